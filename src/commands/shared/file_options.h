// SPDX-License-Identifier: MIT
// Options that several calls have.
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

/// Headings in help. What stands under the last two decides how a call runs, not what it finds or writes.
inline constexpr const char* kInputAndOutput = "Input and output";
inline constexpr const char* kRunning = "Running";
inline constexpr const char* kReporting = "Reporting";

/// A program whose reading of normal maps is meant: the names of findMapReading.
Option readingOption(const char* names, MapReading& target, HelpText help);
void addAllowExternal(OptionList& list, FileOptions& file);
void addKeepCoordinates(OptionList& list, FileOptions& file);
void addThreads(OptionList& list, Execution& execution, HelpText help);
/// Only the first of the limits, for commands that need no importer.
void addMemoryLimit(OptionList& list, std::uint64_t& memory_limit_bytes);
void addLimits(OptionList& list, FileOptions& file);
/// FileOptions::sync, for calls that write.
void addSync(OptionList& list, bool& sync);
/// The three: threads, limits, and whether outputs are waited for.
void addRunning(OptionList& list, Execution& execution, HelpText threads_help, FileOptions& file);
/// Adds --lengths, for 8-bit maps.
void addLengths(OptionList& list, const char* group, TexelLengths& lengths);
/// --alpha, of normal maps that get levels.
void addAlpha(OptionList& list, const char* group, MapAlpha& alpha);
/// --dds-header, of outputs in DDS.
void addDdsHeader(OptionList& list, const char* group, DdsHeader& header);
/// Selects the primitives of a model that use a map.
void addMaterialOfMap(OptionList& list, std::string& material);
/// The last options of calls that make an image by a model: how tangents are made where it has none (in `group`), and how
/// the call runs.
void addMakingAnImage(OptionList& list, const char* group, Method& method, Execution& execution, FileOptions& file);

}  // namespace tspace::options
