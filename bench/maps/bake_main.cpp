// SPDX-License-Identifier: MIT
// tspace_maps_bench: errors of baked maps, in degrees, on surfaces with a formula.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "bake_cases.h"

namespace {

using namespace tspace;
using namespace tspace::bench;

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
    [[nodiscard]] double of(double sum) const { return std::exp(sum / count); }
};

}  // namespace

int main(int argc, char** argv) {
    const std::uint32_t size = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 512;
    const bool held_out = argc > 2 && std::strcmp(argv[2], "held-out") == 0;
    const char* const only[] = {"torus", "saddle", "bumpy", "cube-sphere"};
    for (const Charts charts : {Charts::one, Charts::four, Charts::mirrored}) {
        for (const bool relief : {false, true}) {
            std::map<std::string, Means> rows;
            for (const accuracy::Surface& surface : held_out ? accuracy::heldOutSurfaces() : accuracy::surfaces()) {
                bool wanted = held_out && surface.fold < 0 && !surface.is_flat;
                for (const char* name : only) wanted = wanted || std::strcmp(name, surface.name) == 0;
                if (!wanted) continue;
                const LowMesh low = makeLow(surface, charts);
                const HighMesh high = makeHigh(surface, relief ? 512 : 256, relief);
                for (const unsigned bits : {16U, 8U}) {
                    for (const MapFit fit : {MapFit::texel, MapFit::solve}) {
                        BakeOptions options{.width = size, .height = size, .bits = bits, .fit = fit};
                        options.execution.thread_count = 2;
                        const auto start = std::chrono::steady_clock::now();
                        const Result<BakedMap> map = bakeMap(low.view(), high.view(), options);
                        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
                        if (!map) {
                            std::printf("%s: %s\n", surface.name, map.error().message.c_str());
                            return 1;
                        }
                        const std::string row = std::to_string(bits) + (fit == MapFit::solve ? " solve" : " texel");
                        rows[row].add(map->error);
                        std::printf(
                            "%-16s %d %s %-8s mean %.4f p99 %.4f max %.3f seam %.4f inside %.4f missed %zu/%zu overlap "
                            "%zu conflict %zu %.2f s\n",
                            surface.name, static_cast<int>(charts), relief ? "relief" : "smooth", row.c_str(),
                            map->error.mean_deg, map->error.p99_deg, map->error.max_deg, map->error.seam_mean_deg,
                            map->error.inside_mean_deg, map->missed_count, map->error.missed_count, map->overlap_count,
                            map->conflict_count, took.count());
                    }
                    // Plain rounding of the map that is exact at each texel's centre.
                    BakeOptions options{.width = size, .height = size, .bits = 16, .fit = MapFit::texel};
                    const Result<BakedMap> map = bakeMap(low.view(), high.view(), options);
                    std::vector<Vec3> texels = map->texels;
                    const float most = bits == 8 ? 255 : 65535;
                    for (Vec3& texel : texels)
                        texel = {std::floor(texel.x * most + 0.5F) / most, std::floor(texel.y * most + 0.5F) / most,
                                 std::floor(texel.z * most + 0.5F) / most};
                    const Result<MapError> plain = measureMap({size, size, texels}, low.view(), high.view());
                    rows[std::to_string(bits) + " plain"].add(*plain);
                }
            }
            for (const auto& [name, row] : rows) {
                std::printf("%s charts %d: %-8s mean %.4f p99 %.4f seam/inside %.3f\n", relief ? "relief" : "smooth",
                            static_cast<int>(charts), name.c_str(), row.of(row.log_mean), row.of(row.log_p99),
                            row.of(row.log_seam) / row.of(row.log_inside));
            }
        }
    }
    return 0;
}
