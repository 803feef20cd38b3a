// Stands before libcoal in a program, and records what the program asks of it: collide and distance, of objects, of geometries and
// of pairs for repeated queries.
#include <limits>

#include "coal_objects.hpp"
#include "replaces.hpp"

// The names that the compiler gives these functions, with which programs are linked.
#define COLLIDE_OBJECTS _ZN4coal7collideEPKNS_15CollisionObjectES2_RKNS_16CollisionRequestERNS_15CollisionResultE
#define COLLIDE_GEOMETRIES _ZN4coal7collideEPKNS_17CollisionGeometryERKNS_11Transform3sES2_S5_RKNS_16CollisionRequestERNS_15CollisionResultE
#define COLLIDE_PAIR _ZNK4coal16ComputeCollisionclERKNS_11Transform3sES3_RKNS_16CollisionRequestERNS_15CollisionResultE
#define DISTANCE_OBJECTS _ZN4coal8distanceEPKNS_15CollisionObjectES2_RKNS_15DistanceRequestERNS_14DistanceResultE
#define DISTANCE_GEOMETRIES _ZN4coal8distanceEPKNS_17CollisionGeometryERKNS_11Transform3sES2_S5_RKNS_15DistanceRequestERNS_14DistanceResultE
#define DISTANCE_PAIR _ZNK4coal15ComputeDistanceclERKNS_11Transform3sES3_RKNS_15DistanceRequestERNS_14DistanceResultE

namespace {

using namespace ocb::record;
using Geometry = coal::CollisionGeometry;
using Object = coal::CollisionObject;
using Pose = coal::Transform3s;
using Pair = PairOf<Geometry, Pose>;
using CollisionPair = coal::ComputeCollision;
using DistancePair = coal::ComputeDistance;

// What Coal has as distance where nothing was asked yet.
constexpr double NO_ANSWER = std::numeric_limits<double>::max();

Pair pair(const Object *a, const Object *b) {
  return {{a->collisionGeometryPtr(), b->collisionGeometryPtr()}, {&a->getTransform(), &b->getTransform()}};
}

Query query(Spool &spool, const Pair &pair, bool &convex) {
  const auto at = [](const Pose &pose) { return matrix(pose.getRotation(), pose.getTranslation()); };
  return about(spool, spool.library("coal", COAL_VERSION), pair, convex, at);
}

// `pair` is called behind the library, which may change what a pair was made for.
std::size_t collide(const auto &pair, const coal::CollisionRequest &request, const coal::CollisionResult &result, const auto &ask) {
  const std::size_t before = result.numContacts();
  const double begun = seconds_now();
  const std::size_t answer = ask();
  observe(seconds_now() - begun, [&](Spool &spool) {
    if (!(request.security_margin >= 0))
      throw Unusable{"a negative security margin is not recorded"};
    bool convex = false;
    Query it = query(spool, pair(), convex);
    if (request.security_margin > 0) {
      it.kind = TOLERANCE, it.limit = request.security_margin;
    } else {
      it.kind = request.num_max_contacts > 1 ? CONTACTS : COLLIDE;
      it.limit = static_cast<double>(request.num_max_contacts);
    }
    it.bits = hit_told(before, result.numContacts(), request.num_max_contacts, convex);
    return it;
  });
  return answer;
}

double distance(const auto &pair, const coal::DistanceRequest &, const coal::DistanceResult &result, const auto &ask) {
  const double before = result.min_distance, begun = seconds_now();
  const double distance = ask();
  observe(seconds_now() - begun, [&](Spool &spool) {
    bool convex = false;
    Query it = query(spool, pair(), convex);
    it.kind = DISTANCE, it.distance = distance;
    it.bits = distance_told(before, distance, NO_ANSWER, convex);
    return it;
  });
  return distance;
}

} // namespace

// Both kinds of questions, which Coal asks by functions of the same shapes.
#define OCB_ASKS(answer, asked, Compute, Request, Result, OBJECTS, GEOMETRIES, PAIR)                                                  \
  extern "C" answer ocb_##asked##_objects(const Object *, const Object *, const Request &, Result &) OCB_REPLACES(OBJECTS);                 \
  extern "C" answer ocb_##asked##_objects(const Object *a, const Object *b, const Request &request, Result &result) {                       \
    OCB_NEXT(OBJECTS, ocb_##asked##_objects);                                                                                               \
    const auto ask = [&] { return real(a, b, request, result); };                                                                           \
    return wanted ? asked([&] { return pair(a, b); }, request, result, ask) : ask();                                                                   \
  }                                                                                                                                         \
  extern "C" answer ocb_##asked##_geometries(const Geometry *, const Pose &, const Geometry *, const Pose &, const Request &, Result &)     \
      OCB_REPLACES(GEOMETRIES);                                                                                                             \
  extern "C" answer ocb_##asked##_geometries(const Geometry *a, const Pose &at, const Geometry *b, const Pose &bt, const Request &request,  \
                                             Result &result) {                                                                              \
    OCB_NEXT(GEOMETRIES, ocb_##asked##_geometries);                                                                                         \
    const auto ask = [&] { return real(a, at, b, bt, request, result); };                                                                   \
    return wanted ? asked([&] { return Pair{{a, b}, {&at, &bt}}; }, request, result, ask) : ask();                                                     \
  }                                                                                                                                         \
  extern "C" answer ocb_##asked##_pair(const Compute *, const Pose &, const Pose &, const Request &, Result &) OCB_REPLACES(PAIR);          \
  extern "C" answer ocb_##asked##_pair(const Compute *both, const Pose &at, const Pose &bt, const Request &request, Result &result) {       \
    OCB_NEXT(PAIR, ocb_##asked##_pair);                                                                                                     \
    const auto ask = [&] { return real(both, at, bt, request, result); };                                                                   \
    return wanted ? asked([&] { return Pair{{&first(*both), &second(*both)}, {&at, &bt}}; }, request, result, ask) : ask();                            \
  }

OCB_ASKS(std::size_t, collide, CollisionPair, coal::CollisionRequest, coal::CollisionResult, COLLIDE_OBJECTS, COLLIDE_GEOMETRIES,
         COLLIDE_PAIR)
OCB_ASKS(double, distance, DistancePair, coal::DistanceRequest, coal::DistanceResult, DISTANCE_OBJECTS, DISTANCE_GEOMETRIES, DISTANCE_PAIR)
