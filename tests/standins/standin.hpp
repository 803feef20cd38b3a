// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What the stand-ins share: each has the published interface of a library that may not be shipped, and compares every
// triangle with every other behind it. So wrappers are known to compile, to link and to place objects as they are told.
#pragma once

#include <triangles.hpp>

#include <cmath>
#include <functional>

namespace standin {

struct Numbered {
    ocb::Triangle triangle;
    int id;
};

struct Soup {
    std::vector<Numbered> all;

    template <class Real> void add(const Real *p, const Real *q, const Real *r, int id) {
        all.push_back({{{{p[0], p[1], p[2]}, {q[0], q[1], q[2]}, {r[0], r[1], r[2]}}}, id});
    }
};

// A row-major 4x4 matrix.
struct Matrix {
    double m[16];

    template <class Real> static Matrix of(const Real rotation[3][3], const Real translation[3]) {
        Matrix matrix{};
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) matrix.m[4 * row + column] = rotation[row][column];
            matrix.m[4 * row + 3] = translation[row];
        }
        matrix.m[15] = 1;
        return matrix;
    }
    ocb::Triangle operator()(const Numbered &n) const { return ocb::Pose{m}(n.triangle); }
};

// Calls `met` with the ids of all pairs that meet, until it says false. Returns how many pairs were tested.
inline int meetings(const Soup &a, const Matrix &at_a, const Soup &b, const Matrix &at_b,
                    const std::function<bool(int, int)> &met) {
    int tests = 0;
    for (const Numbered &i : a.all)
        for (const Numbered &j : b.all) {
            tests++;
            if (ocb::meet(at_a(i), at_b(j)) && !met(i.id, j.id)) return tests;
        }
    return tests;
}

struct Nearest {
    double distance;
    // In the objects' own frames, and in the world.
    ocb::Vector own_a, own_b, world_a, world_b;
};

// The nearest two corners: enough to see which numbers go where.
inline Nearest nearest_corners(const Soup &a, const Matrix &at_a, const Soup &b, const Matrix &at_b) {
    Nearest best{1e300, {}, {}, {}, {}};
    for (const Numbered &i : a.all)
        for (const Numbered &j : b.all)
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++) {
                    using ocb::operator-;
                    const ocb::Vector p = at_a(i)[k], q = at_b(j)[l], between = p - q;
                    const double distance = std::sqrt(ocb::dot(between, between));
                    if (distance < best.distance) best = {distance, i.triangle[k], j.triangle[l], p, q};
                }
    return best;
}

} // namespace standin
