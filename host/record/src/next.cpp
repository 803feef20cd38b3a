#include "next.hpp"

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <link.h>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ocb::record {
namespace {

struct Known {
  Next look_up(const char *symbol, const char *library, const void *ours, const void *caller) noexcept;

  std::mutex mutex;
  std::map<std::pair<const void *, std::string_view>, void *> functions;
  std::vector<std::string> left;
  std::atomic<unsigned> leaves{0};
};

Known &known() {
  static Known &of_process = *new Known;
  return of_process;
}

// A function in a loaded library whose file is named so; for callers that are not linked with it themselves.
void *anywhere(const char *symbol, const char *library) {
  struct Search {
    const char *symbol, *library;
    void *found;
  } search{symbol, library, nullptr};
  ::dl_iterate_phdr(
      [](dl_phdr_info *info, std::size_t, void *data) {
        auto &search = *static_cast<Search *>(data);
        const std::string_view path = info->dlpi_name ? info->dlpi_name : "";
        const auto name = path.substr(path.rfind('/') + 1);
        if (!name.starts_with(search.library))
          return 0;
        if (void *handle = ::dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD))
          search.found = ::dlsym(handle, search.symbol);
        return search.found != nullptr ? 1 : 0;
      },
      &search);
  return search.found;
}

void *find(const char *symbol, const char *library, const void *ours, const char *module) {
  // The module and what it is linked with. It is never closed: the function must stay as long as it may be called.
  if (void *handle = ::dlopen(module, RTLD_LAZY | RTLD_NOLOAD))
    if (void *found = ::dlsym(handle, symbol); found && found != ours)
      return found;
  if (void *found = ::dlsym(RTLD_NEXT, symbol))
    return found;
  return anywhere(symbol, library);
}

Next Known::look_up(const char *symbol, const char *library, const void *ours, const void *caller) noexcept {
  const std::lock_guard lock(mutex);
  Dl_info module{};
  if (::dladdr(caller, &module) == 0)
    module.dli_fname = nullptr;
  void *&function = functions[{module.dli_fbase, symbol}];
  if (!function)
    function = find(symbol, library, ours, module.dli_fname);
  if (!function) {
    std::fprintf(stderr, "ocb record: symbol lookup error: undefined symbol: %s\n", symbol);
    std::_Exit(127);
  }
  Next answer{function, false};
  const std::string_view path = module.dli_fname ? module.dli_fname : "";
  for (const auto &ending : left)
    answer.left = answer.left || path.ends_with(ending);
  return answer;
}

} // namespace

Next Symbol::next(const void *ours, const void *caller) const noexcept {
  // The same place mostly calls again.
  struct Last {
    const Symbol *symbol;
    const void *caller;
    unsigned leaves;
    Next next;
  };
  static thread_local Last last[8];
  Last &here = last[(reinterpret_cast<std::uintptr_t>(caller) ^ reinterpret_cast<std::uintptr_t>(this) / alignof(Symbol)) % 8];
  Known &all = known();
  if (const unsigned leaves = all.leaves.load(); here.symbol != this || here.caller != caller || here.leaves != leaves)
    here = {this, caller, leaves, all.look_up(name_, library_, ours, caller)};
  return here.next;
}

} // namespace ocb::record

void ocb_record_leave(const char *ending) noexcept {
  auto &all = ocb::record::known();
  const std::lock_guard lock(all.mutex);
  all.left.emplace_back(ending);
  ++all.leaves;
}
