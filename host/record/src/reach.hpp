// Reaches a member that a class does not show: explicit instantiations may name it.
#pragma once

namespace ocb::record {
// Each file has its own, which it instantiates for types of its own.
namespace {

// `Member` has the type of a pointer to the member as `Type`, and declares a friend `Type reach(Member)`, which this defines.
template <typename Member, typename Member::Type pointer> struct Reach {
  friend typename Member::Type reach(Member) { return pointer; }
};

} // namespace
} // namespace ocb::record
