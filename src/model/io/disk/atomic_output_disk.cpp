// SPDX-License-Identifier: MIT
// Temporary files next to their targets, renamed together at the end.
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "model/io/atomic_output.h"
#include "model/io/disk/stepped_writer.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/recorded_files.h"
#include "model/io/system_files.h"
#include "model/io/temporary_files.h"
#include "tspace/callbacks.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

namespace fs = std::filesystem;

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

/// Renames the files of an AtomicOutput. Old files are set aside first, so that a partial failure can be undone. The
/// constructor allocates everything, so that no allocation can fail after a file has changed.
struct AtomicOutput::Renaming {
    struct Backup {
        Path name = {};
        bool is_made = false;
    };

    std::vector<File>& files;
    std::vector<Backup> backups;     ///< one per file; without a name if no old file is set aside
    std::vector<RunFile*> in_run;    ///< one per file: its uses by all calls of the run; null without a run
    std::vector<Path> folders = {};  ///< folders to flush to the disk

    explicit Renaming(AtomicOutput& output) : files(output.files_), backups(files.size()), in_run(files.size()) {
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (!files[i].is_made) continue;
            if (output.options_.sync) addFolder(folderOf(files[i].target));
            inRun(files[i].target, [&](RunFile& known) { in_run[i] = &known; });
            if (files.size() > 1 && kindOf(files[i].target) == PathKind::file)
                backups[i].name = temporaryName(files[i].target, kBackupEnding);
        }
        for (const Path& folder : output.created_folders_) {
            if (output.options_.sync) addFolder(folderOf(folder));
        }
    }

    void addFolder(Path folder) {
        const auto isIt = [&](const Path& known) { return known.string() == folder.string(); };
        if (std::none_of(folders.begin(), folders.end(), isIt)) folders.push_back(std::move(folder));
    }

    /// Records in the run that its calls must not read the targets any more, or that they may. The caller holds the
    /// mutex of the run.
    void setWritten(bool is_written) {
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (!files[i].is_made || in_run[i] == nullptr) continue;
            in_run[i]->owner = is_written ? files[i].call : 0;
            in_run[i]->is_written = is_written;
        }
    }

    /// Calls setWritten(true) and returns true, unless another call of the run has begun to read a target.
    bool claim() {
        const std::lock_guard run_lock(runFiles().mutex);
        for (std::size_t i = 0; i < files.size(); ++i) {
            const bool is_read = in_run[i] != nullptr && in_run[i]->isReadByOther(files[i].call);
            if (files[i].is_made && is_read && kindOf(files[i].target) != PathKind::nothing) return false;
        }
        setWritten(true);
        return true;
    }

    /// Sets the old file aside, if that was planned, and renames the new one. Returns 0 or errno.
    int replace(std::size_t i) {
        const File& file = files[i];
        if (kindOf(file.target) == PathKind::folder) return EISDIR;
        if (!backups[i].name.empty()) {
            // Falls back to renaming on file systems without hard links.
            int failure = linkFile(file.target, backups[i].name);
            if (failure != 0) failure = renameFile(file.target, backups[i].name);
            if (failure != 0) return failure;
            backups[i].is_made = true;
        }
        return renameFile(file.temporary, file.target);
    }

    /// Restores the old files, after replace(failed) has failed.
    void undo(std::size_t failed) {
        for (std::size_t i = failed; i < files.size(); ++i) {
            if (backups[i].is_made) {
                renameFile(backups[i].name, files[i].target);
                // If both names still refer to one file, renaming has no effect.
                removePath(backups[i].name);
            } else if (i != failed && files[i].is_made) {
                removePath(files[i].target);
            }
        }
    }

    /// Replaces all targets, the first file last. Returns 0, or errno after undoing all, and the file in `failed`.
    int run(const std::vector<Path>& created_folders, std::size_t& failed) {
        TemporaryFilesLock work;
        for (failed = files.size(); failed-- > 0;) {
            const int failure = files[failed].is_made ? replace(failed) : 0;
            if (failure == 0) continue;
            undo(failed);
            return failure;
        }
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (backups[i].is_made) removePath(backups[i].name);
            work.forget(files[i].temporary);
            files[i].is_made = false;
        }
        for (const Path& folder : created_folders) work.forget(folder);
        work.noteCommit();
        return 0;
    }
};

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
    Renaming renames(*this);
    // Before the files change, other calls must not begin to read them, nor have begun since they were checked.
    if (!renames.claim()) {
        leaveSharedFiles();
        if (!renames.claim()) failToWrite(files_.front().target, kIsInputOfOther);
    }
    std::size_t failed = 0;
    const int failure = renames.run(created_folders_, failed);
    if (failure != 0) {
        const std::lock_guard run_lock(runFiles().mutex);
        renames.setWritten(false);
        failToWrite(files_[failed].target, std::strerror(failure));
    }
    committed_ = true;
    lock.unlock();
    for (const Path& folder : renames.folders) syncFolder(folder);
}

}  // namespace tspace
