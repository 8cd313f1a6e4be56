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
Option readingOption(const char* names, std::function<void(const MapReading&)> store, HelpText help);
inline Option readingOption(const char* names, MapReading& target, HelpText help) {
    return readingOption(
        names, [&target](const MapReading& reading) { target = reading; }, std::move(help));
}
inline constexpr const char* kThreadsHelp =
    "Number of threads; 0: one per core. The output is the same for any number of threads.";
void addAllowExternal(OptionList& list, FileOptions& file);
void addKeepCoordinates(OptionList& list, FileOptions& file);
void addThreads(OptionList& list, Execution& execution, HelpText help = kThreadsHelp);
/// Adds only the memory limit, for commands that need no importer.
void addMemoryLimit(OptionList& list, std::uint64_t& memory_limit_bytes);
void addLimits(OptionList& list, FileOptions& file);
/// Adds FileOptions::sync, for commands that write.
void addSync(OptionList& list, bool& sync);
/// Adds the options for threads, limits and flushing of outputs.
void addRunning(OptionList& list, Execution& execution, FileOptions& file, HelpText threads_help = kThreadsHelp);
/// Returns --weld-distance.
Option weldOption(float& distance, HelpText help);
/// Returns --lengths, for 8-bit maps.
Option lengthsOption(TexelLengths& lengths);
/// Returns --alpha, for normal maps with mip levels.
Option alphaOption(MapAlpha& alpha);
/// Returns --dds-header, for DDS outputs.
Option ddsHeaderOption(DdsHeader& header);
/// Returns the option that selects the primitives of a model that use a map.
Option materialOfMapOption(std::string& material);
inline Option dryRunOption(bool& is_dry_run) {
    return flag("--dry-run", is_dry_run, "Do everything except writing the output.");
}
/// Adds the last options of commands that compute a map from a model: the tangent method for models without tangents,
/// threads, limits and flushing.
void addMakingAMap(OptionList& list, Method& method, Execution& execution, FileOptions& file);

}  // namespace tspace::options
