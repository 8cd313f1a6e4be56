// SPDX-License-Identifier: MIT
// tspace_bake_bench: errors of baked maps, in degrees, on surfaces given by formulas; also writes these surfaces as
// files.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bake_cases.h"
#include "core/base/vec_math.h"
#include "level_errors.h"
#include "maps/texels/quantize.h"

namespace {

using namespace tspace;
using namespace tspace::bench;

/// Geometric means over surfaces, accumulated as sums of logarithms.
struct Means {
    double log_mean = 0, log_p99 = 0, log_seam = 0, log_inside = 0;
    int count = 0;

    void add(const MapError& error) {
        log_mean += std::log(error.mean_deg);
        log_p99 += std::log(error.p99_deg);
        log_seam += std::log(error.seam_mean_deg);
        log_inside += std::log(error.inside_mean_deg);
        ++count;
    }
    [[nodiscard]] double mean() const { return std::exp(log_mean / count); }
    [[nodiscard]] double p99() const { return std::exp(log_p99 / count); }
    [[nodiscard]] double seam() const { return std::exp((log_seam - log_inside) / count); }
};

[[noreturn]] void stop(const char* surface, const Error& error) {
    std::fprintf(stderr, "%s: %s\n", surface, error.message.c_str());
    std::exit(1);
}

std::vector<const accuracy::Surface*> chosenSurfaces(bool held_out) {
    std::vector<const accuracy::Surface*> chosen;
    for (const accuracy::Surface& surface : held_out ? accuracy::heldOutSurfaces() : accuracy::surfaces()) {
        bool wanted = held_out && surface.fold < 0 && !surface.is_flat;
        for (const char* name : {"torus", "saddle", "bumpy", "cube-sphere"})
            wanted = wanted || (!held_out && std::strcmp(name, surface.name) == 0);
        if (wanted) chosen.push_back(&surface);
    }
    return chosen;
}

/// Results for one kind of case. `exact`: the map is exact at each texel's center; `solved`: the map is fitted by least
/// squares; `plain`: the exact map rounded to 8 bits.
struct CaseMeans {
    Means exact16, solved16, plain8, solved8;
    double slowest = 0;
};

void addSurface(const accuracy::Surface& surface, Charts charts, bool relief, std::uint32_t size, CaseMeans& means) {
    const LowMesh low = makeLow(surface, charts);
    const HighMesh high = makeHigh(surface, relief ? 512 : 256, relief, 1);
    const auto baked = [&](unsigned bits, MapFit fit) {
        const BakeOptions options{
            .width = size, .height = size, .bits = bits, .fit = fit, .lengths = TexelLengths::free};
        const auto start = std::chrono::steady_clock::now();
        Result<BakedMap> map = bakeMap(low.view(), high.view(), options, {.thread_count = 2});
        if (!map) stop(surface.name, map.error());
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        means.slowest = std::max(means.slowest, took.count());
        return *std::move(map);
    };
    const BakedMap exact = baked(16, MapFit::texel);
    means.exact16.add(exact.error);
    means.solved16.add(baked(16, MapFit::solve).error);
    means.solved8.add(baked(8, MapFit::solve).error);
    // The exact map rounded to 8 bits, channel by channel.
    std::vector<Vec3> texels = exact.texels;
    const auto rounded = [](float channel) { return std::floor(channel * 255 + 0.5F) / 255; };
    for (Vec3& texel : texels) texel = {rounded(texel.x), rounded(texel.y), rounded(texel.z)};
    const Result<MapError> plain = measureMap({size, size, texels}, low.view(), high.view());
    if (!plain) stop(surface.name, plain.error());
    means.plain8.add(*plain);
}

void printRow(const char* name, unsigned bits, const Means& exact, const Means& solved, const char* asked) {
    std::printf("| %-22s | %2u | %.4f / %.4f | %.4f / %.4f | %.2f | %.2f | %.2f | %.2f | %s |\n", name, bits,
                exact.mean(), exact.p99(), solved.mean(), solved.p99(), solved.mean() / exact.mean(),
                solved.p99() / exact.p99(), exact.seam(), solved.seam(), asked);
    std::fflush(stdout);
}

void printTable(std::uint32_t size, bool held_out) {
    std::printf("%u x %u texels%s. Degrees, mean / p99; geometric means over the surfaces.\n\n", size, size,
                held_out ? ", held-out surfaces" : "");
    std::printf(
        "| case | bits | exact at centers (8 bits: rounded) | solved | mean | p99 | seams, exact | seams, solved | "
        "target |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    double slowest = 0;
    const struct {
        Charts charts;
        const char* name;
    } kinds[] = {{Charts::one, "one chart"}, {Charts::four, "four charts"}, {Charts::mirrored, "mirrored halves"}};
    for (const auto& kind : kinds) {
        for (const bool relief : {false, true}) {
            CaseMeans means;
            for (const accuracy::Surface* surface : chosenSurfaces(held_out))
                addSurface(*surface, kind.charts, relief, size, means);
            const std::string name = std::string(relief ? "relief, " : "smooth, ") + kind.name;
            // If the mirrored halves require different normals, no map is correct for both, so there is no target.
            const bool has_none = kind.charts == Charts::mirrored && relief;
            // Each texel is used by both halves, whose frames and triangles differ slightly.
            const bool is_shared = kind.charts == Charts::mirrored;
            const char* const asked16 = has_none ? "" : is_shared ? "1.0, 1.0" : relief ? "0.55, 0.70" : "0.92, 0.70";
            const char* const asked8 = has_none ? "" : is_shared ? "1.0, 1.0" : relief ? "0.40, 0.95" : "0.65, 0.95";
            printRow(name.c_str(), 16, means.exact16, means.solved16, asked16);
            printRow(name.c_str(), 8, means.plain8, means.solved8, asked8);
            slowest = std::max(slowest, means.slowest);
        }
    }
    std::printf("\nSlowest bake: %.1f s (2 threads, on the clock).\n", slowest);
}

/// A row of printLevels: means over surfaces of the error of the shading, and of the error of each mip level.
struct LevelRow {
    const char* name;
    unsigned bits;
    TexelLengths lengths = TexelLengths::even;
    float least = 0;  ///< minimum vector length of the 16-bit map; shorter vectors are lengthened to it
    double log_shown = 0;
    std::array<double, kLevels> log_levels = {};
};

/// Returns the 16-bit map with all shorter vectors lengthened to `least`, and its error.
BakedMap lengthened(BakedMap map, float least, const LowMesh& low, const HighMesh& high) {
    for (Vec3& texel : map.texels) {
        const DVec3 vector = 2 * toDouble(texel) - DVec3{1, 1, 1};
        const double own = length(vector);
        if (own >= least || !(own > 0)) continue;
        texel = toFloat(0.5 * (roundedVector(65535, least / own * vector) + DVec3{1, 1, 1}));
    }
    const Result<MapError> error = measureMap({map.width, map.height, map.texels}, low.view(), high.view());
    if (!error) stop("lengthened", error.error());
    map.error = *error;
    return map;
}

void printLevels(std::uint32_t size, bool held_out) {
    std::printf(
        "%u x %u texels, relief, one chart%s. Degrees in the mean, geometric means over the surfaces: as shown, and of "
        "means of so many texels.\n\n| lengths | shown | 2 x 2 | 4 x 4 | 8 x 8 | 16 x 16 "
        "|\n|---|---|---|---|---|---|\n",
        size, size, held_out ? ", held-out surfaces" : "");
    LevelRow rows[] = {{"16 bits", 16},
                       {"16 bits, .9 or more", 16, TexelLengths::even, 0.9F},
                       {"16 bits, 1", 16, TexelLengths::even, 1},
                       {"8 bits, `even`", 8},
                       {"8 bits, `free`", 8, TexelLengths::free}};
    const std::vector<const accuracy::Surface*> surfaces = chosenSurfaces(held_out);
    for (const accuracy::Surface* surface : surfaces) {
        const LowMesh low = makeLow(*surface, Charts::one);
        const HighMesh high = makeHigh(*surface, 512, true, 1);
        const auto baked = [&](BakeOptions options, std::uint32_t side) {
            options.width = options.height = side;
            Result<BakedMap> map = bakeMap(low.view(), high.view(), options, {.thread_count = 2});
            if (!map) stop(surface->name, map.error());
            return *std::move(map);
        };
        const BakedMap fine = baked({.fit = MapFit::texel}, 4 * size);
        BakedMap wide;
        for (LevelRow& row : rows) {
            const BakedMap map = row.least > 0 ? lengthened(wide, row.least, low, high)
                                               : baked({.bits = row.bits, .lengths = row.lengths}, size);
            row.log_shown += std::log(map.error.mean_deg);
            const std::array<double, kLevels> errors = levelErrors(map, fine);
            for (std::size_t i = 0; i < kLevels; ++i) row.log_levels[i] += std::log(errors[i]);
            if (row.bits == 16 && row.least == 0) wide = map;
        }
    }
    const auto count = static_cast<double>(surfaces.size());
    for (const LevelRow& row : rows) {
        std::printf("| %s | %.4f |", row.name, std::exp(row.log_shown / count));
        for (const double sum : row.log_levels) std::printf(" %.4f |", std::exp(sum / count));
        std::printf("\n");
    }
    std::fflush(stdout);
}

void writeObj(const std::string& path, std::span<const Vec3> positions, std::span<const Vec3> normals,
              std::span<const Vec2> uvs, std::span<const std::uint32_t> corners) {
    std::ofstream file(path);
    file.precision(9);
    for (const Vec3& at : positions) file << "v " << at.x << ' ' << at.y << ' ' << at.z << '\n';
    for (const Vec3& normal : normals) file << "vn " << normal.x << ' ' << normal.y << ' ' << normal.z << '\n';
    // v points up in OBJ files, and down in this library.
    for (const Vec2& uv : uvs) file << "vt " << uv.x << ' ' << 1 - uv.y << '\n';
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (i % 3 == 0) file << (i == 0 ? "f" : "\nf");
        const std::uint32_t n = corners[i] + 1;
        file << ' ' << n << '/';
        if (!uvs.empty()) file << n;
        file << '/' << n;
    }
    file << '\n';
    if (!file.flush()) {
        std::fprintf(stderr, "cannot write %s\n", path.c_str());
        std::exit(1);
    }
}

struct WeldedMesh {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> corners = {};
};

/// Merges equal corners into one vertex. Otherwise the vertices would remain separate in Blender, which rounds normals.
WeldedMesh weld(const LowMesh& low) {
    WeldedMesh welded;
    std::map<std::array<float, 8>, std::uint32_t> known;
    for (std::size_t i = 0; i < low.positions.size(); ++i) {
        const Vec3 &at = low.positions[i], &normal = low.normals[i];
        const auto count = static_cast<std::uint32_t>(welded.positions.size());
        const auto [vertex, is_new] =
            known.try_emplace({at.x, at.y, at.z, normal.x, normal.y, normal.z, low.uvs[i].x, low.uvs[i].y}, count);
        welded.corners.push_back(vertex->second);
        if (!is_new) continue;
        welded.positions.push_back(at);
        welded.normals.push_back(normal);
        welded.uvs.push_back(low.uvs[i]);
    }
    return welded;
}

/// Writes low.obj, cage.obj (the low poly moved along its normals by `reach`) and high.obj.
void writeModels(const std::string& folder, const char* name, bool relief, int cells, double reach) {
    for (const bool held_out : {false, true}) {
        for (const accuracy::Surface* surface : chosenSurfaces(held_out)) {
            if (std::strcmp(surface->name, name) != 0) continue;
            const WeldedMesh low = weld(makeLow(*surface, Charts::one));
            std::vector<Vec3> cage = low.positions;
            for (std::size_t i = 0; i < cage.size(); ++i)
                cage[i] = cage[i] + static_cast<float>(reach) * low.normals[i];
            writeObj(folder + "/low.obj", low.positions, low.normals, low.uvs, low.corners);
            writeObj(folder + "/cage.obj", cage, low.normals, low.uvs, low.corners);
            const HighMesh high = makeHigh(*surface, cells, relief, 1);
            writeObj(folder + "/high.obj", high.positions, high.normals, {}, high.corners);
            return;
        }
    }
    std::fprintf(stderr, "no surface is called %s\n", name);
    std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() == 6 && arguments[0] == "--write") {
        writeModels(arguments[1], arguments[2].c_str(), arguments[3] == "relief", std::atoi(arguments[4].c_str()),
                    std::atof(arguments[5].c_str()));
        return 0;
    }
    if (arguments.size() >= 2 && arguments.size() <= 3 && arguments[0] == "--levels") {
        const int side = std::atoi(arguments[1].c_str());
        if (side < 16 || side > 4096) return 2;
        printLevels(static_cast<std::uint32_t>(side), arguments.size() == 3);
        return 0;
    }
    if (arguments.size() > 2 || (arguments.size() == 2 && arguments[1] != "held-out")) {
        std::fprintf(stderr,
                     "usage: tspace_bake_bench [SIZE [held-out]]\n"
                     "       tspace_bake_bench --levels SIZE [held-out]\n"
                     "       tspace_bake_bench --write FOLDER SURFACE smooth|relief CELLS REACH\n");
        return 2;
    }
    const int size = arguments.empty() ? 512 : std::atoi(arguments[0].c_str());
    if (size < 1 || size > 16384) return 2;
    printTable(static_cast<std::uint32_t>(size), arguments.size() == 2);
    return 0;
}
