// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Bullet's GImpact: its quantised box hierarchies name the pairs of triangles, its clipping test decides each.
#include "wrapper.hpp"

#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

namespace {

using namespace ocb;

struct Shape : Object {
    // Bullet keeps pointers to both.
    std::vector<double> positions;
    std::vector<int> corners;
    btTriangleIndexVertexArray arrays;
    std::unique_ptr<btGImpactMeshShape> shape;

    Shape(const Mesh &mesh, double margin)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          corners(mesh.corners, mesh.corners + 3 * size_t{mesh.triangle_count}) {
        btIndexedMesh indexed;
        indexed.m_numTriangles = static_cast<int>(mesh.triangle_count);
        indexed.m_triangleIndexBase = reinterpret_cast<const unsigned char *>(corners.data());
        indexed.m_triangleIndexStride = 3 * sizeof(int);
        indexed.m_numVertices = static_cast<int>(mesh.vertex_count);
        indexed.m_vertexBase = reinterpret_cast<const unsigned char *>(positions.data());
        indexed.m_vertexStride = 3 * sizeof(double);
        indexed.m_vertexType = PHY_DOUBLE;
        arrays.addIndexedMesh(indexed, PHY_INTEGER);
        shape = std::make_unique<btGImpactMeshShape>(&arrays);
        shape->setMargin(margin);
        shape->updateBound();
    }

    btGImpactMeshShapePart &part() { return *shape->getMeshPart(0); }
};

btTransform transform(Pose pose) {
    btMatrix3x3 basis;
    btVector3 origin;
    for (int row = 0; row < 3; row++) {
        basis[row].setValue(pose.rotation(row, 0), pose.rotation(row, 1), pose.rotation(row, 2));
        origin[row] = pose.translation(row);
    }
    return btTransform(basis, origin);
}

btPrimitiveTriangle triangle(btGImpactMeshShapePart &part, int index, const btTransform &placed) {
    btPrimitiveTriangle result;
    part.getPrimitiveTriangle(index, result);
    result.applyTransform(placed);
    result.buildTriPlane();
    return result;
}

// While triangles are read, Bullet wants the arrays locked.
struct Locked {
    btGImpactMeshShapePart &part;
    explicit Locked(btGImpactMeshShapePart &part) : part(part) { part.lockChildShapes(); }
    ~Locked() { part.unlockChildShapes(); }
};

class Bullet : public Algorithm {
  public:
    void set(const std::string &name, double value) override {
        if (name == "margin") margin = value;
        else Algorithm::set(name, value);
    }

    std::unique_ptr<Object> load(const Mesh &mesh) override { return std::make_unique<Shape>(mesh, margin); }

    bool collide(Object &a, Pose pose_a, Object &b, Pose pose_b, Pair &pair) override {
        btGImpactMeshShapePart &part_a = static_cast<Shape &>(a).part(), &part_b = static_cast<Shape &>(b).part();
        const btTransform placed_a = transform(pose_a), placed_b = transform(pose_b);
        const Locked locked_a(part_a), locked_b(part_b);
        candidates.resizeNoInitialize(0);
        btGImpactQuantizedBvh::find_collision(part_a.getBoxSet(), placed_a, part_b.getBoxSet(), placed_b, candidates);
        for (int i = 0; i < candidates.size(); i++) {
            const GIM_PAIR &candidate = candidates[i];
            btPrimitiveTriangle of_a = triangle(part_a, candidate.m_index1, placed_a);
            btPrimitiveTriangle of_b = triangle(part_b, candidate.m_index2, placed_b);
            GIM_TRIANGLE_CONTACT contact;
            if (of_a.overlap_test_conservative(of_b) && of_a.find_triangle_collision_clip_method(of_b, contact)) {
                pair = {static_cast<uint32_t>(candidate.m_index1), static_cast<uint32_t>(candidate.m_index2)};
                return true;
            }
        }
        return false;
    }

  private:
    double margin = 0;
    btPairSet candidates;
};

} // namespace

ocb::About ocb::about() {
    return {"bullet" OCB_VARIANT,
            "Bullet (GImpact)" OCB_VARIANT,
            "3.24",
            "Erwin Coumans, Francisco Leon Najera",
            "Zlib",
            "https://github.com/bulletphysics/bullet3",
            nullptr,
            COLLIDE,
            0,
            {real("margin", "Shell around each triangle that counts as part of it, in the meshes' unit of length.", 0, 1e3, 0)}};
}

std::unique_ptr<ocb::Algorithm> ocb::make() { return std::make_unique<Bullet>(); }
