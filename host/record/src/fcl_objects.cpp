#include "fcl_objects.hpp"

#include "reach.hpp"

namespace ocb::record {
namespace {

struct Geometry {
  using Type = std::shared_ptr<fcl::CollisionGeometryd> fcl::CollisionObjectd::*;
  friend Type reach(Geometry);
};
struct Pose {
  using Type = fcl::Transform3d fcl::CollisionObjectd::*;
  friend Type reach(Pose);
};
struct Contacts {
  using Type = std::vector<fcl::Contactd> fcl::CollisionResultd::*;
  friend Type reach(Contacts);
};
struct Corners {
  using Type = std::size_t (fcl::Triangle::*)[3];
  friend Type reach(Corners);
};
template struct Reach<Geometry, &fcl::CollisionObjectd::cgeom>;
template struct Reach<Pose, &fcl::CollisionObjectd::t>;
template struct Reach<Contacts, &fcl::CollisionResultd::contacts>;
template struct Reach<Corners, &fcl::Triangle::vids>;

// The members that are read stand at the same place for every kind of bounding volume.
Known mesh(Spool &spool, const fcl::BVHModel<fcl::OBBRSSd> &model, std::uint32_t library) {
  if (model.getModelType() != fcl::BVH_MODEL_TRIANGLES)
    throw Unusable{"a point cloud is not a recorded kind of object"};
  const auto vertices = static_cast<std::size_t>(model.num_vertices), triangles = static_cast<std::size_t>(model.num_tris);
  const auto read = [&] {
    Triangles all{coordinates(model.vertices, vertices), {}};
    for (std::size_t t = 0; t < triangles; ++t)
      for (int k = 0; k < 3; ++k)
        all.corners.push_back(static_cast<std::uint32_t>((model.tri_indices[t].*reach(Corners{}))[k]));
    return all;
  };
  return record::model(spool, &model, mark(model, model.vertices, vertices, triangles), false, read, library);
}

Known convex(Spool &spool, const fcl::Convexd &body, std::uint32_t library) {
  const auto &vertices = body.getVertices();
  const auto read = [&] {
    Triangles all{coordinates(vertices.data(), vertices.size()), {}};
    const auto &faces = body.getFaces();
    std::size_t at = 0;
    for (int f = 0; f < body.getFaceCount() && at < faces.size(); ++f) {
      const auto corners = static_cast<std::size_t>(faces[at]);
      for (std::size_t i = 2; i < corners && at + i + 1 < faces.size(); ++i)
        for (const std::size_t k : {std::size_t{1}, i, i + 1})
          all.corners.push_back(static_cast<std::uint32_t>(faces[at + k]));
      at += 1 + corners;
    }
    return all;
  };
  const auto its = mark(body, vertices.data(), vertices.size(), static_cast<std::size_t>(body.getFaceCount()));
  return model(spool, &body, its, true, read, library);
}

} // namespace

Known describe(Spool &spool, const fcl::CollisionGeometryd &geometry, std::uint32_t library) {
  switch (geometry.getNodeType()) {
  case fcl::BV_AABB:
  case fcl::BV_OBB:
  case fcl::BV_RSS:
  case fcl::BV_kIOS:
  case fcl::BV_OBBRSS:
  case fcl::BV_KDOP16:
  case fcl::BV_KDOP18:
  case fcl::BV_KDOP24:
    return mesh(spool, static_cast<const fcl::BVHModel<fcl::OBBRSSd> &>(geometry), library);
  case fcl::GEOM_CONVEX:
    return convex(spool, static_cast<const fcl::Convexd &>(geometry), library);
  case fcl::GEOM_BOX: {
    const auto &side = static_cast<const fcl::Boxd &>(geometry).side;
    return primitive(spool, "box", {side[0], side[1], side[2]}, library);
  }
  case fcl::GEOM_SPHERE:
    return primitive(spool, "sphere", {static_cast<const fcl::Sphered &>(geometry).radius}, library);
  case fcl::GEOM_CYLINDER: {
    const auto &cylinder = static_cast<const fcl::Cylinderd &>(geometry);
    return primitive(spool, "cylinder", {cylinder.radius, cylinder.lz}, library);
  }
  case fcl::GEOM_CAPSULE: {
    const auto &capsule = static_cast<const fcl::Capsuled &>(geometry);
    return primitive(spool, "capsule", {capsule.radius, capsule.lz}, library);
  }
  case fcl::GEOM_CONE:
    throw Unusable{"a cone is not a recorded kind of object"};
  case fcl::GEOM_ELLIPSOID:
    throw Unusable{"an ellipsoid is not a recorded kind of object"};
  case fcl::GEOM_PLANE:
  case fcl::GEOM_HALFSPACE:
    throw Unusable{"a plane or half-space is not a recorded kind of object"};
  case fcl::GEOM_TRIANGLE:
    throw Unusable{"a single triangle is not a recorded kind of object"};
  case fcl::GEOM_OCTREE:
    throw Unusable{"an octree is not a recorded kind of object"};
  default:
    throw Unusable{"an object of an unknown kind"};
  }
}

const fcl::CollisionGeometryd &geometry(const fcl::CollisionObjectd &object) { return *(object.*reach(Geometry{})); }
const fcl::Transform3d &pose(const fcl::CollisionObjectd &object) { return object.*reach(Pose{}); }
std::size_t contacts(const fcl::CollisionResultd &result) { return (result.*reach(Contacts{})).size(); }

} // namespace ocb::record
