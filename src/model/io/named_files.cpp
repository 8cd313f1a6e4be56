// SPDX-License-Identifier: MIT
// Reads referenced files from the disk, or through the callback of the caller.
#include "model/io/named_files.h"

#include <filesystem>
#include <optional>

#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/system_files.h"
#include "model/io/uri.h"

namespace tspace {

namespace fs = std::filesystem;

NamedFiles::NamedFiles(const Path& model, const FileOptions& options)
    : find_file_(options.find_file), opened_(options.opened), named_(options.named ? options.named : options.opened),
      is_in_memory_(options.content.data() != nullptr), allow_external_(options.allow_external) {
    if (is_in_memory_) return;
    folder_ = folderOf(model);
    if (opened_) opened_(model.string());
}

Path NamedFiles::resolve(const Path& folder, std::string_view uri, const std::string& place) const {
    if (!is_in_memory_) return resolveUri(folder, uri, allow_external_, place);
    const std::string path = checkedPathOfUri(uri, allow_external_, place);
    if (!find_file_) {
        failFile(ErrorCode::invalidFile,
                 "the file " + inQuotes(path, 200) +
                     " that the model references cannot be found, because the model was not read from a file",
                 place);
    }
    return fs::path(folder / path).lexically_normal();
}

Result<std::span<const std::uint8_t>> NamedFiles::find(const Path& file) const {
    Result<std::span<const std::uint8_t>> found = find_file_(file.string());
    if (found || found.error().code == ErrorCode::cannotRead) return found;
    throw CallerError{std::move(found).error()};
}

NamedFiles::Kind NamedFiles::kindOf(const Path& file) const {
    if (is_in_memory_) return find(file) ? Kind::file : Kind::missing;
    switch (tspace::kindOf(file)) {
        case PathKind::nothing: return Kind::missing;
        case PathKind::file: return Kind::file;
        case PathKind::folder: return Kind::folder;
        default: return Kind::other;
    }
}

std::string NamedFiles::whyNotRead(std::string_view uri, const std::string& place) const {
    Kind kind = Kind::file;
    const std::optional<Error> failure = tryFile([&] { kind = kindOf(resolve(uri, place)); });
    if (failure) return failure->message;
    switch (kind) {
        case Kind::file: return "";
        case Kind::folder: return "it is a folder";
        case Kind::other: return "it is not a regular file";  // reading a pipe or device could block or never end
        default: return "it does not exist";
    }
}

void NamedFiles::note(const Path& file) const {
    if (named_ && !is_in_memory_ && kindOf(file) == Kind::file) named_(file.string());
}

Bytes NamedFiles::read(const Path& file, const std::string& place) const {
    if (!is_in_memory_) {
        if (opened_) opened_(file.string());
        return readFile(file, place);
    }
    const Result<std::span<const std::uint8_t>> found = find(file);
    if (!found)
        failFile(ErrorCode::invalidFile, "the file " + pathInQuotes(file) + " was not provided with the model", place);
    return Bytes(found->begin(), found->end());
}

}  // namespace tspace
