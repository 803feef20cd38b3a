// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A plugin in C++: every triangle of A against every triangle of B. Correct, and slow. Replace what `load` returns and
// `collide` by your own, and `about` by your name; see opencollbench/plugin.hpp for what else a plugin can answer.
#include <opencollbench/plugin.hpp>

#include <algorithm>

using ocb::Triangle, ocb::Vector;

static Vector operator-(const Vector &a, const Vector &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
static double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Whether a plane orthogonal to `axis` has all of a on one side and all of b on the other.
static bool separates(const Vector &axis, const Triangle &a, const Triangle &b) {
    const auto in = [&](const Triangle &t) {
        return std::minmax({dot(axis, t[0] - b[0]), dot(axis, t[1] - b[0]), dot(axis, t[2] - b[0])});
    };
    const std::pair<double, double> in_a = in(a), in_b = in(b);
    return in_a.second < in_b.first || in_b.second < in_a.first;
}

// Two triangles are apart if one of these directions separates them: their normals, the products of an edge of each, the
// normals of the edges in their planes, and, for triangles without area, two made of the line between their first corners.
static bool meet(const Triangle &a, const Triangle &b) {
    const Triangle edges_a = {a[1] - a[0], a[2] - a[1], a[0] - a[2]}, edges_b = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const Vector normal_a = cross(edges_a[0], edges_a[1]), normal_b = cross(edges_b[0], edges_b[1]), between = b[0] - a[0];
    std::vector<Vector> axes = {normal_a, normal_b, between};
    for (const Triangle &edges : {edges_a, edges_b})
        for (const Vector &e : edges)
            axes.insert(axes.end(), {cross(normal_a, e), cross(normal_b, e), cross(cross(e, between), e)});
    for (const Vector &e : edges_a)
        for (const Vector &f : edges_b) axes.push_back(cross(e, f));
    return std::none_of(axes.begin(), axes.end(), [&](const Vector &axis) { return separates(axis, a, b); });
}

struct MyAlgorithm {
    static ocb::About about() { return {"my-algorithm-cpp", "My algorithm", "0.1.0", "Me", "MIT OR Apache-2.0"}; }

    std::vector<Triangle> load(const ocb::Mesh &mesh) {
        std::vector<Triangle> triangles;
        for (uint32_t i = 0; i < mesh.triangle_count; i++) triangles.push_back(mesh.triangle(i));
        return triangles;
    }

    using Object = ocb::Placed<std::vector<Triangle>>;
    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        for (uint32_t i = 0; i < a.object.size(); i++)
            for (uint32_t j = 0; j < b.object.size(); j++)
                if (meet(a.pose(a.object[i]), b.pose(b.object[j]))) return ocb::Collision::pair(i, j);
        return {};
    }
};

OCB_PLUGIN(MyAlgorithm)
