// SPDX-License-Identifier: MIT
// The tags of an XML text, one after the other. Broken text ends early.
#pragma once

#include <optional>
#include <string_view>

namespace tspace::import {

struct XmlTag {
    std::string_view name = {}, attributes = {};
    bool is_end = false;  ///< </name>, and not <name/>

    /// Its value as it stands, without a look at entities; empty: it is not there. Linear in `attributes`.
    [[nodiscard]] std::string_view attribute(std::string_view wanted) const;
};

class XmlTags {
  public:
    explicit XmlTags(std::string_view text) : text_(text) {}

    /// Passes over comments, CDATA, instructions and declarations.
    std::optional<XmlTag> next();
    /// What stands between the last tag and the next.
    [[nodiscard]] std::string_view textUntilTag() const { return text_.substr(at_, text_.find('<', at_) - at_); }

  private:
    /// Moves behind `end`; to the end of the text where it is not there.
    void skipPast(std::string_view end);

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace tspace::import
