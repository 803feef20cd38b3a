/* SPDX-License-Identifier: MIT OR Apache-2.0 */
/* Stand-in for SOLID 3: the names that its manual documents, nothing of its code. */
#pragma once

typedef double DT_Scalar;
typedef DT_Scalar DT_Vector3[3];
typedef unsigned int DT_Index;
typedef unsigned int DT_Count;
typedef unsigned int DT_Size;
typedef int DT_Bool;
typedef struct DT_VertexBase *DT_VertexBaseHandle;
typedef struct DT_Shape *DT_ShapeHandle;
typedef struct DT_Object *DT_ObjectHandle;

extern "C" {
DT_VertexBaseHandle DT_NewVertexBase(const void *pointer, DT_Size stride);
void DT_DeleteVertexBase(DT_VertexBaseHandle base);
DT_ShapeHandle DT_NewComplexShape(DT_VertexBaseHandle base);
void DT_EndComplexShape();
void DT_VertexIndices(DT_Count count, const DT_Index *indices);
void DT_DeleteShape(DT_ShapeHandle shape);
DT_ObjectHandle DT_CreateObject(void *client, DT_ShapeHandle shape);
void DT_DestroyObject(DT_ObjectHandle object);
void DT_SetMatrixd(DT_ObjectHandle object, const double *columns);
void DT_SetAccuracy(DT_Scalar relative_error);
DT_Bool DT_GetCommonPoint(DT_ObjectHandle a, DT_ObjectHandle b, DT_Vector3 point);
DT_Scalar DT_GetClosestPair(DT_ObjectHandle a, DT_ObjectHandle b, DT_Vector3 on_a, DT_Vector3 on_b);
}
