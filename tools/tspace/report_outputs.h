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

/// If the file of --report is one of the inputs, makes the result an error and discards the outputs. Only reading a
/// model shows which files it references.
template <class Value>
void rejectReportOfInput(Result<Value>& result, const std::string& path, const InputFiles& read, HeldOutputs& outputs) {
    if (!result || path.empty() || !read.has(path)) return;
    result = Error{ErrorCode::invalidOption, "the output " + path + " is an input"};
    outputs.discard();
}

/// Returns whether the file of --report is written. It is written after most errors, too, but not if memory ran out, or
/// if the file is one of the inputs.
template <class Value>
bool isReported(const Result<Value>& result, const std::string& path, const InputFiles& read) {
    const bool has_memory = result || result.error().code != ErrorCode::outOfMemory;
    return !path.empty() && has_memory && !read.has(path);
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
