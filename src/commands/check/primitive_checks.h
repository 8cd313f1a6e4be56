// SPDX-License-Identifier: MIT
// The checks of one primitive, a family of findings each. They know arrays and uses, but no file format; findings get
// the place and the names of the primitive afterwards, where they leave them empty.
#pragma once

#include <optional>
#include <vector>

#include "commands/check/frame_health.h"
#include "commands/shared/uv_reading.h"
#include "core/mesh/surface/surface.h"
#include "model/scene/scene.h"
#include "tspace/check.h"

namespace tspace {

// Tangents that were made on quads, compared with the triangles that MikkTSpace cuts these into.

struct QuadReading {
    std::vector<std::uint32_t> corners = {};  ///< three per triangle, as TangentView::corners
    Surface surface = {};                     ///< surface of these faces; the two halves of a quad have one orientation
};

/// The quads that CheckOptions::faces means, cut as MikkTSpace cuts them. Nothing: the mesh's own triangles are meant,
/// or, with Faces::automatic, nothing in `health` asks for another reading. `health`: of the mesh. Near-linear;
/// fails where generateTangents does.
Result<std::optional<QuadReading>> findQuads(const TangentView& mesh, const FrameHealth& health,
                                             const CheckOptions& options);

/// Data shared by the checks of one primitive.
struct PrimitiveFacts {
    const ScenePrimitive& primitive;
    const CheckOptions& options;
    bool is_gltf = true;          ///< others are seldom expected to hold tangents, and many cannot
    UvReading reading = {};       ///< UVs that the tangents should follow
    TangentView mesh = {};        ///< over `reading`; without UVs where these are no authority
    Surface surface = {};         ///< surface of `mesh`
    std::vector<bool> used = {};  ///< vertices that triangles have
    QuadReading quads = {};       ///< holds the corners of `mesh` where its tangents were made on quads
    std::vector<Finding> findings = {};
    std::vector<std::uint32_t> faults = {};    ///< faults of the tangents, as in FrameHealth::faults; empty: none
    double wrong_sign_share = 0;               ///< as in FrameHealth::wrong_sign_share
    std::span<const ScenePrimitive> all = {};  ///< primitives of the scene, or nothing
    bool looked_at_values = false;             ///< there are tangents, and they were examined

    void fault(std::uint32_t vertex, FindingCode code) {
        if (faults.empty()) faults.resize(mesh.positions.size());
        faults[vertex] |= faultBit(code);
    }
    void add(FindingCode code, Severity severity, const Tally& tally, const char* unit, std::string message);
};

/// The findings of a primitive, and which of its vertices have them.
struct PrimitiveVerdict {
    std::vector<Finding> findings = {};
    std::vector<std::uint32_t> faults = {};  ///< as in PrimitiveFacts::faults; empty: none
    double wrong_sign_share = 0;
    /// Share of the surface where tangents were compared with UVs; 0 where their values alone were looked at.
    double compared_share = 0;
};

/// All findings of a primitive, but for those of its images. Fails for lack of memory only.
/// `scene`: its primitives, whose surface may go on over borders of primitives.
Result<PrimitiveVerdict> judgePrimitive(const ScenePrimitive& primitive, const CheckOptions& options, bool is_gltf,
                                        std::span<const ScenePrimitive> scene = {});
/// The findings alone.
Result<std::vector<Finding>> checkPrimitive(const ScenePrimitive& primitive, const CheckOptions& options, bool is_gltf);

// The families, in the order in which they run. checkTangents may find that tangents follow other UVs, or that they
// were made on quads: `facts` then has those.
void checkPositions(PrimitiveFacts& facts);
void checkNormals(PrimitiveFacts& facts);
void checkNoise(PrimitiveFacts& facts);
void checkMorphValues(PrimitiveFacts& facts);
void checkMorphNormals(PrimitiveFacts& facts);
void checkUvs(PrimitiveFacts& facts);
void checkTextures(PrimitiveFacts& facts);
Result<Done> checkTangents(PrimitiveFacts& facts);
void checkMorphTargets(PrimitiveFacts& facts);

}  // namespace tspace
