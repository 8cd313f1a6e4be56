// SPDX-License-Identifier: MIT
// tspace generate: processes many files in parallel; a failed file does not stop the others.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>

#include "batch.h"
#include "command_table.h"
#include "commands/generate/generate_report.h"
#include "commands/shared/request.h"
#include "common_options.h"
#include "console.h"
#include "interrupt.h"
#include "manifest.h"
#include "output_files.h"
#include "report_outputs.h"
#include "standard_input.h"

namespace tspace::tool {
namespace {

struct GenerateArguments {
    JobRequest jobs = {};
    GenerateOptions options = {};
    std::string option_text = {};  ///< the given options that affect results, in canonical form
    BatchArguments batch = {};
    bool json = false;
    bool quiet = false;
};

constexpr Named<Container> kContainers[] = {
    {"glb", Container::glb},
    {"gltf", Container::gltf},
};

void addOutputOptions(Command& command, GenerateArguments& arguments) {
    const char* group = kInputAndOutput;
    addInputs(command, arguments.jobs.inputs, InputKind::model);
    command.add(
        group,
        fileOption("-o, --output", "OUT", arguments.jobs.output,
                   "Output file (.glb, .vrm or .gltf) or folder. Several inputs, or a folder as input, need a "
                   "folder, which is created if missing; files keep their paths relative to the input folder. If "
                   "a.glb and a.obj would both become a.glb, the later one becomes a.obj.glb. '-': writes the "
                   "model as GLB to stdout and the report to stderr."));
    command.add(group, flag("--in-place", arguments.jobs.in_place,
                            "Overwrite the input files. Each is replaced only when its result is complete. Without "
                            "this option, an output that is also an input is rejected."));
    command.add(group, choice("--container", "FORMAT", kContainers, arguments.jobs.container,
                              "File format of outputs whose name does not determine it: glb or gltf. Default: that of "
                              "the input; glb for OBJ."));
}

/// Applies the effects of option combinations. Returns an error message for an invalid combination, or an empty string.
std::string finish(const Given& given, GenerateArguments& arguments) {
    arguments.option_text = resultOptions(given);
    const std::string wrong = options::finish(given, arguments.options);
    arguments.jobs.is_dry_run = arguments.options.dry_run;
    arguments.jobs.has_list = given.has("--files-from");
    arguments.jobs.has_manifest = !arguments.batch.manifest.empty();
    return wrong;
}

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Returns the input and output files with fingerprints. An overwritten file is listed only as output.
ManifestEntry manifestEntry(const Job& job, const report::GenerateOutcome& outcome, const std::string& options) {
    ManifestEntry entry{.version = TSPACE_VERSION, .options = options, .job = job, .seconds = outcome.seconds};
    if (!outcome.result) {
        entry.job.error = outcome.result.error();
        entry.inputs = hashFiles({outcome.input});
        return entry;
    }
    const GenerateReport& report = *outcome.result;
    std::vector<std::string> outputs = report.output_files;
    if (outputs.empty()) outputs.push_back(outcome.output);
    std::vector<std::string> inputs;
    for (const std::string& input : report.input_files) {
        if (std::find(outputs.begin(), outputs.end(), input) == outputs.end()) inputs.push_back(input);
    }
    entry.changed = report.changed;
    entry.inputs = hashFiles(inputs);
    entry.outputs = hashFiles(outputs);
    return entry;
}

class GenerateRun {
  public:
    GenerateRun(const GenerateArguments& arguments, std::vector<Job> jobs)
        : arguments_(arguments), jobs_(std::move(jobs)), outcomes_(jobs_.size()), texts_(jobs_.size()),
          failures_(jobs_.size()), workers_(workerCount(arguments.batch, jobs_.size())),
          report_to_(arguments.jobs.output == "-" ? stderr : stdout), wants_text_(!arguments.json && !arguments.quiet) {
        progressLine().setFileCount(jobs_.size());
    }

    /// Opens the manifest. An error ends the run before anything is done.
    Result<Done> openManifest() { return record_.open(arguments_.batch, jobs_, arguments_.options.dry_run); }

    ExitCode run() {
        runBatch(
            jobs_.size(), workers_, [this](std::size_t job) { work(job); }, [this](std::size_t job) { finish(job); },
            [this] { return wasInterrupted() || output_is_closed_; });
        if (wasInterrupted()) endByInterrupt();
        if (output_is_closed_) return ExitCode::cannotReadOrWrite;
        const auto is_written = [](const report::GenerateOutcome& outcome) { return outcome.result.ok(); };
        const bool has_outputs = std::any_of(outcomes_.begin(), outcomes_.end(), is_written);
        const auto report = [&] {
            if (Depfile* const depfile = Depfile::ofRun(); depfile != nullptr && exit_code_ == ExitCode::done) {
                if (const Result<Done> written = depfile->write({}); !written)
                    exit_code_ = printError(depfile->path(), written.error());
            }
            std::string last;
            if (arguments_.json) {
                const bool is_prepared = outcomes_.size() == 1 && exit_code_ == ExitCode::done;
                last = is_prepared ? std::move(texts_[0])
                                   : report::generateJson(outcomes_, exit_code_, secondsSince(start_));
            } else if (wants_text_ && outcomes_.size() > 1) {
                last = fitted(report::generateSummary(outcomes_, secondsSince(start_)), report_to_);
            }
            const std::string_view failure = !has_outputs            ? kCannotPrint
                                             : outcomes_.size() == 1 ? std::string_view(failures_[0])
                                                                     : kCannotPrintReport;
            return printResult(last, report_to_, failure) ? exit_code_ : ExitCode::cannotReadOrWrite;
        };
        return has_outputs ? afterOutputs(kNoMemoryForReport, report) : report();
    }

  private:
    Result<GenerateReport> generate(const Job& job) {
        if (job.error.code != ErrorCode::ok) return job.error;
        GenerateOptions options = arguments_.options;
        options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers_);
        options.progress = progressOf(job.input);
        StandardInput standard_input;
        if (const Result<Done> opened = standard_input.open(job.input, options.file); !opened) return opened.error();
        if (job.output != "-") return generateFile(job.input, job.output, options);
        StandardOutput standard_output;
        options.sink = [&](std::span<const std::uint8_t> bytes) { return standard_output.write(bytes); };
        Result<GenerateReport> report = generateFile(job.input, "stdout.glb", options);
        if (const Result<Done> closed = standard_output.close(); !closed) return closed.error();
        if (report) report->output_files = {"-"};
        return report;
    }

    void work(std::size_t number) {
        const Clock::time_point start = Clock::now();
        const Job& job = jobs_[number];
        report::GenerateOutcome outcome{
            .input = job.input, .output = job.output, .is_dry_run = arguments_.options.dry_run};
        const auto make = [&]() -> Result<GenerateReport> {
            outcome.was_done_before = job.error.code == ErrorCode::ok && record_.isDone(job, arguments_.option_text);
            return outcome.was_done_before ? GenerateReport{} : generate(job);
        };
        makeAndCommit(outcome, jobs_.size() == 1, make, [&] {
            outcome.seconds = secondsSince(start);
            if (outcome.result) {
                texts_[number] = textOf(outcome);
                failures_[number] = lineWithoutReport(outcome.result->output_files);
            }
        });
        if (record_.isKept() && !outcome.was_done_before) record(job, outcome);
        progressLine().fileDone(outcome.result.ok());
        outcomes_[number] = std::move(outcome);
    }

    /// Returns the text printed for a written file: its line, its details, or the JSON document of a run with only this
    /// file.
    std::string textOf(const report::GenerateOutcome& outcome) const {
        const bool is_alone = jobs_.size() == 1;
        if (arguments_.json && is_alone) return report::generateJson({outcome}, ExitCode::done, secondsSince(start_));
        if (!wants_text_) return {};
        const bool shows_details = is_alone || arguments_.batch.verbose;
        return fitted(shows_details ? report::generateText(outcome) : report::generateLine(outcome), report_to_);
    }

    void record(const Job& job, const report::GenerateOutcome& outcome) {
        const ExitCode code = afterOutputs(
            kNoMemoryForManifest, [&] { return record_.append(manifestEntry(job, outcome, arguments_.option_text)); });
        const std::lock_guard lock(mutex_);
        exit_code_ = worse(exit_code_, code);
    }

    /// Reports a file. Called in file order, one call at a time.
    void finish(std::size_t number) {
        const report::GenerateOutcome& outcome = outcomes_[number];
        if (!outcome.result) {
            const ExitCode code = printError(outcome.input, outcome.result.error());
            const std::lock_guard lock(mutex_);
            exit_code_ = worse(exit_code_, code);
        } else if (wants_text_ && !output_is_closed_) {
            output_is_closed_ = !printResult(texts_[number], report_to_, failures_[number]);
        }
    }

    const GenerateArguments& arguments_;
    const Clock::time_point start_ = Clock::now();
    std::vector<Job> jobs_;
    std::vector<report::GenerateOutcome> outcomes_;
    std::vector<std::string> texts_;     ///< result of textOf() for each file
    std::vector<std::string> failures_;  ///< result of lineWithoutReport() for each file
    unsigned workers_;
    std::FILE* report_to_;
    bool wants_text_;
    BatchRecord record_ = {};
    std::mutex mutex_;  ///< guards the following members
    ExitCode exit_code_ = ExitCode::done;
    std::atomic<bool> output_is_closed_ = false;
};

ExitCode runGenerate(const GenerateArguments& arguments) {
    Result<std::vector<Job>> jobs = generateJobs(arguments.jobs);
    if (!jobs) return printUsageError(jobs.error().message);
    if (!arguments.quiet && !jobs->empty() && !jobs->front().remark.empty()) printRemark(jobs->front().remark);
    std::vector<std::string> files;
    for (const Job& job : *jobs) files.insert(files.end(), {job.input, job.output});
    if (const Result<Done> fit = prepareOutputs({arguments.batch.manifest}, files); !fit)
        return printUsageError(fit.error().message);
    takeShard(*jobs, arguments.batch.shard);
    GenerateRun run(arguments, std::move(*jobs));
    if (const Result<Done> opened = run.openManifest(); !opened)
        return printError(arguments.batch.manifest, opened.error());
    return run.run();
}

}  // namespace

Command generateCommand() {
    const auto owned = std::make_shared<GenerateArguments>();
    GenerateArguments& arguments = *owned;
    arguments.options.execution.thread_count = kAllThreads;
    Command command{
        .summary = "add the tangents that normal maps need",
        .operands = "IN... {-o OUT | --in-place}",
        .description =
            "Reads model files, adds missing normals, adds missing tangents if a material needs them (a normal map, "
            "clearcoat normal map or anisotropy), and writes glTF. Vertices are split where the tangents of their "
            "corners differ, with all their attributes, skin weights and morph targets. Morph targets that move the "
            "surface get tangent deltas. Everything else in the file is preserved. If a run fails, an existing output "
            "file is not changed.",
        .examples = {"tspace generate helmet.glb -o out/helmet.glb",
                     "tspace generate --all --overwrite models/ -o out/",
                     "tspace generate scan.obj -o scan.glb --all --normals angle --crease 60",
                     "tspace generate --json *.glb -o out/ > report.json", "cat a.glb | tspace generate - -o - > b.glb",
                     "tspace generate models/ -o out/ --jobs 8 --manifest done.jsonl --resume"},
        .finish = [&arguments](const Given& given) { return finish(given, arguments); },
    };
    addOutputOptions(command, arguments);
    command.add(generateOptions(arguments.options));
    addBatch(command, arguments.batch, true);
    addReporting(command, arguments.json, arguments.quiet);
    command.keeps_freed_memory = true;
    command.file = &owned->options.file;
    command.run = [owned] { return runGenerate(*owned); };
    return command;
}

}  // namespace tspace::tool
