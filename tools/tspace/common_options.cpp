// SPDX-License-Identifier: MIT
// Options shared by several commands.
#include "common_options.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "console.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/recorded_files.h"
#include "model/io/system_files.h"
#include "model/io/text_encoding.h"

namespace tspace::tool {
namespace {

constexpr unsigned kMaxJobs = 1024;

/// Parses "I/N" with 1 <= I <= N.
bool parseShard(const std::string& text, Shard& shard) {
    const std::size_t slash = text.find('/');
    std::uint64_t index = 0, count = 0;
    if (slash == std::string::npos || !parseNumber(text.substr(0, slash), index) ||
        !parseNumber(text.substr(slash + 1), count) || index < 1 || index > count || count > UINT32_MAX)
        return false;
    shard = {static_cast<unsigned>(index), static_cast<unsigned>(count)};
    return true;
}

}  // namespace

Option operand(const char* value_name, std::string& target, InputKind reads, HelpText help) {
    Option made = fileOption("", value_name, target, std::move(help), reads);
    made.is_required = true;
    return made;
}

Option operand(const char* value_name, std::vector<std::string>& target, InputKind reads, HelpText help) {
    const auto take = [&target](const std::string& given) {
        target.push_back(given);
        return std::string();
    };
    Option made = option("", value_name, take, std::move(help));
    made.is_file = made.is_required = made.is_repeatable = true;
    made.reads = reads;
    return made;
}

namespace {

/// Reads a stream to its end. Throws FileError.
void readStream(std::FILE* stream, std::string& text) {
    constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
    char part[4096];
    for (std::size_t count = 0; (count = std::fread(part, 1, sizeof part, stream)) != 0;) {
        text.append(part, count);
        if (text.size() > kMaxBytes) failFile(ErrorCode::cannotRead, "the list exceeds 256 MB");
    }
    if (std::ferror(stream) != 0) failFile(ErrorCode::cannotRead, "the list cannot be read");
}

/// Reads a file or a pipe; "-": standard input. Throws FileError.
std::string readList(const std::string& list) {
    std::string text;
    // Shells pass a pipe for <(...).
    const CFile pipe = list != "-" && kindOf(list) == PathKind::stream ? openFile(list, "rb") : nullptr;
    if (list == "-" || pipe) {
        readStream(pipe ? pipe.get() : stdin, text);
        return text;
    }
    const Bytes bytes = readFile(list);
    recordInput(list);
    return {bytes.begin(), bytes.end()};
}

/// Appends the paths in a list: one per line, or separated by NUL bytes if it contains any.
ExitCode readFileList(const std::string& list, std::vector<std::string>& inputs) {
    std::string text;
    const std::optional<Error> failure = tryFile([&] {
        text = readList(list);
        // Names of one character that are separated by NUL bytes look like UTF-16, but contain no line break.
        const bool has_lines = text.find('\n') != std::string::npos;
        const std::string_view begin = std::string_view(text).substr(0, has_lines ? text.size() : 3);
        text.erase(0, begin.size() - narrowText(begin).size());
    });
    if (failure) return printError(list == "-" ? "standard input" : list, *failure);
    const char end = text.find('\0') == std::string::npos ? '\n' : '\0';
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t stop = std::min(text.find(end, begin), text.size());
        std::string path = text.substr(begin, stop - begin);
        if (end == '\n' && path.ends_with('\r')) path.pop_back();
        if (!path.empty()) inputs.push_back(std::move(path));
        begin = stop + 1;
    }
    return ExitCode::done;
}

}  // namespace

void addInputs(Command& command, std::vector<std::string>& inputs, InputKind reads) {
    Option& files = command.add(
        kInputAndOutput, operand("IN...", inputs, reads,
                                 "Model files (.glb, .vrm, .gltf, .obj; also .fbx, .ply, .stl, .dae, .3ds and more if "
                                 "tspace-import is installed), folders, and quoted patterns ('models/**/*.glb'). "
                                 "Folders are searched recursively for model files. '-': a GLB from stdin."));
    files.is_required = false;
    const auto list = std::make_shared<std::string>();
    command.add(kManyFiles, fileOption("--files-from", "FILE", *list,
                                       "Also read input names from this file, one per line or separated by "
                                       "NUL bytes; '-': from stdin. The list may be empty.",
                                       InputKind::text));
    command.finish = [&inputs, list, finish = std::move(command.finish)](const Given& given) {
        if (inputs.empty() && list->empty()) return std::string("IN... is missing");
        if (*list == "-" && std::find(inputs.begin(), inputs.end(), "-") != inputs.end())
            return std::string("--files-from - and the input - cannot both read stdin");
        return finish ? finish(given) : std::string();
    };
    command.prepare = [&inputs, list] { return list->empty() ? ExitCode::done : readFileList(*list, inputs); };
}

void addBatch(Command& command, BatchArguments& batch, bool with_manifest) {
    const char* group = kManyFiles;
    command.add(group,
                number("--jobs", batch.jobs, kMaxJobs, "Number of inputs processed in parallel; 0: one per core."));
    const auto take_shard = [&batch](const std::string& text) -> std::string {
        return parseShard(text, batch.shard) ? "" : "must be I/N with I from 1 to N, such as 2/8";
    };
    command.add(
        group,
        option("--shard", "I/N", take_shard,
               "Process only shard I of N (1-based), to split a batch across machines. The shard of a file depends "
               "only on its path relative to the input folder, so adding or removing other files does not change it."));
    command.add(kReporting, flag("-v, --verbose", batch.verbose,
                                 "Print details for every input. By default, several inputs get one line each."));
    if (!with_manifest) return;
    Option& manifest = command.add(
        group, fileOption("--manifest", "FILE", batch.manifest,
                          "Append one line of JSON to this file for each finished input: hashes of inputs and "
                          "outputs, options, result and time (schema: docs/reference/json.md).",
                          InputKind::text));
    manifest.excludes = {"--dry-run"};
    command
        .add(group, flag("--resume", batch.resume,
                         "Skip files that the manifest lists as done with the same options, if neither they nor their "
                         "outputs have changed since."))
        .needs = "--manifest";
}

std::string resultOptions(const Given& given) {
    std::set<std::string> texts;
    for (const Given::Item& item : given.items) {
        const Option& option = *item.option;
        if (option.names.empty() || option.group == kManyFiles || option.group == kReporting ||
            option.group == kRunning || option.name() == "--output" || option.name() == "--in-place") {
            continue;
        }
        texts.insert(option.name() + (option.value.empty() ? "" : "=" + item.value));
    }
    std::string joined;
    for (const std::string& text : texts) joined += (joined.empty() ? "" : " ") + text;
    return joined;
}

void addReporting(Command& command, bool& json, bool& quiet) {
    const char* group = kReporting;
    command.add(group, flag("--json", json, "Print the result as JSON on stdout (schema: docs/reference/json.md)."));
    command.add(
        group,
        flag("-q, --quiet", quiet,
             "Do not print the text report. --json still prints the JSON, and failures are still reported on stderr."));
    command.add(group, helpOption());
}

Option helpOption() {
    return option(
        "-h, --help", "", [](const std::string&) { return std::string(); }, "Print this help page.");
}

}  // namespace tspace::tool
