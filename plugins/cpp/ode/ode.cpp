// SPDX-License-Identifier: MIT OR Apache-2.0
//
// ODE: its own collider of two triangle meshes on OPCODE's trees.
#include "wrapper.hpp"

#include <ode/ode.h>

namespace {

using namespace ocb;

struct Meshes : Object {
    // ODE keeps pointers to both.
    std::vector<double> positions;
    std::vector<dTriIndex> corners;
    dTriMeshDataID data = dGeomTriMeshDataCreate();
    // The same object may be both objects of a query.
    dGeomID as_a = nullptr, as_b = nullptr;

    explicit Meshes(const Mesh &mesh)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          corners(mesh.corners, mesh.corners + 3 * size_t{mesh.triangle_count}) {
        dGeomTriMeshDataBuildDouble(data, positions.data(), 3 * sizeof(double), static_cast<int>(mesh.vertex_count),
                                    corners.data(), static_cast<int>(corners.size()), 3 * sizeof(dTriIndex));
        for (dGeomID *geom : {&as_a, &as_b}) *geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    }
    ~Meshes() override {
        dGeomDestroy(as_a);
        dGeomDestroy(as_b);
        dGeomTriMeshDataDestroy(data);
    }
};

void place(dGeomID geom, Pose pose, bool coherent) {
    dMatrix3 rotation = {};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) rotation[4 * row + column] = pose.rotation(row, column);
    dGeomSetRotation(geom, rotation);
    dGeomSetPosition(geom, pose.translation(0), pose.translation(1), pose.translation(2));
    dGeomTriMeshEnableTC(geom, dTriMeshClass, coherent);
}

class Ode : public Algorithm {
  public:
    Ode() {
        static const int ready = dInitODE2(0) && dAllocateODEDataForThread(dAllocateFlagCollisionData);
        if (!ready) throw std::runtime_error("ODE does not start");
    }

    void set(const std::string &name, double value) override {
        if (name == "temporal_coherence") coherent = value != 0;
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override { return std::make_unique<Meshes>(mesh); }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        const dGeomID first = static_cast<Meshes &>(a).as_a, second = static_cast<Meshes &>(b).as_b;
        place(first, pose_a, coherent);
        place(second, pose_b, coherent);
        dContactGeom contact;
        if (dCollide(first, second, 1 | CONTACTS_UNIMPORTANT, &contact, sizeof contact) == 0) return false;
        if (contact.side1 >= 0 && contact.side2 >= 0)
            pair = {static_cast<uint32_t>(contact.side1), static_cast<uint32_t>(contact.side2)};
        return true;
    }

  private:
    bool coherent = false;
};

} // namespace

ocb::About ocb::about() {
    return {"ode" OCB_VARIANT,
            "ODE (OPCODE)" OCB_VARIANT,
            "0.16.2",
            "Russell Smith, Pierre Terdiman",
            "LGPL-2.1-or-later OR BSD-3-Clause",
            "https://www.ode.org",
            "Terdiman: Memory-optimized bounding-volume hierarchies, 2001",
            COLLIDE,
            OCB_CAPABILITY_SINGLE_PRECISION,
            {whole("temporal_coherence", "1: begin at the pair of triangles that met last.", 0, 1, 0)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Ode>(); }
