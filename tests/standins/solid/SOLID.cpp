// SPDX-License-Identifier: MIT OR Apache-2.0
#include "SOLID.h"

#include "../standin.hpp"

struct DT_VertexBase {
    const char *pointer;
    DT_Size stride;
};
struct DT_Shape {
    DT_VertexBase *base;
    standin::Soup soup;
};
struct DT_Object {
    DT_Shape *shape;
    standin::Matrix at{};
};

static DT_Shape *current;

DT_VertexBaseHandle DT_NewVertexBase(const void *pointer, DT_Size stride) {
    return new DT_VertexBase{static_cast<const char *>(pointer), stride};
}
void DT_DeleteVertexBase(DT_VertexBaseHandle base) { delete base; }
DT_ShapeHandle DT_NewComplexShape(DT_VertexBaseHandle base) { return current = new DT_Shape{base, {}}; }
void DT_EndComplexShape() { current = nullptr; }
void DT_VertexIndices(DT_Count, const DT_Index *indices) {
    const auto at = [&](int k) {
        return reinterpret_cast<const DT_Scalar *>(current->base->pointer + indices[k] * current->base->stride);
    };
    current->soup.add(at(0), at(1), at(2), 0);
}
void DT_DeleteShape(DT_ShapeHandle shape) { delete shape; }
DT_ObjectHandle DT_CreateObject(void *, DT_ShapeHandle shape) { return new DT_Object{shape, {}}; }
void DT_DestroyObject(DT_ObjectHandle object) { delete object; }
void DT_SetMatrixd(DT_ObjectHandle object, const double *columns) {
    for (int i = 0; i < 16; i++) object->at.m[i] = columns[4 * (i % 4) + i / 4];
}
void DT_SetAccuracy(DT_Scalar) {}

DT_Bool DT_GetCommonPoint(DT_ObjectHandle a, DT_ObjectHandle b, DT_Vector3) {
    bool any = false;
    standin::meetings(a->shape->soup, a->at, b->shape->soup, b->at, [&](int, int) { return any = true, false; });
    return any;
}

DT_Scalar DT_GetClosestPair(DT_ObjectHandle a, DT_ObjectHandle b, DT_Vector3 on_a, DT_Vector3 on_b) {
    const standin::Nearest nearest = standin::nearest_corners(a->shape->soup, a->at, b->shape->soup, b->at);
    for (int k = 0; k < 3; k++) on_a[k] = nearest.world_a[k], on_b[k] = nearest.world_b[k];
    return nearest.distance;
}
