// SPDX-License-Identifier: MIT
// Checks of one primitive; each check makes the findings of one kind. They use arrays and texture uses, independent of
// file formats. If a finding has no location and names, the caller adds those of the primitive.
#pragma once

#include <optional>
#include <vector>

#include "commands/check/findings.h"
#include "commands/check/frame_health.h"
#include "commands/shared/uv_reading.h"
#include "core/mesh/surface/surface.h"
#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

// Tangents that were computed on quads are compared with the triangles into which MikkTSpace splits the quads.

struct QuadReading {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle, like TangentView::corners
    /// Surface of these triangles; both halves of a quad have one orientation.
    Surface surface = {};
};

/// Returns the quads selected by CheckOptions::faces, split as MikkTSpace does it. Returns nothing if the triangles of
/// the mesh are used, or, for Faces::automatic, if `health` has no fault that quads could explain. `health`: result for
/// the mesh. Near-linear time; fails if generateTangents fails.
std::optional<QuadReading> findQuads(const TangentView& mesh, const FrameHealth& health, const CheckOptions& options);

/// Data shared by the checks of one primitive.
struct PrimitiveFacts {
    const ScenePrimitive& primitive;
    const CheckOptions& options;
    bool is_gltf = true;          ///< other formats are rarely expected to contain tangents, and many cannot
    UvReading reading = {};       ///< UVs that the tangents should follow
    TangentView mesh = {};        ///< the mesh, with the UVs of `reading` if they determine the tangents
    Surface surface = {};         ///< surface of `mesh`
    std::vector<bool> used = {};  ///< vertices that triangles use
    QuadReading quads = {};       ///< owns the corners that `mesh` refers to if its tangents were computed on quads
    std::vector<Finding> findings = {};
    std::vector<std::uint32_t> faults = {};    ///< faults of the tangents, see FrameHealth::faults; empty: none
    double wrong_sign_share = 0;               ///< see FrameHealth::wrong_sign_share
    std::span<const ScenePrimitive> all = {};  ///< primitives of the scene, or none
    bool examined_values = false;              ///< there are tangents, and they were examined

    void fault(std::uint32_t vertex, FindingCode code) {
        if (faults.empty()) faults.resize(mesh.positions.size());
        faults[vertex] |= faultBit(code);
    }
    void add(FindingCode code, Severity severity, const Tally& tally, const char* unit, FindingText text);
};

/// Findings of a primitive, and the vertices that have them.
struct PrimitiveVerdict {
    std::vector<Finding> findings = {};
    std::vector<std::uint32_t> faults = {};  ///< see PrimitiveFacts::faults; empty: none
    double wrong_sign_share = 0;
    /// Share of the surface where tangents were compared with UVs; 0 if only their values were examined.
    double compared_share = 0;
};

/// Returns all findings of a primitive, except those of its images. Throws FileError only if memory runs out. `scene`:
/// primitives of the scene, since surfaces may continue across borders of primitives.
PrimitiveVerdict judgePrimitive(const ScenePrimitive& primitive, const CheckOptions& options, bool is_gltf,
                                std::span<const ScenePrimitive> scene = {});

// Declares the checks in the order in which they run. checkTangents may detect that tangents follow other UVs, or were
// computed on quads; it then stores these UVs or quads in `facts`.
void checkPositions(PrimitiveFacts& facts);
void checkNormals(PrimitiveFacts& facts);
void checkNoise(PrimitiveFacts& facts);
void checkMorphValues(PrimitiveFacts& facts);
void checkMorphNormals(PrimitiveFacts& facts);
void checkUvs(PrimitiveFacts& facts);
void checkTextures(PrimitiveFacts& facts);
void checkTangents(PrimitiveFacts& facts);
void checkMorphTargets(PrimitiveFacts& facts);

}  // namespace tspace
