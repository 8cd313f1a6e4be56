// SPDX-License-Identifier: MIT
// Normals for typical kinds of meshes: grids, scans, decimated meshes and CAD meshes, of tuned and held-out shapes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/vec_math.h"
#include "report.h"
#include "scans.h"
#include "tspace/normals.h"

namespace tspace::accuracy {

namespace {

using Normals = std::vector<Vec3>;

struct Kind {
    std::string name;
    bool is_sharp;
    std::function<std::vector<Scan>(const StudyOptions&, std::span<const Shape>)> make;
};

/// Returns a kind that consists of one mesh for each sharp shape, or for each smooth shape.
Kind kindOf(std::string name, bool is_sharp, const std::function<Scan(const Shape&, int cells, Random)>& one,
            int cells) {
    return {std::move(name), is_sharp, [=](const StudyOptions& options, std::span<const Shape> from) {
                std::vector<Scan> all;
                for (const Shape& shape : from) {
                    if (shape.is_sharp == is_sharp)
                        all.push_back(one(shape, options.quick ? 5 * cells / 8 : cells, Random{options.seed}));
                }
                return all;
            }};
}

std::vector<Kind> kinds() {
    std::vector<Kind> all;
    const auto grid = [](auto make, double noise) {
        return [=](const Shape& shape, int cells, Random random) { return make(shape, cells, noise, random); };
    };
    const auto lessOf = [](double share) {
        return [=](const Shape& shape, int cells, Random random) {
            return decimated(surfaceNets(shape, cells, 0, random), share);
        };
    };
    for (const bool is_sharp : {false, true}) {
        for (const double noise : {0.0, 0.03, 0.1})
            all.push_back(kindOf(fmt::format("surface nets, noise {}", noise), is_sharp, grid(surfaceNets, noise), 64));
        for (const double noise : {0.0, 0.1})
            all.push_back(
                kindOf(fmt::format("marching cubes, noise {}", noise), is_sharp, grid(marchingCubes, noise), 64));
        for (const double noise : {0.0, 0.03, 0.1, 0.3})
            all.push_back(kindOf(fmt::format("scan, noise {}", noise), is_sharp, grid(scan, noise), 56));
        for (const double percent : {10.0, 3.0, 1.0})
            all.push_back(kindOf(fmt::format("decimated to {} %", percent), is_sharp, lessOf(percent / 100), 64));
        all.push_back({"CAD", is_sharp, [=](const StudyOptions&, std::span<const Shape> from) {
                           const bool is_tried = from.data() == shapes().data();
                           return is_tried ? drawnMeshes(is_sharp) : std::vector<Scan>();
                       }});
    }
    return all;
}

Normals normalsBy(const Scan& scan, const NormalOptions& options) {
    Normals normals(scan.indices.size());
    if (!generateNormals(scan.view(), options, normals)) normals.assign(normals.size(), {0, 0, 1});
    return normals;
}

/// Computes normals as meshoptimizer's generateNormals does without smoothing: weighted by the angle at the corner
/// times the lengths of its two edges.
Normals normalsByProduct(const Scan& scan) {
    std::vector<DVec3> sums(scan.positions.size());
    const auto at = [&](std::size_t corner) { return toDouble(scan.positions[scan.indices[corner]]); };
    for (std::size_t first = 0; first < scan.indices.size(); first += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const DVec3 a = at(first + (k + 1) % 3) - at(first + k), b = at(first + (k + 2) % 3) - at(first + k);
            const DVec3 across = cross(a, b);
            const double size = length(across);
            if (!(size > 0)) continue;
            DVec3& sum = sums[scan.indices[first + k]];
            sum = sum + (angleBetween(a, b) * length(a) * length(b) / size) * across;
        }
    }
    Normals normals;
    for (const std::uint32_t vertex : scan.indices) {
        DVec3 sum = sums[vertex];
        if (!normalize(sum)) sum = {0, 0, 1};
        normals.push_back(toFloat(sum));
    }
    return normals;
}

double errorOf(const StudyOptions& options, const Scan& scan, const Normals& normals) {
    return shadedError(scan, normals, options.quick ? 1500 : 4000, Random{options.seed, 2});
}

void printHead(const char* title, const std::vector<const char*>& columns) {
    fmt::print("\n**{}**\n\n| case |", title);
    for (const char* column : columns) fmt::print(" {} |", column);
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < columns.size(); ++i) fmt::print("---|");
    fmt::print("\n");
}

double mean(const std::vector<double>& values) { return geometricMean(values); }
std::string rangeOf(const std::vector<double>& values) {
    return fmt::format("{:.3g} ({:.3g} to {:.3g})", mean(values), *std::min_element(values.begin(), values.end()),
                       *std::max_element(values.begin(), values.end()));
}
const char* nameOf(bool is_sharp) { return is_sharp ? "sharp" : "smooth"; }

// True hard edges: edges at which the shape's normals at the centers of both faces differ.

struct Edge {
    std::size_t corners[2];  ///< one corner from each of the two faces
};
std::vector<Edge> edgesOf(const Scan& scan) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> by_ends;
    for (std::size_t c = 0; c < scan.indices.size(); ++c) {
        const std::uint32_t a = scan.indices[c], b = scan.indices[c % 3 == 2 ? c - 2 : c + 1];
        by_ends[{std::min(a, b), std::max(a, b)}].push_back(c);
    }
    std::vector<Edge> edges;
    for (const auto& [ends, corners] : by_ends) {
        if (corners.size() == 2) edges.push_back({{corners[0], corners[1]}});
    }
    return edges;
}
std::size_t nextOf(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Returns one group number per face: faces with equal numbers are connected by edges that are smooth in the exact
/// shape.
std::vector<std::uint32_t> smoothPieces(const Scan& scan, const std::vector<Edge>& edges) {
    constexpr double kSoft = 25 * kPi / 180;
    std::vector<std::uint32_t> pieces(scan.indices.size() / 3);
    std::iota(pieces.begin(), pieces.end(), 0u);
    const auto rootOf = [&](std::uint32_t face) {
        while (pieces[face] != face) face = pieces[face] = pieces[pieces[face]];
        return face;
    };
    std::vector<DVec3> exact;
    for (std::size_t first = 0; first < scan.indices.size(); first += 3) {
        DVec3 sum;
        for (std::size_t k = 0; k < 3; ++k) sum = sum + toDouble(scan.positions[scan.indices[first + k]]);
        exact.push_back(scan.shape->normalAt(scan.shape->nearest((1.0 / 3) * sum)));
    }
    for (const Edge& edge : edges) {
        const auto a = static_cast<std::uint32_t>(edge.corners[0] / 3),
                   b = static_cast<std::uint32_t>(edge.corners[1] / 3);
        if (!scan.shape->is_sharp || angleBetween(exact[a], exact[b]) < kSoft) pieces[rootOf(a)] = rootOf(b);
    }
    for (std::uint32_t face = 0; face < pieces.size(); ++face) pieces[face] = rootOf(face);
    for (std::uint32_t& piece : pieces) ++piece;  // smoothing group 0 would mean that the face is never smooth
    return pieces;
}

/// Returns the share, by length, of hard edges: those at which the normals of the two faces differ at an end of the
/// edge.
double hardShare(const Scan& scan, const std::vector<Edge>& edges, const Normals& normals) {
    double hard = 0, all = 0;
    for (const Edge& edge : edges) {
        const std::size_t a = edge.corners[0], b = edge.corners[1];
        const bool runs_back = scan.indices[a] == scan.indices[nextOf(b)];
        const bool is_hard = normals[a] != normals[runs_back ? nextOf(b) : b] ||
                             normals[nextOf(a)] != normals[runs_back ? b : nextOf(b)];
        const double size =
            length(toDouble(scan.positions[scan.indices[nextOf(a)]]) - toDouble(scan.positions[scan.indices[a]]));
        all += size;
        if (is_hard) hard += size;
    }
    return hard / all;
}

void printWeightings(const StudyOptions& options, std::span<const Shape> from) {
    using enum NormalWeighting;
    printHead("Normals by kinds of meshes, shaded; hard edges from 30 degrees on sharp shapes",
              {"uniform", "area", "angle", "angle-area", "max", "a * e1 * e2", "best"});
    for (const Kind& kind : kinds()) {
        std::vector<std::vector<double>> errors(7);
        for (const Scan& scan : kind.make(options, from)) {
            std::size_t column = 0;
            const float crease = kind.is_sharp ? 30 : 180;
            for (const NormalWeighting weighting : {uniform, area, angle, angleArea, max}) {
                errors[column++].push_back(
                    errorOf(options, scan, normalsBy(scan, {.weighting = weighting, .crease_angle_deg = crease})));
            }
            if (!kind.is_sharp) errors[column].push_back(errorOf(options, scan, normalsByProduct(scan)));
            errors[6].push_back(
                errorOf(options, scan, normalsBy(scan, {.weighting = best, .crease_angle_deg = crease})));
        }
        if (errors[0].empty()) continue;
        fmt::print("| {}, {} |", nameOf(kind.is_sharp), kind.name);
        for (const auto& column : errors)
            fmt::print(" {} |", column.empty() ? "" : fmt::format("{:.3g}", mean(column)));
        fmt::print("\n");
    }
}

void printCreases(const StudyOptions& options, std::span<const Shape> from) {
    using enum NormalWeighting;
    printHead("Automatic creases", {"true edges", "auto", "in parts of it", "false edges, % of length"});
    constexpr double kUnseen = 0.01;  // degrees, added to both errors of a ratio: flat faces have an error of 0
    std::vector<double> of_kinds, of_smooth;
    for (const Kind& kind : kinds()) {
        std::vector<double> truths, found, parts, falses;
        for (const Scan& scan : kind.make(options, from)) {
            const std::vector<Edge> edges = edgesOf(scan);
            const std::vector<std::uint32_t> pieces = smoothPieces(scan, edges);
            const Normals automatic =
                normalsBy(scan, {.weighting = best, .crease_angle_deg = NormalOptions::crease_auto});
            truths.push_back(errorOf(options, scan, normalsBy(scan, {.weighting = best, .smoothing_groups = pieces})));
            found.push_back(errorOf(options, scan, automatic));
            parts.push_back((found.back() + kUnseen) / (truths.back() + kUnseen));
            if (!kind.is_sharp) falses.push_back(100 * hardShare(scan, edges, automatic));
        }
        if (truths.empty()) continue;
        fmt::print("| {}, {} | {:.3g} | {:.3g} | {} |", nameOf(kind.is_sharp), kind.name, mean(truths), mean(found),
                   rangeOf(parts));
        of_kinds.push_back(mean(parts));
        if (!falses.empty()) {
            of_smooth.push_back(std::accumulate(falses.begin(), falses.end(), 0.0) /
                                static_cast<double>(falses.size()));
            fmt::print(" {:.2f}", of_smooth.back());
        }
        fmt::print(" |\n");
    }
    fmt::print("| all kinds | | | {} | {:.2f} |\n", rangeOf(of_kinds),
               std::accumulate(of_smooth.begin(), of_smooth.end(), 0.0) / static_cast<double>(of_smooth.size()));
}

/// Returns the smallest error of several weightings without denoising; for sharp shapes, also of several crease angles.
double leastError(const StudyOptions& options, const Scan& scan) {
    using enum NormalWeighting;
    double least = 180;
    for (const NormalWeighting weighting : {area, angle, angleArea, best}) {
        for (const float crease : {180.0f, 45.0f, 30.0f}) {
            if (crease < 180 && !scan.shape->is_sharp) continue;
            least = std::min(
                least, errorOf(options, scan, normalsBy(scan, {.weighting = weighting, .crease_angle_deg = crease})));
        }
    }
    return least;
}

void printNoise(const StudyOptions& options, std::span<const Shape> from, int cells) {
    printHead(fmt::format("Noise removed, grids of {}^3; sharp shapes with automatic creases", cells).c_str(),
              {"triangles", "best without", "denoised", "in parts of it", "sigma in parts of the noise"});
    struct Row {
        const char* name;
        Scan (*make)(const Shape&, int, double, Random);
        double noise;
        bool has_sigma;
    };
    const Row rows[] = {{"scan, noise 0.01", scan, 0.01, true},
                        {"scan, noise 0.03", scan, 0.03, true},
                        {"scan, noise 0.1", scan, 0.1, true},
                        {"scan, noise 0.3", scan, 0.3, true},
                        {"marching cubes, noise 0.1", marchingCubes, 0.1, false},
                        {"surface nets, noise 0.1", surfaceNets, 0.1, false}};
    for (const bool is_sharp : {false, true}) {
        for (const Row& row : rows) {
            std::vector<double> before, after, parts, sigmas;
            std::size_t triangles = 0;
            for (const Shape& shape : from) {
                if (shape.is_sharp != is_sharp) continue;
                const Scan made = row.make(shape, cells, row.noise, Random{options.seed});
                const float crease = is_sharp ? NormalOptions::crease_auto : 180;
                before.push_back(leastError(options, made));
                after.push_back(errorOf(options, made,
                                        normalsBy(made, {.weighting = NormalWeighting::best,
                                                         .crease_angle_deg = crease,
                                                         .denoise = NormalOptions::denoise_auto})));
                parts.push_back(after.back() / before.back());
                triangles = std::max(triangles, made.indices.size() / 3);
                if (const auto noise = measurePositionNoise(made.view()); noise && row.has_sigma)
                    sigmas.push_back(noise->sigma / row.noise);
            }
            fmt::print("| {}, {} | up to {} | {:.3g} | {:.3g} | {} | {} |\n", nameOf(is_sharp), row.name, triangles,
                       mean(before), mean(after), rangeOf(parts), sigmas.empty() ? "" : rangeOf(sigmas));
        }
    }
}

}  // namespace

void printKinds(const StudyOptions& options) {
    for (const std::span<const Shape> from : {shapes(), heldOutShapes()}) {
        fmt::print("\nShapes:");
        for (const Shape& shape : from) fmt::print(" {}", shape.name);
        fmt::print("\n");
        printWeightings(options, from);
        printCreases(options, from);
        for (const int cells : options.quick ? std::vector<int>{40} : std::vector<int>{56, 112})
            printNoise(options, from, cells);
    }
}

}  // namespace tspace::accuracy
