// SPDX-License-Identifier: MIT
// Reads whole files, and queries the file system.
#include "model/io/file_io.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>
#include <system_error>

#include "core/base/parallel.h"
#include "model/io/file_error.h"
#include "model/io/folder_rule.h"
#include "model/io/system_files.h"
#include "model/io/uri.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

/// Reads one huge page per step: the first access makes the kernel clear the page, so it is still in the cache when the
/// data are copied to it.
bool readSteps(std::FILE* file, std::span<std::uint8_t> to, const Execution& execution) {
    const std::size_t steps = (to.size() + kHugePage - 1) / kHugePage;
    std::atomic<bool> good = true;
    Parallel parallel(to.size() < kLargeBytes ? Execution{.thread_count = 1} : execution);
    parallel.forTasks(steps, [&](std::size_t step) {
        const std::size_t begin = step * kHugePage;
        const auto part = to.subspan(begin, std::min(kHugePage, to.size() - begin));
        if (to.size() >= kLargeBytes) populatePages(part.data(), part.size());
        if (!readAt(file, begin, part)) good = false;
    });
    return good;
}

}  // namespace

Bytes readFile(const Path& name, const std::string& place, const Execution& execution) {
    const fs::path path = name;
    // For a file named by the user the error is cannotRead; a missing file that a model references makes the model
    // invalid.
    const ErrorCode code = place.empty() ? ErrorCode::cannotRead : ErrorCode::invalidFile;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    const auto fail_open = [&](const std::string& why) {
        failFile(code, "cannot open the file " + pathInQuotes(name) + ": " + why, place);
    };
    if (status.type() == fs::file_type::not_found)
        failFile(code, "the file " + pathInQuotes(name) + " does not exist", place);
    if (error) fail_open(error.message());
    if (fs::is_directory(status)) failFile(code, pathInQuotes(name) + " is a folder", place);
    // Reading pipes and devices could block or never end.
    if (!fs::is_regular_file(status)) failFile(code, pathInQuotes(name) + " is not a regular file", place);
    const std::uintmax_t size = fs::file_size(path, error);
    const CFile file = error ? nullptr : openFile(name, "rb");
    if (!file) fail_open(error ? error.message() : std::strerror(errno));
    Bytes bytes(static_cast<std::size_t>(size));
    if (!readSteps(file.get(), bytes, execution))
        failFile(code, "cannot read the whole file " + pathInQuotes(name), place);
    return bytes;
}

bool isThere(const Path& path) {
    std::error_code error;
    return fs::exists(fs::path(path), error);
}

bool isFolder(const Path& path) {
    std::error_code error;
    return fs::is_directory(fs::path(path), error);
}

bool isOneFile(const Path& a, const Path& b) {
    std::error_code error;
    return fs::equivalent(fs::path(a), fs::path(b), error) && !error;
}

std::string identityOf(const Path& path) {
    std::string identity = fileIdentity(path);
    if (!identity.empty()) return identity;
    try {
        return canonicalPath(path).string();
    } catch (const fs::filesystem_error&) {
        return Path(fs::absolute(fs::path(path)).lexically_normal()).string();
    }
}

bool isSameFile(const Path& a, const Path& b) { return identityOf(a) == identityOf(b); }

Path resolveUri(const Path& in_folder, std::string_view uri, bool allow_external, const std::string& place) {
    const fs::path folder = in_folder, relative{Path(checkedPathOfUri(uri, allow_external, place))};
    const fs::path root = canonicalPath(in_folder);
    fs::path file;
    try {
        file = canonicalPath(root / relative);
    } catch (const fs::filesystem_error& failure) {
        // The name is too long, or its links are circular.
        failFile(ErrorCode::invalidFile,
                 "the URI " + inQuotes(uri, 200) + " cannot name a file: " + failure.code().message(), place);
    }
    if (!allow_external && !isBelow(root, file))
        refuseUri(uri, std::string("leads outside the folder of the model through a symbolic link") + kFollowed, place);
    return folder / relative;
}

std::uint64_t fileSize(const Path& path) {
    std::error_code no_file;
    const std::uintmax_t size = fs::file_size(fs::path(path), no_file);
    return no_file ? 0 : size;
}

bool isGlbOutput(const Path& path) {
    return isGlbName(path) || (kindOf(path) == PathKind::stream && lowerExtension(path) != ".gltf");
}

std::string pathBelow(const Path& folder, const Path& file) {
    const fs::path root = canonicalPath(folder);
    const fs::path relative = fs::path(canonicalPath(file)).lexically_relative(root);
    return relative.empty() || *relative.begin() == ".." ? "" : Path(relative).string();
}

}  // namespace tspace
