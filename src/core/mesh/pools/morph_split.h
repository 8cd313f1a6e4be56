// SPDX-License-Identifier: MIT
// One split for a mesh and all its morph targets: a vertex whose corners one target moves apart is split for all.
#pragma once

#include <span>
#include <vector>

#include "core/mesh/pools/morph_targets.h"
#include "tspace/split.h"

namespace tspace {

/// Offsets after a further split: each vertex from `old_count` on has those of its source, which is an earlier vertex.
VertexOffsets spread(const VertexOffsets& offsets, std::span<const std::uint32_t> sources, std::size_t old_count);

class MorphSplit {
  public:
    /// Goes on from `split`. `may_split` false: where corners of a vertex differ, the first one counts.
    MorphSplit(SplitResult&& split, bool may_split);

    /// The next target, by an offset per corner, which must be finite. Corners whose offsets differ by no more than
    /// `tolerance` from the first corner of their vertex share that one's.
    Result<Done> add(std::span<const Vec3> offsets, float tolerance, const Execution& execution);

    /// Offsets of each target for the vertices there are now.
    [[nodiscard]] std::vector<VertexOffsets> finish();

    [[nodiscard]] SplitResult& split() { return split_; }

  private:
    struct Target {
        VertexOffsets offsets = {};
        std::size_t vertex_count = 0;  ///< how many there were
    };
    [[nodiscard]] bool agree(std::span<const Vec3> offsets, float tolerance) const;
    Result<Done> refine(std::span<const Vec3> offsets, float tolerance, const Execution& execution);
    SplitResult split_;
    bool may_split_;
    std::vector<std::uint32_t> parents_;  ///< the vertex that each was split from by a target, or itself
    std::vector<Target> targets_ = {};
};

}  // namespace tspace
