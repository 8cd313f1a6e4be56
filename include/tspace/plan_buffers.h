// SPDX-License-Identifier: MIT
// A tangent plan as one flat array of words, for compute shaders: shaders/tspace_evaluate.* read it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tspace/execution.h"
#include "tspace/mesh.h"
#include "tspace/normals.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace {

/// What planBuffers writes beside the plan itself.
struct PlanBufferOptions {
    /// The vertex of each corner in the arrays of a pose, as IndexedFrames::indices; empty: the indices of the plan's mesh.
    std::span<const std::uint32_t> indices = {};
    /// The corner that each result belongs to, as IndexedFrames::source_corners; kNoCorner: none. Empty: one result per
    /// output of evaluateTangents.
    std::span<const std::uint32_t> source_corners = {};
    /// The mesh of the plan, whose normals the shader computes from positions. Positions decide which corners share one.
    /// No vertices, the default: a pose brings its normals.
    MeshView mesh = {};
    /// How the normals of `mesh` are computed: every weighting but NormalWeighting::best. `denoise` must be 0, and only
    /// lengyel reads the convention: other plans have theirs.
    NormalOptions normals = {};
};

/// The words of a plan: a header of 12 words, then the three arrays that it names. All numbers are 32-bit words in the byte
/// order of the machine. docs/guides/gpu.md describes the header, and how a result is computed.
///
/// Results, 3 words each: the first entry; the count of entries (bits 0..27) with flags; the own corner of the result as an
/// entry, or 0xffffffff. Corners that share a tangent and a normal have the same entries.
/// Entries, 1 word each, in the order of summation: a corner of a triangle, 4 * triangle + corner, with flags. 0xffffffff
/// separates parts of a result that is the normalized mean of several.
/// Triangles: three vertices, then UV coefficients as floats: (a, b) with dP/du along a * e1 - b * e2, where
/// e1 = P1 - P0, e2 = P2 - P0; for `lengyel` (a, b, c, d) with dP/du = a * e1 - b * e2 and dP/dv = c * e2 - d * e1.
struct PlanBuffers {
    static constexpr std::uint32_t kVersion = 1;

    /// Places of words in the header.
    enum Header : std::uint32_t {
        version,
        method,     ///< Method
        flags,      ///< Flag
        weighting,  ///< NormalWeighting
        result_count,
        entry_count,
        triangle_count,
        triangle_words,  ///< words of a triangle: 5, or 7 for `lengyel`
        results,         ///< where each array begins, in words from the start of the header
        entries,
        triangles,
        header_words = 12
    };
    enum Flag : std::uint32_t {
        makes_normals = 1,       ///< normals are computed from positions
        inward_normals = 2,      ///< normalFactor(convention) is -1
        normalizes_normals = 4,  ///< TangentOptions::normalize_normals
        results_are_corners = 8  ///< the result of an entry is 3 * triangle + corner; else it is that of its vertex
    };
    enum ResultFlag : std::uint32_t {
        negative = 0x80000000u,     ///< the sign is -1; for `lengyel`: the computed sign is multiplied by -1
        has_default = 0x40000000u,  ///< a tangent that vanishes becomes (1, 0, 0), not zero
        is_cleared = 0x20000000u,   ///< the tangent and its sign are 0
        /// Corners that share the tangent have normals of several results, which were equal on the plan's mesh.
        mixes_normals = 0x10000000u,
        count_mask = 0x0fffffffu
    };
    enum EntryFlag : std::uint32_t {
        no_tangent = 0x80000000u,  ///< the corner adds nothing to the tangent
        no_normal = 0x40000000u,   ///< the corner adds nothing to the normal
        corner_mask = 0x3fffffffu,
        kNextPart = 0xffffffffu,
        kNoEntry = 0xffffffffu
    };

    std::vector<std::uint32_t> words = {};

    [[nodiscard]] std::uint32_t operator[](Header word) const { return words[word]; }
};

/// Writes the plan as words. About 12 bytes per result and 32 per triangle of entries and triangles (40 for `lengyel`).
///
/// Errors: invalidOption for the methods flat, basis and best, for FrameShape::symmetric, for normals that are `best` or
/// denoised, and for a plan of several index lists without `indices`; countMismatch and indexOutOfRange for arrays of
/// `options` that do not fit the plan; tooLarge above 268,435,455 triangles; those of generateNormals; outOfMemory.
/// O(n log n) in results, else linear, plus the size of groups that an angular threshold splits. Thread-safe.
Result<PlanBuffers> planBuffers(const TangentPlan& plan, const PlanBufferOptions& options = {},
                                const Execution& execution = {});

}  // namespace tspace
