// SPDX-License-Identifier: MIT
#include "plots.h"

#include <filesystem>
#include <fstream>

#include "bevel_plot.h"
#include "figures.h"
#include "line_plot.h"

namespace tspace::accuracy {

namespace {

/// Returns a line with the figure at each size for which a study has it.
template <class FigureAt>
Line lineOf(const std::string& name, FigureAt figureAt) {
    Line line{name, {}, {}};
    for (const int cells : {8, 16, 32, 64, 128, 256, 512}) {
        const double y = figureAt(cells);
        if (!(y > 1e-5)) continue;
        line.x.push_back(cells);
        line.y.push_back(y);
    }
    return line;
}

std::vector<double> ticksOf(const std::vector<Line>& lines) { return lines.front().x; }

/// Returns whether a method is plotted; `angle` would coincide with `mikktspace`.
bool isDrawn(const std::string& method) {
    return method != "angle" && method != kFitAlone && method != kOneStep && method != kTwoSteps;
}

std::string tangentPlot(const Study& study, bool shading) {
    std::vector<Line> lines;
    for (const std::string& method : study.methods) {
        if (!isDrawn(method) || (!shading && method == kFloor)) continue;
        lines.push_back(lineOf(method, [&](int cells) {
            return shading ? shadingError(study, method, "irregular", cells, false)
                           : tangentError(study, method, "irregular", cells, false);
        }));
    }
    return linePlot(shading ? "Shading error on irregular meshes" : "Error of vertex tangents on irregular meshes",
                    "cells along each side", "degrees", ticksOf(lines), lines);
}

std::string normalPlot(const Study& study) {
    std::vector<Line> lines;
    for (const std::string& weighting : study.weightings) {
        lines.push_back(
            lineOf(weighting, [&](int cells) { return normalError(study, weighting, "irregular", cells, false); }));
    }
    return linePlot("Error of vertex normals on irregular meshes", "cells along each side", "degrees", ticksOf(lines),
                    lines);
}

std::string bevelTangents() {
    const TestMesh mesh = bevelMesh({.radius = 0.05, .flat_cells = 4, .diagonal = 2, .shear_deg = 72}, Random{5});
    std::vector<BevelPanel> panels;
    for (const NamedMethod& method : methods()) {
        if (!isDrawn(method.name)) continue;
        BevelPanel panel{method.name, {}};
        for (const Vec4& t : framesBy(method.method, mesh).tangents) panel.vectors.push_back(xyz(t));
        panels.push_back(std::move(panel));
    }
    return bevelPlot("Tangents on a flat face whose narrow rounded border has sheared UVs", mesh, {1, 0, 0}, panels);
}

std::string bevelNormals() {
    const TestMesh mesh = bevelMesh({.radius = 0.05, .flat_cells = 4, .diagonal = 2}, Random{5});
    std::vector<BevelPanel> panels;
    for (const NamedWeighting& weighting : weightings()) {
        if (weighting.refine == NormalOptions{}.refine)
            panels.push_back({weighting.name, normalsBy(weighting.weighting, mesh)});
    }
    return bevelPlot("Normals on a flat face with a narrow rounded border", mesh, {0, 0, 1}, panels);
}

bool write(const std::filesystem::path& path, const std::string& svg) {
    std::ofstream file(path, std::ios::binary);
    file << svg;
    return static_cast<bool>(file.flush());
}

}  // namespace

bool writePlots(const Study& study, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    const std::filesystem::path to(folder);
    return write(to / "vertex-error.svg", tangentPlot(study, false)) &&
           write(to / "shading-error.svg", tangentPlot(study, true)) &&
           write(to / "normal-error.svg", normalPlot(study)) && write(to / "bevel-tangents.svg", bevelTangents()) &&
           write(to / "bevel-normals.svg", bevelNormals());
}

}  // namespace tspace::accuracy
