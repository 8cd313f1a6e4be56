// SPDX-License-Identifier: MIT
// What becomes of nodes whose groups are known: where nothing rare happens, the results of a node are computed and written at
// once; or groups are written down as a plan, which can be evaluated in any pose (evaluation_plan.h).
#pragma once

#include <span>

#include "core/float4.h"
#include "tangents/mikktspace/groups.h"
#include "tangents/mikktspace/results.h"

namespace tspace::mikk {

struct NodeCounts {
    std::uint64_t groups = 0, default_corners = 0;
};

class NodeResults {
  public:
    /// `defaults`: empty, or one per corner of the mesh, set to 1 where the default is written.
    NodeResults(const VertexPath& path, const VertexCorners& corners, float threshold_cosine, Marks& defaults);

    /// Writes the corners of a node. Returns false where something rare happens: many groups, groups that may split,
    /// results that are not finite or vanish, several results for one corner of the mesh. Then what is written means
    /// nothing.
    bool write(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const;

  private:
    /// What a group's members add up to.
    struct alignas(16) Sum {
        Float4 s{}, t{};  // rows of corner_terms.h
        float length_t = 0;
        std::uint32_t common = ~0u, adding = 0;  // what the members have in common; how many of them add to it
        bool positive = false;
    };

    [[nodiscard]] bool writeGroup(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const;
    template <std::size_t kMost>
    [[nodiscard]] bool writeGroups(std::size_t place, const NodeGroups& groups, NodeCounts& counts) const;
    void add(const NodeCorner& corner, bool with_lengths, Sum& sum) const;
    [[nodiscard]] bool maySplit(std::size_t place, const NodeGroups& groups, std::uint32_t group, const Sum& sum) const;
    [[nodiscard]] bool resultOf(const Sum& sum, Tangents& result) const;
    void writeCorner(std::uint32_t slot, const Tangents& result) const;

    const VertexPath& path_;
    Sink sink_;
    const VertexCorners& corners_;
    float threshold_cosine_;
    Marks& defaults_;
    bool may_split_;      // the angular test applies
    bool has_polygons_;   // several triangles may have one corner of the mesh
    bool tangents_only_;  // nothing else is written
    bool has_t_;          // terms with bitangents
};

/// What a plan is made from.
struct PlanSource {
    const VertexPath& path;
    const VertexCorners& corners;
    const Grouping& grouping;
    std::span<const std::uint8_t> planned;  ///< one per chosen node: 1 where it is planned; empty: all are
    float threshold_cosine = -1;
    PlanUse use = PlanUse::kept;
};

/// The plan of some nodes. Skipped corners are left out, and corners of degenerate triangles; of these, the report has
/// no default corners. Throws OutOfMemory.
EvaluationPlan planNodes(const PlanSource& source);

}  // namespace tspace::mikk
