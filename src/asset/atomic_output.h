// SPDX-License-Identifier: MIT
// Several output files that appear together or not at all: each is written beside its target under a
// temporary name, and all are renamed at the end.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "asset/output_piece.h"
#include "asset/path.h"
#include "tspace/asset.h"

namespace tspace {

/// Collects files, then commit() puts them in place. Without commit() the destructor removes every temporary
/// file. All functions fail with cannotWrite by throwing FileError.
class AtomicOutput {
  public:
    /// With a `sink` the one file goes there at once, in place of the disk; a dry run writes nothing.
    explicit AtomicOutput(Sink sink = {}, bool is_dry_run = false) : sink_(std::move(sink)), is_dry_run_(is_dry_run) {}
    ~AtomicOutput();
    AtomicOutput(const AtomicOutput&) = delete;
    AtomicOutput& operator=(const AtomicOutput&) = delete;

    /// Writes `pieces` one after the other to a temporary file beside `target`. Missing folders are created. Pieces are
    /// made while the ones before them are written, where `execution` has a second thread.
    void add(const Path& target, std::span<const OutputPiece> pieces, const Execution& execution = {.thread_count = 1});
    void add(const Path& target, std::initializer_list<OutputPiece> pieces) {
        add(target, std::span(pieces.begin(), pieces.size()));
    }
    void add(const Path& target, std::span<const std::uint8_t> bytes) { add(target, {OutputPiece(bytes)}); }

    [[nodiscard]] bool isStream() const { return sink_ != nullptr; }

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
    [[noreturn]] static void failToWrite(const Path& target, const std::string& why);
    /// What is done on the disk. writeTo(sink) returns 0, or errno.
    void addFile(const Path& requested_path, const std::function<int(const Sink&)>& writeTo);
    void renameFiles();
    void removeTemporaryFiles();

    struct File {
        Path temporary;
        Path target;
    };
    Sink sink_;
    bool is_dry_run_ = false;
    std::vector<File> files_;
    std::vector<Path> created_folders_;
    std::vector<std::string> sources_;
    std::uint64_t byte_count_ = 0;
    bool committed_ = false;
};

}  // namespace tspace
