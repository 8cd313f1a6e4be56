// SPDX-License-Identifier: MIT
// FBX as text: keys, their values, and blocks of more keys in braces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "near_origin/coordinates.h"

namespace tspace::import {

/// Keys from the root to the innermost block; empty where a block has none so far.
using FbxPath = std::vector<std::string_view>;

/// Calls back with every value: `visit(path, i, text)`, the i-th value of the last key of the path. `text` is without
/// quotes, and a part of the file's. Linear, no recursion.
template <class Visit>
void forEachFbxValue(std::string_view text, Visit&& visit) {
    FbxPath path(1);
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (c == ';') {
            at = std::min(text.find('\n', at), text.size());
        } else if (c == '"') {
            const std::size_t end = text.find('"', at + 1);
            if (end == std::string_view::npos) return;
            visit(path, count++, text.substr(at + 1, end - at - 1));
            at = end + 1;
        } else if (c == '{') {
            path.emplace_back();
            ++at;
        } else if (c == '}') {
            if (path.size() == 1) return;
            path.pop_back();
            ++at;
        } else if (isBlank(c) || c == ',') {
            ++at;
        } else {
            const std::size_t end = std::min(text.find_first_of(" \t\r\n\v\f,;:{}\"", at), text.size());
            const std::string_view word = text.substr(at, end - at);
            at = end;
            if (end < text.size() && text[end] == ':') {
                path.back() = word;
                count = 0;
                ++at;
            } else {
                visit(path, count++, word);
            }
        }
    }
}

}  // namespace tspace::import
