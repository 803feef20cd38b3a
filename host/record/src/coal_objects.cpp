#include "coal_objects.hpp"

#include <coal/BVH/BVH_model.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>
#include <string_view>
#include <typeinfo>

#include "reach.hpp"

namespace ocb::record {
namespace {

#define OCB_MEMBER(name, Compute, place)                                                                                                    \
  struct name {                                                                                                                             \
    using Type = const coal::CollisionGeometry *Compute::*;                                                                                 \
    friend Type reach(name);                                                                                                                \
  };                                                                                                                                        \
  template struct Reach<name, &Compute::place>;
OCB_MEMBER(FirstToCollide, coal::ComputeCollision, o1)
OCB_MEMBER(SecondToCollide, coal::ComputeCollision, o2)
OCB_MEMBER(FirstToMeasure, coal::ComputeDistance, o1)
OCB_MEMBER(SecondToMeasure, coal::ComputeDistance, o2)

Triangles triangles(const std::vector<coal::Vec3s> &vertices, const std::vector<coal::Triangle> &corners, std::size_t count) {
  Triangles all{coordinates(vertices.data(), vertices.size()), {}};
  for (std::size_t t = 0; t < count && t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k)
      all.corners.push_back(static_cast<std::uint32_t>(corners[t][k]));
  return all;
}

Known mesh(Spool &spool, const coal::BVHModelBase &its, std::uint32_t library) {
  if (its.getModelType() != coal::BVH_MODEL_TRIANGLES || !its.vertices || !its.tri_indices)
    throw Unusable{"a point cloud is not a recorded kind of object"};
  const auto &vertices = *its.vertices;
  const auto read = [&] { return triangles(vertices, *its.tri_indices, its.num_tris); };
  return model(spool, &its, mark(its, vertices.data(), vertices.size(), its.num_tris), false, read, library);
}

Known convex(Spool &spool, const coal::ConvexBase &base, std::uint32_t library) {
  // By its name, because only libcoal has the types themselves.
  static constexpr std::string_view OF_TRIANGLES = "N4coal6ConvexINS_8TriangleEEE";
  if (typeid(base).name() != OF_TRIANGLES)
    throw Unusable{"a convex body whose faces are no triangles is not a recorded kind of object"};
  const auto &body = static_cast<const coal::Convex<coal::Triangle> &>(base);
  if (!body.points || !body.polygons)
    throw Unusable{"a convex body without faces is not a recorded kind of object"};
  const auto &points = *body.points;
  const auto read = [&] { return triangles(points, *body.polygons, body.num_polygons); };
  return model(spool, &body, mark(body, points.data(), points.size(), body.num_polygons), true, read, library);
}

Known shape(Spool &spool, const coal::ShapeBase &body, std::uint32_t library) {
  if (body.getSweptSphereRadius() > 0)
    throw Unusable{"a body with a swept sphere is not recorded"};
  switch (body.getNodeType()) {
  case coal::GEOM_CONVEX:
    return convex(spool, static_cast<const coal::ConvexBase &>(body), library);
  case coal::GEOM_BOX: {
    const auto &half = static_cast<const coal::Box &>(body).halfSide;
    return primitive(spool, "box", {2 * half[0], 2 * half[1], 2 * half[2]}, library);
  }
  case coal::GEOM_SPHERE:
    return primitive(spool, "sphere", {static_cast<const coal::Sphere &>(body).radius}, library);
  case coal::GEOM_CYLINDER: {
    const auto &cylinder = static_cast<const coal::Cylinder &>(body);
    return primitive(spool, "cylinder", {cylinder.radius, 2 * cylinder.halfLength}, library);
  }
  case coal::GEOM_CAPSULE: {
    const auto &capsule = static_cast<const coal::Capsule &>(body);
    return primitive(spool, "capsule", {capsule.radius, 2 * capsule.halfLength}, library);
  }
  case coal::GEOM_CONE:
    throw Unusable{"a cone is not a recorded kind of object"};
  case coal::GEOM_ELLIPSOID:
    throw Unusable{"an ellipsoid is not a recorded kind of object"};
  case coal::GEOM_PLANE:
  case coal::GEOM_HALFSPACE:
    throw Unusable{"a plane or half-space is not a recorded kind of object"};
  case coal::GEOM_TRIANGLE:
    throw Unusable{"a single triangle is not a recorded kind of object"};
  default:
    throw Unusable{"an object of an unknown kind"};
  }
}

} // namespace

Known describe(Spool &spool, const coal::CollisionGeometry &geometry, std::uint32_t library) {
  switch (geometry.getObjectType()) {
  case coal::OT_BVH:
    return mesh(spool, static_cast<const coal::BVHModelBase &>(geometry), library);
  case coal::OT_GEOM:
    return shape(spool, static_cast<const coal::ShapeBase &>(geometry), library);
  case coal::OT_OCTREE:
    throw Unusable{"an octree is not a recorded kind of object"};
  case coal::OT_HFIELD:
    throw Unusable{"a height field is not a recorded kind of object"};
  default:
    throw Unusable{"an object of an unknown kind"};
  }
}

const coal::CollisionGeometry &first(const coal::ComputeCollision &compute) { return *(compute.*reach(FirstToCollide{})); }
const coal::CollisionGeometry &second(const coal::ComputeCollision &compute) { return *(compute.*reach(SecondToCollide{})); }
const coal::CollisionGeometry &first(const coal::ComputeDistance &compute) { return *(compute.*reach(FirstToMeasure{})); }
const coal::CollisionGeometry &second(const coal::ComputeDistance &compute) { return *(compute.*reach(SecondToMeasure{})); }

} // namespace ocb::record
