// The objects of a library in the spool that is being written, so that each model is read once. For one thread at a time.
#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <initializer_list>

#include "spool.hpp"

namespace ocb::record {

// An object of a query: its number in the spool, and whether it is a convex body, of which the surface alone is recorded.
struct Known {
  std::uint32_t object = 0;
  bool convex = false;
};

// Changes when a model at the same address is another one.
struct Mark {
  const void *vertices = nullptr;
  std::size_t num_vertices = 0, num_triangles = 0;
  std::array<double, 10> bounds{};
  std::array<double, 6> sample{};

  bool operator==(const Mark &) const = default;
};

// The mark of a geometry with these vertices, which are three numbers each.
template <typename Geometry, typename Vector>
Mark mark(const Geometry &geometry, const Vector *vertices, std::size_t num_vertices, std::size_t num_triangles) {
  static_assert(sizeof(Vector) == 3 * sizeof(double));
  Mark mark{vertices, num_vertices, num_triangles, {}, {}};
  const Vector *bounds[] = {&geometry.aabb_local.min_, &geometry.aabb_local.max_, &geometry.aabb_center};
  for (int i = 0; i < 3; ++i)
    std::memcpy(&mark.bounds[3 * i], bounds[i]->data(), 3 * sizeof(double));
  mark.bounds[9] = geometry.aabb_radius;
  if (num_vertices > 0) {
    std::memcpy(mark.sample.data(), vertices[0].data(), 3 * sizeof(double));
    std::memcpy(&mark.sample[3], vertices[num_vertices / 2].data(), 3 * sizeof(double));
  }
  return mark;
}

// Vertices as the spool has them.
template <typename Vector> std::vector<double> coordinates(const Vector *vertices, std::size_t count) {
  std::vector<double> all;
  all.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    all.insert(all.end(), vertices[i].data(), vertices[i].data() + 3);
  return all;
}

// The number of a mesh or a convex body; `read` gives its triangles where it is not known.
Known model(Spool &spool, const void *geometry, const Mark &mark, bool convex, const std::function<Triangles()> &read,
            std::uint32_t library);
// The number of a primitive, see `Spool::primitive`.
Known primitive(Spool &spool, const char *kind, std::initializer_list<double> sizes, std::uint32_t library);

// A pose as the spool has it.
Matrix matrix(const auto &rotation, const auto &translation) {
  Matrix rows;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      rows[4 * i + k] = rotation(i, k);
    rows[4 * i + 3] = translation[i];
  }
  return rows;
}

// Two geometries and where they are.
template <typename Geometry, typename Pose> struct PairOf {
  const Geometry *geometries[2];
  const Pose *poses[2];
};

// The query about a pair without its answer; a convex body hides the answers where it collides. `at` gives the matrix of a pose.
Query about(Spool &spool, std::uint32_t library, const auto &pair, bool &convex, const auto &at) {
  Query query;
  query.library = library;
  for (int i = 0; i < 2; ++i) {
    const auto [object, is_convex] = describe(spool, *pair.geometries[i], library);
    query.objects[i] = object, query.poses[i] = at(*pair.poses[i]);
    convex = convex || is_convex;
  }
  return query;
}

// What a call tells that was to find at most so many contacts: a result that already had contacts, or may have none, does not tell
// whether these two collide, and a convex body hides that they do.
inline std::uint32_t hit_told(std::size_t before, std::size_t after, std::size_t most, bool convex) {
  const bool more = after > before;
  const bool told = more || (before == 0 && most > 0);
  return !told || (convex && more) ? NONE : more ? ANSWERED | HIT : ANSWERED;
}

// What a distance tells: a result that already had a smaller one keeps it. `none` is what the library gives where it has no answer.
inline std::uint32_t distance_told(double before, double distance, double none, bool convex) {
  const bool told = distance < none && (before == none || distance < before);
  return told && !(convex && distance <= 0) ? MEASURED : NONE;
}

} // namespace ocb::record
