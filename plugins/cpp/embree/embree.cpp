// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Embree: rtcCollide names the pairs of triangles whose boxes overlap; the test of each pair is ours. It knows no placed
// objects, so B is moved into A's frame and its hierarchy is made to fit, anew for every query.
#include "triangles.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>

namespace {

using ocb::Pose, ocb::Triangle, ocb::Vector;

// A scene of one geometry, whose triangles may be moved. Embree's boxes are of float: they are rounded outwards.
class Scene {
  public:
    Scene(RTCDevice device, const std::vector<Triangle> &own, RTCBuildQuality again)
        : own(own), placed(own), scene(rtcNewScene(device)) {
        // Of scenes of low quality, each geometry has a hierarchy of its own, which is what can be fitted anew.
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryBuildQuality(geometry, again);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(own.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcCommitScene(scene);
    }
    ~Scene() {
        rtcReleaseGeometry(geometry);
        rtcReleaseScene(scene);
    }
    Scene(const Scene &) = delete;

    void move(Pose from, Pose to) {
        const auto into = [&](const Vector &p) {
            const Vector world = from(p);
            Vector moved{};
            for (int column = 0; column < 3; column++)
                for (int row = 0; row < 3; row++)
                    moved[column] += to.rotation(row, column) * (world[row] - to.translation(row));
            return moved;
        };
        for (size_t i = 0; i < own.size(); i++) placed[i] = {into(own[i][0]), into(own[i][1]), into(own[i][2])};
        rtcCommitGeometry(geometry);
        rtcCommitScene(scene);
    }

    const Triangle &triangle(size_t i) const { return placed[i]; }
    RTCScene handle() const { return scene; }

  private:
    static void bound(const RTCBoundsFunctionArguments *arguments) {
        const Triangle &t = static_cast<const Scene *>(arguments->geometryUserPtr)->placed[arguments->primID];
        const auto around = [&](int axis) { return std::minmax({t[0][axis], t[1][axis], t[2][axis]}); };
        const float most = std::numeric_limits<float>::max();
        const auto below = [&](double x) { return std::nextafterf(static_cast<float>(x), -most); };
        const auto above = [&](double x) { return std::nextafterf(static_cast<float>(x), most); };
        const std::pair<double, double> x = around(0), y = around(1), z = around(2);
        RTCBounds &box = *arguments->bounds_o;
        box.lower_x = below(x.first), box.lower_y = below(y.first), box.lower_z = below(z.first);
        box.upper_x = above(x.second), box.upper_y = above(y.second), box.upper_z = above(z.second);
    }

    const std::vector<Triangle> &own;
    std::vector<Triangle> placed;
    RTCScene scene;
    RTCGeometry geometry;
};

struct Model {
    std::vector<Triangle> triangles;
    // As object A, at rest, and as object B.
    Scene resting, moving;

    Model(RTCDevice device, const ocb::Mesh &mesh, RTCBuildQuality again)
        : triangles(all(mesh)), resting(device, triangles, again), moving(device, triangles, again) {
        if (const RTCError error = rtcGetDeviceError(device))
            throw std::runtime_error("Embree's error " + std::to_string(error));
    }

    static std::vector<Triangle> all(const ocb::Mesh &mesh) {
        std::vector<Triangle> triangles;
        for (uint32_t i = 0; i < mesh.triangle_count; i++) triangles.push_back(mesh.triangle(i));
        return triangles;
    }
};

class Embree {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"embree",
                "Embree (rtcCollide)",
                RTC_VERSION_STRING,
                "Ingo Wald, Sven Woop, Carsten Benthin, Gregory S. Johnson, Manfred Ernst",
                "Apache-2.0",
                "https://www.embree.org",
                "Wald et al.: Embree: A Kernel Framework for Efficient CPU Ray Tracing, SIGGRAPH 2014",
                0,
                // Embree does not report its tests between boxes.
                OCB_COUNTS_PRIMITIVE_TESTS | OCB_COUNTS_PER_TRIANGLE,
                {ocb::integer("rebuild", "1: build B's hierarchy anew for every query instead of fitting the old one.",
                              0, 1, 0)}};
    }

    Embree() : device(rtcNewDevice("threads=1,set_affinity=0,start_threads=0")) {
        if (!device) throw std::runtime_error("Embree makes no device");
    }
    ~Embree() { rtcReleaseDevice(device); }
    Embree(const Embree &) = delete;

    void set(const std::string &name, double value) {
        if (name == "rebuild") again = value != 0 ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_REFIT;
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    Model load(const ocb::Mesh &mesh) { return Model(device, mesh, again); }

    ocb::Collision collide(ocb::Placed<Model> a, ocb::Placed<Model> b, ocb::Work &work) {
        Question question{a.object.resting, b.object.moving, work, {}};
        b.object.moving.move(b.pose, a.pose);
        rtcCollide(question.a.handle(), question.b.handle(), test, &question);
        return question.found;
    }

  private:
    struct Question {
        const Scene &a, &b;
        ocb::Work &work;
        ocb::Collision found;
    };

    // Embree cannot be told to stop; after the first pair the rest is not looked at.
    static void test(void *user, RTCCollision *candidates, unsigned count) {
        Question &question = *static_cast<Question *>(user);
        for (unsigned i = 0; i < count && !question.found.hit; i++) {
            const uint32_t a = candidates[i].primID0, b = candidates[i].primID1;
            question.work.primitive_test(a, b);
            if (ocb::meet(question.a.triangle(a), question.b.triangle(b))) question.found = ocb::Collision::pair(a, b);
        }
    }

    RTCDevice device;
    RTCBuildQuality again = RTC_BUILD_QUALITY_REFIT;
};

} // namespace

OCB_PLUGIN(Embree)
