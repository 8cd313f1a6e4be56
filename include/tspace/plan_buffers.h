// SPDX-License-Identifier: MIT
// Tangent plan as one flat array of 32-bit words, for the compute shaders shaders/tspace_evaluate.*.
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

/// Optional additions to the plan that planBuffers writes.
struct PlanBufferOptions {
    /// For each corner, the index of its vertex in the arrays of a pose; IndexedFrames::indices can be passed here.
    /// Empty: the indices of the plan's mesh are used.
    std::span<const std::uint32_t> indices = {};
    /// For each result, the corner that it belongs to; IndexedFrames::source_corners can be passed here. kNoCorner:
    /// none. Empty: one result per output of evaluateTangents.
    std::span<const std::uint32_t> source_corners = {};
    /// Mesh of the plan, for computing normals from positions in the shader. Corners with equal positions share
    /// normals. Without vertices, the default, a pose provides its normals.
    MeshView mesh = {};
    /// Options for the normals of `mesh`. Not supported: NormalWeighting::best, and `denoise` other than 0.
    /// `normals.convention` is used only for a plan of lengyel; plans of other methods store their convention.
    NormalOptions normals = {};
};

/// Words of a plan: a header of 12 words, and the three arrays that it refers to. All values are 32-bit words in native
/// byte order. docs/guides/gpu.md describes the header, and how to compute a result.
///
/// Results, 3 words each: index of its first entry; number of its entries (bits 0..27) with flags; its own corner as an
/// entry, or 0xffffffff. Corners that share a tangent and a normal have equal entries.
/// Entries, 1 word each, in the order of summation: a corner of a triangle, 4 * triangle + corner, with flags.
/// 0xffffffff separates parts of a result that is the normalized mean of several.
/// Triangles: three vertices, then UV coefficients as floats: (a, b) with dP/du along a * e1 - b * e2, where
/// e1 = P1 - P0, e2 = P2 - P0; for Method::lengyel (a, b, c, d) with dP/du = a * e1 - b * e2 and
/// dP/dv = c * e2 - d * e1. If a triangle's UV area is nearly lost in rounding, a is 0xffffffff, and b is the index of
/// the first of ten words after the triangles: five doubles, each with its high word first, r, t2, t1, s1, s2, with
/// dP/du = r * (t2 * e1 - t1 * e2) and dP/dv = r * (s1 * e2 - s2 * e1).
struct PlanBuffers {
    static constexpr std::uint32_t kVersion = 1;

    /// Indices of words in the header.
    enum Header : std::uint32_t {
        version,
        method,     ///< Method
        flags,      ///< Flag
        weighting,  ///< NormalWeighting
        result_count,
        entry_count,
        triangle_count,
        triangle_words,  ///< words per triangle: 5, or 7 for `lengyel`
        results,         ///< first word of each array, counted from the start of the header
        entries,
        triangles,
        header_words = 12
    };
    enum Flag : std::uint32_t {
        makes_normals = 1,       ///< normals are computed from positions
        inward_normals = 2,      ///< normalFactor(convention) is -1
        normalizes_normals = 4,  ///< TangentOptions::normalize_normals
        /// The result of an entry is 3 * triangle + corner; otherwise it is the result of its vertex.
        results_are_corners = 8
    };
    enum ResultFlag : std::uint32_t {
        negative = 0x80000000u,     ///< the sign is -1; for `lengyel`: the computed sign is multiplied by -1
        has_default = 0x40000000u,  ///< a tangent of length 0 is replaced by (1, 0, 0)
        is_cleared = 0x20000000u,   ///< the tangent and its sign are 0
        /// The normals of the corners that share the tangent come from several results, which were equal on the plan's
        /// mesh.
        mixes_normals = 0x10000000u,
        count_mask = 0x0fffffffu
    };
    enum EntryFlag : std::uint32_t {
        no_tangent = 0x80000000u,  ///< the corner does not contribute to the tangent
        no_normal = 0x40000000u,   ///< the corner does not contribute to the normal
        corner_mask = 0x3fffffffu,
        kNextPart = 0xffffffffu,
        kNoEntry = 0xffffffffu,
        kDoubles = 0xffffffffu  ///< in place of the first UV coefficient
    };

    std::vector<std::uint32_t> words = {};

    [[nodiscard]] std::uint32_t operator[](Header word) const { return words[word]; }
};

/// Writes the plan as words: about 12 bytes per result, and 32 per triangle for entries and triangles (40 for
/// Method::lengyel).
///
/// Errors: invalidOption for the methods flat, basis and best, for FrameShape::symmetric, for normals that are `best`
/// or denoised, and for a plan with several index lists without `indices`; countMismatch and indexOutOfRange for arrays
/// of `options` that do not match the plan; tooLarge above 268,435,455 triangles; those of generateNormals;
/// outOfMemory.
/// O(n log n) in results, otherwise linear, plus the size of groups that an angular threshold splits. Thread-safe.
Result<PlanBuffers> planBuffers(const TangentPlan& plan, const PlanBufferOptions& options = {},
                                const Execution& execution = {});

}  // namespace tspace
