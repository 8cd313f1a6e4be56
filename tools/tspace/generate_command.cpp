// SPDX-License-Identifier: MIT
// tspace generate: file after file, one bad file does not stop the others.
#include <chrono>
#include <filesystem>

#include "commands.h"
#include "console.h"
#include "report.h"

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The folders of an output, made when they are not there and taken away again when nothing was put into
/// them.
class OutputFolder {
  public:
    explicit OutputFolder(const fs::path& folder) {
        std::error_code ignored;
        for (fs::path path = folder; !path.empty() && !fs::exists(path, ignored); path = path.parent_path()) {
            made_.push_back(path);
        }
        if (!made_.empty()) fs::create_directories(folder, failed_);
    }
    ~OutputFolder() {
        std::error_code ignored;
        for (const fs::path& path : made_)
            fs::remove(path, ignored);  // fails, as it should, when something is in it
    }
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    [[nodiscard]] const std::error_code& failed() const { return failed_; }

  private:
    std::vector<fs::path> made_ = {};  // innermost first
    std::error_code failed_ = {};
};

Result<GenerateReport> generateOne(const Job& job, const GenerateArguments& arguments) {
    if (job.error.code != ErrorCode::ok) return job.error;
    const OutputFolder folder(fs::path(job.output).parent_path());
    if (folder.failed()) {
        return Error{ErrorCode::cannotWrite,
                     "cannot make the folder of the output: " + folder.failed().message(), kNoElement,
                     fs::path(job.output).parent_path().string()};
    }
    ProgressLine progress(job.input, !arguments.quiet);
    GenerateOptions options = arguments.options;
    options.progress = [&progress](const char* what, std::uint64_t done, std::uint64_t total) {
        progress.update(what, done, total);
    };
    return generateFile(job.input, job.output, options);
}

}  // namespace

ExitCode runGenerate(const GenerateArguments& arguments) {
    Result<std::vector<Job>> jobs = generateJobs(arguments);
    if (!jobs) return printUsageError(jobs.error().message);

    const Clock::time_point start = Clock::now();
    const bool wants_text = !arguments.json && !arguments.quiet;
    ExitCode exit_code = ExitCode::done;
    std::vector<GenerateOutcome> outcomes;
    for (Job& job : *jobs) {
        const Clock::time_point job_start = Clock::now();
        Result<GenerateReport> result = generateOne(job, arguments);
        outcomes.push_back({std::move(job), std::move(result), secondsSince(job_start)});
        const GenerateOutcome& outcome = outcomes.back();
        if (!outcome.result) {
            exit_code = worse(exit_code, printError(outcome.job.input, outcome.result.error()));
        } else if (wants_text && !printResult(generateText(outcome))) {
            return ExitCode::cannotReadOrWrite;
        }
    }
    std::string last;
    if (arguments.json) {
        last = generateJson(outcomes, exit_code, secondsSince(start));
    } else if (wants_text && outcomes.size() > 1) {
        last = generateSummary(outcomes, secondsSince(start));
    }
    return printResult(last) ? exit_code : ExitCode::cannotReadOrWrite;
}

}  // namespace tspace::tool
