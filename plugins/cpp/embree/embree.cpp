// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Embree: rtcCollide names the pairs of triangles whose boxes overlap; the test of each pair is ours. It knows no placed
// objects, so B is moved into A's frame and its hierarchy is made to fit, anew for every query.
#include "triangles.hpp"
#include "wrapper.hpp"

#include <embree3/rtcore.h>

#include <limits>

namespace {

using namespace ocb;

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
        const auto below = [](double x) { return std::nextafterf(static_cast<float>(x), -std::numeric_limits<float>::max()); };
        const auto above = [](double x) { return std::nextafterf(static_cast<float>(x), std::numeric_limits<float>::max()); };
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

struct Model : Object {
    std::vector<Triangle> triangles;
    // As object A, at rest, and as object B.
    std::unique_ptr<Scene> resting, moving;
};

class Embree : public Algorithm {
  public:
    Embree() : device(rtcNewDevice("threads=1,set_affinity=0,start_threads=0")) {
        if (!device) throw std::runtime_error("Embree makes no device");
    }
    ~Embree() override { rtcReleaseDevice(device); }

    void set(const std::string &name, double value) override {
        if (name == "rebuild") again = value != 0 ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_REFIT;
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override {
        auto model = std::make_unique<Model>();
        for (uint32_t i = 0; i < mesh.triangle_count; i++) model->triangles.push_back(mesh.triangle(i));
        for (auto *scene : {&model->resting, &model->moving})
            *scene = std::make_unique<Scene>(device, model->triangles, again);
        if (const RTCError error = rtcGetDeviceError(device))
            throw std::runtime_error("Embree's error " + std::to_string(error));
        return model;
    }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        Question question{*static_cast<Model &>(a).resting, *static_cast<Model &>(b).moving, {}};
        question.b.move(pose_b, pose_a);
        rtcCollide(question.a.handle(), question.b.handle(), test, &question);
        pair = question.found;
        return pair.a != OCB_NO_TRIANGLE;
    }

  private:
    struct Question {
        const Scene &a;
        Scene &b;
        Pair found;
    };

    // Embree cannot be told to stop; after the first pair the rest is not looked at.
    static void test(void *user, RTCCollision *candidates, unsigned count) {
        Question &question = *static_cast<Question *>(user);
        for (unsigned i = 0; i < count && question.found.a == OCB_NO_TRIANGLE; i++) {
            const RTCCollision &c = candidates[i];
            if (meet(question.a.triangle(c.primID0), question.b.triangle(c.primID1))) question.found = {c.primID0, c.primID1};
        }
    }

    RTCDevice device;
    RTCBuildQuality again = RTC_BUILD_QUALITY_REFIT;
};

} // namespace

ocb::About ocb::about() {
    return {"embree",
            "Embree (rtcCollide)",
            RTC_VERSION_STRING,
            "Ingo Wald, Sven Woop, Carsten Benthin, Gregory S. Johnson, Manfred Ernst",
            "Apache-2.0",
            "https://www.embree.org",
            "Wald et al.: Embree: A Kernel Framework for Efficient CPU Ray Tracing, SIGGRAPH 2014",
            COLLIDE,
            0,
            {whole("rebuild", "1: build B's hierarchy anew for every query instead of fitting the old one.", 0, 1, 0)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Embree>(); }
