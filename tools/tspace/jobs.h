// SPDX-License-Identifier: MIT
// From the inputs on the command line (files and folders) to single files and where their results go.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace tspace::tool {

/// One model file to work on.
struct Job {
    std::string input = {};
    std::string output = {};                ///< empty for commands that write nothing
    Error error = {.code = ErrorCode::ok};  ///< why it cannot even be tried
};

/// true for names that end in .glb, .gltf or .obj, in any case.
bool isModelFile(const std::string& path);

/// Every input file, and the model files of every input folder and below in the order of their names.
std::vector<Job> inputJobs(const std::vector<std::string>& inputs);

/// The same with outputs. Makes no folder: that happens when there is something to write. An Error of code
/// invalidOption says what is wrong with the command line.
Result<std::vector<Job>> generateJobs(const GenerateArguments& arguments);

}  // namespace tspace::tool
