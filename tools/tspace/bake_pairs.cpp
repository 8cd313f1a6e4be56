// SPDX-License-Identifier: MIT
// tspace bake --pairs: several bakes in parallel; a failed bake does not stop the others.
#include "bake_pairs.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>

#include "commands/bake/bake_outputs.h"
#include "commands/bake/bake_report.h"
#include "commands/bake/match_meshes.h"
#include "console.h"
#include "interrupt.h"
#include "manifest.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/folder_rule.h"
#include "model/io/recorded_files.h"
#include "model/io/text_encoding.h"
#include "output_files.h"
#include "report_outputs.h"

namespace tspace::tool {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

std::string below(const Path& folder, const std::string& name) { return Path(fs::path(folder) / Path(name)).string(); }

/// One line of the table.
struct Pair {
    Job job = {};
    std::size_t line = 0;
    std::string high = {}, model = {};  ///< `model`: output path of the low poly with its maps; may be empty
};

/// Reads the table of pairs. Throws FileError.
std::vector<Pair> readTable(const BakePairsArguments& arguments) {
    const Bytes bytes = readFile(arguments.table);
    recordInput(arguments.table);
    const Path folder = folderOf(arguments.table);
    std::vector<Pair> pairs;
    std::string_view rest = narrowText({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    for (std::size_t number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (const std::string text = trimmed(line); text.empty() || text[0] == '#') continue;
        std::vector<std::string> words;
        for (bool more = true; more;) {
            const std::size_t equals = line.find('=');
            more = equals != std::string_view::npos;
            words.push_back(trimmed(line.substr(0, equals)));
            if (more) line.remove_prefix(equals + 1);
        }
        const bool is_whole = words.size() <= 3 && std::find(words.begin(), words.end(), "") == words.end();
        if (words.size() < 2 || !is_whole)
            failFile(ErrorCode::invalidFile,
                     "line " + std::to_string(number) + ": expected LOW = HIGH or LOW = HIGH = NAME");
        if (words.size() == 3 && leadsAway(fs::path(Path(words[2]))) != nullptr)
            failFile(ErrorCode::forbiddenPath, "line " + std::to_string(number) + ": the output " + inQuotes(words[2]) +
                                                   " is outside the output folder (-o)");
        Pair& pair = pairs.emplace_back();
        pair.line = number;
        pair.job.name = words[0];
        pair.job.input = below(folder, words[0]);
        pair.high = below(folder, words[1]);
        const std::string name = words.size() == 3 ? words[2] : stemOf(words[0]) + ".png";
        if (printable(name) != name)
            failFile(ErrorCode::forbiddenPath, "line " + std::to_string(number) + ": the output " + inQuotes(name) +
                                                   " has a control character in its name");
        pair.job.output = below(arguments.output, name);
        if (!arguments.options.out_mesh.empty()) pair.model = below(arguments.options.out_mesh, stemOf(name) + ".glb");
    }
    if (pairs.empty()) failFile(ErrorCode::invalidFile, "the table contains no line LOW = HIGH");
    return pairs;
}

/// A line of the table, and the files that its bake writes.
struct PairOutputs {
    std::size_t line = 0;
    std::vector<std::string> files = {};
};

/// Returns a sentence if two lines write the same file, otherwise an empty string.
std::string sharedOutput(const std::vector<PairOutputs>& pairs) {
    std::map<std::string, std::size_t> lines;  // line numbers in the table, by file identity
    for (const PairOutputs& pair : pairs) {
        for (const std::string& file : pair.files) {
            const auto [first, is_new] = lines.emplace(identityOf(file), pair.line);
            if (!is_new && first->second != pair.line)
                return "lines " + std::to_string(first->second) + " and " + std::to_string(pair.line) +
                       " of the table both write " + file + "; use LOW = HIGH = NAME to rename one of them";
        }
    }
    return {};
}

BakeFileOptions optionsOf(const BakePairsArguments& arguments, const Pair& pair) {
    BakeFileOptions options = arguments.options;
    options.out_mesh = pair.model;
    return options;
}

/// Adds file names that depend on materials and tiles. Reads a low poly for them only if another pair writes a file
/// whose name this pair may also use.
void addSuffixedFiles(const BakePairsArguments& arguments, const std::vector<Pair>& pairs,
                      std::vector<PairOutputs>& outputs) {
    std::map<std::string, std::size_t> plain;  // index of the pair by the identity of each of its files
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const std::string& file : outputs[i].files) plain.emplace(identityOf(file), i);
    }
    std::set<std::size_t> asked;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const std::string& file : outputs[i].files) {
            for (const std::string& shorter : withoutSuffixes(file)) {
                const auto other = plain.find(identityOf(shorter));
                if (other != plain.end() && other->second != i) asked.insert({i, other->second});
            }
        }
    }
    for (const std::size_t i : asked) {
        const Pair& pair = pairs[i];
        // If a low poly cannot be read, its own bake reports the error.
        (void)tryFile([&] {
            outputs[i].files = outputsFor(pair.job.input, {pair.job.output, {}}, optionsOf(arguments, pair));
        });
    }
}

class PairsRun {
  public:
    PairsRun(const BakePairsArguments& arguments, std::vector<Pair> pairs)
        : arguments_(arguments), pairs_(std::move(pairs)), done_(pairs_.size()), texts_(pairs_.size()),
          failures_(pairs_.size()), workers_(workerCount(arguments.batch, pairs_.size())) {
        progressLine().setFileCount(pairs_.size());
    }

    /// Opens the manifest. An error ends the run before anything is done.
    Result<Done> openManifest() {
        std::vector<Job> jobs;
        for (const Pair& pair : pairs_) jobs.push_back(pair.job);
        return record_.open(arguments_.batch, jobs, false);
    }

    ExitCode run() {
        runBatch(
            pairs_.size(), workers_, [this](std::size_t pair) { work(pair); },
            [this](std::size_t pair) { finishPair(pair); }, [this] { return wasInterrupted() || output_is_closed_; });
        if (wasInterrupted()) endByInterrupt();
        if (output_is_closed_) return ExitCode::cannotReadOrWrite;
        const auto is_written = [](const report::BakedPair& pair) { return pair.outcome.result.ok(); };
        const bool has_outputs = std::any_of(done_.begin(), done_.end(), is_written);
        return has_outputs ? afterOutputs(kNoMemoryForReport, [this] { return finish(); }) : finish();
    }

  private:
    ExitCode finish() {
        const std::chrono::duration<double> took = Clock::now() - start_;
        const auto json = [&] { return report::bakedPairsJson(done_, exit_code_, took.count()); };
        HeldOutputs outputs;
        return commitAndPrint(outputs, [&](const Error* failure) {
            Result<Done> written = Done{};
            if (failure != nullptr) {
                written = *failure;
            } else if (!arguments_.report.empty()) {
                written = writeTextFile(arguments_.report, json());
            }
            if (!written) exit_code_ = worse(exit_code_, printError(arguments_.report, written.error()));
            return PreparedReport{.exit_code = exit_code_,
                                  .text = arguments_.json ? json() : std::string(),
                                  .earlier_files = mapsInPlace()};
        });
    }

    [[nodiscard]] std::vector<std::string> mapsInPlace() const {
        std::vector<std::string> files;
        for (const report::BakedPair& pair : done_) {
            if (!pair.outcome.result) continue;
            for (const std::string& file : pair.outcome.result->output_files) files.push_back(file);
        }
        return files;
    }

    Result<BakeFileReport> bake(const Pair& pair, std::vector<std::string>& read) {
        BakeFileOptions options = optionsOf(arguments_, pair);
        options.execution.thread_count = threadsPerFile(options.execution.thread_count, workers_);
        std::mutex mutex;
        options.file.opened = [&](const std::string& path) {
            const std::lock_guard lock(mutex);
            if (std::find(read.begin(), read.end(), path) == read.end()) read.push_back(path);
        };
        options.file.named = [](const std::string&) {};
        options.progress = progressOf(pair.job.input);
        return bakeFile(pair.job.input, pair.high, pair.job.output, options);
    }

    void work(std::size_t number) {
        const Pair& pair = pairs_[number];
        const Clock::time_point start = Clock::now();
        report::BakedPair done{.high = pair.high};
        done.outcome.input = pair.job.input;
        done.outcome.output = pair.job.output;
        std::vector<std::string> read = {pair.job.input, pair.high};
        // With --resume, a pair is baked again if its high poly or output model has changed, so both are recorded.
        const std::string options =
            arguments_.option_text + " high=" + pair.high + (pair.model.empty() ? "" : " model=" + pair.model);
        const auto make = [&]() -> Result<BakeFileReport> {
            done.outcome.was_done_before = record_.isDone(pair.job, options);
            return done.outcome.was_done_before ? BakeFileReport{} : bake(pair, read);
        };
        makeAndCommit(done.outcome, false, make, [&] {
            const std::chrono::duration<double> took = Clock::now() - start;
            done.outcome.seconds = took.count();
            if (done.outcome.result && !arguments_.json && !arguments_.quiet)
                texts_[number] = fitted(arguments_.batch.verbose && !done.outcome.was_done_before
                                            ? report::bakeText(done.outcome, pair.model)
                                            : report::bakeLine(done.outcome));
            if (done.outcome.result) failures_[number] = lineWithoutReport(done.outcome.result->output_files);
        });
        if (record_.isKept() && !done.outcome.was_done_before) record(pair, options, read, done);
        progressLine().fileDone(done.outcome.result.ok());
        done_[number] = std::move(done);
    }

    void record(const Pair& pair, const std::string& options, const std::vector<std::string>& read,
                const report::BakedPair& done) {
        take(afterOutputs(kNoMemoryForManifest, [&] { return record_.append(entryOf(pair, options, read, done)); }));
    }

    static ManifestEntry entryOf(const Pair& pair, const std::string& options, const std::vector<std::string>& read,
                                 const report::BakedPair& done) {
        ManifestEntry entry{.version = TSPACE_VERSION,
                            .options = options,
                            .job = pair.job,
                            .changed = true,
                            .seconds = done.outcome.seconds,
                            .inputs = hashFiles(read)};
        if (done.outcome.result) {
            entry.outputs = hashFiles(done.outcome.result->output_files);
        } else {
            entry.job.error = done.outcome.result.error();
        }
        return entry;
    }

    void take(ExitCode code) {
        const std::lock_guard lock(mutex_);
        exit_code_ = worse(exit_code_, code);
    }

    /// Reports a bake. Called in the order of the table, one call at a time.
    void finishPair(std::size_t number) {
        report::BakedPair& done = done_[number];
        if (!done.outcome.result) {
            done.exit_code = printErrorOfFiles({done.outcome.input, done.high}, done.outcome.result.error());
        } else {
            const std::vector<std::string>& findings = done.outcome.result->findings;
            done.exit_code = report::exitCodeOf(*done.outcome.result);
            if (done.outcome.result->output_files.empty()) {
                for (const std::string& finding : findings) printRemark(finding);
            }
            if (!arguments_.json && !arguments_.quiet && !output_is_closed_)
                output_is_closed_ = !printResult(texts_[number], stdout, failures_[number]);
        }
        take(done.exit_code);
    }

    const BakePairsArguments& arguments_;
    const Clock::time_point start_ = Clock::now();
    std::vector<Pair> pairs_;
    std::vector<report::BakedPair> done_;
    std::vector<std::string> texts_;     ///< printed text of each pair
    std::vector<std::string> failures_;  ///< lineWithoutReport() of each pair
    unsigned workers_;
    BatchRecord record_ = {};
    std::mutex mutex_;  ///< guards the following members
    ExitCode exit_code_ = ExitCode::done;
    std::atomic<bool> output_is_closed_ = false;
};

}  // namespace

ExitCode runBakePairs(const BakePairsArguments& arguments) {
    std::vector<Pair> pairs;
    if (const std::optional<Error> failure = tryFile([&] { pairs = readTable(arguments); }))
        return printError(arguments.table, *failure);
    std::vector<PairOutputs> written;
    for (const Pair& pair : pairs)
        written.push_back({pair.line, outputsToCompare({arguments.batch.manifest, arguments.report}, pair.job.input,
                                                       {.output = pair.job.output}, optionsOf(arguments, pair))});
    if (const std::string shared = sharedOutput(written); !shared.empty()) return printUsageError(shared);
    addSuffixedFiles(arguments, pairs, written);
    if (const std::string shared = sharedOutput(written); !shared.empty()) return printUsageError(shared);
    std::vector<std::string> outputs = {arguments.batch.manifest, arguments.report},
                             inputs = {arguments.table, matchFileOf(arguments.options.match)};
    for (const PairOutputs& pair : written) outputs.insert(outputs.end(), pair.files.begin(), pair.files.end());
    for (const Pair& pair : pairs) inputs.insert(inputs.end(), {pair.job.input, pair.high});
    if (const Result<Done> fit = prepareOutputs(outputs, inputs); !fit) return printUsageError(fit.error().message);
    // The shard depends on the name of the low poly in the table.
    std::erase_if(pairs, [&](const Pair& pair) { return !isInShard(pair.job, arguments.batch.shard); });
    PairsRun run(arguments, std::move(pairs));
    if (const Result<Done> opened = run.openManifest(); !opened)
        return printError(arguments.batch.manifest, opened.error());
    return run.run();
}

}  // namespace tspace::tool
