// SPDX-License-Identifier: MIT
// Common parts of HTML reports. Each report is one HTML file that loads nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tspace {

/// Maximum size of the encoded pictures of one model, and of a page.
inline constexpr std::size_t kMaxModelBytes = 1500000, kMaxPageBytes = 12000000;
/// Size in pixels of a picture of a location.
inline constexpr std::uint32_t kPlaceWidth = 320, kPlaceHeight = 240;

/// Returns the page up to the contents of <main>. `title` is not escaped and must not contain text from files.
std::string pageHead(std::string_view title);
std::string pageEnd();

/// Date of a page, and the command that created it.
struct PageOrigin {
    std::string date = {};     ///< "2026-11-26 07:41 UTC"
    std::string command = {};  ///< in shell syntax: "tspace check helmet.glb --html report.html"
};
/// Returns a paragraph with the date, the command and the version.
std::string originHtml(const PageOrigin& origin);

/// Returns a picture with a caption, which is also its alternative text. `caption`: plain text. Returns nothing if
/// `png` is empty.
std::string figureHtml(const std::vector<std::uint8_t>& png, std::uint32_t width, std::uint32_t height,
                       std::string_view caption);
/// Returns the HTML that replaces a missing picture. `sentence`: plain text.
std::string noFigureHtml(std::string_view sentence);
/// Returns figures side by side, or nothing if there are none.
std::string figuresHtml(const std::string& figures);

/// Opens a table that scrolls in a narrow window, also by keyboard; closed by </table></div>.
inline constexpr std::string_view kWideTable = "<div class=\"scroll\" tabindex=\"0\"><table>";

/// Quotes a word for a POSIX shell.
std::string shellWord(const std::string& word);

/// Escapes text from a file or a user for HTML and for quoted attribute values. Invalid UTF-8 is left to the browser.
std::string htmlText(std::string_view text);

}  // namespace tspace
