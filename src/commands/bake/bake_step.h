// SPDX-License-Identifier: MIT
// Baking as a step of another command.
#pragma once

#include <string>

#include "commands/bake/model_surfaces.h"
#include "model/io/atomic_output.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Inputs of a bake, and the objects that receive its results.
struct BakeStep {
    BakeSources sources = {};
    /// Path from which the names of the other maps are derived (NAME_ao.png from NAME.png). Empty: they are derived
    /// from the output path.
    std::string layers_output = {};
    bool notes_noise = true;  ///< warns of noisy positions of the high poly
    InputFiles& inputs;       ///< receives the names of the files that are read
    AtomicOutput& map_files;
    AtomicOutput& model_files;  ///< files of BakeFileOptions::out_mesh are added to this output
};

/// Bakes like bakeFile, but commits nothing. If the report names no output files, nothing must be committed. Throws
/// FileError.
BakeFileReport bakeAsStep(const std::string& low, const std::string& high, const std::string& output,
                          const BakeFileOptions& options, const BakeStep& step);

}  // namespace tspace
