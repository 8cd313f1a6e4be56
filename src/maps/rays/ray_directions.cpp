// SPDX-License-Identifier: MIT
#include "maps/rays/ray_directions.h"

#include <algorithm>
#include <numeric>
#include <queue>
#include <span>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/mesh_loops.h"
#include "core/base/near_positions.h"
#include "core/base/vec_math.h"
#include "core/base/weld.h"
#include "maps/layout/low_points.h"
#include "maps/texels/texture_sample.h"

namespace tspace {
namespace {

/// Maximum ratio of the cage distance at a corner to that at its faces. Without this limit, the distance at spikes
/// would be unbounded.
constexpr double kMostFactor = 3;
/// Minimum cosine between the mean normal and a corner's own normal for the corner to use the mean: the two sides of a
/// leaf share positions but have opposite normals.
constexpr double kOwnPart = 0.05;

/// Distance from a hard edge within which ray directions bend toward it, relative to the cage offset. Measured on boxes
/// with bevels, ribs and bolts at an offset of 0.1, seen from seven sides: the results of 1 and 0.5 are equally close
/// to the high poly, those of 0.25 are as close except for misses at sharp rims, and those of 0.1 are as inaccurate as
/// with stored normals.
constexpr double kBend = 0.5;

DVec3 unitOr(DVec3 v, const DVec3& other) { return normalize(v) ? v : other; }

/// Whole mesh: the triangles that the map covers, followed by the others. Close positions are welded.
struct WholeMesh {
    WholeMesh(const LowPoly& low, float weld_distance, const Allocator* allocator, Parallel& parallel)
        : positions(allocator, low.positions.count + low.rest_positions.count), normals(allocator, positions.size()),
          faces(allocator, positions.size() / 3) {
        const std::size_t shown = low.positions.count;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            positions[i] = i < shown ? low.positions[i] : low.rest_positions[i - shown];
            normals[i] = i < shown ? low.normals[i] : low.rest_normals[i - shown];
        }
        const NearPositions near({.positions = view()}, weld_distance, allocator, parallel);
        if (!near.empty()) positions = near.moved(view());
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = unitOr(faceVector(view(), i), {});
        roots = weldPositions({.positions = view()}, allocator, parallel);
        if (roots.empty()) {
            roots = Buffer<std::uint32_t>(allocator, positions.size());
            std::iota(roots.begin(), roots.end(), 0U);
        }
    }

    [[nodiscard]] StridedSpan<const Vec3> view() const {
        return std::span<const Vec3>(positions.data(), positions.size());
    }
    [[nodiscard]] double angleAt(std::size_t corner) const {
        const std::size_t first = corner - corner % 3;
        const DVec3 at = toDouble(positions[corner]), a = toDouble(positions[first + (corner + 1) % 3]) - at,
                    b = toDouble(positions[first + (corner + 2) % 3]) - at;
        const double sum = a.x + a.y + a.z + b.x + b.y + b.z;
        return std::isfinite(sum) ? angleBetween(a, b) : 0;
    }

    Buffer<Vec3> positions, normals;
    Buffer<DVec3> faces;  ///< unit normal of each face; zero for degenerate faces
    Buffer<std::uint32_t> roots = {};
};

DVec3 ownOf(const WholeMesh& mesh, std::size_t corner) { return unitOr(toDouble(mesh.normals[corner]), {}); }

/// Returns, at the first corner of each position, the offset to the cage along the mean of all normals at that
/// position; zero if the mean has no direction.
Buffer<Vec3> meanOffsets(const WholeMesh& mesh, const Allocator* allocator) {
    const std::size_t count = mesh.positions.size();
    Buffer<DVec3> means(allocator, count, DVec3{});
    for (std::size_t i = 0; i < count; ++i)
        means[mesh.roots[i]] = means[mesh.roots[i]] + mesh.angleAt(i) * ownOf(mesh, i);
    for (std::size_t i = 0; i < count; ++i) means[i] = unitOr(means[i], {});
    // smallest cosine between the mean and any face normal at the position
    Buffer<double> along(allocator, count, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t root = mesh.roots[i];
        const DVec3& face = mesh.faces[i / 3];
        if (dot(face, face) > 0 && dot(means[root], ownOf(mesh, i)) > kOwnPart)
            along[root] = std::min(along[root], dot(means[root], face));
    }
    Buffer<Vec3> ways(allocator, count);
    for (std::size_t i = 0; i < count; ++i) ways[i] = toFloat((1 / std::max(along[i], 1 / kMostFactor)) * means[i]);
    return ways;
}

/// Returns, for each corner that the map covers, the mean offset of its position. If the mean is nearly perpendicular
/// or opposite to the corner's own normal, returns that normal instead.
Buffer<Vec3> averagedOffsets(const WholeMesh& mesh, const Buffer<Vec3>& means, std::size_t shown,
                             const Allocator* allocator) {
    Buffer<Vec3> ways(allocator, shown);
    for (std::size_t i = 0; i < shown; ++i) {
        const Vec3& mean = means[mesh.roots[i]];
        const DVec3 own = ownOf(mesh, i);
        const bool has_part = dot(unitOr(toDouble(mean), {}), own) > kOwnPart || dot(own, own) == 0;
        ways[i] = has_part ? mean : toFloat(own);
    }
    return ways;
}

std::uint32_t nextCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Hard edges of a mesh, at which faces meet at an angle, and the nearest hard edges of each corner.
struct HardEdges {
    struct Edge {
        std::array<std::uint32_t, 2> corners = {};  ///< the two ends of the edge
        DVec3 normal = {};                          ///< unit vector along the mean of the normals of its faces, or zero
    };
    std::vector<Edge> edges = {};
    // The two nearest hard edges of each corner, reached over faces that meet smoothly, at most `far` away. Empty, like
    // the other arrays, if no edge is hard.
    std::vector<std::array<std::uint32_t, 2>> nearest = {};
    /// Group ID of each corner. Corners at one position whose faces meet smoothly have the same ID, which is the index
    /// of one of these corners.
    std::vector<std::uint32_t> groups = {};
    std::vector<bool> at_edge = {};  ///< flag of each group: a hard edge starts or ends at one of its corners
};

/// Search for hard edges. Linear time, except for sorting the edges.
class HardEdgeSearch {
  public:
    HardEdgeSearch(const WholeMesh& mesh, double far) : mesh_(mesh), far_(far), groups_(mesh.positions.size()) {
        std::iota(groups_.begin(), groups_.end(), 0U);
    }

    HardEdges run() {
        const auto forHalves = [&](const auto& add) {
            for (std::uint32_t corner = 0; corner < mesh_.positions.size(); ++corner) {
                const std::uint32_t a = mesh_.roots[corner], b = mesh_.roots[nextCorner(corner)];
                if (a != b) add(std::min(a, b), std::max(a, b), corner);
            }
        };
        forEachEdge(mesh_.positions.size(), nullptr, forHalves,
                    [&](std::uint32_t low, std::uint32_t high, std::span<const HalfEdge> sides) {
                        joinOrMarkHard(low, high, sides);
                    });
        if (found_.edges.empty()) return std::move(found_);
        spread();
        found_.nearest.resize(groups_.size());
        found_.at_edge.resize(groups_.size());
        for (const auto& [corner, edge] : at_edges_) found_.at_edge[groupOf(corner)] = true;
        for (std::uint32_t i = 0; i < groups_.size(); ++i) {
            const std::uint32_t group = groupOf(i);
            found_.nearest[i] = near_[group];
            found_.at_edge[i] = found_.at_edge[group];
        }
        found_.groups.resize(groups_.size());
        for (std::uint32_t i = 0; i < groups_.size(); ++i) found_.groups[i] = groupOf(i);
        return std::move(found_);
    }

  private:
    [[nodiscard]] const DVec3& normalOf(std::uint32_t corner) const { return mesh_.faces[corner / 3]; }

    /// Processes the triangles of one edge: marks the edge as hard, or joins the corners at both of its ends.
    void joinOrMarkHard(std::uint32_t low, std::uint32_t high, std::span<const HalfEdge> sides) {
        constexpr double kCosine = 0.861629160441525819;  // cosine of kHardDeg
        if (sides.size() == 1) return;
        if (sides.size() == 2) {
            const DVec3 a = normalOf(cornerOf(sides[0])), b = normalOf(cornerOf(sides[1]));
            // A degenerate triangle has no normal, and so no angle.
            const bool has_angle = dot(a, a) > 0 && dot(b, b) > 0;
            if (!has_angle || dot(a, b) >= kCosine) {
                for (const std::uint32_t end : {low, high})
                    joinSets(groups_.data(), cornerAt(cornerOf(sides[0]), end), cornerAt(cornerOf(sides[1]), end));
                return;
            }
        }
        const auto edge = static_cast<std::uint32_t>(found_.edges.size());
        DVec3 normal{};
        for (const HalfEdge side : sides) normal = normal + normalOf(cornerOf(side));
        const std::uint32_t first = cornerOf(sides[0]);
        found_.edges.push_back({{first, nextCorner(first)}, normalize(normal) ? normal : DVec3{}});
        for (const HalfEdge side : sides) {
            at_edges_.push_back({cornerOf(side), edge});
            at_edges_.push_back({nextCorner(cornerOf(side)), edge});
        }
    }

    [[nodiscard]] std::uint32_t cornerAt(std::uint32_t side, std::uint32_t root) const {
        return mesh_.roots[side] == root ? side : nextCorner(side);
    }

    /// Returns the first corner of a corner's group.
    std::uint32_t groupOf(std::uint32_t corner) { return rootOf(groups_.data(), corner); }

    [[nodiscard]] double distanceTo(std::uint32_t edge, std::uint32_t corner) const {
        const auto& [from, to] = found_.edges[edge].corners;
        return std::sqrt(squaredDistanceTo(toDouble(mesh_.positions[corner]), toDouble(mesh_.positions[from]),
                                           toDouble(mesh_.positions[to])));
    }

    struct Reached {
        double distance = 0;
        std::uint32_t group = 0, edge = 0;
        bool operator<(const Reached& other) const {
            if (distance != other.distance) return distance > other.distance;
            return group != other.group ? group > other.group : edge > other.edge;
        }
    };

    /// Propagates hard edges from corners to the other corners of their triangles, nearest first. A corner propagates
    /// the first two edges that reach it.
    void spread() {
        near_.assign(groups_.size(), {kNoHardEdge, kNoHardEdge});
        // Linked lists of the corners of each group.
        std::vector<std::uint32_t> first(groups_.size(), kNoHardEdge), next(groups_.size(), kNoHardEdge);
        for (auto corner = static_cast<std::uint32_t>(groups_.size()); corner-- > 0;) {
            const std::uint32_t group = groupOf(corner);
            next[corner] = first[group];
            first[group] = corner;
        }
        std::priority_queue<Reached> queue;
        for (const auto& [corner, edge] : at_edges_) queue.push({0, groupOf(corner), edge});
        while (!queue.empty()) {
            const Reached reached = queue.top();
            queue.pop();
            auto& near = near_[reached.group];
            if (near[0] == reached.edge || near[1] != kNoHardEdge) continue;
            near[near[0] == kNoHardEdge ? 0 : 1] = reached.edge;
            for (std::uint32_t at = first[reached.group]; at != kNoHardEdge; at = next[at]) {
                for (std::uint32_t other = nextCorner(at); other != at; other = nextCorner(other)) {
                    const std::uint32_t group = groupOf(other);
                    if (near_[group][0] == reached.edge || near_[group][1] != kNoHardEdge) continue;
                    const double distance = distanceTo(reached.edge, other);
                    if (distance <= far_) queue.push({distance, group, reached.edge});
                }
            }
        }
    }

    const WholeMesh& mesh_;
    double far_;
    std::vector<std::uint32_t> groups_;  ///< disjoint sets of corners with equal positions whose faces meet smoothly
    std::vector<std::array<std::uint32_t, 2>> at_edges_ = {};  ///< pairs of a corner at a hard edge and that edge
    std::vector<std::array<std::uint32_t, 2>> near_ = {};      ///< hard edges near each group
    HardEdges found_ = {};
};

/// Returns the mean normal of the faces that meet smoothly at a corner with a hard edge, and `averaged` for other
/// corners.
Buffer<Vec3> straightOffsets(const WholeMesh& mesh, const HardEdges& hard, const Buffer<Vec3>& averaged,
                             const Allocator* allocator) {
    Buffer<DVec3> means(allocator, mesh.positions.size(), DVec3{});
    for (std::size_t i = 0; i < means.size(); ++i) {
        if (hard.at_edge[i]) means[hard.groups[i]] = means[hard.groups[i]] + mesh.angleAt(i) * mesh.faces[i / 3];
    }
    Buffer<Vec3> ways(allocator, averaged.size());
    for (std::size_t i = 0; i < ways.size(); ++i) {
        DVec3 mean = hard.at_edge[i] ? means[hard.groups[i]] : DVec3{};
        ways[i] = normalize(mean) ? toFloat(mean) : averaged[i];
    }
    return ways;
}

DVec3 mixedOffset(const Buffer<Vec3>& values, std::size_t triangle, const std::array<double, 3>& weights) {
    return mixedAt(StridedSpan<const Vec3>(std::span<const Vec3>(values.data(), values.size())), triangle, weights);
}

}  // namespace

RayField::RayField(const LowPoly& low, const RayOptions& rays, double offset, Parallel& parallel,
                   const Allocator* allocator)
    : low_(low), rays_(rays), offset_(offset) {
    if (!low.cage.empty()) return;
    const bool has_skew_map = !rays.skew.texels.empty();
    if (rays.directions == RayDirections::normals && !has_skew_map) return;
    const WholeMesh mesh(low, rays.weld_distance, allocator, parallel);
    const std::size_t shown = low.positions.count;
    const Buffer<Vec3> means = meanOffsets(mesh, allocator);
    averaged_ = averagedOffsets(mesh, means, shown, allocator);
    if (rays.directions != RayDirections::automatic || has_skew_map) return;
    bend_ = kBend * offset;
    const HardEdges hard = HardEdgeSearch(mesh, 2 * bend_).run();
    if (hard.edges.empty()) return;
    edges_ = Buffer<HardEdge>(allocator, hard.edges.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const auto& [corners, normal] = hard.edges[i];
        const double along = dot(normal, mesh.faces[corners[0] / 3]);
        edges_[i] = {.from = mesh.positions[corners[0]],
                     .to = mesh.positions[corners[1]],
                     .offset = toFloat((1 / std::max(along, 1 / kMostFactor)) * normal),
                     .offset_at_from = means[mesh.roots[corners[0]]],
                     .offset_at_to = means[mesh.roots[corners[1]]]};
    }
    near_ = Buffer<NearEdges>(allocator, shown);
    for (std::size_t i = 0; i < shown; ++i) near_[i] = hard.nearest[i];
    straight_ = straightOffsets(mesh, hard, averaged_, allocator);
}

bool RayField::at(std::size_t triangle, const std::array<double, 3>& weights, DVec3& outward, double& height) const {
    if (averaged_.empty()) {
        outward = mixedAt(low_.normals, triangle, weights);
        height = offset_;
        return normalizeOrdinary(outward);
    }
    DVec3 offset = mixedOffset(near_.empty() ? averaged_ : straight_, triangle, weights);
    if (!rays_.skew.texels.empty()) {
        const double part = painted(triangle, weights);
        offset = (1 - part) * offset + part * unitOr(faceVector(low_.positions, triangle), {});
    } else if (isNearEdges(triangle)) {
        offset = bentAtEdges(triangle, mixedAt(low_.positions, triangle, weights), offset);
    }
    height = offset_ * length(offset);
    outward = offset;
    return normalizeOrdinary(outward) && std::isfinite(height);
}

double RayField::painted(std::size_t triangle, const std::array<double, 3>& weights) const {
    const MapImage& image = rays_.skew;
    const TextureShape shape{image.width, image.height, image.wrap_u, image.wrap_v};
    return static_cast<double>(sampleBilinear(shape, image.texels, mixedAt(low_.uvs, triangle, weights)).x);
}

DVec3 RayField::bentAtEdges(std::size_t triangle, const DVec3& point, const DVec3& straight) const {
    const auto smooth = [](double part) { return part * part * (3 - 2 * part); };
    DVec3 sum{};
    double total = 0;
    std::array<std::uint32_t, 6> seen{};
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::uint32_t number = near_[3 * triangle + i / 2][i % 2];
        const bool is_known = std::any_of(seen.begin(), seen.begin() + i, [&](auto other) { return other == number; });
        seen[i] = number;
        if (number == kNoHardEdge || is_known) continue;
        const HardEdge& edge = edges_[number];
        const DVec3 from = toDouble(edge.from), to = toDouble(edge.to);
        const double part = nearestPart(point, from, to);
        const DVec3 at = from + part * (to - from);
        const double away = length(point - at);
        if (!(away < bend_)) continue;
        // Along an edge, its own offset is used; near its ends, the offset blends into that of the end vertex, so that
        // the directions of adjacent faces agree.
        const double size = length(to - from), near_end = std::min(bend_, size / 2);
        const double of_from = smooth(std::max(0.0, 1 - part * size / near_end)),
                     of_to = smooth(std::max(0.0, 1 - (1 - part) * size / near_end));
        DVec3 offset = toDouble(edge.offset);
        offset = offset + of_from * (toDouble(edge.offset_at_from) - offset) +
                 of_to * (toDouble(edge.offset_at_to) - offset);
        // If there are several edges, closer ones have more weight; a single edge has full weight.
        const double bent = smooth(1 - away / bend_), least = 1e-6 * bend_;
        const double weight = bent / (away * away + least * least);
        sum = sum + (weight * bent) * (offset - straight);
        total += weight;
    }
    return total > 0 ? straight + (1 / total) * sum : straight;
}

}  // namespace tspace
