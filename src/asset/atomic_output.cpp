// SPDX-License-Identifier: MIT
// Temporary files beside their targets, renamed together at the end.
#include "asset/atomic_output.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "asset/c_file.h"
#include "asset/file_error.h"
#include "asset/temporary_name.h"
#include "core/parallel.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void failWrite(const fs::path& target, const std::string& why) {
    failFile(ErrorCode::cannotWrite, "cannot write " + pathInQuotes(target) + ": " + why);
}

/// What is written at one time: bytes that are there, and a block of bytes that were made.
class Batch {
  public:
    [[nodiscard]] bool empty() const { return parts_.empty(); }

    /// Takes from the pieces from `piece` and `offset` on, which go on to what is next.
    void fill(std::span<const OutputPiece> pieces, std::size_t& piece, std::size_t& offset) {
        parts_.clear();
        std::size_t used = 0, taken = 0;
        while (piece < pieces.size() && taken < kMostBytes) {
            const OutputPiece& from = pieces[piece];
            std::size_t count = from.size() - offset;
            if (!from.isThere() && count != 0) {
                if (block_.empty()) block_.resize(kBlockBytes);
                count = std::min(count, block_.size() - used);
                if (count == 0) break;
                const auto made = std::span(block_).subspan(used, count);
                from.maker->make(offset, made);
                parts_.emplace_back(made);
                used += count;
            } else if (count != 0) {
                parts_.push_back(from.bytes);
            }
            taken += count;
            offset += count;
            if (offset == from.size()) {
                ++piece;
                offset = 0;
            }
        }
    }
    [[nodiscard]] bool write(const Sink& sink) const { return std::all_of(parts_.begin(), parts_.end(), sink); }

  private:
    static constexpr std::size_t kBlockBytes = std::size_t{1} << 19;  // stays in the second cache
    static constexpr std::size_t kMostBytes = 4 * kBlockBytes;
    std::vector<std::span<const std::uint8_t>> parts_;
    Bytes block_;
};

/// Returns 0, or errno.
int writePieces(const Sink& sink, std::span<const OutputPiece> pieces, Parallel& parallel) {
    Batch batches[2];
    std::size_t piece = 0, offset = 0;
    int error = 0;
    batches[0].fill(pieces, piece, offset);
    for (std::size_t current = 0; error == 0 && !batches[current].empty(); current ^= 1) {
        // The other one is filled even where nothing is left: then it is empty.
        int no_memory = 0;
        parallel.forTasks(2, [&](std::size_t task) {
            if (task == 0) {
                if (!batches[current].write(sink)) error = errno != 0 ? errno : EIO;
                return;
            }
            try {
                batches[current ^ 1].fill(pieces, piece, offset);
            } catch (...) {
                no_memory = ENOMEM;
            }
        });
        if (error == 0) error = no_memory;
    }
    return error;
}

}  // namespace

AtomicOutput::~AtomicOutput() {
    if (committed_) return;
    std::error_code ignored;
    for (const File& file : files_) fs::remove(file.temporary.string(), ignored);
    // Only empty folders go: remove() fails on others.
    for (auto folder = created_folders_.rbegin(); folder != created_folders_.rend(); ++folder)
        fs::remove(folder->string(), ignored);
}

void AtomicOutput::add(const Path& requested_path, std::span<const OutputPiece> pieces, const Execution& execution) {
    for (const OutputPiece& piece : pieces) byte_count_ += piece.size();
    const bool any_made = std::any_of(pieces.begin(), pieces.end(), [](const OutputPiece& p) { return !p.isThere(); });
    Parallel parallel(any_made ? execution : Execution{.thread_count = 1});
    if (sink_ || is_dry_run_) {
        files_.push_back({{}, requested_path});
        const int failure = is_dry_run_ ? 0 : writePieces(sink_, pieces, parallel);
        if (failure != 0) failWrite(requested_path, std::strerror(failure));
        return;
    }
    // A link keeps being a link: what it points at is replaced.
    std::error_code error;
    const fs::path requested = requested_path;
    const fs::path target = fs::is_symlink(requested, error) ? fs::weakly_canonical(requested) : requested;
    if (fs::is_directory(target, error)) failWrite(target, "it is a folder");
    std::vector<fs::path> missing;
    for (fs::path folder = folderOf(target); !folder.empty() && !fs::exists(folder, error);
         folder = folder.parent_path()) {
        missing.push_back(folder);
    }
    for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
        if (fs::create_directory(*folder, error)) created_folders_.push_back(*folder);
        if (error) failWrite(target, "cannot make its folder: " + error.message());
    }
    const fs::path temporary = besideName(target, kTemporaryEnding);
    CFile file(std::fopen(temporary.c_str(), "wb"));
    if (!file) failWrite(target, std::strerror(errno));
    files_.push_back({temporary, target});
    const Sink to_file = [&file](std::span<const std::uint8_t> part) {
        return std::fwrite(part.data(), 1, part.size(), file.get()) == part.size();
    };
    if (const int failure = writePieces(to_file, pieces, parallel); failure != 0) {
        failWrite(target, std::strerror(failure));
    }
    if (std::fclose(file.release()) != 0) failWrite(target, std::strerror(errno));
    const fs::file_status old = fs::status(target, error);
    if (fs::exists(old)) fs::permissions(temporary, old.permissions(), error);
}

void AtomicOutput::commit() {
    if (sink_ || is_dry_run_) {
        committed_ = true;
        return;
    }
    // Old files are set aside first, so that a failure half-way can be taken back.
    struct Aside {
        fs::path old_name, new_name;
        bool renamed = false;
    };
    std::vector<Aside> aside(files_.size());
    std::error_code error, ignored;
    std::size_t done = 0;
    for (std::size_t i = files_.size(); i-- > 0 && !error; ++done) {
        const File& file = files_[i];
        if (fs::is_directory(file.target.string(), ignored)) {
            error = std::make_error_code(std::errc::is_a_directory);
            continue;
        }
        if (files_.size() > 1 && fs::exists(file.target.string(), ignored)) {
            aside[i] = {file.target, besideName(file.target, ".old"), false};
            fs::create_hard_link(aside[i].old_name, aside[i].new_name, error);
            // Not every file system has hard links.
            if (error) fs::rename(aside[i].old_name, aside[i].new_name, error);
            if (error) continue;
            aside[i].renamed = true;
        }
        fs::rename(file.temporary.string(), file.target.string(), error);
    }
    if (error) {
        const std::size_t failed = files_.size() - done;
        for (std::size_t i = failed; i < files_.size(); ++i) {
            if (aside[i].renamed) {
                fs::rename(aside[i].new_name, aside[i].old_name, ignored);
                // Where both names are still one file, renaming does nothing.
                fs::remove(aside[i].new_name, ignored);
            } else if (i != failed) {
                fs::remove(files_[i].target.string(), ignored);
            }
        }
        failWrite(files_[failed].target, error.message());
    }
    for (const Aside& old : aside) {
        if (old.renamed) fs::remove(old.new_name, ignored);
    }
    committed_ = true;
}

void AtomicOutput::addSource(const Path& source) {
    if (std::find(sources_.begin(), sources_.end(), source.string()) == sources_.end()) {
        sources_.push_back(source.string());
    }
}

std::vector<std::string> AtomicOutput::files() const {
    std::vector<std::string> names;
    for (const File& file : files_) names.push_back(file.target.string());
    return names;
}

}  // namespace tspace
