// SPDX-License-Identifier: MIT
// Mends what is broken in tangents and leaves every other bit alone.
#pragma once

#include <cstdint>

#include "tspace/execution.h"
#include "tspace/mesh.h"

namespace tspace {

struct SanitizeOptions {
    /// Also make every sound tangent unit and orthogonal to N. Off by default: the result then no longer matches a
    /// bake made with the method's own tangents (quantised normals are not unit, so the reference's tangents can be
    /// off by up to a degree there).
    bool orthogonalize_all = false;
};

/// Corners mended, by cause (the first that applies, in this order) and by cure.
struct SanitizeReport {
    std::uint64_t not_finite_count = 0;      ///< NaN or infinity in the tangent
    std::uint64_t zero_count = 0;            ///< length 0 (or too small to be normalised)
    std::uint64_t not_unit_count = 0;        ///< length off by more than 5e-4 (the glTF validator's tolerance)
    std::uint64_t parallel_count = 0;        ///< within 1 degree of +N or -N: no frame can be built
    std::uint64_t placeholder_count = 0;     ///< exactly (1, 0, 0), and not in the plane across N
    std::uint64_t bad_sign_count = 0;        ///< sign not exactly +1 or -1
    std::uint64_t mixed_sign_count = 0;      ///< sign changed because the face's corners disagreed
    std::uint64_t orthogonalized_count = 0;  ///< sound ones changed by orthogonalize_all

    std::uint64_t normalized_count = 0;     ///< cure: own direction, made unit and orthogonal to N
    std::uint64_t from_neighbor_count = 0;  ///< cure: direction taken from a sound corner of the same face or position
    std::uint64_t from_basis_count = 0;     ///< cure: basis from N alone (Duff et al. 2017)

    std::uint64_t bad_normal_count = 0;  ///< corners whose N is zero or not finite: only a unit tangent is promised

    /// All corners that were written: the sum of the causes.
    [[nodiscard]] std::uint64_t mendedCount() const {
        return not_finite_count + zero_count + not_unit_count + parallel_count + placeholder_count + bad_sign_count +
               mixed_sign_count + orthogonalized_count;
    }
};

/// Mends tangents in place. A tangent is broken when it is not finite, zero, not unit (beyond 5e-4), within 1 degree
/// of +-N, a placeholder that leans out of the surface, when its sign is not +-1, or when the signs inside its face
/// differ. What is written is unit and orthogonal to the corner's N (normalised) within 1e-6, with sign +1 or -1. Sound
/// tangents keep every bit.
///
/// Placeholder: the reference gives exactly (1, 0, 0) to corners around which no triangle has UV area, wherever N
/// points. What UVs give has been projected along N, so that with these bits it lies in the plane.
///
/// Cures, in this order: the tangent's own direction, when it has one that is not parallel to N; the tangent of the
/// first sound corner of the same face; of the first sound corner at the same position (in corner order); a basis
/// from N. Signs inside a face: the majority of the sound corners decides, of those whose N has a direction where there are
/// any; on a tie, the first of them. Where N has none, corners at one position that get a tangent from elsewhere get that of
/// the first of them with their sign.
/// The result does not depend on how vertices are indexed, so mending a split mesh again changes nothing.
///
/// mesh       positions and normals; UVs are not looked at
/// tangents   one per corner, read and written; corners of faces with fewer than 3 corners are left alone
/// execution  threads and memory; changes no bit
/// Errors: those of validate(); missingAttribute (normals), countMismatch, nullData, outOfMemory.
/// O(corners). Thread-safe; same bits for any thread count.
Result<SanitizeReport> sanitizeTangents(const MeshView& mesh, const SanitizeOptions& options,
                                        StridedSpan<Vec4> tangents, const Execution& execution = {});

}  // namespace tspace
