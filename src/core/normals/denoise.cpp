// SPDX-License-Identifier: MIT
// NormalOptions::denoise: regional choice among fits. The more rings a quadratic surface goes through, the less noise its
// normal has, and the more shape it may miss. The first follows from the points and the noise, the second from how much fits
// differ beyond what noise explains, averaged over a region. Each normal counts by its risk, the sum of both.
// Based on: Goldenshluger & Lepski's comparison of estimators ("Bandwidth selection in kernel density estimation", 2011): bias
// by the differences of nested estimates, less their variance; here with a mean over a region in the place of a maximum.
#include "core/normals/denoise.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/base/vec_math.h"
#include "core/normals/ring_fit.h"

namespace tspace {

namespace {

// In units of the mean edge. Above the first, planes of fits are smoothed more; above the second, a single ring's normal says
// too little to compare with.
constexpr double kRoughNoise = 0.15, kLoudNoise = 0.12;
constexpr int kBiasPasses = 8;
constexpr double kFirstVariance = 1.15;  // of `best` by that of the mean by area, measured

Float4 toFloat4(const Vec3& v) { return Float4{v.x, v.y, v.z, 0}; }
Float4 unitOr(Float4 v, Float4 other) {
    const float square = dotted(v, v);
    return square > 0 && std::isfinite(square) ? splat(1 / std::sqrt(square)) * v : other;
}

/// A fit of some rings: its normal and the normal's variance.
struct RingFit {
    Float4 normal = {};
    double variance = std::numeric_limits<double>::infinity();

    RingFit() = default;
    RingFit(const RingSums& sums, const RingFrame& frame, double noise) {
        const RingSums::Rest rest = sums.slopes();
        if (!rest.is_sound) return;
        const auto& m = rest.matrix;
        const double inverse = 1 / (m[0][0] * m[1][1] - m[0][1] * m[0][1]);
        const double d = inverse * (m[1][1] * rest.right[0] - m[0][1] * rest.right[1]);
        const double e = inverse * (m[0][0] * rest.right[1] - m[0][1] * rest.right[0]);
        const Float4 found = frame.z - splat(static_cast<float>(d)) * frame.x - splat(static_cast<float>(e)) * frame.y;
        normal = unitOr(found, splat(0.0f));
        if (dotted(normal, normal) > 0) variance = noise * noise * inverse * (m[0][0] + m[1][1]);
    }
    [[nodiscard]] bool isThere() const { return std::isfinite(variance); }
};

/// Two of them for each group: of two rings and of three.
struct Fits {
    float normals[2][4];  ///< the fourth number is the variance
};

class Denoiser {
  public:
    Denoiser(const NormalGroups& groups, const Allocator* allocator, Parallel& parallel, double noise)
        : groups_(groups), allocator_(allocator), parallel_(parallel), noise_(noise) {}

    /// Makes better normals in place; `normals` has four floats per group.
    void run(Buffer<float>& normals) {
        Buffer<float> planes = makePlanes();
        Buffer<Fits> fits(allocator_, groups_.count());
        Buffer<float> bias(allocator_, 2 * groups_.count());
        groups_.forAll([&](std::uint32_t group, std::uint32_t* marks) {
            fit(group, marks, loadFloat4(planes.data() + 4 * std::size_t{group}), fits[group]);
            compare(group, loadFloat4(normals.data() + 4 * std::size_t{group}), fits[group],
                    bias.data() + 2 * std::size_t{group});
        });
        planes = {};
        average(bias);
        forRanges(
            [&](std::size_t group) { blend(group, fits[group], bias.data() + 2 * group, normals.data() + 4 * group); });
    }

  private:
    template <class Body>
    void forRanges(const Body& body) {
        parallel_.forRanges(groups_.count(), Parallel::kGrain / 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t g = begin; g < end; ++g) body(g);
        });
    }

    /// The area normals, averaged with their neighbours.
    Buffer<float> makePlanes() {
        const std::size_t count = groups_.count();
        Buffer<float> planes(allocator_, 4 * count), before(allocator_, 4 * count);
        forRanges([&](std::size_t g) { storeFloat4(planes.data() + 4 * g, groups_.areaNormal(g)); });
        for (int pass = noise_ > kRoughNoise ? 3 : 1; pass != 0; --pass) {
            std::swap(planes, before);
            forRanges([&](std::size_t g) {
                const Float4 own = loadFloat4(before.data() + 4 * g);
                Float4 sum = own;
                for (const std::uint32_t n : groups_.neighbours(g))
                    sum += loadFloat4(before.data() + 4 * std::size_t{n});
                storeFloat4(planes.data() + 4 * g, unitOr(sum, own));
            });
        }
        return planes;
    }

    void fit(std::uint32_t group, std::uint32_t* marks, Float4 plane, Fits& fits) const {
        RingFit found[2];
        if (dotted(plane, plane) > 0) {
            const RingFrame frame(plane);
            RingWalk walk(groups_, marks, group);
            RingSums sums;
            if (walk.grow()) {
                std::size_t begin = 0;
                for (RingFit& fit : found) {
                    if (!walk.grow()) break;
                    sums.add(groups_, frame, walk, begin);
                    begin = walk.size();
                    fit = RingFit(sums, frame, noise_);
                }
            }
        }
        for (std::size_t r = 0; r < 2; ++r) {
            found[r].normal[3] = static_cast<float>(found[r].variance);
            storeFloat4(fits.normals[r], found[r].normal);
        }
    }

    [[nodiscard]] double firstVariance(std::size_t group) const {
        return kFirstVariance * noise_ * noise_ * groups_.areaVariance(group);
    }

    /// Fits are nested least squares, so the variance of their difference is the difference of their variances: what they
    /// differ beyond that is bias. NaN: nothing to compare.
    void compare(std::size_t group, Float4 first, const Fits& fits, float* bias) const {
        const bool is_loud = noise_ > kLoudNoise;
        const Float4 two = loadFloat4(fits.normals[0]), three = loadFloat4(fits.normals[1]);
        const Float4 base = is_loud ? two : first;
        const double base_variance = is_loud ? double{two[3]} : firstVariance(group);
        const auto beyond = [&](Float4 normal) {
            const Float4 difference = normal - base;
            const double variance = std::max(0.0, base_variance - normal[3]);
            const double bias_square = dotted(difference, difference) - variance;
            return std::isfinite(base_variance) && std::isfinite(normal[3]) ? static_cast<float>(bias_square)
                                                                            : std::numeric_limits<float>::quiet_NaN();
        };
        bias[0] = is_loud ? (std::isfinite(two[3]) ? 0.0f : std::numeric_limits<float>::quiet_NaN()) : beyond(two);
        bias[1] = beyond(three);
    }

    void average(Buffer<float>& bias) {
        Buffer<float> before(allocator_, bias.size());
        for (int pass = 0; pass < kBiasPasses; ++pass) {
            std::swap(bias, before);
            forRanges([&](std::size_t g) {
                const std::span<const std::uint32_t> around = groups_.neighbours(g);
                for (std::size_t r = 0; r < 2; ++r) {
                    const float own = before[2 * g + r];
                    float sum = own == own ? own : 0, count = own == own ? 1 : 0;
                    for (const std::uint32_t n : around) {
                        const float other = before[2 * std::size_t{n} + r];
                        if (other == other) sum += other, count += 1;
                    }
                    bias[2 * g + r] = count > 0 ? sum / count : own;
                }
            });
        }
    }

    void blend(std::size_t group, const Fits& fits, const float* bias, float* normal) const {
        const double first_risk = firstVariance(group);
        double risks[3] = {first_risk, 0, 0}, least = risks[0];
        for (std::size_t r = 0; r < 2; ++r) {
            risks[r + 1] = double{fits.normals[r][3]} + std::max(0.0, double{bias[r]});
            if (!std::isfinite(bias[r])) risks[r + 1] = std::numeric_limits<double>::infinity();
            least = std::min(least, risks[r + 1]);
        }
        if (!(least > 0) || !std::isfinite(least)) return;
        Float4 sum = splat(0.0f);
        for (std::size_t r = 0; r < 3; ++r) {
            const double share = least / risks[r];
            const Float4 one = r == 0 ? loadFloat4(normal) : loadFloat4(fits.normals[r - 1]);
            sum += splat(static_cast<float>(share * share * share)) * one;
        }
        sum[3] = 0;
        storeFloat4(normal, unitOr(sum, loadFloat4(normal)));
    }

    const NormalGroups& groups_;
    const Allocator* allocator_;
    Parallel& parallel_;
    double noise_;
};

/// Makes better normals of those in call.out. noise: in the unit of `groups`
void denoise(const NormalsCall& call, const CornerGroups& corner_groups, const NormalGroups& groups, double noise) {
    const std::size_t corner_count = call.mesh.cornerCount();
    Buffer<float> normals(call.allocator, 4 * groups.count(), 0.0f);
    for (std::uint32_t c = 0; c < corner_count; ++c)
        storeFloat4(normals.data() + 4 * std::size_t{corner_groups.of(c)}, toFloat4(call.out[c]));
    Denoiser(groups, call.allocator, call.parallel, noise).run(normals);
    call.parallel.forRanges(corner_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const std::uint32_t group = corner_groups.of(static_cast<std::uint32_t>(c));
            if (!std::isfinite(groups.areaVariance(group))) continue;  // corners there have substitutes
            const float* const n = normals.data() + 4 * std::size_t{group};
            call.out[c] = {n[0], n[1], n[2]};
        }
    });
}

}  // namespace

NormalReport denoisedNormals(NormalsCall& call) {
    const NormalOptions& options = call.options;
    const bool by_guard = options.denoise == NormalOptions::denoise_auto;
    // Noise is that of the whole surface: what lies between hard edges may be too little to tell.
    const bool is_whole = options.weld_positions && options.crease_angle_deg >= 180 &&
                          options.smoothing_groups.empty() && call.posed.positions.data == call.mesh.positions.data;
    Buffer<std::uint32_t> components;
    call.components = &components;
    NormalReport report = averageNormals(call);
    PositionNoise noise =
        is_whole ? sampleEdges(call) : noiseOf(call.mesh, call.options.execution, call.parallel, !by_guard);
    if (!(noise.mean_edge > 0) || (by_guard && areClean(noise))) return report;
    const CornerGroups corner_groups(call, std::move(components));
    const NormalGroups groups(call, corner_groups, noise.mean_edge);
    if (is_whole) measureNoise(groups, call.allocator, noise);
    report.noise = by_guard ? noise.noise : options.denoise * noise.sigma;
    if (report.noise > 0) denoise(call, corner_groups, groups, report.noise);
    return report;
}

}  // namespace tspace
