// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A plugin in C++: every triangle of A against every triangle of B. Correct, and slow.
//
// Replace `Object`, its constructor and `Object::meets` by your own, and the descriptor at the end by your name. The rest
// of the interface (distances, all contacts, counters, parameters) is optional: see opencollbench/ext/.
#include <opencollbench/plugin.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <vector>

namespace {

using Vector = std::array<double, 3>;
using Triangle = std::array<Vector, 3>;

Vector operator-(const Vector &a, const Vector &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector &a, const Vector &b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// From the object's frame to the world. `m` is a row-major 4x4 matrix.
Triangle place(const double *m, const Triangle &t) {
    Triangle placed;
    for (int k = 0; k < 3; k++)
        for (int row = 0; row < 3; row++)
            placed[k][row] = m[4 * row] * t[k][0] + m[4 * row + 1] * t[k][1] + m[4 * row + 2] * t[k][2] + m[4 * row + 3];
    return placed;
}

// Whether a plane orthogonal to `axis` has all of a on one side and all of b on the other.
bool separates(const Vector &axis, const Triangle &a, const Triangle &b) {
    const Vector origin = b[0];
    const auto in = [&](const Triangle &t) {
        return std::minmax({dot(axis, t[0] - origin), dot(axis, t[1] - origin), dot(axis, t[2] - origin)});
    };
    const std::pair<double, double> in_a = in(a), in_b = in(b);
    return in_a.second < in_b.first || in_b.second < in_a.first;
}

// Two convex sets are apart if and only if some direction separates them. For two triangles it is enough to try their
// normals, the products of an edge of each, and, when they lie in one plane, the normals of the edges in that plane. The
// directions made of `between` are for triangles without area, which are segments or points. Touching triangles meet.
bool meet(const Triangle &a, const Triangle &b) {
    const Vector between = b[0] - a[0];
    const Triangle edges_a = {a[1] - a[0], a[2] - a[1], a[0] - a[2]}, edges_b = {b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const Vector normal_a = cross(edges_a[0], edges_a[1]), normal_b = cross(edges_b[0], edges_b[1]);
    if (separates(normal_a, a, b) || separates(normal_b, a, b) || separates(between, a, b)) return false;
    for (const Triangle &edges : {edges_a, edges_b})
        for (const Vector &e : edges) {
            const Vector beside = cross(cross(e, between), e);
            if (separates(cross(normal_a, e), a, b) || separates(cross(normal_b, e), a, b)) return false;
            if (separates(beside, a, b)) return false;
        }
    for (const Vector &e : edges_a)
        for (const Vector &f : edges_b)
            if (separates(cross(e, f), a, b)) return false;
    return true;
}

// Your data structure, made from one mesh.
struct Object {
    std::vector<Triangle> triangles;

    Object(const double *positions, const uint32_t *corners, uint32_t triangle_count) {
        triangles.reserve(triangle_count);
        for (uint32_t i = 0; i < triangle_count; i++) {
            Triangle t;
            for (int k = 0; k < 3; k++) {
                const double *p = positions + 3 * static_cast<size_t>(corners[3 * static_cast<size_t>(i) + k]);
                t[k] = {p[0], p[1], p[2]};
            }
            triangles.push_back(t);
        }
    }

    void meets(const double *pose, const Object &other, const double *other_pose, ocb_collide_result &result) const {
        for (uint32_t i = 0; i < triangles.size(); i++) {
            const Triangle mine = place(pose, triangles[i]);
            for (uint32_t j = 0; j < other.triangles.size(); j++)
                if (meet(mine, place(other_pose, other.triangles[j]))) {
                    result.hit = 1;
                    result.triangle_a = i;
                    result.triangle_b = j;
                    return;
                }
        }
        result.hit = 0;
    }
};

// What the C side calls. No exception may leave these functions.

std::string last_error;

template <class Call> ocb_status guarded(Call call) {
    try {
        call();
        return OCB_OK;
    } catch (const std::exception &error) {
        last_error = error.what();
    } catch (...) {
        last_error = "unknown exception";
    }
    return OCB_ERROR;
}

ocb_status load_mesh(ocb_instance *, const double *positions, uint32_t, const uint32_t *triangles,
                     uint32_t triangle_count, ocb_object **object) {
    return guarded([&] {
        *object = reinterpret_cast<ocb_object *>(new Object(positions, triangles, triangle_count));
    });
}

void free_mesh(ocb_instance *, ocb_object *object) { delete reinterpret_cast<Object *>(object); }

ocb_status collide(ocb_instance *, ocb_object *a, const double *pose_a, ocb_object *b, const double *pose_b,
                   const ocb_collide_request *, ocb_collide_result *result) {
    return guarded([&] {
        reinterpret_cast<Object *>(a)->meets(pose_a, *reinterpret_cast<Object *>(b), pose_b, *result);
    });
}

const char *error_message(ocb_instance *) { return last_error.c_str(); }

ocb_algorithm describe() {
    ocb_algorithm algorithm{};
    algorithm.struct_size = sizeof algorithm;
    algorithm.id = "my-algorithm-cpp";
    algorithm.name = "My algorithm";
    algorithm.version = "0.1.0";
    algorithm.authors = "Me";
    algorithm.license = "MIT OR Apache-2.0";
    algorithm.load_mesh = load_mesh;
    algorithm.free_mesh = free_mesh;
    algorithm.collide = collide;
    algorithm.error_message = error_message;
    return algorithm;
}

} // namespace

extern "C" const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major) {
    static const ocb_algorithm algorithm = describe();
    static const ocb_algorithm *const algorithms[] = {&algorithm};
    static const ocb_plugin plugin = {OCB_ABI_MAJOR, OCB_ABI_MINOR, sizeof(ocb_plugin), 1, algorithms};
    return host_abi_major == OCB_ABI_MAJOR ? &plugin : nullptr;
}
