// Puts a function in the place of one of the recorded library.
#pragma once

#include "next.hpp"
#include "process.hpp"

#define OCB_STRING(text) #text
#define OCB_TEXT(text) OCB_STRING(text)

// Behind a declaration: it has this name, which the compiler gives to the function of the library.
#define OCB_REPLACES(name) asm(OCB_TEXT(name)) __attribute__((visibility("default")))

// Finds the library's function `real`. A call is `wanted` unless another is under way, or another recorder sees the caller.
#define OCB_NEXT(name, function)                                                                                                            \
  static constexpr ::ocb::record::Symbol symbol{OCB_TEXT(name), "lib" OCB_RECORDER};                                                        \
  const auto [address, left] = symbol.next(reinterpret_cast<const void *>(function), __builtin_return_address(0));                          \
  const auto real = reinterpret_cast<decltype(&function)>(address);                                                                         \
  const ::ocb::record::Inside inside;                                                                                                       \
  const bool wanted = inside.first() && !left && ::ocb::record::recording()

// The queries during one call of this member function of a collision manager are one group.
#define OCB_GROUPS(mangled, which, parameters, arguments)                                                                                   \
  extern "C" void which parameters asm(#mangled) __attribute__((visibility("default")));                                                    \
  extern "C" void which parameters {                                                                                                        \
    static constexpr ::ocb::record::Symbol symbol{#mangled, "lib" OCB_RECORDER};                                                            \
    const auto reached = symbol.next(reinterpret_cast<const void *>(which), __builtin_return_address(0));                                   \
    const ::ocb::record::Together together;                                                                                                 \
    reinterpret_cast<decltype(&which)>(reached.function) arguments;                                                                         \
  }
