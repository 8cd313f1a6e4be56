// SPDX-License-Identifier: MIT
// Supercompression of KTX2 levels: Zstandard with libzstd, zlib with zlib. Both stop at the required size of the level.
// The web page uses other libraries (bindings/js/wasm/textures.cpp).
#include "core/base/memory.h"
#include "images/textures/texture_file.h"

#ifdef TSPACE_HAS_ZSTD
#include <zstd.h>
#include <zstd_errors.h>
#endif
#ifdef TSPACE_HAS_ZLIB
#include <zlib.h>
#endif

namespace tspace {

const char* whyNotUnpacked(Repacking repacking) {
#ifndef TSPACE_HAS_ZSTD
    if (repacking == Repacking::zstd)
        return "the KTX2 uses Zstandard supercompression, which this build of tspace does not support";
#endif
#ifndef TSPACE_HAS_ZLIB
    if (repacking == Repacking::zlib)
        return "the KTX2 uses zlib supercompression, which this build of tspace does not support";
#endif
    (void)repacking;
    return nullptr;
}

bool unpackLevel([[maybe_unused]] Repacking repacking, [[maybe_unused]] ByteSpan packed,
                 [[maybe_unused]] std::span<std::uint8_t> out) {
#ifdef TSPACE_HAS_ZSTD
    if (repacking == Repacking::zstd) {
        const std::size_t count = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
        if (ZSTD_getErrorCode(count) == ZSTD_error_memory_allocation) throwOutOfMemory();
        return count == out.size();
    }
#endif
#ifdef TSPACE_HAS_ZLIB
    if (repacking == Repacking::zlib) {
        uLongf count = static_cast<uLongf>(out.size());
        if (count != out.size() || packed.size() != static_cast<uLong>(packed.size())) return false;
        const int result = uncompress(out.data(), &count, packed.data(), static_cast<uLong>(packed.size()));
        if (result == Z_MEM_ERROR) throwOutOfMemory();
        return result == Z_OK && count == out.size();
    }
#endif
    return false;
}

}  // namespace tspace
