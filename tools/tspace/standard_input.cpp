// SPDX-License-Identifier: MIT
// Reads all of stdin if it looks like a model.
#include "standard_input.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>

#include "images/image.h"
#include "system.h"

namespace tspace::tool {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t{4} << 30;  // maximum size of a GLB

/// Returns whether the first bytes may be those of a GLB or of JSON, which may start with a UTF-8 byte order mark and
/// whitespace.
bool mayBeModel(std::string_view text) {
    if (text.starts_with("glTF")) return true;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != std::string_view::npos && text[begin] == '{';
}

bool mayBeModelOrImage(std::string_view text) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    const ImageFormat format = imageFormat(bytes);
    return mayBeModel(text) || (format != ImageFormat::unknown && format != ImageFormat::tga);
}

}  // namespace

Result<std::vector<std::uint8_t>> readStandardInput(const char* what, std::uint64_t memory_limit_bytes,
                                                    bool (*is_valid)(std::string_view), const char* why_not) {
    if (isTerminal(stdin))
        return Error{ErrorCode::cannotRead, std::string("standard input is a terminal, not ") + what};
    const bool is_limited = memory_limit_bytes != 0 && memory_limit_bytes != kNoMemoryLimit;
    const std::uint64_t most = is_limited ? std::min(kMaxBytes, memory_limit_bytes) : kMaxBytes;
    std::vector<std::uint8_t> bytes, block(std::size_t{1} << 20);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), stdin)) {
        const std::string_view text(reinterpret_cast<const char*>(block.data()), count);
        if (bytes.empty() && !is_valid(text)) return Error{ErrorCode::unsupportedFile, why_not};
        if (count > most - bytes.size()) return Error{ErrorCode::tooLarge, "standard input timed out"};
        bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
    }
    if (std::ferror(stdin) != 0)
        return Error{ErrorCode::cannotRead, std::string("cannot read standard input: ") + std::strerror(errno)};
    if (bytes.empty()) return Error{ErrorCode::invalidFile, "standard input is empty"};
    return bytes;
}

Result<Done> StandardInput::open(const std::string& input, FileOptions& options, bool takes_images) {
    if (input != "-") return Done{};
    Result<std::vector<std::uint8_t>> bytes =
        readStandardInput("a model", options.memory_limit_bytes, takes_images ? mayBeModelOrImage : mayBeModel,
                          "standard input is neither a GLB nor a glTF; other formats must be read from files");
    if (!bytes) return std::move(bytes).error();
    bytes_ = *std::move(bytes);
    options.content = bytes_;
    return Done{};
}

bool StandardOutput::write(std::span<const std::uint8_t> bytes) {
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) failure_ = errno;
    return failure_ == 0;
}

Result<Done> StandardOutput::close() {
    if (failure_ == 0 && std::fflush(stdout) != 0) failure_ = errno;
    if (failure_ == 0) return Done{};
    return Error{ErrorCode::cannotWrite, std::string("cannot write standard output: ") + std::strerror(failure_)};
}

}  // namespace tspace::tool
