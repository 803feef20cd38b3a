// SPDX-License-Identifier: MIT OR Apache-2.0
//
// SOLID 3, built against your own copy: trees of axis-aligned boxes, triangles compared by GJK.
#include <opencollbench/plugin.hpp>

#include <SOLID.h>

namespace {

struct Shape {
    // SOLID keeps a pointer to them.
    std::vector<DT_Scalar> positions;
    DT_VertexBaseHandle base;
    DT_ShapeHandle shape;
    // The same object may be both objects of a query.
    DT_ObjectHandle as_a, as_b;

    explicit Shape(const ocb::Mesh &mesh)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          base(DT_NewVertexBase(positions.data(), 3 * sizeof(DT_Scalar))), shape(DT_NewComplexShape(base)) {
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            const DT_Index corners[3] = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
            DT_VertexIndices(3, corners);
        }
        DT_EndComplexShape();
        as_a = DT_CreateObject(this, shape), as_b = DT_CreateObject(this, shape);
    }
    ~Shape() {
        DT_DestroyObject(as_a);
        DT_DestroyObject(as_b);
        DT_DeleteShape(shape);
        DT_DeleteVertexBase(base);
    }
    Shape(const Shape &) = delete;
};

void place(DT_ObjectHandle object, ocb::Pose pose) {
    double columns[16];
    for (int i = 0; i < 16; i++) columns[4 * (i % 4) + i / 4] = pose.m[i];
    DT_SetMatrixd(object, columns);
}

ocb::Vector vector(const DT_Vector3 p) { return {p[0], p[1], p[2]}; }

class Solid {
  public:
    static ocb::About about() {
        return {"solid",
                "SOLID",
                "3",
                "Gino van den Bergen",
                "LicenseRef-SOLID-QPL-or-GPL",
                "https://dtecta.com",
                "van den Bergen: A Fast and Robust GJK Implementation for Collision Detection of Convex Objects, 1999",
                sizeof(DT_Scalar) == sizeof(float) ? OCB_CAPABILITY_SINGLE_PRECISION : 0,
                0,
                {ocb::real("accuracy", "Relative error of closest points at which GJK stops; SOLID's own default is 1e-3.",
                           1e-15, 1, 1e-12)}};
    }

    Solid() { DT_SetAccuracy(static_cast<DT_Scalar>(1e-12)); }

    void set(const std::string &name, double value) {
        if (name == "accuracy") DT_SetAccuracy(static_cast<DT_Scalar>(value));
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    Shape load(const ocb::Mesh &mesh) { return Shape(mesh); }

    using Object = ocb::Placed<Shape>;

    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        const DT_ObjectHandle first = a.object.as_a, second = b.object.as_b;
        place(first, a.pose);
        place(second, b.pose);
        DT_Vector3 common;
        return DT_GetCommonPoint(first, second, common) ? ocb::Collision::somewhere() : ocb::Collision{};
    }

    ocb::Distance distance(Object a, Object b, ocb::Work &) {
        const DT_ObjectHandle first = a.object.as_a, second = b.object.as_b;
        place(first, a.pose);
        place(second, b.pose);
        DT_Vector3 point_a, point_b;
        ocb::Distance found;
        found.distance = DT_GetClosestPair(first, second, point_a, point_b);
        if (found.distance > 0) found.points = {vector(point_a), vector(point_b)};
        return found;
    }
};

} // namespace

OCB_PLUGIN(Solid)
