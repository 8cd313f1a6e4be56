// SPDX-License-Identifier: MIT
// Temporary files of this process, and those that killed processes left.
//
// A signal handler may neither lock a mutex nor allocate. It waits until no thread works on the list; threads block signals
// while they do, so the handler never interrupts such work on its own thread.
//
// A process id is meaningful only on one machine, since its last boot, among processes that see each other. The names of
// temporary files therefore hold all of that.
#include "model/io/temporary_files.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/border.h"
#include "core/base/unique_index.h"
#include "model/io/system_files.h"
#include "tspace/asset.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

std::mutex mutex;
std::atomic<bool> is_in_work = false, is_ending = false;

/// Never deleted: a signal may arrive while the program ends. Null until the first file.
std::vector<Path>* files = nullptr;

}  // namespace

TemporaryFilesInWork::TemporaryFilesInWork() {
    mutex.lock();
    is_in_work = true;
    if (!is_ending) return;
    is_in_work = false;
    while (true) waitBriefly();
}

TemporaryFilesInWork::~TemporaryFilesInWork() {
    is_in_work = false;
    mutex.unlock();
}

void TemporaryFilesInWork::add(const Path& path) {
    if (files == nullptr) files = new std::vector<Path>;
    files->push_back(path);
}

void TemporaryFilesInWork::forget(const Path& path) noexcept {
    if (files == nullptr) return;
    const auto found =
        std::find_if(files->begin(), files->end(), [&](const Path& known) { return known.string() == path.string(); });
    if (found == files->end()) return;
    std::swap(*found, files->back());
    files->pop_back();
}

void removeTemporaryFiles() {
    is_ending = true;
    // Long enough to rename some files; the disk hangs if it takes longer.
    constexpr int kPatience_ms = 5000;
    for (int waited = 0; is_in_work; ++waited) {
        if (waited == kPatience_ms) return;
        waitBriefly();
    }
    if (files == nullptr) return;
    for (const Path& path : *files) removePath(path);
}

namespace {

std::string sixteenDigits(std::uint64_t number) {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[number >> shift & 15];
    return digits;
}

/// A hash of the space of process ids.
std::string machineTag() {
    const std::string text = processSpace();
    std::uint64_t hash = text.size();
    for (const char c : text) hash = foldHash(hash, static_cast<unsigned char>(c));
    return sixteenDigits(hash);
}

const std::string& machineMark() {
    static const std::string mark = ".tspace-" + machineTag() + "-";
    return mark;
}

/// The arguments of besideName() in a process that no longer runs.
struct Abandoned {
    std::string target_name;
    bool is_aside;  ///< else a temporary file
};

std::optional<Abandoned> abandoned(std::string_view name) {
    const std::size_t at = name.rfind(machineMark());
    if (at == std::string_view::npos || at == 0) return {};
    const bool is_aside = name.ends_with(kAsideEnding);
    if (!is_aside && !name.ends_with(kTemporaryEnding)) return {};
    Abandoned found{std::string(name.substr(0, at)), is_aside};
    name.remove_suffix(std::string_view(kTemporaryEnding).size());
    name.remove_prefix(std::min(name.size(), at + machineMark().size()));
    const std::size_t dash = name.find('-');
    constexpr std::size_t kMostDigits = 10;
    const auto hasOnly = [](std::string_view text, const char* digits, std::size_t most) {
        return !text.empty() && text.size() <= most && text.find_first_not_of(digits) == std::string_view::npos;
    };
    if (dash == std::string_view::npos || !hasOnly(name.substr(0, dash), "0123456789", kMostDigits) ||
        !hasOnly(name.substr(dash + 1), "0123456789abcdef", 16))
        return {};
    const std::uint64_t process = std::strtoull(std::string(name.substr(0, dash)).c_str(), nullptr, 10);
    if (process > UINT32_MAX || isRunning(static_cast<std::uint32_t>(process))) return {};
    return found;
}

bool removeAbandoned(const fs::directory_entry& entry) {
    std::error_code ignored;
    // Links are left alone: abandoned files are regular ones.
    if (entry.symlink_status(ignored).type() != fs::file_type::regular) return false;
    const std::optional<Abandoned> found = abandoned(Path(entry.path().filename()).string());
    if (!found) return false;
    const Path path = entry.path();
    const Path target = folderOf(path) / found->target_name;
    // The run was killed between two renames: the old file is restored.
    if (found->is_aside && kindOf(target) == PathKind::nothing) return renameFile(path, target) == 0;
    return removePath(path) == 0;
}

}  // namespace

Path besideName(const Path& target, const char* ending) {
    constexpr std::size_t kMostBytes = 255;
    const std::string tail =
        machineMark() + std::to_string(processNumber()) + "-" + sixteenDigits(randomNumber()) + ending;
    std::string name = Path(fs::path(target).filename()).string();
    if (name.size() + tail.size() > kMostBytes) {
        std::size_t length = kMostBytes - tail.size();
        // Cuts before a whole UTF-8 character (bytes 10xxxxxx continue one).
        while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0u) == 0x80u) --length;
        name.resize(length);
    }
    const Path folder = fs::path(target).parent_path();
    return folder.empty() ? Path(name + tail) : folder / (name + tail);
}

namespace {

void removeAbandonedFiles(const std::string& folder, bool with_folders_below, std::uint64_t& count) {
    std::error_code error;
    const auto options = fs::directory_options::skip_permission_denied;
    const fs::path root = Path(folder);
    if (with_folders_below) {
        for (fs::recursive_directory_iterator entry(root, options, error), end; !error && entry != end;
             entry.increment(error))
            count += removeAbandoned(*entry);
    } else {
        for (fs::directory_iterator entry(root, options, error), end; !error && entry != end; entry.increment(error))
            count += removeAbandoned(*entry);
    }
}

}  // namespace

std::uint64_t removeAbandonedFiles(const std::string& folder, bool with_folders_below) {
    std::uint64_t count = 0;
    // Files stay until the next call where memory does not suffice.
    static_cast<void>(atBorder([&]() -> Result<Done> {
        removeAbandonedFiles(folder, with_folders_below, count);
        return Done{};
    }));
    return count;
}

}  // namespace tspace
