// SPDX-License-Identifier: MIT
// Writes several output files atomically: each is written next to its target under a temporary name, and all are
// renamed at the end.
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
#include "tspace/callbacks.h"
#include "tspace/execution.h"
#include "tspace/file_options.h"
#include "tspace/result.h"

namespace tspace {

// Parts of an output file: existing bytes, or bytes that are generated when they are written.

class ByteMaker {
  public:
    virtual ~ByteMaker() = default;
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Fills `to` with the bytes from `begin` on. Must be thread-safe and deterministic.
    virtual void make(std::size_t begin, std::span<std::uint8_t> to) const = 0;
    /// Returns all bytes if they already exist (valid for the lifetime of this object); otherwise an empty span.
    [[nodiscard]] virtual std::span<const std::uint8_t> existingBytes() const { return {}; }
};

/// Owns a vector and provides its bytes without a copy. T: four-byte numbers without padding.
template <class T>
class KeptBytes final : public ByteMaker {
  public:
    explicit KeptBytes(std::vector<T>&& values) : values_(std::move(values)) {
        convertLittleEndian({reinterpret_cast<std::uint8_t*>(values_.data()), size()}, 4);
    }

    [[nodiscard]] std::size_t size() const override { return values_.size() * sizeof(T); }
    void make(std::size_t begin, std::span<std::uint8_t> to) const override {
        if (!to.empty()) std::memcpy(to.data(), existingBytes().data() + begin, to.size());
    }
    [[nodiscard]] std::span<const std::uint8_t> existingBytes() const override {
        return {reinterpret_cast<const std::uint8_t*>(values_.data()), size()};
    }

  private:
    std::vector<T> values_;
};

struct OutputPiece {
    OutputPiece(std::span<const std::uint8_t> existing) : bytes(existing) {}
    OutputPiece(const Bytes& existing) : bytes(existing) {}
    OutputPiece(std::shared_ptr<const ByteMaker> made) : bytes(made->existingBytes()), maker(std::move(made)) {}

    [[nodiscard]] bool isThere() const { return !maker || !bytes.empty(); }

    [[nodiscard]] std::size_t size() const { return maker ? maker->size() : bytes.size(); }

    std::span<const std::uint8_t> bytes = {};
    std::shared_ptr<const ByteMaker> maker = {};  ///< owner or generator of the bytes; null if the caller owns them
};

/// Input files of one call, which its outputs must not replace: files that it reads, and images that its models
/// reference.
class InputFiles {
  public:
    InputFiles();
    /// Adds an input. Fails with cannotRead (FileError) if another call of the same OneRun wrote this file.
    void add(const Path& path) { addTo(identities_, path); }
    /// Makes `options` report every opened file, and every referenced image, to this object and then to the callbacks
    /// that were set before. This object must outlive `options`.
    void watch(FileOptions& options);
    /// Allows outputs to replace this file if a model references it as an image and nothing reads it.
    void allowReplacing(const Path& path);
    /// Returns whether `path` is one of the inputs, under any name (links, relative paths).
    [[nodiscard]] bool has(const Path& path) const;
    /// Returns a number for the call that is unique in this process.
    [[nodiscard]] std::uint64_t call() const { return call_; }

  private:
    void addTo(std::set<std::string>& identities, const Path& path);

    std::uint64_t call_;
    mutable std::mutex mutex_ = {};
    std::set<std::string> identities_ = {}, named_ = {}, replaceable_ = {};
};

/// Prevents all outputs of this process from replacing these files while it exists. Used for reports and manifests,
/// which other code writes, possibly later (the names of derived outputs are known only when they are written). Empty
/// paths and "-" are ignored.
class ProtectedFiles {
  public:
    explicit ProtectedFiles(const std::vector<std::string>& paths);
    ~ProtectedFiles();
    ProtectedFiles(const ProtectedFiles&) = delete;
    ProtectedFiles& operator=(const ProtectedFiles&) = delete;

  private:
    std::vector<std::string> identities_ = {};
};

/// While it exists, all calls are part of one run over several models. The calls may run in parallel: no call changes a
/// file that another call read, wrote, or left unchanged because its content was already correct. At most one may
/// exist.
class OneRun {
  public:
    OneRun();
    ~OneRun();
    OneRun(const OneRun&) = delete;
    OneRun& operator=(const OneRun&) = delete;
};

/// Options for writing outputs.
struct OutputOptions {
    /// If set, the sink receives the single output file, and nothing is written to disk.
    Sink sink = {};
    bool is_dry_run = false;  ///< no output is written
    /// Flushes files to the disk before they are renamed. Takes a few milliseconds per file.
    bool sync = true;
    const InputFiles* inputs = nullptr;  ///< inputs of the call, which outputs must not replace; null: none
    bool replaces_inputs = false;        ///< outputs may replace inputs, as for in-place changes of a model
};

/// Collects files; commit() puts them in place. Without commit() the destructor removes all temporary files. All
/// functions fail with cannotWrite by throwing FileError.
///
/// Symbolic links are followed, except if isForeignLink() returns true. commit() writes into a character device or
/// FIFO; any other target that is not a regular file is rejected. The new file inherits the owner, group and
/// permissions of the file it replaces, and the temporary file never has more permissions.
class AtomicOutput {
  public:
    explicit AtomicOutput(OutputOptions options = {}) : options_(std::move(options)) {}
    ~AtomicOutput();
    AtomicOutput(const AtomicOutput&) = delete;
    AtomicOutput& operator=(const AtomicOutput&) = delete;

    /// Writes `pieces` consecutively to a temporary file next to `target`. Pieces are generated while earlier ones are
    /// written, if `execution` has a second thread. Fails if the target is one of the inputs, or was added before.
    void add(const Path& target, std::span<const OutputPiece> pieces, const Execution& execution = {.thread_count = 1});
    void add(const Path& target, std::initializer_list<OutputPiece> pieces) {
        add(target, std::span(pieces.begin(), pieces.size()));
    }
    void add(const Path& target, std::span<const std::uint8_t> bytes) { add(target, {OutputPiece(bytes)}); }

    /// Adds a file that several outputs may write, such as a shared texture. If the file exists at commit(), it is kept
    /// if its bytes are equal; otherwise commit() fails. Atomic among the threads of this process.
    void addShared(const Path& target, std::span<const std::uint8_t> bytes) {
        add(target, bytes);
        files_.back().is_shared = true;
    }

    /// Returns whether the file already exists with exactly these bytes. If so, other calls of the run cannot change
    /// it.
    bool leave(const Path& target, std::span<const std::uint8_t> bytes);

    [[nodiscard]] bool isStream() const { return options_.sink != nullptr; }

    /// Records a file whose content became part of an output.
    void addSource(const Path& source);
    [[nodiscard]] const std::vector<std::string>& sources() const { return sources_; }

    /// Renames all temporary files to their targets. The first one added, a model, is renamed last, when the files that
    /// it references are in place. If a rename fails, the previous renames are undone. While a HeldOutputs exists on
    /// this thread, commit() hands the files to it instead.
    void commit();

    /// Returns the targets in the order of adding, and their total size.
    [[nodiscard]] std::vector<std::string> files() const;
    [[nodiscard]] std::uint64_t byteCount() const { return byte_count_; }

  private:
    friend class HeldOutputs;
    struct File {
        Path target;  ///< path with links resolved
        Path temporary = {};
        bool is_made = false;  ///< the temporary file exists
        Bytes held = {};       ///< content of a stream output
        bool is_stream = false;
        bool is_shared = false;  ///< the file was added by addShared()
        std::uint64_t call = 0;  ///< InputFiles::call() of the call; 0: none
    };

    struct Renaming;

    [[noreturn]] static void failToWrite(const Path& target, const std::string& why);
    // Implemented in disk/atomic_output_disk.cpp.
    /// Returns the entry for a target that may be written.
    File planFile(const Path& requested);
    /// Adds a file written by writeTo(sink), which returns 0 or errno.
    void addFile(File planned, const std::function<int(const Sink&)>& writeTo);
    void makeFolders(const Path& target);
    /// Checks existing targets that are shared, or that another call of the run uses: keeps those whose bytes are
    /// equal, and fails if they differ.
    void leaveSharedFiles();
    void leave(File& file);
    void renameFiles();
    void removeTemporaryFiles() noexcept;

    OutputOptions options_;
    std::vector<File> files_;
    std::vector<Path> created_folders_;
    std::set<std::string> identities_;  ///< file identities of the targets
    std::vector<std::string> sources_;
    std::uint64_t byte_count_ = 0;
    bool committed_ = false;
};

/// Holds back the files of AtomicOutput::commit() on this thread while it exists; its own commit() puts them in place
/// together. The caller prepares its report in between, so that no allocation follows once outputs are in place.
/// Without commit() the destructor removes the files. If several exist on one thread, the innermost one is used.
class HeldOutputs {
  public:
    HeldOutputs();
    ~HeldOutputs();
    HeldOutputs(const HeldOutputs&) = delete;
    HeldOutputs& operator=(const HeldOutputs&) = delete;

    /// Returns the files that commit() puts in place.
    [[nodiscard]] std::vector<std::string> files() const { return all_.files(); }
    /// Puts all held files in place. After an error no file is in place, and none is held any more.
    [[nodiscard]] Result<Done> commit();
    /// Removes all held files.
    void discard() noexcept;

  private:
    friend class AtomicOutput;
    void forget() noexcept;
    /// Returns the object of this thread, or null.
    static HeldOutputs* ofThread();
    void take(AtomicOutput& output);

    AtomicOutput all_{{.sync = false}};
    HeldOutputs* outer_;
};

}  // namespace tspace
