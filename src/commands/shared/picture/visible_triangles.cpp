// SPDX-License-Identifier: MIT
// Implements the camera, the rasterization of triangles with integer coordinates, and the depth test.
#include "commands/shared/picture/visible_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/vec_math.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Maximum share of the picture's width and height that the points fill.
constexpr double kFilled = 0.94;

struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = -least;

    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    [[nodiscard]] double center() const { return 0.5 * (least + most); }
    [[nodiscard]] double half() const { return 0.5 * (most - least); }
};

bool isFinitePoint(const DVec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

Camera Camera::around(const VisitPoints& points, const ViewAngles& angles, double field_of_view_deg,
                      std::uint32_t width, std::uint32_t height) {
    Camera camera;
    const SineCosine yaw = sineCosine(angles.yaw_deg * (kPi / 180)), pitch = sineCosine(angles.pitch_deg * (kPi / 180));
    camera.right_ = {yaw.cosine, 0, -yaw.sine};
    camera.back_ = {yaw.sine * pitch.cosine, pitch.sine, yaw.cosine * pitch.cosine};
    camera.up_ = cross(camera.back_, camera.right_);
    camera.center_x_ = 0.5 * width;
    camera.center_y_ = 0.5 * height;
    camera.is_perspective_ = field_of_view_deg > 0;

    Extent x, y, z;
    points([&](const DVec3& p) {
        if (!isFinitePoint(p)) return;
        x.add(dot(p, camera.right_));
        y.add(dot(p, camera.up_));
        z.add(dot(p, camera.back_));
    });
    if (!(x.least <= x.most)) x = y = z = {-1, 1};
    const DVec3 center = x.center() * camera.right_ + y.center() * camera.up_ + z.center() * camera.back_;
    const double half_width = kFilled * camera.center_x_, half_height = kFilled * camera.center_y_;
    if (!camera.is_perspective_) {
        const double samples = std::max(x.half() / half_width, y.half() / half_height);
        camera.scale_ = samples > 0 ? 1 / samples : 1;
        camera.eye_ = center;
        return camera;
    }
    const SineCosine half_angle = sineCosine(field_of_view_deg * (0.5 * kPi / 180));
    camera.scale_ = std::min(camera.center_x_, camera.center_y_) * half_angle.cosine / half_angle.sine;
    double distance = 0;
    points([&](const DVec3& p) {
        if (!isFinitePoint(p)) return;
        const double from_x = std::fabs(dot(p, camera.right_) - x.center()) / half_width,
                     from_y = std::fabs(dot(p, camera.up_) - y.center()) / half_height;
        distance = std::max(distance, dot(p, camera.back_) - z.center() + camera.scale_ * std::max(from_x, from_y));
    });
    if (!(distance > 0)) distance = 1;
    camera.eye_ = center + distance * camera.back_;
    camera.min_w_ = std::max(0.5 * (distance - z.half()), 1e-6 * distance);
    return camera;
}

namespace {

/// Subdivisions of a sample to which corners are rounded.
constexpr std::int64_t kSampleParts = 256;
/// Triangles are clipped at this distance from the picture, in samples, so that products of coordinates fit in 64 bits.
constexpr double kMaxSamples = 1048576;

using Polygon = std::vector<SeenPoint>;

double nearnessOf(const SeenPoint& p) { return p.nearness_w / p.w; }

DVec3 homogeneous(const SeenPoint& p) { return {p.x, p.y, p.w}; }

/// Clips away the part where `inside` (a linear function of the point) is negative.
template <class Inside>
void cutAway(Polygon& polygon, const Inside& inside) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const SeenPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0) kept.push_back(a);
        if ((at_a >= 0) == (at_b >= 0)) continue;
        const double t = at_a / (at_a - at_b);
        kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.w + t * (b.w - a.w),
                        a.nearness_w + t * (b.nearness_w - a.nearness_w)});
    }
    polygon = std::move(kept);
}

/// Returns whether a point can be drawn without clipping.
bool isDrawable(const SeenPoint& p, double min_w) {
    return p.w >= min_w && p.w > 0 && std::fabs(p.x) <= kMaxSamples * p.w && std::fabs(p.y) <= kMaxSamples * p.w;
}

Polygon cutToPicture(const std::array<SeenPoint, 3>& points, double min_w) {
    Polygon polygon(points.begin(), points.end());
    cutAway(polygon, [&](const SeenPoint& p) { return p.w - min_w; });
    cutAway(polygon, [](const SeenPoint& p) { return kMaxSamples * p.w - p.x; });
    cutAway(polygon, [](const SeenPoint& p) { return kMaxSamples * p.w + p.x; });
    cutAway(polygon, [](const SeenPoint& p) { return kMaxSamples * p.w - p.y; });
    cutAway(polygon, [](const SeenPoint& p) { return kMaxSamples * p.w + p.y; });
    return polygon;
}

struct FixedCorner {
    std::int64_t x = 0, y = 0;
};

std::int64_t floorQuotient(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// A triangle in fixed-point coordinates. A sample on an edge belongs to the triangle on only one side of it.
class FixedTriangle {
  public:
    FixedTriangle(FixedCorner a, FixedCorner b, FixedCorner c) : corners_{a, b, c} {
        const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area < 0) std::swap(corners_[1], corners_[2]);
        is_empty_ = area == 0;
    }

    /// Computes the rows of samples that the triangle may cover, clipped to the picture.
    void rows(std::int64_t height, std::int64_t& first, std::int64_t& end) const {
        const auto [least, most] = std::minmax({corners_[0].y, corners_[1].y, corners_[2].y});
        first = std::max<std::int64_t>(0, floorQuotient(least - kSampleParts / 2, kSampleParts));
        end = is_empty_ ? first : std::min(height, floorQuotient(most, kSampleParts) + 1);
    }

    /// Computes the covered samples `begin` to `end` - 1 of a row, clipped to the picture.
    void span(std::int64_t row, std::int64_t width, std::int64_t& begin, std::int64_t& end) const {
        begin = 0;
        end = width;
        const std::int64_t y = row * kSampleParts + kSampleParts / 2;
        for (int i = 0; i < 3; ++i) {
            const FixedCorner &a = corners_[i], &b = corners_[(i + 1) % 3];
            const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
            const bool is_own = dy < 0 || (dy == 0 && dx > 0);
            // A sample is inside if value - dy * kSampleParts * column >= 0.
            const std::int64_t value = dx * (y - a.y) - dy * (kSampleParts / 2 - a.x) - (is_own ? 0 : 1);
            if (dy > 0) end = std::min(end, floorQuotient(value, dy * kSampleParts) + 1);
            if (dy < 0) begin = std::max(begin, -floorQuotient(value, -dy * kSampleParts));
            if (dy == 0 && value < 0) end = begin;
        }
    }

  private:
    std::array<FixedCorner, 3> corners_;
    bool is_empty_ = false;
};

FixedCorner fixedCorner(const SeenPoint& p) {
    // Clipping enormous triangles can produce NaN; fmax and fmin replace it by a limit of the range.
    const auto fixed = [&](double x) {
        const double inside = std::fmin(std::fmax(x / p.w, -kMaxSamples), kMaxSamples);
        return static_cast<std::int64_t>(std::floor(inside * kSampleParts + 0.5));
    };
    return {fixed(p.x), fixed(p.y)};
}

}  // namespace

void WorkLimit::spend(std::uint64_t steps) {
    if (steps > left_) {
        failFile(ErrorCode::tooLarge,
                 "drawing the model would take too long: it has too many instances, or its triangles cover the picture "
                 "too many times");
    }
    left_ -= steps;
}

SeenTriangle::SeenTriangle(const std::array<SeenPoint, 3>& points) : points_(points) {
    for (std::size_t i = 0; i < 3; ++i)
        edges_[i] = cross(homogeneous(points[(i + 1) % 3]), homogeneous(points[(i + 2) % 3]));
    determinant_ = dot(homogeneous(points[0]), edges_[0]);
}

std::array<double, 3> SeenTriangle::weightsAt(double x, double y) const {
    std::array<double, 3> weights;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        // Corners were rounded for drawing, so a sample may lie slightly outside the triangle.
        weights[i] = std::max(0.0, (edges_[i].x * x + edges_[i].y * y + edges_[i].z) / determinant_);
        sum += weights[i];
    }
    if (!(sum > 0) || !std::isfinite(sum)) return {1, 0, 0};
    for (double& weight : weights) weight /= sum;
    return weights;
}

DVec3 SeenTriangle::nearness() const {
    DVec3 plane;
    for (std::size_t i = 0; i < 3; ++i) plane = plane + (points_[i].nearness_w / determinant_) * edges_[i];
    return plane;
}

VisibleTriangles::VisibleTriangles(std::span<const DrawnMesh> meshes, const Camera& camera, std::uint32_t width,
                                   std::uint32_t height, WorkLimit& work_limit)
    : meshes_(meshes), camera_(camera), width_(width), height_(height),
      nearness_(std::size_t{width} * height, -HUGE_VALF), triangles_(std::size_t{width} * height, kNone) {
    std::uint64_t count = 0;
    for (const DrawnMesh& mesh : meshes) {
        first_.push_back(static_cast<std::uint32_t>(count));
        count += mesh.corners.size() / 3;
        if (count >= kNone) failFile(ErrorCode::tooLarge, "the model draws more than 4,294,967,294 triangles");
    }
    for (std::size_t i = 0; i < meshes.size(); ++i) draw(i, work_limit);
}

void VisibleTriangles::draw(std::size_t mesh, WorkLimit& work_limit) {
    const DrawnMesh& drawn = meshes_[mesh];
    constexpr std::uint64_t kVertexSteps = 4, kTriangleSteps = 16;
    work_limit.spend(1 + kVertexSteps * drawn.positions.size());
    std::vector<SeenPoint> points;
    points.reserve(drawn.positions.size());
    for (const Vec3& position : drawn.positions)
        points.push_back(camera_.see(drawn.to_world.point(toDouble(position))));
    for (std::size_t i = 0; i < drawn.corners.size() / 3; ++i) {
        work_limit.spend(kTriangleSteps);
        const std::uint32_t* corners = drawn.corners.data() + 3 * i;
        drawTriangle(mesh, i, {points[corners[0]], points[corners[1]], points[corners[2]]}, work_limit);
    }
}

void VisibleTriangles::drawTriangle(std::size_t mesh, std::size_t triangle, const std::array<SeenPoint, 3>& points,
                                    WorkLimit& work_limit) {
    const DrawnMesh& drawn = meshes_[mesh];
    const SeenTriangle seen(points);
    if (!seen.isSeen()) return;
    if (!drawn.is_double_sided && seen.isFront() == (drawn.to_world.determinant() < 0)) return;
    const std::uint32_t number = first_[mesh] + static_cast<std::uint32_t>(triangle);
    const Job job{drawn, seen, seen.nearness(), triangle, number};
    const bool is_whole =
        std::all_of(points.begin(), points.end(), [&](const SeenPoint& p) { return isDrawable(p, camera_.minW()); });
    if (is_whole) {
        drawPart(job, points[0], points[1], points[2], work_limit);
        return;
    }
    const Polygon polygon = cutToPicture(points, camera_.minW());
    for (std::size_t k = 2; k < polygon.size(); ++k) drawPart(job, polygon[0], polygon[k - 1], polygon[k], work_limit);
}

void VisibleTriangles::drawPart(const Job& job, const SeenPoint& a, const SeenPoint& b, const SeenPoint& c,
                                WorkLimit& work_limit) {
    const FixedTriangle part(fixedCorner(a), fixedCorner(b), fixedCorner(c));
    // Corners were rounded, so a sample may lie outside the triangle, where a steep plane would give a wrong depth.
    const auto [least, most] = std::minmax({nearnessOf(a), nearnessOf(b), nearnessOf(c)});
    constexpr std::uint64_t kRowSteps = 8;
    std::int64_t row = 0, end_row = 0;
    for (part.rows(height_, row, end_row); row < end_row; ++row) {
        std::int64_t begin = 0, end = 0;
        part.span(row, width_, begin, end);
        work_limit.spend(kRowSteps + static_cast<std::uint64_t>(std::max<std::int64_t>(0, end - begin)));
        const double y = static_cast<double>(row) + 0.5, at_row = job.plane.y * y + job.plane.z;
        const std::size_t first = static_cast<std::size_t>(row) * width_;
        for (std::int64_t column = begin; column < end; ++column) {
            const double x = static_cast<double>(column) + 0.5;
            const auto nearness = static_cast<float>(std::min(std::max(job.plane.x * x + at_row, least), most));
            const std::size_t sample = first + static_cast<std::size_t>(column);
            if (!(nearness > nearness_[sample])) continue;
            if (job.mesh.is_there && !job.mesh.is_there(job.triangle, job.seen.weightsAt(x, y))) continue;
            nearness_[sample] = nearness;
            triangles_[sample] = job.number;
        }
    }
}

VisibleTriangles::Place VisibleTriangles::placeOf(std::uint32_t number) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), number);
    const auto mesh = static_cast<std::size_t>(after - first_.begin()) - 1;
    return {mesh, number - first_[mesh]};
}

SeenTriangle VisibleTriangles::seen(const Place& place) const {
    const DrawnMesh& mesh = meshes_[place.mesh];
    std::array<SeenPoint, 3> points;
    for (std::size_t k = 0; k < 3; ++k)
        points[k] = camera_.see(mesh.to_world.point(toDouble(mesh.positions[mesh.corners[3 * place.triangle + k]])));
    return SeenTriangle(points);
}

}  // namespace tspace
