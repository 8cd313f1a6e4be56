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

// GenerateOptions::mend_winding: the surfaces of a model, and which of their faces are turned.

struct WindingPlan {
    std::vector<MendedWindingReport> reports = {};
    /// For each primitive: one entry per triangle, 1 to turn it; or empty: none.
    std::vector<std::vector<std::uint8_t>> turned = {};

    [[nodiscard]] bool turnsAny() const;
};

/// Of a glTF model, mesh by mesh: where nodes put a mesh, and whether they mirror it, does not matter, since viewers look
/// at the winding in the mesh's own coordinates. `kept`: meshes that are left alone. Changes nothing.
WindingPlan planWinding(gltf::Model& model, const GenerateOptions& options, std::span<const std::uint32_t> kept);

/// One more face that was turned, behind those before it.
void listTurned(std::uint64_t face, PrimitiveReport& report);

/// Counts and lists the faces that were turned.
void countTurned(const WindingPlan& plan, std::vector<PrimitiveReport>& primitives);

/// Turns the faces of an OBJ file. Returns one per face: 1 if it was turned.
std::vector<std::uint8_t> mendObjWinding(obj::Model& model, const GenerateOptions& options, GenerateReport& report);

}  // namespace tspace

namespace tspace::gltf {

// ExistingTangents::repair: which tangents stay, and what of the others is mended.

/// Judges the tangents that are there as `check` does, normal maps included. Primitives without an error leave the plan,
/// and their reports say so; what is wrong in the others becomes the mends of their geometries and a note in their
/// reports. Fails as reading the primitives' attributes does.
void planRepair(Model& model, const GenerateOptions& options, GeneratePlan& plan);

// ExistingTangents::replace gives correct signs to tangents that may have rendered correctly with inverted signs, because green of
// the normal map points down.

/// Returns a warning where tangents with inverted signs are replaced and their normal maps stay as they are; else an empty string.
/// Does not read images, since that takes many times as long as the tangents. Fails as reading the attributes does.
std::string warnOfInvertedSigns(Model& model, const GeneratePlan& plan, const MapFlips& flips,
                                const GenerateOptions& options);

// Tangents that stay: what the format forbids in them is mended, and nothing else.

/// Primitives whose tangents stay and lie in one accessor, where these have values that no tangent may have
/// (hasSoundValues) at some vertex, used by triangles or not. Tangents along N count where a material reads
/// them: elsewhere they may be normals for outlines.
std::vector<std::vector<std::size_t>> findBrokenValues(Model& model, const GeneratePlan& plan);

/// Mends them, in the format that they have, and says so in the reports. All other elements keep their bits.
void mendBrokenValues(Editor& editor, const Document& document, std::span<const Primitive> primitives,
                      std::span<const std::vector<std::size_t>> groups, std::span<PrimitiveReport> reports);

// Normal maps of a glTF file that follow its tangents: what the model showed with the old ones, it shows with the new.

class MapConversion {
  public:
    /// Takes what the model shows now: call it before anything in it is changed. Both must outlive it.
    MapConversion(Model& model, const GenerateOptions& options);

    /// Once the model has the new tangents, and wasEdited: puts new maps in where they bring the picture closer to the old one.
    /// `reports`: of all primitives. Files beside the document are never changed: the output has new ones.
    std::vector<ConvertedMapReport> run(Editor& editor, const OutputTarget& target,
                                        std::span<const PrimitiveReport> reports);

  private:
    Model& model_;
    const GenerateOptions& options_;
    std::vector<std::size_t> numbers_ = {};     ///< primitives that show normal maps
    Scene before_ = {};                         ///< these, in this order
    std::map<std::size_t, Bytes> images_ = {};  ///< the files of their maps, by number of the image
};

}  // namespace tspace::gltf

namespace tspace {

// Warnings about the file as a whole.

/// Whether options had an effect, as far as the report does not contain it.
struct WorkedOn {
    bool far_coordinates = false;     ///< an offset that was left in them
    bool texture_transforms = false;  ///< computed or examined tangents follow such textures
    bool compression = false;         ///< geometry that was packed or unpacked
};

/// Adds to the warnings: triangles that are wound against their neighbours, and new normals that point behind their triangles.
void warnOfWinding(const GenerateOptions& options, GenerateReport& report);

/// Adds the warnings of warnOfWinding, and one for each option without effect. For a step it adds nothing: it may be one of
/// several.
void addWarnings(const GenerateOptions& options, const WorkedOn& worked_on, bool is_step, GenerateReport& report);

namespace gltf {

/// Writes a document that was generated, completes the report by what only that tells, and so ends the call: nothing that can
/// fail comes after it. `inputs`: what the call read.
void writeGenerated(const std::string& input, Document& document, const OutputTarget& target,
                    const GenerateOptions& options, const WorkedOn& worked_on, const InputFiles& inputs, bool is_step,
                    GenerateReport& report);

}  // namespace gltf
}  // namespace tspace
