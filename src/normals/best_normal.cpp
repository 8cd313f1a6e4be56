// SPDX-License-Identifier: MIT
// The normal of the quadratic surface through the edges around a point, unless these look like noise or a bevel: then
// the mean by angle * area. In between a blend.
// Based on: Zhang & Naga, "A New Finite Element Gradient Recovery Method: Superconvergence Property", 2005 (a quadratic
// fit around each point, here of the height above a plane; a ridge keeps it solvable); Max, "Weights for Computing
// Vertex Normals from Facet Normals", 1999 (the plane).
//
// The same from sums, for the common case, is in best_sums_kernel.h.
//
// A fit follows noise, and across a bevel it bends what is flat. What tells these from a smooth surface is an edge e
// between normals m and n: on a circle, and nearly on everything that is smooth at the mesh's scale, dot(e, m + n) is
// 0.
#include "normals/best_normal.h"

#include <algorithm>
#include <cmath>

#include "core/basis.h"
#include "core/vec_math.h"
#include "normals/best_constants.h"

namespace tspace {

namespace {

using namespace smooth;

double square(double x) { return x * x; }

/// Calls visit(edge, doubled area of the corner's triangle, corner at the other end) for both edges of each corner.
template <class Visit>
void forEdges(const BestSource& source, const PointCorners& at, const Link* links, std::uint32_t count, Visit visit) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t corner = at.corner(links[i].slot);
        if (source.rows[at.triangle(links[i].slot)].isDegenerate()) continue;
        const std::uint32_t next = source.faces.next(corner), previous = source.faces.previous(corner);
        const auto position = [&](std::uint32_t c) { return toDouble(source.mesh.positions[source.mesh.indices[c]]); };
        const DVec3 here = position(corner), e1 = position(next) - here, e2 = position(previous) - here;
        const double area = length(cross(e1, e2));
        if (dot(e1, e1) > 0) visit(e1, area, next);
        if (dot(e2, e2) > 0) visit(e2, area, previous);
    }
}

/// Whether the sharp normals, and a fit that starts from them, can be trusted.
class Doubt {
  public:
    Doubt(const DVec3& robust, const DVec3& sharp) : robust_(robust), sharp_(sharp), axes_(planeAxes(sharp)) {}

    void add(const DVec3& edge, double area, const DVec3& robust_there, const DVec3& sharp_there) {
        const double square_length = dot(edge, edge), per_length = 1 / square_length;
        const double misfit = dot(edge, sharp_ + sharp_there);
        const double x = dot(edge, axes_.x), y = dot(edge, axes_.y);
        xx_ += per_length * x * x;
        xy_ += per_length * x * y;
        yy_ += per_length * y * y;
        x_ += per_length * x * misfit;
        y_ += per_length * y * misfit;
        misfit_ += per_length * square(misfit);
        count_ += 1;
        bend_ += per_length * square(dot(edge, sharp_there - sharp_));
        // Large triangles say what is flat.
        const double height = square(area) * per_length;
        sharp_misfit_ += height * square(misfit);
        robust_misfit_ += height * square(dot(edge, robust_ + robust_there));
        largest_curvature_ = std::max(largest_curvature_, 2 * std::fabs(dot(robust_, edge)) * per_length);
        longest_ = std::max(longest_, square_length);
    }

    /// From 0 to no limit; 1 where trust and doubt are even.
    [[nodiscard]] double value(const DVec3& fit) const {
        if (dot(robust_, fit) < 0) return kNoTrust;
        const double noise = unexplained() / (bend_ * square(kNoise));
        const double kink = sharp_misfit_ / (robust_misfit_ * square(kKink));
        const double turn = square(largest_curvature_) * longest_;
        const DVec3 apart = cross(robust_, sharp_);
        const double jump = turn * dot(apart, apart) / square(kJump);
        const double too_coarse = bend_ / (count_ * square(kTurn));
        const DVec3 lean = cross(robust_, fit);
        const double spread = dot(lean, lean) / square(kSpread);
        return finite(square(noise)) + finite(square(square(kink))) + finite(square(square(jump))) +
               finite(square(square(too_coarse))) + finite(square(spread));
    }

  private:
    /// What remains of the misfit when the normal here is turned as well as it can be: noise at the other ends.
    [[nodiscard]] double unexplained() const {
        const double determinant = xx_ * yy_ - xy_ * xy_;
        if (!(determinant > 1e-12 * square(xx_ + yy_))) return misfit_;
        const double along_x = (yy_ * x_ - xy_ * y_) / determinant, along_y = (xx_ * y_ - xy_ * x_) / determinant;
        return std::max(0.0, misfit_ - along_x * x_ - along_y * y_);
    }
    /// 0/0 is a plane, where all normals are the same; what overflows is beyond doubt.
    static double finite(double x) { return x < kNoTrust ? x : x >= kNoTrust ? kNoTrust : 0; }

    DVec3 robust_, sharp_;
    PlaneAxes axes_;
    double xx_ = 0, xy_ = 0, yy_ = 0, x_ = 0, y_ = 0, misfit_ = 0, bend_ = 0, count_ = 0;
    double sharp_misfit_ = 0, robust_misfit_ = 0, largest_curvature_ = 0, longest_ = 0;
};

/// Fits the height of the edges' other ends above a plane: linear plus quadratic, through the point itself. An edge
/// counts by the inverse of its squared length, so its slope counts once, and the unknowns are found whatever the
/// scale.
class HeightFit {
  public:
    explicit HeightFit(const DVec3& normal) : normal_(normal), axes_(planeAxes(normal)) {}

    void add(const DVec3& edge) {
        const double size = length(edge), inverse = 1 / size;
        const double x = inverse * dot(edge, axes_.x), y = inverse * dot(edge, axes_.y);
        const double slope = inverse * dot(edge, normal_);
        const double bend[3] = {0.5 * size * x * x, size * x * y, 0.5 * size * y * y};
        xx_ += x * x;
        xy_ += x * y;
        yy_ += y * y;
        x_slope_ += x * slope;
        y_slope_ += y * slope;
        for (int i = 0; i < 3; ++i) {
            x_bend_[i] += x * bend[i];
            y_bend_[i] += y * bend[i];
            bend_slope_[i] += bend[i] * slope;
            for (int k = 0; k < 3; ++k) bend_bend_[i][k] += bend[i] * bend[k];
        }
    }

    /// The plane's own normal where the edges do not span it.
    [[nodiscard]] DVec3 normal() const {
        const double determinant = xx_ * yy_ - xy_ * xy_;
        if (!(determinant > 1e-12 * square(xx_ + yy_))) return normal_;
        double curvature[3] = {};
        solveCurvature(1 / determinant, curvature);
        double x_left = x_slope_, y_left = y_slope_;
        for (int i = 0; i < 3; ++i) {
            x_left -= x_bend_[i] * curvature[i];
            y_left -= y_bend_[i] * curvature[i];
        }
        const double along_x = (yy_ * x_left - xy_ * y_left) / determinant;
        const double along_y = (xx_ * y_left - xy_ * x_left) / determinant;
        const DVec3 sum = normal_ - along_x * axes_.x - along_y * axes_.y;
        const double size = length(sum);
        return size < 1e6 ? (1 / size) * sum : normal_;  // at least 1; not a number for rings beyond reach
    }

  private:
    /// Eliminates the linear part, adds the ridge, and solves for the quadratic one. Zeros where that has no answer.
    void solveCurvature(double inverse_determinant, double (&curvature)[3]) const {
        double rows[3][4];
        const double ridge = kFitRidge * kFitRidgeShare * (bend_bend_[0][0] + bend_bend_[1][1] + bend_bend_[2][2]);
        for (int i = 0; i < 3; ++i) {
            const double along_x = (yy_ * x_bend_[i] - xy_ * y_bend_[i]) * inverse_determinant;
            const double along_y = (xx_ * y_bend_[i] - xy_ * x_bend_[i]) * inverse_determinant;
            for (int k = 0; k < 3; ++k) rows[i][k] = bend_bend_[i][k] - along_x * x_bend_[k] - along_y * y_bend_[k];
            rows[i][i] += i == 1 ? 2 * ridge : ridge;
            rows[i][3] = bend_slope_[i] - along_x * x_slope_ - along_y * y_slope_;
        }
        for (int i = 0; i < 3; ++i) {
            if (!(rows[i][i] > 0)) return;
            for (int below = i + 1; below < 3; ++below) {
                const double factor = rows[below][i] / rows[i][i];
                for (int k = i; k < 4; ++k) rows[below][k] -= factor * rows[i][k];
            }
        }
        for (int i = 2; i >= 0; --i) {
            double left = rows[i][3];
            for (int k = i + 1; k < 3; ++k) left -= rows[i][k] * curvature[k];
            curvature[i] = left / rows[i][i];
        }
    }

    DVec3 normal_;
    PlaneAxes axes_;
    double xx_ = 0, xy_ = 0, yy_ = 0, x_slope_ = 0, y_slope_ = 0;
    double x_bend_[3] = {}, y_bend_[3] = {}, bend_slope_[3] = {}, bend_bend_[3][3] = {};
};

}  // namespace

Vec3 bestNormal(const BestSource& source, const PointCorners& at, const Link* links, std::uint32_t count) {
    const std::uint32_t any = at.corner(links[0].slot);
    const DVec3 robust = toDouble(source.robust[any]), sharp = toDouble(source.sharp[any]);
    Doubt doubt(robust, sharp);
    HeightFit fit(sharp);
    forEdges(source, at, links, count, [&](const DVec3& edge, double area, std::uint32_t there) {
        fit.add(edge);
        const DVec3 sharp_there = toDouble(source.sharp[there]);
        if (dot(sharp_there, sharp_there) > 0) doubt.add(edge, area, toDouble(source.robust[there]), sharp_there);
    });
    const DVec3 fitted = fit.normal();
    const double share = 1 / (1 + doubt.value(fitted));
    // The two lean to the same side, so the sum does not vanish.
    const DVec3 sum = share * fitted + (1 - share) * robust;
    return toFloat((1 / length(sum)) * sum);
}

}  // namespace tspace
