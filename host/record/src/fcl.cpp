// Stands before libfcl in a program, and records what the program asks of it: collide and distance, of objects and of geometries.
#include <limits>

#include "fcl_objects.hpp"
#include "replaces.hpp"

// The names that the compiler gives these functions, with which programs are linked.
#define COLLIDE_OBJECTS _ZN3fcl7collideIdEEmPKNS_15CollisionObjectIT_EES5_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE
#define COLLIDE_GEOMETRIES                                                                                                                  \
  _ZN3fcl7collideIdEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS2_Li3ELi1ELi0EEES5_SA_RKNS_16CollisionRequestIS2_EERNS_15CollisionResultIS2_EE
#define COLLIDE_BY_LIBCCD                                                                                                                   \
  _ZN3fcl7collideIdNS_6detail16GJKSolver_libccdIdEEEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS5_Li3ELi1ELi0EEES8_SD_PKT0_RKNS_16CollisionRequestIS5_EERNS_15CollisionResultIS5_EE
#define COLLIDE_BY_INDEP                                                                                                                    \
  _ZN3fcl7collideIdNS_6detail15GJKSolver_indepIdEEEEmPKNS_17CollisionGeometryIT_EERKN5Eigen9TransformIS5_Li3ELi1ELi0EEES8_SD_PKT0_RKNS_16CollisionRequestIS5_EERNS_15CollisionResultIS5_EE
#define DISTANCE_OBJECTS _ZN3fcl8distanceIdEET_PKNS_15CollisionObjectIS1_EES5_RKNS_15DistanceRequestIS1_EERNS_14DistanceResultIS1_EE
#define DISTANCE_GEOMETRIES                                                                                                                 \
  _ZN3fcl8distanceIdEET_PKNS_17CollisionGeometryIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEES5_SA_RKNS_15DistanceRequestIS1_EERNS_14DistanceResultIS1_EE
#define CONTINUOUS_OBJECTS                                                                                                                  \
  _ZN3fcl17continuousCollideIdEET_PKNS_15CollisionObjectIS1_EERKN5Eigen9TransformIS1_Li3ELi1ELi0EEES5_SA_RKNS_26ContinuousCollisionRequestIS1_EERNS_25ContinuousCollisionResultIS1_EE

namespace {

using namespace ocb::record;
using Geometry = fcl::CollisionGeometryd;
using Object = fcl::CollisionObjectd;
using Pose = fcl::Transform3d;
using Pair = PairOf<Geometry, Pose>;
using Request = fcl::CollisionRequestd;
using Result = fcl::CollisionResultd;

// What FCL gives as distance where it has no algorithm for a pair, and where nothing was asked yet.
constexpr double NO_ANSWER = std::numeric_limits<double>::max();

Pair pair(const Object *a, const Object *b) {
  return {{&geometry(*a), &geometry(*b)}, {&pose(*a), &pose(*b)}};
}

Query query(Spool &spool, const Pair &pair, bool &convex) {
  const auto at = [](const Pose &pose) { return matrix(pose.linear(), pose.translation()); };
  return about(spool, spool.library("fcl", FCL_VERSION), pair, convex, at);
}

std::size_t collide(const Pair &pair, const Request &request, const Result &result, const auto &ask) {
  const std::size_t before = contacts(result);
  const double begun = seconds_now();
  const std::size_t answer = ask();
  observe(seconds_now() - begun, [&](Spool &spool) {
    bool convex = false;
    Query it = query(spool, pair, convex);
    it.kind = request.num_max_contacts > 1 ? CONTACTS : COLLIDE;
    it.limit = static_cast<double>(request.num_max_contacts);
    it.bits = hit_told(before, contacts(result), request.num_max_contacts, convex);
    return it;
  });
  return answer;
}

double distance(const Pair &pair, const fcl::DistanceResultd &result, const auto &ask) {
  const double before = result.min_distance, begun = seconds_now();
  const double distance = ask();
  observe(seconds_now() - begun, [&](Spool &spool) {
    bool convex = false;
    Query it = query(spool, pair, convex);
    it.kind = DISTANCE;
    it.distance = distance;
    it.bits = distance_told(before, distance, NO_ANSWER, convex);
    return it;
  });
  return distance;
}

} // namespace

extern "C" {

std::size_t ocb_collide_objects(const Object *, const Object *, const Request &, Result &) OCB_REPLACES(COLLIDE_OBJECTS);
std::size_t ocb_collide_objects(const Object *a, const Object *b, const Request &request, Result &result) {
  OCB_NEXT(COLLIDE_OBJECTS, ocb_collide_objects);
  if (!wanted)
    return real(a, b, request, result);
  return collide(pair(a, b), request, result, [&] { return real(a, b, request, result); });
}

std::size_t ocb_collide_geometries(const Geometry *, const Pose &, const Geometry *, const Pose &, const Request &, Result &)
    OCB_REPLACES(COLLIDE_GEOMETRIES);
std::size_t ocb_collide_geometries(const Geometry *a, const Pose &at, const Geometry *b, const Pose &bt, const Request &request,
                                   Result &result) {
  OCB_NEXT(COLLIDE_GEOMETRIES, ocb_collide_geometries);
  if (!wanted)
    return real(a, at, b, bt, request, result);
  return collide({{a, b}, {&at, &bt}}, request, result, [&] { return real(a, at, b, bt, request, result); });
}

// Reached by programs whose compiler put the functions above into their own code.
#define OCB_BY_SOLVER(function, name)                                                                                                       \
  std::size_t function(const Geometry *, const Pose &, const Geometry *, const Pose &, const void *, const Request &, Result &)             \
      OCB_REPLACES(name);                                                                                                                   \
  std::size_t function(const Geometry *a, const Pose &at, const Geometry *b, const Pose &bt, const void *solver, const Request &request,    \
                       Result &result) {                                                                                                    \
    OCB_NEXT(name, function);                                                                                                               \
    if (!wanted)                                                                                                                            \
      return real(a, at, b, bt, solver, request, result);                                                                                   \
    return collide({{a, b}, {&at, &bt}}, request, result, [&] { return real(a, at, b, bt, solver, request, result); });                     \
  }
OCB_BY_SOLVER(ocb_collide_by_libccd, COLLIDE_BY_LIBCCD)
OCB_BY_SOLVER(ocb_collide_by_indep, COLLIDE_BY_INDEP)

double ocb_distance_objects(const Object *, const Object *, const fcl::DistanceRequestd &, fcl::DistanceResultd &)
    OCB_REPLACES(DISTANCE_OBJECTS);
double ocb_distance_objects(const Object *a, const Object *b, const fcl::DistanceRequestd &request, fcl::DistanceResultd &result) {
  OCB_NEXT(DISTANCE_OBJECTS, ocb_distance_objects);
  if (!wanted)
    return real(a, b, request, result);
  return distance(pair(a, b), result, [&] { return real(a, b, request, result); });
}

double ocb_distance_geometries(const Geometry *, const Pose &, const Geometry *, const Pose &, const fcl::DistanceRequestd &,
                               fcl::DistanceResultd &) OCB_REPLACES(DISTANCE_GEOMETRIES);
double ocb_distance_geometries(const Geometry *a, const Pose &at, const Geometry *b, const Pose &bt, const fcl::DistanceRequestd &request,
                               fcl::DistanceResultd &result) {
  OCB_NEXT(DISTANCE_GEOMETRIES, ocb_distance_geometries);
  if (!wanted)
    return real(a, at, b, bt, request, result);
  return distance({{a, b}, {&at, &bt}}, result, [&] { return real(a, at, b, bt, request, result); });
}

// Continuous collision is counted only, and the queries that it makes are no queries of the program.
double ocb_continuous_objects(const Object *, const Pose &, const Object *, const Pose &, const fcl::ContinuousCollisionRequestd &,
                              fcl::ContinuousCollisionResultd &) OCB_REPLACES(CONTINUOUS_OBJECTS);
double ocb_continuous_objects(const Object *a, const Pose &at, const Object *b, const Pose &bt,
                              const fcl::ContinuousCollisionRequestd &request, fcl::ContinuousCollisionResultd &result) {
  OCB_NEXT(CONTINUOUS_OBJECTS, ocb_continuous_objects);
  if (wanted)
    observe(0, [](Spool &) -> Query { throw Unusable{"continuous collision is not recorded"}; });
  return real(a, at, b, bt, request, result);
}

} // extern "C"
