// The recording of this process: its spool, made at the first query, and the groups to which queries belong.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>

#include "spool.hpp"

namespace ocb::record {

// Describes a query for the spool, without sequence, group and seconds; may throw `Unusable`.
using Describe = std::function<Query(Spool &)>;

// Is anything recorded in this process?
bool recording() noexcept;

// Records a query that took so long. Throws nothing: a recorder must not end the program that it records.
void observe(double seconds, const Describe &describe) noexcept;

// The queries of this thread belong to one group while this lives; the outermost of several holds.
class Together {
public:
  Together() noexcept;
  ~Together();
  Together(const Together &) = delete;
  Together &operator=(const Together &) = delete;
};

// A call of the library is under way in this thread: what it calls itself is no query of the program.
class Inside {
public:
  Inside() noexcept;
  ~Inside();
  Inside(const Inside &) = delete;
  Inside &operator=(const Inside &) = delete;
  // No other call was under way.
  bool first() const noexcept;
};

// Seconds on a clock that never jumps.
double seconds_now() noexcept;

} // namespace ocb::record
