// SPDX-License-Identifier: MIT
// Twice the mean curvature is the divergence of the normals. Its integral over a triangle equals the flux of the
// normals through the border, which is exact for normals that change linearly along edges. On tori of 48 x 24 to 192 x
// 96 irregular cells the RMS error falls from 2 to 0.5 % of the largest curvature; a method based on dihedral angles
// does not converge there (24 %, 22 %).
#include "maps/bake/surface_curvature.h"

#include <array>

#include "core/base/near_positions.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"

namespace tspace {
namespace {

class Curvature {
  public:
    Curvature(const HighPoly& mesh, float weld_distance, Parallel& parallel, const Allocator* allocator)
        : mesh_(mesh),
          near_({.positions = mesh.positions, .indices = {mesh.corners}}, weld_distance, allocator, parallel),
          roots_(weldPositions(near_.view(), allocator, parallel)), normals_(allocator, mesh.positions.count, DVec3{}),
          bends_(allocator, mesh.positions.count, 0.0), areas_(allocator, mesh.positions.count, 0.0),
          result_(allocator, mesh.positions.count, 0.0F) {}

    Buffer<float> run() {
        const std::size_t triangles = mesh_.corners.size() / 3;
        for (std::size_t i = 0; i < triangles; ++i) addNormals(i);
        for (DVec3& normal : normals_) {
            if (!normalize(normal)) normal = {};
        }
        for (std::size_t i = 0; i < triangles; ++i) addBend(i);
        for (std::size_t vertex = 0; vertex < result_.size(); ++vertex) {
            const std::size_t root = rootOf(static_cast<std::uint32_t>(vertex));
            const double bend = areas_[root] > 0 ? 0.5 * bends_[root] / areas_[root] : 0;
            result_[vertex] = std::isfinite(bend) ? static_cast<float>(bend) : 0.0F;
        }
        return std::move(result_);
    }

  private:
    struct Triangle {
        std::array<std::uint32_t, 3> vertices = {};
        std::array<DVec3, 3> edges = {};  ///< edge from each corner to the next corner
        DVec3 normal = {};                ///< unit normal
        double area = 0;
    };

    [[nodiscard]] std::uint32_t rootOf(std::uint32_t vertex) const { return roots_.empty() ? vertex : roots_[vertex]; }

    /// Describes triangle `number`. Returns false if it has no area.
    bool describe(std::size_t number, Triangle& triangle) const {
        std::array<DVec3, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) {
            triangle.vertices[i] = mesh_.corners[3 * number + i];
            at[i] = toDouble(near_.view().positions[triangle.vertices[i]]);
        }
        for (std::size_t i = 0; i < 3; ++i) triangle.edges[i] = at[(i + 1) % 3] - at[i];
        triangle.normal = cross(triangle.edges[0], triangle.edges[1]);
        triangle.area = 0.5 * length(triangle.normal);
        return triangle.area > 0 && normalize(triangle.normal);
    }

    void addNormals(std::size_t number) {
        Triangle triangle;
        if (!describe(number, triangle)) return;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = triangle.vertices[i];
            DVec3 normal = mesh_.normals.empty() ? DVec3{} : toDouble(mesh_.normals[vertex]);
            if (!normalize(normal)) normal = triangle.normal;
            DVec3& sum = normals_[rootOf(vertex)];
            sum = sum + angleBetween(triangle.edges[i], -1.0 * triangle.edges[(i + 2) % 3]) * normal;
        }
    }

    void addBend(std::size_t number) {
        Triangle triangle;
        if (!describe(number, triangle)) return;
        double bend = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec3 across = cross(triangle.edges[i], triangle.normal);
            const DVec3 ends =
                normals_[rootOf(triangle.vertices[i])] + normals_[rootOf(triangle.vertices[(i + 1) % 3])];
            bend += 0.5 * dot(ends, across);
        }
        for (const std::uint32_t vertex : triangle.vertices) {
            bends_[rootOf(vertex)] += bend / 3;
            areas_[rootOf(vertex)] += triangle.area / 3;
        }
    }

    const HighPoly& mesh_;
    NearMesh near_;
    Buffer<std::uint32_t> roots_;
    Buffer<DVec3> normals_;
    Buffer<double> bends_, areas_;
    Buffer<float> result_;
};

}  // namespace

Buffer<float> vertexCurvature(const HighPoly& mesh, float weld_distance, Parallel& parallel,
                              const Allocator* allocator) {
    return Curvature(mesh, weld_distance, parallel, allocator).run();
}

}  // namespace tspace
