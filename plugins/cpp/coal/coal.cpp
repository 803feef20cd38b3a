// SPDX-License-Identifier: MIT OR Apache-2.0
//
// coal (formerly hpp-fcl): hierarchies as in FCL, triangles compared by GJK.
#include "wrapper.hpp"

#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/distance.h>

#include <limits>

namespace {

using namespace ocb;

coal::Transform3s transform(Pose pose) {
    coal::Matrix3s rotation;
    coal::Vec3s translation;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) rotation(row, column) = pose.rotation(row, column);
        translation(row) = pose.translation(row);
    }
    return {rotation, translation};
}

struct Model : Object {
    std::unique_ptr<coal::CollisionGeometry> geometry;
};

template <class Volume> std::unique_ptr<coal::CollisionGeometry> build(const Mesh &mesh) {
    std::vector<coal::Vec3s> points(mesh.vertex_count);
    for (uint32_t i = 0; i < mesh.vertex_count; i++)
        points[i] = coal::Vec3s(mesh.positions[3 * size_t{i}], mesh.positions[3 * size_t{i} + 1], mesh.positions[3 * size_t{i} + 2]);
    std::vector<coal::Triangle> triangles(mesh.triangle_count);
    for (uint32_t i = 0; i < mesh.triangle_count; i++)
        triangles[i].set(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
    auto model = std::make_unique<coal::BVHModel<Volume>>();
    model->beginModel(mesh.triangle_count, mesh.vertex_count);
    model->addSubModel(points, triangles);
    model->endModel();
    model->computeLocalAABB();
    return model;
}

const coal::CollisionGeometry *geometry(Object &object) { return static_cast<Model &>(object).geometry.get(); }

class Coal : public Algorithm {
  public:
    void set(const std::string &name, double value) override {
        if (name == "bv") volume = static_cast<int>(value);
        else if (name == "gjk_tolerance") tolerance = value;
        else if (name == "enable_contact") enable_contact = value != 0;
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto model = std::make_unique<Model>();
        model->geometry = volume == 0   ? build<coal::OBB>(mesh)
                          : volume == 1 ? build<coal::RSS>(mesh)
                          : volume == 2 ? build<coal::OBBRSS>(mesh)
                                        : build<coal::kIOS>(mesh);
        return model;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        const coal::CollisionResult result = ask(a, pose_a, b, pose_b, 1);
        if (!result.isCollision()) return false;
        const coal::Contact &contact = result.getContact(0);
        pair = {static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2)};
        return true;
    }

    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        const coal::CollisionResult result = ask(a, pose_a, b, pose_b, std::numeric_limits<size_t>::max());
        for (const coal::Contact &contact : result.getContacts())
            out.add(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
    }

    Distance distance(Object &a, Pose pose_a, Object &b, Pose pose_b) override {
        if (volume == 0) throw Unsupported("coal has no distance between hierarchies of OBBs; choose another bv");
        coal::DistanceRequest request(true, false, 0, 0);
        request.gjk_tolerance = tolerance;
        coal::DistanceResult result;
        coal::distance(geometry(a), transform(pose_a), geometry(b), transform(pose_b), request, result);
        Distance found;
        found.value = std::max(result.min_distance, 0.0);
        found.triangles = {static_cast<uint32_t>(result.b1), static_cast<uint32_t>(result.b2)};
        found.has_points = found.value > 0;
        for (int k = 0; k < 3; k++) {
            found.a[k] = result.nearest_points[0][k];
            found.b[k] = result.nearest_points[1][k];
        }
        return found;
    }

  private:
    coal::CollisionResult ask(Object &a, Pose pose_a, Object &b, Pose pose_b, size_t most) const {
        coal::CollisionRequest request(coal::NO_REQUEST, most);
        request.enable_contact = enable_contact;
        request.gjk_tolerance = tolerance;
        coal::CollisionResult result;
        coal::collide(geometry(a), transform(pose_a), geometry(b), transform(pose_b), request, result);
        return result;
    }

    int volume = 2;
    double tolerance = 1e-9;
    bool enable_contact = false;
};

} // namespace

ocb::About ocb::about() {
    return {"coal",
            "Coal",
            "3.0.3",
            "Louis Montaut, Justin Carpentier, Joseph Mirabel, Florent Lamiraux",
            "BSD-3-Clause",
            "https://github.com/coal-library/coal",
            "Montaut et al.: Collision Detection Accelerated: An Optimization Perspective, RSS 2022",
            DISTANCE | CONTACTS,
            0,
            {whole("bv", "Bounding volume: 0 OBB (no distances), 1 RSS (slow collision queries), 2 OBBRSS, 3 kIOS.", 0, 3, 2),
             real("gjk_tolerance", "Where GJK stops, in the meshes' unit of length; Coal's own default is 1e-6.", 1e-15, 1, 1e-9),
             whole("enable_contact", "1: a collision query also computes contact point and depth, as Coal's default does.", 0, 1, 0)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Coal>(); }
