// SPDX-License-Identifier: MIT
// Generating in memory, and generateFile for each format of input: read, decide, compute, edit, write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/generate/generate_plan.h"
#include "model/gltf/model.h"
#include "tspace/generate.h"
#include "tspace/result.h"

namespace tspace {

/// Generating as a step of another command: of its options none is said to have had no effect.
struct GenerateStep {
    gltf::NormalWishes normals = {};  ///< normals to recompute; not for OBJ
    std::vector<std::uint32_t> wound_meshes =
        {};  ///< meshes that GenerateOptions::mend_winding leaves alone; not for OBJ
    /// Attributes of a wrong type or number are repaired, which generate does for some options alone.
    bool repairs_attributes = false;
};

}  // namespace tspace

namespace tspace::gltf {

/// A model whose frames were generated in memory, and what was done. No file is written, and the report names none.
struct GeneratedModel {
    Model model;
    GenerateReport report = {};
};

/// Generates what a GLB would hold, and gives the model as a reader of that GLB would get it. `with_images`: it takes them in
/// as a GLB does. GenerateOptions::sink and dry_run mean nothing. Throws FileError.
GeneratedModel generateModel(Model&& input, const GenerateOptions& options, bool with_images,
                             const GenerateStep& step = {});

/// generateFile for glTF inputs, and for what the importer makes of other formats. `step`: null for a command of its own.
Result<GenerateReport> generateGltf(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep* step);

}  // namespace tspace::gltf

namespace tspace {

/// Like the overload above, for a model file of any format.
gltf::GeneratedModel generateModel(const std::string& input, const GenerateOptions& options, bool with_images,
                                   const GenerateStep& step = {});

/// generateFile as a step.
Result<GenerateReport> generateStep(const std::string& input, const std::string& output, const GenerateOptions& options,
                                    const GenerateStep& step);

/// generateFile for an OBJ input; `output` is a .glb or .gltf.
Result<GenerateReport> generateObj(const std::string& input, const std::string& output, const GenerateOptions& options,
                                   const GenerateStep* step);
/// generateModel for an OBJ input. Throws FileError.
gltf::GeneratedModel generateObjModel(const std::string& input, const GenerateOptions& options);

}  // namespace tspace
