// SPDX-License-Identifier: MIT
// Several output files that appear together or not at all: each is written beside its target under a
// temporary name, and all are renamed at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/numbers.h"
#include "model/io/file_io.h"
#include "model/io/path.h"
#include "model/io/system_files.h"
#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

// Parts of an output file: existing bytes, or bytes that are made when they are written.

class ByteMaker {
  public:
    virtual ~ByteMaker() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Fills `to` with the bytes from `begin` on. Must be thread-safe and deterministic.
    virtual void make(std::size_t begin, std::span<std::uint8_t> to) const = 0;
    /// All bytes, where they exist already; valid as long as this object. Else empty.
    [[nodiscard]] virtual std::span<const std::uint8_t> there() const { return {}; }
};

/// Owns a vector and serves its bytes without a copy. T: numbers of four bytes without padding.
template <class T>
class KeptBytes final : public ByteMaker {
  public:
    explicit KeptBytes(std::vector<T>&& values) : values_(std::move(values)) {
        turnLittleEndian({reinterpret_cast<std::uint8_t*>(values_.data()), size()}, 4);
    }

    [[nodiscard]] std::size_t size() const override { return values_.size() * sizeof(T); }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override {
        if (!to.empty()) std::memcpy(to.data(), there().data() + begin, to.size());
    }
    [[nodiscard]] std::span<const std::uint8_t> there() const override {
        return {reinterpret_cast<const std::uint8_t*>(values_.data()), size()};
    }

  private:
    std::vector<T> values_;
};

struct OutputPiece {
    OutputPiece(std::span<const std::uint8_t> there) : bytes(there) {}
    OutputPiece(const Bytes& there) : bytes(there) {}
    OutputPiece(std::shared_ptr<const ByteMaker> made) : bytes(made->there()), maker(std::move(made)) {}

    [[nodiscard]] bool isThere() const { return !maker || !bytes.empty(); }

    [[nodiscard]] std::size_t size() const { return maker ? maker->size() : bytes.size(); }

    std::span<const std::uint8_t> bytes = {};
    std::shared_ptr<const ByteMaker> maker = {};  ///< owner or maker of the bytes
};

// Temporary files: their names, which tell whose they are, and the list of those of this process, which a signal handler
// removes, together with the folders that were created for them.

inline constexpr const char* kTemporaryEnding = ".tmp";
/// The old file while new ones are renamed.
inline constexpr const char* kAsideEnding = ".old";

/// An unpredictable name beside `target`: TARGET.tspace-MACHINE-PROCESS-RANDOM and the ending. Long names of targets are
/// cut, so that it has at most 255 bytes.
Path besideName(const Path& target, const char* ending);

/// A critical section in which temporary files are created, removed or renamed; signals are blocked, and one thread at a
/// time is inside. The constructor does not return once removeTemporaryFiles() has removed the files.
class TemporaryFilesInWork {
  public:
    TemporaryFilesInWork();
    ~TemporaryFilesInWork();
    TemporaryFilesInWork(const TemporaryFilesInWork&) = delete;
    TemporaryFilesInWork& operator=(const TemporaryFilesInWork&) = delete;

    /// Call before the file or folder is created.
    void add(const Path& path);
    /// Call when the file or folder is removed, renamed, or kept for good.
    void forget(const Path& path) noexcept;
    /// Call when outputs have been put in place.
    void noteCommit() noexcept;

  private:
    HeldSignals signals_;
};

/// Removes all temporary files, and stops threads that would make others: the caller ends the program. Where outputs of this
/// process are in place and `even_after_commit` is false, it removes nothing and returns false. Async-signal-safe.
bool removeTemporaryFiles(bool even_after_commit);

/// The input files of one call, which its outputs must not replace: those that it reads, and images that its models name.
class InputFiles {
  public:
    InputFiles();
    /// Fails with cannotRead (FileError) where another call of the same OneRun wrote this file.
    void add(const Path& path) { addTo(identities_, path); }
    /// Makes `options` report every file that is opened, and apart from them every image that is named, to this and then to the
    /// callbacks that they had. Must outlive `options`.
    void watch(FileOptions& options);
    /// From now on an output may replace this file where a model names it as an image and nothing reads it.
    void letOff(const Path& path);
    /// Whether `path` is one of the inputs, under any name (links, relative paths).
    [[nodiscard]] bool has(const Path& path) const;
    /// Unique in this process.
    [[nodiscard]] std::uint64_t call() const { return call_; }

  private:
    void addTo(std::set<std::string>& identities, const Path& path);

    std::uint64_t call_;
    mutable std::mutex mutex_ = {};
    std::set<std::string> identities_ = {}, named_ = {}, let_off_ = {};
};

/// While it lives, no output of this process replaces these files (reports and manifests, which are written in other
/// ways or later; the names of derived outputs are known only when they are written). Empty paths and "-" are skipped.
class KeptFiles {
  public:
    explicit KeptFiles(const std::vector<std::string>& paths);
    ~KeptFiles();
    KeptFiles(const KeptFiles&) = delete;
    KeptFiles& operator=(const KeptFiles&) = delete;

  private:
    std::vector<std::string> identities_ = {};
};

/// While it lives, all calls belong to one run over several models, perhaps in parallel: no call changes a file that
/// another call read, wrote, or left because it already had the right bytes. At most one may exist.
class OneRun {
  public:
    OneRun();
    ~OneRun();
    OneRun(const OneRun&) = delete;
    OneRun& operator=(const OneRun&) = delete;
};

/// How outputs are written.
struct OutputWay {
    /// If set, receives the single output file instead of the disk.
    Sink sink = {};
    bool is_dry_run = false;  ///< writes nothing
    /// Flushes files from the disk's cache before they are renamed. Costs some milliseconds per file.
    bool sync = true;
    const InputFiles* inputs = nullptr;  ///< inputs of the call, which outputs must not replace; null: none
    bool replaces_inputs = false;        ///< outputs may replace inputs: the model is changed in place
};

/// Collects files, then commit() puts them in place. Without commit() the destructor removes every temporary
/// file. All functions fail with cannotWrite by throwing FileError.
///
/// Links are followed, except where isForeignLink(). A character device or FIFO is written into by commit(); any other
/// target that is not a regular file is refused. A replaced file passes its owner, group and permissions on, and the
/// temporary file never has more permissions than it.
class AtomicOutput {
  public:
    explicit AtomicOutput(OutputWay way = {}) : way_(std::move(way)) {}
    ~AtomicOutput();
    AtomicOutput(const AtomicOutput&) = delete;
    AtomicOutput& operator=(const AtomicOutput&) = delete;

    /// Writes `pieces` one after the other to a temporary file beside `target`. Pieces are
    /// made while the ones before them are written, where `execution` has a second thread. Fails where the target is
    /// one of the inputs, or one that was added before.
    void add(const Path& target, std::span<const OutputPiece> pieces, const Execution& execution = {.thread_count = 1});
    void add(const Path& target, std::initializer_list<OutputPiece> pieces) {
        add(target, std::span(pieces.begin(), pieces.size()));
    }
    void add(const Path& target, std::span<const std::uint8_t> bytes) { add(target, {OutputPiece(bytes)}); }

    /// add() for a file that several outputs may write (a shared texture) and that does not exist yet. Where it exists at
    /// commit() with equal bytes, it stays; with other bytes commit() fails. Atomic among the threads of this process.
    void addShared(const Path& target, std::span<const std::uint8_t> bytes) {
        add(target, bytes);
        files_.back().is_shared = true;
    }

    /// Whether a file exists and has these bytes. If so, other calls of OneRun cannot change it.
    bool leave(const Path& target, std::span<const std::uint8_t> bytes);

    [[nodiscard]] bool isStream() const { return way_.sink != nullptr; }

    /// Notes a file whose content went into an output.
    void addSource(const Path& source);
    [[nodiscard]] const std::vector<std::string>& sources() const { return sources_; }

    /// Renames all temporary files to their targets, the last one added first kept for the end. When a rename
    /// fails, the files renamed before it are put back as they were. While HeldOutputs live on this thread, it hands the files
    /// to them.
    void commit();

    /// Targets in the order they were added, and the bytes of all of them.
    [[nodiscard]] std::vector<std::string> files() const;
    [[nodiscard]] std::uint64_t byteCount() const { return byte_count_; }

  private:
    friend class HeldOutputs;
    struct File {
        Path target;  ///< with links resolved
        Path temporary = {};
        bool is_made = false;  ///< the temporary file exists
        Bytes held = {};       ///< for a stream
        bool is_stream = false;
        bool is_shared = false;  ///< see addShared()
        std::uint64_t call = 0;  ///< InputFiles::call() of its call; 0: none
    };

    [[noreturn]] static void failToWrite(const Path& target, const std::string& why);
    // Implemented on the disk (atomic_output_disk.cpp).
    /// The entry for a target that may be written.
    File planFile(const Path& requested);
    /// writeTo(sink) returns 0, or errno.
    void addFile(File planned, const std::function<int(const Sink&)>& writeTo);
    void makeFolders(const Path& target);
    /// Fails where another call of the run relies on a target; skips targets that have equal bytes already.
    void leaveSharedFiles();
    void leave(File& file);
    void renameFiles();
    void removeTemporaryFiles() noexcept;

    OutputWay way_;
    std::vector<File> files_;
    std::vector<Path> created_folders_;
    std::set<std::string> identities_;  ///< file identities of the targets
    std::vector<std::string> sources_;
    std::uint64_t byte_count_ = 0;
    bool committed_ = false;
};

/// While it lives, AtomicOutput::commit() on this thread keeps its files back, and commit() of this object puts all of them in
/// place together. A caller prepares its report in between: nothing that needs memory follows once outputs are in place.
/// Without commit() the destructor removes the files. Of several on one thread, the innermost holds.
class HeldOutputs {
  public:
    HeldOutputs();
    ~HeldOutputs();
    HeldOutputs(const HeldOutputs&) = delete;
    HeldOutputs& operator=(const HeldOutputs&) = delete;

    /// After an error no file is in place, and none is held any more.
    [[nodiscard]] Result<Done> commit();

  private:
    friend class AtomicOutput;
    /// The object of this thread, or null.
    static HeldOutputs* ofThread();
    void take(AtomicOutput& output);

    AtomicOutput all_{{.sync = false}};
    HeldOutputs* outer_;
};

}  // namespace tspace
