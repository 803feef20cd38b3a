// An ordinary program on Coal, which knows nothing of recorders: prints each of its answers, one a line.
//
//   coal_robot ROUNDS [killed]
//
// With `killed` it ends itself by SIGKILL after the first rounds.
// Objects, geometries and pairs for repeated queries are asked, through a manager, with results that are used again, with a
// callback that throws through the library, by two threads, and in a child process.
#include <coal/BVH/BVH_model.h>
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/collision.h>
#include <coal/distance.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

#include "robot.hpp"

namespace {

using coal::CollisionObject;
using coal::Transform3s;

Transform3s pose() {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized();
  return Transform3s(turn.toRotationMatrix(), coal::Vec3s(draw(-3, 3), draw(-3, 3), draw(-3, 3)));
}

std::shared_ptr<coal::CollisionGeometry> ring(std::size_t n) {
  auto model = std::make_shared<coal::BVHModel<coal::OBBRSS>>();
  make_ring<coal::Vec3s, coal::Triangle>(*model, n);
  return model;
}

// A tetrahedron as a convex body.
std::shared_ptr<coal::CollisionGeometry> wedge() {
  const auto points = std::make_shared<std::vector<coal::Vec3s>>(
      std::vector<coal::Vec3s>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const auto faces = std::make_shared<std::vector<coal::Triangle>>(
      std::vector<coal::Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  return std::make_shared<coal::Convex<coal::Triangle>>(points, 4, faces, 4);
}

bool collide(const CollisionObject &a, const CollisionObject &b, std::size_t most, double margin = 0) {
  coal::CollisionRequest request(coal::CONTACT, most);
  request.security_margin = margin;
  coal::CollisionResult result;
  return coal::collide(&a, &b, request, result) > 0;
}

double distance(const CollisionObject &a, const CollisionObject &b) {
  coal::DistanceResult result;
  return coal::distance(&a, &b, coal::DistanceRequest(), result);
}

struct Count : coal::CollisionCallBackBase {
  int hits = 0;
  bool collide(CollisionObject *a, CollisionObject *b) override {
    hits += ::collide(*a, *b, 1);
    return false;
  }
};

struct Refuse : coal::CollisionCallBackBase {
  bool collide(CollisionObject *, CollisionObject *) override { throw std::runtime_error("refused"); }
};

} // namespace

int main(int argc, char **argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 20;
  const bool killed = argc > 2 && std::strcmp(argv[2], "killed") == 0;
  CollisionObject mesh(ring(50)), other(ring(20)), convex(wedge());
  CollisionObject box(std::make_shared<coal::Box>(0.5, 0.75, 1)), ball(std::make_shared<coal::Sphere>(0.5));
  CollisionObject capsule(std::make_shared<coal::Capsule>(0.25, 1)), cylinder(std::make_shared<coal::Cylinder>(0.25, 1));
  for (int i = 0; i < rounds; ++i)
    for (CollisionObject *moving : {&other, &box, &ball, &capsule, &cylinder}) {
      moving->setTransform(pose());
      std::printf("collide %d\n", collide(mesh, *moving, i % 2 ? 1 : 5));
      std::printf("tolerance %d\n", collide(mesh, *moving, 1, 0.25));
      std::printf("distance %.17g\n", distance(mesh, *moving));
    }
  std::fflush(stdout);
  if (killed)
    std::raise(SIGKILL);
  // Of geometries, whose poses are no members of an object, and of pairs for repeated queries; then into a result with a contact.
  const Transform3s near = Transform3s::Identity();
  const coal::CollisionGeometry *one = mesh.collisionGeometryPtr(), *two = box.collisionGeometryPtr();
  const coal::ComputeCollision compute_collision(one, two);
  const coal::ComputeDistance compute_distance(two, one);
  for (int i = 0; i < 5; ++i) {
    const Transform3s there = pose();
    coal::CollisionResult of_geometries, of_pair;
    coal::DistanceResult far_geometries, far_pair;
    coal::collide(one, near, two, there, coal::CollisionRequest(), of_geometries);
    std::printf("collide %d\n", of_geometries.isCollision());
    std::printf("collide %d\n", compute_collision(near, there, coal::CollisionRequest(), of_pair) > 0);
    std::printf("distance %.17g\n", coal::distance(one, near, two, there, coal::DistanceRequest(), far_geometries));
    std::printf("distance %.17g\n", compute_distance(there, near, coal::DistanceRequest(), far_pair));
  }
  coal::CollisionResult result;
  const coal::CollisionGeometry *small = other.collisionGeometryPtr();
  for (int i = 0; i < 2; ++i) {
    coal::collide(one, near, small, near, coal::CollisionRequest(), result);
    std::printf("%s %d\n", i == 0 ? "collide" : "again", result.isCollision());
  }

  std::vector<CollisionObject *> all{&mesh, &other, &box, &ball, &capsule};
  for (CollisionObject *object : all) {
    object->setTransform(near);
    object->computeAABB();
  }
  coal::DynamicAABBTreeCollisionManager manager;
  manager.registerObjects(all);
  manager.setup();
  Count count;
  manager.collide(&count);
  std::printf("manager %d\n", count.hits);
  try {
    Refuse refuse;
    manager.collide(&refuse);
  } catch (const std::runtime_error &error) {
    std::printf("thrown %s\n", error.what());
  }
  // Of a convex body that it hits, no answer; then what is not recorded.
  std::printf("convex %d\n", collide(mesh, convex, 1));
  CollisionObject cone(std::make_shared<coal::Cone>(0.5, 1));
  auto swept = std::make_shared<coal::Sphere>(0.5);
  swept->setSweptSphereRadius(0.1);
  CollisionObject round(swept);
  std::printf("unsupported %d %d %d\n", collide(mesh, cone, 1), collide(box, round, 1), collide(box, ball, 1, -0.01));

  return end_with_threads_and_a_child(rounds, [&](int who) { return collide(mesh, who < 2 ? *all[static_cast<std::size_t>(1 + who)] : ball, 1); });
}
