// SPDX-License-Identifier: MIT
// The command line, parsed: one struct per command.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "exit_code.h"
#include "tspace/asset.h"

namespace tspace::tool {

/// The file format of outputs whose name does not say it.
enum class Container { sameAsInput, glb, gltf };

struct GenerateArguments {
    std::vector<std::string> inputs = {};
    std::string output = {};
    bool in_place = false;
    Container container = Container::sameAsInput;
    GenerateOptions options = {};
    bool json = false;
    bool quiet = false;
};

struct InspectArguments {
    std::vector<std::string> inputs = {};
    FileOptions file = {};
    bool json = false;
    bool quiet = false;
};

/// Nothing to run: help was printed, or the command line is wrong and the error line was printed.
using Arguments = std::variant<ExitCode, GenerateArguments, InspectArguments>;

Arguments parseArguments(int argc, char** argv);

}  // namespace tspace::tool
