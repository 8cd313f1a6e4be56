// SPDX-License-Identifier: MIT
#include "model/gltf/packed_words.h"

#include <mutex>

#include "core/base/parallel.h"
#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// Frames that a task has at least: one takes about as long as ten corners of usual cost.
constexpr std::size_t kPackGrain = 512, kCornersPerFrame = 10;

void add(const PackReport& part, PackReport& sum) {
    sum.bad_normal_count += part.bad_normal_count;
    sum.not_finite_count += part.not_finite_count;
    sum.zero_count += part.zero_count;
    sum.parallel_count += part.parallel_count;
    sum.not_unit_count += part.not_unit_count;
    sum.not_orthogonal_count += part.not_orthogonal_count;
    sum.bad_sign_count += part.bad_sign_count;
}

}  // namespace

Bytes packWords(FrameFormat format, std::span<const Vec3> normals, std::span<const Vec4> tangents,
                const Execution& execution, PackReport& report) {
    const std::size_t word_bytes = frameBytes(format);
    Bytes words(normals.size() * word_bytes);
    const auto out = std::as_writable_bytes(std::span(words));
    Error failure{ErrorCode::ok, {}};
    std::mutex mutex;
    Parallel parallel(execution, kCornersPerFrame * normals.size());
    parallel.forRanges(normals.size(), kPackGrain, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        const Result<PackReport> packed =
            tspace::packFrames(normals.subspan(begin, count), tangents.subspan(begin, count), format,
                               out.subspan(begin * word_bytes, count * word_bytes));
        const std::lock_guard lock(mutex);
        if (packed) {
            add(*packed, report);
        } else {
            failure = packed.error();
        }
    });
    if (failure.code != ErrorCode::ok) failFile(failure.code, failure.message);
    return words;
}

}  // namespace tspace::gltf
