// SPDX-License-Identifier: MIT
// Generates frames in memory, and implements generateFile for each input format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/generate/generate_plan.h"
#include "model/gltf/model.h"
#include "model/read/read_scene.h"
#include "tspace/generate.h"
#include "tspace/result.h"

namespace tspace {

/// Settings of generate as a step of another command. A step does not warn about options without effect.
struct GenerateStep {
    gltf::RecomputedNormals normals = {};  ///< normals to recompute; ignored for OBJ
    /// Meshes that GenerateOptions::mend_winding does not change; ignored for OBJ.
    std::vector<std::uint32_t> wound_meshes = {};
    /// Repairs attributes with a wrong type or element count; otherwise generate repairs them only with some options.
    bool repairs_attributes = false;
    /// Path to which the model will be written: a GLB in the folder of an OBJ references its images instead of
    /// embedding them.
    std::string output = "model.glb";
};

}  // namespace tspace

namespace tspace::gltf {

/// A model whose frames were generated in memory, with the report. No file is written, and the report names none.
struct GeneratedModel {
    Model model;
    GenerateReport report = {};
    bool attributes_repaired = false;      ///< as in OptionEffects
    std::size_t normals_scaled_count = 0;  ///< as in OptionEffects
};

/// Generates the contents of a GLB, and returns the model as if it were read from that GLB. `with_images`: embeds the
/// images, as in a GLB. Ignores GenerateOptions::sink and dry_run. Throws FileError.
GeneratedModel generateModel(Model&& input, const GenerateOptions& options, bool with_images,
                             const GenerateStep& step = {});

/// Implements generateFile for glTF inputs, and for formats that the importer converts to glTF. `step`: null if
/// generate itself is the command.
Result<GenerateReport> generateGltf(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep* step);

}  // namespace tspace::gltf

namespace tspace {

/// Generates in memory like gltf::generateModel, from a model file of any format. `path`: path of this file.
gltf::GeneratedModel generateModel(ModelFile&& input, const std::string& path, const GenerateOptions& options,
                                   bool with_images, const GenerateStep& step);
gltf::GeneratedModel generateModel(const std::string& input, const GenerateOptions& options, bool with_images,
                                   const GenerateStep& step = {});

/// Runs generateFile as a step of another command.
Result<GenerateReport> generateStep(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep& step);

/// Implements generateFile for an OBJ input; `output` is a .glb or .gltf file.
Result<GenerateReport> generateObj(const std::string& input, const std::string& output, const GenerateOptions& options,
                                   const GenerateStep* step);
/// Implements generateModel for an OBJ input; `path`: path of the OBJ file. Throws FileError.
gltf::GeneratedModel generateObjModel(obj::Model&& input, const std::string& path, const GenerateOptions& options,
                                      const GenerateStep& step);

}  // namespace tspace
