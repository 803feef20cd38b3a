// The C functions for programs that record themselves.
#include <opencollbench/record.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>

#include "spool.hpp"

using namespace ocb::record;

struct ocb_recording {
  std::mutex mutex;
  // Nothing after a file could not be written.
  std::unique_ptr<Spool> spool;
  std::uint32_t library;
};

namespace {

// A spool has no limit when the program chooses its queries itself.
constexpr std::uint64_t NO_LIMIT = ~std::uint64_t{0};

// What `act` gives on the spool, or `otherwise` when it fails.
auto with(ocb_recording *recording, auto otherwise, const auto &act) noexcept {
  if (!recording)
    return otherwise;
  const std::lock_guard lock(recording->mutex);
  try {
    if (recording->spool)
      return act(*recording->spool);
  } catch (const std::runtime_error &) {
    // The disk is full: a row or a line may be there in part, and another behind it could not be read.
    recording->spool.reset();
  } catch (...) {
    // Memory is full, or it cannot be recorded.
  }
  return otherwise;
}

// The reason why a query is none; nothing for one that is.
const char *fault(const ocb_query &query) {
  if (query.objects[0] < 0 || query.objects[1] < 0)
    return "an object was not recorded";
  if (query.kind < OCB_COLLIDE || query.kind > OCB_TOLERANCE)
    return "the kind of query is unknown";
  for (const auto &pose : query.poses)
    if (!std::all_of(std::begin(pose), std::end(pose), [](double x) { return std::isfinite(x); }))
      return "a pose is not finite";
  return std::isfinite(query.limit) ? nullptr : "the limit of a query is not finite";
}

} // namespace

#define OCB_PUBLIC __attribute__((visibility("default")))

OCB_PUBLIC ocb_recording *ocb_recording_open(const char *folder, const char *program, const char *library, const char *version) {
  try {
    auto recording = std::make_unique<ocb_recording>();
    recording->spool = std::make_unique<Spool>(folder, program, "opencollbench/record.h", NO_LIMIT);
    recording->library = recording->spool->library(library, version);
    return recording.release();
  } catch (...) {
    return nullptr;
  }
}

OCB_PUBLIC std::int32_t ocb_recording_mesh(ocb_recording *recording, const char *name, const double *vertices, std::size_t num_vertices,
                                           const std::uint32_t *corners, std::size_t num_triangles) {
  return with(recording, std::int32_t{-1}, [&](Spool &spool) {
    const Triangles mesh{{vertices, vertices + 3 * num_vertices}, {corners, corners + 3 * num_triangles}};
    return static_cast<std::int32_t>(spool.mesh(name, mesh, "", recording->library));
  });
}

OCB_PUBLIC std::int32_t ocb_recording_primitive(ocb_recording *recording, ocb_primitive kind, const double *sizes) {
  static constexpr struct {
    const char *name;
    int sizes;
  } KINDS[] = {{"box", 3}, {"sphere", 1}, {"cylinder", 2}, {"capsule", 2}};
  if (kind < OCB_BOX || kind > OCB_CAPSULE)
    return -1;
  return with(recording, std::int32_t{-1}, [&](Spool &spool) {
    const auto &[name, count] = KINDS[kind];
    return static_cast<std::int32_t>(spool.primitive(name, {sizes, sizes + count}, recording->library));
  });
}

OCB_PUBLIC int ocb_recording_query(ocb_recording *recording, const ocb_query *query) {
  return with(recording, -1, [&](Spool &spool) {
    spool.keeps(query->group);
    if (const char *reason = fault(*query)) {
      spool.drop(reason);
      return -1;
    }
    Query row;
    row.group = query->group, row.kind = query->kind, row.bits = query->answered;
    row.limit = query->limit, row.distance = query->distance, row.seconds = query->seconds, row.library = recording->library;
    for (int i = 0; i < 2; ++i) {
      row.objects[i] = static_cast<std::uint32_t>(query->objects[i]);
      std::copy(std::begin(query->poses[i]), std::end(query->poses[i]), row.poses[i].begin());
    }
    spool.add(row);
    return 0;
  });
}

OCB_PUBLIC void ocb_recording_close(ocb_recording *recording) {
  with(recording, 0, [](Spool &spool) {
    spool.note();
    return 0;
  });
  delete recording;
}
