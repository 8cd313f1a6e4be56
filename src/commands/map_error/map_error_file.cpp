// SPDX-License-Identifier: MIT
// mapErrorFile: reads a map and both models, and measures the error; its report as JSON.
#include <algorithm>
#include <charconv>

#include "commands/bake/bake_report.h"
#include "commands/bake/model_surfaces.h"
#include "commands/map_error/map_error_report.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/texture_vectors.h"
#include "core/base/numbers.h"
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
constexpr double kMuchBetter = 0.7, kLeastGainDeg = 0.02;
/// If the errors of all interpretations exceed this angle, none explains the map.
constexpr double kUnexplainedDeg = 5;

struct TriedFrames {
    std::string name = {};
    std::vector<Vec4> tangents = {};  ///< empty: tangents of the low poly
};

struct TriedRays {
    RayOptions options = {};
    double reach = 0;
    MapError error = {};
};

/// Merges all images of a model, or the part selected by the options, into one.
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

class FileMeasuring {
  public:
    explicit FileMeasuring(const MapErrorFileOptions& options) : options_(options) {
        options_.map.reading.two_channels = options_.map.reading.two_channels || options_.two_channels;
        bake_.execution = options.execution;
        bake_.progress = options.progress;
        bake_.tangents = options.tangents;
        bake_.normals = options.normals;
        bake_.file = options.file;
        inputs_.watch(bake_.file);
        bake_.cage = options.cage;
        bake_.skew = options.skew;
        bake_.match = options.match;
        bake_.ignore_high_maps = options.ignore_high_maps;
        bake_.high_green = options.high_green;
    }

    MapErrorFileReport run(const std::string& map, const std::string& low, const std::string& high) {
        requireEndingIfAny(options_.heat, {".png"});
        inputs_.add(map);
        image_ = tagInput(BakeInput::map, [&] { return readFloatImage(map, bake_.file); });
        const std::string how_read = readTextureVectors(image_);
        report_.width = image_.width;
        report_.height = image_.height;
        report_.bits = image_.bits;
        const BakeModels models = readBakeModels(low, high, bake_);
        report_.frames_made = models.low.frames_made;
        report_.matched_by_name = models.matched_by_name;
        report_.high_maps = models.high.shown.reports;
        report_.warnings = models.low.warnings;
        report_.warnings.insert(report_.warnings.end(), models.high.warnings.begin(), models.high.warnings.end());
        if (!how_read.empty()) report_.warnings.push_back(how_read);
        const LowModel::Image shown = tagInput(BakeInput::low, [&] { return shownPart(models.low, options_); });
        const LowPart& part = shown.part;
        options_.map.reach = models.reach(options_.map.reach);
        options_.map.rays = models.rays(options_.map.rays, options_.tile == 0 ? shown.wrap_u : TextureWrap::repeat,
                                        options_.tile == 0 ? shown.wrap_v : TextureWrap::repeat);
        listFrames(low, models.low);
        const MapImage view{.width = image_.width,
                            .height = image_.height,
                            .texels = image_.texels,
                            .wrap_u = options_.tile == 0 ? shown.wrap_u : TextureWrap::repeat,
                            .wrap_v = options_.tile == 0 ? shown.wrap_v : TextureWrap::repeat};
        listReadings();
        const auto measure = [&](const std::vector<MapCandidate>& candidates, const MapErrorOptions& how) {
            return tagInput(BakeInput::low, [&] {
                return valueOrThrow(measureReadings(view, part.view(), models.high.view(), candidates, how,
                                                    options_.execution, options_.progress));
            });
        };
        takeErrors(measure(candidates_, options_.map));
        // The first interpretation is the requested one.
        report_.error = report_.readings.front().error;
        tryRays(measure);
        if (other_rays_) {
            MapErrorOptions with_best = options_.map;
            with_best.rays = tried_.front().options;
            with_best.reach = tried_.front().reach;
            takeErrors(measure(candidates_, with_best));
        }
        shows_several_ = models.low.images.size() > 1 && options_.material.empty();
        judge(report_.readings.front());
        if (!options_.heat.empty()) writeHeat(view, part, models.high);
        return std::move(report_);
    }

  private:
    /// Lists the frames for which the map may have been baked.
    void listFrames(const std::string& low, const LowModel& known) {
        frames_.push_back({"file"});
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
            bake_.tangents.method = tried.method;
            const std::optional<LowModel> model = readLowAnew(low, bake_, tried.faces, known);
            if (!model) continue;
            std::vector<Vec4> tangents = shownPart(*model, options_).part.corners.tangents;
            const auto is_known = [&](const TriedFrames& frames) { return frames.tangents == tangents; };
            if (tangents == shownPart(known, options_).part.corners.tangents) continue;
            if (std::none_of(frames_.begin(), frames_.end(), is_known))
                frames_.push_back({tried.name, std::move(tangents)});
        }
    }

    void listReadings() {
        const auto add = [&](const std::string& frames, const MapCandidate& candidate) {
            candidates_.push_back(candidate);
            report_.readings.push_back({.frames = frames, .axes = candidate.axes, .reading = candidate.reading});
        };
        const bool in_object = options_.map.space == MapSpace::object;
        add(in_object ? "object" : "file",
            {.space = options_.map.space, .reading = options_.map.reading, .axes = options_.map.axes});
        const MapReading& asked = options_.map.reading;
        for (const TriedFrames& frames : frames_) {
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
            if (in_object || !blueMatters()) break;
            MapReading reading = asked;
            reading.green = green;
            reading.two_channels = !asked.two_channels;
            add("file", {MapSpace::tangent, reading, {}});
        }
        for (const MapAxes& axes : {MapAxes{}, kMapAxesZUp}) {
            if (!in_object || !(axes == options_.map.axes)) add("object", {.space = MapSpace::object, .axes = axes});
        }
    }

    void takeErrors(const std::vector<MapError>& errors) {
        for (std::size_t i = 0; i < errors.size(); ++i) report_.readings[i].error = errors[i];
    }

    /// Returns whether z of the texels differs from the z reconstructed from x and y, in more than a few of the tilted
    /// texels.
    [[nodiscard]] bool blueMatters() const {
        constexpr double kLeanDeg = 5, kOtherDeg = 2;
        constexpr std::size_t kOneOf = 20;
        MapReading three = options_.map.reading, two = three;
        three.two_channels = false;
        two.two_channels = true;
        std::size_t leaning = 0, other = 0;
        for (const Vec3& texel : image_.texels) {
            const DVec3 a = decodeTexel(texel, three), b = decodeTexel(texel, two);
            if (degreesBetween(a, {0, 0, 1}) < kLeanDeg && degreesBetween(b, {0, 0, 1}) < kLeanDeg) continue;
            ++leaning;
            other += degreesBetween(a, b) > kOtherDeg ? 1 : 0;
        }
        return other * kOneOf > leaning;
    }

    /// Measures the map with the rays that it may have been baked with.
    template <class Measure>
    void tryRays(const Measure& measure) {
        const RayOptions& asked = options_.map.rays;
        if (!options_.cage.empty()) {
            report_.rays.push_back({{.has_cage = true}, report_.error});
            return;
        }
        constexpr std::uint32_t kPoints = 20000;
        const auto best =
            std::min_element(report_.readings.begin(), report_.readings.end(),
                             [](const auto& a, const auto& b) { return a.error.met_mean_deg < b.error.met_mean_deg; });
        MapCandidate reading = candidates_[static_cast<std::size_t>(best - report_.readings.begin())];
        listRays(asked);
        std::vector<MapCandidate> candidates;
        for (const TriedRays& rays : tried_) {
            reading.rays = &rays.options;
            reading.reach = rays.reach;
            candidates.push_back(reading);
        }
        MapErrorOptions map = options_.map;
        map.point_count = std::min(map.point_count, kPoints);
        const std::vector<MapError> errors = measure(candidates, map);
        for (std::size_t i = 0; i < errors.size(); ++i) tried_[i].error = errors[i];
        const double mean = errors.front().mean_deg;
        std::stable_sort(tried_.begin(), tried_.end(),
                         [](const auto& a, const auto& b) { return a.error.mean_deg < b.error.mean_deg; });
        const double better = tried_.front().error.mean_deg;
        other_rays_ = isMuchBetter(better, mean);
        for (const TriedRays& rays : tried_)
            report_.rays.push_back(
                {{rays.options.target, rays.options.directions, !rays.options.skew.texels.empty()}, rays.error});
    }

    /// Lists the requested rays first, then others. A cage is also tried with a smaller and a larger reach.
    void listRays(const RayOptions& asked) {
        const double reach = options_.map.reach;
        tried_.push_back({asked, reach});
        // Among rays with the same hits, the first is reported.
        for (const double factor : {1.0, 0.25, 3.0}) {
            for (const RayTarget target : {RayTarget::outermost, RayTarget::nearest}) {
                for (const RayDirections directions :
                     {RayDirections::automatic, RayDirections::averaged, RayDirections::normals}) {
                    TriedRays tried{{.target = target, .directions = directions}, factor * reach};
                    const bool is_asked = target == asked.target && directions == asked.directions &&
                                          asked.skew.texels.empty() && factor == 1 && asked.cage_offset == 0;
                    if (!is_asked) tried_.push_back(tried);
                }
            }
        }
    }

    static bool isMuchBetter(double better, double than) {
        return better < kMuchBetter * than && than - better > kLeastGainDeg;
    }

    /// Sorts the interpretations and judges the best. `asked` is a copy, because the list is sorted.
    void judge(const ExplainedReading asked) {
        // Among interpretations with indistinguishable errors, the one closest to the requested one is chosen.
        constexpr double kTie = 1.02;
        const auto differences = [&](const ExplainedReading& reading) {
            return (reading.frames != asked.frames ? 1 : 0) + (reading.axes == asked.axes ? 0 : 1) +
                   (reading.reading.green != asked.reading.green ? 1 : 0) +
                   (reading.reading.bitangent != asked.reading.bitangent ? 1 : 0) +
                   (reading.reading.two_channels != asked.reading.two_channels ? 1 : 0);
        };
        // All interpretations miss at the same samples, so misses do not distinguish them.
        std::stable_sort(report_.readings.begin(), report_.readings.end(),
                         [](const auto& a, const auto& b) { return a.error.met_mean_deg < b.error.met_mean_deg; });
        const double tie = kTie * report_.readings.front().error.met_mean_deg;
        const auto end =
            std::find_if(report_.readings.begin(), report_.readings.end(),
                         [&](const ExplainedReading& reading) { return reading.error.met_mean_deg > tie; });
        std::stable_sort(report_.readings.begin(), end,
                         [&](const auto& a, const auto& b) { return differences(a) < differences(b); });
        const ExplainedReading& best = report_.readings.front();
        const double mean = asked.error.met_mean_deg, better = best.error.met_mean_deg;
        const bool reads_well = !isMuchBetter(better, mean);
        report_.fits = reads_well && !other_rays_;
        if (asked.error.missed_count > asked.error.point_count) {
            report_.fits = false;
            report_.verdict = "Most rays from the low poly do not hit the high poly within " +
                              shortNumber(asked.error.reach) +
                              ", so the map cannot be measured: the models do not overlap.";
            return;
        }
        if (better > kUnexplainedDeg) {
            report_.fits = false;
            report_.verdict =
                "No interpretation of the map fits: the best one has an error of " + degreesWord(better) +
                " degrees on average, so the map was probably made for another model or other UVs, or the high poly is "
                "not aligned with the low poly" +
                (shows_several_ ? "; or the map is for a single material, which --material selects." : ".");
        } else if (!reads_well) {
            report_.verdict = "The map was made for " + difference(asked, best) +
                              ": with this interpretation, its error is " + degreesWord(better) +
                              " degrees on average; with the current interpretation it is " + degreesWord(mean) + ".";
        } else if (!other_rays_) {
            report_.verdict = "The map fits the model: its error is " + degreesWord(mean) + " degrees on average.";
        }
        if (better <= kUnexplainedDeg) addRaysToVerdict();
        if (asked.error.missed_count * 1000 > asked.error.point_count)
            report_.verdict +=
                " This excludes samples that did not hit the high poly: " + std::to_string(asked.error.missed_count) +
                " of " + std::to_string(asked.error.missed_count + asked.error.point_count) + " samples.";
    }

    void addRaysToVerdict() {
        if (!other_rays_) return;
        const TriedRays& best = tried_.front();
        const bool is_near = best.reach == options_.map.reach;
        const std::string away = is_near ? "" : ", within " + shortNumber(best.reach);
        report_.verdict += (report_.verdict.empty() ? "The map was baked with " : " It was baked with ") +
                           raysPhrase(best.options) + away + ": measured with these rays, its error is " +
                           degreesWord(best.error.mean_deg) + " degrees on average, and with " +
                           raysPhrase(options_.map.rays) + " it is " + degreesWord(report_.error.mean_deg) + ".";
    }

    static std::string raysPhrase(const RayOptions& rays) {
        const bool is_nearest = rays.target == RayTarget::nearest;
        const std::string which = is_nearest ? ", nearest" : ", outermost";
        if (!rays.skew.texels.empty()) return "painted directions" + which;
        switch (rays.directions) {
            case RayDirections::automatic:
                return (is_nearest ? "rays that bend at hard edges" : "a cage that bends at hard edges") + which;
            case RayDirections::averaged:
                return (is_nearest ? "averaged rays" : "an averaged cage") + which;
            case RayDirections::normals:
                break;
        }
        return "rays along the stored normals" + which;
    }

    /// Describes the conditions that the map was baked for, if they differ from this model.
    static std::string difference(const ExplainedReading& asked, const ExplainedReading& best) {
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
                    : "tangents that differ from those in the file (tspace generate --overwrite --method " +
                          best.frames + " makes them)");
        }
        if (best.reading.bitangent != asked.reading.bitangent)
            add(best.reading.bitangent == BitangentPlace::perVertex ? "a bitangent per vertex, as in three.js and Godot"
                                                                    : "a bitangent per pixel");
        if (best.reading.two_channels != asked.reading.two_channels)
            add(best.reading.two_channels ? "two channels, with z reconstructed from x and y (use --two-channels)"
                                          : "three channels");
        return words;
    }

    void writeHeat(const MapImage& view, const LowPart& part, const HighModel& high) {
        MapErrorOptions options = options_.map;
        options.heat = true;
        const MapError error =
            valueOrThrow(measureMap(view, part.view(), high.view(), options, options_.execution, options_.progress));
        report_.heat_top_deg = error.p99_deg;
        const std::optional<std::vector<std::uint8_t>> png = encodePng(
            {.width = view.width, .height = view.height, .texels = pictureOfHeat(error.heat, error.p99_deg)}, 8);
        if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
        AtomicOutput files({.sync = options_.file.sync, .inputs = &inputs_});
        files.add(options_.heat, std::span<const std::uint8_t>(*png));
        files.commit();
    }

    MapErrorFileOptions options_;
    InputFiles inputs_ = {};
    BakeFileOptions bake_ = {};
    FloatImage image_ = {};
    std::vector<TriedFrames> frames_ = {};
    std::vector<MapCandidate> candidates_ = {};
    std::vector<TriedRays> tried_ = {};  ///< sorted, the best first
    bool other_rays_ = false;            ///< rays other than the requested ones explain the map much better
    bool shows_several_ = false;         ///< several materials are shown
    MapErrorFileReport report_ = {};
};

}  // namespace

Result<MapErrorFileReport> mapErrorFile(const std::string& map, const std::string& low, const std::string& high,
                                        const MapErrorFileOptions& options) {
    return atFileBorder([&]() -> Result<MapErrorFileReport> { return FileMeasuring(options).run(map, low, high); });
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
