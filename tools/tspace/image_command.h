// SPDX-License-Identifier: MIT
// Common parts of commands that write one image: their arguments, stdin and stdout as files, and the report at the end.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "command_table.h"
#include "commands/shared/report.h"
#include "common_options.h"
#include "console.h"
#include "report_outputs.h"
#include "standard_input.h"
#include "system.h"

namespace tspace::tool {

inline constexpr const char* kNoTextForATerminal =
    "an image cannot be printed on a terminal; redirect stdout to a file or a pipe";

template <class Options>
struct ImageArguments {
    std::string input = {};
    std::string output = {};
    Options options = {};
    bool json = false;
    bool quiet = false;
};

/// Adds the operand IN, the required option -o, `options`, and reporting.
template <class Options>
void addImageArguments(Command& command, ImageArguments<Options>& arguments, InputKind reads, const char* input_help,
                       const char* output_help, OptionList options) {
    command.add(kInputAndOutput, operand("IN", arguments.input, reads, input_help));
    Option output = fileOption("-o, --output", "OUT", arguments.output, output_help);
    output.is_required = true;
    command.add(kInputAndOutput, std::move(output));
    command.add(std::move(options));
    addReporting(command, arguments.json, arguments.quiet);
}

template <class Options>
bool goesToTerminal(const ImageArguments<Options>& arguments) {
    return arguments.output == "-" && !arguments.options.dry_run && isTerminal(stdout);
}

/// Calls call(options), writing to stdout instead of a file if `output` is "-".
template <class Options, class Call>
auto callWithOutput(const std::string& output, Options options, const Call& call) -> decltype(call(options)) {
    if (output != "-") return call(options);
    StandardOutput standard_output;
    options.sink = [&](std::span<const std::uint8_t> part) { return standard_output.write(part); };
    auto report = call(options);
    if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
    return report;
}

/// Runs a command on an image, which is read from stdin if `input` is "-", and calls callWithOutput().
template <class Options, class Call>
auto callOnImage(const std::string& input, const std::string& output, std::uint64_t memory_limit_bytes, Options options,
                 const Call& call) -> decltype(call(options)) {
    progressLine().update(input, "converting", 0, 0);
    std::vector<std::uint8_t> bytes;
    if (input == "-") {
        // Any bytes are accepted, because the library determines the format.
        const auto is_anything = [](std::string_view) { return true; };
        Result<std::vector<std::uint8_t>> read = readStandardInput("an image", memory_limit_bytes, is_anything, "");
        if (!read) return std::move(read).error();
        bytes = *std::move(read);
        options.content = bytes;
    }
    return callWithOutput(output, std::move(options), call);
}

/// Writes the image with make(), which returns a Result. Then prints the error, or the report: as text by
/// textOf(outcome), or as JSON by jsonOf(outcome, exit_code). The report goes to stderr if the image is written to
/// stdout.
template <class Options, class Make, class JsonOf, class TextOf>
ExitCode makeAndPrint(const ImageArguments<Options>& arguments, const Make& make, JsonOf jsonOf, TextOf textOf) {
    HeldOutputs outputs;
    using Value = std::remove_cvref_t<decltype(*make())>;
    report::Outcome<Value> outcome{.input = arguments.input,
                                   .output = arguments.output,
                                   .result = make(),
                                   .is_dry_run = arguments.options.dry_run};
    return commitAndPrint(outputs, [&](const Error* failure) {
        if (failure != nullptr) outcome.result = *failure;
        PreparedReport report{.to = arguments.output == "-" ? stderr : stdout};
        if (!outcome.result) report.exit_code = printError(arguments.input, outcome.result.error());
        if (arguments.json) {
            report.text = jsonOf(outcome, report.exit_code);
        } else if (!arguments.quiet && outcome.result) {
            report.text = fitted(textOf(outcome), report.to);
        }
        return report;
    });
}

/// Makes the image with call(input, output, options), and prints the report. `fit`: whether the outputs can be written.
template <class Options, class Call, class JsonOf, class TextOf>
ExitCode makeFromImage(const ImageArguments<Options>& arguments, const Result<Done>& fit, const Call& call,
                       JsonOf jsonOf, TextOf textOf) {
    if (!fit) return printUsageError(fit.error().message + "; name another file");
    if (goesToTerminal(arguments)) return printUsageError(kNoTextForATerminal);
    const auto make = [&] {
        return callOnImage(arguments.input, arguments.output, arguments.options.file.memory_limit_bytes,
                           arguments.options,
                           [&](const Options& options) { return call(arguments.input, arguments.output, options); });
    };
    return makeAndPrint(arguments, make, jsonOf, textOf);
}

}  // namespace tspace::tool
