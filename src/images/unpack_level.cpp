// SPDX-License-Identifier: MIT
// What KTX2 packs its levels with: Zstandard by libzstd, zlib by zlib. Both stop at the size that the level must have.
// The page has other libraries for it (bindings/js/wasm/textures.cpp).
#include "images/texture_file.h"

#ifdef TSPACE_HAS_ZSTD
#include <zstd.h>
#endif
#ifdef TSPACE_HAS_ZLIB
#include <zlib.h>
#endif

namespace tspace {

const char* whyNotUnpacked(Repacking repacking) {
#ifndef TSPACE_HAS_ZSTD
    if (repacking == Repacking::zstd)
        return "it is a KTX2 packed by Zstandard, which this build of tspace does not read";
#endif
#ifndef TSPACE_HAS_ZLIB
    if (repacking == Repacking::zlib) return "it is a KTX2 packed by zlib, which this build of tspace does not read";
#endif
    (void)repacking;
    return nullptr;
}

bool unpackLevel([[maybe_unused]] Repacking repacking, [[maybe_unused]] ByteSpan packed,
                 [[maybe_unused]] std::span<std::uint8_t> out) {
#ifdef TSPACE_HAS_ZSTD
    if (repacking == Repacking::zstd)
        return ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()) == out.size();
#endif
#ifdef TSPACE_HAS_ZLIB
    if (repacking == Repacking::zlib) {
        uLongf count = static_cast<uLongf>(out.size());
        return count == out.size() && packed.size() == static_cast<uLong>(packed.size()) &&
               uncompress(out.data(), &count, packed.data(), static_cast<uLong>(packed.size())) == Z_OK &&
               count == out.size();
    }
#endif
    return false;
}

}  // namespace tspace
