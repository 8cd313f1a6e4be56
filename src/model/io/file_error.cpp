// SPDX-License-Identifier: MIT
// Quotes text of unknown origin in messages (well-formed byte sequences: Unicode 15.0, table 3-7).
#include "model/io/file_error.h"

#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

namespace tspace {
namespace {

struct Character {
    std::size_t length = 1;  ///< length in bytes
    bool printable = false;
};

/// Returns the first character of a nonempty `text`; an invalid byte counts as a character.
Character firstCharacter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return {1, lead >= 0x20 && lead != 0x7f};
    const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
    std::uint32_t code = lead & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0u) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    if (overlong || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {};
    // Control characters include line separators and marks that change the text direction.
    const bool control = code < 0xa0 || code == 0x061c || code == 0x200b || code == 0x200e || code == 0x200f ||
                         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f);
    return {length, !control};
}

}  // namespace

void failFile(ErrorCode code, std::string message, std::string place) {
    throw FileError{Error{code, std::move(message), kNoElement, std::move(place)}};
}

std::string inQuotes(std::string_view text, std::size_t limit) {
    std::string result = "'";
    while (!text.empty()) {
        const Character next = firstCharacter(text);
        if (result.size() - 1 + next.length > limit) return result + "...'";
        if (next.printable) {
            result += text.substr(0, next.length);
        } else {
            result += '?';
        }
        text.remove_prefix(next.length);
    }
    return result + "'";
}

std::string pathInQuotes(const Path& path) { return inQuotes(path.string(), 1000); }

Error fileErrorInFlight() try { throw; } catch (const FileError& failure) {
    return failure.error;
} catch (const CallerError& failure) {
    return failure.error;
} catch (const std::filesystem::filesystem_error& failure) {
    if (failure.code() == std::errc::not_enough_memory) throw std::bad_alloc();
    return Error{ErrorCode::cannotRead,
                 "cannot look up " + pathInQuotes(failure.path1()) + ": " + failure.code().message()};
}

}  // namespace tspace
