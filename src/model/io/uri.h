// SPDX-License-Identifier: MIT
// URIs as model files use them.
#pragma once

#include <string>
#include <string_view>

#include "model/io/bytes.h"
#include "model/io/path.h"

namespace tspace {

// URIs as model files use them: data URIs, and paths relative to the model's folder, which are the only ones
// that are followed unless the caller allows more.

enum class UriKind { data, path, otherScheme };

UriKind uriKind(std::string_view uri);

struct DataUri {
    std::string mime_type = {};
    Bytes bytes = {};
};

/// Decodes a data URI, base64 or percent-encoded. Fails with invalidFile at `place`.
DataUri decodeDataUri(std::string_view uri, const std::string& place);

std::string encodeBase64(const Bytes& bytes);

std::string encodeDataUri(std::string_view mime_type, const Bytes& bytes);

/// %41 -> A. A percent sign that starts no valid escape stays as it is, because file names contain them.
std::string percentDecode(std::string_view text);

/// Escapes what may not stand in the path of a URI.
std::string percentEncode(std::string_view path);

/// The path that a relative URI stands for: escapes decoded, and Windows' separators, which some exporters write, as
/// slashes, without "." and with ".." only at the front.
std::string pathOfUri(std::string_view uri);

/// pathOfUri with checks. Fails with forbiddenPath when the path is absolute (also at a drive of Windows), has a scheme or
/// leads out of the folder; `allow_external` lifts all of these but the scheme.
std::string checkedPathOfUri(std::string_view uri, bool allow_external, const std::string& place);

/// How messages on refused paths end: the option that lifts the rule.
inline constexpr const char* kFollowed = " (--allow-external follows it)";

/// Fails with forbiddenPath. `why`: the fault, a predicate of the URI.
[[noreturn]] void refuseUri(std::string_view uri, const std::string& why, const std::string& place);

}  // namespace tspace
