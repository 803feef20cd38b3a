// SPDX-License-Identifier: MIT OR Apache-2.0
#include "VCollide.H"

int VCollide::NewObject(int *id) {
    *id = static_cast<int>(bodies.size());
    bodies.emplace_back();
    return VC_OK;
}
int VCollide::AddTri(double p[3], double q[3], double r[3], int id) {
    bodies.back().soup.add(p, q, r, id);
    return VC_OK;
}
int VCollide::EndObject() { return VC_OK; }
int VCollide::UpdateTrans(int id, double matrix[4][4]) {
    for (int i = 0; i < 16; i++) bodies[id].at.m[i] = matrix[i / 4][i % 4];
    return VC_OK;
}
int VCollide::ActivateObject(int id) { return bodies[id].active = true, VC_OK; }
int VCollide::DeactivateObject(int id) { return bodies[id].active = false, VC_OK; }

// Pairs come with the later body first, which the interface leaves open.
int VCollide::Collide(VCReport *report, int flag) {
    for (int i = 0; i < static_cast<int>(bodies.size()); i++)
        for (int j = 0; j < i; j++) {
            if (!bodies[i].active || !bodies[j].active) continue;
            VCReport::Met met{i, j, {}};
            bool any = false;
            standin::meetings(bodies[i].soup, bodies[i].at, bodies[j].soup, bodies[j].at, [&](int a, int b) {
                any = true;
                if (flag == VC_ALL_CONTACTS) met.triangles.push_back({a, b});
                return flag == VC_ALL_CONTACTS;
            });
            if (any) report->met.push_back(met);
        }
    return VC_OK;
}
