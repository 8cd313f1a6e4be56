// SPDX-License-Identifier: MIT
// Projects points from world space to samples of a picture, and determines the visible triangle at each sample.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/vec_math.h"
#include "core/mesh/surface/affine.h"
#include "tspace/span.h"

namespace tspace {

// Projection from world space to samples.

/// Direction of the camera: yaw 0 and pitch 0 view from +z, yaw 90 from +x, pitch 90 from +y.
struct ViewAngles {
    double yaw_deg = 0, pitch_deg = 0;
};

/// A projected point. (x / w, y / w) are in samples from the upper left corner of the picture, to the right and down.
struct SeenPoint {
    double x = 0, y = 0, w = 1;
    /// Product of w and the nearness, which is linear in x / w and y / w, and increases toward the camera.
    double nearness_w = 0;
};

class Camera {
  public:
    /// Calls `visit` with each point that must be in the picture.
    using VisitPoints = std::function<void(const std::function<void(const DVec3&)>& visit)>;

    /// Returns a camera that shows all finite points, with a narrow margin. `field_of_view_deg`: along the shorter
    /// side, below 180; 0: orthographic. `width`, `height`: in samples.
    static Camera around(const VisitPoints& points, const ViewAngles& angles, double field_of_view_deg,
                         std::uint32_t width, std::uint32_t height);

    [[nodiscard]] SeenPoint see(const DVec3& point) const {
        const DVec3 from = point - eye_;
        const double x = scale_ * dot(from, right_), y = -scale_ * dot(from, up_), depth = -dot(from, back_);
        if (!is_perspective_) return {center_x_ + x, center_y_ + y, 1, -depth};
        return {center_x_ * depth + x, center_y_ * depth + y, depth, 1};
    }
    /// Returns the minimum w of visible points. Points with a smaller w are too close to the camera.
    [[nodiscard]] double minW() const { return min_w_; }

    [[nodiscard]] const DVec3& right() const { return right_; }
    [[nodiscard]] const DVec3& up() const { return up_; }
    /// Returns the direction from the scene to the eye.
    [[nodiscard]] const DVec3& back() const { return back_; }

  private:
    DVec3 right_{1, 0, 0}, up_{0, 1, 0}, back_{0, 0, 1}, eye_{};
    double center_x_ = 0, center_y_ = 0;
    double scale_ = 1;  ///< samples per unit; for a perspective camera, at distance 1
    double min_w_ = 0;
    bool is_perspective_ = true;
};

/// A mesh and its transform.
struct DrawnMesh {
    std::span<const Vec3> positions = {};
    std::span<const std::uint32_t> corners = {};  ///< three per triangle, each smaller than positions.size()
    Affine to_world = {};
    bool is_double_sided = false;
    /// Returns whether the surface is opaque at a point of a triangle. A null function means that it is opaque
    /// everywhere.
    std::function<bool(std::size_t triangle, const std::array<double, 3>& weights)> is_there = {};
};

/// Work limit of a picture; one step takes a few nanoseconds. Hostile models have huge numbers of triangles, each as
/// large as the picture. Throws FileError (tooLarge) at the limit.
class WorkLimit {
  public:
    explicit WorkLimit(std::uint64_t steps) : left_(steps) {}
    void spend(std::uint64_t steps);

  private:
    std::uint64_t left_;
};

/// A projected triangle without clipping: homogeneous, so that parts of it may lie behind the camera.
class SeenTriangle {
  public:
    explicit SeenTriangle(const std::array<SeenPoint, 3>& points);

    /// Returns whether the projected corners are in counterclockwise order.
    [[nodiscard]] bool isFront() const { return determinant_ < 0; }
    /// Returns false for triangles seen edge-on, and for triangles that are not finite.
    [[nodiscard]] bool isSeen() const { return determinant_ != 0 && std::isfinite(determinant_); }
    /// Returns the barycentric weights of a sample, perspective-correct: their sum is 1, and none is negative.
    [[nodiscard]] std::array<double, 3> weightsAt(double x, double y) const;
    /// Returns the coefficients (a, b, c) of the nearness a x + b y + c.
    [[nodiscard]] DVec3 nearness() const;

  private:
    std::array<SeenPoint, 3> points_;
    std::array<DVec3, 3> edges_;  ///< dot(edges[i], (x, y, 1)): unnormalized weight of corner i at (x, y)
    double determinant_ = 0;
};

/// Index of the visible triangle at each sample. Triangles are numbered consecutively over all meshes.
class VisibleTriangles {
  public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Place {
        std::size_t mesh = 0, triangle = 0;
    };

    /// Draws all meshes. Among triangles at equal distance the first is visible. Triangles that share an edge leave no
    /// gap, and cover no sample twice. Throws FileError: tooLarge for 2^32 - 1 triangles or more, and if `work_limit`
    /// is exhausted.
    VisibleTriangles(std::span<const DrawnMesh> meshes, const Camera& camera, std::uint32_t width, std::uint32_t height,
                     WorkLimit& work_limit);

    /// Returns a row of samples, counted from the top.
    [[nodiscard]] std::span<const std::uint32_t> row(std::uint32_t y) const {
        return std::span(triangles_).subspan(std::size_t{y} * width_, width_);
    }
    [[nodiscard]] Place placeOf(std::uint32_t number) const;
    [[nodiscard]] SeenTriangle seen(const Place& place) const;

  private:
    /// A triangle of which parts are drawn after clipping.
    struct Job {
        const DrawnMesh& mesh;
        const SeenTriangle& seen;
        DVec3 plane;  ///< plane equation of its nearness
        std::size_t triangle = 0;
        std::uint32_t number = 0;
    };
    void draw(std::size_t mesh, WorkLimit& work_limit);
    void drawTriangle(std::size_t mesh, std::size_t triangle, const std::array<SeenPoint, 3>& points,
                      WorkLimit& work_limit);
    void drawPart(const Job& job, const SeenPoint& a, const SeenPoint& b, const SeenPoint& c, WorkLimit& work_limit);

    std::span<const DrawnMesh> meshes_;
    Camera camera_;
    std::uint32_t width_, height_;
    std::vector<std::uint32_t> first_;  ///< per mesh: index of its first triangle
    std::vector<float> nearness_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace tspace
