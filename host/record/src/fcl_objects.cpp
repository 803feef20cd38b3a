#include "fcl_objects.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <unordered_map>

namespace ocb::record {
namespace {

// Reaches a member that a class does not show: explicit instantiations may name it.
template <typename Member, typename Member::Type pointer> struct Reach {
  friend typename Member::Type reach(Member) { return pointer; }
};
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

using Bounds = std::array<double, 10>;

// Changes when a model at the same address is another one.
struct Fingerprint {
  const void *vertices = nullptr;
  std::size_t num_vertices = 0, num_triangles = 0;
  Bounds bounds{};
  std::array<double, 6> sample{};

  bool operator==(const Fingerprint &) const = default;
};

struct Model {
  Fingerprint mark;
  std::uint32_t object;
};

using V = fcl::Vector3d;

Fingerprint fingerprint(const fcl::CollisionGeometryd &geometry, const V *vertices, std::size_t num_vertices, std::size_t num_triangles) {
  Fingerprint mark{vertices, num_vertices, num_triangles, {}, {}};
  const V *bounds[] = {&geometry.aabb_local.min_, &geometry.aabb_local.max_, &geometry.aabb_center};
  for (int i = 0; i < 3; ++i)
    std::memcpy(&mark.bounds[3 * i], bounds[i]->data(), 3 * sizeof(double));
  mark.bounds[9] = geometry.aabb_radius;
  if (num_vertices > 0) {
    std::memcpy(mark.sample.data(), vertices[0].data(), 3 * sizeof(double));
    std::memcpy(&mark.sample[3], vertices[num_vertices / 2].data(), 3 * sizeof(double));
  }
  return mark;
}

// What was described in the spool that is being written: models by their address, primitives by their kind and lengths.
struct Described {
  std::uint64_t spool = 0;
  std::unordered_map<const void *, Model> models;
  std::map<std::pair<int, std::array<double, 3>>, std::uint32_t> primitives;
};

Described &described(const Spool &spool) {
  static Described &of_process = *new Described;
  if (of_process.spool != spool.serial)
    of_process = Described{spool.serial, {}, {}};
  return of_process;
}

std::uint32_t known(Spool &spool, const fcl::CollisionGeometryd &geometry, const Fingerprint &mark, const auto &read, const char *what,
                    const char *source, std::uint32_t library) {
  auto &models = described(spool).models;
  if (const auto found = models.find(&geometry); found != models.end() && found->second.mark == mark)
    return found->second.object;
  const Triangles triangles = read();
  const std::string name = std::string(what) + " of " + std::to_string(triangles.corners.size() / 3) + " triangles";
  const std::uint32_t object = spool.mesh(name, triangles, source, library);
  models.insert_or_assign(&geometry, Model{mark, object});
  return object;
}

std::uint32_t primitive(Spool &spool, const char *kind, int type, std::initializer_list<double> sizes, std::uint32_t library) {
  std::array<double, 3> lengths{};
  std::copy(sizes.begin(), sizes.end(), lengths.begin());
  auto &primitives = described(spool).primitives;
  if (const auto found = primitives.find({type, lengths}); found != primitives.end())
    return found->second;
  const std::uint32_t object = spool.primitive(kind, sizes, library);
  primitives.emplace(std::pair{type, lengths}, object);
  return object;
}

void copy(std::vector<double> &to, const V *from, std::size_t count) {
  to.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    to.insert(to.end(), from[i].data(), from[i].data() + 3);
}

// The members that are read stand at the same place for every kind of bounding volume.
std::uint32_t mesh(Spool &spool, const fcl::BVHModel<fcl::OBBRSSd> &model, std::uint32_t library) {
  if (model.getModelType() != fcl::BVH_MODEL_TRIANGLES)
    throw Unusable{"a point cloud is not a recorded kind of object"};
  const auto vertices = static_cast<std::size_t>(model.num_vertices), triangles = static_cast<std::size_t>(model.num_tris);
  const auto read = [&] {
    Triangles all;
    copy(all.vertices, model.vertices, vertices);
    for (std::size_t t = 0; t < triangles; ++t)
      for (int k = 0; k < 3; ++k)
        all.corners.push_back(static_cast<std::uint32_t>((model.tri_indices[t].*reach(Corners{}))[k]));
    return all;
  };
  return known(spool, model, fingerprint(model, model.vertices, vertices, triangles), read, "mesh", "", library);
}

std::uint32_t convex(Spool &spool, const fcl::Convexd &body, std::uint32_t library) {
  const auto &vertices = body.getVertices();
  const auto read = [&] {
    Triangles all;
    copy(all.vertices, vertices.data(), vertices.size());
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
  const auto mark = fingerprint(body, vertices.data(), vertices.size(), static_cast<std::size_t>(body.getFaceCount()));
  return known(spool, body, mark, read, "convex body", "its surface; the program's answers where it collides are left out", library);
}

} // namespace

Known describe(Spool &spool, const fcl::CollisionGeometryd &geometry, std::uint32_t library) {
  const auto type = geometry.getNodeType();
  switch (type) {
  case fcl::BV_AABB:
  case fcl::BV_OBB:
  case fcl::BV_RSS:
  case fcl::BV_kIOS:
  case fcl::BV_OBBRSS:
  case fcl::BV_KDOP16:
  case fcl::BV_KDOP18:
  case fcl::BV_KDOP24:
    return {mesh(spool, static_cast<const fcl::BVHModel<fcl::OBBRSSd> &>(geometry), library), false};
  case fcl::GEOM_CONVEX:
    return {convex(spool, static_cast<const fcl::Convexd &>(geometry), library), true};
  case fcl::GEOM_BOX: {
    const V &side = static_cast<const fcl::Boxd &>(geometry).side;
    return {primitive(spool, "box", type, {side[0], side[1], side[2]}, library), false};
  }
  case fcl::GEOM_SPHERE:
    return {primitive(spool, "sphere", type, {static_cast<const fcl::Sphered &>(geometry).radius}, library), false};
  case fcl::GEOM_CYLINDER: {
    const auto &cylinder = static_cast<const fcl::Cylinderd &>(geometry);
    return {primitive(spool, "cylinder", type, {cylinder.radius, cylinder.lz}, library), false};
  }
  case fcl::GEOM_CAPSULE: {
    const auto &capsule = static_cast<const fcl::Capsuled &>(geometry);
    return {primitive(spool, "capsule", type, {capsule.radius, capsule.lz}, library), false};
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

Matrix matrix(const fcl::Transform3d &pose) {
  Matrix rows;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      rows[4 * i + k] = pose.linear()(i, k);
    rows[4 * i + 3] = pose.translation()[i];
  }
  return rows;
}

} // namespace ocb::record
