// SPDX-License-Identifier: MIT
// Normals of scans: shading error by noise, with and without denoising and automatic hard edges.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "report.h"
#include "scans.h"
#include "tspace/normals.h"

namespace tspace::accuracy {

namespace {

struct Column {
    const char* name;
    NormalOptions options;
};

std::vector<Column> columns() {
    using enum NormalWeighting;
    constexpr float kNoise = NormalOptions::denoise_auto, kEdges = NormalOptions::crease_auto;
    return {{"area", {.weighting = area}},
            {"angle", {.weighting = angle}},
            {"best", {.weighting = best}},
            {"best, denoised", {.weighting = best, .denoise = kNoise}},
            {"best, crease 45", {.weighting = best, .crease_angle_deg = 45}},
            {"best, crease auto", {.weighting = best, .crease_angle_deg = kEdges}},
            {"both auto", {.weighting = best, .crease_angle_deg = kEdges, .denoise = kNoise}}};
}

void printRow(const StudyOptions& options, bool is_sharp, double noise) {
    const int cells = options.quick ? 40 : 56, points = options.quick ? 1500 : 4000;
    std::vector<double> logarithms(columns().size(), 0);
    int count = 0;
    for (const Shape& shape : shapes()) {
        if (shape.is_sharp != is_sharp) continue;
        const Scan made = scan(shape, cells, noise, Random{options.seed});
        std::vector<Vec3> normals(made.indices.size());
        for (std::size_t i = 0; i < logarithms.size(); ++i) {
            if (!generateNormals(made.view(), columns()[i].options, normals)) return;
            logarithms[i] += std::log(shadedError(made, normals, points, Random{options.seed, 2}));
        }
        ++count;
    }
    fmt::print("| {}, noise {} |", is_sharp ? "sharp" : "smooth", noise);
    for (const double sum : logarithms) fmt::print(" {:.3g} |", std::exp(sum / count));
    fmt::print("\n");
}

}  // namespace

void printScans(const StudyOptions& options) {
    fmt::print("\n**Normals of scans**: shaded error; noise in edge lengths\n\n| case |");
    for (const Column& column : columns()) fmt::print(" {} |", column.name);
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < columns().size(); ++i) fmt::print("---|");
    fmt::print("\n");
    for (const bool is_sharp : {false, true}) {
        for (const double noise : {0.0, 0.01, 0.03, 0.1, 0.3}) printRow(options, is_sharp, noise);
    }
}

}  // namespace tspace::accuracy
