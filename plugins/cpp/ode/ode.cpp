// SPDX-License-Identifier: MIT OR Apache-2.0
//
// ODE: its own collider of two triangle meshes on OPCODE's trees.
#include <opencollbench/plugin.hpp>

#include <ode/ode.h>

namespace {

struct Meshes {
    // ODE keeps pointers to both.
    std::vector<double> positions;
    std::vector<dTriIndex> corners;
    dTriMeshDataID data = dGeomTriMeshDataCreate();
    // The same object may be both objects of a query.
    dGeomID as_a = nullptr, as_b = nullptr;

    explicit Meshes(const ocb::Mesh &mesh)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          corners(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count}) {
        dGeomTriMeshDataBuildDouble(data, positions.data(), 3 * sizeof(double), static_cast<int>(mesh.vertex_count),
                                    corners.data(), static_cast<int>(corners.size()), 3 * sizeof(dTriIndex));
        for (dGeomID *geom : {&as_a, &as_b}) *geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    }
    ~Meshes() {
        dGeomDestroy(as_a);
        dGeomDestroy(as_b);
        dGeomTriMeshDataDestroy(data);
    }
    Meshes(const Meshes &) = delete;
};

class Ode {
  public:
    static ocb::About about() {
        return {"ode" OCB_VARIANT,
                "ODE (OPCODE)" OCB_VARIANT,
                "0.16.2",
                "Russell Smith, Pierre Terdiman",
                "LGPL-2.1-or-later OR BSD-3-Clause",
                "https://www.ode.org",
                "Terdiman: Memory-optimized bounding-volume hierarchies, 2001",
                OCB_CAPABILITY_SINGLE_PRECISION,
                0,
                {ocb::integer("temporal_coherence", "1: begin at the pair of triangles that met last.", 0, 1, 0)}};
    }

    Ode() {
        static const int ready = dInitODE2(0) && dAllocateODEDataForThread(dAllocateFlagCollisionData);
        if (!ready) throw std::runtime_error("ODE does not start");
    }

    void set(const std::string &name, double value) {
        if (name == "temporal_coherence") coherent = value != 0;
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    Meshes load(const ocb::Mesh &mesh) { return Meshes(mesh); }

    ocb::Collision collide(ocb::Placed<Meshes> a, ocb::Placed<Meshes> b, ocb::Work &) {
        const dGeomID first = a.object.as_a, second = b.object.as_b;
        place(first, a.pose);
        place(second, b.pose);
        dContactGeom contact;
        if (dCollide(first, second, 1 | CONTACTS_UNIMPORTANT, &contact, sizeof contact) == 0) return {};
        if (contact.side1 < 0 || contact.side2 < 0) return ocb::Collision::somewhere();
        return ocb::Collision::pair(static_cast<uint32_t>(contact.side1), static_cast<uint32_t>(contact.side2));
    }

  private:
    void place(dGeomID geom, ocb::Pose pose) const {
        dMatrix3 rotation = {};
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++) rotation[4 * row + column] = pose.rotation(row, column);
        dGeomSetRotation(geom, rotation);
        dGeomSetPosition(geom, pose.translation(0), pose.translation(1), pose.translation(2));
        dGeomTriMeshEnableTC(geom, dTriMeshClass, coherent);
    }

    bool coherent = false;
};

} // namespace

OCB_PLUGIN(Ode)
