// SPDX-License-Identifier: MIT OR Apache-2.0
#include "PQP.h"

using standin::Matrix;

int PQP_Model::BeginModel(int) { return PQP_OK; }
int PQP_Model::AddTri(const PQP_REAL *p, const PQP_REAL *q, const PQP_REAL *r, int id) {
    soup.add(p, q, r, id);
    return PQP_OK;
}
int PQP_Model::EndModel() { return PQP_OK; }

int PQP_Collide(PQP_CollideResult *result, PQP_REAL R1[3][3], PQP_REAL T1[3], PQP_Model *o1, PQP_REAL R2[3][3],
                PQP_REAL T2[3], PQP_Model *o2, int flag) {
    result->tests = standin::meetings(o1->soup, Matrix::of(R1, T1), o2->soup, Matrix::of(R2, T2), [&](int a, int b) {
        result->pairs.push_back({a, b});
        return flag == PQP_ALL_CONTACTS;
    });
    return PQP_OK;
}

int PQP_Distance(PQP_DistanceResult *result, PQP_REAL R1[3][3], PQP_REAL T1[3], PQP_Model *o1, PQP_REAL R2[3][3],
                 PQP_REAL T2[3], PQP_Model *o2, PQP_REAL, PQP_REAL, int) {
    result->tests = static_cast<int>(o1->soup.all.size() * o2->soup.all.size());
    result->nearest = standin::nearest_corners(o1->soup, Matrix::of(R1, T1), o2->soup, Matrix::of(R2, T2));
    return PQP_OK;
}
