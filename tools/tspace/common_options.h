// SPDX-License-Identifier: MIT
// Options that several commands have.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"
#include "option_table.h"

namespace tspace::tool {

inline constexpr Named<Convention> kConventions[] = {
    {"gltf", conventions::gltf},     {"opengl", conventions::opengl}, {"directx", conventions::directx},
    {"unreal", conventions::unreal}, {"unity", conventions::unity},   {"blender", conventions::blender},
    {"godot", conventions::godot},
};
inline constexpr Named<Faces> kFaces[] = {
    {"triangles", Faces::triangles},
    {"quads", Faces::quads},
    {"auto", Faces::automatic},
};

/// Headings in help. What stands under the last three decides how a command runs, not what it finds or writes.
inline constexpr const char* kInputAndOutput = "Input and output";
inline constexpr const char* kManyFiles = "Many files";
inline constexpr const char* kReporting = "Reporting";
inline constexpr const char* kRunning = "Running";

void addInputs(Command& command, std::vector<std::string>& inputs);
void addBatch(Command& command, BatchArguments& batch, bool with_manifest);
/// Also --help.
void addReporting(Command& command, bool& json, bool& quiet);
void addAllowExternal(Command& command, FileOptions& file);
void addThreads(Command& command, Execution& execution, std::string help);
/// Only the first of the limits: for what needs no importer.
void addMemoryLimit(Command& command, FileOptions& file);
void addLimits(Command& command, FileOptions& file);
Option helpOption();

/// The options given that decide about results: "--all --method=angle", in the order of their names, so that the
/// manifest of another command line with the same meaning fits.
std::string resultOptions(const Given& given);

}  // namespace tspace::tool
