// SPDX-License-Identifier: MIT
#include "model/io/text_encoding.h"

#include "model/io/file_error.h"

namespace tspace {

std::string_view wideEncoding(std::string_view text) {
    using std::operator""sv;
    if (text.starts_with("\xff\xfe\0\0"sv) || text.starts_with("\0\0\xfe\xff"sv)) return "UTF-32";
    if (text.starts_with("\xff\xfe"sv) || text.starts_with("\xfe\xff"sv)) return "UTF-16";
    // Text in an encoding with code units of one byte contains no NUL.
    std::string zeros;
    for (const char byte : text.substr(0, 8)) zeros += byte == '\0' ? '0' : 'x';
    if (zeros == "x000x000" || zeros == "000x000x") return "UTF-32";
    return zeros.starts_with("x0x0") || zeros.starts_with("0x0x") ? "UTF-16" : "";
}

std::string wideTextMessage(std::string_view encoding) {
    return "the text is encoded as " + std::string(encoding) + ", which is not supported; save the file as UTF-8";
}

std::string_view narrowText(std::string_view text, const std::string& prefix) {
    const std::string_view encoding = wideEncoding(text);
    if (!encoding.empty()) failFile(ErrorCode::invalidFile, prefix + wideTextMessage(encoding));
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

}  // namespace tspace
