// SPDX-License-Identifier: MIT
// Adjacent triangles leave no gaps, and the nearest triangle is visible.
#include "commands/shared/picture/visible_triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace tspace::test {
namespace {

constexpr std::uint32_t kSize = 64;

Camera cameraFor(const std::vector<Vec3>& points, double field_of_view_deg, const ViewAngles& angles = {}) {
    return Camera::around(
        [&](const std::function<void(const DVec3&)>& visit) {
            for (const Vec3& point : points) visit(toDouble(point));
        },
        angles, field_of_view_deg, kSize, kSize);
}

float someNumber(int least, int end) { return 0.01f * static_cast<float>(*rc::gen::inRange(least, end)); }

/// A square that is divided into a fan of triangles around an inner point, with shared vertices.
RC_GTEST_PROP(VisibleTriangles, NeighborsLeaveNoGapAndNoSampleTwice, ()) {
    const Vec3 inner{someNumber(-90, 90), someNumber(-90, 90), 0};
    const std::vector<Vec3> points = {inner, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const std::vector<std::uint32_t> corners = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    const Camera camera = cameraFor(points, *rc::gen::element(0.0, 45.0));
    std::vector<int> seen(kSize * kSize, 0);
    for (std::size_t i = 0; i < 4; ++i) {
        const DrawnMesh mesh{.positions = points, .corners = std::span(corners).subspan(3 * i, 3)};
        WorkLimit effort(1 << 20);
        const VisibleTriangles visible(std::span(&mesh, 1), camera, kSize, kSize, effort);
        for (std::uint32_t y = 0; y < kSize; ++y) {
            for (std::uint32_t x = 0; x < kSize; ++x) seen[y * kSize + x] += visible.row(y)[x] == 0;
        }
    }
    // The picture's margin is 3 %, so 2 samples are free on each side.
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            const bool is_inside = x >= 2 && x < 62 && y >= 2 && y < 62;
            RC_ASSERT(seen[y * kSize + x] == (is_inside ? 1 : 0));
        }
    }
}

/// Each sample shows the first triangle on its ray.
RC_GTEST_PROP(VisibleTriangles, TheNearestTriangleIsVisible, ()) {
    std::vector<Vec3> points;
    const int count = *rc::gen::inRange(1, 8);
    for (int i = 0; i < 3 * count; ++i)
        points.push_back({someNumber(-99, 99), someNumber(-99, 99), someNumber(-99, 99)});
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < points.size(); ++i) corners.push_back(i);
    const DrawnMesh mesh{.positions = points, .corners = corners, .is_double_sided = true};
    const Camera camera = cameraFor(points, 0);
    WorkLimit effort(1 << 20);
    const VisibleTriangles visible(std::span(&mesh, 1), camera, kSize, kSize, effort);
    for (std::uint32_t y = 0; y < kSize; y += 3) {
        for (std::uint32_t x = 0; x < kSize; x += 3) {
            // Compute depths at the sample from areas in the picture plane. Samples near edges are doubtful, because
            // they depend on rounding.
            double nearest = -HUGE_VAL, seen = -HUGE_VAL;
            bool is_doubtful = false;
            for (std::size_t t = 0; t < static_cast<std::size_t>(count); ++t) {
                SeenPoint p[3];
                for (std::size_t k = 0; k < 3; ++k) p[k] = camera.see(toDouble(points[3 * t + k]));
                const auto area = [&](int a, int b, double qx, double qy) {
                    return (p[a].x - qx) * (p[b].y - qy) - (p[a].y - qy) * (p[b].x - qx);
                };
                const double whole = area(1, 2, p[0].x, p[0].y), qx = x + 0.5, qy = y + 0.5;
                const double w[3] = {area(1, 2, qx, qy) / whole, area(2, 0, qx, qy) / whole,
                                     area(0, 1, qx, qy) / whole};
                const double least = std::min({w[0], w[1], w[2]});
                if (std::fabs(whole) < 8 || std::fabs(least) < 0.02) is_doubtful = true;
                if (least < 0) continue;
                const double nearness = w[0] * p[0].nearness_w + w[1] * p[1].nearness_w + w[2] * p[2].nearness_w;
                if (std::fabs(nearness - nearest) < 0.01) is_doubtful = true;
                nearest = std::max(nearest, nearness);
                if (visible.row(y)[x] == t) seen = nearness;
            }
            if (!is_doubtful) RC_ASSERT(seen == nearest);
        }
    }
}

/// Returns the smallest sine of the angles of a triangle, as it appears in the picture.
double leastSine(const std::vector<Vec3>& points, const Camera& camera) {
    DVec3 seen[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const SeenPoint p = camera.see(toDouble(points[k]));
        seen[k] = {p.x / p.w, p.y / p.w, 0};
    }
    double least = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const DVec3 a = seen[(k + 1) % 3] - seen[k], b = seen[(k + 2) % 3] - seen[k];
        least = std::min(least, length(cross(a, b)) / (length(a) * length(b)));
    }
    return least;
}

RC_GTEST_PROP(VisibleTriangles, WeightsLeadToTheSample, ()) {
    std::vector<Vec3> points;
    for (int i = 0; i < 3; ++i) points.push_back({someNumber(-99, 99), someNumber(-99, 99), someNumber(-99, 99)});
    const Camera camera =
        cameraFor(points, 60,
                  {static_cast<double>(*rc::gen::inRange(-180, 180)), static_cast<double>(*rc::gen::inRange(-90, 90))});
    const std::vector<std::uint32_t> corners = {0, 1, 2};
    const DrawnMesh mesh{.positions = points, .corners = corners, .is_double_sided = true};
    WorkLimit effort(1 << 20);
    const VisibleTriangles visible(std::span(&mesh, 1), camera, kSize, kSize, effort);
    const SeenTriangle seen = visible.seen({0, 0});
    // Corners are rounded to 1/256 of a pixel, so they move by at most sqrt(2) / 512 = 0.0028 pixels. A sample just
    // outside of an edge is therefore moved to the edge, toward the opposite corner; it moves farther in narrow
    // triangles.
    const double most = 0.003 / leastSine(points, camera);
    for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
            if (visible.row(y)[x] != 0) continue;
            const std::array<double, 3> weights = seen.weightsAt(x + 0.5, y + 0.5);
            DVec3 point;
            for (std::size_t k = 0; k < 3; ++k) point = point + weights[k] * toDouble(points[k]);
            const SeenPoint back = camera.see(point);
            RC_ASSERT(std::fabs(back.x / back.w - (x + 0.5)) < most);
            RC_ASSERT(std::fabs(back.y / back.w - (y + 0.5)) < most);
        }
    }
}

TEST(VisibleTriangles, TrianglesBehindTheCameraAreClipped) {
    // A floor that extends below and behind the camera, of which the camera sees a small part.
    const std::vector<Vec3> points = {{-100, -1, 100}, {100, -1, 100}, {100, -1, -100}, {-100, -1, -100}};
    const std::vector<std::uint32_t> corners = {0, 1, 2, 0, 2, 3};
    const DrawnMesh mesh{.positions = points, .corners = corners, .is_double_sided = true};
    const Camera camera = cameraFor({{-1, -1, -1}, {1, 1, 1}}, 60);
    WorkLimit effort(1 << 20);
    const VisibleTriangles visible(std::span(&mesh, 1), camera, kSize, kSize, effort);
    EXPECT_EQ(visible.row(2)[32], VisibleTriangles::kNone);
    for (const std::uint32_t x : {0U, 32U, 63U}) EXPECT_NE(visible.row(63)[x], VisibleTriangles::kNone);
}

}  // namespace
}  // namespace tspace::test
