// SPDX-License-Identifier: MIT
// mapErrorFile: reads a map and both models, and measures the error; its report as JSON. The steps of measuring, in the
// order of this file:
//
//   1. bakeOptionsOf: the options with which both models are read
//   2. listFrames, listReadings: the tangents and encodings that the map may have been made for
//   3. tryRays: the rays that it may have been baked with
//   4. judge: the verdict
//   5. writeHeat: a picture of the error
#include <algorithm>
#include <charconv>

#include "commands/bake/bake_report.h"
#include "commands/bake/model_surfaces.h"
#include "commands/map_error/map_error_report.h"
#include "commands/shared/map_image_file.h"
#include "core/base/numbers.h"
#include "images/texture_vectors.h"
#include "maps/texels/shading.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/output_name.h"
#include "tspace/bake_file.h"

namespace tspace {
namespace {

/// Another interpretation is reported if its error is below this fraction of the requested one, and lower by at least
/// this angle; smaller differences may be random.
constexpr double kMuchBetter = 0.7, kMinGainDeg = 0.02;
/// If the errors of all interpretations are above this angle, none of them explains the map.
constexpr double kUnexplainedDeg = 5;

struct TriedFrames {
    std::string name = {};
    std::vector<Vec4> tangents = {};  ///< tangents to try; empty: those of the low poly
};

struct TriedRays {
    RayOptions options = {};
    double reach = 0;
    MapError error = {};
};

/// Merges all images of a model into one, or the images that the options select.
LowModel::Image shownPart(const LowModel& model, const MapErrorFileOptions& options) {
    LowModel::Image shown;
    for (const LowModel::Image& image : model.images) {
        if (!options.material.empty() && image.material != options.material) {
            for (std::size_t i = 0; i < image.part.triangleCount(); ++i) shown.part.addToRest(image.part, i);
            continue;
        }
        if (shown.part.corners.positions.empty()) {
            shown.wrap_u = image.wrap_u;
            shown.wrap_v = image.wrap_v;
        }
        for (std::size_t i = 0; i < image.part.triangleCount(); ++i) {
            if (options.tile == 0 || tileOf(&image.part.corners.uvs[3 * i]) == options.tile) {
                shown.part.addTriangle(image.part, i);
            } else {
                shown.part.addToRest(image.part, i);
            }
        }
    }
    if (!shown.part.corners.positions.empty()) return shown;
    failFile(ErrorCode::missingAttribute, options.tile == 0
                                              ? "no triangle has the material " + inQuotes(options.material)
                                              : "no triangle is in the UDIM tile " + std::to_string(options.tile));
}

std::string degreesWord(double degrees) {
    char text[32];
    const int digits = degrees < 0.1 ? 3 : 2;
    return {text, std::to_chars(text, text + sizeof text, degrees, std::chars_format::fixed, digits).ptr};
}

/// State of a call, which all steps share.
struct Measuring {
    MapErrorFileOptions options;
    InputFiles inputs = {};
    BakeFileOptions bake = {};
    FloatImage image = {};
    std::vector<TriedFrames> frames = {};
    std::vector<MapCandidate> candidates = {};
    std::vector<TriedRays> tried = {};  ///< sorted, the best first
    bool other_rays = false;            ///< rays other than the requested ones explain the map much better
    bool shows_several = false;         ///< the measured triangles have several materials
    MapErrorFileReport report = {};
};

// -- 1. options --

BakeFileOptions bakeOptionsOf(const MapErrorFileOptions& options) {
    BakeFileOptions bake;
    bake.execution = options.execution;
    bake.progress = options.progress;
    bake.tangents = options.tangents;
    bake.normals = options.normals;
    bake.file = options.file;
    bake.cage = options.cage;
    bake.skew = options.skew;
    bake.match = options.match;
    bake.ignore_high_maps = options.ignore_high_maps;
    bake.high_green = options.high_green;
    return bake;
}

// -- 2. readings --

/// Lists the frames that the map may have been baked for.
void listFrames(Measuring& state, const std::string& low, const LowModel& known) {
    state.frames.push_back({"file"});
    struct Tried {
        const char* name;
        Method method;
        Faces faces;
    };
    constexpr Tried kTried[] = {{"mikktspace", Method::mikktspace, Faces::triangles},
                                {"quads", Method::mikktspace, Faces::quads},
                                {"lengyel", Method::lengyel, Faces::triangles},
                                {"best", Method::best, Faces::triangles}};
    for (const Tried& tried : kTried) {
        state.bake.tangents.method = tried.method;
        const std::optional<LowModel> model = readLowRecomputed(low, state.bake, tried.faces, known);
        if (!model) continue;
        std::vector<Vec4> tangents = shownPart(*model, state.options).part.corners.tangents;
        const auto is_known = [&](const TriedFrames& frames) { return frames.tangents == tangents; };
        if (tangents == shownPart(known, state.options).part.corners.tangents) continue;
        if (std::none_of(state.frames.begin(), state.frames.end(), is_known))
            state.frames.push_back({tried.name, std::move(tangents)});
    }
}

/// Returns whether z of the texels differs from the z reconstructed from x and y, in more than one of 20 tilted texels.
bool blueMatters(const Measuring& state) {
    constexpr double kLeanDeg = 5, kOtherDeg = 2;
    constexpr std::size_t kOneOf = 20;
    MapReading three = state.options.map.reading, two = three;
    three.two_channels = false;
    two.two_channels = true;
    std::size_t leaning = 0, other = 0;
    for (const Vec3& texel : state.image.texels) {
        const DVec3 a = decodeTexel(texel, three), b = decodeTexel(texel, two);
        if (degreesBetween(a, {0, 0, 1}) < kLeanDeg && degreesBetween(b, {0, 0, 1}) < kLeanDeg) continue;
        ++leaning;
        other += degreesBetween(a, b) > kOtherDeg ? 1 : 0;
    }
    return other * kOneOf > leaning;
}

void listReadings(Measuring& state) {
    const auto add = [&](const std::string& frames, const MapCandidate& candidate) {
        state.candidates.push_back(candidate);
        state.report.readings.push_back({.frames = frames, .axes = candidate.axes, .reading = candidate.reading});
    };
    const bool in_object = state.options.map.space == MapSpace::object;
    add(in_object ? "object" : "file",
        {.space = state.options.map.space, .reading = state.options.map.reading, .axes = state.options.map.axes});
    const MapReading& asked = state.options.map.reading;
    for (const TriedFrames& frames : state.frames) {
        for (const Green green : {Green::up, Green::down}) {
            for (const bool per_vertex : {false, true}) {
                MapReading reading = asked;
                reading.green = green;
                reading.bitangent = per_vertex ? BitangentPlace::perVertex : BitangentPlace::perPixel;
                reading.unit_vectors = per_vertex;
                if (!in_object && frames.name == "file" && reading == asked) continue;
                add(frames.name, {MapSpace::tangent, reading, frames.tangents});
            }
        }
    }
    for (const Green green : {Green::up, Green::down}) {
        // If ignoring blue changes nearly no texel, maps of two and three channels cannot be distinguished.
        if (in_object || !blueMatters(state)) break;
        MapReading reading = asked;
        reading.green = green;
        reading.two_channels = !asked.two_channels;
        add("file", {MapSpace::tangent, reading, {}});
    }
    for (const MapAxes& axes : {MapAxes{}, kMapAxesZUp}) {
        if (!in_object || !(axes == state.options.map.axes)) add("object", {.space = MapSpace::object, .axes = axes});
    }
}

void storeErrors(Measuring& state, const std::vector<MapError>& errors) {
    for (std::size_t i = 0; i < errors.size(); ++i) state.report.readings[i].error = errors[i];
}

// -- 3. rays --

/// Lists the requested rays first, and then other targets and directions, each with one, a quarter and three times the
/// reach.
void listRays(Measuring& state, const RayOptions& asked) {
    const double reach = state.options.map.reach;
    state.tried.push_back({asked, reach});
    // If several choices of rays have the same hits, the first one is reported.
    for (const double factor : {1.0, 0.25, 3.0}) {
        for (const RayTarget target : {RayTarget::outermost, RayTarget::nearest}) {
            for (const RayDirections directions :
                 {RayDirections::automatic, RayDirections::averaged, RayDirections::normals}) {
                TriedRays tried{{.target = target, .directions = directions}, factor * reach};
                const bool is_asked = target == asked.target && directions == asked.directions &&
                                      asked.skew.texels.empty() && factor == 1 && asked.cage_offset == 0;
                if (!is_asked) state.tried.push_back(tried);
            }
        }
    }
}

bool isMuchBetter(double better, double than) { return better < kMuchBetter * than && than - better > kMinGainDeg; }

/// Measures the map with the rays that it may have been baked with.
template <class Measure>
void tryRays(Measuring& state, const Measure& measure) {
    const RayOptions& asked = state.options.map.rays;
    if (!state.options.cage.empty()) {
        state.report.rays.push_back({{.has_cage = true}, state.report.error});
        return;
    }
    constexpr std::uint32_t kPoints = 20000;
    const auto best =
        std::min_element(state.report.readings.begin(), state.report.readings.end(),
                         [](const auto& a, const auto& b) { return a.error.met_mean_deg < b.error.met_mean_deg; });
    MapCandidate reading = state.candidates[static_cast<std::size_t>(best - state.report.readings.begin())];
    listRays(state, asked);
    std::vector<MapCandidate> candidates;
    for (const TriedRays& rays : state.tried) {
        reading.rays = &rays.options;
        reading.reach = rays.reach;
        candidates.push_back(reading);
    }
    MapErrorOptions map = state.options.map;
    map.point_count = std::min(map.point_count, kPoints);
    const std::vector<MapError> errors = measure(candidates, map);
    for (std::size_t i = 0; i < errors.size(); ++i) state.tried[i].error = errors[i];
    const double mean = errors.front().mean_deg;
    std::stable_sort(state.tried.begin(), state.tried.end(),
                     [](const auto& a, const auto& b) { return a.error.mean_deg < b.error.mean_deg; });
    const double better = state.tried.front().error.mean_deg;
    state.other_rays = isMuchBetter(better, mean);
    for (const TriedRays& rays : state.tried)
        state.report.rays.push_back(
            {{rays.options.target, rays.options.directions, !rays.options.skew.texels.empty()}, rays.error});
}

// -- 4. verdict --

/// Describes how the interpretation `best` differs from the requested one, `asked`; empty if it does not.
std::string difference(const ExplainedReading& asked, const ExplainedReading& best) {
    if (best.frames == "object")
        return best.axes == kMapAxesZUp ? "object space with z up, as in Blender (convert-map --from object --axes "
                                          "z-up converts it to tangent space)"
                                        : "object space";
    std::string words;
    const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", and ") + word; };
    if (best.reading.green != asked.reading.green)
        add(best.reading.green == Green::down ? "green that points down (tspace flip-green inverts it)"
                                              : "green that points up (tspace flip-green inverts it)");
    if (best.frames == "quads") {
        add("the tangents of mikktspace on quads (tspace generate --overwrite --faces quads writes them)");
    } else if (best.frames != asked.frames) {
        add(best.frames == "file"
                ? "the tangents in the file"
                : "tangents that differ from those in the file (tspace generate --overwrite --method " + best.frames +
                      " writes them)");
    }
    if (best.reading.bitangent != asked.reading.bitangent)
        add(best.reading.bitangent == BitangentPlace::perVertex ? "a bitangent per vertex, as in three.js and Godot"
                                                                : "a bitangent per pixel");
    if (best.reading.two_channels != asked.reading.two_channels)
        add(best.reading.two_channels ? "two channels, with z reconstructed from x and y (use --two-channels)"
                                      : "three channels");
    return words;
}

std::string raysPhrase(const RayOptions& rays) {
    const bool is_nearest = rays.target == RayTarget::nearest;
    const std::string target = std::string(" to the ") + (is_nearest ? "nearest" : "outermost") + " front face";
    if (!rays.skew.texels.empty()) return "rays along the directions of the skew map" + target;
    switch (rays.directions) {
        case RayDirections::automatic: return "rays along face normals averaged at hard edges" + target;
        case RayDirections::averaged: return "rays along averaged normals" + target;
        case RayDirections::normals: break;
    }
    return "rays along the stored normals" + target;
}

void addRaysToVerdict(Measuring& state) {
    if (!state.other_rays) return;
    const TriedRays& best = state.tried.front();
    const bool is_near = best.reach == state.options.map.reach;
    const std::string away = is_near ? "" : " (reach " + shortNumber(best.reach) + " model units)";
    state.report.verdict +=
        (state.report.verdict.empty() ? "The map was baked with " : " It was baked with ") + raysPhrase(best.options) +
        away + ": its mean error is " + degreesWord(best.error.mean_deg) + " degrees with these rays, and " +
        degreesWord(state.report.error.mean_deg) + " degrees with " + raysPhrase(state.options.map.rays) + ".";
}

/// Sorts the interpretations and judges the best. `asked` is a copy, because the list is sorted.
void judge(Measuring& state, const ExplainedReading asked) {
    // Among interpretations with indistinguishable errors, the one closest to the requested one is chosen.
    constexpr double kTie = 1.02;
    const auto differences = [&](const ExplainedReading& reading) {
        return (reading.frames != asked.frames ? 1 : 0) + (reading.axes == asked.axes ? 0 : 1) +
               (reading.reading.green != asked.reading.green ? 1 : 0) +
               (reading.reading.bitangent != asked.reading.bitangent ? 1 : 0) +
               (reading.reading.two_channels != asked.reading.two_channels ? 1 : 0);
    };
    // All interpretations miss at the same samples, so misses do not distinguish them.
    std::stable_sort(state.report.readings.begin(), state.report.readings.end(),
                     [](const auto& a, const auto& b) { return a.error.met_mean_deg < b.error.met_mean_deg; });
    const double tie = kTie * state.report.readings.front().error.met_mean_deg;
    const auto end = std::find_if(state.report.readings.begin(), state.report.readings.end(),
                                  [&](const ExplainedReading& reading) { return reading.error.met_mean_deg > tie; });
    std::stable_sort(state.report.readings.begin(), end,
                     [&](const auto& a, const auto& b) { return differences(a) < differences(b); });
    const ExplainedReading& best = state.report.readings.front();
    const double mean = asked.error.met_mean_deg, better = best.error.met_mean_deg;
    const bool reads_well = !isMuchBetter(better, mean);
    state.report.fits = reads_well && !state.other_rays;
    if (asked.error.missed_count > asked.error.point_count) {
        state.report.fits = false;
        state.report.verdict = "Most rays from the low poly do not hit the high poly within " +
                               shortNumber(asked.error.reach) +
                               ", so the map cannot be measured. Check that the models overlap, or raise --reach.";
        return;
    }
    if (better > kUnexplainedDeg) {
        state.report.fits = false;
        state.report.verdict =
            "No interpretation of the map fits: the best one has an error of " + degreesWord(better) +
            " degrees on average, so the map was probably made for another model or other UVs, or the high poly is "
            "not aligned with the low poly" +
            (state.shows_several ? "; or the map is for a single material, which --material selects." : ".");
    } else if (!reads_well) {
        state.report.verdict = "The map was made for " + difference(asked, best) +
                               ": with this interpretation, its error is " + degreesWord(better) +
                               " degrees on average; with the current interpretation it is " + degreesWord(mean) + ".";
    } else if (!state.other_rays) {
        state.report.verdict = "The map fits the model: its error is " + degreesWord(mean) + " degrees on average.";
    }
    if (better <= kUnexplainedDeg) addRaysToVerdict(state);
    if (asked.error.missed_count * 1000 > asked.error.point_count)
        state.report.verdict +=
            " This excludes samples whose rays did not hit the high poly: " + std::to_string(asked.error.missed_count) +
            " of " + std::to_string(asked.error.missed_count + asked.error.point_count) + " samples.";
}

// -- 5. picture --

void writeHeat(Measuring& state, const MapImage& view, const LowPart& part, const HighModel& high) {
    MapErrorOptions options = state.options.map;
    options.heat = true;
    const MapError error = valueOrThrow(
        measureMap(view, part.view(), high.view(), options, state.options.execution, state.options.progress));
    state.report.heat_top_deg = error.p99_deg;
    const std::optional<std::vector<std::uint8_t>> png =
        encodePng({.width = view.width, .height = view.height, .texels = pictureOfHeat(error.heat, error.p99_deg)}, 8);
    if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
    AtomicOutput files({.sync = state.options.file.sync, .inputs = &state.inputs});
    files.add(state.options.heat, std::span<const std::uint8_t>(*png));
    files.commit();
}

MapErrorFileReport measureFile(Measuring& state, const std::string& map, const std::string& low,
                               const std::string& high) {
    requireEndingIfAny(state.options.heat, {".png"});
    state.options.map.reading.two_channels = state.options.map.reading.two_channels || state.options.two_channels;
    state.bake = bakeOptionsOf(state.options);
    state.inputs.watch(state.bake.file);
    state.inputs.add(map);
    state.image = tagInput(BakeInput::map, [&] { return readFloatImage(map, state.bake.file); });
    const std::string how_read = readTextureVectors(state.image);
    state.report.width = state.image.width;
    state.report.height = state.image.height;
    state.report.bits = state.image.bits;
    const BakeModels models = readBakeModels(low, high, state.bake);
    state.report.frames_made = models.low.frames_made;
    state.report.matched_by_name = models.matched_by_name;
    state.report.high_maps = models.high.shown.reports;
    state.report.warnings = models.low.warnings;
    state.report.warnings.insert(state.report.warnings.end(), models.high.warnings.begin(), models.high.warnings.end());
    if (!how_read.empty()) state.report.warnings.push_back(how_read);
    const LowModel::Image shown = tagInput(BakeInput::low, [&] { return shownPart(models.low, state.options); });
    const LowPart& part = shown.part;
    state.options.map.reach = models.reach(state.options.map.reach);
    state.options.map.rays =
        models.rays(state.options.map.rays, state.options.tile == 0 ? shown.wrap_u : TextureWrap::repeat,
                    state.options.tile == 0 ? shown.wrap_v : TextureWrap::repeat);
    listFrames(state, low, models.low);
    const MapImage view{.width = state.image.width,
                        .height = state.image.height,
                        .texels = state.image.texels,
                        .wrap_u = state.options.tile == 0 ? shown.wrap_u : TextureWrap::repeat,
                        .wrap_v = state.options.tile == 0 ? shown.wrap_v : TextureWrap::repeat};
    listReadings(state);
    const auto measure = [&](const std::vector<MapCandidate>& candidates, const MapErrorOptions& how) {
        return tagInput(BakeInput::low, [&] {
            return valueOrThrow(measureReadings(view, part.view(), models.high.view(), candidates, how,
                                                state.options.execution, state.options.progress));
        });
    };
    storeErrors(state, measure(state.candidates, state.options.map));
    // The first interpretation is the requested one.
    state.report.error = state.report.readings.front().error;
    tryRays(state, measure);
    if (state.other_rays) {
        MapErrorOptions with_best = state.options.map;
        with_best.rays = state.tried.front().options;
        with_best.reach = state.tried.front().reach;
        storeErrors(state, measure(state.candidates, with_best));
    }
    state.shows_several = models.low.images.size() > 1 && state.options.material.empty();
    judge(state, state.report.readings.front());
    if (!state.options.heat.empty()) writeHeat(state, view, part, models.high);
    return std::move(state.report);
}

}  // namespace

Result<MapErrorFileReport> mapErrorFile(const std::string& map, const std::string& low, const std::string& high,
                                        const MapErrorFileOptions& options) {
    return atFileBorder([&]() -> Result<MapErrorFileReport> {
        Measuring state{.options = options};
        return measureFile(state, map, low, high);
    });
}

}  // namespace tspace

namespace tspace::report {

std::string mapErrorJson(const Outcome<MapErrorFileReport>& outcome, const std::string& low, const std::string& high,
                         ExitCode exit_code) {
    const Result<MapErrorFileReport>& result = outcome.result;
    Json json = documentJson("tspace.map-error/1", result.ok(), exit_code);
    json["map"] = outcome.input;
    json["low"] = low;
    json["high"] = high;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bits"] = result->bits;
    json["fits"] = result->fits;
    json["verdict"] = result->verdict;
    json["reach"] = result->error.reach;
    json["cageOffset"] = result->error.cage_offset;
    json["angles"] = errorOfMapJson(result->error);
    json["rays"] = listJson(result->rays, [](const ExplainedRays& rays) -> Json {
        return {{"rays", raysWord(rays.rays)},
                {"directions", directionsWord(rays.rays)},
                {"reach", rays.error.reach},
                {"cageOffset", rays.error.cage_offset},
                {"angles", errorOfMapJson(rays.error)}};
    });
    json["readings"] = listJson(result->readings, [](const ExplainedReading& reading) -> Json {
        return {{"frames", reading.frames},
                {"axes", reading.axes == MapAxes{}     ? "y-up"
                         : reading.axes == kMapAxesZUp ? "z-up"
                                                       : "other"},
                {"green", reading.reading.green == Green::up ? "up" : "down"},
                {"bitangent", reading.reading.bitangent == BitangentPlace::perPixel ? "pixel" : "vertex"},
                {"unitVectors", reading.reading.unit_vectors},
                {"twoChannels", reading.reading.two_channels},
                {"angles", errorOfMapJson(reading.error)}};
    });
    json["framesMade"] = result->frames_made;
    json["matchedByName"] = result->matched_by_name;
    json["highMaps"] = listJson(result->high_maps, highMapJson);
    json["heatTopDeg"] = result->heat_top_deg;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
