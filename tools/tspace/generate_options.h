// SPDX-License-Identifier: MIT
// The options of tspace generate.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "arguments.h"

namespace tspace::tool {

/// What CLI11 writes into before it is checked and turned into GenerateArguments.
struct RawGenerate {
    std::string method = "mikktspace";
    std::string pairing = "reference";
    std::string frame = "gram-schmidt";
    std::string normals = {};
    std::string convention = "gltf";
    std::string container = {};
    std::string compression = "keep";
    std::string format = "float";
    float crease_deg = 180.0f;
    float threshold_deg = 180.0f;
    std::string texture_transform = "apply";
    bool only_missing = false;
    bool overwrite = false;
    bool repair = false;
};

CLI::App* addGenerate(CLI::App& app, GenerateArguments& arguments, RawGenerate& raw);

/// Fills `arguments` from what was given. Empty, or what makes no sense.
std::string finishGenerate(const RawGenerate& raw, const CLI::App* command, GenerateArguments& arguments);

}  // namespace tspace::tool
