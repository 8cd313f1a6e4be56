// SPDX-License-Identifier: MIT
// Measurement of noise (measureNoise), and denoised normals (denoisedNormals).
#include "tspace/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/estimate/denoise.h"

namespace tspace {

std::size_t sampledPlace(std::size_t number, std::size_t count, std::size_t all) {
    if (count >= all) return number;
    // 2^32 divided by the golden ratio, which distributes consecutive numbers evenly
    const std::uint32_t turn = static_cast<std::uint32_t>(number) * 2654435769u;
    const double within = (turn >> 8) * (1.0 / (1 << 24));
    return std::min(all - 1, static_cast<std::size_t>((static_cast<double>(number) + within) *
                                                      (static_cast<double>(all) / static_cast<double>(count))));
}

double medianOf(float* begin, float* end) {
    float* const middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    return *middle;
}

// Measures position noise on samples: the distances of vertices from the quadratic surface through the two rings around
// them, and whether the normals along edges look like noise or like shape.

namespace {

constexpr std::size_t kEdgeSamples = 16384;
// Number of sampled vertices: a quarter of all vertices, within these limits.
constexpr std::size_t kMostVertexSamples = 4096, kLeastVertexSamples = 1024;
constexpr std::size_t kLeastFits = 200;

/// Returns 3 u^2 - 2 u^3 for the relative position u of `value` between `low` and `high`.
double smoothStep(double low, double high, double value) {
    const double u = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

/// Returns the dihedral angles at the edges of up to 1,024 sampled groups.
Dihedrals sampleDihedrals(const NormalGroups& groups, std::size_t all, const Allocator* allocator) {
    constexpr std::size_t kVertices = 1024;
    struct Edge {
        double angle, length;
    };
    const std::size_t samples = std::min(all, kVertices);
    Buffer<Edge> edges(allocator, samples * RingWalk::kFan);
    std::size_t count = 0;
    double lengths = 0;
    const auto vectorTo = [&](std::size_t group, std::uint32_t other) {
        const Float4 v = groups.position(other) - groups.position(group);
        return DVec3{v[0], v[1], v[2]};
    };
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t group = sampledPlace(i, samples, all);
        const std::span<const NormalGroups::Ends> corners = groups.corners(group);
        if (corners.size() > RingWalk::kFan) continue;
        for (const NormalGroups::Ends& a : corners) {
            const auto b =
                std::find_if(corners.begin(), corners.end(), [&](const auto& c) { return c.previous == a.next; });
            if (b == corners.end()) continue;
            const DVec3 edge = vectorTo(group, a.next);
            const DVec3 m = cross(edge, vectorTo(group, a.previous)), n = cross(vectorTo(group, b->next), edge);
            if (!std::isfinite(dot(m, m) * dot(n, n))) continue;
            edges[count++] = {angleBetween(m, n) * (180 / kPi), length(edge)};
            lengths += length(edge);
        }
    }
    sortList(edges.begin(), edges.begin() + count, [](const Edge& a, const Edge& b) { return a.angle < b.angle; });
    Dihedrals found;
    double below = 0;
    for (std::size_t i = 0; i < count && below < lengths / 2; ++i) {
        if (below < lengths / 4) found.quarter = edges[i].angle;
        below += edges[i].length;
        found.median = edges[i].angle;
    }
    return found;
}

/// Median dihedral angle, in degrees, per edge length of noise: 110 to 160 on most shapes, and at least 78, on shapes
/// with many sharp edges. Decimated shapes with sharp edges, whose faces are flat, stay below 31.
constexpr double kTurnOfNoise = 126, kLeastTurnOfNoise = 90;

}  // namespace

double noisePart(double sigma, double kink_share, const Dihedrals& dihedrals) {
    constexpr double kLeast = 1e-3;  // minimum noise in edge lengths: below it, a fit costs more accuracy than it gains
    if (!(sigma > 0) || !(dihedrals.median > 0)) return 0;
    // On a mesh without noise, both the kink share and sigma grow with curvature.
    const double high = std::min(0.4, kNoisyShare + 3 * sigma);
    const double turn = dihedrals.median / (kTurnOfNoise * sigma);
    // Noise leaves no edge flat: the lower quartile of its dihedral angles is 0.36 to 0.49 of their median. Decimated
    // meshes have flat faces: their ratio is at most 0.3 (eleven shapes).
    const double part = std::min(sigma, dihedrals.median / kLeastTurnOfNoise) * smoothStep(high / 2, high, kink_share) *
                        smoothStep(0.25, 0.5, turn) * smoothStep(0.31, 0.36, dihedrals.quarter / dihedrals.median);
    return part >= kLeast ? part : 0;
}

double kinkShare(const DVec3& edge, const DVec3& m, const DVec3& n, double flat) {
    const double size = length(edge), kink = dot(edge, m + n) / size, bend = dot(edge, n - m) / size;
    return kink * kink / (kink * kink + bend * bend + flat);
}

PositionNoise sampleEdges(const NormalsCall& call) {
    constexpr double kFlat = 1e-7;
    const std::size_t corners = call.mesh.cornerCount(), samples = std::min(corners, kEdgeSamples);
    Buffer<float> shares(call.allocator, samples);
    std::size_t count = 0, edges = 0;
    double lengths = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const auto corner = static_cast<std::uint32_t>(sampledPlace(i, samples, corners));
        const std::uint32_t next = call.faces.next(corner);
        const DVec3 edge = toDouble(call.posed.positions[call.mesh.indices[next]]) -
                           toDouble(call.posed.positions[call.mesh.indices[corner]]);
        const double size = length(edge);
        if (!(size > 0) || !std::isfinite(size) || !call.faces.isUsed(call.faces.of(corner))) continue;
        ++edges;
        lengths += size;
        if (call.out.count == 0) continue;
        const DVec3 m = toDouble(call.out[corner]), n = toDouble(call.out[next]);
        const double share = kinkShare(edge, m, n, kFlat);
        if (std::isfinite(share)) shares[count++] = static_cast<float>(share);
    }
    PositionNoise found;
    if (edges != 0) found.mean_edge = lengths / static_cast<double>(edges);
    if (count != 0) found.kink_share = static_cast<float>(medianOf(shares.begin(), shares.begin() + count));
    return found;
}

/// Fits a surface to each vertex's neighborhood without the vertex itself: r = |z(0)| / sqrt(1 + (A^-1)_00) has the
/// standard deviation of the noise, on every surface that is quadratic within two rings. Uses the median, so that edges
/// and corners of the shape have no influence.
Roughness measureRoughness(const NormalGroups& groups, std::size_t all, const Allocator* allocator) {
    const std::size_t samples = std::min(all, std::clamp(all / 4, kLeastVertexSamples, kMostVertexSamples));
    Buffer<float> distances(allocator, samples);
    groups.forSome(
        samples, [&](std::size_t i) { return sampledPlace(i, samples, all); },
        [&](std::size_t i, std::size_t group, std::uint32_t* marks) {
            distances[i] = -1;
            const Float4 normal = groups.areaNormal(group);
            if (!(dotted(normal, normal) > 0)) return;
            RingWalk walk(groups, marks, static_cast<std::uint32_t>(group));
            if (!walk.grow() || !walk.grow()) return;
            RingSums sums;
            sums.add(groups, RingFrame(normal), walk, 1);
            const RingSums::Rest rest = sums.height();
            if (walk.size() < 9 || !rest.is_sound) return;
            const double height = rest.right[1] / rest.matrix[1][1], variance = 1 / rest.matrix[1][1];
            distances[i] = static_cast<float>(std::fabs(height) / std::sqrt(1 + variance));
        });
    float* const end = std::remove_if(distances.begin(), distances.end(), [](float d) { return !(d >= 0); });
    if (end - distances.begin() < static_cast<std::ptrdiff_t>(kLeastFits)) return {};
    constexpr double kMedianOfNormal = 0.6745;  // median of |x| for a normal distribution
    return {medianOf(distances.begin(), end) / kMedianOfNormal, sampleDihedrals(groups, all, allocator), true};
}

double measureNoise(const NormalGroups& groups, const Allocator* allocator, PositionNoise& noise) {
    const auto [sigma, dihedrals, is_known] = measureRoughness(groups, groups.count(), allocator);
    if (!is_known) return 0;
    noise.sigma = static_cast<float>(std::min(sigma, dihedrals.median / kLeastTurnOfNoise));
    noise.noise = static_cast<float>(noisePart(sigma, noise.kink_share, dihedrals));
    return std::min(sigma, dihedrals.median / kTurnOfNoise);
}

namespace {

/// Returns the factor by which noise lengthens edges. Noise of x lengthens edges by 2 x^2 (relative to their original
/// length: two of the three components of the displacement between their ends are perpendicular to them). `sigma` is
/// relative to the lengthened edges. Limited to the value for 0.3, the largest noise that was examined.
double growthOfEdges(double sigma) { return 2 / (1 + std::sqrt(1 - 8 * std::min(0.068, sigma * sigma))); }

}  // namespace

PositionNoise withoutGrowth(PositionNoise noise) {
    const double growth = growthOfEdges(noise.sigma);
    noise.sigma = static_cast<float>(growth * noise.sigma);
    noise.noise = static_cast<float>(growth * noise.noise);
    noise.mean_edge /= growth;
    return noise;
}

double roughnessOf(const NormalsCall& call) {
    PositionNoise noise = sampleEdges(call);
    if (!(noise.mean_edge > 0)) return 0;
    return measureNoise(NormalGroups(call, CornerGroups(call, {}), noise.mean_edge), call.allocator, noise);
}

PositionNoise noiseOf(const MeshView& mesh, const Execution& execution, Parallel& parallel, double fewest_kinks) {
    Call<NormalOptions> options{{.weighting = NormalWeighting::best}, execution};
    Buffer<Vec3> normals(execution.allocator, mesh.cornerCount());
    const NormalsCall call(mesh, mesh, options, {normals.data(), normals.size()}, parallel);
    averageNormals(call);
    PositionNoise noise = sampleEdges(call);
    if (!(noise.mean_edge > 0) || noise.kink_share <= fewest_kinks) return noise;
    const CornerGroups corner_groups(call, {});
    measureNoise(NormalGroups(call, corner_groups, noise.mean_edge), execution.allocator, noise);
    return noise;
}

// NormalOptions::denoise: local selection among fits. A quadratic surface through more rings has a normal with less
// noise, but may miss more shape. The noise follows from the points and sigma, the shape error from the difference
// between fits beyond the noise, averaged over a region. Each normal is weighted by its risk, the sum of both errors.
// Based on: Goldenshluger & Lepski's comparison of estimators ("Bandwidth selection in kernel density estimation",
// 2011): bias from the differences of nested estimates, minus their variance; here with a regional mean instead of a
// maximum.

namespace {

// Noise thresholds, in units of the mean edge. Above kRoughNoise, the normals that define the planes of the fits are
// averaged in three passes instead of one; above kLoudNoise, the normal of a single ring is too uncertain for
// comparisons.
constexpr double kRoughNoise = 0.15, kLoudNoise = 0.12;
constexpr int kBiasPasses = 8;
// Measured noise variance of `best` normals, relative to area-weighted normals.
constexpr double kFirstVariance = 1.15;

Float4 toFloat4(const Vec3& v) { return Float4{v.x, v.y, v.z, 0}; }
Float4 unitOr(Float4 v, Float4 other) {
    const float square = dotted(v, v);
    return square > 0 && std::isfinite(square) ? splat(1 / std::sqrt(square)) * v : other;
}

/// Fit over several rings: its normal and the variance of the normal.
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

/// Fits of a group: the first over two rings, the second over three.
struct Fits {
    float normals[2][4];  ///< normals of both fits; the fourth component is the variance
};

class Denoiser {
  public:
    Denoiser(const NormalGroups& groups, const Allocator* allocator, Parallel& parallel, double noise)
        : groups_(groups), allocator_(allocator), parallel_(parallel), noise_(noise) {}

    /// Denoises normals in place; `normals` has four floats per group.
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

    /// Returns the area-weighted normals, averaged with those of the neighbors in one or more passes.
    Buffer<float> makePlanes() {
        const std::size_t count = groups_.count();
        Buffer<float> planes(allocator_, 4 * count), before(allocator_, 4 * count);
        forRanges([&](std::size_t g) { storeFloat4(planes.data() + 4 * g, groups_.areaNormal(g)); });
        for (int pass = noise_ > kRoughNoise ? 3 : 1; pass != 0; --pass) {
            std::swap(planes, before);
            forRanges([&](std::size_t g) {
                const Float4 own = loadFloat4(before.data() + 4 * g);
                Float4 sum = own;
                for (const std::uint32_t n : groups_.neighbors(g))
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

    /// Computes the squared bias of the fits. The fits are nested least squares, so the variance of their difference
    /// equals the difference of their variances; any excess is bias. NaN means that no comparison is possible.
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
                const std::span<const std::uint32_t> around = groups_.neighbors(g);
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

/// Replaces the normals in call.out by denoised ones. `noise`: in the unit of `groups`.
void denoise(const NormalsCall& call, const CornerGroups& corner_groups, const NormalGroups& groups, double noise) {
    const std::size_t corner_count = call.mesh.cornerCount();
    Buffer<float> normals(call.allocator, 4 * groups.count(), 0.0f);
    for (std::uint32_t c = 0; c < corner_count; ++c)
        storeFloat4(normals.data() + 4 * std::size_t{corner_groups.of(c)}, toFloat4(call.out[c]));
    Denoiser(groups, call.allocator, call.parallel, noise).run(normals);
    call.parallel.forRanges(corner_count, Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const std::uint32_t group = corner_groups.of(static_cast<std::uint32_t>(c));
            // the corners of this group keep their substitute normals
            if (!std::isfinite(groups.areaVariance(group))) continue;
            const float* const n = normals.data() + 4 * std::size_t{group};
            call.out[c] = {n[0], n[1], n[2]};
        }
    });
}

}  // namespace

NormalReport denoisedNormals(NormalsCall& call) {
    const NormalOptions& options = call.options;
    const bool by_guard = options.denoise == NormalOptions::denoise_auto;
    // Noise is measured on the whole surface: regions between hard edges may be too small.
    const bool is_whole = options.weld_positions && options.crease_angle_deg >= 180 &&
                          options.smoothing_groups.empty() && call.posed.positions.data == call.mesh.positions.data;
    Buffer<std::uint32_t> components;
    call.components = &components;
    NormalReport report = averageNormals(call);
    PositionNoise noise =
        is_whole ? sampleEdges(call)
                 : noiseOf(call.mesh, call.options.execution, call.parallel, by_guard ? kNoisyShare / 2 : -1);
    if (!(noise.mean_edge > 0) || (by_guard && noise.kink_share <= kNoisyShare / 2)) return report;
    const CornerGroups corner_groups(call, std::move(components));
    const NormalGroups groups(call, corner_groups, noise.mean_edge);
    if (is_whole) measureNoise(groups, call.allocator, noise);
    const double removed = by_guard ? noise.noise : options.denoise * noise.sigma;
    report.noise = static_cast<float>(growthOfEdges(noise.sigma) * removed);
    if (removed > 0) denoise(call, corner_groups, groups, removed);
    return report;
}

}  // namespace tspace
