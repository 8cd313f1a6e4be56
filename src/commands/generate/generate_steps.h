// SPDX-License-Identifier: MIT
// Steps of generate, in the order in which they run.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "commands/generate/flip_maps.h"
#include "commands/generate/generate_plan.h"
#include "model/gltf/container.h"
#include "model/gltf/editor.h"
#include "model/gltf/model.h"
#include "model/io/atomic_output.h"
#include "model/obj/obj_reader.h"
#include "model/scene/scene.h"
#include "tspace/generate.h"

namespace tspace {

// GenerateOptions::mend_winding: the surfaces of a model, and which of their faces are flipped.

struct WindingPlan {
    std::vector<MendedWindingReport> reports = {};
    /// Per primitive: one entry per triangle, 1 to flip it; or empty: no triangle is flipped.
    std::vector<std::vector<std::uint8_t>> flipped = {};

    [[nodiscard]] bool flipsAny() const;
};

/// Plans the winding of a glTF model, mesh by mesh. Node transforms are ignored, even if they mirror a mesh, because
/// viewers take the front side from the winding in mesh coordinates. `kept`: meshes to leave unchanged. Does not change
/// the model.
WindingPlan planWinding(gltf::Model& model, const GenerateOptions& options, std::span<const std::uint32_t> kept);

/// Appends a flipped face to the report.
void listFlipped(std::uint64_t face, PrimitiveReport& report);

/// Counts and lists the flipped faces in the reports.
void countFlipped(const WindingPlan& plan, std::vector<PrimitiveReport>& primitives);

/// Flips faces of an OBJ file. Returns one entry per face: 1 if it was flipped.
std::vector<std::uint8_t> fixObjWinding(obj::Model& model, const GenerateOptions& options, GenerateReport& report);

}  // namespace tspace

namespace tspace::gltf {

// ExistingTangents::repair: which tangents are kept, and what is repaired in the others.

/// Judges the existing tangents like `check`, including normal maps. Removes primitives without an error from the plan
/// and states this in their reports; for the others, stores the repairs in their geometries and adds a note to their
/// reports. Fails if the attributes cannot be read.
void planRepair(Model& model, const GenerateOptions& options, GeneratePlan& plan);

// ExistingTangents::replace writes correct signs, even if tangents with inverted signs rendered correctly because green
// of the normal map points down.

/// Returns a warning if tangents with inverted signs are replaced and their normal maps are not inverted; otherwise
/// empty. Does not read images, because that takes many times as long as computing the tangents. Fails if the
/// attributes cannot be read.
std::string warnOfInvertedSigns(Model& model, const GeneratePlan& plan, const MapFlips& flips,
                                const GenerateOptions& options);

// Kept tangents: repairs only values that the format forbids.

/// Returns groups of primitives whose tangents are kept and that share one TANGENT accessor, if the accessor contains
/// invalid values (see hasValidValues), even at unused vertices. Tangents parallel to the normal are invalid only if a
/// material reads them: otherwise they may be normals for outlines.
std::vector<std::vector<std::size_t>> findBrokenValues(Model& model, const GeneratePlan& plan);

/// Repairs invalid values in the format of the accessor, and notes the repairs in the reports. All other elements keep
/// their bits.
void repairInvalidValues(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                         std::span<const std::vector<std::size_t>> groups, std::span<PrimitiveReport> reports);

// Converts the normal maps of a glTF file for its new tangents, so that the shading does not change.

class MapConversion {
  public:
    /// Records the current appearance; call before the model is changed. The arguments must outlive the object.
    MapConversion(Model& model, const GenerateOptions& options);

    /// Inserts converted maps into the document if they make the shading closer to the original. Call it after the new
    /// tangents have been stored, and after Model::wasEdited. `reports`: one per primitive. Files referenced by the
    /// document are never changed: the output has new files.
    std::vector<ConvertedMapReport> run(Editor& editor, const OutputTarget& target,
                                        std::span<const PrimitiveReport> reports);

  private:
    Model& model_;
    const GenerateOptions& options_;
    std::vector<std::size_t> numbers_ = {};  ///< primitives that use normal maps
    Scene before_ = {};  ///< state, before the change, of the primitives `numbers_`, in the same order
    std::map<std::size_t, Bytes> images_ = {};  ///< files of the normal maps; key: image index
};

}  // namespace tspace::gltf

namespace tspace {

// Warnings about the whole file.

/// Effects of options that the report does not contain.
struct OptionEffects {
    bool far_coordinates = false;          ///< coordinates far from the origin kept their offset
    bool texture_transforms = false;       ///< tangents that were computed or examined follow textures with transforms
    bool compression = false;              ///< geometry was compressed or decompressed
    bool attributes_repaired = false;      ///< attributes that could not be read were repaired or removed
    std::size_t normals_scaled_count = 0;  ///< primitives whose normals were scaled to length 1
};

/// Adds warnings about triangles whose winding is opposite to that of their neighbors, and about new normals that point
/// behind their triangles.
void warnOfWinding(const GenerateOptions& options, GenerateReport& report);

/// Adds the warnings of warnOfWinding, and a warning for each option without effect. Adds nothing for a step, which may
/// be one of several.
void addWarnings(const GenerateOptions& options, const OptionEffects& effects, bool is_step, GenerateReport& report);

namespace gltf {

/// Writes the generated document and completes the report with the output files and sizes. Must be the last step of a
/// call, because nothing that can fail may follow. `inputs`: files that the call read.
void writeGenerated(const std::string& input, Document& document, const OutputTarget& target,
                    const GenerateOptions& options, const OptionEffects& effects, const InputFiles& inputs,
                    bool is_step, GenerateReport& report);

}  // namespace gltf
}  // namespace tspace
