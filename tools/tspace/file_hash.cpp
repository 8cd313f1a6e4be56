// SPDX-License-Identifier: MIT
// Computes fingerprints with xxHash.
#include "file_hash.h"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "model/io/system_files.h"

namespace tspace::tool {

std::optional<FileHash> hashFile(const std::string& path) {
    const CFile file = openFile(path, "rb");
    const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    if (!file || !state || XXH3_128bits_reset(state.get()) != XXH_OK) return {};
    FileHash result;
    std::vector<unsigned char> block(std::size_t{1} << 18);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        if (XXH3_128bits_update(state.get(), block.data(), count) != XXH_OK) return {};
        result.bytes += count;
    }
    if (std::ferror(file.get()) != 0) return {};
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    result.hash = fmt::format("xxh3:{:016x}{:016x}", hash.high64, hash.low64);
    return result;
}

std::uint64_t hashText(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace tspace::tool
