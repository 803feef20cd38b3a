// What the geometries of FCL are, for the spool.
#pragma once

#include <fcl/fcl.h>

#include "described.hpp"

namespace ocb::record {

// Throws `Unusable` for geometries that are not recorded. For one thread at a time.
Known describe(Spool &spool, const fcl::CollisionGeometryd &geometry, std::uint32_t library);

// What libfcl alone has functions for, which a process may not have loaded.
const fcl::CollisionGeometryd &geometry(const fcl::CollisionObjectd &object);
const fcl::Transform3d &pose(const fcl::CollisionObjectd &object);
std::size_t contacts(const fcl::CollisionResultd &result);

} // namespace ocb::record
