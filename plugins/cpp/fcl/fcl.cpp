// SPDX-License-Identifier: MIT OR Apache-2.0
//
// FCL: one hierarchy of bounding volumes per mesh, of the kind that the parameter `bv` says, descended together.
#include "wrapper.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>

namespace {

using namespace ocb;

fcl::Transform3d transform(Pose pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) result.linear()(row, column) = pose.rotation(row, column);
        result.translation()(row) = pose.translation(row);
    }
    return result;
}

struct Model : Object {
    std::unique_ptr<fcl::CollisionGeometryd> geometry;
};

template <class Volume> std::unique_ptr<fcl::CollisionGeometryd> build(const Mesh &mesh) {
    std::vector<fcl::Vector3d> points(mesh.vertex_count);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) points[i] = fcl::Vector3d(mesh.positions + 3 * size_t{i});
    std::vector<fcl::Triangle> triangles(mesh.triangle_count);
    for (uint32_t i = 0; i < mesh.triangle_count; i++)
        triangles[i].set(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2));
    auto model = std::make_unique<fcl::BVHModel<Volume>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
    model->addSubModel(points, triangles);
    model->endModel();
    model->computeLocalAABB();
    return model;
}

const fcl::CollisionGeometryd *geometry(Object &object) { return static_cast<Model &>(object).geometry.get(); }

class Fcl : public Algorithm {
  public:
    void set(const std::string &name, double value) override {
        if (name == "bv") volume = static_cast<int>(value);
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto model = std::make_unique<Model>();
        model->geometry = volume == 0   ? build<fcl::OBBd>(mesh)
                          : volume == 1 ? build<fcl::RSSd>(mesh)
                          : volume == 2 ? build<fcl::OBBRSSd>(mesh)
                                        : build<fcl::kIOSd>(mesh);
        return model;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        const fcl::CollisionRequestd request(1, false);
        fcl::CollisionResultd result;
        fcl::collide(geometry(a), transform(pose_a), geometry(b), transform(pose_b), request, result);
        if (!result.isCollision()) return false;
        const fcl::Contactd &contact = result.getContact(0);
        pair = {static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2)};
        return true;
    }

    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        const fcl::CollisionRequestd request(std::numeric_limits<size_t>::max(), false);
        fcl::CollisionResultd result;
        fcl::collide(geometry(a), transform(pose_a), geometry(b), transform(pose_b), request, result);
        for (size_t i = 0; i < result.numContacts(); i++) {
            const fcl::Contactd &contact = result.getContact(i);
            out.add(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
        }
    }

    Distance distance(Object &a, Pose pose_a, Object &b, Pose pose_b) override {
        if (volume == 0) throw Unsupported("FCL has no distance between hierarchies of OBBs; choose another bv");
        // Nearest points asked for, no error allowed.
        const fcl::DistanceRequestd request(true, false, 0, 0);
        fcl::DistanceResultd result;
        fcl::distance(geometry(a), transform(pose_a), geometry(b), transform(pose_b), request, result);
        Distance found;
        found.value = std::max(result.min_distance, 0.0);
        found.triangles = {static_cast<uint32_t>(result.b1), static_cast<uint32_t>(result.b2)};
        // Of triangles that meet, FCL names two points that need not be a common one.
        found.has_points = found.value > 0;
        for (int k = 0; k < 3; k++) {
            found.a[k] = result.nearest_points[0][k];
            found.b[k] = result.nearest_points[1][k];
        }
        return found;
    }

  private:
    int volume = 2;
};

} // namespace

ocb::About ocb::about() {
    return {"fcl" OCB_VARIANT,
            "FCL" OCB_VARIANT,
            "0.7.0",
            "Jia Pan, Sachin Chitta, Dinesh Manocha",
            "BSD-3-Clause",
            "https://github.com/flexible-collision-library/fcl",
            "Pan, Chitta, Manocha: FCL: A General Purpose Library for Collision and Proximity Queries, ICRA 2012",
            DISTANCE | CONTACTS,
            0,
            {whole("bv", "Bounding volume: 0 OBB (no distances), 1 RSS (slow collision queries), 2 OBBRSS, 3 kIOS.", 0, 3, 2)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Fcl>(); }
