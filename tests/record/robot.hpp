// What the programs that are recorded have in common: numbers that are the same each time, two threads, a child process.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

inline double draw(double low, double high) {
  static std::mt19937 random_numbers(7);
  return std::uniform_real_distribution<double>(low, high)(random_numbers);
}

// A closed ring of n pieces with a square cross-section, put into this model.
template <typename Vector, typename Triangle, typename Model> void make_ring(Model &model, std::size_t n) {
  std::vector<Vector> vertices;
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
      const double r = k == 0 || k == 3 ? 0.75 : 1.25, z = k < 2 ? -0.25 : 0.25;
      vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
      const auto at = [&](std::size_t piece, std::size_t corner) { return (i + piece) % n * 4 + (k + corner) % 4; };
      triangles.emplace_back(at(0, 0), at(0, 1), at(1, 0));
      triangles.emplace_back(at(0, 1), at(1, 1), at(1, 0));
    }
  model.beginModel();
  model.addSubModel(vertices, triangles);
  model.endModel();
}

// Two threads ask so many times each, then a child process once; `ask` is told which thread it is, the child is the third.
template <typename Ask> int end_with_threads_and_a_child(int rounds, const Ask &ask) {
  bool met[2] = {};
  std::thread threads[2];
  for (int t = 0; t < 2; ++t)
    threads[t] = std::thread([&, t] {
      for (int i = 0; i < rounds; ++i)
        met[t] = ask(t);
    });
  for (auto &thread : threads)
    thread.join();
  std::printf("threads %d %d\n", met[0], met[1]);
  std::fflush(stdout);

  const pid_t child = ::fork();
  if (child == 0) {
    std::printf("child %d\n", ask(2));
    return 0;
  }
  ::waitpid(child, nullptr, 0);
  return 3;
}
