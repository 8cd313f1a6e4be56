// SPDX-License-Identifier: MIT
// Graph of groups: a counting sort of corners, then the neighbors of each group.
#include "core/estimate/denoise.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/base/vec_math.h"

namespace tspace {

CornerGroups::CornerGroups(const NormalsCall& call, Buffer<std::uint32_t> components)
    : call_(call), numbers_(std::move(components)), count_(call.mesh.vertexCount()) {
    if (numbers_.empty()) return;
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < numbers_.size(); ++c) {
        // first corner of c's component; if it precedes c, its entry already contains the number of the group
        const std::uint32_t lowest = numbers_[c];
        numbers_[c] = lowest == c ? count++ : numbers_[lowest];
    }
    count_ = count;
}

NormalGroups::NormalGroups(const NormalsCall& call, const CornerGroups& corner_groups, double length)
    : call_(call), count_(corner_groups.count()), positions_(call.allocator, 4 * count_, 0.0f),
      normals_(call.allocator, 4 * count_), variances_(call.allocator, count_), begins_(call.allocator, count_ + 2, 0u),
      counts_(call.allocator, count_) {
    sortCorners(corner_groups, length);
    marks_ = Buffer<std::uint32_t>(call.allocator, count_ * call.parallel.width());
    findNeighbors();
}

void NormalGroups::sortCorners(const CornerGroups& corner_groups, double length) {
    const std::size_t corner_count = call_.mesh.cornerCount();
    const StridedSpan<const Vec3>& positions = call_.posed.positions;
    const IndexView& indices = call_.mesh.indices;
    const double per_length = 1 / length;
    const auto around = [&](std::uint32_t corner) {
        if (!call_.are_triangles) return call_.faces.around(corner);
        const std::uint32_t first = corner / 3 * 3, k = corner - first;
        return MeshFaces::Around{{corner, first + (k == 2 ? 0 : k + 1), first + (k == 0 ? 2 : k - 1)}};
    };
    DVec3 origin;
    for (std::uint32_t c = 0; c < corner_count; ++c) {
        if (!isFinite(positions[indices[c]])) continue;
        origin = toDouble(positions[indices[c]]);
        break;
    }
    // A corner contributes only if its triangle has three different groups.
    const auto read = [&](std::uint32_t corner, std::uint32_t(&groups)[3]) {
        if (!call_.are_triangles && !call_.faces.isUsed(call_.faces.of(corner))) return false;
        const MeshFaces::Around a = around(corner);
        for (std::size_t k = 0; k < 3; ++k) groups[k] = corner_groups.of(a.corners[k]);
        return groups[0] != groups[1] && groups[1] != groups[2] && groups[2] != groups[0];
    };
    std::uint32_t groups[3];
    for (std::uint32_t c = 0; c < corner_count; ++c) {
        if (!read(c, groups)) continue;
        ++begins_[groups[0] + 2];
        const DVec3 p = per_length * (toDouble(positions[indices[c]]) - origin);
        storeFloat4(positions_.data() + 4 * std::size_t{groups[0]},
                    Float4{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0});
    }
    for (std::size_t g = 2; g < count_ + 2; ++g) {
        most_corners_ = std::max<std::size_t>(most_corners_, begins_[g]);
        begins_[g] += begins_[g - 1];
    }
    corners_ = Buffer<Ends>(call_.allocator, begins_[count_ + 1]);
    for (std::uint32_t c = 0; c < corner_count; ++c) {
        if (read(c, groups)) corners_[begins_[groups[0] + 1]++] = {groups[1], groups[2]};
    }
}

void NormalGroups::findNeighbors() {
    neighbors_ = Buffer<std::uint32_t>(call_.allocator, 2 * corners_.size());
    // begins_ counts corners; each corner adds up to two neighbors.
    const std::size_t turns_each = 4 * 2 * most_corners_, tasks = count_ == 0 ? 0 : marks_.size() / count_;
    Buffer<float> turns(call_.allocator, tasks * turns_each);
    forAll([&](std::uint32_t group, std::uint32_t* places) {
        const std::size_t task = static_cast<std::size_t>(places - marks_.data()) / count_;
        findNeighbors(group, corners_.data() + begins_[group], corners_.data() + begins_[group + 1], places,
                      turns.data() + task * turns_each);
    });
    for (std::size_t g = 0; g <= count_; ++g) begins_[g] *= 2;
}

/// Computes the neighbors and the area normal of a group, with its variance. The vector area is half the sum of (p_j -
/// p) x (p_j+1 - p). Moving p_j by d along the normal changes it by d times half the vector from the neighbor before
/// p_j to the neighbor after it: the variance is the sum of the squares of these vectors over the square of the area.
void NormalGroups::findNeighbors(std::uint32_t group, const Ends* begin, const Ends* end, std::uint32_t* places,
                                 float* turns) {
    std::uint32_t* const list = neighbors_.data() + 2 * std::size_t{begins_[group]};
    std::uint32_t count = 0;
    const auto turnOf = [&](std::uint32_t neighbor) {
        std::uint32_t place = places[neighbor];
        if (place >= count || list[place] != neighbor) {
            place = count++;
            places[neighbor] = place;
            list[place] = neighbor;
            storeFloat4(turns + 4 * std::size_t{place}, splat(0.0f));
        }
        return turns + 4 * std::size_t{place};
    };
    const Float4 here = position(group);
    Float4 area = splat(0.0f);
    for (const Ends* corner = begin; corner != end; ++corner) {
        const Float4 next = position(corner->next) - here, previous = position(corner->previous) - here;
        const Float4 part = crossed(next, previous);
        if (!std::isfinite(dotted(part, part))) continue;
        area += part;
        float* const at_next = turnOf(corner->next);
        storeFloat4(at_next, loadFloat4(at_next) + previous);
        float* const at_previous = turnOf(corner->previous);
        storeFloat4(at_previous, loadFloat4(at_previous) - next);
    }
    float squares = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Float4 turn = loadFloat4(turns + 4 * std::size_t{i});
        squares += dotted(turn, turn);
    }
    counts_[group] = count;
    const float area_square = dotted(area, area), factor = static_cast<float>(call_.factor);
    const bool has_normal = area_square > 0 && std::isfinite(area_square) && std::isfinite(squares);
    variances_[group] = has_normal ? squares / area_square : std::numeric_limits<float>::infinity();
    storeFloat4(normals_.data() + 4 * std::size_t{group},
                has_normal ? (factor / std::sqrt(area_square)) * area : splat(0.0f));
}

bool RingWalk::grow() {
    const std::size_t end = size_;
    for (std::size_t i = ring_; i < end; ++i) {
        const std::span<const std::uint32_t> around = groups_.neighbors(list_[i]);
        if (around.size() <= kFan) [[likely]] {
            for (const std::uint32_t group : around) add(group);
        } else {
            for (std::size_t k = 0; k < kFan; ++k) add(around[around.size() * k / kFan]);
        }
        if (size_ > kMost) return false;
    }
    ring_ = end;
    return true;
}

}  // namespace tspace
