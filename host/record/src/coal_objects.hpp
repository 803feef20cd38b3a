// What the geometries of Coal are, for the spool.
#pragma once

#include <coal/collision.h>
#include <coal/distance.h>

#include "described.hpp"

namespace ocb::record {

// Throws `Unusable` for geometries that are not recorded. For one thread at a time.
Known describe(Spool &spool, const coal::CollisionGeometry &geometry, std::uint32_t library);

// The pairs that these were made for, which they do not show.
const coal::CollisionGeometry &first(const coal::ComputeCollision &compute);
const coal::CollisionGeometry &second(const coal::ComputeCollision &compute);
const coal::CollisionGeometry &first(const coal::ComputeDistance &compute);
const coal::CollisionGeometry &second(const coal::ComputeDistance &compute);

} // namespace ocb::record
