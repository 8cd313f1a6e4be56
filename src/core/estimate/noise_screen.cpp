// SPDX-License-Identifier: MIT
// Screening test for noise (mayHaveNoise) on samples gathered in passes over vertices and triangles, so that a clean
// mesh is neither welded nor sorted. First it measures the kinks at sampled edges; if there are many, also the two-ring
// neighborhoods of the start vertices of these edges.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "core/base/mesh_loops.h"
#include "core/base/unique_index.h"
#include "core/estimate/denoise.h"

namespace tspace {
namespace {

constexpr std::size_t kEdges = 512;
/// Maximum number of points in the two rings around the sampled edge ends. Most meshes have about 20,000 of these; more
/// than kMostPoints indicate triangle fans.
constexpr std::size_t kMostPoints = 32768;

/// Safety factors for the values that all vertices would give. The factor for sigma covers three standard errors. One
/// standard error is 5.3 % for the median of 480 noisy distances, and 1.8 % for the median of 4096.
constexpr double kSigmaError = 1.17, kDihedralError = 1.25, kKinkError = 1.1;
constexpr double kMostGrowth = 1.2;  // maximum factor by which withoutGrowth (denoise.h) increases the noise

bool areEqual(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Set of mesh positions, numbered in order of insertion. A one-bit filter rejects nearly all other positions.
class SomePoints {
  public:
    static constexpr std::uint16_t kNone = 0xffff;

    /// `room`: capacity, limited to kMostPoints.
    SomePoints(const Allocator* allocator, std::size_t room)
        : points_(allocator, std::min(room, kMostPoints)),
          slots_(allocator, std::bit_ceil(2 * points_.size() + 1), kNone), filter_(allocator, kFilterWords, 0u) {}

    void clear() {
        count_ = 0;
        std::fill(slots_.begin(), slots_.end(), kNone);
        std::fill(filter_.begin(), filter_.end(), 0u);
    }
    /// Returns the index of a position, or kNone if the set is full.
    std::uint16_t add(const Vec3& position) {
        const std::uint32_t hash = hashOf(position);
        std::uint16_t& slot = slotOf(position, hash);
        if (slot == kNone && count_ < points_.size()) {
            filter_[wordOf(hash)] |= bitOf(hash);
            points_[count_] = position;
            slot = static_cast<std::uint16_t>(count_++);
        }
        return slot;
    }
    [[nodiscard]] std::uint16_t numberOf(const Vec3& position) {
        const std::uint32_t hash = hashOf(position);
        return (filter_[wordOf(hash)] & bitOf(hash)) == 0 ? kNone : slotOf(position, hash);
    }
    [[nodiscard]] std::span<const Vec3> list() const { return {points_.data(), count_}; }

  private:
    static constexpr std::size_t kFilterBits = 17, kFilterWords = (std::size_t{1} << kFilterBits) / 32;

    static std::uint32_t hashOf(const Vec3& p) {
        const std::uint32_t all = weldBits(p.x) * 0x9e3779b1u ^ std::rotl(weldBits(p.y) * 0x85ebca6bu, 11) ^
                                  std::rotl(weldBits(p.z) * 0xc2b2ae35u, 22);
        return (all ^ all >> 15) * 0x2c1b3c6du;
    }
    static std::uint32_t wordOf(std::uint32_t hash) { return hash >> (32 - kFilterBits) >> 5; }
    static std::uint32_t bitOf(std::uint32_t hash) { return 1u << (hash >> (32 - kFilterBits) & 31); }

    std::uint16_t& slotOf(const Vec3& position, std::uint32_t hash) {
        for (std::size_t at = hash;; ++at) {
            std::uint16_t& slot = slots_[at & (slots_.size() - 1)];
            if (slot == kNone || areEqual(points_[slot], position)) return slot;
        }
    }

    Buffer<Vec3> points_;
    Buffer<std::uint16_t> slots_;
    Buffer<std::uint32_t> filter_;
    std::size_t count_ = 0;
};

class NoiseScreen {
  public:
    NoiseScreen(const MeshView& mesh, const Execution& execution, Parallel& parallel)
        : mesh_(mesh), execution_(execution), parallel_(parallel), points_(execution.allocator, mesh.positions.count),
          edges_(execution.allocator, kEdges), point_of_(execution.allocator, mesh.positions.count) {}

    bool mayHave(double noise) {
        sampleEdges();
        if (edge_count_ == 0) return false;
        // The kink share of these normals is larger than that of the normals of `best` (measured on 235 primitives), so
        // a low share is reliable. The error of the median is 0.02.
        const double kinks = kinkShareOfEdges(noise);
        if (kinks <= kFewKinks) return false;
        const std::optional<Roughness> roughness = roughnessAroundEdges();
        if (!roughness || !roughness->is_known) return true;
        // A sample of edges cannot estimate the share of flat edges, so a reduced median is used for both values of
        // Dihedrals.
        const double turned = kDihedralError * roughness->dihedrals.median;
        for (const double error : {1 / kSigmaError, 1.0, kSigmaError})
            if (kMostGrowth * noisePart(error * roughness->sigma, kKinkError * kinks, {turned, turned}) >= noise)
                return true;
        return false;
    }

  private:
    struct Edge {
        Vec3 from;
        DVec3 vector;
        std::uint16_t begin, end;
    };

    void sampleEdges() {
        const std::size_t corners = mesh_.cornerCount(), samples = std::min(corners, kEdges);
        for (std::size_t i = 0; i < samples; ++i) {
            const std::size_t corner = sampledPlace(i, samples, corners),
                              next = corner % 3 == 2 ? corner - 2 : corner + 1;
            const Vec3 from = mesh_.positions[mesh_.indices[corner]], to = mesh_.positions[mesh_.indices[next]];
            if (!isFinite(from) || !isFinite(to) || areEqual(from, to)) continue;
            edges_[edge_count_++] = {from, toDouble(to) - toDouble(from), points_.add(from), points_.add(to)};
        }
    }

    void findPoints() {
        for (std::size_t v = 0; v < point_of_.size(); ++v) point_of_[v] = points_.numberOf(mesh_.positions[v]);
    }
    /// Calls body(vertices) for each triangle with a corner that the last call of findPoints() found.
    template <class Body>
    void forTrianglesThere(const Body& body) const {
        const std::size_t corners = mesh_.cornerCount();
        const std::uint16_t* const point_of = point_of_.data();
        withIndices(mesh_.indices, [&](auto vertexOf) {
            for (std::size_t c = 0; c < corners; c += 3) {
                const std::uint32_t v[3] = {vertexOf(c), vertexOf(c + 1), vertexOf(c + 2)};
                if ((point_of[v[0]] & point_of[v[1]] & point_of[v[2]]) != SomePoints::kNone) body(v);
            }
        });
    }

    /// Returns the median kink share, from sums of face normals that are exact on spheres.
    /// Based on: Max, "Weights for Computing Vertex Normals from Facet Normals", 1999.
    double kinkShareOfEdges(double noise) {
        Buffer<DVec3> normals(execution_.allocator, points_.list().size(), DVec3{});
        findPoints();
        forTrianglesThere([&](const std::uint32_t(&v)[3]) {
            const DVec3 p[3] = {toDouble(mesh_.positions[v[0]]), toDouble(mesh_.positions[v[1]]),
                                toDouble(mesh_.positions[v[2]])};
            const DVec3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2], normal = cross(a, b);
            const double across[3] = {dot(b, b), dot(c, c), dot(a, a)}, all = across[0] * across[1] * across[2];
            if (!(all > 0) || !std::isfinite(all)) return;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint16_t point = point_of_[v[k]];
                if (point != SomePoints::kNone) normals[point] = normals[point] + across[k] / all * normal;
            }
        });
        for (DVec3& normal : std::span(normals.data(), normals.size())) normalize(normal);
        Buffer<float> shares(execution_.allocator, edge_count_);
        // Edges with smaller angles count as having no kink. This threshold reduces the kink shares of noise by at most
        // 5 % (measured on scans).
        const double flat = noise * noise / 16;
        std::size_t count = 0;
        for (const Edge& edge : edges()) {
            const double share = kinkShare(edge.vector, normals[edge.begin], normals[edge.end], flat);
            if (std::isfinite(share)) shares[count++] = static_cast<float>(share);
        }
        return count == 0 ? 0 : medianOf(shares.begin(), shares.begin() + count);
    }

    /// Returns the roughness around the sampled edges, or nothing if they have more neighboring points than fit in
    /// `points_`.
    std::optional<Roughness> roughnessAroundEdges() {
        double lengths = 0;
        points_.clear();
        for (const Edge& edge : edges()) {
            lengths += length(edge.vector);
            points_.add(edge.from);
        }
        const std::size_t seeds = points_.list().size();
        bool is_full = false;
        const auto add = [&](std::uint32_t vertex) {
            const std::uint16_t point = points_.add(mesh_.positions[vertex]);
            is_full = is_full || point == SomePoints::kNone;
            return point;
        };
        findPoints();
        forTrianglesThere([&](const std::uint32_t(&v)[3]) {
            for (const std::uint32_t vertex : v) add(vertex);
        });
        if (is_full) return std::nullopt;
        findPoints();
        std::size_t count = 0;
        forTrianglesThere([&](const auto&) { ++count; });
        Buffer<std::uint32_t> corners(execution_.allocator, 3 * count);
        std::uint32_t* to = corners.data();
        forTrianglesThere([&](const std::uint32_t(&v)[3]) {
            for (const std::uint32_t vertex : v) *to++ = add(vertex);
        });
        if (is_full) return std::nullopt;
        MeshView around;
        around.positions = points_.list();
        around.indices = IndexView(std::span<const std::uint32_t>(corners.data(), corners.size()));
        Call<NormalOptions> options{{}, execution_};
        options.weld_positions = false;
        const NormalsCall call(around, around, options, {}, parallel_);
        const CornerGroups corner_groups(call, {});
        return measureRoughness(NormalGroups(call, corner_groups, lengths / static_cast<double>(edge_count_)), seeds,
                                execution_.allocator);
    }

    [[nodiscard]] std::span<const Edge> edges() const { return {edges_.data(), edge_count_}; }

    const MeshView& mesh_;
    const Execution& execution_;
    Parallel& parallel_;
    SomePoints points_;
    Buffer<Edge> edges_;
    std::size_t edge_count_ = 0;
    Buffer<std::uint16_t> point_of_;
};

}  // namespace

bool mayHaveNoise(const MeshView& mesh, double noise, const Execution& execution, Parallel& parallel) {
    return NoiseScreen(mesh, execution, parallel).mayHave(noise);
}

}  // namespace tspace
