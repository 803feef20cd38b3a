// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Do two triangles meet? For libraries that leave this to their user.
#pragma once

#include <opencollbench/plugin.hpp>

namespace ocb {

inline Vector operator-(const Vector &a, const Vector &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Whether a plane orthogonal to `axis` has all of a on one side and all of b on the other.
inline bool separates(const Vector &axis, const Triangle &a, const Triangle &b) {
    const auto along = [&](const Triangle &t) {
        return std::minmax({dot(axis, t[0] - b[0]), dot(axis, t[1] - b[0]), dot(axis, t[2] - b[0])});
    };
    const std::pair<double, double> of_a = along(a), of_b = along(b);
    return of_a.second < of_b.first || of_b.second < of_a.first;
}

// Closed triangles, in double precision: two convex sets are apart if and only if some direction separates them, and for
// two triangles these directions are enough: the normals, the products of an edge of each, the normals of the edges in
// their planes, and, for triangles without area, two made of the line between the first corners.
inline bool meet(const Triangle &a, const Triangle &b) {
    const Vector between = b[0] - a[0];
    const Triangle edges_a = {a[1] - a[0], a[2] - a[1], a[0] - a[2]}, edges_b = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const Vector normal_a = cross(edges_a[0], edges_a[1]), normal_b = cross(edges_b[0], edges_b[1]);
    if (separates(normal_a, a, b) || separates(normal_b, a, b) || separates(between, a, b)) return false;
    for (const Vector &e : edges_a)
        for (const Vector &f : edges_b)
            if (separates(cross(e, f), a, b)) return false;
    for (const Triangle &edges : {edges_a, edges_b})
        for (const Vector &e : edges)
            if (separates(cross(normal_a, e), a, b) || separates(cross(normal_b, e), a, b) ||
                separates(cross(cross(e, between), e), a, b))
                return false;
    return true;
}

} // namespace ocb
