// An ordinary program on FCL, which knows nothing of recorders: prints each of its answers, one a line.
//
//   robot ROUNDS [killed]
//
// With `killed` it ends itself by SIGKILL after the first rounds.
// Objects and geometries are asked, by one thread and by two, through a manager, with results that are used again, with a callback
// that throws through the library, and in a child process.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcl/fcl.h>
#include <memory>
#include <stdexcept>
#include <vector>

#include "robot.hpp"

namespace {

using Object = fcl::CollisionObjectd;

fcl::Transform3d pose() {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized().toRotationMatrix();
  pose.translation() << draw(-3, 3), draw(-3, 3), draw(-3, 3);
  return pose;
}

std::shared_ptr<fcl::CollisionGeometryd> ring(std::size_t n) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  make_ring<fcl::Vector3d, fcl::Triangle>(*model, n);
  return model;
}

bool collide(const Object &a, const Object &b, std::size_t most) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, fcl::CollisionRequestd(most), result) > 0;
}

double distance(const Object &a, const Object &b) {
  fcl::DistanceResultd result;
  return fcl::distance(&a, &b, fcl::DistanceRequestd(), result);
}

bool count(Object *a, Object *b, void *data) {
  *static_cast<int *>(data) += collide(*a, *b, 1);
  return false;
}

bool refuse(Object *, Object *, void *) { throw std::runtime_error("refused"); }

} // namespace

int main(int argc, char **argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 20;
  const bool killed = argc > 2 && std::strcmp(argv[2], "killed") == 0;
  Object mesh(ring(50)), other(ring(20));
  Object box(std::make_shared<fcl::Boxd>(0.5, 0.75, 1)), ball(std::make_shared<fcl::Sphered>(0.5));
  Object capsule(std::make_shared<fcl::Capsuled>(0.25, 1)), cone(std::make_shared<fcl::Coned>(0.5, 1));
  for (int i = 0; i < rounds; ++i) {
    for (Object *moving : {&other, &box, &ball, &capsule}) {
      moving->setTransform(pose());
      std::printf("collide %d\n", collide(mesh, *moving, i % 2 ? 1 : 5));
      std::printf("distance %.17g\n", distance(mesh, *moving));
    }
  }
  std::fflush(stdout);
  if (killed)
    std::raise(SIGKILL);
  // Of geometries, whose poses are no members of an object; then into a result that has a contact already.
  const fcl::Transform3d near = fcl::Transform3d::Identity();
  fcl::CollisionResultd result;
  for (int i = 0; i < 2; ++i) {
    fcl::collide(mesh.collisionGeometry().get(), near, other.collisionGeometry().get(), near, fcl::CollisionRequestd(), result);
    std::printf("%s %d\n", i == 0 ? "collide" : "again", result.isCollision());
  }

  std::vector<Object *> all{&mesh, &other, &box, &ball, &capsule};
  for (Object *object : all) {
    object->setTransform(near);
    object->computeAABB();
  }
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects(all);
  manager.setup();
  int hits = 0;
  manager.collide(&hits, count);
  std::printf("manager %d\n", hits);
  try {
    manager.collide(&hits, refuse);
  } catch (const std::runtime_error &error) {
    std::printf("thrown %s\n", error.what());
  }
  std::printf("unsupported %d\n", collide(mesh, cone, 1));

  return end_with_threads_and_a_child(rounds, [&](int who) { return collide(mesh, who < 2 ? *all[static_cast<std::size_t>(1 + who)] : ball, 1); });
}
