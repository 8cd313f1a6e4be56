// SPDX-License-Identifier: MIT
// What pages for people have in common: one HTML file each that loads nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tspace {

/// Pictures of one model take no more than this, as they stand in the page, and those of a page no more than that.
inline constexpr std::size_t kMostModelBytes = 1500000, kMostPageBytes = 12000000;
/// Size in pixels of a picture of a place.
inline constexpr std::uint32_t kPlaceWidth = 320, kPlaceHeight = 240;

/// The page up to the contents of <main>. `title`: not escaped, so no text from files.
std::string pageHead(std::string_view title);
std::string pageEnd();

/// When a page was made, and by which command.
struct PageOrigin {
    std::string date = {};     ///< "2026-11-26 07:41 UTC"
    std::string command = {};  ///< as a shell takes it: "tspace check helmet.glb --html report.html"
};
/// A paragraph that says so, with the version.
std::string originHtml(const PageOrigin& origin);

/// A picture with a caption, which is its alternative text too. `caption`: text. Nothing where `png` is empty.
std::string figureHtml(const std::vector<std::uint8_t>& png, std::uint32_t width, std::uint32_t height,
                       std::string_view caption);
/// The replacement of a missing picture. `sentence`: text.
std::string noFigureHtml(std::string_view sentence);
/// Figures side by side; nothing for none.
std::string figuresHtml(const std::string& figures);

/// Opens a table that scrolls where a window is narrow, by keys too; closed by </table></div>.
inline constexpr std::string_view kWideTable = "<div class=\"scroll\" tabindex=\"0\"><table>";

/// A word as a shell of POSIX takes it.
std::string shellWord(const std::string& word);

/// Text from a file or of a user, fit to stand in HTML or in quotation marks as a value. Bytes that are no UTF-8 are for
/// the browser to replace.
std::string htmlText(std::string_view text);

}  // namespace tspace
