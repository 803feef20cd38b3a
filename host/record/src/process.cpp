#include "process.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <pthread.h>
#include <string>
#include <unistd.h>

#ifndef OCB_RECORDER
#error "OCB_RECORDER names the recorder"
#endif

namespace ocb::record {
namespace {

constexpr std::uint64_t NO_GROUP = ~std::uint64_t{0};

// What follows is never destroyed: threads may ask while the process ends.
struct State {
  std::mutex mutex;
  std::unique_ptr<Spool> spool;
  // The environment names no folder, or the spool cannot be written.
  bool off = false;
};

State &state() {
  static State &of_process = *new State;
  return of_process;
}

std::atomic<std::uint64_t> groups{0};
thread_local std::uint64_t group_here = NO_GROUP;
thread_local int together = 0, inside = 0;

const char *folder() { return std::getenv("OCB_RECORD"); }

std::unique_ptr<Spool> make() {
  const char *program = std::getenv("OCB_RECORD_PROGRAM"), *limit = std::getenv("OCB_RECORD_LIMIT");
  const auto most = limit ? std::strtoull(limit, nullptr, 10) : 250'000;
  for (int number = 0;; ++number) {
    const std::string path = std::string(folder()) + "/" + std::to_string(::getpid()) + "-" OCB_RECORDER "-" + std::to_string(number);
    if (::access(path.c_str(), F_OK) != 0)
      return std::make_unique<Spool>(path, program ? program : program_invocation_short_name, "opencollbench record for " OCB_RECORDER, most);
  }
}

// A child of a fork writes a spool of its own.
[[gnu::constructor]] void follow_forks() {
  ::pthread_atfork([] { state().mutex.lock(); }, [] { state().mutex.unlock(); },
                   [] {
                     state().spool.reset();
                     state().mutex.unlock();
                   });
}

[[gnu::destructor]] void last_note() {
  const std::lock_guard lock(state().mutex);
  try {
    if (state().spool)
      state().spool->note();
  } catch (const std::exception &) {
    // The notes before it stay.
  }
}

} // namespace

bool recording() noexcept {
  static const bool wanted = folder() != nullptr;
  return wanted;
}

void observe(double seconds, const Describe &describe) noexcept {
  State &all = state();
  const std::lock_guard lock(all.mutex);
  if (all.off)
    return;
  try {
    if (!all.spool)
      all.spool = make();
    const std::uint64_t group = group_here == NO_GROUP ? groups++ : group_here;
    if (!all.spool->keeps(group))
      return;
    try {
      Query query = describe(*all.spool);
      query.group = group, query.seconds = seconds;
      all.spool->add(query);
    } catch (const Unusable &why) {
      all.spool->drop(why.reason);
    }
  } catch (const std::exception &why) {
    all.off = true;
    std::fprintf(stderr, "ocb record: recording stopped, what was written stays: %s\n", why.what());
  }
}

Together::Together() noexcept {
  if (together++ == 0)
    group_here = groups++;
}

Together::~Together() {
  if (--together == 0)
    group_here = NO_GROUP;
}

Inside::Inside() noexcept { ++inside; }
Inside::~Inside() { --inside; }
bool Inside::first() const noexcept { return inside == 1; }

double seconds_now() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace ocb::record
