// SPDX-License-Identifier: MIT
// The corners around one node: which of them are a group, what groups add up to, and their results.
#pragma once

#include <algorithm>
#include <span>

#include "core/float4.h"
#include "tangents/mikktspace/pairing.h"
#include "tangents/mikktspace/results.h"
#include "tangents/mikktspace/unclear_corners.h"

namespace tspace::mikk {

inline constexpr std::uint8_t kNoGroup = 0xff;

/// What became of a node.
enum NodeState : std::uint8_t { kDone, kLeft, kFirstIsDefault };

/// The corners around one node, at most kSmallNode, and their groups.
struct Members {
    std::span<const UnclearCorner> corners;
    std::uint32_t group_count = 0;
    std::uint8_t group[kSmallNode];

    explicit Members(std::span<const UnclearCorner> around) : corners(around) {}
    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(corners.size()); }
};

/// Who lies across the edges of each member: its place among them, or kNoLink.
struct Links {
    static constexpr std::uint8_t kNoLink = kSmallNode;
    std::uint8_t left[kSmallNode + 1],
        right[kSmallNode + 1];  // the last ones take what is written for kNoLink

    explicit Links(std::span<const UnclearCorner> around);
    /// Whether one path or ring goes through all `count` members.
    [[nodiscard]] bool areOnePath(std::size_t count) const;

  private:
    bool linkUnambiguous(std::span<const UnclearCorner> around);
    void linkAny(std::span<const UnclearCorner> around);
};

struct WalkCounts {
    std::uint64_t groups = 0, defaults = 0;
};

class NodeGroups {
  public:
    NodeGroups(const MeshView& mesh, const TangentOptions& options, const TriangleList& triangles, const Nodes& nodes,
               std::span<const std::uint32_t> chosen, const TangentOutput& out, const UnclearCorners& corners);

    /// Whether bitangents and lengths decide on anything.
    [[nodiscard]] bool isFull() const { return full_; }
    [[nodiscard]] bool maySplit() const { return may_split_; }
    [[nodiscard]] const Sink& sink() const { return sink_; }

    /// Groups and writes a node without contested triangles. kLeft: what is written means nothing.
    NodeState walk(std::size_t place, WalkCounts& counts) const;
    /// Sums, results and corners of a node whose groups are known. The same.
    NodeState finish(std::size_t place, const Members& members, WalkCounts& counts) const;

  private:
    /// What a group's members add up to.
    struct alignas(16) Sum {
        Float4 s{}, t{};  // rows of corner_terms.h
        float length_t = 0;
        std::uint32_t common = ~0u,
                      adding = 0;  // what the members have in common; how many of them add to it
        bool positive = false;
    };
    /// What the angular test compares.
    struct Direction {
        Vec3 s, t;
    };
    struct Columns;

    void add(const UnclearCorner& corner, bool with_lengths, Sum& sum) const;
    [[nodiscard]] Sum sumOf(std::span<const UnclearCorner> around, bool with_lengths) const;
    NodeState writeDefaults(std::span<const UnclearCorner> around, WalkCounts& counts) const;
    NodeState finishOneGroup(std::size_t place, std::span<const UnclearCorner> around, WalkCounts& counts) const;
    static void formGroups(Members& members, const Links& links);
    template <std::size_t kMost>
    NodeState finishGroups(std::size_t place, const Members& members, WalkCounts& counts) const;

    template <class IsMember>
    [[nodiscard]] bool splits(std::size_t place, const Sum& sum, std::span<const UnclearCorner> around,
                              const IsMember& isMember) const;
    using Adding = std::span<const UnclearCorner* const>;  // members of one group that add to it
    static bool onOneSide(Adding adding, const Sum& sum);
    static bool farFromOpposed(const UnclearCorner& a, const UnclearCorner& b);
    static bool allFarFromOpposed(Adding adding);
    static bool restIsSound(const Sum& sum);
    [[nodiscard]] bool anyOpposed(Adding adding, const Vec3& normal) const;
    [[nodiscard]] Direction directionOf(const UnclearCorner& corner, const Vec3& normal) const;

    [[nodiscard]] Tangents resultOf(const Sum& sum) const;
    [[nodiscard]] bool isSound(const Tangents& result) const;
    [[nodiscard]] static bool repeatsApart(std::span<const UnclearCorner> around);
    [[nodiscard]] bool isEntangled(std::size_t place, const Members& members) const;
    NodeState write(const Members& members, const Sum* sums, const Tangents* results, WalkCounts& counts) const;
    void writeOne(std::uint32_t slot, const Tangents& result) const;
    void writeMerged(std::uint32_t slot, const std::uint8_t* first, const std::uint8_t* end, const Sum* sums) const;
    [[nodiscard]] std::uint32_t faceOf(const UnclearCorner& corner) const {
        return triangles_.face(corners_.triangleOf(corners_.numberOf(corner)));
    }
    [[nodiscard]] const Vec3& normalOf(std::size_t place) const { return mesh_.normals[nodes_.vertex(chosen_[place])]; }

    const MeshView& mesh_;
    const TriangleList& triangles_;
    const Nodes& nodes_;
    std::span<const std::uint32_t> chosen_;
    TangentOutput out_;
    Sink sink_;
    const UnclearCorners& corners_;
    bool may_split_;      // the angular test applies
    bool has_polygons_;   // several triangles may have one corner of the mesh
    bool tangents_only_;  // nothing else is written
    bool full_;           // results with bitangents and lengths
    bool has_t_;          // terms with bitangents
};

}  // namespace tspace::mikk
