// SPDX-License-Identifier: MIT
// The order at the end of every command that writes files: the report is prepared, the outputs are put in place, the report is
// printed.
#pragma once

#include <cstdio>
#include <string>

#include "console.h"
#include "core/base/border.h"
#include "model/io/atomic_output.h"

namespace tspace::tool {

/// The end of a command, ready to be printed without memory.
struct PreparedReport {
    ExitCode exit_code = ExitCode::done;
    std::string text = {};
    std::FILE* to = stdout;
};

/// Ends a command whose outputs are held. prepare(failure) composes the report: `failure` is null before the outputs are put in
/// place, and the reason in a second call where that failed and no output is there. Files that it writes are outputs, too.
/// Nothing needs memory once outputs are in place; std::bad_alloc before that leaves none.
template <class Prepare>
ExitCode commitAndPrint(HeldOutputs& outputs, const Prepare& prepare) {
    PreparedReport report = prepare(static_cast<const Error*>(nullptr));
    if (const Result<Done> done = outputs.commit(); !done) {
        report = prepare(&done.error());
        // Only a file of the report is held now; the exit code is that of an error already.
        static_cast<void>(outputs.commit());
    }
    return printResult(report.text, report.to) ? report.exit_code : ExitCode::cannotReadOrWrite;
}

/// One file of several: outcome.result becomes make(), prepare() composes what is said about it, and its outputs are put in
/// place. Where memory ends or an output cannot be put in place, that is the result, and there are no outputs.
template <class Outcome, class Make, class Prepare>
void makeAndCommit(Outcome& outcome, const Make& make, const Prepare& prepare) {
    const Result<Done> done = atBorder([&]() -> Result<Done> {
        HeldOutputs outputs;
        outcome.result = make();
        prepare();
        return outputs.commit();
    });
    if (!done) outcome.result = done.error();
}

inline constexpr const char* kNoMemoryForReport =
    "tspace: standard output: cannot write the report for lack of memory; the outputs are complete\n";
inline constexpr const char* kNoMemoryForManifest =
    "tspace: cannot write the manifest for lack of memory; the outputs are complete\n";

/// Calls work(), which follows outputs that are in place: what concerns several files, or is about the files written. Where
/// memory ends in it, the line, which needs none, and the exit code of a file that cannot be written take its place.
template <class Work>
ExitCode afterOutputs(const char* line, const Work& work) {
    const Result<ExitCode> done = atBorder([&]() -> Result<ExitCode> { return work(); });
    if (done) return *done;
    printPlain(line);
    return ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
