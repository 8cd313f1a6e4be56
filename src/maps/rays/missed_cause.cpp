// SPDX-License-Identifier: MIT
#include "maps/rays/missed_cause.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/numbers.h"
#include "core/base/vec_math.h"
#include "maps/layout/low_points.h"
#include "maps/rays/map_surfaces.h"
#include "maps/rays/rays.h"

namespace tspace {
namespace {

constexpr std::size_t kSamples = 1000;
constexpr double kMeets = 0.8;
/// Reach of rays that is usually sufficient, relative to the size of the low poly.
constexpr double kUsualReach = 0.05;

/// Rotation by multiples of 90 degrees, as the rows of its matrix.
using Turn = std::array<DVec3, 3>;
constexpr Turn kNone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

DVec3 turnedBack(const Turn& turn, const DVec3& at) { return at.x * turn[0] + at.y * turn[1] + at.z * turn[2]; }

Turn product(const Turn& second, const Turn& first) {
    Turn result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = second[i].x * first[0] + second[i].y * first[1] + second[i].z * first[2];
    return result;
}

bool isEqual(const Turn& a, const Turn& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec3 gap = a[i] - b[i];
        if (dot(gap, gap) > 0) return false;
    }
    return true;
}

struct NamedTurn {
    Turn turn = kNone;
    std::string name = {};
};

/// Returns all rotations by multiples of 90 degrees about one or two axes, except the identity.
std::vector<NamedTurn> quarterTurns() {
    constexpr Turn kAxes[3] = {{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}},
                               {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}},
                               {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
    constexpr const char* kNames[3] = {" degrees about x", " degrees about y", " degrees about z"};
    constexpr const char* kAngles[3] = {"90", "180", "-90"};
    std::vector<NamedTurn> about_one;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Turn turn = kNone;
        for (const char* const angle : kAngles) {
            turn = product(kAxes[axis], turn);
            about_one.push_back({turn, std::string("by ") + angle + kNames[axis]});
        }
    }
    std::vector<NamedTurn> all = about_one;
    for (const NamedTurn& first : about_one) {
        for (const NamedTurn& second : about_one) {
            const Turn turn = product(second.turn, first.turn);
            const bool is_known = isEqual(turn, kNone) || std::any_of(all.begin(), all.end(), [&](const auto& other) {
                                      return isEqual(other.turn, turn);
                                  });
            if (!is_known) all.push_back({turn, first.name + ", then " + second.name});
        }
    }
    return all;
}

struct Sample {
    DVec3 place = {}, outward = {};
    std::uint32_t group = 0;
};

/// Returns sample points of the low poly, evenly distributed over its area.
std::vector<Sample> samplesOf(const LowPoly& low) {
    const AreaPoints places(low.positions.count / 3, [&](std::size_t i) { return faceSize(low.positions, i); });
    std::vector<Sample> samples;
    for (std::size_t i = 0; !places.empty() && i < kSamples; ++i) {
        const auto [triangle, weights] = places.at(i, kSamples);
        Sample sample{mixedAt(low.positions, triangle, weights), mixedAt(low.normals, triangle, weights),
                      low.groups.empty() ? 0 : low.groups[triangle]};
        if (normalize(sample.outward) && std::isfinite(sample.place.x + sample.place.y + sample.place.z))
            samples.push_back(sample);
    }
    return samples;
}

/// Counts the samples whose ray hits the high poly after the high poly is rotated and scaled.
class Trial {
  public:
    Trial(const RaySurface& surface, std::vector<Sample> samples) : surface_(surface), samples_(std::move(samples)) {}

    /// Returns the share of samples whose ray hits a front face.
    [[nodiscard]] double met(double reach, const Turn& turn = kNone, double scale = 1) const {
        std::size_t count = 0;
        double guess = 0;
        for (const Sample& sample : samples_) {
            RayHit hit;
            count += surface_.nearest((1 / scale) * turnedBack(turn, sample.place), turnedBack(turn, sample.outward),
                                      reach / scale, sample.group, guess, hit)
                         ? 1
                         : 0;
        }
        return partOf(count);
    }
    /// Returns the share of samples whose ray hits only back faces.
    [[nodiscard]] double backHitShare(double reach) const {
        std::size_t count = 0;
        for (const Sample& sample : samples_) {
            const RayCrossings crossings =
                surface_.crossings({sample.place, sample.outward, -reach, reach, sample.group});
            count += crossings.backs > 0 && crossings.fronts == 0 ? 1 : 0;
        }
        return partOf(count);
    }

  private:
    [[nodiscard]] double partOf(std::size_t count) const {
        return samples_.empty() ? 0 : static_cast<double>(count) / static_cast<double>(samples_.size());
    }
    const RaySurface& surface_;
    std::vector<Sample> samples_;
};

/// Describes the rotation and scale of the high poly with which the largest share of rays hits it. Returns an empty
/// string if no share exceeds `enough`.
std::string likelyPlacement(const Trial& trial, double size, double high_size, double reach, double enough) {
    constexpr double kOtherSize = 1.5;
    std::vector<NamedTurn> turns = quarterTurns();
    turns.insert(turns.begin(), NamedTurn{});
    std::vector<double> scales = {1};
    if (high_size > 0 && (size > kOtherSize * high_size || high_size > kOtherSize * size))
        scales.push_back(size / high_size);
    double most = enough;
    std::string best;
    for (const double scale : scales) {
        for (const NamedTurn& turn : turns) {
            if (turn.name.empty() && scale == 1) continue;
            const double met = trial.met(reach, turn.turn, scale);
            if (!(met > most)) continue;
            most = met;
            best = turn.name.empty() ? "" : "rotate it " + turn.name;
            if (scale != 1) best += (best.empty() ? "scale it by " : " and scale it by ") + shortNumber(scale);
        }
    }
    return best.empty() ? best : "the high poly's axes or units differ: " + best + " to align it with the low poly";
}

}  // namespace

std::string causeOfMisses(const LowPoly& low, const HighPoly& high, const RaySurface& surface, double reach) {
    const Trial trial(surface, samplesOf(low));
    if (trial.backHitShare(reach) >= 0.5) return "the high poly's faces point inward: rays hit only back faces";
    const double size = PositionBox(low.positions).diagonal(), high_size = PositionBox(high.positions).diagonal();
    const double usual = std::max(reach, kUsualReach * size);
    const auto furtherAway = [&](double other) {
        return "the high poly is farther away than the maximum ray distance: --reach " + shortNumber(other) +
               " reaches it";
    };
    if (usual > reach && trial.met(usual) >= kMeets) return furtherAway(usual);
    const std::string moved = likelyPlacement(trial, size, high_size, usual, kMeets);
    if (!moved.empty()) return moved;
    for (const double factor : {2.0, 4.0, 8.0}) {
        if (trial.met(factor * usual) >= kMeets) return furtherAway(factor * usual);
    }
    if (trial.backHitShare(usual) >= 0.5) return "the high poly's faces point inward: rays hit only back faces";
    return {};
}

std::string likelyPlacementOf(const LowPoly& low, const HighPoly& high, const RaySurface& surface) {
    constexpr double kFew = 0.5, kNearlyAll = 0.95;
    const Trial trial(surface, samplesOf(low));
    const double size = PositionBox(low.positions).diagonal(), high_size = PositionBox(high.positions).diagonal();
    if (trial.met(kUsualReach * size) >= kFew) return {};
    return likelyPlacement(trial, size, high_size, kUsualReach * size, kNearlyAll);
}

}  // namespace tspace
