// SPDX-License-Identifier: MIT
// Several output files that appear together or not at all: each is written beside its target under a
// temporary name, and all are renamed at the end.
#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "model/io/output_piece.h"
#include "model/io/path.h"
#include "tspace/asset.h"

namespace tspace {

/// Files that outputs of one call must not take the place of.
class InputFiles {
  public:
    InputFiles();
    /// Fails with cannotRead (FileError) where another call of the same OneRun wrote the file.
    void add(const Path& path);
    /// Makes `options` tell about every file that is opened, also to whom they told it before. Lives longer than they.
    void watch(FileOptions& options);
    /// Whether `path` is one of them, under whatever name.
    [[nodiscard]] bool has(const Path& path) const;
    /// No other call of this process has it.
    [[nodiscard]] std::uint64_t call() const { return call_; }

  private:
    std::uint64_t call_;
    mutable std::mutex mutex_ = {};
    std::set<std::string> identities_ = {};
};

/// While it lives, no output of this process takes the place of these files, which it writes itself in another way or at
/// another time: names of outputs that are made from others are known only when they are written. Empty paths and "-" are
/// none.
class KeptFiles {
  public:
    explicit KeptFiles(const std::vector<std::string>& paths);
    ~KeptFiles();
    KeptFiles(const KeptFiles&) = delete;
    KeptFiles& operator=(const KeptFiles&) = delete;

  private:
    std::vector<std::string> identities_ = {};
};

/// While it lives, calls with InputFiles of their own are one run over several models, perhaps at one time: none of them
/// changes a file that another one read, or wrote, or left because it needs just that. One at a time.
class OneRun {
  public:
    OneRun();
    ~OneRun();
    OneRun(const OneRun&) = delete;
    OneRun& operator=(const OneRun&) = delete;
};

/// How outputs are written.
struct OutputWay {
    /// The one file goes there at once, in place of the disk.
    Sink sink = {};
    bool is_dry_run = false;  ///< writes nothing
    /// Files are on the disk, and not in its cache alone, before they take their places. Costs some milliseconds for each.
    bool sync = true;
    const InputFiles* inputs = nullptr;  ///< of the call: no output may be one of these; null: there are none
    bool replaces_inputs = false;        ///< outputs may be those all the same: the model is changed in place
};

/// Collects files, then commit() puts them in place. Without commit() the destructor removes every temporary
/// file. All functions fail with cannotWrite by throwing FileError.
///
/// A target that is a link is what it points at, but where isForeignLink(). A character device or FIFO is written into, in
/// commit(); what is neither that nor a file is refused. A file that was there leaves its owner, group and permissions to
/// the new one, and until then nobody may do more with that.
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

    /// The same for a file that other outputs may bring too, and that is not there yet. Where it is there by the time of
    /// commit(), with the same bytes, it stays; with others commit() fails. That holds for all threads of the process.
    void addShared(const Path& target, std::span<const std::uint8_t> bytes) {
        add(target, bytes);
        files_.back().is_shared = true;
    }

    /// Whether a file is there and has these bytes. It then stays so until the end of OneRun.
    bool leave(const Path& target, std::span<const std::uint8_t> bytes);

    [[nodiscard]] bool isStream() const { return way_.sink != nullptr; }

    /// Remembers a file whose content went into an output.
    void addSource(const Path& source);
    [[nodiscard]] const std::vector<std::string>& sources() const { return sources_; }

    /// Renames all temporary files to their targets, the last one added first kept for the end. When a rename
    /// fails, the files renamed before it are put back as they were.
    void commit();

    /// Targets in the order they were added, and the bytes of all of them.
    [[nodiscard]] std::vector<std::string> files() const;
    [[nodiscard]] std::uint64_t byteCount() const { return byte_count_; }

  private:
    struct File {
        Path target;  ///< no link
        Path temporary = {};
        bool is_made = false;  ///< the temporary file is there
        Bytes held = {};       ///< for a stream
        bool is_stream = false;
        bool is_shared = false;  ///< see addShared()
    };

    [[noreturn]] static void failToWrite(const Path& target, const std::string& why);
    // What is done on the disk.
    /// The entry for a target that may be written.
    File planFile(const Path& requested);
    /// writeTo(sink) returns 0, or errno.
    void addFile(File planned, const std::function<int(const Sink&)>& writeTo);
    void makeFolders(const Path& target);
    /// Fails where another call of the run needs a file as it is; leaves those that have the same bytes already.
    void leaveSharedFiles();
    void leave(File& file);
    void renameFiles();
    void removeTemporaryFiles() noexcept;

    OutputWay way_;
    std::vector<File> files_;
    std::vector<Path> created_folders_;
    std::set<std::string> identities_;  ///< of targets
    std::vector<std::string> sources_;
    std::uint64_t byte_count_ = 0;
    bool committed_ = false;
};

}  // namespace tspace
