// SPDX-License-Identifier: MIT
// Parsing and checking of URIs in model files.
#pragma once

#include <string>
#include <string_view>

#include "model/io/bytes.h"
#include "model/io/path.h"

namespace tspace {

// URIs in model files: data URIs, and paths relative to the model's folder; other paths are followed only if the caller
// allows it.

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

/// Decodes percent escapes (%41 -> A). A percent sign without a valid escape is kept, because file names contain such
/// signs.
std::string percentDecode(std::string_view text);

/// Escapes characters that are not allowed in the path of a URI: all except letters, digits and `kept`.
std::string percentEncode(std::string_view path, std::string_view kept = "-._~/!$&'()*+,;=@");

/// Returns the path of a relative URI: escapes are decoded, backslashes (written by some exporters) become slashes, "."
/// is removed, and ".." remains only at the front.
std::string pathOfUri(std::string_view uri);

/// Returns pathOfUri() after checks. Fails with forbiddenPath if the path is absolute (including Windows drives), has a
/// scheme or leaves the folder. `allow_external` allows all of these except a scheme.
std::string checkedPathOfUri(std::string_view uri, bool allow_external, const std::string& place);

/// End of messages about rejected paths, which names the option that allows them.
inline constexpr const char* kFollowed = " (--allow-external follows it)";

/// Fails with forbiddenPath. `why`: the fault, as a predicate whose subject is the URI.
[[noreturn]] void refuseUri(std::string_view uri, const std::string& why, const std::string& place);

}  // namespace tspace
