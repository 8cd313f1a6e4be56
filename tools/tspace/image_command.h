// SPDX-License-Identifier: MIT
// The common parts of commands that write one image: stdin and stdout as files, and the report at the end. Their arguments
// have `input`, `output`, `json`, `quiet` and `options.dry_run`.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/shared/report.h"
#include "console.h"
#include "report_outputs.h"
#include "standard_input.h"
#include "system.h"

namespace tspace::tool {

inline constexpr const char* kNoTextForATerminal =
    "an image is no text for a terminal; send stdout to a file or a pipe";

template <class Arguments>
bool goesToTerminal(const Arguments& arguments) {
    return arguments.output == "-" && !arguments.options.dry_run && isTerminal(stdout);
}

/// call(options), with stdout in the place of a file where `output` is "-".
template <class Options, class Call>
auto callWithOutput(const std::string& output, Options options, const Call& call) -> decltype(call(options)) {
    if (output != "-") return call(options);
    StandardOutput standard_output;
    options.sink = [&](std::span<const std::uint8_t> part) { return standard_output.write(part); };
    auto report = call(options);
    if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
    return report;
}

/// As callWithOutput, with an image from stdin where `input` is "-".
template <class Options, class Call>
auto callOnImage(const std::string& input, const std::string& output, std::uint64_t memory_limit_bytes, Options options,
                 const Call& call) -> decltype(call(options)) {
    std::vector<std::uint8_t> bytes;
    if (input == "-") {
        // Any bytes are taken here; the library tells the format.
        const auto is_anything = [](std::string_view) { return true; };
        Result<std::vector<std::uint8_t>> read = readStandardInput("an image", memory_limit_bytes, is_anything, "");
        if (!read) return std::move(read).error();
        bytes = *std::move(read);
        options.content = bytes;
    }
    return callWithOutput(output, std::move(options), call);
}

/// Prints the error, or the result as text, textOf(outcome), or JSON, jsonOf(outcome, exit code): on stderr where the image is
/// on stdout.
template <class Arguments, class Report, class JsonOf, class TextOf>
ExitCode printOutcome(const Arguments& arguments, const Result<Report>& result, JsonOf jsonOf, TextOf textOf) {
    const ExitCode exit_code = result ? ExitCode::done : printError(arguments.input, result.error());
    return reportOutputs(result.ok(), [&] {
        const report::Outcome<Report> outcome{.input = arguments.input,
                                              .output = arguments.output,
                                              .result = result,
                                              .is_dry_run = arguments.options.dry_run};
        std::string text;
        if (arguments.json) {
            text = jsonOf(outcome, exit_code);
        } else if (!arguments.quiet && result) {
            text = textOf(outcome);
        }
        return printResult(text, arguments.output == "-" ? stderr : stdout) ? exit_code : ExitCode::cannotReadOrWrite;
    });
}

}  // namespace tspace::tool
