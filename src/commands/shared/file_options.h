// SPDX-License-Identifier: MIT
// Options that several commands share.
#pragma once

#include <cstdint>
#include <string>

#include "commands/shared/option_table.h"
#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/map_files.h"
#include "tspace/maps.h"
#include "tspace/mesh.h"
#include "tspace/tangents.h"

namespace tspace::options {

inline constexpr Named<Convention> kConventions[] = {
    {"gltf", conventions::gltf},     {"opengl", conventions::opengl}, {"directx", conventions::directx},
    {"unreal", conventions::unreal}, {"unity", conventions::unity},   {"blender", conventions::blender},
    {"godot", conventions::godot},
};
inline constexpr Named<Method> kMethods[] = {
    {"mikktspace", Method::mikktspace}, {"lengyel", Method::lengyel}, {"uniform", Method::uniform},
    {"angle", Method::angle},           {"area", Method::area},       {"flat", Method::flat},
    {"basis", Method::basis},           {"fast", Method::fast},       {"best", Method::best},
};
inline constexpr Named<Faces> kFaces[] = {
    {"triangles", Faces::triangles},
    {"quads", Faces::quads},
    {"auto", Faces::automatic},
};

/// Headings in help. Options under kRunning and kReporting control how a call runs, not its results or outputs.
inline constexpr const char* kInputAndOutput = "Input and output";
inline constexpr const char* kRunning = "Running";
inline constexpr const char* kReporting = "Reporting";

/// Returns an option that selects the convention of a program for normal maps, by a name of findMapReading.
Option readingOption(const char* names, MapReading& target, HelpText help);
void addAllowExternal(OptionList& list, FileOptions& file);
void addKeepCoordinates(OptionList& list, FileOptions& file);
void addThreads(OptionList& list, Execution& execution, HelpText help);
/// Adds only the memory limit, for commands that need no importer.
void addMemoryLimit(OptionList& list, std::uint64_t& memory_limit_bytes);
void addLimits(OptionList& list, FileOptions& file);
/// Adds FileOptions::sync, for commands that write.
void addSync(OptionList& list, bool& sync);
/// Adds the options for threads, limits and flushing of outputs.
void addRunning(OptionList& list, Execution& execution, HelpText threads_help, FileOptions& file);
/// Adds --lengths, for 8-bit maps.
void addLengths(OptionList& list, const char* group, TexelLengths& lengths);
/// Adds --alpha, for normal maps with mip levels.
void addAlpha(OptionList& list, const char* group, MapAlpha& alpha);
/// Adds --dds-header, for DDS outputs.
void addDdsHeader(OptionList& list, const char* group, DdsHeader& header);
/// Adds the option that selects the primitives of a model that use a map.
void addMaterialOfMap(OptionList& list, std::string& material);
/// Adds the last options of commands that compute an image from a model: the tangent method for models without tangents
/// (in `group`), threads, limits and flushing.
void addMakingAnImage(OptionList& list, const char* group, Method& method, Execution& execution, FileOptions& file);

}  // namespace tspace::options
