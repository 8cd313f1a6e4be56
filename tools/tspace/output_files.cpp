// SPDX-License-Identifier: MIT
// Checks of outputs before a run, and writing of reports after it.
#include "output_files.h"

#include <map>
#include <new>
#include <optional>
#include <set>

#include "depfile.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "model/io/temporary_files.h"

namespace tspace::tool {

Result<Done> prepareOutputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                            bool is_dry_run) {
    const auto isFile = [](const std::string& path) {
        return !path.empty() && path != "-" && kindOf(path) != PathKind::stream;
    };
    std::map<std::string, std::string> names;  // description of each file for messages; key: identity of the file
    for (const std::string& input : inputs) {
        if (isFile(input)) names.emplace(identityOf(input), "an input");
    }
    std::vector<std::string> all = outputs;
    if (const Depfile* depfile = Depfile::ofRun()) all.push_back(depfile->path());
    std::set<std::string> folders;
    for (const std::string& output : all) {
        if (!isFile(output)) continue;
        const auto [other, is_new] = names.emplace(identityOf(output), "the same file as the output " + output);
        if (!is_new) return Error{ErrorCode::invalidOption, "the output " + output + " is " + other->second};
        folders.insert(folderOf(output).string());
    }
    if (is_dry_run) return Done{};
    for (const std::string& folder : folders) removeAbandonedOnce(folder);
    return Done{};
}

Result<Done> writeTextFile(const std::string& path, const std::string& text, const InputFiles* inputs) {
    Result<Done> written = atFileBorder([&]() -> Result<Done> {
        // A report that cannot be written must not discard other outputs. For a stream, only writing to it shows
        // whether it can be written.
        std::optional<HeldOutputs> at_once;
        if (kindOf(path) == PathKind::stream) at_once.emplace();
        AtomicOutput output({.inputs = inputs});
        output.add(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
        output.commit();
        return at_once ? at_once->commit() : Done{};
    });
    if (!written && written.error().code == ErrorCode::outOfMemory) throw std::bad_alloc();
    return written;
}

}  // namespace tspace::tool
