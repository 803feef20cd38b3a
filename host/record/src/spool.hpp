// Writes a spool: a folder that only grows, which `ocb record` makes a recording of (host/README.md, "Recordings").
//
// It can be read at any moment, also after the program was killed: each query is one write of one row, meshes get their name when
// they are whole, and text files are read up to their last whole line.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ocb::record {

// What a query asks, by its number in the spool.
enum Kind : std::uint32_t { COLLIDE, CONTACTS, DISTANCE, TOLERANCE };
// Bits of an answer.
enum Answer : std::uint32_t { NONE = 0, ANSWERED = 1, HIT = 2, MEASURED = 4 };

// A rotation and a translation: the upper three rows of the 4x4 matrix, row-major.
using Matrix = std::array<double, 12>;

// A row of the spool.
struct Query {
  std::uint64_t sequence = 0, group = 0;
  std::uint32_t objects[2] = {};
  Matrix poses[2] = {};
  std::uint32_t kind = COLLIDE, bits = NONE;
  double limit = 0, distance = 0, seconds = 0;
  std::uint32_t library = 0, unused = 0;
};
static_assert(sizeof(Query) == 256);

// A query that cannot be recorded, with the reason under which it is counted.
struct Unusable {
  std::string reason;
};

// The triangles of an object; every triangle has three corners.
struct Triangles {
  std::vector<double> vertices;
  std::vector<std::uint32_t> corners;
};

// The spool in one folder, for one thread at a time. At most `limit` queries are kept: of more, every second, fourth, ... whole
// group. Throws `std::runtime_error` when the folder cannot be made or written.
class Spool {
public:
  Spool(std::string folder, const std::string &program, const std::string &recorder, std::uint64_t limit);
  ~Spool();
  Spool(const Spool &) = delete;
  Spool &operator=(const Spool &) = delete;

  // Another number for each spool of this process and of those that it forked.
  const std::uint64_t serial;

  // The number of a library in rows.
  std::uint32_t library(const std::string &name, const std::string &version);
  // The number of an object; equal objects of one library are one object. Throws `Unusable`.
  std::uint32_t mesh(const std::string &name, const Triangles &mesh, const std::string &source, std::uint32_t library);
  // The kinds of primitives are "box" (three edges), "sphere" (radius), "cylinder" and "capsule" (radius, length).
  std::uint32_t primitive(const std::string &kind, const std::vector<double> &sizes, std::uint32_t library);

  // Are the queries of this group recorded? Counts the query.
  bool keeps(std::uint64_t group);
  // Adds the query that was counted last.
  void add(Query query);
  // Counts a query that is not recorded.
  void drop(const std::string &reason);
  // Writes down how many queries were dropped.
  void note();

private:
  std::uint32_t object(const std::string &name, const std::string &geometry, const std::string &source, std::uint32_t library);
  void thin();
  void append(const std::string &name, const std::string &text);
  void open_queries();

  std::string folder_;
  std::uint64_t limit_, every_ = 1, seen_ = 0, rows_ = 0, mesh_bytes_ = 0;
  int queries_ = -1;
  double noted_ = 0;
  std::vector<std::pair<std::string, std::string>> libraries_;
  std::map<std::string, std::uint32_t> objects_;
  std::set<std::string> meshes_;
  std::map<std::string, std::uint64_t> dropped_;
};

} // namespace ocb::record
