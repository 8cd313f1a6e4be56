// SPDX-License-Identifier: MIT
// Text in HTML.
#pragma once

#include <string>
#include <string_view>

namespace tspace {

/// Text from a file or of a user, fit to stand in HTML or in quotation marks as a value. Bytes that are no UTF-8 are for
/// the browser to replace.
std::string htmlText(std::string_view text);

}  // namespace tspace
