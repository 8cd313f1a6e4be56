// SPDX-License-Identifier: MIT
// Converts the inputs on the command line (files, folders, patterns) to single files with their outputs.
#pragma once

#include <string>
#include <vector>

#include "tspace/result.h"

namespace tspace::tool {

/// Format of outputs whose name does not determine it.
enum class Container { sameAsInput, glb, gltf };

/// Inputs and output location according to the command line.
struct JobRequest {
    std::vector<std::string> inputs = {};
    std::string output = {};
    bool in_place = false;
    Container container = Container::sameAsInput;
    bool is_dry_run = false;
    bool has_manifest = false;
    bool has_list = false;  ///< inputs come from --files-from: the output is a folder, regardless of their number
};

/// A model file to process, and its output.
struct Job {
    std::string input = {};
    std::string output = {};  ///< empty for commands without output files
    /// Path relative to the input folder. For files named explicitly: the given name.
    std::string name = {};
    std::string remark = {};                ///< remark about an output that the user may not expect; may be empty
    bool is_found_image = false;            ///< an image found by a search, not named by an input
    Error error = {.code = ErrorCode::ok};  ///< error that prevents the job from starting
};

/// Returns the path of tspace-import, which must be next to this program. Empty if it does not exist.
std::string importerPath();

/// Returns whether a name ends in .glb, .vrm, .gltf or .obj, ignoring case; also .fbx, .ply, .stl, .dae and .3ds if the
/// importer exists. (Explicitly named files may have any format that the importer reads.)
bool isModelFile(const std::string& path);

/// Types of files that are searched in folders and patterns.
enum class SearchedFiles {
    models,
    modelsOrImages  ///< images if a folder or a pattern has no model
};

/// Returns all input files. A folder stands for the model files in it and its subfolders, sorted by name; a pattern
/// (glob.h) stands for the model files that match, unless a file has that name.
std::vector<Job> inputJobs(const std::vector<std::string>& inputs, SearchedFiles searched = SearchedFiles::models);

/// Returns the input files with their outputs. Creates no folders; they are created when files are written. An error
/// with code invalidOption describes a fault of the command line.
Result<std::vector<Job>> generateJobs(const JobRequest& request);

/// Returns the folders that the jobs write into; folders inside another listed folder are omitted.
std::vector<std::string> outputFolders(const std::vector<Job>& jobs);

}  // namespace tspace::tool
