// SPDX-License-Identifier: MIT
// Names and list of the temporary files of this process, and removal of those that killed processes left.
#include "model/io/temporary_files.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/border.h"
#include "core/base/unique_index.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

// A signal handler may neither lock a mutex nor allocate. It waits until no thread works on the list of temporary
// files. Threads block signals during such work, so the handler never interrupts this work on its own thread.
//
// A process ID is meaningful only on one machine, since its last boot, among processes of one PID namespace. The names
// of temporary files therefore contain all three.

namespace fs = std::filesystem;

namespace {

std::mutex work_mutex;
std::atomic<bool> is_busy = false, is_ending = false, has_committed = false;

/// Paths of the temporary files; null until the first one. Never deleted, because a signal may arrive while the program
/// ends.
std::vector<Path>* temporary_files = nullptr;

}  // namespace

TemporaryFilesLock::TemporaryFilesLock() {
    work_mutex.lock();
    for (is_busy = true; is_ending; is_busy = true) {
        is_busy = false;
        while (is_ending) waitBriefly();
    }
}

TemporaryFilesLock::~TemporaryFilesLock() {
    is_busy = false;
    work_mutex.unlock();
}

void TemporaryFilesLock::add(const Path& path) {
    if (temporary_files == nullptr) temporary_files = new std::vector<Path>;
    temporary_files->push_back(path);
}

void TemporaryFilesLock::forget(const Path& path) noexcept {
    if (temporary_files == nullptr) return;
    const auto found = std::find_if(temporary_files->begin(), temporary_files->end(),
                                    [&](const Path& known) { return known.string() == path.string(); });
    if (found == temporary_files->end()) return;
    // The order is preserved: a folder precedes its contents.
    temporary_files->erase(found);
}

void TemporaryFilesLock::noteCommit() noexcept { has_committed = true; }

bool removeTemporaryFiles(bool even_after_commit) {
    is_ending = true;
    // This is long enough to rename a few files; if it takes longer, the disk hangs.
    constexpr int kPatience_ms = 5000;
    for (int waited = 0; is_busy; ++waited) {
        if (waited == kPatience_ms) return true;
        waitBriefly();
    }
    if (has_committed && !even_after_commit) {
        is_ending = false;
        return false;
    }
    if (temporary_files == nullptr) return true;
    // removePath() removes only empty folders.
    for (auto path = temporary_files->rbegin(); path != temporary_files->rend(); ++path) removePath(*path);
    return true;
}

namespace {

std::string sixteenDigits(std::uint64_t number) {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[number >> shift & 15];
    return digits;
}

/// Returns the hash of processSpace() as 16 hexadecimal digits.
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

/// Target and kind of a temporary file that a process left behind, according to its name.
struct Abandoned {
    std::string target_name;
    bool is_backup;  ///< false: a temporary file
};

std::optional<Abandoned> abandoned(std::string_view name) {
    const std::size_t at = name.rfind(machineMark());
    if (at == std::string_view::npos || at == 0) return {};
    const bool is_backup = name.ends_with(kBackupEnding);
    if (!is_backup && !name.ends_with(kTemporaryEnding)) return {};
    Abandoned found{std::string(name.substr(0, at)), is_backup};
    name.remove_suffix(std::string_view(kTemporaryEnding).size());
    name.remove_prefix(std::min(name.size(), at + machineMark().size()));
    const std::size_t dash = name.find('-');
    constexpr std::size_t kMaxDigits = 10;
    const auto hasOnly = [](std::string_view text, const char* digits, std::size_t most) {
        return !text.empty() && text.size() <= most && text.find_first_not_of(digits) == std::string_view::npos;
    };
    if (dash == std::string_view::npos || !hasOnly(name.substr(0, dash), "0123456789", kMaxDigits) ||
        !hasOnly(name.substr(dash + 1), "0123456789abcdef", 16))
        return {};
    const std::uint64_t process = std::strtoull(std::string(name.substr(0, dash)).c_str(), nullptr, 10);
    if (process > UINT32_MAX || isRunning(static_cast<std::uint32_t>(process))) return {};
    return found;
}

bool removeAbandoned(const Path& folder, const FolderEntry& entry) {
    // Links are skipped, because abandoned files are always regular files.
    if (entry.kind != PathKind::file || entry.is_link) return false;
    const std::optional<Abandoned> found = abandoned(entry.name);
    if (!found) return false;
    const Path path = folder / entry.name, target = folder / found->target_name;
    // The run was killed between two renames, so the old file is restored.
    if (found->is_backup && kindOf(target) == PathKind::nothing) return renameFile(path, target) == 0;
    return removePath(path) == 0;
}

}  // namespace

Path temporaryName(const Path& target, const char* ending) {
    constexpr std::size_t kMaxBytes = 255;
    const std::string tail =
        machineMark() + std::to_string(processNumber()) + "-" + sixteenDigits(randomNumber()) + ending;
    std::string name = Path(fs::path(target).filename()).string();
    if (name.size() + tail.size() > kMaxBytes) {
        std::size_t length = kMaxBytes - tail.size();
        // Cuts at the start of a UTF-8 character (continuation bytes are 10xxxxxx).
        while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xc0u) == 0x80u) --length;
        name.resize(length);
    }
    const Path folder = fs::path(target).parent_path();
    return folder.empty() ? Path(name + tail) : folder / (name + tail);
}

namespace {

void removeAbandonedFiles(const std::string& top, bool with_folders_below, std::uint64_t& count) {
    std::vector<Path> folders = {top};
    while (!folders.empty()) {
        const Path folder = std::move(folders.back());
        folders.pop_back();
        std::vector<FolderEntry> entries;
        // Folders that cannot be read are skipped.
        listFolder(folder, entries);
        for (const FolderEntry& entry : entries) {
            count += removeAbandoned(folder, entry);
            if (with_folders_below && entry.kind == PathKind::folder && !entry.is_link)
                folders.push_back(folder / entry.name);
        }
    }
}

}  // namespace

std::uint64_t removeAbandonedFiles(const std::string& folder, bool with_folders_below) {
    std::uint64_t count = 0;
    // If memory runs out, the abandoned files stay until the next call.
    static_cast<void>(atBorder([&]() -> Result<Done> {
        removeAbandonedFiles(folder, with_folders_below, count);
        return Done{};
    }));
    return count;
}

void removeAbandonedOnce(const Path& folder) {
    static std::mutex mutex;
    static std::set<std::string> known;
    {
        const std::lock_guard lock(mutex);
        if (!known.insert(folder.string()).second) return;
    }
    removeAbandonedFiles(folder.string(), false);
}

}  // namespace tspace
