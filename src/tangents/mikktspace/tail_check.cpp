// SPDX-License-Identifier: MIT
// Step 5: whether the last bucket of the reference's edge list can matter.
//
// An edge's key is the lower one of its two nodes' representatives (which are corners), and the last bucket
// holds the edges with the largest key, V. Where are they? Let F be the first corner of some triangles at the
// end of the list, so that corners from F on are in these triangles only, and S the nodes that have such a
// corner.
//
//   If V >= F, both ends of every edge of the last bucket are in S: the lower end's representative is V, the
//   higher end's is larger, and a node's representative is one of its corners.
//
// So it is enough to look at edges with both ends in S. Let L be the largest key among them. V >= L, since
// they are edges of the mesh. If L >= F, then V >= F, all of the bucket is among them, and V = L. Else V < F
// (otherwise V would be the key of one of them), and the end of the list has to be taken longer; with the
// whole list F is its first corner.
//
// To find L, few representatives are needed. A node's last corner is the most that its representative can be,
// which bounds an edge's key from above. The edges of the highest bounds are worked out exactly, then those
// whose bound reaches the best key found.
#include "tangents/mikktspace/tail_check.h"

#include <algorithm>

#include "core/vec_math.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/grouped_plan.h"
#include "tangents/mikktspace/growing.h"
#include "tangents/mikktspace/weld_order.h"

namespace tspace::mikk {

namespace {

constexpr std::size_t kFirstTail = 2048;  // triangles; in a mesh in natural order, a few rows
constexpr std::size_t kShortTail = 32;    // for meshes of few triangles
constexpr std::size_t kFew = 16384;
constexpr std::size_t kLonger = 16;      // times, when that was not enough
constexpr std::size_t kFirstEdges = 64;  // that are worked out before a better bound is known
constexpr std::size_t kMostEdges = 512;

/// A half-edge with both ends in S.
struct LateEdge {
    std::uint32_t from, to;  // nodes
};

class TailCheck {
  public:
    TailCheck(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
              const Allocator* allocator, Parallel& parallel)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          allocator_(allocator),
          parallel_(parallel),
          order_(mesh, triangles, nodes, allocator, parallel),
          corners_(allocator, nodes.count),
          edges_(allocator) {}

    bool run() {
        for (std::size_t length = triangles_.count < kFew ? kShortTail : kFirstTail;; length *= kLonger) {
            const std::size_t begin = tailOf(length);
            collectEdges(begin);
            const std::uint32_t first_corner = firstCorner(begin);
            if (findLargestKey(first_corner, begin == 0) && key_ >= first_corner) break;
            if (begin == 0) return false;  // no edge at all
        }
        return bucketMatters();
    }

  private:
    /// Where the last `length` triangles begin, or a few more: a face is not cut in two.
    [[nodiscard]] std::size_t tailOf(std::size_t length) const {
        if (length >= triangles_.count) return 0;
        std::size_t begin = triangles_.count - length;
        while (begin > 0 && triangles_.face(begin - 1) == triangles_.face(begin)) --begin;
        return begin;
    }

    /// F: a face's first corner is in one of its triangles.
    [[nodiscard]] std::uint32_t firstCorner(std::size_t triangle) const {
        std::uint32_t first = kNone;
        for (std::size_t t = triangle;
             t < triangles_.count && triangles_.face(t) == triangles_.face(triangle); ++t) {
            for (std::size_t k = 0; k < 3; ++k) first = std::min(first, triangles_.corner(3 * t + k));
        }
        return first;
    }

    [[nodiscard]] std::uint32_t nodeAt(std::size_t entry) const {
        return nodes_.of(mesh_, triangles_.corner(entry));
    }

    [[nodiscard]] bool isGood(std::size_t triangle) const {
        const auto at = [&](std::size_t k) {
            return mesh_.positions[mesh_.indices[triangles_.corner(3 * triangle + k)]];
        };
        const Vec3 a = at(0), b = at(1), c = at(2);
        return !(a == b || b == c || c == a);
    }

    /// S, with the last corners of its nodes; then the edges that have both ends in S.
    void collectEdges(std::size_t begin) {
        Marks late_vertices = noMarks(allocator_, mesh_.vertexCount());
        {
            Marks late_nodes = noMarks(allocator_, nodes_.count);
            for (std::size_t t = triangles_.count; t-- > begin;) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t corner = triangles_.corner(3 * t + k),
                                        node = nodes_.of(mesh_, corner);
                    if (late_nodes[node] == 0) corners_[node] = corner;
                    // Corners of a face are in no order; those of later faces are larger.
                    corners_[node] = std::max(corners_[node], corner);
                    late_nodes[node] = 1;
                    late_vertices[mesh_.indices[corner]] = 1;
                }
            }
            for (std::size_t v = 0; v < nodes_.of_vertex.size(); ++v) {
                late_vertices[v] = late_nodes[nodes_.of_vertex[v]];
            }
        }
        const Buffer<std::uint32_t> found =
            collectTriangles(mesh_, triangles_, late_vertices, 2, allocator_, parallel_);
        edges_.drop(edges_.size());
        for (const std::uint32_t t : found) {
            if (!isGood(t)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t from = 3 * std::size_t{t} + k, to = k == 2 ? from - 2 : from + 1;
                if (late_vertices[mesh_.indices[triangles_.corner(from)]] == 0 ||
                    late_vertices[mesh_.indices[triangles_.corner(to)]] == 0)
                    continue;
                edges_.push({nodeAt(from), nodeAt(to)});
            }
        }
    }

    /// Never below the edge's key; equal to it when both ends are exact.
    [[nodiscard]] std::uint32_t bound(const LateEdge& e) const {
        return std::min(corners_[e.from], corners_[e.to]);
    }

    /// L, if it is not below F; else anything below F. Returns false when there is no edge. All edges whose
    /// bound is L are exact afterwards.
    bool findLargestKey(std::uint32_t first_corner, bool is_whole_list) {
        if (edges_.empty()) return false;
        const auto higher = [&](const LateEdge& a, const LateEdge& b) { return bound(a) > bound(b); };
        Marks exact = noMarks(allocator_, nodes_.count);
        key_ = 0;
        // In a mesh without order one edge in thirty or so has its key at the end, so a few are tried, and
        // some more. (Each time all vertices are read.) Then it is as well to make the end of the list
        // longer.
        std::size_t step = kFirstEdges;
        for (std::size_t done = 0; done < edges_.size() && key_ < first_corner; step *= 8) {
            if (step > kMostEdges && !is_whole_list) return false;
            const std::size_t end = is_whole_list ? edges_.size() : std::min(done + step, edges_.size());
            std::nth_element(edges_.begin() + done, edges_.begin() + (end - 1), edges_.end(), higher);
            workOut(bound(edges_[end - 1]), exact);
            for (const LateEdge& e : edges_) {
                if (exact[e.from] != 0 && exact[e.to] != 0) key_ = std::max(key_, bound(e));
            }
            done = end;
        }
        workOut(std::max(key_, first_corner), exact);
        for (const LateEdge& e : edges_) {
            if (exact[e.from] != 0 && exact[e.to] != 0) key_ = std::max(key_, bound(e));
        }
        return true;
    }

    /// Makes the ends of all edges exact whose bound reaches the limit.
    void workOut(std::uint32_t limit, Marks& exact) {
        Growing<std::uint32_t> asked(allocator_);  // a vertex of each
        for (const LateEdge& e : edges_) {
            if (bound(e) < limit) continue;
            for (const std::uint32_t node : {e.from, e.to}) {
                if (exact[node] != 0) continue;
                exact[node] = 1;
                asked.push(mesh_.indices[corners_[node]]);
            }
        }
        if (!asked.empty()) order_.findSome({asked.begin(), asked.end()}, corners_.data());
    }

    bool bucketMatters() {
        struct Record {
            std::uint32_t high;
            bool ascending;
        };
        Growing<Record> bucket(allocator_);
        for (const LateEdge& e : edges_) {
            if (bound(e) != key_) continue;
            const bool ascending = corners_[e.from] < corners_[e.to];
            bucket.push({ascending ? e.to : e.from, ascending});
        }
        if (bucket.size() <= 2) return false;
        std::sort(bucket.begin(), bucket.end(), [](const Record& a, const Record& b) {
            return a.high != b.high ? a.high < b.high : a.ascending < b.ascending;
        });
        for (std::size_t i = 1; i < bucket.size(); ++i) {
            if (bucket[i].high == bucket[i - 1].high && bucket[i].ascending != bucket[i - 1].ascending)
                return true;
        }
        return false;
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const Allocator* allocator_;
    Parallel& parallel_;
    WeldOrder order_;
    Buffer<std::uint32_t>
        corners_;  // of nodes in S: the representative where it is known, else the last corner
    Growing<LateEdge> edges_;
    std::uint32_t key_ = 0;  // L, and V in the end
};

}  // namespace

bool tailMayMatter(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                   const Allocator* allocator, Parallel& parallel) {
    if (!nodes.tame) return true;
    if (triangles.count == 0) return false;
    return TailCheck(mesh, triangles, nodes, allocator, parallel).run();
}

}  // namespace tspace::mikk
