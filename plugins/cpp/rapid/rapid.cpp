// SPDX-License-Identifier: MIT OR Apache-2.0
//
// RAPID, built against your own copy: trees of oriented bounding boxes.
#include "wrapper.hpp"

#include <RAPID.H>

namespace {

using namespace ocb;

struct Model : Object {
    RAPID_model model;
};

struct Place {
    double rotation[3][3], translation[3];

    explicit Place(Pose pose) {
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) rotation[row][column] = pose.rotation(row, column);
            translation[row] = pose.translation(row);
        }
    }
};

class Rapid : public Algorithm {
  public:
    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto object = std::make_unique<Model>();
        object->model.BeginModel();
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            Triangle t = mesh.triangle(i);
            object->model.AddTri(t[0].data(), t[1].data(), t[2].data(), static_cast<int>(i));
        }
        if (object->model.EndModel() != RAPID_OK) throw std::runtime_error("RAPID could not build its tree");
        return object;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        ask(a, pose_a, b, pose_b, RAPID_FIRST_CONTACT);
        if (RAPID_num_contacts == 0) return false;
        pair = {static_cast<uint32_t>(RAPID_contact[0].id1), static_cast<uint32_t>(RAPID_contact[0].id2)};
        return true;
    }

    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        ask(a, pose_a, b, pose_b, RAPID_ALL_CONTACTS);
        for (int i = 0; i < RAPID_num_contacts; i++)
            out.add(static_cast<uint32_t>(RAPID_contact[i].id1), static_cast<uint32_t>(RAPID_contact[i].id2));
    }

  private:
    static void ask(Object &a, Pose pose_a, Object &b, Pose pose_b, int which) {
        Place place_a(pose_a), place_b(pose_b);
        if (RAPID_Collide(place_a.rotation, place_a.translation, &static_cast<Model &>(a).model, place_b.rotation,
                          place_b.translation, &static_cast<Model &>(b).model, which) != RAPID_OK)
            throw std::runtime_error("RAPID_Collide failed");
    }
};

} // namespace

ocb::About ocb::about() {
    return {"rapid",
            "RAPID",
            "2.01",
            "Stefan Gottschalk, Ming C. Lin, Dinesh Manocha",
            "LicenseRef-RAPID",
            "http://gamma.cs.unc.edu/OBB/",
            "Gottschalk, Lin, Manocha: OBBTree: A Hierarchical Structure for Rapid Interference Detection, SIGGRAPH 1996",
            CONTACTS,
            0,
            {}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Rapid>(); }
