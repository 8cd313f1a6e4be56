// SPDX-License-Identifier: MIT
#include "commands/shared/picture/camera.h"

#include <algorithm>
#include <limits>

#include "core/base/vec_math.h"

namespace tspace {

namespace {

/// Part of the picture's half sides that the points may fill.
constexpr double kFilled = 0.94;

struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = -least;

    void add(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
    [[nodiscard]] double centre() const { return 0.5 * (least + most); }
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
    camera.centre_x_ = 0.5 * width;
    camera.centre_y_ = 0.5 * height;
    camera.is_perspective_ = field_of_view_deg > 0;

    Extent x, y, z;
    points([&](const DVec3& p) {
        if (!isFinitePoint(p)) return;
        x.add(dot(p, camera.right_));
        y.add(dot(p, camera.up_));
        z.add(dot(p, camera.back_));
    });
    if (!(x.least <= x.most)) x = y = z = {-1, 1};
    const DVec3 centre = x.centre() * camera.right_ + y.centre() * camera.up_ + z.centre() * camera.back_;
    const double half_width = kFilled * camera.centre_x_, half_height = kFilled * camera.centre_y_;
    if (!camera.is_perspective_) {
        const double samples = std::max(x.half() / half_width, y.half() / half_height);
        camera.scale_ = samples > 0 ? 1 / samples : 1;
        camera.eye_ = centre;
        return camera;
    }
    const SineCosine half_angle = sineCosine(field_of_view_deg * (0.5 * kPi / 180));
    camera.scale_ = std::min(camera.centre_x_, camera.centre_y_) * half_angle.cosine / half_angle.sine;
    double distance = 0;
    points([&](const DVec3& p) {
        if (!isFinitePoint(p)) return;
        const double from_x = std::fabs(dot(p, camera.right_) - x.centre()) / half_width,
                     from_y = std::fabs(dot(p, camera.up_) - y.centre()) / half_height;
        distance = std::max(distance, dot(p, camera.back_) - z.centre() + camera.scale_ * std::max(from_x, from_y));
    });
    if (!(distance > 0)) distance = 1;
    camera.eye_ = centre + distance * camera.back_;
    camera.least_w_ = std::max(0.5 * (distance - z.half()), 1e-6 * distance);
    return camera;
}

}  // namespace tspace
