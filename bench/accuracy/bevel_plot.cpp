// SPDX-License-Identifier: MIT
#include "bevel_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tspace::accuracy {

namespace {

constexpr int kPixels = 48;  // pixels along each side of a panel
constexpr double kSide = 168, kGap = 16, kTop = 48, kName = 20;
constexpr std::size_t kColumns = 4;

struct Step {
    double below_deg;
    const char* color;
};
constexpr Step kScale[] = {{0.1, "#ffffff"}, {0.5, "#fff9c4"}, {1, "#ffe082"},  {2, "#ffb74d"},
                           {5, "#ff7043"},   {10, "#d32f2f"},  {20, "#7b1fa2"}, {180, "#311b92"}};
constexpr std::size_t kSteps = std::size(kScale);

std::size_t stepOf(double error_deg) {
    const auto* found = std::find_if(std::begin(kScale), std::end(kScale),
                                     [&](const Step& step) { return error_deg < step.below_deg; });
    return std::min<std::size_t>(static_cast<std::size_t>(found - kScale), kSteps - 1);
}

double turn(const Vec3& a, const Vec3& b, double x, double y) {
    return (double{b.x} - a.x) * (y - a.y) - (double{b.y} - a.y) * (x - a.x);
}

/// Returns the error at the position (x, y) of the flat face.
double errorAt(const TestMesh& mesh, const BevelPanel& panel, const DVec3& exact, double x, double y) {
    for (const std::uint32_t triangle : mesh.measured) {
        const std::size_t first = 3 * std::size_t{triangle};
        const Vec3& a = mesh.positions[mesh.indices[first]];
        const Vec3& b = mesh.positions[mesh.indices[first + 1]];
        const Vec3& c = mesh.positions[mesh.indices[first + 2]];
        const double u = turn(b, c, x, y), v = turn(c, a, x, y), w = turn(a, b, x, y);
        if (u < 0 || v < 0 || w < 0) continue;
        const DVec3 sum = u * toDouble(panel.vectors[first]) + v * toDouble(panel.vectors[first + 1]) +
                          w * toDouble(panel.vectors[first + 2]);
        return angleDeg(sum, exact);
    }
    return 0;
}

/// Returns one path per color; adjacent pixels of a row with equal color become one rectangle.
std::string pixels(const TestMesh& mesh, const BevelPanel& panel, const DVec3& exact, double left, double top) {
    std::string paths[kSteps];
    const double size = kSide / kPixels;
    for (int row = 0; row < kPixels; ++row) {
        const auto step = [&](int column) {
            return stepOf(errorAt(mesh, panel, exact, 2 * (column + 0.5) / kPixels - 1, 1 - 2 * (row + 0.5) / kPixels));
        };
        for (int column = 0; column < kPixels;) {
            const std::size_t color = step(column);
            int end = column + 1;
            while (end < kPixels && step(end) == color) ++end;
            paths[color] += fmt::format("M{:g} {:g}h{:g}v{:g}h{:g}z", left + column * size, top + row * size,
                                        (end - column) * size, size, (column - end) * size);
            column = end;
        }
    }
    std::string svg;
    for (std::size_t i = 0; i < kSteps; ++i) {
        if (!paths[i].empty()) svg += fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", paths[i], kScale[i].color);
    }
    return svg;
}

std::string edges(const TestMesh& mesh, double left, double top) {
    std::string path;
    for (const std::uint32_t triangle : mesh.measured) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[mesh.indices[3 * std::size_t{triangle} + k]];
            path += fmt::format("{}{:g} {:g}", k == 0 ? "M" : "L", left + kSide * (p.x + 1) / 2,
                                top + kSide * (1 - p.y) / 2);
        }
        path += "z";
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#000\" stroke-opacity=\"0.35\" stroke-width=\"0.7\"/>\n",
                       path);
}

std::string legend(double left, double top) {
    std::string svg;
    for (std::size_t i = 0; i < kSteps; ++i) {
        const double x = left + 78.0 * static_cast<double>(i);
        svg += fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"16\" height=\"14\" fill=\"{}\" stroke=\"#666\"/>\n", x,
                           top, kScale[i].color);
        const std::string words = i + 1 < kSteps ? fmt::format("&lt; {:g}°", kScale[i].below_deg) : "more";
        svg += fmt::format("<text x=\"{:g}\" y=\"{:g}\">{}</text>\n", x + 21, top + 12, words);
    }
    return svg;
}

}  // namespace

std::string bevelPlot(const std::string& title, const TestMesh& mesh, const DVec3& exact,
                      const std::vector<BevelPanel>& panels) {
    const auto rows = static_cast<double>((panels.size() + kColumns - 1) / kColumns);
    const double width = kGap + kColumns * (kSide + kGap), height = kTop + rows * (kSide + kName + kGap) + 30;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
        "role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" "
        "fill=\"#222\">\n<title>{2}</title>\n"
        "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n"
        "<text x=\"{3:g}\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{2}</text>\n",
        width, height, title, kGap);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const double left = kGap + static_cast<double>(i % kColumns) * (kSide + kGap);
        const double top = kTop + static_cast<double>(i / kColumns) * (kSide + kName + kGap);
        svg += fmt::format("<text x=\"{:g}\" y=\"{:g}\">{}</text>\n", left, top + 10, panels[i].name);
        svg += pixels(mesh, panels[i], exact, left, top + kName) + edges(mesh, left, top + kName);
    }
    return svg + legend(kGap, height - 26) + "</svg>\n";
}

}  // namespace tspace::accuracy
