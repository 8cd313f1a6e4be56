// SPDX-License-Identifier: MIT
// Temporary files next to their targets, renamed together at the end.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/border.h"
#include "core/base/unique_index.h"
#include "model/io/abandoned_files.h"
#include "model/io/atomic_output.h"
#include "model/io/disk/stepped_writer.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/recorded_files.h"
#include "model/io/system_files.h"
#include "tspace/callbacks.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

// Temporary files of this process, and those left by killed processes.
//
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

namespace {

int writeStream(const Path& path, std::span<const std::uint8_t> bytes) {
    CFile stream = openFile(path, "wb");
    if (!stream) return errno;
    const int failure = writeTo(stream.get(), bytes);
    return std::fclose(stream.release()) == 0 || failure != 0 ? failure : errno;
}

/// Identities of files that outputs must not replace, from all ProtectedFiles.
struct KeptIdentities {
    std::mutex mutex = {};
    std::multiset<std::string> identities = {};
};

KeptIdentities& keptIdentities() {
    static KeptIdentities kept;
    return kept;
}

bool isKept(const std::string& identity) {
    KeptIdentities& kept = keptIdentities();
    const std::lock_guard lock(kept.mutex);
    return kept.identities.contains(identity);
}

/// Uses of a file by the calls of one run.
struct RunFile {
    std::set<std::uint64_t> readers = {};
    std::uint64_t owner = 0;  ///< the call that wrote the file, or left it unchanged
    bool is_written = false;

    [[nodiscard]] bool isReadByOther(std::uint64_t call) const { return readers.size() > readers.count(call); }
};

constexpr const char* kIsInputOfOther = "it is an input of another model in this run; choose another output folder";

struct RunFiles {
    std::mutex mutex = {};
    bool is_run = false;
    std::map<std::string, RunFile> files = {};
};

RunFiles& runFiles() {
    static RunFiles files;
    return files;
}

std::string runName(const Path& path) {
    std::error_code error;
    const fs::path name = fs::weakly_canonical(fs::absolute(fs::path(path), error), error);
    return name.empty() ? path.string() : Path(name).string();
}

/// Calls work(file) if there is a OneRun.
template <class Work>
void inRun(const Path& path, const Work& work) {
    RunFiles& run = runFiles();
    const std::lock_guard lock(run.mutex);
    if (run.is_run) work(run.files[runName(path)]);
}

/// Returns the mutex that is locked from the check whether a file exists until another file is renamed to its name,
/// because a thread that works on another model may write the same file.
std::mutex& renaming() {
    static std::mutex mutex;
    return mutex;
}

bool hasBytes(const Path& path, std::span<const std::uint8_t> bytes) {
    std::error_code error;
    if (kindOf(path) != PathKind::file || fs::file_size(fs::path(path), error) != bytes.size()) return false;
    const Bytes found = readFile(path);
    return std::equal(found.begin(), found.end(), bytes.begin(), bytes.end());
}

}  // namespace

OneRun::OneRun() {
    const std::lock_guard lock(runFiles().mutex);
    runFiles().is_run = true;
}

OneRun::~OneRun() {
    const std::lock_guard lock(runFiles().mutex);
    runFiles().is_run = false;
    runFiles().files.clear();
}

ProtectedFiles::ProtectedFiles(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        if (!path.empty() && path != "-") identities_.push_back(identityOf(path));
    }
    KeptIdentities& kept = keptIdentities();
    const std::lock_guard lock(kept.mutex);
    kept.identities.insert(identities_.begin(), identities_.end());
}

ProtectedFiles::~ProtectedFiles() {
    KeptIdentities& kept = keptIdentities();
    const std::lock_guard lock(kept.mutex);
    for (const std::string& identity : identities_) kept.identities.erase(kept.identities.find(identity));
}

InputFiles::InputFiles() {
    static std::atomic<std::uint64_t> last = 0;
    call_ = ++last;
}

void InputFiles::addTo(std::set<std::string>& identities, const Path& path) {
    if (&identities == &identities_) recordInput(path.string());
    inRun(path, [&](RunFile& file) {
        if (file.is_written && file.owner != call_)
            failFile(ErrorCode::cannotRead, "cannot read " + pathInQuotes(path) +
                                                ": this run has already overwritten it as the output of another model");
        file.readers.insert(call_);
    });
    std::string identity = identityOf(path);
    const std::lock_guard lock(mutex_);
    identities.insert(std::move(identity));
}

void InputFiles::watch(FileOptions& options) {
    using Told = std::function<void(const std::string&)>;
    const auto adder = [this](std::set<std::string>& identities, const Told& told) {
        return [this, told, &identities](const std::string& path) {
            addTo(identities, path);
            if (told) told(path);
        };
    };
    options.named = adder(named_, options.named ? options.named : options.opened);
    options.opened = adder(identities_, options.opened);
}

void InputFiles::allowReplacing(const Path& path) {
    std::string identity = identityOf(path);
    const std::lock_guard lock(mutex_);
    replaceable_.insert(std::move(identity));
}

bool InputFiles::has(const Path& path) const {
    const std::string identity = identityOf(path);
    const std::lock_guard lock(mutex_);
    return identities_.contains(identity) || (named_.contains(identity) && !replaceable_.contains(identity));
}

void AtomicOutput::removeTemporaryFiles() noexcept {
    for (const File& file : files_) {
        if (!file.is_made) continue;
        TemporaryFilesLock work;
        removePath(file.temporary);
        work.forget(file.temporary);
    }
    for (auto folder = created_folders_.rbegin(); folder != created_folders_.rend(); ++folder) {
        TemporaryFilesLock work;
        removePath(*folder);
        work.forget(*folder);
    }
}

AtomicOutput::File AtomicOutput::planFile(const Path& requested) {
    // A symbolic link is preserved: the file that it refers to is replaced.
    std::error_code error;
    if (isForeignLink(requested))
        failToWrite(requested, "it is a symbolic link that another user created in a world-writable folder");
    // A stream keeps its name: /dev/stdout links into /proc, where a pipe has no path.
    const PathKind kind = kindOf(requested);
    const std::uint64_t call = options_.inputs != nullptr ? options_.inputs->call() : 0;
    if (kind == PathKind::stream) return {.target = requested, .is_stream = true, .call = call};
    if (kind == PathKind::folder) failToWrite(requested, "it is a folder");
    if (kind == PathKind::other) failToWrite(requested, "it is neither a file nor a stream");
    const bool is_link = fs::is_symlink(fs::path(requested), error);
    const Path target = is_link ? canonicalPath(requested) : requested;
    if (is_link && (fs::is_symlink(fs::path(target), error) || !fs::exists(fs::path(target), error)))
        failToWrite(requested, "it is a dangling symbolic link");
    if (options_.inputs != nullptr && !options_.replaces_inputs && options_.inputs->has(target))
        failToWrite(requested, "it is an input; choose another output");
    const std::string identity = identityOf(target);
    const HeldOutputs* const held = HeldOutputs::ofThread();
    const bool is_held = held != nullptr && held->all_.identities_.contains(identity);
    if (isKept(identity) || is_held || !identities_.insert(identity).second)
        failToWrite(requested, "another output of this run is the same file; give each output its own name");
    return {.target = target, .temporary = temporaryName(target, kTemporaryEnding), .call = call};
}

void AtomicOutput::makeFolders(const Path& target) {
    std::error_code error;
    std::vector<fs::path> missing;
    for (fs::path folder = folderOf(target); !folder.empty() && !fs::exists(folder, error);
         folder = folder.parent_path())
        missing.push_back(folder);
    created_folders_.reserve(created_folders_.size() + missing.size());
    for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
        Path created = *folder;
        {
            TemporaryFilesLock work;
            work.add(created);
            if (fs::create_directory(*folder, error)) {
                created_folders_.push_back(std::move(created));
            } else {
                work.forget(created);
            }
        }
        if (error) failToWrite(target, "cannot create its folder: " + error.message());
    }
}

void AtomicOutput::addFile(File planned, const std::function<int(const Sink&)>& writeAll) {
    files_.push_back(std::move(planned));
    File& added = files_.back();
    if (added.is_stream) {
        const int failure = writeAll([&](std::span<const std::uint8_t> part) {
            added.held.insert(added.held.end(), part.begin(), part.end());
            return true;
        });
        if (failure != 0) failToWrite(added.target, std::strerror(failure));
        return;
    }
    removeAbandonedOnce(folderOf(added.target));
    makeFolders(added.target);
    CFile file;
    {
        TemporaryFilesLock work;
        work.add(added.temporary);
        file = createFile(added.temporary, added.target);
        added.is_made = file != nullptr;
        const int why = errno;
        if (!added.is_made) work.forget(added.temporary);
        errno = why;
    }
    if (!file) failToWrite(added.target, std::strerror(errno));
    SteppedWriter writer(file.get(), options_.sync);
    const int failure = writeAll([&](std::span<const std::uint8_t> part) {
        errno = writer.write(part);
        return errno == 0;
    });
    if (failure != 0) failToWrite(added.target, std::strerror(failure));
    if (std::fflush(file.get()) != 0) failToWrite(added.target, std::strerror(errno));
    takePermissions(file.get(), added.target);
    if (options_.sync && !syncFile(file.get())) failToWrite(added.target, std::strerror(errno));
    if (std::fclose(file.release()) != 0) failToWrite(added.target, std::strerror(errno));
}

void AtomicOutput::leave(File& file) {
    TemporaryFilesLock work;
    removePath(file.temporary);
    work.forget(file.temporary);
    file.is_made = false;
}

void AtomicOutput::leaveSharedFiles() {
    for (File& file : files_) {
        if (!file.is_made) continue;
        bool is_owned_by_other = false, is_read_by_other = false;
        inRun(file.target, [&](const RunFile& known) {
            is_owned_by_other = known.owner != 0 && known.owner != file.call;
            is_read_by_other = known.isReadByOther(file.call);
        });
        if (kindOf(file.target) == PathKind::nothing || !(file.is_shared || is_owned_by_other || is_read_by_other))
            continue;
        if (!hasBytes(file.target, readFile(file.temporary)))
            failToWrite(file.target,
                        is_read_by_other ? kIsInputOfOther
                        : is_owned_by_other
                            ? "this run has already written a different file with this name"
                            : "another program has created a different file with this name during the run");
        leave(file);
        inRun(file.target, [&](RunFile& known) { known.owner = file.call; });
    }
}

bool AtomicOutput::leave(const Path& target, std::span<const std::uint8_t> bytes) {
    const std::lock_guard lock(renaming());
    if (!hasBytes(target, bytes)) return false;
    if (!options_.is_dry_run && options_.inputs != nullptr)
        inRun(target, [&](RunFile& known) { known.owner = options_.inputs->call(); });
    return true;
}

void AtomicOutput::renameFiles() {
    for (const File& file : files_) {
        const int failure = file.is_stream ? writeStream(file.target, file.held) : 0;
        if (failure != 0) failToWrite(file.target, std::strerror(failure));
    }
    std::unique_lock lock(renaming());
    leaveSharedFiles();
    for (const File& file : files_) {
        if (!file.is_stream) recordOutput(file.target.string());
    }
    // Old files are set aside first, so that a partial failure can be undone. No allocations from here on.
    struct Backup {
        Path name = {};
        bool is_made = false;
    };
    std::vector<Backup> backups(files_.size());
    std::vector<RunFile*> in_run(files_.size());
    std::vector<Path> folders;
    const auto addFolder = [&](Path folder) {
        const auto isIt = [&](const Path& known) { return known.string() == folder.string(); };
        if (options_.sync && std::none_of(folders.begin(), folders.end(), isIt)) folders.push_back(std::move(folder));
    };
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (!files_[i].is_made) continue;
        addFolder(folderOf(files_[i].target));
        inRun(files_[i].target, [&](RunFile& known) { in_run[i] = &known; });
        if (files_.size() > 1 && kindOf(files_[i].target) == PathKind::file)
            backups[i].name = temporaryName(files_[i].target, kBackupEnding);
    }
    for (const Path& folder : created_folders_) addFolder(folderOf(folder));
    // Before the files change, other calls must not begin to read them, nor have begun since they were checked.
    const auto setWritten = [&](bool is_written) {
        for (std::size_t i = 0; i < files_.size(); ++i) {
            if (!files_[i].is_made || in_run[i] == nullptr) continue;
            in_run[i]->owner = is_written ? files_[i].call : 0;
            in_run[i]->is_written = is_written;
        }
    };
    const auto claim = [&] {
        const std::lock_guard run_lock(runFiles().mutex);
        for (std::size_t i = 0; i < files_.size(); ++i) {
            const bool is_read = in_run[i] != nullptr && in_run[i]->isReadByOther(files_[i].call);
            if (files_[i].is_made && is_read && kindOf(files_[i].target) != PathKind::nothing) return false;
        }
        setWritten(true);
        return true;
    };
    if (!claim()) {
        leaveSharedFiles();
        if (!claim()) failToWrite(files_.front().target, kIsInputOfOther);
    }
    int failure = 0;
    std::size_t failed = files_.size();
    {
        TemporaryFilesLock work;
        for (std::size_t i = files_.size(); i-- > 0 && failure == 0;) {
            const File& file = files_[i];
            if (!file.is_made) continue;
            failed = i;
            if (kindOf(file.target) == PathKind::folder) {
                failure = EISDIR;
            } else if (!backups[i].name.empty()) {
                // Falls back to renaming on file systems without hard links.
                failure = linkFile(file.target, backups[i].name);
                if (failure != 0) failure = renameFile(file.target, backups[i].name);
                backups[i].is_made = failure == 0;
            }
            if (failure == 0) failure = renameFile(file.temporary, file.target);
        }
        for (std::size_t i = failed; failure != 0 && i < files_.size(); ++i) {
            if (backups[i].is_made) {
                renameFile(backups[i].name, files_[i].target);
                // If both names still refer to one file, renaming has no effect.
                removePath(backups[i].name);
            } else if (i != failed && files_[i].is_made) {
                removePath(files_[i].target);
            }
        }
        for (std::size_t i = 0; failure == 0 && i < files_.size(); ++i) {
            if (backups[i].is_made) removePath(backups[i].name);
            work.forget(files_[i].temporary);
            files_[i].is_made = false;
        }
        if (failure == 0) {
            for (const Path& folder : created_folders_) work.forget(folder);
            work.noteCommit();
        }
    }
    if (failure != 0) {
        const std::lock_guard run_lock(runFiles().mutex);
        setWritten(false);
        failToWrite(files_[failed].target, std::strerror(failure));
    }
    committed_ = true;
    lock.unlock();
    for (const Path& folder : folders) syncFolder(folder);
}

}  // namespace tspace
