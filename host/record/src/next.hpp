// Finds the function of the library that a caller would have reached without us.
#pragma once

namespace ocb::record {

// What a call through a symbol reaches.
struct Next {
  void *function = nullptr;
  // Calls of this caller are recorded by another recorder, or by none.
  bool left = false;
};

// Where the calls through one symbol go. The function is that of the library with which the module of the caller is linked.
class Symbol {
public:
  // `library` begins the file name of libraries that have it; `ours` is the function that took its place.
  constexpr Symbol(const char *name, const char *library) : name_(name), library_(library) {}
  // The process is ended where there is no such function, as the loader does it, because the call cannot be answered.
  Next next(const void *ours, const void *caller) const noexcept;

private:
  const char *name_, *library_;
};

} // namespace ocb::record

// Calls from modules whose file has this end of its name are left to another recorder from now on.
extern "C" void ocb_record_leave(const char *ending) noexcept asm("ocb_record_leave_" OCB_RECORDER) __attribute__((visibility("default")));
