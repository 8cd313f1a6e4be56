// SPDX-License-Identifier: MIT
// From places in the world to samples of a picture.
#pragma once

#include <cstdint>
#include <functional>

#include "core/base/vec_math.h"

namespace tspace {

/// Where a camera stands: yaw 0 and pitch 0 look from +z, yaw 90 from +x, pitch 90 from +y.
struct ViewAngles {
    double yaw_deg = 0, pitch_deg = 0;
};

/// A point as a camera sees it. (x / w, y / w) are samples, from the upper left corner of the picture to the right and
/// down.
struct SeenPoint {
    double x = 0, y = 0, w = 1;
    double nearness_w = 0;  ///< w times the nearness, which is linear in x / w and y / w, and larger for what is nearer
};

class Camera {
  public:
    /// Calls its argument with each point that has to be in the picture.
    using VisitPoints = std::function<void(const std::function<void(const DVec3&)>& visit)>;

    /// Holds all points, those that are not finite left out, with a narrow margin. `field_of_view_deg`: of the shorter side,
    /// below 180; 0: all rays are parallel. `width`, `height`: in samples.
    static Camera around(const VisitPoints& points, const ViewAngles& angles, double field_of_view_deg,
                         std::uint32_t width, std::uint32_t height);

    [[nodiscard]] SeenPoint see(const DVec3& point) const {
        const DVec3 from = point - eye_;
        const double x = scale_ * dot(from, right_), y = -scale_ * dot(from, up_), depth = -dot(from, back_);
        if (!is_perspective_) return {centre_x_ + x, centre_y_ + y, 1, -depth};
        return {centre_x_ * depth + x, centre_y_ * depth + y, depth, 1};
    }
    /// Points with a smaller w are too near to be seen.
    [[nodiscard]] double leastW() const { return least_w_; }

    [[nodiscard]] const DVec3& right() const { return right_; }
    [[nodiscard]] const DVec3& up() const { return up_; }
    /// The direction from the scene to the eye.
    [[nodiscard]] const DVec3& back() const { return back_; }

  private:
    DVec3 right_{1, 0, 0}, up_{0, 1, 0}, back_{0, 0, 1}, eye_{};
    double centre_x_ = 0, centre_y_ = 0;
    double scale_ = 1;  ///< samples per unit; with perspective at distance 1
    double least_w_ = 0;
    bool is_perspective_ = true;
};

}  // namespace tspace
