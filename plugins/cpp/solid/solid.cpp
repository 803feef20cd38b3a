// SPDX-License-Identifier: MIT OR Apache-2.0
//
// SOLID 3, built against your own copy: trees of axis-aligned boxes, triangles compared by GJK.
#include "wrapper.hpp"

#include <SOLID.h>

namespace {

using namespace ocb;

struct Shape : Object {
    // SOLID keeps a pointer to them.
    std::vector<DT_Scalar> positions;
    DT_VertexBaseHandle base;
    DT_ShapeHandle shape;
    // The same object may be both objects of a query.
    DT_ObjectHandle as_a, as_b;

    explicit Shape(const Mesh &mesh)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          base(DT_NewVertexBase(positions.data(), 3 * sizeof(DT_Scalar))), shape(DT_NewComplexShape(base)) {
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            const DT_Index corners[3] = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
            DT_VertexIndices(3, corners);
        }
        DT_EndComplexShape();
        as_a = DT_CreateObject(this, shape), as_b = DT_CreateObject(this, shape);
    }
    ~Shape() override {
        DT_DestroyObject(as_a);
        DT_DestroyObject(as_b);
        DT_DeleteShape(shape);
        DT_DeleteVertexBase(base);
    }
};

void place(DT_ObjectHandle object, Pose pose) {
    double columns[16];
    for (int i = 0; i < 16; i++) columns[4 * (i % 4) + i / 4] = pose.m[i];
    DT_SetMatrixd(object, columns);
}

class Solid : public Algorithm {
  public:
    Solid() { DT_SetAccuracy(static_cast<DT_Scalar>(1e-12)); }

    void set(const std::string &name, double value) override {
        if (name == "accuracy") DT_SetAccuracy(static_cast<DT_Scalar>(value));
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override { return std::make_unique<Shape>(mesh); }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &) override {
        const DT_ObjectHandle first = static_cast<Shape &>(a).as_a, second = static_cast<Shape &>(b).as_b;
        place(first, pose_a);
        place(second, pose_b);
        DT_Vector3 common;
        return DT_GetCommonPoint(first, second, common);
    }

    Distance distance(Object &a, Pose pose_a, Object &b, Pose pose_b) override {
        const DT_ObjectHandle first = static_cast<Shape &>(a).as_a, second = static_cast<Shape &>(b).as_b;
        place(first, pose_a);
        place(second, pose_b);
        DT_Vector3 point_a, point_b;
        Distance found;
        found.value = DT_GetClosestPair(first, second, point_a, point_b);
        found.has_points = found.value > 0;
        for (int k = 0; k < 3; k++) found.a[k] = point_a[k], found.b[k] = point_b[k];
        return found;
    }
};

} // namespace

ocb::About ocb::about() {
    return {"solid",
            "SOLID",
            "3",
            "Gino van den Bergen",
            "LicenseRef-SOLID-QPL-or-GPL",
            "https://dtecta.com",
            "van den Bergen: A Fast and Robust GJK Implementation for Collision Detection of Convex Objects, 1999",
            DISTANCE,
            sizeof(DT_Scalar) == sizeof(float) ? OCB_CAPABILITY_SINGLE_PRECISION : 0u,
            {real("accuracy", "Relative error of closest points at which GJK stops; SOLID's own default is 1e-3.", 1e-15, 1, 1e-12)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Solid>(); }
