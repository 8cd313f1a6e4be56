// SPDX-License-Identifier: MIT
#include "near_origin/xml_tags.h"

#include <algorithm>

#include "near_origin/coordinates.h"

namespace tspace::import {

std::string_view XmlTag::attribute(std::string_view wanted) const {
    for (std::size_t at = 0; at < attributes.size();) {
        const std::size_t equals = attributes.find('=', at);
        const std::size_t quote = attributes.find_first_of("\"'", at);
        if (equals == std::string_view::npos || quote == std::string_view::npos || quote < equals) return {};
        const std::size_t end = attributes.find(attributes[quote], quote + 1);
        if (end == std::string_view::npos) return {};
        const std::string_view word = nextWord(attributes.substr(0, equals), at);
        if (word == wanted) return attributes.substr(quote + 1, end - quote - 1);
        at = end + 1;
    }
    return {};
}

void XmlTags::skipPast(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
}

std::optional<XmlTag> XmlTags::next() {
    for (;;) {
        const std::size_t begin = text_.find('<', at_);
        if (begin == std::string_view::npos) return {};
        at_ = begin + 1;
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("!--")) {
            skipPast("-->");
        } else if (rest.starts_with("![CDATA[")) {
            skipPast("]]>");
        } else if (rest.starts_with('?') || rest.starts_with('!')) {
            skipPast(">");
        } else {
            break;
        }
    }
    // A '>' may stand in a value.
    std::size_t end = at_;
    for (char quote = 0; end < text_.size() && (quote != 0 || text_[end] != '>'); ++end) {
        const char c = text_[end];
        if (quote == c) {
            quote = 0;
        } else if (quote == 0 && (c == '"' || c == '\'')) {
            quote = c;
        }
    }
    if (end == text_.size()) return {};
    std::string_view inside = text_.substr(at_, end - at_);
    at_ = end + 1;
    XmlTag tag{.is_end = inside.starts_with('/')};
    if (tag.is_end) inside.remove_prefix(1);
    if (inside.ends_with('/')) inside.remove_suffix(1);
    std::size_t name_end = 0;
    tag.name = nextWord(inside, name_end);
    tag.attributes = inside.substr(name_end);
    return tag;
}

}  // namespace tspace::import
