// SPDX-License-Identifier: MIT
// All of stdin, as long as it looks like a model.
#include "standard_input.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace tspace::tool {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;  // a GLB cannot be larger

/// By the first bytes. A JSON text may begin with a mark of UTF-8 and spaces.
bool looksLikeModel(std::string_view text) {
    if (text.starts_with("glTF")) return true;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != std::string_view::npos && text[begin] == '{';
}

}  // namespace

Result<Done> StandardInput::open(const std::string& input, FileOptions& options) {
    if (input != "-") return Done{};
    if (isatty(STDIN_FILENO) != 0) return Error{ErrorCode::cannotRead, "standard input is a terminal, not a model"};
    const std::uint64_t limit = options.memory_limit_bytes;
    const std::uint64_t most = limit == 0 || limit == kNoMemoryLimit ? kMostBytes : std::min(kMostBytes, limit);
    std::vector<std::uint8_t> block(std::size_t{1} << 20);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), stdin)) {
        const std::string_view text(reinterpret_cast<const char*>(block.data()), count);
        if (bytes_.empty() && !looksLikeModel(text)) {
            return Error{ErrorCode::unsupportedFile,
                         "standard input is neither GLB nor glTF; models of other formats are read from files"};
        }
        if (count > most - bytes_.size()) return Error{ErrorCode::tooLarge, "standard input does not end in time"};
        bytes_.insert(bytes_.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (std::ferror(stdin) != 0)
        return Error{ErrorCode::cannotRead, std::string("cannot read standard input: ") + std::strerror(errno)};
    if (bytes_.empty()) return Error{ErrorCode::invalidFile, "standard input is empty"};
    options.content = bytes_;
    return Done{};
}

}  // namespace tspace::tool
