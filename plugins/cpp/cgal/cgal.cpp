// SPDX-License-Identifier: MIT OR Apache-2.0
//
// CGAL: trees of axis-aligned boxes, and predicates that decide exactly about the points they are given.
#include <opencollbench/plugin.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

namespace {

using ocb::Triangle, ocb::Vector;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Detection = CGAL::Rigid_triangle_mesh_collision_detection<Surface>;

Kernel::Point_3 point(const Vector &p) { return {p[0], p[1], p[2]}; }

// A mesh is a polygon soup here: each triangle has corners of its own.
struct Soup {
    std::vector<Triangle> triangles;
    Surface surface;
    Detection::AABB_tree tree;
    // The same object may be both objects of a query.
    size_t as_a = 0, as_b = 0;

    Soup(const ocb::Mesh &mesh, Detection &detection) {
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            const Triangle t = mesh.triangle(i);
            const Kernel::Point_3 p = point(t[0]), q = point(t[1]), r = point(t[2]);
            if (CGAL::collinear(p, q, r))
                throw ocb::Unsupported("triangle " + std::to_string(i) + " has no area, which CGAL's predicates exclude");
            surface.add_face(surface.add_vertex(p), surface.add_vertex(q), surface.add_vertex(r));
            triangles.push_back(t);
        }
        tree.insert(faces(surface).begin(), faces(surface).end(), surface);
        tree.build();
        for (size_t *id : {&as_a, &as_b})
            *id = detection.add_mesh(tree, surface, CGAL::parameters::apply_per_connected_component(false));
    }
    // CGAL keeps a pointer to the tree.
    Soup(const Soup &) = delete;
};

Kernel::Aff_transformation_3 transform(ocb::Pose pose) {
    const double *m = pose.m;
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], 1};
}

class Cgal {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"cgal",
                "CGAL",
                CGAL_VERSION_STR,
                "Pierre Alliez, Sebastien Loriot, Mael Rouxel-Labbe, Stephane Tayeb",
                "GPL-3.0-or-later",
                "https://www.cgal.org",
                "Alliez, Tayeb, Wormser: 3D Fast Intersection and Distance Computation, CGAL User and Reference Manual"};
    }

    Soup load(const ocb::Mesh &mesh) { return Soup(mesh, detection); }

    using Object = ocb::Placed<Soup>;

    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        const size_t first = a.object.as_a, second = b.object.as_b;
        detection.set_transformation(first, transform(a.pose));
        detection.set_transformation(second, transform(b.pose));
        const bool apart = detection.get_all_intersections(first, std::array<size_t, 1>{second}).empty();
        return apart ? ocb::Collision{} : ocb::Collision::somewhere();
    }

    // The tree of A is asked about each triangle of B, moved into A's frame.
    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &) {
        const auto into_a = [&](const Vector &p) {
            const Vector world = b.pose(p);
            Vector own{};
            for (int column = 0; column < 3; column++)
                for (int row = 0; row < 3; row++)
                    own[column] += a.pose.rotation(row, column) * (world[row] - a.pose.translation(row));
            return point(own);
        };
        const std::vector<Triangle> &moved = b.object.triangles;
        for (uint32_t i = 0; i < moved.size(); i++) {
            const Triangle &t = moved[i];
            met.clear();
            a.object.tree.all_intersected_primitives(Kernel::Triangle_3(into_a(t[0]), into_a(t[1]), into_a(t[2])),
                                                     std::back_inserter(met));
            for (const Surface::Face_index face : met) found.add(static_cast<uint32_t>(face), i);
        }
    }

  private:
    Detection detection;
    std::vector<Surface::Face_index> met;
};

} // namespace

OCB_PLUGIN(Cgal)
