#include "described.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_map>

namespace ocb::record {
namespace {

struct Model {
  Mark mark;
  std::uint32_t object;
};

// Models by their address, primitives by their kind and lengths.
struct Described {
  std::uint64_t spool = 0;
  std::unordered_map<const void *, Model> models;
  std::map<std::pair<std::string_view, std::array<double, 3>>, std::uint32_t> primitives;
};

Described &described(const Spool &spool) {
  static Described &of_process = *new Described;
  if (of_process.spool != spool.serial)
    of_process = Described{spool.serial, {}, {}};
  return of_process;
}

} // namespace

Known model(Spool &spool, const void *geometry, const Mark &mark, bool convex, const std::function<Triangles()> &read,
            std::uint32_t library) {
  auto &models = described(spool).models;
  if (const auto found = models.find(geometry); found != models.end() && found->second.mark == mark)
    return {found->second.object, convex};
  const Triangles triangles = read();
  const std::string name = (convex ? "convex body of " : "mesh of ") + std::to_string(triangles.corners.size() / 3) + " triangles";
  const char *source = convex ? "its surface; the program's answers where it collides are left out" : "";
  const std::uint32_t object = spool.mesh(name, triangles, source, library);
  models.insert_or_assign(geometry, Model{mark, object});
  return {object, convex};
}

Known primitive(Spool &spool, const char *kind, std::initializer_list<double> sizes, std::uint32_t library) {
  std::array<double, 3> lengths{};
  std::copy(sizes.begin(), sizes.end(), lengths.begin());
  auto &primitives = described(spool).primitives;
  if (const auto found = primitives.find({kind, lengths}); found != primitives.end())
    return {found->second, false};
  const std::uint32_t object = spool.primitive(kind, sizes, library);
  primitives.emplace(std::pair{kind, lengths}, object);
  return {object, false};
}

} // namespace ocb::record
