// SPDX-License-Identifier: MIT
// Options that several commands share.
#include "commands/shared/file_options.h"

namespace tspace::options {
namespace {

constexpr unsigned kMaxThreads = 1024;

/// Parses a memory limit such as "500M", "8G" or "none"; K, M, G and T are powers of 1024. Rejects limits below 64 MiB,
/// which every file may use.
bool parseMemory(const std::string& text, std::uint64_t& bytes) {
    constexpr std::uint64_t kMin = std::uint64_t{64} << 20, kMax = std::uint64_t{1} << 56;
    if (text == "none") {
        bytes = kNoMemoryLimit;
        return true;
    }
    const std::size_t unit = text.find_first_not_of("0123456789");
    const bool has_unit = unit != std::string::npos && unit + 1 == text.size();
    const std::size_t power = has_unit ? std::string("KMGT").find(text[unit]) : std::string::npos;
    std::uint64_t count = 0;
    if (power == std::string::npos || !parseNumber(text.substr(0, unit), count)) return false;
    const std::uint64_t factor = std::uint64_t{1} << (10 * (power + 1));
    bytes = count * factor;
    return count <= kMax / factor && bytes >= kMin;
}

}  // namespace

Option readingOption(const char* names, std::function<void(const MapReading&)> store, HelpText help) {
    const auto take = [store = std::move(store)](const std::string& value) {
        if (const MapReading* reading = findMapReading(value.c_str())) store(*reading);
        return std::string();
    };
    Option chosen = option(names, "NAME", take, std::move(help));
    chosen.choices = {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot", "three"};
    chosen.default_text = "gltf";
    return chosen;
}

void addAllowExternal(OptionList& list, FileOptions& file) {
    add(list, kInputAndOutput,
        flag("--allow-external", file.allow_external,
             "Also follow paths in a model that lead outside its own folder. By default, absolute paths, paths with "
             "'..' and URLs are rejected."));
}

void addKeepCoordinates(OptionList& list, FileOptions& file) {
    add(list, kInputAndOutput,
        flag("--keep-coordinates", file.keep_coordinates,
             "Write the coordinates of OBJ, PLY and STL files unchanged. By default, coordinates that are too far from "
             "the origin for the 32-bit floats of glTF (map coordinates in meters, for example) are moved by an "
             "offset, which becomes the translation of the nodes."));
}

void addThreads(OptionList& list, Execution& execution, HelpText help) {
    const auto store = [&execution](std::uint64_t given) {
        execution.thread_count = given == 0 ? kAllThreads : static_cast<std::uint32_t>(given);
    };
    const std::uint32_t threads = execution.thread_count == kAllThreads ? 0 : execution.thread_count;
    add(list, kRunning, numberOption("--threads", threads, kMaxThreads, store, std::move(help)));
}

void addMemoryLimit(OptionList& list, std::uint64_t& memory_limit_bytes) {
    const auto take = [&memory_limit_bytes](const std::string& text) -> std::string {
        return parseMemory(text, memory_limit_bytes) ? ""
                                                     : "must be a number with the unit M or G, at least 64M, or none";
    };
    add(list, kRunning,
        option("--memory-limit", "SIZE", take,
               "Approximate memory limit per file, e.g. 512M or 4G (at least 64M), or none. Memory use is estimated "
               "first, and a file that would exceed the limit is rejected. Default: 64M plus 16 times the size of the "
               "input (for a model, including the files it references), which protects against small files that "
               "declare huge sizes."));
}

void addLimits(OptionList& list, FileOptions& file) {
    addMemoryLimit(list, file.memory_limit_bytes);
    constexpr unsigned kMaxSeconds = 1000000;
    add(list, kRunning,
        number("--import-seconds", file.import_max_seconds, kMaxSeconds,
               "Time limit in seconds for reading one file of an imported format (FBX, PLY, DAE, ...), for CPU time "
               "and for wall-clock time. 0: 2 seconds plus 1 second per MiB of the file for CPU time, and ten times "
               "that for wall-clock time."));
}

Option weldOption(float& distance, HelpText help) {
    constexpr int kMost = 1000000000;
    return numberOrAuto("--weld-distance", "DISTANCE", "a distance", distance, NormalOptions::weld_auto, kMost,
                        std::move(help));
}

Option lengthsOption(TexelLengths& lengths) {
    static constexpr Named<TexelLengths> kLengths[] = {{"even", TexelLengths::even}, {"free", TexelLengths::free}};
    return choice("--lengths", "HOW", kLengths, lengths,
                  "Allowed vector lengths in 8-bit maps. A length other than 1 permits texel values with a smaller "
                  "angular error. even: 0.9 to 1, for textures whose mip levels are computed from the map, as engines "
                  "do; free: 0.7 to 1.1, which is more accurate close up and less accurate in mip levels.");
}

Option alphaOption(MapAlpha& alpha) {
    static constexpr Named<MapAlpha> kAlphas[] = {
        {"auto", MapAlpha::automatic}, {"coverage", MapAlpha::coverage}, {"data", MapAlpha::data}};
    return choice("--alpha", "MEANING", kAlphas, alpha,
                  "Meaning of the alpha channel. coverage: covered fraction of the texel, as in sprites and foliage; "
                  "mip levels are alpha-weighted means. data: anything else; alpha is ignored. auto: coverage if "
                  "texels with alpha 0 hold no unit vectors and the others do.");
}

Option ddsHeaderOption(DdsHeader& header) {
    static constexpr Named<DdsHeader> kHeaders[] = {
        {"dx10", DdsHeader::dx10}, {"legacy", DdsHeader::legacy}, {"bc5u", DdsHeader::bc5u}};
    return choice("--dds-header", "HEADER", kHeaders, header,
                  "Header of a .dds. dx10: Direct3D 10. legacy: Direct3D 9, for older readers; BC5 has the FourCC "
                  "ATI2, signed BC5 has BC5S. bc5u: like legacy, with BC5U instead of ATI2.");
}

Option materialOfMapOption(std::string& material) {
    return text("--material", "NAME", material,
                "Use only the primitives with the material of this name. Default: those whose material references an "
                "image with the name of the map; if there are none, all that have UVs.");
}

void addMakingAMap(OptionList& list, Method& method, Execution& execution, FileOptions& file) {
    add(list, "Map",
        choice("--method", "NAME", kMethods, method, "Tangent method for a model without tangents, as in generate."));
    addRunning(list, execution, file);
}

void addSync(OptionList& list, bool& sync) {
    add(list, kRunning,
        setting("--no-sync", sync, false,
                "Do not wait until outputs are flushed to disk. By default they are flushed before they replace old "
                "files, so that after a power failure either the old or the new file is complete. Flushing slows down "
                "runs on many small files."));
}

void addRunning(OptionList& list, Execution& execution, FileOptions& file, HelpText threads_help) {
    addThreads(list, execution, std::move(threads_help));
    addLimits(list, file);
    addSync(list, file.sync);
}

}  // namespace tspace::options
