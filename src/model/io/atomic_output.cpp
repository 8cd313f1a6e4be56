// SPDX-License-Identifier: MIT
// Writes the pieces of an output in order; contains the code shared by outputs on disk and in memory.
#include "model/io/atomic_output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <utility>

#include "core/base/parallel.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Bytes of one write: views of existing bytes, and a block of generated ones.
class Batch {
  public:
    [[nodiscard]] bool empty() const { return parts_.empty(); }

    /// Fills the batch from the pieces, starting at `piece` and `offset`, and advances both.
    void fill(std::span<const OutputPiece> pieces, std::size_t& piece, std::size_t& offset) {
        parts_.clear();
        std::size_t used = 0, taken = 0;
        while (piece < pieces.size() && taken < kMaxBytes) {
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
    static constexpr std::size_t kBlockBytes = std::size_t{1} << 19;  // fits the L2 cache
    static constexpr std::size_t kMaxBytes = 4 * kBlockBytes;
    std::vector<std::span<const std::uint8_t>> parts_;
    Bytes block_;
};

/// Writes all pieces to the sink, in order. Returns 0 or errno.
int writePieces(const Sink& sink, std::span<const OutputPiece> pieces, Parallel& parallel) {
    Batch batches[2];
    std::size_t piece = 0, offset = 0;
    int error = 0;
    batches[0].fill(pieces, piece, offset);
    for (std::size_t current = 0; error == 0 && !batches[current].empty(); current ^= 1) {
        // Fills the next batch while the current one is written; at the end, the next batch is empty. An exception of
        // the caller's sink is passed on.
        parallel.forTasks(2, [&](std::size_t task) {
            if (task == 1) return batches[current ^ 1].fill(pieces, piece, offset);
            errno = 0;
            if (!batches[current].write(sink)) error = errno != 0 ? errno : EIO;
        });
    }
    return error;
}

}  // namespace

void AtomicOutput::failToWrite(const Path& target, const std::string& why) {
    failFile(ErrorCode::cannotWrite, "cannot write " + pathInQuotes(target) + ": " + why);
}

AtomicOutput::~AtomicOutput() {
    if (!committed_) removeTemporaryFiles();
}

void AtomicOutput::add(const Path& requested_path, std::span<const OutputPiece> pieces, const Execution& execution) {
    for (const OutputPiece& piece : pieces) byte_count_ += piece.size();
    const bool any_made = std::any_of(pieces.begin(), pieces.end(), [](const OutputPiece& p) { return !p.isThere(); });
    Parallel parallel(any_made ? execution : Execution{.thread_count = 1});
    if (options_.sink) {
        files_.push_back({requested_path});
        const int failure = options_.is_dry_run ? 0 : writePieces(options_.sink, pieces, parallel);
        if (failure != 0) failToWrite(requested_path, std::strerror(failure));
        return;
    }
    File planned = planFile(requested_path);
    if (options_.is_dry_run) {
        planned.target = requested_path;
        files_.push_back(std::move(planned));
        return;
    }
    addFile(std::move(planned), [&](const Sink& to_file) { return writePieces(to_file, pieces, parallel); });
}

void AtomicOutput::commit() {
    HeldOutputs* const held = HeldOutputs::ofThread();
    if (!options_.sink && !options_.is_dry_run) held != nullptr ? held->take(*this) : renameFiles();
    committed_ = true;
}

void AtomicOutput::addSource(const Path& source) {
    if (std::find(sources_.begin(), sources_.end(), source.string()) == sources_.end())
        sources_.push_back(source.string());
}

std::vector<std::string> AtomicOutput::files() const {
    std::vector<std::string> names;
    for (const File& file : files_) names.push_back(file.target.string());
    return names;
}

namespace {

thread_local HeldOutputs* held_outputs = nullptr;

}  // namespace

HeldOutputs::HeldOutputs() : outer_(std::exchange(held_outputs, this)) {}
HeldOutputs::~HeldOutputs() { held_outputs = outer_; }
HeldOutputs* HeldOutputs::ofThread() { return held_outputs; }

void HeldOutputs::take(AtomicOutput& output) {
    all_.files_.reserve(all_.files_.size() + output.files_.size());
    all_.created_folders_.reserve(all_.created_folders_.size() + output.created_folders_.size());
    // No allocations from here on.
    std::move(output.files_.begin(), output.files_.end(), std::back_inserter(all_.files_));
    std::move(output.created_folders_.begin(), output.created_folders_.end(),
              std::back_inserter(all_.created_folders_));
    all_.identities_.merge(output.identities_);
    all_.options_.sync = all_.options_.sync || output.options_.sync;
    output.files_.clear();
    output.created_folders_.clear();
}

Result<Done> HeldOutputs::commit() {
    if (all_.files_.empty()) return Done{};
    Result<Done> done = atFileBorder([&]() -> Result<Done> {
        all_.renameFiles();
        return Done{};
    });
    done ? forget() : discard();
    return done;
}

void HeldOutputs::discard() noexcept {
    all_.removeTemporaryFiles();
    forget();
}

void HeldOutputs::forget() noexcept {
    all_.files_.clear();
    all_.created_folders_.clear();
    all_.identities_.clear();
}

}  // namespace tspace
