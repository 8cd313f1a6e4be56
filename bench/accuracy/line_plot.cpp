// SPDX-License-Identifier: MIT
#include "line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tspace::accuracy {

namespace {

constexpr double kLeft = 70, kTop = 44, kWidth = 520, kHeight = 360, kLegend = 130;

/// Logarithmic mapping from values (low to high) to positions on the plot (from, to).
struct Axis {
    double low, high, from, to;

    [[nodiscard]] double place(double value) const {
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
};

std::string text(double x, double y, const std::string& anchor, const std::string& content) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, content);
}

std::string segment(double x1, double y1, double x2, double y2, const char* color) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, color);
}

/// Returns an axis of whole powers of ten that includes all values.
Axis heightAxis(const std::vector<Line>& lines) {
    double low = 1e300, high = 1e-300;
    for (const Line& line : lines) {
        for (const double y : line.y) {
            if (!(y > 0)) continue;
            low = std::min(low, y);
            high = std::max(high, y);
        }
    }
    return {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high))), kTop + kHeight, kTop};
}

std::string grid(const Axis& x_axis, const Axis& y_axis, const std::vector<double>& x_ticks) {
    std::string svg = "<g fill=\"none\">\n";
    for (const double x : x_ticks) svg += segment(x_axis.place(x), kTop, x_axis.place(x), kTop + kHeight, "#e0e0e0");
    for (double y = y_axis.low; y < 1.5 * y_axis.high; y *= 10)
        svg += segment(kLeft, y_axis.place(y), kLeft + kWidth, y_axis.place(y), "#e0e0e0");
    svg += "</g>\n";
    for (const double x : x_ticks) svg += text(x_axis.place(x), kTop + kHeight + 18, "middle", fmt::format("{:g}", x));
    for (double y = y_axis.low; y < 1.5 * y_axis.high; y *= 10)
        svg += text(kLeft - 8, y_axis.place(y) + 5, "end", fmt::format("{:g}", y));
    return svg;
}

/// Draws `lines` in order, with dots, and labels at the right.
std::string drawn(const Axis& x_axis, const Axis& y_axis, const std::vector<Line>& lines) {
    std::string svg;
    double legend = kTop + 10;
    for (const Line& line : lines) {
        std::string path, dots;
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            if (!(line.y[i] > 0)) continue;
            const double x = x_axis.place(line.x[i]), y = y_axis.place(line.y[i]);
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
            dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", x, y);
        }
        const std::string color = colorOf(line.name);
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, color);
        svg += fmt::format("<g fill=\"{}\">{}</g>\n", color, dots);
        svg += fmt::format("<path d=\"M{0:.1f} {2:.1f}L{1:.1f} {2:.1f}\" stroke=\"{3}\" stroke-width=\"3\"/>\n",
                           kLeft + kWidth + 12, kLeft + kWidth + 34, legend - 5, color);
        svg += text(kLeft + kWidth + 40, legend, "start", line.name);
        legend += 22;
    }
    return svg;
}

}  // namespace

std::string colorOf(const std::string& name) {
    static const std::map<std::string, std::string> colors = {
        {"mikktspace", "#1565c0"},    {"lengyel", "#8d6e63"}, {"uniform", "#7b1fa2"},    {"angle", "#26a69a"},
        {"area", "#ef6c00"},          {"flat", "#9e9e9e"},    {"fast", "#c0ca33"},       {"best", "#c62828"},
        {"floor", "#212121"},         {"max", "#2e7d32"},     {"angle-area", "#1565c0"}, {"best, 0 steps", "#ef9a9a"},
        {"best, 2 steps", "#6d1b1b"},
    };
    const auto found = colors.find(name);
    return found == colors.end() ? "#000" : found->second;
}

std::string linePlot(const std::string& title, const std::string& x_title, const std::string& y_title,
                     const std::vector<double>& x_ticks, const std::vector<Line>& lines) {
    const double width = kLeft + kWidth + kLegend, height = kTop + kHeight + 50;
    const Axis x_axis{x_ticks.front(), x_ticks.back(), kLeft, kLeft + kWidth};
    const Axis y_axis = heightAxis(lines);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
        "role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" "
        "fill=\"#222\">\n<title>{2}</title>\n"
        "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n",
        width, height, title);
    svg += fmt::format("<text x=\"{:g}\" y=\"24\" font-size=\"16\" font-weight=\"bold\">{}</text>\n", kLeft, title);
    svg += grid(x_axis, y_axis, x_ticks);
    svg += text(kLeft + kWidth / 2, kTop + kHeight + 40, "middle", x_title);
    svg += fmt::format("<text transform=\"translate(18 {:g}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       kTop + kHeight / 2, y_title);
    return svg + drawn(x_axis, y_axis, lines) + "</svg>\n";
}

}  // namespace tspace::accuracy
