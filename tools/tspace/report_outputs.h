// SPDX-License-Identifier: MIT
// Final steps of every command that writes files: prepare the report, put the outputs in place, print the report.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "console.h"
#include "core/base/border.h"
#include "depfile.h"
#include "model/io/atomic_output.h"
#include "output_files.h"

namespace tspace::tool {

/// Prepared result of a command, which can be printed without allocating.
struct PreparedReport {
    ExitCode exit_code = ExitCode::done;
    std::string text = {};
    std::FILE* to = stdout;
    std::vector<std::string> earlier_files = {};  ///< outputs that are in place already
};

/// Returns the line to print if standard output fails although `files` are in place.
inline std::string lineWithoutReport(const std::vector<std::string>& files) {
    constexpr std::size_t kMaxNamed = 8;
    std::string line = files.empty() ? "tspace: cannot write to standard output"
                                     : "tspace: cannot write the report to standard output";
    for (std::size_t i = 0; i < std::min(files.size(), kMaxNamed); ++i)
        line += (i == 0 ? "; all output files are complete: " : ", ") + printable(files[i]);
    if (files.size() > kMaxNamed) line += ", and " + std::to_string(files.size() - kMaxNamed) + " more";
    return line + "\n";
}

/// Puts the last outputs of a run in place, together with the dependency file. After an error none is in place.
inline Result<Done> commitLast(HeldOutputs& outputs) {
    if (Depfile* const depfile = Depfile::ofRun()) {
        if (const Result<Done> written = depfile->write(outputs.files()); !written) {
            outputs.discard();
            return written;
        }
    }
    return outputs.commit();
}

/// Ends a command whose outputs are held. prepare(failure) composes the report: `failure` is null before the outputs
/// are put in place; if that fails, prepare is called again with the reason, and no output exists. Files that prepare()
/// writes are outputs, too. Nothing allocates once outputs are in place; std::bad_alloc before that leaves no outputs.
template <class Prepare>
ExitCode commitAndPrint(HeldOutputs& outputs, const Prepare& prepare) {
    PreparedReport report = prepare(static_cast<const Error*>(nullptr));
    const auto lineOf = [&] {
        std::vector<std::string> files = report.earlier_files;
        for (std::string& file : outputs.files()) files.push_back(std::move(file));
        return lineWithoutReport(files);
    };
    std::string failure = lineOf();
    const bool is_done = report.exit_code == ExitCode::done || report.exit_code == ExitCode::findings;
    if (const Result<Done> done = is_done ? commitLast(outputs) : outputs.commit(); !done) {
        report = prepare(&done.error());
        failure = lineOf();
        // Only a report file is held now; the exit code is already that of an error.
        static_cast<void>(outputs.commit());
    }
    return printResult(report.text, report.to, failure) ? report.exit_code : ExitCode::cannotReadOrWrite;
}

/// Runs a command whose report may also be written to a file (--report). `arguments` has the members report, json and
/// quiet; `outcome`: names the input and the output. make(read) makes the outputs and records the files that it reads.
/// `files`: those that errors may name. If nothing was written, findingsOf(value) contains the reason.
template <class Value, class Arguments, class Make, class CodeOf, class FindingsOf, class JsonOf, class TextOf>
ExitCode makeAndReport(const Arguments& arguments, report::Outcome<Value> outcome,
                       const std::vector<std::string>& files, const Make& make, const CodeOf& codeOf,
                       const FindingsOf& findingsOf, const JsonOf& jsonOf, const TextOf& textOf) {
    InputFiles read;
    const auto start = std::chrono::steady_clock::now();
    HeldOutputs held;
    Result<Value>& result = outcome.result = make(read);
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    // Only reading a model shows which files it references.
    const bool is_input = !arguments.report.empty() && read.has(arguments.report);
    if (result && is_input) {
        result = Error{ErrorCode::invalidOption, "the output " + arguments.report + " is an input"};
        held.discard();
    }
    return commitAndPrint(held, [&](const Error* failure) {
        if (failure != nullptr) result = *failure;
        PreparedReport report{.exit_code = result ? codeOf(*result) : printErrorOfFiles(files, result.error())};
        // The reason is printed for users who do not read the report.
        if (result && result->output_files.empty()) {
            for (const std::string& finding : findingsOf(*result)) printRemark(finding);
        }
        // The file is written after most errors too, but not if memory ran out.
        const bool has_memory = result || result.error().code != ErrorCode::outOfMemory;
        if (!arguments.report.empty() && has_memory && !is_input) {
            const Result<Done> written = writeTextFile(arguments.report, jsonOf(outcome, report.exit_code), &read);
            if (!written) report.exit_code = worse(report.exit_code, printError(arguments.report, written.error()));
        }
        if (arguments.json) {
            report.text = jsonOf(outcome, report.exit_code);
        } else if (!arguments.quiet && result) {
            report.text = fitted(textOf(outcome));
        }
        return report;
    });
}

/// Processes one of several files: sets outcome.result to make(), composes its report with prepare(), and puts its
/// outputs in place. If memory runs out or an output cannot be put in place, the result is this error, and there are no
/// outputs. `is_alone`: these are the only outputs of the run.
template <class Outcome, class Make, class Prepare>
void makeAndCommit(Outcome& outcome, bool is_alone, const Make& make, const Prepare& prepare) {
    const Result<Done> done = atBorder([&]() -> Result<Done> {
        HeldOutputs outputs;
        outcome.result = make();
        prepare();
        return is_alone && outcome.result ? commitLast(outputs) : outputs.commit();
    });
    if (!done) outcome.result = done.error();
}

inline constexpr const char* kCannotPrintReport =
    "tspace: cannot write the report to standard output; all output files are complete\n";
inline constexpr const char* kNoMemoryForReport =
    "tspace: out of memory: cannot write the report to standard output; all output files are complete\n";
inline constexpr const char* kNoMemoryForManifest =
    "tspace: out of memory: cannot write the manifest; all output files are complete\n";

/// Calls work(), a step after outputs have been put in place, such as writing a report on several files or the
/// manifest. If memory runs out in it, prints `line`, which needs no memory, and returns the exit code of a file that
/// cannot be written.
template <class Work>
ExitCode afterOutputs(const char* line, const Work& work) {
    const Result<ExitCode> done = atBorder([&]() -> Result<ExitCode> { return work(); });
    if (done) return *done;
    printPlain(line);
    return ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
