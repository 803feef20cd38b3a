// SPDX-License-Identifier: MIT OR Apache-2.0
//
// coal (formerly hpp-fcl): hierarchies as in FCL, triangles compared by GJK.
#include <opencollbench/plugin.hpp>

#include <coal/BVH/BVH_model.h>
#include <coal/collision.h>
#include <coal/distance.h>

#include <limits>
#include <memory>

namespace {

using Model = std::unique_ptr<coal::CollisionGeometry>;

template <class Volume> Model build(const ocb::Mesh &mesh) {
    std::vector<coal::Vec3s> points(mesh.vertex_count);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        const ocb::Vector p = mesh.vertex(i);
        points[i] = coal::Vec3s(p[0], p[1], p[2]);
    }
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

coal::Transform3s transform(ocb::Pose pose) {
    coal::Matrix3s rotation;
    coal::Vec3s translation;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) rotation(row, column) = pose.rotation(row, column);
        translation(row) = pose.translation(row);
    }
    return {rotation, translation};
}

ocb::Vector vector(const coal::Vec3s &p) { return {p[0], p[1], p[2]}; }

class Coal {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"coal" OCB_VARIANT,
                "Coal" OCB_VARIANT,
                "3.0.3",
                "Louis Montaut, Justin Carpentier, Joseph Mirabel, Florent Lamiraux",
                "BSD-3-Clause",
                "https://github.com/coal-library/coal",
                "Montaut et al.: Collision Detection Accelerated: An Optimization Perspective, RSS 2022",
                0,
                0,
                {ocb::integer("bv",
                              "Bounding volume: 0 OBB (no distances), 1 RSS (slow collision queries), 2 OBBRSS, 3 kIOS.",
                              0, 3, 2),
                 ocb::real("gjk_tolerance", "Where GJK stops, in the meshes' unit of length; Coal's own default is 1e-6.",
                           1e-15, 1, 1e-9),
                 ocb::integer("enable_contact",
                              "1: a collision query also computes contact point and depth, as Coal's default does.",
                              0, 1, 0)}};
    }

    void set(const std::string &name, double value) {
        if (name == "bv") volume = static_cast<int>(value);
        else if (name == "gjk_tolerance") tolerance = value;
        else if (name == "enable_contact") enable_contact = value != 0;
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    // Coal has no distances between hierarchies of OBBs.
    bool answers(ocb::Query query) const { return volume != 0 || query != ocb::Query::distance; }

    Model load(const ocb::Mesh &mesh) {
        return volume == 0   ? build<coal::OBB>(mesh)
               : volume == 1 ? build<coal::RSS>(mesh)
               : volume == 2 ? build<coal::OBBRSS>(mesh)
                             : build<coal::kIOS>(mesh);
    }

    using Object = ocb::Placed<Model>;

    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        const coal::CollisionResult result = ask(a, b, 1);
        if (!result.isCollision()) return {};
        const coal::Contact &contact = result.getContact(0);
        return ocb::Collision::pair(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
    }

    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &) {
        const coal::CollisionResult result = ask(a, b, std::numeric_limits<size_t>::max());
        for (const coal::Contact &contact : result.getContacts())
            found.add(static_cast<uint32_t>(contact.b1), static_cast<uint32_t>(contact.b2));
    }

    ocb::Distance distance(Object a, Object b, ocb::Work &) {
        coal::DistanceRequest request(true, false, 0, 0);
        request.gjk_tolerance = tolerance;
        coal::DistanceResult result;
        coal::distance(a.object.get(), transform(a.pose), b.object.get(), transform(b.pose), request, result);
        ocb::Distance found;
        found.distance = std::max(result.min_distance, 0.0);
        if (result.b1 >= 0) found.triangles = {static_cast<uint32_t>(result.b1), static_cast<uint32_t>(result.b2)};
        if (found.distance > 0) found.points = {vector(result.nearest_points[0]), vector(result.nearest_points[1])};
        return found;
    }

  private:
    coal::CollisionResult ask(Object a, Object b, size_t most) const {
        coal::CollisionRequest request(coal::NO_REQUEST, most);
        request.enable_contact = enable_contact;
        request.gjk_tolerance = tolerance;
        coal::CollisionResult result;
        coal::collide(a.object.get(), transform(a.pose), b.object.get(), transform(b.pose), request, result);
        return result;
    }

    int volume = 2;
    double tolerance = 1e-9;
    bool enable_contact = false;
};

} // namespace

OCB_PLUGIN(Coal)
