// SPDX-License-Identifier: MIT

#include "commands/shared/picture/legend.h"

#include <algorithm>
#include <array>
#include <utility>

#include "commands/shared/picture/colors.h"
#include "core/base/vec_math.h"

namespace tspace {
namespace {

constexpr std::int64_t kDotRows = 7, kDotColumns = 5;

/// Bitmaps of the digits: rows from the top, with the leftmost dot in the highest of five bits.
constexpr std::array<std::array<std::uint8_t, kDotRows>, 10> kDigits = {{
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111},
    {0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110},
    {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010},
    {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110},
    {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000},
    {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110},
    {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100},
}};

constexpr std::array<std::array<std::uint8_t, kDotRows>, 26> kLetters = {{
    {0b01110, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110},
    {0b01110, 0b10001, 0b10000, 0b10000, 0b10000, 0b10001, 0b01110},
    {0b11110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b11110},
    {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b11111},
    {0b11111, 0b10000, 0b10000, 0b11110, 0b10000, 0b10000, 0b10000},
    {0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110},
    {0b10001, 0b10001, 0b10001, 0b11111, 0b10001, 0b10001, 0b10001},
    {0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110},
    {0b00111, 0b00010, 0b00010, 0b00010, 0b00010, 0b10010, 0b01100},
    {0b10001, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010, 0b10001},
    {0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b10000, 0b11111},
    {0b10001, 0b11011, 0b10101, 0b10101, 0b10001, 0b10001, 0b10001},
    {0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001},
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10000, 0b10000, 0b10000},
    {0b01110, 0b10001, 0b10001, 0b10001, 0b10101, 0b10010, 0b01101},
    {0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001},
    {0b01111, 0b10000, 0b10000, 0b01110, 0b00001, 0b00001, 0b11110},
    {0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100},
    {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110},
    {0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01010, 0b00100},
    {0b10001, 0b10001, 0b10001, 0b10101, 0b10101, 0b11011, 0b10001},
    {0b10001, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001, 0b10001},
    {0b10001, 0b10001, 0b01010, 0b00100, 0b00100, 0b00100, 0b00100},
    {0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b11111},
}};
constexpr std::array<std::uint8_t, kDotRows> kNoDots{},
    kPlus = {0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000},
    kMinus = {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000},
    kEquals = {0b00000, 0b00000, 0b11111, 0b00000, 0b11111, 0b00000, 0b00000},
    kComma = {0b00000, 0b00000, 0b00000, 0b00000, 0b00110, 0b00100, 0b01000},
    kColon = {0b00000, 0b00110, 0b00110, 0b00000, 0b00110, 0b00110, 0b00000};

const std::array<std::uint8_t, kDotRows>& dotsOf(char c) {
    if (c >= '0' && c <= '9') return kDigits[static_cast<std::size_t>(c - '0')];
    if (c >= 'A' && c <= 'Z') return kLetters[static_cast<std::size_t>(c - 'A')];
    switch (c) {
        case '+': return kPlus;
        case '-': return kMinus;
        case '=': return kEquals;
        case ',': return kComma;
        case ':': return kColon;
        default: return kNoDots;
    }
}

// Sizes of the legend, in dots.
constexpr std::int64_t kLetterRows = kDotRows, kLineRows = kDotRows + 4, kMargin = 6, kBarRows = 8, kGap = 14;

/// Returns the size of a dot in pixels. Letters are 7 dots high: 14 pixels in a picture of width 512, and 21 in one of
/// width 1024.
std::int64_t dotOf(std::uint32_t width) { return std::max<std::int64_t>(1, (std::int64_t{width} + 170) / 341); }

/// Draws capital letters, digits and + - = , : with 5 x 7 dots each and a gap of one dot. Other characters are drawn as
/// spaces.
void drawText(RgbImage& image, std::int64_t left, std::int64_t top, std::int64_t dot, std::string_view text) {
    for (const char c : text) {
        const std::array<std::uint8_t, kDotRows>& rows = dotsOf(c);
        for (std::int64_t row = 0; row < kDotRows; ++row) {
            const unsigned dots = rows[static_cast<std::size_t>(row)];
            for (std::int64_t column = 0; column < kDotColumns; ++column) {
                if ((dots >> (kDotColumns - 1 - column) & 1U) == 0) continue;
                fillRect(image, left + column * dot, top + row * dot, dot, dot, kPictureInk);
            }
        }
        left += (kDotColumns + 1) * dot;
    }
}

void drawHeatScale(RgbImage& image, std::int64_t top, std::int64_t dot) {
    const std::int64_t margin = kMargin * dot, bar_height = kBarRows * dot;
    const auto stops = static_cast<std::int64_t>(kHeatStops.size());
    const std::int64_t step = (std::int64_t{image.width} - 2 * margin - 18 * dot) / (stops - 1);
    for (std::int64_t i = 0; i + 1 < stops; ++i) {
        const HeatStop &from = kHeatStops[static_cast<std::size_t>(i)],
                       &to = kHeatStops[static_cast<std::size_t>(i) + 1];
        for (std::int64_t x = 0; x < step; ++x) {
            const float t = static_cast<float>(x) / static_cast<float>(step);
            fillRect(image, margin + i * step + x, top, 1, bar_height,
                     heatColor(from.degrees + t * (to.degrees - from.degrees)));
        }
    }
    for (std::int64_t i = 0; i < stops; ++i) {
        const std::int64_t x = margin + i * step;
        fillRect(image, x, top, dot, bar_height + dot, kPictureInk);
        drawText(image, x, top + bar_height + 2 * dot, dot,
                 std::to_string(static_cast<int>(kHeatStops[static_cast<std::size_t>(i)].degrees)));
    }
}

/// Returns the distance in dots from the left end of an entry to that of the next entry.
std::int64_t advanceOf(const LegendEntry& entry) {
    const std::int64_t text = static_cast<std::int64_t>(entry.text.size()) * (kDotColumns + 1);
    return (entry.color ? kLetterRows + 3 : 0) + text + kGap;
}

/// Positions of the entries: dots from the left, and line number. Each line contains as many entries as fit.
struct Layout {
    std::vector<std::pair<std::int64_t, std::int64_t>> places = {};
    std::int64_t line_count = 0;
};
Layout layOut(const std::vector<LegendEntry>& entries, std::uint32_t width) {
    const std::int64_t room = width / dotOf(width) - kMargin;
    Layout layout;
    std::int64_t left = kMargin;
    for (const LegendEntry& entry : entries) {
        const std::int64_t advance = advanceOf(entry);
        if (layout.line_count == 0 || left + advance - kGap > room) {
            ++layout.line_count;
            left = kMargin;
        }
        layout.places.emplace_back(left, layout.line_count - 1);
        left += advance;
    }
    return layout;
}

std::string upperCase(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return result;
}

/// Returns entries that are short enough for pictures of 200 columns.
std::vector<LegendEntry> tangentEntries(const TangentSources& sources, Method method, const std::string& before = {}) {
    const std::string computed = "BY " + upperCase(methodName(method));
    if (sources.stored && sources.computed)
        return {{{}, {}, before + "TANGENTS OF THE FILE,"}, {{}, {}, "ELSE " + computed}};
    if (sources.stored) return {{{}, {}, before + "TANGENTS OF THE FILE"}};
    if (sources.computed) return {{{}, {}, before + "TANGENTS " + computed}};
    return {{{}, {}, before + (sources.has_map ? "NO TANGENTS, FLAT" : "NO NORMAL MAP")}};
}

void appendEntries(std::vector<LegendEntry>& entries, const std::vector<LegendEntry>& more) {
    entries.insert(entries.end(), more.begin(), more.end());
}

}  // namespace

Legend legendOf(RenderShow show, const TangentSources& sources, Method method) {
    constexpr Vec3 kRed{1, 0.5f, 0.5f}, kGreen{0.5f, 1, 0.5f}, kBlue{0.5f, 0.5f, 1};
    const std::vector<LegendEntry> axes = {{kRed, {}, "+X"}, {kGreen, {}, "+Y"}, {kBlue, {}, "+Z"}};
    const std::vector<LegendEntry> tangents = tangentEntries(sources, method);
    Legend legend;
    std::vector<LegendEntry>& entries = legend.entries;
    const auto say = [&](std::string text) { entries.push_back({{}, {}, std::move(text)}); };
    const auto labelMissing = [&](const char* what) {
        if (sources.missing) entries.push_back({kNoData, {}, what});
    };
    switch (show) {
        case RenderShow::lit:
            say("LIT BY ONE LAMP");
            appendEntries(entries, tangents);
            break;
        case RenderShow::normals:
            say("NORMALS");
            appendEntries(entries, axes);
            break;
        case RenderShow::mapped:
            say("NORMALS WITH MAP");
            appendEntries(entries, axes);
            appendEntries(entries, tangents);
            break;
        case RenderShow::tangents:
            entries = axes;
            labelMissing("NO TANGENTS");
            if (sources.stored || sources.computed) appendEntries(entries, tangents);
            break;
        case RenderShow::sign:
            entries = {{kSignPlus, {}, "W = +1"},
                       {kSignMinus, {}, "W = -1"},
                       {kSignMinus, kSignStripes, "UV MIRRORED"},
                       {kSignPlus, kSignWrong, "WRONG SIGN"},
                       {kSignNeither, {}, "NEITHER"}};
            labelMissing("NO TANGENTS");
            if (sources.stored || sources.computed) appendEntries(entries, tangents);
            break;
        case RenderShow::error:
            legend.has_heat_scale = true;
            say("DEGREES FROM " + (sources.has_other ? "THE OTHER MODEL" : upperCase(methodName(method))));
            labelMissing("NOT COMPARED");
            break;
        case RenderShow::uv:
            entries = {{kIslandColor, {}, "AN ISLAND"},
                       {kIslandColor, 0.45f * kIslandColor, "MIRRORED"},
                       {{}, {}, "FRAME: 0 TO 1"}};
            break;
        case RenderShow::both: break;
    }
    return legend;
}

Legend legendOfBoth(const TangentSources& left, const TangentSources& right, Method method) {
    Legend legend{.entries = tangentEntries(left, method, "LEFT: ")};
    appendEntries(legend.entries, tangentEntries(right, method, "RIGHT: "));
    return legend;
}

std::uint32_t legendRows(const Legend& legend, std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t kMinWidth = 200, kMinShare = 3;
    if (width < kMinWidth) return 0;
    const std::int64_t lines = layOut(legend.entries, width).line_count;
    if (lines == 0 && !legend.has_heat_scale) return 0;
    const std::int64_t scale = legend.has_heat_scale ? kBarRows + kDotRows + 5 : 0;
    const auto rows = static_cast<std::uint32_t>((kMargin + scale + lines * kLineRows) * dotOf(width));
    return rows > height / kMinShare ? 0 : rows;
}

void addLegend(const Legend& legend, std::uint32_t rows, RgbImage& image) {
    if (rows == 0) return;
    image.height += rows;
    image.rgb.resize(std::size_t{3} * image.width * image.height);
    const std::int64_t dot = dotOf(image.width);
    std::int64_t top = std::int64_t{image.height} - rows;
    fillRect(image, 0, top, image.width, rows, kBackground);
    top += kMargin / 2 * dot;
    if (legend.has_heat_scale) {
        drawHeatScale(image, top, dot);
        top += (kBarRows + kDotRows + 6) * dot;
    }
    const Layout layout = layOut(legend.entries, image.width);
    for (std::size_t i = 0; i < legend.entries.size(); ++i) {
        const LegendEntry& entry = legend.entries[i];
        const std::int64_t side = kLetterRows * dot, y = top + layout.places[i].second * kLineRows * dot;
        std::int64_t x = layout.places[i].first * dot;
        if (entry.color) {
            fillRect(image, x, y, side, side, *entry.color);
            for (std::int64_t k = 0; entry.stripes && k < kLetterRows; k += 2)
                fillRect(image, x + k * dot, y, dot, side, *entry.stripes);
            x += side + 3 * dot;
        }
        drawText(image, x, y, dot, entry.text);
    }
}

}  // namespace tspace
