// SPDX-License-Identifier: MIT OR Apache-2.0
//
// V-COLLIDE, built against your own copy: many bodies, of which two at a time are active; between them it is RAPID.
#include "wrapper.hpp"

#include <VCollide.H>

namespace {

using namespace ocb;

struct Body : Object {
    // The same object may be both objects of a query.
    int as_a = 0, as_b = 0;
};

class VCollideWrapper : public Algorithm {
  public:
    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto body = std::make_unique<Body>();
        for (int *id : {&body->as_a, &body->as_b}) {
            done(bodies.NewObject(id), "NewObject");
            for (uint32_t i = 0; i < mesh.triangle_count; i++) {
                Triangle t = mesh.triangle(i);
                done(bodies.AddTri(t[0].data(), t[1].data(), t[2].data(), static_cast<int>(i)), "AddTri");
            }
            done(bodies.EndObject(), "EndObject");
            done(bodies.DeactivateObject(*id), "DeactivateObject");
        }
        return body;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &) override {
        VCReport report;
        ask(a, pose_a, b, pose_b, report, VC_FIRST_CONTACT);
        return report.numObjPairs() > 0;
    }

    void contacts(Object &a, Pose pose_a, Object &b, Pose pose_b, Contacts &out) override {
        VCReport report;
        ask(a, pose_a, b, pose_b, report, VC_ALL_CONTACTS);
        for (int pair = 0; pair < report.numObjPairs(); pair++) {
            const bool in_order = report.obj1ID(pair) == static_cast<Body &>(a).as_a;
            for (int i = 0; i < report.numTriPairs(pair); i++) {
                const auto first = static_cast<uint32_t>(report.tri1ID(pair, i));
                const auto second = static_cast<uint32_t>(report.tri2ID(pair, i));
                in_order ? out.add(first, second) : out.add(second, first);
            }
        }
    }

  private:
    void ask(Object &a, Pose pose_a, Object &b, Pose pose_b, VCReport &report, int which) {
        const int first = static_cast<Body &>(a).as_a, second = static_cast<Body &>(b).as_b;
        place(first, pose_a);
        place(second, pose_b);
        for (int id : {first, second}) done(bodies.ActivateObject(id), "ActivateObject");
        done(bodies.Collide(&report, which), "Collide");
        for (int id : {first, second}) done(bodies.DeactivateObject(id), "DeactivateObject");
    }

    void place(int id, Pose pose) {
        double matrix[4][4];
        for (int i = 0; i < 16; i++) matrix[i / 4][i % 4] = pose.m[i];
        done(bodies.UpdateTrans(id, matrix), "UpdateTrans");
    }

    static void done(int code, const char *what) {
        if (code < 0) throw std::runtime_error(std::string("V-COLLIDE's ") + what + " failed: " + std::to_string(code));
    }

    VCollide bodies;
};

} // namespace

ocb::About ocb::about() {
    return {"v-collide",
            "V-COLLIDE",
            "2.01",
            "Thomas C. Hudson, Ming C. Lin, Jonathan Cohen, Stefan Gottschalk, Dinesh Manocha",
            "LicenseRef-V-COLLIDE",
            "http://gamma.cs.unc.edu/V-COLLIDE/",
            "Hudson et al.: V-COLLIDE: Accelerated Collision Detection for VRML, 1997",
            CONTACTS,
            // Its sorted lists of boxes follow the movements.
            OCB_CAPABILITY_COHERENT,
            {}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<VCollideWrapper>(); }
