// SPDX-License-Identifier: MIT OR Apache-2.0
//
// FCL: one hierarchy of bounding volumes per mesh, of the kind that the parameter `bv` says, descended together.
#include <opencollbench/plugin.hpp>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>
#include <memory>

namespace {

using Model = std::unique_ptr<fcl::CollisionGeometryd>;

template <class Volume> Model build(const ocb::Mesh &mesh) {
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

fcl::Transform3d transform(ocb::Pose pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) result.linear()(row, column) = pose.rotation(row, column);
        result.translation()(row) = pose.translation(row);
    }
    return result;
}

ocb::Vector vector(const fcl::Vector3d &p) { return {p[0], p[1], p[2]}; }

class Fcl {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"fcl" OCB_VARIANT,
                "FCL" OCB_VARIANT,
                "0.7.0",
                "Jia Pan, Sachin Chitta, Dinesh Manocha",
                "BSD-3-Clause",
                "https://github.com/flexible-collision-library/fcl",
                "Pan, Chitta, Manocha: FCL: A General Purpose Library for Collision and Proximity Queries, ICRA 2012",
                0,
                0,
                {ocb::integer("bv",
                              "Bounding volume: 0 OBB (no distances), 1 RSS (slow collision queries), 2 OBBRSS, 3 kIOS.",
                              0, 3, 2)}};
    }

    void set(const std::string &name, double value) {
        if (name == "bv") volume = static_cast<int>(value);
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    // FCL has no distances between hierarchies of OBBs.
    bool answers(ocb::Query query) const { return volume != 0 || query != ocb::Query::distance; }

    Model load(const ocb::Mesh &mesh) {
        return volume == 0   ? build<fcl::OBBd>(mesh)
               : volume == 1 ? build<fcl::RSSd>(mesh)
               : volume == 2 ? build<fcl::OBBRSSd>(mesh)
                             : build<fcl::kIOSd>(mesh);
    }

    using Object = ocb::Placed<Model>;

    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        const fcl::CollisionResultd result = ask(a, b, 1);
        if (!result.isCollision()) return {};
        const fcl::Contactd &contact = result.getContact(0);
        return ocb::Collision::pair(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
    }

    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &) {
        const fcl::CollisionResultd result = ask(a, b, std::numeric_limits<size_t>::max());
        for (size_t i = 0; i < result.numContacts(); i++) {
            const fcl::Contactd &contact = result.getContact(i);
            found.add(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
        }
    }

    ocb::Distance distance(Object a, Object b, ocb::Work &) {
        // Nearest points asked for, no error allowed.
        const fcl::DistanceRequestd request(true, false, 0, 0);
        fcl::DistanceResultd result;
        fcl::distance(a.object.get(), transform(a.pose), b.object.get(), transform(b.pose), request, result);
        ocb::Distance found;
        found.distance = std::max(result.min_distance, 0.0);
        if (result.b1 >= 0) found.triangles = {static_cast<uint32_t>(result.b1), static_cast<uint32_t>(result.b2)};
        // Of triangles that meet, FCL names two points that need not be a common one.
        if (found.distance > 0) found.points = {vector(result.nearest_points[0]), vector(result.nearest_points[1])};
        return found;
    }

  private:
    static fcl::CollisionResultd ask(Object a, Object b, size_t most) {
        const fcl::CollisionRequestd request(most, false);
        fcl::CollisionResultd result;
        fcl::collide(a.object.get(), transform(a.pose), b.object.get(), transform(b.pose), request, result);
        return result;
    }

    int volume = 2;
};

} // namespace

OCB_PLUGIN(Fcl)
