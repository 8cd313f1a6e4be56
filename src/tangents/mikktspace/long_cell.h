// SPDX-License-Identifier: MIT
// One cell of the reference's grid that holds a large part of the mesh, when the order of its corners is wanted at
// a few positions only.
//
// The reference cuts a range of corners in the middle of their box, then both sides, and so on (weld_cell.h). The
// cuts depend on which positions are in a range, not on their order. So all cuts are found first, from the vertices
// of the cell, each once, in pieces of vertices that follow each other: where the box of a piece is on one side of
// a cut, nobody looks inside. The parts that the cuts leave are numbered from left to right, and each corner gets
// the number of its part, a byte. These bytes say what the reference's partitions do with the corners, and 64 of
// them are compared at once.
#pragma once

#include <cstdint>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"
#include "tangents/mikktspace/growing.h"
#include "tspace/tangents.h"

namespace tspace::mikk {

/// The corners of a cell in the order of the corner list.
struct NumberedCorners {
    NumberedCorners(std::size_t corner_count, const Allocator* allocator)
        : count(corner_count), entries(allocator, count), parts(allocator, (count + kBlock - 1) / kBlock * kBlock) {}

    /// The reference's partition of the corners [begin, end): those of parts below `first_right` go left. Returns
    /// where the right side begins. On a side that is not kept anything may be left.
    std::size_t partition(std::size_t begin, std::size_t end, std::uint8_t first_right, bool keep_left,
                          bool keep_right);

    static constexpr std::size_t kBlock = 64;  // parts that are compared at once
    std::size_t count;
    Buffer<std::uint32_t> entries;  ///< of the corner list
    Buffer<std::uint8_t> parts;     ///< in whole blocks; what follows the last corner does not matter
};

class LongCell {
  public:
    /// `vertices`: those of the cell that triangles use, in any order, which will change; `wanted`: positions in
    /// the cell, whose order will change too. No sum of two coordinates may overflow.
    LongCell(const StridedSpan<const Vec3>& positions, Buffer<std::uint32_t> vertices, std::span<Vec3> wanted,
             std::size_t mesh_vertex_count, const Allocator* allocator, Parallel& parallel);

    static constexpr std::uint8_t kOutside = 255;  ///< the part of vertices of other cells
    [[nodiscard]] std::uint8_t partOf(std::uint32_t vertex) const { return part_of_[vertex]; }

    /// Brings the corners of the parts with wanted positions in the order that the reference's partitions down to
    /// these parts leave. follow(begin, end): called for each of them. Such parts are short, but for those that
    /// cannot be cut, and where there would be too many parts.
    template <class Follow>
    void order(NumberedCorners& corners, const Follow& follow) const {
        struct Range {
            std::size_t begin, end;
        };
        Growing<Range> waiting(allocator_);
        waiting.push({0, corners.count});
        for (const Step& step : steps_) {
            const Range range = waiting[waiting.size() - 1];
            waiting.drop(1);
            if (step.is_cut) {
                const std::size_t cut =
                    corners.partition(range.begin, range.end, step.first_right, step.keep_left, step.keep_right);
                waiting.push({cut, range.end});
                waiting.push({range.begin, cut});
            } else if (step.is_wanted) {
                follow(range.begin, range.end);
            }
        }
    }

  private:
    /// Vertices that follow each other, and their box.
    struct alignas(16) Piece {
        Vec3 low;
        std::uint32_t begin;
        Vec3 high;
        std::uint32_t end;
    };
    /// The pieces of the part that was made last are the last pieces.
    struct Part {
        Vec3 low, high;
        std::uint32_t cut;  // of a right side: the step that made it; else kNone
        std::size_t vertex_count;
        std::size_t piece_begin;
        std::size_t wanted_begin, wanted_end;
    };
    /// What becomes of a range, in the order of a walk that goes to the left first.
    struct Step {
        bool is_cut = false, is_wanted = false;
        bool keep_left = false, keep_right = false;  // of a cut: whether something on this side is wanted
        std::uint8_t first_right = 0;                // and the first part on its right side
    };
    struct Side;

    void makePieces(Parallel& parallel);
    bool cut(const Part& part);
    void finish(const Part& part);
    Piece takeLeft(Piece& piece, int axis, float middle);

    StridedSpan<const Vec3> positions_;
    Buffer<std::uint32_t> vertices_;
    std::span<Vec3> wanted_;
    const Allocator* allocator_;
    Buffer<std::uint8_t> part_of_;  // one per vertex of the mesh
    Growing<Piece> pieces_, left_pieces_;
    Growing<Part> waiting_;
    Growing<Step> steps_;
    std::uint8_t part_count_ = 0;
};

}  // namespace tspace::mikk
