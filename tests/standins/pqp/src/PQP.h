// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Stand-in for PQP: the names that its manual documents, nothing of its code.
#pragma once

#include "../../standin.hpp"

typedef double PQP_REAL;
const int PQP_OK = 0;
const int PQP_ALL_CONTACTS = 1;
const int PQP_FIRST_CONTACT = 2;

class PQP_Model {
  public:
    standin::Soup soup;
    int BeginModel(int triangles = 8);
    int AddTri(const PQP_REAL *p, const PQP_REAL *q, const PQP_REAL *r, int id);
    int EndModel();
};

class PQP_CollideResult {
  public:
    std::vector<std::pair<int, int>> pairs;
    int tests = 0;
    // A stand-in has no bounding volumes, so it tests none.
    int NumBVTests() { return 0; }
    int NumTriTests() { return tests; }
    int NumPairs() { return static_cast<int>(pairs.size()); }
    int Id1(int i) { return pairs[i].first; }
    int Id2(int i) { return pairs[i].second; }
};

class PQP_DistanceResult {
  public:
    standin::Nearest nearest;
    int tests = 0;
    int NumBVTests() { return 0; }
    int NumTriTests() { return tests; }
    PQP_REAL Distance() { return nearest.distance; }
    const PQP_REAL *P1() { return nearest.own_a.data(); }
    const PQP_REAL *P2() { return nearest.own_b.data(); }
};

int PQP_Collide(PQP_CollideResult *result, PQP_REAL R1[3][3], PQP_REAL T1[3], PQP_Model *o1, PQP_REAL R2[3][3],
                PQP_REAL T2[3], PQP_Model *o2, int flag = PQP_ALL_CONTACTS);
int PQP_Distance(PQP_DistanceResult *result, PQP_REAL R1[3][3], PQP_REAL T1[3], PQP_Model *o1, PQP_REAL R2[3][3],
                 PQP_REAL T2[3], PQP_Model *o2, PQP_REAL rel_err, PQP_REAL abs_err, int qsize = 2);
