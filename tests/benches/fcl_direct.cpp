// FCL called directly: what a query costs without interface and jail (Debian libfcl-dev; OBBRSS, double).
//
// fcl_direct MESH POSES: MESH holds u64 vertices, u64 triangles, f64 x y z each, u32 corners each; POSES f64 matrices, row-major,
// that place B. On stdin, per block: u64 question (0 collision, 1 distance), u64 first pose, u64 count; it answers with f64
// nanoseconds each. Development only: nothing that is shipped links FCL.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

template <class T> static bool get(std::FILE *f, T *to, std::size_t n) { return std::fread(to, sizeof(T), n, f) == n; }

int main(int argc, char **argv) {
  std::FILE *file = argc == 3 ? std::fopen(argv[1], "rb") : nullptr, *poses = argc == 3 ? std::fopen(argv[2], "rb") : nullptr;
  std::uint64_t counts[2];
  if (!file || !poses || !get(file, counts, 2)) return 2;
  std::vector<double> x(3 * counts[0]);
  std::vector<std::uint32_t> t(3 * counts[1]);
  if (!get(file, x.data(), x.size()) || !get(file, t.data(), t.size())) return 2;
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < counts[0]; i++) vertices.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  for (std::size_t i = 0; i < counts[1]; i++) triangles.emplace_back(t[3 * i], t[3 * i + 1], t[3 * i + 2]);
  fcl::BVHModel<fcl::OBBRSSd> model;
  model.beginModel();
  model.addSubModel(vertices, triangles);
  model.endModel();
  std::vector<double> all;
  for (double m[16]; get(poses, m, 16);) all.insert(all.end(), m, m + 16);

  std::uint64_t block[3];
  while (get(stdin, block, 3)) {
    std::vector<double> took;
    for (std::uint64_t i = block[1]; i < block[1] + block[2]; i++) {
      const auto start = std::chrono::steady_clock::now();
      fcl::Transform3d still = fcl::Transform3d::Identity(), moved = fcl::Transform3d::Identity();
      const double *m = &all[16 * i];
      for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) moved.linear()(row, column) = m[4 * row + column];
        moved.translation()(row) = m[4 * row + 3];
      }
      if (block[0] == 0) {
        fcl::CollisionResultd result;
        fcl::collide(&model, still, &model, moved, fcl::CollisionRequestd(1, false), result);
      } else {
        fcl::DistanceResultd result;
        fcl::distance(&model, still, &model, moved, fcl::DistanceRequestd(true, false, 0, 0), result);
      }
      took.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
    }
    std::fwrite(took.data(), sizeof(double), took.size(), stdout);
    std::fflush(stdout);
  }
}
