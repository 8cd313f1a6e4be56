// SPDX-License-Identifier: MIT
// URIs, and the files that a model references by URIs.
#include "model/io/uri.h"

#include <array>
#include <filesystem>

#include "model/io/file_error.h"
#include "model/io/folder_rule.h"
#include "model/io/legacy_text.h"

namespace tspace {

// Decodes URIs (RFC 3986, RFC 2397, RFC 4648), and checks which files a model may reference.

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Returns whether browsers ignore a character in base64 (forgiving-base64 of the WHATWG).
bool isBase64Space(char c) { return c == '\n' || c == '\r' || c == ' ' || c == '\t' || c == '\f'; }

/// Returns the length of the scheme before the colon, or 0.
std::size_t schemeLength(std::string_view uri) {
    if (uri.empty() || !isLetter(uri[0])) return 0;
    std::size_t i = 1;
    while (i < uri.size() && (isLetter(uri[i]) || isDigit(uri[i]) || uri[i] == '+' || uri[i] == '-' || uri[i] == '.'))
        ++i;
    return i < uri.size() && uri[i] == ':' ? i : 0;
}

bool equalsIgnoringCase(std::string_view a, std::string_view lower) {
    return std::equal(a.begin(), a.end(), lower.begin(), lower.end(), [](char x, char y) {
        return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
    });
}

std::array<std::int8_t, 256> makeBase64Values() {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    for (std::size_t i = 0; i < kBase64.size(); ++i)
        values[static_cast<unsigned char>(kBase64[i])] = static_cast<std::int8_t>(i);
    return values;
}

Bytes decodeBase64(std::string_view text, const std::string& place) {
    static const std::array<std::int8_t, 256> values = makeBase64Values();
    while (!text.empty() && (text.back() == '=' || isBase64Space(text.back()))) text.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = values[static_cast<unsigned char>(c)];
        if (isBase64Space(c)) continue;
        if (value < 0)
            failFile(ErrorCode::invalidFile, "a data URI contains a character that is not valid in base64", place);
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count));
        }
    }
    if (bit_count == 6) failFile(ErrorCode::invalidFile, "the base64 data of a data URI has an invalid length", place);
    return bytes;
}

}  // namespace

std::string encodeBase64(const Bytes& bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = std::uint32_t{bytes[i]} << 16;
        if (left > 1) bits |= std::uint32_t{bytes[i + 1]} << 8;
        if (left > 2) bits |= bytes[i + 2];
        text += kBase64[bits >> 18];
        text += kBase64[bits >> 12 & 63];
        text += left > 1 ? kBase64[bits >> 6 & 63] : '=';
        text += left > 2 ? kBase64[bits & 63] : '=';
    }
    return text;
}

void refuseUri(std::string_view uri, const std::string& why, const std::string& place) {
    failFile(ErrorCode::forbiddenPath, "the URI " + inQuotes(uri, 200) + " " + why, place);
}

UriKind uriKind(std::string_view uri) {
    const std::size_t length = schemeLength(uri);
    // A single letter is a Windows drive, because no scheme is that short.
    if (length <= 1) return UriKind::path;
    return equalsIgnoringCase(uri.substr(0, length), "data") ? UriKind::data : UriKind::otherScheme;
}

DataUri decodeDataUri(std::string_view uri, const std::string& place) {
    const std::size_t comma = uri.find(',');
    if (uriKind(uri) != UriKind::data || comma == std::string_view::npos)
        failFile(ErrorCode::invalidFile, "a data URI has no comma before its data", place);
    std::string_view header = uri.substr(5, comma - 5);
    const std::string_view data = uri.substr(comma + 1);
    constexpr std::string_view kMark = ";base64";
    const bool is_base64 =
        header.size() >= kMark.size() && equalsIgnoringCase(header.substr(header.size() - kMark.size()), kMark);
    if (is_base64) header.remove_suffix(kMark.size());
    DataUri result;
    result.mime_type = std::string(header.substr(0, header.find(';')));
    if (is_base64) {
        // Escapes are rare in base64, so they are decoded only if there are any.
        result.bytes = data.find('%') == std::string_view::npos ? decodeBase64(data, place)
                                                                : decodeBase64(percentDecode(data), place);
    } else {
        const std::string text = percentDecode(data);
        result.bytes.assign(text.begin(), text.end());
    }
    return result;
}

std::string encodeDataUri(std::string_view mime_type, const Bytes& bytes) {
    return "data:" + std::string(mime_type) + ";base64," + encodeBase64(bytes);
}

std::string percentDecode(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && text.size() - i > 2 && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0) {
            result += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

std::string percentEncode(std::string_view path, std::string_view kept) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string result;
    for (const char c : path) {
        if (isLetter(c) || isDigit(c) || kept.find(c) != std::string_view::npos) {
            result += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            result += '%';
            result += kHex[byte >> 4];
            result += kHex[byte & 15];
        }
    }
    return result;
}

std::string pathOfUri(std::string_view uri) {
    const std::string path = withSlashes(percentDecode(uri));
    return Path(fs::path(Path(path)).lexically_normal()).string();
}

std::string checkedPathOfUri(std::string_view uri, bool allow_external, const std::string& place) {
    if (uriKind(uri) != UriKind::path)
        refuseUri(uri, "has a scheme that tspace never loads; use a data URI or the path of a file", place);
    if (uri.starts_with(':'))
        failFile(ErrorCode::invalidFile, "the URI " + inQuotes(uri, 200) + " has an empty scheme before its colon",
                 place);
    std::string path = pathOfUri(uri);
    if (path.empty() || path.find('\0') != std::string::npos)
        failFile(ErrorCode::invalidFile, "a URI does not name a file", place);
    if (allow_external) return path;
    if (const char* why = leadsAway(fs::path{Path(path)})) refuseUri(uri, std::string(why) + kFollowed, place);
    return path;
}

}  // namespace tspace
