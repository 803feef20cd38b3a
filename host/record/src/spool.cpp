#include "spool.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

#include "sha256.hpp"

namespace ocb::record {
namespace {

// Bounds of a spool: objects, and bytes of their meshes.
constexpr std::size_t MOST_OBJECTS = 20'000;
constexpr std::uint64_t MOST_MESH_BYTES = std::uint64_t{4} << 30;
// Largest coordinate of a mesh, smallest and largest length of a primitive.
constexpr double LARGEST = 1e18, SMALLEST = 1e-100;
// Seconds between two notes of how many queries were dropped for known reasons.
constexpr double NOTED = 0.2;

std::uint64_t spools = 0;

[[noreturn]] void failed(const std::string &path) { throw std::runtime_error(path + ": " + std::strerror(errno)); }

std::string json(const std::string &text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  }
  return quoted + '"';
}

// The shortest text that gives the number back, in every locale.
std::string json(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

void write_all(int file, const void *bytes, std::size_t count, const std::string &path) {
  auto *at = static_cast<const char *>(bytes);
  while (count > 0) {
    const ssize_t written = ::write(file, at, count);
    if (written < 0 && errno != EINTR)
      failed(path);
    if (written > 0)
      at += written, count -= static_cast<std::size_t>(written);
  }
}

// A file is there as a whole or not at all.
void write_whole(const std::string &path, const void *bytes, std::size_t count) {
  const std::string part = path + ".new";
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0)
    failed(part);
  try {
    write_all(file, bytes, count, part);
  } catch (...) {
    ::close(file);
    throw;
  }
  ::close(file);
  if (::rename(part.c_str(), path.c_str()) != 0)
    failed(path);
}

template <typename T> void put(std::string &bytes, const T &value) { bytes.append(reinterpret_cast<const char *>(&value), sizeof value); }

// A mesh as binary PLY; throws `Unusable` if it is not one.
std::string ply(const Triangles &mesh) {
  const std::size_t vertices = mesh.vertices.size() / 3, triangles = mesh.corners.size() / 3;
  if (triangles == 0)
    throw Unusable{"a mesh has no triangles"};
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](double x) { return std::abs(x) <= LARGEST; }))
    throw Unusable{"a mesh has a coordinate that is not a number, or too large"};
  if (std::any_of(mesh.corners.begin(), mesh.corners.end(), [&](std::uint32_t i) { return i >= vertices; }))
    throw Unusable{"a triangle of a mesh names a vertex that does not exist"};
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(triangles) +
                      "\nproperty list uchar uint vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + 24 * vertices + 13 * triangles);
  bytes.append(reinterpret_cast<const char *>(mesh.vertices.data()), 24 * vertices);
  bool area = false;
  for (std::size_t t = 0; t < triangles; ++t) {
    bytes += '\3';
    const double *p[3];
    for (int k = 0; k < 3; ++k) {
      put(bytes, mesh.corners[3 * t + k]);
      p[k] = &mesh.vertices[3 * mesh.corners[3 * t + k]];
    }
    for (int k = 0; k < 3 && !area; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      area = (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) != (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
    }
  }
  if (!area)
    throw Unusable{"every triangle of a mesh has zero area"};
  return bytes;
}

double now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

Spool::Spool(std::string folder, const std::string &program, const std::string &recorder, std::uint64_t limit)
    : serial(++spools), folder_(std::move(folder)), limit_(std::max<std::uint64_t>(1, limit)) {
  for (const auto &path : {folder_, folder_ + "/objects"})
    if (::mkdir(path.c_str(), 0755) != 0)
      failed(path);
  const std::string head = "{\"format\": \"opencollbench-spool/1\", \"program\": " + json(program) + ", \"recorder\": " + json(recorder) + "}\n";
  write_whole(folder_ + "/about.json", head.data(), head.size());
  open_queries();
}

Spool::~Spool() { ::close(queries_); }

void Spool::open_queries() {
  const std::string path = folder_ + "/queries.bin";
  queries_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (queries_ < 0)
    failed(path);
}

std::uint32_t Spool::library(const std::string &name, const std::string &version) {
  const std::pair library{name, version};
  const auto at = static_cast<std::size_t>(std::find(libraries_.begin(), libraries_.end(), library) - libraries_.begin());
  if (at == libraries_.size())
    libraries_.push_back(library);
  return static_cast<std::uint32_t>(at);
}

std::uint32_t Spool::mesh(const std::string &name, const Triangles &mesh, const std::string &source, std::uint32_t library) {
  const std::string bytes = ply(mesh);
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  const std::string sha256 = hash.hex();
  if (!meshes_.contains(sha256)) {
    if (mesh_bytes_ + bytes.size() > MOST_MESH_BYTES)
      throw Unusable{"the meshes have more than 4 GiB"};
    write_whole(folder_ + "/objects/" + sha256 + ".ply", bytes.data(), bytes.size());
    mesh_bytes_ += bytes.size();
    meshes_.insert(sha256);
  }
  return object(name, "{\"kind\": \"mesh\", \"sha256\": \"" + sha256 + "\"}", source, library);
}

std::uint32_t Spool::primitive(const std::string &kind, const std::vector<double> &sizes, std::uint32_t library) {
  for (std::size_t i = 0; i < sizes.size(); ++i)
    // A capsule may be a ball: it has a radius, and no length.
    if (!(sizes[i] >= SMALLEST && sizes[i] <= LARGEST) && !(sizes[i] == 0 && kind == "capsule" && i == 1))
      throw Unusable{"a " + kind + " has a length that cannot be computed with"};
  std::string geometry = "{\"kind\": \"" + kind + "\", ";
  if (kind == "box")
    geometry += "\"size\": [" + json(sizes.at(0)) + ", " + json(sizes.at(1)) + ", " + json(sizes.at(2)) + "]}";
  else if (kind == "sphere")
    geometry += "\"radius\": " + json(sizes.at(0)) + "}";
  else
    geometry += "\"radius\": " + json(sizes.at(0)) + ", \"length\": " + json(sizes.at(1)) + "}";
  return object(kind, geometry, "", library);
}

std::uint32_t Spool::object(const std::string &name, const std::string &geometry, const std::string &source, std::uint32_t library) {
  const auto &[library_name, version] = libraries_.at(library);
  const std::string rest = "\"name\": " + json(name) + ", \"geometry\": " + geometry + ", \"source\": " + json(source) +
                           ", \"library\": " + json(library_name) + ", \"version\": " + json(version) + "}\n";
  if (const auto known = objects_.find(rest); known != objects_.end())
    return known->second;
  if (objects_.size() >= MOST_OBJECTS)
    throw Unusable{"an object is beyond the first " + std::to_string(MOST_OBJECTS)};
  const auto id = static_cast<std::uint32_t>(objects_.size());
  append("objects.jsonl", "{\"id\": " + std::to_string(id) + ", " + rest);
  objects_.emplace(rest, id);
  return id;
}

bool Spool::keeps(std::uint64_t group) {
  ++seen_;
  if (group % every_ == 0)
    return true;
  drop("sampled");
  return false;
}

void Spool::add(Query query) {
  if (rows_ >= limit_) {
    thin();
    if (query.group % every_ != 0)
      return drop("sampled");
    if (rows_ >= limit_)
      return drop("a group has more queries than the limit");
  }
  query.sequence = seen_ - 1;
  write_all(queries_, &query, sizeof query, folder_ + "/queries.bin");
  ++rows_;
}

void Spool::drop(const std::string &reason) {
  const bool first = ++dropped_[reason] == 1;
  if (const double time = now(); first || time - noted_ > NOTED) {
    noted_ = time;
    note();
  }
}

void Spool::note() {
  std::string lines;
  for (const auto &[reason, count] : dropped_)
    lines += "{\"reason\": " + json(reason) + ", \"count\": " + std::to_string(count) + "}\n";
  write_whole(folder_ + "/dropped.jsonl", lines.data(), lines.size());
}

// Keeps the queries of every second group of those that are kept.
void Spool::thin() {
  const std::string path = folder_ + "/queries.bin";
  std::vector<Query> rows(rows_);
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto bytes = static_cast<ssize_t>(rows.size() * sizeof(Query));
  const bool whole = file >= 0 && ::read(file, rows.data(), static_cast<std::size_t>(bytes)) == bytes;
  ::close(file);
  if (!whole)
    failed(path);
  const auto several = [&] { return std::any_of(rows.begin(), rows.end(), [&](const Query &row) { return row.group != rows[0].group; }); };
  while (rows.size() > limit_ / 2 && several()) {
    every_ *= 2;
    std::erase_if(rows, [&](const Query &row) { return row.group % every_ != 0; });
  }
  if (rows.size() == rows_)
    return;
  write_whole(path, rows.data(), rows.size() * sizeof(Query));
  ::close(queries_);
  open_queries();
  dropped_["sampled"] += rows_ - rows.size();
  rows_ = rows.size();
  note();
}

void Spool::append(const std::string &name, const std::string &text) {
  const std::string path = folder_ + "/" + name;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0)
    failed(path);
  write_all(file, text.data(), text.size(), path);
  ::close(file);
}

} // namespace ocb::record
