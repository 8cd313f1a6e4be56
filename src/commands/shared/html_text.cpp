// SPDX-License-Identifier: MIT
#include "commands/shared/html_text.h"

namespace tspace {

std::string htmlText(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
                    result += "&#" + std::to_string(static_cast<int>(c)) + ";";
                else
                    result += c;
        }
    }
    return result;
}

}  // namespace tspace
