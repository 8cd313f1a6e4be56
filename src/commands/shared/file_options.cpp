// SPDX-License-Identifier: MIT
// Options that several calls have.
#include "commands/shared/file_options.h"

namespace tspace::options {
namespace {

constexpr unsigned kMostThreads = 1024;

/// "500M", "8G" or "none"; K, M, G and T count by 1024. At least the limit that every file has.
bool parseMemory(const std::string& text, std::uint64_t& bytes) {
    constexpr std::uint64_t kLeast = std::uint64_t{64} << 20, kMost = std::uint64_t{1} << 56;
    if (text == "none") {
        bytes = kNoMemoryLimit;
        return true;
    }
    const std::size_t unit = text.find_first_not_of("0123456789");
    const std::size_t power = unit + 1 == text.size() ? std::string("KMGT").find(text[unit]) : std::string::npos;
    std::uint64_t count = 0;
    if (power == std::string::npos || !parseNumber(text.substr(0, unit), count)) return false;
    const std::uint64_t factor = std::uint64_t{1} << (10 * (power + 1));
    bytes = count * factor;
    return count <= kMost / factor && bytes >= kLeast;
}

}  // namespace

Option readingOption(const char* names, MapReading& target, HelpText help) {
    const auto take = [&target](const std::string& value) {
        if (const MapReading* reading = findMapReading(value.c_str())) target = *reading;
        return std::string();
    };
    Option chosen = option(names, "NAME", take, std::move(help));
    chosen.choices = {"gltf", "opengl", "directx", "unreal", "unity", "blender", "godot", "three"};
    chosen.default_text = "gltf";
    return chosen;
}

void addAllowExternal(OptionList& list, FileOptions& file) {
    add(list, kInputAndOutput,
        flag(
            "--allow-external", file.allow_external,
            "Also follow paths in a model that lead outside its own folder. By default absolute paths, paths with '..' "
            "and URLs are refused."));
}

void addKeepCoordinates(OptionList& list, FileOptions& file) {
    add(list, kInputAndOutput,
        flag("--keep-coordinates", file.keep_coordinates,
             "For OBJ, PLY and STL: write coordinates as they are. By default an offset is taken out of "
             "those that are too far from the origin for the 32-bit floats of glTF, such as metres of a map, and "
             "becomes "
             "the translation of the nodes."));
}

void addThreads(OptionList& list, Execution& execution, HelpText help) {
    const auto store = [&execution](std::uint64_t given) {
        execution.thread_count = given == 0 ? kAllThreads : static_cast<std::uint32_t>(given);
    };
    const std::uint32_t threads = execution.thread_count == kAllThreads ? 0 : execution.thread_count;
    add(list, kRunning, numberOption("--threads", threads, kMostThreads, store, std::move(help)));
}

void addMemoryLimit(OptionList& list, std::uint64_t& memory_limit_bytes) {
    const auto take = [&memory_limit_bytes](const std::string& text) -> std::string {
        return parseMemory(text, memory_limit_bytes) ? "" : "must be a number with M or G, 64M or more, or none";
    };
    add(list, kRunning,
        option(
            "--memory-limit", "SIZE", take,
            "What working on one file may take of memory, about: a number with M or G (64M or more), or none. What it "
            "would take is estimated first, and more is refused. Default: 64M, and 16 times the bytes of the file and "
            "of those it names, so that a small file that claims to be huge does no harm."));
}

void addLimits(OptionList& list, FileOptions& file) {
    addMemoryLimit(list, file.memory_limit_bytes);
    constexpr unsigned kMostSeconds = 1000000;
    add(list, kRunning,
        number(
            "--import-seconds", file.import_max_seconds, kMostSeconds,
            "Time for reading one file of another format (FBX, PLY, DAE, ...); 0: 2 seconds of processor time, and one "
            "more for each MiB of the file."));
}

void addLengths(OptionList& list, const char* group, TexelLengths& lengths) {
    static constexpr Named<TexelLengths> kLengths[] = {{"even", TexelLengths::even}, {"free", TexelLengths::free}};
    add(list, group,
        choice(
            "--lengths", "HOW", kLengths, lengths,
            "Lengths of vectors in maps of 8 bits. even: 0.9 to 1, for textures whose smaller levels are made of the "
            "map, as engines do; free: 0.7 to 1.1, which errs less close up, and more in smaller levels."));
}

void addAlpha(OptionList& list, const char* group, MapAlpha& alpha) {
    static constexpr Named<MapAlpha> kAlphas[] = {
        {"auto", MapAlpha::automatic}, {"coverage", MapAlpha::coverage}, {"data", MapAlpha::data}};
    add(list, group,
        choice(
            "--alpha", "MEANING", kAlphas, alpha,
            "Meaning of alpha. coverage: how much of a texel is surface, as in sprites and foliage; smaller levels are "
            "means weighted by it. data: anything else; it is left out. auto: coverage where texels with alpha 0 hold "
            "no "
            "unit vectors and the others do."));
}

void addDdsHeader(OptionList& list, const char* group, DdsHeader& header) {
    static constexpr Named<DdsHeader> kHeaders[] = {
        {"dx10", DdsHeader::dx10}, {"legacy", DdsHeader::legacy}, {"bc5u", DdsHeader::bc5u}};
    add(list, group,
        choice("--dds-header", "HEADER", kHeaders, header,
               "Header of a .dds. dx10: that of Direct3D 10. legacy: that of Direct3D 9 for older readers, BC5 as "
               "FourCC ATI2, "
               "or BC5S with a sign. bc5u: as legacy, with BC5U in place of ATI2."));
}

void addMaterialOfMap(OptionList& list, std::string& material) {
    add(list, kInputAndOutput,
        text("--material", "NAME", material,
             "Takes the primitives with the material of this name. Default: those whose material names an image of "
             "the map's name; where there are none, all that have UVs."));
}

void addMakingAnImage(OptionList& list, const char* group, Method& method, Execution& execution, FileOptions& file) {
    add(list, group, choice("--method", "NAME", kMethods, method, "How tangents are made for a model that has none."));
    addRunning(list, execution, "Threads; 0: as many as there are cores. The output is the same for any number.", file);
}

void addSync(OptionList& list, bool& sync) {
    add(list, kRunning,
        setting(
            "--no-sync", sync, false,
            "Do not wait until outputs are on the disk. By default they are there before they take the places of old "
            "files, so that a power cut leaves one or the other whole; many small files take longer for it."));
}

void addRunning(OptionList& list, Execution& execution, HelpText threads_help, FileOptions& file) {
    addThreads(list, execution, std::move(threads_help));
    addLimits(list, file);
    addSync(list, file.sync);
}

}  // namespace tspace::options
