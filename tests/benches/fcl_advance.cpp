// Conservative advancement on FCL's distance (Debian libfcl-dev; OBBRSS, double): the peer of the position search.
//
// fcl_advance MESH: MESH holds u64 vertices, u64 triangles, f64 x y z each, u32 corners each. On stdin, per ray: u64 1, then
// f64 rotation[9] from[3] direction[3] wanted tolerance length; u64 0 ends. Per ray it answers with f64 nanoseconds, f64
// queries, f64 way (NaN for none). Development only: nothing that is shipped links FCL.
#include <fcl/fcl.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

template <class T> static bool get(std::FILE *f, T *to, std::size_t n) { return std::fread(to, sizeof(T), n, f) == n; }

int main(int argc, char **argv) {
  std::FILE *file = argc == 2 ? std::fopen(argv[1], "rb") : nullptr;
  std::uint64_t counts[2];
  if (!file || !get(file, counts, 2)) return 2;
  std::vector<double> x(3 * counts[0]);
  std::vector<std::uint32_t> t(3 * counts[1]);
  if (!get(file, x.data(), x.size()) || !get(file, t.data(), t.size())) return 2;
  using Model = fcl::BVHModel<fcl::OBBRSSd>;
  auto model = std::make_shared<Model>();
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (std::size_t i = 0; i < counts[0]; i++) vertices.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  for (std::size_t i = 0; i < counts[1]; i++) triangles.emplace_back(t[3 * i], t[3 * i + 1], t[3 * i + 2]);
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();

  std::uint64_t more;
  double ray[18];
  while (get(stdin, &more, 1) && more == 1 && get(stdin, ray, 18)) {
    const double wanted = ray[15], tolerance = ray[16], length = ray[17];
    fcl::Transform3d still = fcl::Transform3d::Identity(), moved = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++) moved.linear()(i, k) = ray[3 * i + k];
    const fcl::Vector3d from(ray[9], ray[10], ray[11]), direction(ray[12], ray[13], ray[14]);
    double way = 0, queries = 0, found = NAN;
    const auto start = std::chrono::steady_clock::now();
    for (; queries < 2000; queries++) {
      moved.translation() = from - direction * way;
      fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      const double distance = fcl::distance(model.get(), still, model.get(), moved, request, result);
      if (std::fabs(distance - wanted) <= tolerance) {
        found = way;
        break;
      }
      way += distance - wanted;
      if (way > length) break;
    }
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    const double answer[3] = {took.count(), queries + 1, found};
    std::fwrite(answer, sizeof(double), 3, stdout);
    std::fflush(stdout);
  }
  return 0;
}
