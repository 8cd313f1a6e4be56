// SPDX-License-Identifier: MIT
#include "tangents/mikktspace/split_check.h"

#include <algorithm>

#include "core/vec_math.h"
#include "tangents/mikktspace/collect.h"
#include "tangents/mikktspace/growing.h"

namespace tspace::mikk {

namespace {

/// Sine of the angle that vectors must keep from the plane: far more than rounding errors.
constexpr float kOffPlane = 0.02f;
constexpr float kLeastWeight = 1e-4f;  // below, a corner says too little about its direction

constexpr std::size_t kWorthwhile = 512;  // triangles for each node in doubt

struct Doubt {
    std::uint32_t node;
    Vec3 s, t;  ///< sums of weighted tangents and bitangents
    bool splits;
};

class SplitChecker {
  public:
    SplitChecker(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                 const CornerSource& source, CornerTermsFunction terms, NodeSums& sums,
                 const Allocator* allocator)
        : mesh_(mesh),
          triangles_(triangles),
          nodes_(nodes),
          source_(source),
          terms_of_(terms),
          sums_(sums),
          allocator_(allocator),
          doubts_(allocator) {}

    void run(std::span<const std::uint32_t> candidates, Parallel& parallel) {
        chooseNodes(candidates);
        // Reading all indices costs as much as what the general steps do for one node in some hundred
        // triangles.
        if (doubts_.size() * kWorthwhile < triangles_.count || doubts_.empty()) {
            for (const Doubt& doubt : doubts_) sums_.nodes[doubt.node].fan.arrives[1] = Fan::kFree;
            return;
        }
        Marks marks = noMarks(allocator_, mesh_.vertexCount());
        for (std::size_t v = 0; v < marks.size(); ++v)
            marks[v] = isChosen(nodes_.ofVertex(static_cast<std::uint32_t>(v))) ? 1 : 0;
        const Buffer<std::uint32_t> found =
            collectTriangles(mesh_, triangles_, marks, 1, allocator_, parallel);
        forEachCorner(found, [](Doubt& doubt, const float*, const float* t) {
            doubt.t = doubt.t + Vec3{t[0], t[1], t[2]};
        });
        forEachCorner(found, [](Doubt& doubt, const float* s, const float* t) {
            const float margin = kOffPlane * s[3];
            const bool keeps_side = s[3] > kLeastWeight &&
                                    dot(doubt.s, Vec3{s[0], s[1], s[2]}) > margin * length(doubt.s) &&
                                    dot(doubt.t, Vec3{t[0], t[1], t[2]}) > margin * length(doubt.t);
            doubt.splits |= !keeps_side;
        });
        for (const Doubt& doubt : doubts_) {
            if (!doubt.splits) sums_.marks[doubt.node] |= kCannotSplit;
            sums_.nodes[doubt.node].fan.arrives[1] = Fan::kFree;
        }
    }

  private:
    /// Nodes of which only this is unknown. The place of their second path, which they do not have, holds the
    /// number of the doubt.
    void chooseNodes(std::span<const std::uint32_t> candidates) {
        for (const std::uint32_t n : candidates) {
            const std::uint32_t m = sums_.marks[n];
            NodeSum& sum = sums_.nodes[n];
            if ((m & (kFacesUp | kFacesDown)) == 0 || (m & kFanKnown) == 0 || !sum.fan.isOne()) continue;
            sum.fan.arrives[1] = static_cast<std::uint32_t>(doubts_.size());
            doubts_.push({n, {sum.s[0], sum.s[1], sum.s[2]}, {}, false});
        }
    }

    [[nodiscard]] bool isChosen(std::uint32_t node) const {
        const std::uint32_t number = sums_.nodes[node].fan.arrives[1];
        return number < doubts_.size() && doubts_[number].node == node;
    }

    /// body(doubt, s, t) with the rows of corner_terms.h, for the corners that add to a sum.
    template <class Body>
    void forEachCorner(const Buffer<std::uint32_t>& found, const Body& body) {
        CornerTerms terms;
        std::uint32_t nodes[kTermCorners] = {}, vertices[kTermCorners] = {};
        for (std::size_t begin = 0; begin < found.size(); begin += kTermTriangles) {
            const std::size_t count = std::min(kTermTriangles, found.size() - begin);
            for (std::size_t i = 0; i < 3 * count; ++i) {
                const std::size_t entry = 3 * std::size_t{found[begin + i / 3]} + i % 3;
                const std::uint32_t v = mesh_.indices[triangles_.corner(entry)];
                nodes[i] = nodes_.ofVertex(v);
                vertices[i] = nodes_.mixed ? nodes_.vertex(nodes[i]) : v;
            }
            terms_of_(source_, vertices, count, terms);
            for (std::size_t i = 0; i < 3 * count; ++i) {
                const bool adds = (terms.marks[i % 3][i / 3] & (kDegenerateMark | kNoUvArea)) == 0;
                if (!adds || !isChosen(nodes[i])) continue;
                body(doubts_[sums_.nodes[nodes[i]].fan.arrives[1]], terms.s[i], terms.t[i]);
            }
        }
    }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    const CornerSource& source_;
    CornerTermsFunction terms_of_;
    NodeSums& sums_;
    const Allocator* allocator_;
    Growing<Doubt> doubts_;
};

}  // namespace

void checkSplits(const MeshView& mesh, const TriangleList& triangles, const Nodes& nodes,
                 std::span<const std::uint32_t> candidates, const CornerSource& source,
                 CornerTermsFunction terms, NodeSums& sums, const Allocator* allocator, Parallel& parallel) {
    SplitChecker(mesh, triangles, nodes, source, terms, sums, allocator).run(candidates, parallel);
}

}  // namespace tspace::mikk
