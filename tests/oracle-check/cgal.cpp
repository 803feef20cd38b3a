// A second opinion for the oracle, by CGAL's exact kernel. Development only: nothing of the product is linked with it.
// (CGAL's kernel is LGPL, its distances between triangles too; this program of ours stays MIT OR Apache-2.0.)
//
// Reads pairs of triangles, one a line, as 42 numbers (decimal or C99 hexadecimal; taken exactly): nine coordinates of A,
// nine of B, then the 3x4 matrices of A and of B, row by row. Writes one line for each: 1 when the closed triangles meet
// and 0 otherwise, and the exact squared distance as a fraction. CGAL forbids triangles without area.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;

constexpr int numbers_per_pair = 42;

Point mapped(const double *matrix, const double *p) {
  auto row = [&](int i) -> Number {
    const double *m = matrix + 4 * i;
    return Number(m[0]) * Number(p[0]) + Number(m[1]) * Number(p[1]) + Number(m[2]) * Number(p[2]) + Number(m[3]);
  };
  return {row(0), row(1), row(2)};
}

Triangle mapped_triangle(const double *matrix, const double *corners) {
  return {mapped(matrix, corners), mapped(matrix, corners + 3), mapped(matrix, corners + 6)};
}

int main() {
  std::ios::sync_with_stdio(false);
  std::string line;
  for (long number = 1; std::getline(std::cin, line); ++number) {
    std::array<double, numbers_per_pair> n;
    const char *at = line.c_str();
    for (double &x : n) {
      char *end;
      x = std::strtod(at, &end);
      if (end == at) {
        std::cerr << "line " << number << ": fewer than " << numbers_per_pair << " numbers\n";
        return 2;
      }
      at = end;
    }
    Triangle a = mapped_triangle(&n[18], &n[0]), b = mapped_triangle(&n[30], &n[9]);
    if (a.is_degenerate() || b.is_degenerate()) {
      std::cerr << "line " << number << ": a triangle has no area\n";
      return 2;
    }
    std::cout << CGAL::do_intersect(a, b) << ' ' << CGAL::squared_distance(a, b).exact() << '\n';
  }
}
