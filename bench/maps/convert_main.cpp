// SPDX-License-Identifier: MIT
// tspace_convert_bench: accuracy of converted normal maps, in degrees, on surfaces given by formulas.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "bake_cases.h"
#include "maps/texels/shading.h"
#include "maps/texels/texture_sample.h"
#include "tspace/maps.h"

namespace {

using namespace tspace;
using namespace tspace::bench;

[[noreturn]] void stop(const Error& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    std::exit(1);
}

template <class T>
T orStop(Result<T> result) {
    if (!result) stop(result.error());
    return *std::move(result);
}

MapSide sideOf(const LowMesh& mesh) {
    return {.uvs = mesh.uvs, .normals = mesh.normals, .tangents = mesh.tangents, .positions = mesh.positions};
}

struct Map {
    std::uint32_t size = 0;
    std::vector<Vec3> texels = {};

    [[nodiscard]] MapImage image() const { return {size, size, texels}; }
};

Map converted(const Map& map, const MapSide& from, const MapSide& to, unsigned bits) {
    Map out{map.size, std::vector<Vec3>(map.texels.size())};
    orStop(convertMap(map.image(), from, to, {.bits = bits}, out.texels, {.thread_count = kAllThreads}));
    return out;
}

/// Returns the shading normals of a mesh with a bilinearly filtered map, at points distributed evenly over its area.
std::vector<DVec3> pictureOf(const Map& map, const LowMesh& mesh) {
    constexpr double kPoints = 100000;
    std::vector<double> areas(mesh.positions.size() / 3);
    double whole = 0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        const DVec3 a = toDouble(mesh.positions[3 * t]);
        areas[t] = length(cross(toDouble(mesh.positions[3 * t + 1]) - a, toDouble(mesh.positions[3 * t + 2]) - a));
        whole += areas[t];
    }
    std::vector<DVec3> shaded;
    double due = 0;
    std::uint32_t number = 0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        CornerFrames corners;
        for (std::size_t i = 0; i < 3; ++i) {
            corners.normals[i] = mesh.normals[3 * t + i];
            corners.tangents[i] = mesh.tangents[3 * t + i];
        }
        for (due += kPoints * areas[t] / whole; due >= 1; --due) {
            // Points by the additive recurrence of the plastic number: evenly distributed in any range, and equal for
            // every map.
            ++number;
            double a = std::fmod(number * 0.7548776662466927, 1), b = std::fmod(number * 0.5698402909980532, 1);
            if (a + b > 1) {
                a = 1 - a;
                b = 1 - b;
            }
            const std::array<double, 3> weights{1 - a - b, a, b};
            double u = 0, v = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                u += weights[i] * mesh.uvs[3 * t + i].x;
                v += weights[i] * mesh.uvs[3 * t + i].y;
            }
            const Vec3 texel =
                sampleBilinear({map.size, map.size}, map.texels, {static_cast<float>(u), static_cast<float>(v)});
            shaded.push_back(shadedNormal(shadingFrame(corners, weights, {}), decodeTexel(texel, {})));
        }
    }
    return shaded;
}

struct Angles {
    double mean = 0, p99 = 0;
};

Angles apart(const std::vector<DVec3>& a, const std::vector<DVec3>& b) {
    std::vector<double> angles;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        angles.push_back(degreesBetween(a[i], b[i]));
        sum += angles.back();
    }
    const std::size_t at = angles.size() * 99 / 100;
    std::nth_element(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(at), angles.end());
    return {sum / static_cast<double>(angles.size()), angles[at]};
}

/// Row of the table: geometric means over surfaces of the mean and of the 99th percentile.
class Row {
  public:
    explicit Row(const char* name, double most_mean, double most_p99 = 0)
        : name_(name), most_mean_(most_mean), most_p99_(most_p99) {}

    void add(const Angles& angles) {
        log_mean_ += std::log(angles.mean);
        log_p99_ += std::log(std::max(angles.p99, 1e-12));
        ++count_;
    }
    /// Returns the same row with a target for its mean.
    [[nodiscard]] Row withTarget(double most_mean) const {
        Row row = *this;
        row.most_mean_ = most_mean;
        return row;
    }
    /// Prints the row. Returns false if it misses a target.
    [[nodiscard]] bool print() const {
        const double mean = std::exp(log_mean_ / count_), p99 = std::exp(log_p99_ / count_);
        const bool is_met = (most_mean_ == 0 || mean <= most_mean_) && (most_p99_ == 0 || p99 <= most_p99_);
        std::printf("%-34s %9.5f %9.5f", name_, mean, p99);
        if (most_mean_ != 0) std::printf("   at most %g", most_mean_);
        if (most_p99_ != 0) std::printf(", %g", most_p99_);
        std::printf("%s\n", is_met ? "" : "   MISSED");
        return is_met;
    }

  private:
    const char* name_;
    double most_mean_, most_p99_;
    double log_mean_ = 0, log_p99_ = 0;
    int count_ = 0;
};

struct Rows {
    Row unconverted{"unconverted, 16 bits", 0};
    Row once{"16 to 16 bits", 0.001, 0.004};
    Row round_trip{"16 bits, there and back", 0.0003};
    Row object_round_trip{"to object space and back", 0.0003};
    Row widened{"8 to 16 bits", 0.0015};
    Row narrow_unconverted{"unconverted, 8 bits", 0};
    Row narrow{"8 to 8 bits", 0};
    Row object{"object to tangent, of the floor", 1.05};
    Row object_itself{"the object map itself, of it", 0};
    Row object_floats{"object to tangent, floats, of it", 0};

    [[nodiscard]] bool print(bool relief) {
        if (relief) narrow = narrow.withTarget(0.045);
        bool all = true;
        for (const Row* row : {&unconverted, &once, &round_trip, &object_round_trip, &widened, &narrow_unconverted,
                               &narrow, &object, &object_itself, &object_floats})
            all = row->print() && all;
        return all;
    }
};

void measure(const accuracy::Surface& surface, Charts charts, bool relief, std::uint32_t size, Rows& rows) {
    const LowMesh mikk = makeLow(surface, charts), best = makeLow(surface, charts, Method::best);
    const HighMesh high = makeHigh(surface, relief ? 512 : 256, relief, 1);
    const MapSide from = sideOf(mikk), to = sideOf(best);
    BakeOptions options{.width = size, .height = size, .bits = 16, .fit = MapFit::texel};
    const BakedMap baked = orStop(bakeMap(mikk.view(), high.view(), options, {.thread_count = kAllThreads}));
    const Map map{size, baked.texels};
    const std::vector<DVec3> shown = pictureOf(map, mikk);
    const Map there = converted(map, from, to, 16);
    rows.unconverted.add(apart(shown, pictureOf(map, best)));
    rows.once.add(apart(shown, pictureOf(there, best)));
    rows.round_trip.add(apart(shown, pictureOf(converted(there, to, from, 16), mikk)));
    const Map in_space = converted(map, from, {.space = MapSpace::object}, 16);
    rows.object_round_trip.add(
        apart(shown, pictureOf(converted(in_space, {.space = MapSpace::object}, from, 16), mikk)));
    options.bits = 8;
    const Map eight{size, orStop(bakeMap(mikk.view(), high.view(), options, {.thread_count = kAllThreads})).texels};
    const std::vector<DVec3> shown_eight = pictureOf(eight, mikk);
    rows.widened.add(apart(shown_eight, pictureOf(converted(eight, from, to, 16), best)));
    rows.narrow_unconverted.add(apart(shown_eight, pictureOf(eight, best)));
    rows.narrow.add(apart(shown_eight, pictureOf(converted(eight, from, to, 8), best)));
    options.bits = 16;
    options.space = MapSpace::object;
    const Map object{size, orStop(bakeMap(mikk.view(), high.view(), options, {.thread_count = kAllThreads})).texels};
    const auto addObject = [&](Row& row, const Map& texels, MapSpace space) {
        const MapError error = orStop(measureMap(texels.image(), mikk.view(), high.view(), {.space = space}));
        row.add({error.mean_deg / baked.error.mean_deg, error.p99_deg / baked.error.p99_deg});
    };
    addObject(rows.object, converted(object, {.space = MapSpace::object}, from, 16), MapSpace::tangent);
    addObject(rows.object_itself, object, MapSpace::object);
    addObject(rows.object_floats, converted(object, {.space = MapSpace::object}, from, 32), MapSpace::tangent);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint32_t size = 512;
    bool held_out = true;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--tuned") == 0) {
            held_out = false;
        } else if (std::strcmp(argv[i], "--size") == 0 && i + 1 < argc) {
            size = static_cast<std::uint32_t>(std::atoi(argv[++i]));
        } else {
            std::printf(
                "usage: tspace_convert_bench [--size TEXELS] [--tuned]\n"
                "Prints errors of normal maps that were converted from mikktspace frames to those of best, as means "
                "over the\n"
                "held-out surfaces (--tuned: over those of the figures), each beside its target.\n");
            return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
        }
    }
    const char* const tuned[] = {"torus", "saddle", "bumpy", "cube-sphere"};
    bool all = true;
    for (const Charts charts : {Charts::one, Charts::four}) {
        for (const bool relief : {false, true}) {
            Rows rows;
            for (const accuracy::Surface& surface : held_out ? accuracy::heldOutSurfaces() : accuracy::surfaces()) {
                const bool is_wanted =
                    held_out ? surface.fold < 0 && !surface.is_flat
                             : std::any_of(std::begin(tuned), std::end(tuned),
                                           [&](const char* name) { return std::strcmp(name, surface.name) == 0; });
                if (is_wanted) measure(surface, charts, relief, size, rows);
            }
            std::printf("%s, %s, %u texels         mean       p99\n", relief ? "relief" : "smooth",
                        charts == Charts::one ? "one chart" : "four charts", size);
            all = rows.print(relief) && all;
            std::printf("\n");
        }
    }
    std::printf("%s\n", all ? "All targets are met." : "Some targets are missed.");
    return 0;
}
