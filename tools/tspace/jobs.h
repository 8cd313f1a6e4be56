// SPDX-License-Identifier: MIT
// From the inputs on the command line (files, folders, patterns) to single files and where their results go.
#pragma once

#include <string>
#include <vector>

#include "tspace/result.h"

namespace tspace::tool {

/// File format of outputs whose name does not determine it.
enum class Container { sameAsInput, glb, gltf };

/// The inputs and where results go, as the command line says.
struct JobRequest {
    std::vector<std::string> inputs = {};
    std::string output = {};
    bool in_place = false;
    Container container = Container::sameAsInput;
    bool is_dry_run = false;
    bool has_manifest = false;
    bool has_list = false;  ///< inputs come from --files-from: the output is a folder, however many they are
};

/// One model file to work on.
struct Job {
    std::string input = {};
    std::string output = {};                ///< empty for commands that write nothing
    std::string name = {};                  ///< path below the input folder; for files that were named: as named
    std::string remark = {};                ///< a remark on the output that the user may not expect; may be empty
    bool is_found_image = false;            ///< an image that no input names: a search found it
    Error error = {.code = ErrorCode::ok};  ///< why it cannot even be tried
};

/// Path of tspace-import, which lies beside this program. Empty: it is not there.
std::string importerPath();

/// true for names that end in .glb, .vrm, .gltf or .obj, in any case; also .fbx, .ply, .stl, .dae and .3ds where the importer
/// is there. (Files that are named may be of any format that it reads.)
bool isModelFile(const std::string& path);

/// Kinds of files that folders and patterns are searched for.
enum class SearchedFiles {
    models,
    modelsOrImages  ///< for images where a folder or a pattern has no model
};

/// Every input file, the model files of every input folder and below in the order of their names, and the model files
/// that match a pattern (glob.h) that is not itself a file.
std::vector<Job> inputJobs(const std::vector<std::string>& inputs, SearchedFiles searched = SearchedFiles::models);

/// Like inputJobs(), with outputs. Creates no folder; folders are created when something is written. An Error with code
/// invalidOption describes a fault of the command line.
Result<std::vector<Job>> generateJobs(const JobRequest& request);

/// The folders that the jobs write into, without those that lie in another one of them.
std::vector<std::string> outputFolders(const std::vector<Job>& jobs);

}  // namespace tspace::tool
