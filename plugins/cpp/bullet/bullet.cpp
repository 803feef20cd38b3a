// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Bullet's GImpact: its quantised box hierarchies name the pairs of triangles, its clipping test decides each.
#include <opencollbench/plugin.hpp>

#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>

namespace {

struct Shape {
    // Bullet keeps pointers to both.
    std::vector<double> positions;
    std::vector<int> corners;
    btTriangleIndexVertexArray arrays;
    std::unique_ptr<btGImpactMeshShape> shape;

    Shape(const ocb::Mesh &mesh, double margin)
        : positions(mesh.positions, mesh.positions + 3 * size_t{mesh.vertex_count}),
          corners(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count}) {
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
    Shape(const Shape &) = delete;

    btGImpactMeshShapePart &part() { return *shape->getMeshPart(0); }
};

btTransform transform(ocb::Pose pose) {
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

class Bullet {
  public:
    static constexpr bool scene = true;

    static ocb::About about() {
        return {"bullet" OCB_VARIANT,
                "Bullet (GImpact)" OCB_VARIANT,
                "3.24",
                "Erwin Coumans, Francisco Leon Najera",
                "Zlib",
                "https://github.com/bulletphysics/bullet3",
                nullptr,
                0,
                // Bullet does not report its tests between boxes.
                OCB_COUNTS_PRIMITIVE_TESTS | OCB_COUNTS_PER_TRIANGLE,
                {ocb::real("margin", "Shell around each triangle that counts as part of it, in the meshes' unit of length.",
                           0, 1e3, 0)}};
    }

    void set(const std::string &name, double value) {
        if (name == "margin") margin = value;
        else throw ocb::Unsupported("there is no parameter " + name);
    }

    Shape load(const ocb::Mesh &mesh) { return Shape(mesh, margin); }

    ocb::Collision collide(ocb::Placed<Shape> a, ocb::Placed<Shape> b, ocb::Work &work) {
        btGImpactMeshShapePart &part_a = a.object.part(), &part_b = b.object.part();
        const btTransform placed_a = transform(a.pose), placed_b = transform(b.pose);
        const Locked locked_a(part_a), locked_b(part_b);
        candidates.resizeNoInitialize(0);
        btGImpactQuantizedBvh::find_collision(part_a.getBoxSet(), placed_a, part_b.getBoxSet(), placed_b, candidates);
        for (int i = 0; i < candidates.size(); i++) {
            const auto first = static_cast<uint32_t>(candidates[i].m_index1);
            const auto second = static_cast<uint32_t>(candidates[i].m_index2);
            btPrimitiveTriangle of_a = triangle(part_a, candidates[i].m_index1, placed_a);
            btPrimitiveTriangle of_b = triangle(part_b, candidates[i].m_index2, placed_b);
            GIM_TRIANGLE_CONTACT contact;
            work.primitive_test(first, second);
            if (of_a.overlap_test_conservative(of_b) && of_a.find_triangle_collision_clip_method(of_b, contact))
                return ocb::Collision::pair(first, second);
        }
        return {};
    }

  private:
    double margin = 0;
    btPairSet candidates;
};

} // namespace

OCB_PLUGIN(Bullet)
