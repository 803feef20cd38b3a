// SPDX-License-Identifier: MIT OR Apache-2.0
//
// RAPID, built against your own copy: trees of oriented bounding boxes.
#include <opencollbench/plugin.hpp>

#include <RAPID.H>

namespace {

struct Model {
    RAPID_model model;

    explicit Model(const ocb::Mesh &mesh) {
        model.BeginModel();
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            ocb::Triangle t = mesh.triangle(i);
            model.AddTri(t[0].data(), t[1].data(), t[2].data(), static_cast<int>(i));
        }
        if (model.EndModel() != RAPID_OK) throw std::runtime_error("RAPID could not build its tree");
    }
    Model(const Model &) = delete;
};

struct Place {
    double rotation[3][3], translation[3];

    explicit Place(ocb::Pose pose) {
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) rotation[row][column] = pose.rotation(row, column);
            translation[row] = pose.translation(row);
        }
    }
};

class Rapid {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"rapid",
                "RAPID",
                "2.01",
                "Stefan Gottschalk, Ming C. Lin, Dinesh Manocha",
                "LicenseRef-RAPID",
                "http://gamma.cs.unc.edu/OBB/",
                "Gottschalk, Lin, Manocha: OBBTree: A Hierarchical Structure for Rapid Interference Detection, "
                "SIGGRAPH 1996",
                0,
                OCB_COUNTS_BV_TESTS | OCB_COUNTS_PRIMITIVE_TESTS};
    }

    Model load(const ocb::Mesh &mesh) { return Model(mesh); }

    using Object = ocb::Placed<Model>;

    ocb::Collision collide(Object a, Object b, ocb::Work &work) {
        ask(a, b, RAPID_FIRST_CONTACT, work);
        if (RAPID_num_contacts == 0) return {};
        const collision_pair &met = RAPID_contact[0];
        return ocb::Collision::pair(static_cast<uint32_t>(met.id1), static_cast<uint32_t>(met.id2));
    }

    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &work) {
        ask(a, b, RAPID_ALL_CONTACTS, work);
        for (int i = 0; i < RAPID_num_contacts; i++)
            found.add(static_cast<uint32_t>(RAPID_contact[i].id1), static_cast<uint32_t>(RAPID_contact[i].id2));
    }

  private:
    static void ask(Object a, Object b, int which, ocb::Work &work) {
        Place place_a(a.pose), place_b(b.pose);
        if (RAPID_Collide(place_a.rotation, place_a.translation, &a.object.model, place_b.rotation, place_b.translation,
                          &b.object.model, which) != RAPID_OK)
            throw std::runtime_error("RAPID_Collide failed");
        work.bv_tests(RAPID_num_box_tests);
        work.primitive_tests(RAPID_num_tri_tests);
    }
};

} // namespace

OCB_PLUGIN(Rapid)
