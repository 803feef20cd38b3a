// SPDX-License-Identifier: MIT OR Apache-2.0
//
// PQP, built against your own copy: trees of OBBs for collision, of rectangle swept spheres for distance.
#include <opencollbench/plugin.hpp>

#include <PQP.h>

namespace {

struct Model {
    PQP_Model model;

    explicit Model(const ocb::Mesh &mesh) {
        model.BeginModel(static_cast<int>(mesh.triangle_count));
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            PQP_REAL corners[3][3];
            for (int k = 0; k < 3; k++)
                for (int axis = 0; axis < 3; axis++) corners[k][axis] = mesh.triangle(i)[k][axis];
            model.AddTri(corners[0], corners[1], corners[2], static_cast<int>(i));
        }
        if (model.EndModel() != PQP_OK) throw std::runtime_error("PQP could not build its tree");
    }
    Model(const Model &) = delete;
};

struct Place {
    PQP_REAL rotation[3][3], translation[3];

    explicit Place(ocb::Pose pose) {
        for (int row = 0; row < 3; row++) {
            for (int column = 0; column < 3; column++) rotation[row][column] = pose.rotation(row, column);
            translation[row] = pose.translation(row);
        }
    }
};

class Pqp {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        const uint32_t precision = sizeof(PQP_REAL) == sizeof(float) ? OCB_CAPABILITY_SINGLE_PRECISION : 0;
        return {"pqp",
                "PQP",
                "1.3",
                "Eric Larsen, Stefan Gottschalk, Ming C. Lin, Dinesh Manocha",
                "LicenseRef-PQP",
                "http://gamma.cs.unc.edu/SSV/",
                "Larsen, Gottschalk, Lin, Manocha: Fast Proximity Queries with Swept Sphere Volumes, 1999",
                // A distance query begins at the pair of the one before.
                precision | OCB_CAPABILITY_COHERENT,
                OCB_COUNTS_BV_TESTS | OCB_COUNTS_PRIMITIVE_TESTS};
    }

    Model load(const ocb::Mesh &mesh) { return Model(mesh); }

    using Object = ocb::Placed<Model>;

    ocb::Collision collide(Object a, Object b, ocb::Work &work) {
        PQP_CollideResult result;
        ask(a, b, result, PQP_FIRST_CONTACT, work);
        if (result.NumPairs() == 0) return {};
        return ocb::Collision::pair(static_cast<uint32_t>(result.Id1(0)), static_cast<uint32_t>(result.Id2(0)));
    }

    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &work) {
        PQP_CollideResult result;
        ask(a, b, result, PQP_ALL_CONTACTS, work);
        for (int i = 0; i < result.NumPairs(); i++)
            found.add(static_cast<uint32_t>(result.Id1(i)), static_cast<uint32_t>(result.Id2(i)));
    }

    ocb::Distance distance(Object a, Object b, ocb::Work &work) {
        Place place_a(a.pose), place_b(b.pose);
        PQP_DistanceResult result;
        if (PQP_Distance(&result, place_a.rotation, place_a.translation, &a.object.model, place_b.rotation,
                         place_b.translation, &b.object.model, 0, 0) != PQP_OK)
            throw std::runtime_error("PQP_Distance failed");
        count(result, work);
        ocb::Distance found;
        found.distance = result.Distance();
        // Each point is in its own object's frame.
        if (found.distance > 0) found.points = {a.pose(vector(result.P1())), b.pose(vector(result.P2()))};
        return found;
    }

  private:
    static void ask(Object a, Object b, PQP_CollideResult &result, int which, ocb::Work &work) {
        Place place_a(a.pose), place_b(b.pose);
        if (PQP_Collide(&result, place_a.rotation, place_a.translation, &a.object.model, place_b.rotation,
                        place_b.translation, &b.object.model, which) != PQP_OK)
            throw std::runtime_error("PQP_Collide failed");
        count(result, work);
    }

    template <class Result> static void count(Result &result, ocb::Work &work) {
        work.bv_tests(result.NumBVTests());
        work.primitive_tests(result.NumTriTests());
    }

    static ocb::Vector vector(const PQP_REAL *p) { return {p[0], p[1], p[2]}; }
};

} // namespace

OCB_PLUGIN(Pqp)
