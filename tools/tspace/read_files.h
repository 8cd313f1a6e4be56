// SPDX-License-Identifier: MIT
// Processes many files for commands that only read: several files in parallel, with reports in file order. A failed
// file does not stop the others.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "batch.h"
#include "commands/shared/report.h"
#include "console.h"

namespace tspace::tool {

template <class Value>
struct ReadFiles {
    std::vector<report::Outcome<Value>> outcomes = {};
    ExitCode exit_code = ExitCode::done;  ///< the worst exit code of the files that could not be read
    bool output_is_closed = false;        ///< stdout was closed; some files may not have been processed
};

/// Calls read(job), which returns a Result<Value>, for each job. Prints errors and, with `wants_text`, textOf(outcome)
/// of each result; with several files only its first line, unless the user requested details.
template <class Value, class Read, class TextOf>
ReadFiles<Value> readFiles(const std::vector<Job>& jobs, const BatchArguments& batch, bool wants_text, Read read,
                           TextOf textOf) {
    const bool shows_details = jobs.size() == 1 || batch.verbose;
    ReadFiles<Value> files;
    files.outcomes.resize(jobs.size());
    std::atomic<bool> output_is_closed = false;
    progressLine().setFileCount(jobs.size());
    const auto work = [&](std::size_t number) {
        const Job& job = jobs[number];
        progressLine().update(job.input, "reading", 0, 0);
        files.outcomes[number] = {.input = job.input,
                                  .result = job.error.code == ErrorCode::ok ? read(job) : Result<Value>(job.error)};
        progressLine().fileDone(files.outcomes[number].result.ok());
    };
    const auto finished = [&](std::size_t number) {
        const report::Outcome<Value>& outcome = files.outcomes[number];
        if (!outcome.result) {
            files.exit_code = worse(files.exit_code, printError(outcome.input, outcome.result.error()));
        } else if (wants_text && !output_is_closed) {
            std::string text = shows_details && number > 0 ? "\n" : "";
            text.append(textOf(outcome));
            if (!shows_details) text.erase(text.find('\n') + 1);
            output_is_closed = !printText(text);
        }
    };
    runBatch(jobs.size(), workerCount(batch, jobs.size()), work, finished, [&] { return output_is_closed.load(); });
    files.output_is_closed = output_is_closed;
    return files;
}

}  // namespace tspace::tool
