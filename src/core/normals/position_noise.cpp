// SPDX-License-Identifier: MIT
// Noise in positions, by samples: how far vertices lie from the quadratic surface through two rings around them, and whether
// what normals do along edges looks like noise or like shape.
#include "tspace/position_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/angle.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/normals/denoise.h"
#include "core/normals/ring_fit.h"

namespace tspace {

namespace {

constexpr std::size_t kEdgeSamples = 16384;
constexpr std::size_t kMostVertexSamples = 4096, kLeastVertexSamples = 1024;  // a quarter of the vertices between these
constexpr std::size_t kLeastFits = 200;
constexpr double kNoisyShare = 0.15;  ///< of kinks, where positions hardly differ from a smooth surface

/// Of `count` samples of [0, all) the one with this number: one per stretch of equal length, at a place in it that repeats
/// with no period of the mesh.
std::size_t sampleAt(std::size_t number, std::size_t count, std::size_t all) {
    if (count >= all) return number;
    const std::uint32_t turn = static_cast<std::uint32_t>(number) * 2654435769u;  // the golden ratio's
    const double within = (turn >> 8) * (1.0 / (1 << 24));
    return std::min(all - 1, static_cast<std::size_t>((static_cast<double>(number) + within) *
                                                      (static_cast<double>(all) / static_cast<double>(count))));
}

double medianOf(float* begin, float* end) {
    float* const middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end);
    return *middle;
}

/// 3 u^2 - 2 u^3 of the place between two values.
double smoothStep(double low, double high, double value) {
    const double u = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

/// By length, of the edges of some vertices, in degrees.
double medianDihedral(const NormalGroups& groups, const Allocator* allocator) {
    constexpr std::size_t kVertices = 1024;
    struct Edge {
        double angle, length;
    };
    const std::size_t samples = std::min(groups.count(), kVertices);
    Buffer<Edge> edges(allocator, samples * RingWalk::kFan);
    std::size_t count = 0;
    double lengths = 0;
    const auto vectorTo = [&](std::size_t group, std::uint32_t other) {
        const Float4 v = groups.position(other) - groups.position(group);
        return DVec3{v[0], v[1], v[2]};
    };
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t group = sampleAt(i, samples, groups.count());
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
    double below = 0;
    for (std::size_t i = 0; i < count; ++i) {
        below += edges[i].length;
        if (below >= lengths / 2) return edges[i].angle;
    }
    return 0;
}

/// Noise of 1 edge turns edges by 110 to 160 degrees in the median; the least that was measured, on shapes with many sharp
/// edges, is 78. Of decimated shapes with sharp edges, whose faces are flat, it is below 31.
constexpr double kTurnOfNoise = 126, kLeastTurnOfNoise = 90;

/// The part of sigma that is noise.
double noisePart(double sigma, double kink_share, double dihedral) {
    constexpr double kLeast = 1e-3;  // of an edge: what a fit would gain is below what it costs
    if (!(sigma > 0)) return 0;
    // What a clean mesh shows of its shape as kinks, and as sigma, grow together.
    const double high = std::min(0.5, kNoisyShare + 5 * sigma);
    const double turn = dihedral / (kTurnOfNoise * sigma);
    const double part = std::min(sigma, dihedral / kLeastTurnOfNoise) * smoothStep(high / 2, high, kink_share) *
                        smoothStep(0.25, 0.5, turn);
    return part >= kLeast ? part : 0;
}

}  // namespace

bool areClean(const PositionNoise& sampled) { return sampled.kink_share <= kNoisyShare / 2; }

/// On a circle e . (m + n) is 0 for normals m and n at the ends of an edge e, and nearly so on everything that is smooth at the
/// mesh's scale; e . (n - m) is what an even bend gives.
PositionNoise sampleEdges(const NormalsCall& call) {
    constexpr double kFlat = 1e-7;  // squares of sines: an edge that turns by less has no kink
    const std::size_t corners = call.mesh.cornerCount(), samples = std::min(corners, kEdgeSamples);
    Buffer<float> shares(call.allocator, samples);
    std::size_t count = 0, edges = 0;
    double lengths = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const auto corner = static_cast<std::uint32_t>(sampleAt(i, samples, corners));
        const std::uint32_t next = call.faces.next(corner);
        const DVec3 edge = toDouble(call.posed.positions[call.mesh.indices[next]]) -
                           toDouble(call.posed.positions[call.mesh.indices[corner]]);
        const double size = length(edge);
        if (!(size > 0) || !std::isfinite(size) || !call.faces.isUsed(call.faces.of(corner))) continue;
        ++edges;
        lengths += size;
        if (call.out.count == 0) continue;
        const DVec3 m = toDouble(call.out[corner]), n = toDouble(call.out[next]);
        const double kink = dot(edge, m + n) / size, bend = dot(edge, n - m) / size;
        const double share = kink * kink / (kink * kink + bend * bend + kFlat);
        if (std::isfinite(share)) shares[count++] = static_cast<float>(share);
    }
    PositionNoise found;
    if (edges != 0) found.mean_edge = lengths / static_cast<double>(edges);
    if (count != 0) found.kink_share = static_cast<float>(medianOf(shares.begin(), shares.begin() + count));
    return found;
}

/// Each vertex without itself: r = |z(0)| / sqrt(1 + (A^-1)_00) has the spread of the noise, on every surface that two rings
/// show as a quadratic. By the median, so that edges and corners of the shape do not count.
double measureNoise(const NormalGroups& groups, const Allocator* allocator, PositionNoise& noise) {
    const std::size_t all = groups.count();
    const std::size_t samples = std::min(all, std::clamp(all / 4, kLeastVertexSamples, kMostVertexSamples));
    Buffer<float> distances(allocator, samples);
    groups.forSome(
        samples, [&](std::size_t i) { return sampleAt(i, samples, all); },
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
    if (end - distances.begin() < static_cast<std::ptrdiff_t>(kLeastFits)) return 0;
    constexpr double kMedianOfNormal = 0.6745;  // of |x| for a normal distribution
    const double sigma = medianOf(distances.begin(), end) / kMedianOfNormal;
    const double dihedral = medianDihedral(groups, allocator);
    noise.sigma = static_cast<float>(std::min(sigma, dihedral / kLeastTurnOfNoise));
    noise.noise = static_cast<float>(noisePart(sigma, noise.kink_share, dihedral));
    return std::min(sigma, dihedral / kTurnOfNoise);
}

double roughnessOf(const NormalsCall& call) {
    PositionNoise noise = sampleEdges(call);
    if (!(noise.mean_edge > 0)) return 0;
    return measureNoise(NormalGroups(call, CornerGroups(call, {}), noise.mean_edge), call.allocator, noise);
}

PositionNoise noiseOf(const MeshView& mesh, const Execution& execution, Parallel& parallel, bool wants_sigma) {
    Call<NormalOptions> options{{.weighting = NormalWeighting::best}, execution};
    Buffer<Vec3> normals(execution.allocator, mesh.cornerCount());
    const NormalsCall call(mesh, mesh, options, {normals.data(), normals.size()}, parallel);
    averageNormals(call);
    PositionNoise noise = sampleEdges(call);
    if (!(noise.mean_edge > 0) || (!wants_sigma && areClean(noise))) return noise;
    const CornerGroups corner_groups(call, {});
    measureNoise(NormalGroups(call, corner_groups, noise.mean_edge), execution.allocator, noise);
    return noise;
}

}  // namespace tspace
