// SPDX-License-Identifier: MIT
// Reading whole files, and questions about what is on the disk.
#include "asset/file_io.h"

#include <unistd.h>
#include <filesystem>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>

#include "asset/c_file.h"
#include "asset/file_error.h"
#include "core/parallel.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

/// Reads bytes from `begin` on. Returns false when the file has fewer.
bool readAt(int file, std::size_t begin, std::span<std::uint8_t> to) {
    while (!to.empty()) {
        const ::ssize_t count = ::pread(file, to.data(), to.size(), static_cast<::off_t>(begin));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        begin += static_cast<std::size_t>(count);
        to = to.subspan(static_cast<std::size_t>(count));
    }
    return true;
}

/// A step at a time, so that memory is read into while it is in the cache from being cleared.
bool readSteps(int file, std::span<std::uint8_t> to, const Execution& execution) {
    const std::size_t steps = (to.size() + kHugePage - 1) / kHugePage;
    std::atomic<bool> good = true;
    Parallel parallel(to.size() < kLargeBytes ? Execution{.thread_count = 1} : execution);
    parallel.forTasks(steps, [&](std::size_t step) {
        const std::size_t begin = step * kHugePage;
        const auto part = to.subspan(begin, std::min(kHugePage, to.size() - begin));
        if (to.size() >= kLargeBytes) askForPages(part.data(), part.size());
        if (!readAt(file, begin, part)) good = false;
    });
    return good;
}

}  // namespace

Bytes readFile(const Path& path, const std::string& place, const Execution& execution) {
    // What the user named cannot be read; what a model names makes the model incomplete.
    const ErrorCode code = place.empty() ? ErrorCode::cannotRead : ErrorCode::invalidFile;
    std::error_code error;
    const fs::file_status status = fs::status(path.string(), error);
    const auto fail_open = [&](const std::string& why) {
        failFile(code, "cannot open the file " + pathInQuotes(path) + ": " + why, place);
    };
    if (status.type() == fs::file_type::not_found)
        failFile(code, "the file " + pathInQuotes(path) + " does not exist", place);
    if (error) fail_open(error.message());
    if (fs::is_directory(status)) failFile(code, pathInQuotes(path) + " is a folder", place);
    // Pipes and devices could block or never end.
    if (!fs::is_regular_file(status)) {
        failFile(code, pathInQuotes(path) + " is not a regular file", place);
    }
    const std::uintmax_t size = fs::file_size(path.string(), error);
    const CFile file(error ? nullptr : std::fopen(path.string().c_str(), "rb"));
    if (!file) fail_open(error ? error.message() : std::strerror(errno));
    Bytes bytes(static_cast<std::size_t>(size));
    if (!readSteps(::fileno(file.get()), bytes, execution)) {
        failFile(code, "cannot read all of the file " + pathInQuotes(path), place);
    }
    return bytes;
}

bool isThere(const Path& path) {
    std::error_code error;
    return fs::exists(path.string(), error);
}

bool isFolder(const Path& path) {
    std::error_code error;
    return fs::is_directory(path.string(), error);
}

bool isSameFile(const Path& path_a, const Path& path_b) {
    const fs::path a = path_a, b = path_b;
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return true;
    if (fs::exists(a, error) || fs::exists(b, error)) return false;
    return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

}  // namespace tspace
