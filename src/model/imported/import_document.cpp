// SPDX-License-Identifier: MIT
// Formats that the importer reads, its limits, and conversion of its result to a document.
#include "model/imported/import_document.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/gltf/load_document.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "model/io/text_encoding.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

/// Formats of Assimp 5, except OBJ and glTF, which tspace reads itself, and except formats without meshes or with
/// unmaintained parsers.
constexpr std::array kExtensions = {".3d",  ".3ds",     ".3mf", ".ac",   ".ase", ".b3d", ".blend", ".cob",
                                    ".dae", ".dxf",     ".fbx", ".hmp",  ".iqm", ".lwo", ".lws",   ".md2",
                                    ".md3", ".md5mesh", ".mdl", ".ms3d", ".ndo", ".nff", ".off",   ".ply",
                                    ".q3o", ".q3s",     ".smd", ".stl",  ".ter", ".x",   ".xgl",   ".zgl"};

/// Line of the importer's output: a result without tangents means that the file has no tangents.
constexpr std::string_view kNoTangents = "tangents: none\n";
/// Line of the importer's output: no offset was subtracted, because of FileOptions::keep_coordinates.
constexpr std::string_view kCoordinatesKept = "coordinates: kept\n";

/// Returns the first line of the importer's output, quoted for a message.
std::string firstLine(const std::string& messages) {
    constexpr std::size_t kMaxBytes = 300;
    const std::string quoted = inQuotes(messages.substr(0, messages.find('\n')), kMaxBytes);
    return quoted.substr(1, quoted.size() - 2);
}

/// Returns the importer's warnings: its lines that start with "warning: ".
std::vector<std::string> warningsIn(const std::string& messages) {
    constexpr std::string_view kMark = "warning: ";
    std::vector<std::string> warnings;
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kMark)) warnings.push_back(firstLine(line.substr(kMark.size())));
    }
    return warnings;
}

/// Returns the offset that the importer subtracted from coordinates: three numbers in its line that starts with
/// "offset: ".
std::array<double, 3> offsetIn(const std::string& messages) {
    constexpr std::string_view kMark = "offset: ";
    std::array<double, 3> offset{};
    std::istringstream lines(messages);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(kMark)) continue;
        std::istringstream numbers(line.substr(kMark.size()));
        numbers.imbue(std::locale::classic());
        for (double& number : offset) numbers >> number;
    }
    return offset;
}

/// Returns limits that depend on the file size, so that a small file with excessive declarations is stopped early.
ImportLimits limitsFor(std::uint64_t size, const FileOptions& options) {
    constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
    constexpr std::uint64_t kAnyFile = 192 * kMebibyte, kPerByte = 256;
    // Assimp reads 20 to 130 MB per second on the machine of the measurement; other machines may be much slower.
    constexpr std::uint32_t kMinSeconds = 2;
    const auto seconds = kMinSeconds + static_cast<std::uint32_t>(size / kMebibyte);
    ImportLimits limits;
    limits.memory_bytes = options.memory_limit_bytes != 0
                              ? options.memory_limit_bytes
                              : std::min(options.import_max_memory_bytes, kAnyFile + kPerByte * size);
    limits.processor_seconds = options.import_max_seconds != 0 ? options.import_max_seconds : seconds;
    limits.reads_anywhere = options.allow_external;
    // Processor time is the effective limit. The wall-clock limit ends an importer that waits; it is ten times as long,
    // because with 20 processes on two cores each gets a tenth of a core.
    limits.seconds = options.import_max_seconds != 0 ? options.import_max_seconds : 10 * seconds;
    return limits;
}

/// Returns a reason, recognized from the first bytes of the file, why the importer may have failed; empty if there is
/// none.
std::string encodingReason(const Path& path) {
    std::string text(8, '\0');
    const CFile file = openFile(path, "rb");
    text.resize(file ? std::fread(text.data(), 1, text.size(), file.get()) : 0);
    const std::string_view encoding = wideEncoding(text);
    if (!encoding.empty()) return wideTextMessage(encoding);
    if (!text.starts_with("\xef\xbb\xbf")) return {};
    return "the file starts with a byte order mark; save it as UTF-8 without a byte order mark";
}

/// Throws the reason as FileError if the importer returned no result.
void checkEnd(const ImportResult& result, const ImportLimits& limits, const Path& path) {
    std::string why;
    switch (result.end) {
        case ImportEnd::done: return;
        case ImportEnd::outOfProcessorTime:
            why = "the importer was stopped after " + std::to_string(limits.processor_seconds) +
                  " s of CPU time; use --import-seconds to allow more";
            break;
        case ImportEnd::outOfTime:
            why = "the importer was stopped after " + std::to_string(limits.seconds) +
                  " s; use --import-seconds to allow more";
            break;
        case ImportEnd::outOfSpace:
            why =
                "the importer was stopped because its result exceeded the memory limit; use --memory-limit to raise it";
            break;
        case ImportEnd::crashed:
            why = "the importer crashed on this file; convert it to glTF with the program that made it";
            break;
        case ImportEnd::refused:
            why = encodingReason(path);
            if (why.empty()) why = firstLine(result.messages);
            if (why.empty())
                why = "the importer cannot read the file; convert it to glTF with the program that made it";
            break;
    }
    failFile(ErrorCode::invalidFile, why);
}

}  // namespace

bool isImportedFormat(const Path& path) {
    const std::string extension = lowerExtension(path);
    return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

gltf::Document importDocument(const Path& path, const FileOptions& options, const Progress& progress) {
    if (options.importer.empty()) {
        failFile(ErrorCode::unsupportedFile,
                 "reading " + lowerExtension(path) +
                     " files needs the program tspace-import, which is not installed (see docs/reference/import.md)");
    }
    std::error_code error;
    const std::uintmax_t size = fs::file_size(fs::path(path), error);
    if (error || !fs::is_regular_file(fs::path(path), error)) readFile(path);  // fails with the reason
    if (size > options.import_max_file_bytes) {
        failFile(ErrorCode::unsupportedFile, "the file exceeds the size limit of the importer, " +
                                                 std::to_string(options.import_max_file_bytes >> 20) + " MiB");
    }
    const ImportLimits limits = limitsFor(size, options);
    ImportResult result = runImporter(options.importer, Path(fs::absolute(fs::path(path))).string(),
                                      options.keep_coordinates, limits, [&progress] {
                                          if (progress) progress("reading", 0, 1);
                                      });
    checkEnd(result, limits, path);
    gltf::Document document = gltf::parseDocument(std::move(result.glb), path, options);
    document.input_bytes = static_cast<std::uint64_t>(size);
    // The generator of the original is kept separately, because tspace becomes the generator of the output.
    document.source_generator = gltf::generatorOf(document);
    document.imported = true;
    document.json["asset"]["generator"] = "tspace";
    document.may_hide_tangents = result.messages.find(kNoTangents) == std::string::npos;
    document.keeps_far_coordinates = result.messages.find(kCoordinatesKept) != std::string::npos;
    document.coordinate_offset = offsetIn(result.messages);
    for (std::string& warning : warningsIn(result.messages)) document.warnings.push_back(std::move(warning));
    return document;
}

}  // namespace tspace
