// SPDX-License-Identifier: MIT OR Apache-2.0
//
// What a wrapper around a C++ library implements, and views of what the host passes in. `wrapper.cpp` puts it behind the
// C interface: it copies nothing on the way, and a wrapped query costs one virtual call more than a direct one.
#pragma once

#include <opencollbench/ext/contacts.h>
#include <opencollbench/ext/distance.h>
#include <opencollbench/ext/parameters.h>
#include <opencollbench/plugin.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace ocb {

using Vector = std::array<double, 3>;
using Triangle = std::array<Vector, 3>;

// The host's arrays; they are gone when `load` returns.
struct Mesh {
    const double *positions;
    const uint32_t *corners;
    uint32_t vertex_count, triangle_count;

    Vector vertex(size_t i) const { return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]}; }
    uint32_t corner(size_t triangle, size_t k) const { return corners[3 * triangle + k]; }
    Triangle triangle(size_t i) const { return {vertex(corner(i, 0)), vertex(corner(i, 1)), vertex(corner(i, 2))}; }
};

// A row-major 4x4 matrix from the object's frame to the world.
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

// What the library made of a mesh.
struct Object {
    virtual ~Object() = default;
};

// A pair of triangles, or nothing.
struct Pair {
    uint32_t a = OCB_NO_TRIANGLE, b = OCB_NO_TRIANGLE;
};

struct Distance {
    double value = 0;
    Pair triangles;
    bool has_points = false;
    Vector a{}, b{};
};

// Where all contacts go: counted, and written as far as there is room.
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

// Thrown for a question, a parameter or a mesh that the library does not know.
struct Unsupported : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// One algorithm. One of these exists per run.
class Algorithm {
  public:
    virtual ~Algorithm() = default;
    // Name, type and range are checked by the host.
    virtual void set(const std::string &name, double) { throw Unsupported("there is no parameter " + name); }
    virtual std::unique_ptr<Object> load(const Mesh &mesh) = 0;
    // Do they meet? Names a pair if it can.
    virtual bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) = 0;
    // Asked only when `About` says so.
    virtual Distance distance(Object &, Pose, Object &, Pose) { throw Unsupported("no distances"); }
    virtual void contacts(Object &, Pose, Object &, Pose, Contacts &) { throw Unsupported("no list of contacts"); }
};

// The same wrapper around another build of its library is another algorithm, with this behind its id and name.
#ifndef OCB_VARIANT
#define OCB_VARIANT ""
#endif

enum Queries { COLLIDE = 0, DISTANCE = 1, CONTACTS = 2 };

struct About {
    const char *id, *name, *version, *authors, *license, *url, *paper;
    // DISTANCE | CONTACTS, beside the collision query that all have.
    int queries;
    // OCB_CAPABILITY_*.
    uint32_t capabilities;
    std::vector<ocb_parameter> parameters;
};

inline ocb_parameter whole(const char *name, const char *description, double least, double most, double value) {
    return {sizeof(ocb_parameter), OCB_PARAMETER_INTEGER, name, description, least, most, value};
}
inline ocb_parameter real(const char *name, const char *description, double least, double most, double value) {
    return {sizeof(ocb_parameter), OCB_PARAMETER_REAL, name, description, least, most, value};
}

// A wrapper defines these two.
About about();
std::unique_ptr<Algorithm> make();

} // namespace ocb
