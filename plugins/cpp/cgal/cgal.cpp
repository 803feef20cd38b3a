// SPDX-License-Identifier: MIT OR Apache-2.0
//
// CGAL: trees of axis-aligned boxes, and predicates that decide exactly about the points they are given.
#include "wrapper.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

namespace {

using namespace ocb;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Detection = CGAL::Rigid_triangle_mesh_collision_detection<Surface>;

Kernel::Point_3 point(const Vector &p) { return {p[0], p[1], p[2]}; }

// A mesh is a polygon soup here: each triangle has corners of its own.
struct Soup : Object {
    std::vector<Triangle> triangles;
    Surface surface;
    Detection::AABB_tree tree;
    // The same object may be both objects of a query.
    size_t as_a = 0, as_b = 0;

    explicit Soup(const Mesh &mesh) {
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            const Triangle t = mesh.triangle(i);
            const Kernel::Point_3 p = point(t[0]), q = point(t[1]), r = point(t[2]);
            if (CGAL::collinear(p, q, r))
                throw Unsupported("triangle " + std::to_string(i) + " has no area, which CGAL's predicates exclude");
            surface.add_face(surface.add_vertex(p), surface.add_vertex(q), surface.add_vertex(r));
            triangles.push_back(t);
        }
        tree.insert(faces(surface).begin(), faces(surface).end(), surface);
        tree.build();
    }
};

Kernel::Aff_transformation_3 transform(Pose pose) {
    const double *m = pose.m;
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 1};
}

class Cgal : public Algorithm {
  public:
    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto soup = std::make_unique<Soup>(mesh);
        for (size_t *id : {&soup->as_a, &soup->as_b})
            *id = detection.add_mesh(soup->tree, soup->surface,
                                     CGAL::parameters::apply_per_connected_component(false));
        return soup;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &) override {
        const size_t first = static_cast<Soup &>(a).as_a, second = static_cast<Soup &>(b).as_b;
        detection.set_transformation(first, transform(pose_a));
        detection.set_transformation(second, transform(pose_b));
        return !detection.get_all_intersections(first, std::array<size_t, 1>{second}).empty();
    }

    // The tree of A is asked about each triangle of B, moved into A's frame.
    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        const Soup &still = static_cast<Soup &>(a), &moved = static_cast<Soup &>(b);
        const auto into_a = [&](const Vector &p) {
            const Vector world = pose_b(p);
            Vector own{};
            for (int column = 0; column < 3; column++)
                for (int row = 0; row < 3; row++)
                    own[column] += pose_a.rotation(row, column) * (world[row] - pose_a.translation(row));
            return point(own);
        };
        for (uint32_t i = 0; i < moved.triangles.size(); i++) {
            const Triangle &t = moved.triangles[i];
            met.clear();
            still.tree.all_intersected_primitives(Kernel::Triangle_3(into_a(t[0]), into_a(t[1]), into_a(t[2])),
                                                  std::back_inserter(met));
            for (const Surface::Face_index face : met) out.add(static_cast<uint32_t>(face), i);
        }
    }

  private:
    Detection detection;
    std::vector<Surface::Face_index> met;
};

} // namespace

ocb::About ocb::about() {
    return {"cgal",
            "CGAL",
            CGAL_VERSION_STR,
            "Pierre Alliez, Sebastien Loriot, Mael Rouxel-Labbe, Stephane Tayeb",
            "GPL-3.0-or-later",
            "https://www.cgal.org",
            "Alliez, Tayeb, Wormser: 3D Fast Intersection and Distance Computation, CGAL User and Reference Manual",
            CONTACTS,
            0,
            {}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Cgal>(); }
