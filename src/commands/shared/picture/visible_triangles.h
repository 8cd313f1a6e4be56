// SPDX-License-Identifier: MIT
// Which triangle each sample of a picture sees.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "commands/shared/picture/camera.h"
#include "core/mesh/surface/affine.h"
#include "tspace/vec.h"

namespace tspace {

/// Triangles at one place.
struct DrawnMesh {
    std::span<const Vec3> positions = {};
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, each smaller than positions.size()
    Affine to_world = {};
    bool is_double_sided = false;
    /// Whether the surface is there at a point of a triangle; empty: everywhere.
    std::function<bool(std::size_t triangle, const std::array<double, 3>& weights)> is_there = {};
};

/// How much work a picture may take; one step takes some nanoseconds. Hostile models have no end of triangles, each as
/// large as the picture. Throws FileError (tooLarge) where it runs out.
class Effort {
  public:
    explicit Effort(std::uint64_t steps) : left_(steps) {}
    void spend(std::uint64_t steps);

  private:
    std::uint64_t left_;
};

/// A triangle as a camera sees it, without any clipping: homogeneous, so that it may lie behind the camera in part.
class SeenTriangle {
  public:
    explicit SeenTriangle(const std::array<SeenPoint, 3>& points);

    /// Its corners run counter-clockwise, as they are seen.
    [[nodiscard]] bool isFront() const { return determinant_ < 0; }
    /// False for triangles seen edge on, and for those that are not finite.
    [[nodiscard]] bool isSeen() const { return determinant_ != 0 && std::isfinite(determinant_); }
    /// The barycentric weights of the corners at a sample, in space: their sum is 1, and none is negative.
    [[nodiscard]] std::array<double, 3> weightsAt(double x, double y) const;
    /// Coefficients of the nearness: a x + b y + c.
    [[nodiscard]] DVec3 nearness() const;

  private:
    std::array<SeenPoint, 3> points_;
    std::array<DVec3, 3> edges_;  ///< dot(edges[i], (x, y, 1)): how much of corner i there is at (x, y)
    double determinant_ = 0;
};

/// The triangle that each sample sees, numbered through all meshes.
class VisibleTriangles {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Place {
        std::size_t mesh = 0, triangle = 0;
    };

    /// Draws all meshes. Of two triangles at one distance the first is seen. Neighbours that share an edge leave no gap
    /// and no sample twice. Throws FileError: tooLarge for 2^32 - 1 triangles or more, too, and where `effort` ends.
    VisibleTriangles(std::span<const DrawnMesh> meshes, const Camera& camera, std::uint32_t width, std::uint32_t height,
                     Effort& effort);

    /// Row by row from the top.
    [[nodiscard]] std::span<const std::uint32_t> row(std::uint32_t y) const {
        return std::span(triangles_).subspan(std::size_t{y} * width_, width_);
    }
    [[nodiscard]] Place placeOf(std::uint32_t number) const;
    [[nodiscard]] SeenTriangle seen(const Place& place) const;

  private:
    /// A triangle of which parts are drawn.
    struct Job {
        const DrawnMesh& mesh;
        const SeenTriangle& seen;
        DVec3 plane;  ///< of its nearness
        std::size_t triangle = 0;
        std::uint32_t number = 0;
    };
    void draw(std::size_t mesh, Effort& effort);
    void drawTriangle(std::size_t mesh, std::size_t triangle, const std::array<SeenPoint, 3>& points, Effort& effort);
    void drawPart(const Job& job, const SeenPoint& a, const SeenPoint& b, const SeenPoint& c, Effort& effort);

    std::span<const DrawnMesh> meshes_;
    Camera camera_;
    std::uint32_t width_, height_;
    std::vector<std::uint32_t> first_;  ///< per mesh: the number of its first triangle
    std::vector<float> nearness_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace tspace
