// SPDX-License-Identifier: MIT
// Options that several commands have.
#include "common_options.h"

#include <set>

namespace tspace::tool {

namespace {

constexpr const char* kBatchGroup = "Many files";

/// "I/N" with 1 <= I <= N.
bool parseShard(const std::string& text, Shard& shard) {
    const std::size_t slash = text.find('/');
    return slash != std::string::npos && CLI::detail::lexical_cast(text.substr(0, slash), shard.index) &&
           CLI::detail::lexical_cast(text.substr(slash + 1), shard.count) && shard.index >= 1 &&
           shard.index <= shard.count;
}

/// "500M", "8G" or "none"; K, M, G and T count by 1024. At least what any file gets.
bool parseMemory(const std::string& text, std::uint64_t& bytes) {
    constexpr std::uint64_t kLeast = std::uint64_t{64} << 20, kMost = std::uint64_t{1} << 56;
    if (text == "none") {
        bytes = kNoMemoryLimit;
        return true;
    }
    const std::size_t unit = text.find_first_not_of("0123456789");
    const std::size_t power = unit + 1 == text.size() ? std::string("KMGT").find(text[unit]) : std::string::npos;
    std::uint64_t count = 0;
    if (power == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, unit), count)) return false;
    const std::uint64_t factor = std::uint64_t{1} << (10 * (power + 1));
    bytes = count * factor;
    return count <= kMost / factor && bytes >= kLeast;
}

}  // namespace

CLI::Validator degrees(double most) {
    return CLI::Validator(
        [most](std::string& text) -> std::string {
            double value = 0;
            // Written so that NaN fails too.
            if (CLI::detail::lexical_cast(text, value) && value >= 0 && value <= most) return {};
            return "must be a number of degrees from 0 to " + std::to_string(static_cast<int>(most));
        },
        "");
}

CLI::Validator conventionName() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            return findConvention(text.c_str()) != nullptr ? "" : "no such convention: " + text;
        },
        "");
}

void addInputs(CLI::App* command, std::vector<std::string>& inputs) {
    command
        ->add_option(
            "IN", inputs,
            "Model files (.glb, .gltf, .obj; also .fbx, .ply, .stl, .dae, .3ds and more where tspace-import is "
            "installed), folders, and patterns in quotes ('models/**/*.glb'). Of a "
            "folder all model files in it and below are taken.")
        ->type_name("IN...")
        ->required()
        ->group("Input and output");
}

void addBatch(CLI::App* command, BatchArguments& batch, bool with_manifest) {
    command->add_option("--jobs", batch.jobs, "Files worked on at one time; 0: as many as there are cores.")
        ->type_name("N")
        ->check(CLI::Range(0U, 1024U).description(""))
        ->default_str("1")
        ->group(kBatchGroup);
    command
        ->add_option_function<std::string>(
            "--shard", [&batch](const std::string& text) { parseShard(text, batch.shard); },
            "Work on share I of N alone (I from 1), for several machines. A file's name below its input decides, so "
            "a file stays in its share when others come or go.")
        ->type_name("I/N")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                Shard unused;
                return parseShard(text, unused) ? "" : "must be I/N with I from 1 to N, such as 2/8";
            },
            ""))
        ->group(kBatchGroup);
    if (!with_manifest) return;
    CLI::Option* manifest =
        command->add_option("--manifest", batch.manifest,
                            "Append a line of JSON to this file for every file done: hashes of what was read and "
                            "written, options, result, time (schema: docs/json.md).");
    manifest->type_name("FILE")->group(kBatchGroup);
    command
        ->add_flag("--resume", batch.resume,
                   "Leave out files that the manifest says are done with these options, where neither they nor their "
                   "outputs have changed since.")
        ->needs(manifest)
        ->group(kBatchGroup);
}

std::string resultOptions(const CLI::App* command) {
    std::set<std::string> given;
    for (const CLI::Option* option : command->get_options()) {
        const std::string& group = option->get_group();
        if (option->count() == 0 || option->get_positional() || group == kBatchGroup || group == "Reporting" ||
            group == "Running" || option->check_name("--output") || option->check_name("--in-place")) {
            continue;
        }
        std::string text = option->get_name();
        if (option->get_expected_max() > 0) {
            for (const std::string& value : option->results()) text += "=" + value;
        }
        given.insert(std::move(text));
    }
    std::string joined;
    for (const std::string& text : given) joined += (joined.empty() ? "" : " ") + text;
    return joined;
}

void addReporting(CLI::App* command, bool& json, bool& quiet) {
    const char* group = "Reporting";
    command->add_flag("--json", json, "Print the result as JSON on stdout (schema: docs/json.md).")->group(group);
    command->add_flag("-q,--quiet", quiet, "Print nothing but errors, and the JSON if asked for.")->group(group);
}

void addAllowExternal(CLI::App* command, bool& allow_external) {
    command
        ->add_flag("--allow-external", allow_external,
                   "Also follow paths in a model that lead outside its own folder. By default absolute paths, paths "
                   "with '..' and URLs are refused.")
        ->group("Input and output");
}

void addThreads(CLI::App* command, Execution& execution) {
    command
        ->add_option("--threads", execution.thread_count,
                     "Number of threads; 0: as many as there are cores. Changes no bit of the result.")
        ->type_name("N")
        ->check(CLI::Range(0U, 1024U).description(""))
        ->default_str("0")
        ->group("Running");
}

void addMemoryLimit(CLI::App* command, FileOptions& file) {
    command
        ->add_option_function<std::string>(
            "--memory-limit", [&file](const std::string& text) { parseMemory(text, file.memory_limit_bytes); },
            "What working on one file may take of memory, about: a number with M or G (64M or more), or "
            "none. What it "
            "would take is estimated first, and more is refused. Default: 64M, and 16 times the bytes of the "
            "file and of "
            "those it names, so that a small file that claims to be huge does no harm.")
        ->type_name("SIZE")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                std::uint64_t unused = 0;
                return parseMemory(text, unused) ? "" : "must be a number with M or G, 64M or more, or none";
            },
            ""))
        ->group("Running");
}

}  // namespace tspace::tool
