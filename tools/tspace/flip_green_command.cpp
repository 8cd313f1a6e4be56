// SPDX-License-Identifier: MIT
// tspace flip-green: one image, its green channel inverted.
#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

const char* nameOf(ImageFileFormat format) {
    switch (format) {
        case ImageFileFormat::png:
            return "PNG";
        case ImageFileFormat::jpeg:
            return "JPEG";
        case ImageFileFormat::webp:
            return "WebP";
        case ImageFileFormat::sameAsInput:
            break;
    }
    return "";
}

std::string textOf(const FlipGreenArguments& arguments, const FlipGreenReport& report) {
    Table table;
    table.addRow({"image", fmt::format("{}, {} x {}, {} bits a channel", nameOf(report.format), report.width,
                                       report.height, report.bits)});
    table.addRow({"green", report.is_exact ? "inverted exactly" : "inverted, and compressed once more"});
    for (const std::string& warning : report.warnings) table.addRow({"warning", printable(warning)});
    return fmt::format("{} -> {}\n{}", printable(arguments.input), printable(arguments.output), table.text("  "));
}

std::string jsonOf(const FlipGreenArguments& arguments, const Result<FlipGreenReport>& result, ExitCode exit_code) {
    Json json = {
        {"schema", "tspace.flip-green/1"},
        {"version", TSPACE_VERSION},
        {"ok", result.ok()},
        {"exitCode", static_cast<int>(exit_code)},
        {"input", arguments.input},
        {"output", arguments.output},
        {"error", errorJson(result ? nullptr : &result.error())},
    };
    if (!result) return jsonText(json);
    json["format"] = nameOf(result->format);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bits"] = result->bits;
    json["exact"] = result->is_exact;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace

ExitCode runFlipGreen(const FlipGreenArguments& arguments) {
    std::error_code ignored;
    if (!arguments.in_place && std::filesystem::equivalent(arguments.input, arguments.output, ignored)) {
        return printUsageError("the output " + arguments.output + " is the input; --in-place writes over it");
    }
    const Result<FlipGreenReport> result =
        flipGreenFile(arguments.input, arguments.output, {.memory_limit_bytes = arguments.file.memory_limit_bytes});
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.input, result.error());
    std::string text;
    if (arguments.json) {
        text = jsonOf(arguments, result, exit_code);
    } else if (!arguments.quiet && result) {
        text = textOf(arguments, *result);
    }
    return printResult(text) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
