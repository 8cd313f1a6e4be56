// SPDX-License-Identifier: MIT
// Text encodings whose code units are larger than a byte: UTF-16 and UTF-32, which editors and PowerShell write.
#pragma once

#include <string>
#include <string_view>

namespace tspace {

/// Returns "UTF-16" or "UTF-32" if the text has the byte order mark of that encoding, or if its first two characters
/// are ASCII characters of 2 or 4 bytes; otherwise an empty text.
std::string_view wideEncoding(std::string_view text);

/// Returns the message for a file in an encoding that wideEncoding() returned.
std::string wideTextMessage(std::string_view encoding);

/// Returns the text without the byte order mark of UTF-8. Fails with invalidFile if the text is UTF-16 or UTF-32; the
/// message begins with `prefix`.
std::string_view narrowText(std::string_view text, const std::string& prefix = {});

}  // namespace tspace
