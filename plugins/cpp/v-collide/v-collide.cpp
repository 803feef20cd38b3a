// SPDX-License-Identifier: MIT OR Apache-2.0
//
// V-COLLIDE, built against your own copy: many bodies, of which two at a time are active; between them it is RAPID.
#include <opencollbench/plugin.hpp>

#include <VCollide.H>

namespace {

struct Body {
    // The same object may be both objects of a query.
    int as_a, as_b;
};

class VCollideWrapper {
  public:
    static ocb::About about() {
        return {"v-collide",
                "V-COLLIDE",
                "2.01",
                "Thomas C. Hudson, Ming C. Lin, Jonathan Cohen, Stefan Gottschalk, Dinesh Manocha",
                "LicenseRef-V-COLLIDE",
                "http://gamma.cs.unc.edu/V-COLLIDE/",
                "Hudson et al.: V-COLLIDE: Accelerated Collision Detection for VRML, 1997",
                // Its sorted lists of boxes follow the movements.
                OCB_CAPABILITY_COHERENT};
    }

    Body load(const ocb::Mesh &mesh) { return {add(mesh), add(mesh)}; }

    using Object = ocb::Placed<Body>;

    ocb::Collision collide(Object a, Object b, ocb::Work &) {
        VCReport report;
        ask(a, b, report, VC_FIRST_CONTACT);
        return report.numObjPairs() > 0 ? ocb::Collision::somewhere() : ocb::Collision{};
    }

    void contacts(Object a, Object b, ocb::Contacts &found, ocb::Work &) {
        VCReport report;
        ask(a, b, report, VC_ALL_CONTACTS);
        for (int pair = 0; pair < report.numObjPairs(); pair++) {
            const bool in_order = report.obj1ID(pair) == a.object.as_a;
            for (int i = 0; i < report.numTriPairs(pair); i++) {
                const auto first = static_cast<uint32_t>(report.tri1ID(pair, i));
                const auto second = static_cast<uint32_t>(report.tri2ID(pair, i));
                in_order ? found.add(first, second) : found.add(second, first);
            }
        }
    }

  private:
    int add(const ocb::Mesh &mesh) {
        int id = 0;
        done(bodies.NewObject(&id), "NewObject");
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            ocb::Triangle t = mesh.triangle(i);
            done(bodies.AddTri(t[0].data(), t[1].data(), t[2].data(), static_cast<int>(i)), "AddTri");
        }
        done(bodies.EndObject(), "EndObject");
        done(bodies.DeactivateObject(id), "DeactivateObject");
        return id;
    }

    void ask(Object a, Object b, VCReport &report, int which) {
        const int first = a.object.as_a, second = b.object.as_b;
        place(first, a.pose);
        place(second, b.pose);
        for (int id : {first, second}) done(bodies.ActivateObject(id), "ActivateObject");
        done(bodies.Collide(&report, which), "Collide");
        for (int id : {first, second}) done(bodies.DeactivateObject(id), "DeactivateObject");
    }

    void place(int id, ocb::Pose pose) {
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

OCB_PLUGIN(VCollideWrapper)
