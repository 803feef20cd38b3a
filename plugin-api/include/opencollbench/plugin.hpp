/* SPDX-License-Identifier: MIT OR Apache-2.0 */
//
// Plugins in C++17. Write a class with `about`, `load` and `collide`, and name it in OCB_PLUGIN:
//
//     struct Mine {
//         static ocb::About about() { return {"mine", "My algorithm"}; }
//         Tree load(const ocb::Mesh &mesh);
//         ocb::Collision collide(ocb::Placed<Tree> a, ocb::Placed<Tree> b, ocb::Work &work);
//     };
//     OCB_PLUGIN(Mine)
//
// What `load` returns is the object of the queries; it may be of any type and need not be movable. A value of the class is one
// run: its parameters and its scratch memory. It is made by its default constructor, or from a `const ocb_host &` if it can be.
// More members say what else it can do; the class has them or leaves them out (none may be a template or overloaded):
//
//     ocb::Distance distance(Placed a, Placed b, Work &work)                            ocb.distance/1
//     void contacts(Placed a, Placed b, ocb::Contacts &found, Work &work)               ocb.contacts/1
//     void set(const std::string &parameter, double value)                              ocb.parameters/1
//     static constexpr bool scene = true;             ocb.scene/1: any number of objects, queries about any two of them
//     bool inside(Placed a, Placed b, Work &work)     solid bodies: asked when the surfaces do not meet
//     bool answers(ocb::Query query) const            false: not with the parameters that are set
//
// plugin.h is the specification: what it says of frames, units, ownership and threads holds here. No exception leaves these
// functions: `ocb::GaveUp` and `ocb::Unsupported` become their status, any other an error with its words.
#ifndef OPENCOLLBENCH_PLUGIN_HPP
#define OPENCOLLBENCH_PLUGIN_HPP

#include "ext/contacts.h"
#include "ext/distance.h"
#include "ext/draft/scene.h"
#include "ext/parameters.h"
#include "plugin.h"

#include <array>
#include <cstddef>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace ocb {

using Vector = std::array<double, 3>;
using Triangle = std::array<Vector, 3>;
// A triangle of A and one of B: positions in the `triangles` of `load`.
using Pair = std::array<uint32_t, 2>;

// A polygon soup in the object's frame. These are the host's arrays: they are gone when `load` returns.
struct Mesh {
    const double *positions;
    const uint32_t *triangles;
    uint32_t vertex_count, triangle_count;

    Vector vertex(size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
    uint32_t corner(size_t triangle, size_t k) const { return triangles[3 * triangle + k]; }
    Triangle triangle(size_t i) const { return {vertex(corner(i, 0)), vertex(corner(i, 1)), vertex(corner(i, 2))}; }
};

// A rigid placement: a row-major 4x4 matrix from the object's frame to the world frame.
struct Pose {
    const double *m;

    double rotation(int row, int column) const { return m[4 * row + column]; }
    double translation(int row) const { return m[4 * row + 3]; }
    Vector operator()(const Vector &p) const {
        Vector world;
        for (int row = 0; row < 3; row++)
            world[row] = m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
        return world;
    }
    Triangle operator()(const Triangle &t) const { return {(*this)(t[0]), (*this)(t[1]), (*this)(t[2])}; }
};

// An object where a query puts it. Both objects of a query may be one and the same.
template <class Object> struct Placed {
    Object &object;
    Pose pose;
};

// Takes the work of a query. Nothing is counted in a timed query: then each call is one test of a pointer.
class Work {
  public:
    explicit Work(ocb_counts *counts, uint32_t flags) : counts(counts) {
        if (counts) counts->flags = flags;
    }
    // For an algorithm that has a counting copy of its query code.
    bool counting() const { return counts != nullptr; }
    // So many tests between two bounding volumes.
    void bv_tests(uint64_t tests = 1) {
        if (counts) counts->bv_tests += tests;
    }
    // One test between triangle `a` of A and triangle `b` of B.
    void primitive_test(uint32_t a, uint32_t b) {
        if (!counts) return;
        counts->primitive_tests++;
        if (counts->tests_a) counts->tests_a[a]++;
        if (counts->tests_b) counts->tests_b[b]++;
    }
    // So many tests between triangles that are not known, as some libraries report them.
    void primitive_tests(uint64_t tests) {
        if (counts) counts->primitive_tests += tests;
    }

  private:
    ocb_counts *counts;
};

// The answer of `collide`: {} is "apart".
struct Collision {
    bool hit = false;
    Pair triangles{OCB_NO_TRIANGLE, OCB_NO_TRIANGLE};

    // These two triangles have a point in common.
    static Collision pair(uint32_t a, uint32_t b) { return {true, {a, b}}; }
    // The surfaces meet, and the algorithm does not know where.
    static Collision somewhere() { return {true}; }
};

// The answer of `distance`: the minimum distance, 0 when the surfaces meet; witness points on A and on B in the world frame,
// and their triangles, if the algorithm knows them.
struct Distance {
    double distance = 0;
    std::optional<std::array<Vector, 2>> points;
    std::optional<Pair> triangles;
};

// Where `contacts` puts what it finds, each pair once: all are counted, and written as far as there is room.
class Contacts {
  public:
    Contacts(ocb_contact *room, uint64_t capacity) : room(room), capacity(capacity) {}
    void add(uint32_t a, uint32_t b) {
        if (total < capacity) room[total] = {a, b};
        total++;
    }
    uint64_t count() const { return total; }

  private:
    ocb_contact *room;
    uint64_t capacity, total = 0;
};

// Thrown when the algorithm cannot decide: an honest answer, which is counted.
struct GaveUp : std::exception {
    const char *what() const noexcept override { return "it could not decide"; }
};

// Thrown for a query, a parameter or a mesh that the algorithm does not know.
struct Unsupported : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class Query { collide, distance, contacts };

// Who made it. Strings and parameters must live as long as the process: literals are meant.
struct About {
    const char *id, *name;
    const char *version = "0.1.0", *authors = nullptr, *license = nullptr, *url = nullptr, *paper = nullptr;
    // OCB_CAPABILITY_* bits; those for solid bodies and counts follow from `inside` and the next line.
    uint32_t capabilities = 0;
    // OCB_COUNTS_* bits: what every query reports to its `work`.
    uint32_t counts = 0;
    std::vector<ocb_parameter> parameters{};
};

// Parameters for `About`.
inline ocb_parameter integer(const char *name, const char *description, int least, int most, int value) {
    return {sizeof(ocb_parameter), OCB_PARAMETER_INTEGER, name, description, double(least), double(most), double(value)};
}
inline ocb_parameter real(const char *name, const char *description, double least, double most, double value) {
    return {sizeof(ocb_parameter), OCB_PARAMETER_REAL, name, description, least, most, value};
}

} // namespace ocb

#include "detail/calls.hpp"

// Exports one or several algorithms. Once per plugin, outside of any namespace.
#define OCB_PLUGIN(...)                                                                                                     \
    extern "C" OCB_EXPORT const ocb_plugin *ocb_entry_v1(uint32_t host_abi_major) {                                         \
        return ocb::detail::plugin<__VA_ARGS__>(host_abi_major);                                                            \
    }

#endif
