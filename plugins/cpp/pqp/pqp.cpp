// SPDX-License-Identifier: MIT OR Apache-2.0
//
// PQP, built against your own copy: trees of OBBs for collision, of rectangle swept spheres for distance.
#include "wrapper.hpp"

#include <PQP.h>

namespace {

using namespace ocb;

struct Model : Object {
    PQP_Model model;
};

struct Place {
    PQP_REAL rotation[3][3], translation[3];

    explicit Place(Pose pose) {
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) rotation[row][column] = pose.rotation(row, column);
            translation[row] = pose.translation(row);
        }
    }
};

class Pqp : public Algorithm {
  public:
    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto object = std::make_unique<Model>();
        object->model.BeginModel(static_cast<int>(mesh.triangle_count));
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            PQP_REAL corners[3][3];
            for (int k = 0; k < 3; k++)
                for (int axis = 0; axis < 3; axis++) corners[k][axis] = mesh.triangle(i)[k][axis];
            object->model.AddTri(corners[0], corners[1], corners[2], static_cast<int>(i));
        }
        if (object->model.EndModel() != PQP_OK) throw std::runtime_error("PQP could not build its tree");
        return object;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        PQP_CollideResult result;
        ask(a, pose_a, b, pose_b, result, PQP_FIRST_CONTACT);
        if (result.NumPairs() == 0) return false;
        pair = {static_cast<uint32_t>(result.Id1(0)), static_cast<uint32_t>(result.Id2(0))};
        return true;
    }

    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        PQP_CollideResult result;
        ask(a, pose_a, b, pose_b, result, PQP_ALL_CONTACTS);
        for (int i = 0; i < result.NumPairs(); i++)
            out.add(static_cast<uint32_t>(result.Id1(i)), static_cast<uint32_t>(result.Id2(i)));
    }

    Distance distance(Object &a, Pose pose_a, Object &b, Pose pose_b) override {
        Place place_a(pose_a), place_b(pose_b);
        PQP_DistanceResult result;
        if (PQP_Distance(&result, place_a.rotation, place_a.translation, &static_cast<Model &>(a).model,
                         place_b.rotation, place_b.translation, &static_cast<Model &>(b).model, 0, 0) != PQP_OK)
            throw std::runtime_error("PQP_Distance failed");
        Distance found;
        found.value = result.Distance();
        // Each point is in its own object's frame.
        found.has_points = found.value > 0;
        found.a = pose_a(Vector{result.P1()[0], result.P1()[1], result.P1()[2]});
        found.b = pose_b(Vector{result.P2()[0], result.P2()[1], result.P2()[2]});
        return found;
    }

  private:
    static void ask(Object &a, Pose pose_a, Object &b, Pose pose_b, PQP_CollideResult &result, int which) {
        Place place_a(pose_a), place_b(pose_b);
        if (PQP_Collide(&result, place_a.rotation, place_a.translation, &static_cast<Model &>(a).model,
                        place_b.rotation, place_b.translation, &static_cast<Model &>(b).model, which) != PQP_OK)
            throw std::runtime_error("PQP_Collide failed");
    }
};

} // namespace

ocb::About ocb::about() {
    const uint32_t precision = sizeof(PQP_REAL) == sizeof(float) ? OCB_CAPABILITY_SINGLE_PRECISION : 0;
    return {"pqp",
            "PQP",
            "1.3",
            "Eric Larsen, Stefan Gottschalk, Ming C. Lin, Dinesh Manocha",
            "LicenseRef-PQP",
            "http://gamma.cs.unc.edu/SSV/",
            "Larsen, Gottschalk, Lin, Manocha: Fast Proximity Queries with Swept Sphere Volumes, 1999",
            DISTANCE | CONTACTS,
            // A distance query begins at the pair of the one before.
            precision | OCB_CAPABILITY_COHERENT,
            {}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Pqp>(); }
