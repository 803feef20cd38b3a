// SPDX-License-Identifier: MIT OR Apache-2.0
#include "RAPID.H"

int RAPID_num_box_tests = 0;
int RAPID_num_tri_tests = 0;
int RAPID_num_contacts = 0;
collision_pair *RAPID_contact = nullptr;

int RAPID_model::BeginModel() { return RAPID_OK; }
int RAPID_model::AddTri(double *p, double *q, double *r, int id) {
    soup.add(p, q, r, id);
    return RAPID_OK;
}
int RAPID_model::EndModel() { return RAPID_OK; }

int RAPID_Collide(double R1[3][3], double T1[3], RAPID_model *o1, double R2[3][3], double T2[3], RAPID_model *o2,
                  int flag) {
    static std::vector<collision_pair> found;
    found.clear();
    const standin::Matrix at_1 = standin::Matrix::of(R1, T1), at_2 = standin::Matrix::of(R2, T2);
    RAPID_num_tri_tests = standin::meetings(o1->soup, at_1, o2->soup, at_2, [&](int a, int b) {
        found.push_back({a, b});
        return flag == RAPID_ALL_CONTACTS;
    });
    RAPID_num_contacts = static_cast<int>(found.size());
    RAPID_contact = found.data();
    return RAPID_OK;
}
