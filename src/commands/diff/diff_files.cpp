// SPDX-License-Identifier: MIT
// diffFiles: reads two models, pairs their triangles, and compares them corner by corner. Also the options of diff and
// identify, and the report of diff as JSON.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "commands/diff/diff_report.h"
#include "commands/diff/pair_primitives.h"
#include "commands/shared/file_options.h"
#include "commands/shared/request.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"
#include "tspace/inspect.h"

namespace tspace {
namespace {

// Collection of angles, and its statistics.

class AngleSamples {
  public:
    /// Adds the angle in degrees between two directions of any length. Pairs with one unusable direction (zero or
    /// non-finite) are counted. Returns the angle, or 0 for unusable directions.
    double add(const Vec3& a, const Vec3& b);
    void append(const AngleSamples& other);

    /// Sorts the angles; O(n log n).
    [[nodiscard]] AngleStatistics statistics() const;

  private:
    std::vector<float> degrees_ = {};
    std::uint64_t unusable_count_ = 0;
};

// Percentiles (nearest-rank method).

/// Returns the smallest value that at least `share` of all values do not exceed.
double percentile(const std::vector<float>& sorted, double share) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

double AngleSamples::add(const Vec3& a, const Vec3& b) {
    const bool has_a = isDirection(a), has_b = isDirection(b);
    if (!has_a || !has_b) {
        unusable_count_ += has_a != has_b;
        return 0;
    }
    const double degrees = angleBetween(toDouble(a), toDouble(b)) * (180 / kPi);
    degrees_.push_back(static_cast<float>(degrees));
    return degrees;
}

void AngleSamples::append(const AngleSamples& other) {
    degrees_.insert(degrees_.end(), other.degrees_.begin(), other.degrees_.end());
    unusable_count_ += other.unusable_count_;
}

AngleStatistics AngleSamples::statistics() const {
    AngleStatistics result;
    result.count = degrees_.size();
    result.unusable_count = unusable_count_;
    if (degrees_.empty()) return result;
    std::vector<float> sorted = degrees_;
    sortList(sorted.begin(), sorted.end());
    double sum = 0;
    for (const float value : sorted) {
        sum += value;
        const auto bin = std::lower_bound(kAngleBins.begin(), kAngleBins.end() - 1, static_cast<double>(value));
        ++result.histogram[static_cast<std::size_t>(bin - kAngleBins.begin())];
    }
    result.mean_deg = sum / static_cast<double>(sorted.size());
    result.median_deg = percentile(sorted, 0.5);
    result.p95_deg = percentile(sorted, 0.95);
    result.max_deg = sorted.back();
    return result;
}

struct FrameSamples {
    AngleSamples tangents = {}, normals = {}, bitangents = {};

    void append(const FrameSamples& other) {
        tangents.append(other.tangents);
        normals.append(other.normals);
        bitangents.append(other.bitangents);
    }
};

/// Returns 1, -1, 0, or 2 for NaN: an invalid value differs from every sign, but not from itself.
int signOf(float w) {
    if (std::isnan(w)) return 2;
    return (w > 0) - (w < 0);
}

Vec3 bitangentOf(const Vec3& normal, const Vec4& tangent) { return tangent.w * cross(normal, xyz(tangent)); }

/// The worst corners found so far, each vertex of A once.
class WorstPlaces {
  public:
    explicit WorstPlaces(std::size_t most) : max_(most) {}

    void offer(const FrameDifference& difference) {
        if (max_ == 0 || worstOf(difference) == 0) return;
        if (places_.size() == max_ && !isWorse(difference, places_.back())) return;
        const auto same = std::find_if(places_.begin(), places_.end(), [&](const FrameDifference& place) {
            return place.mesh_a == difference.mesh_a && place.primitive_a == difference.primitive_a &&
                   place.vertex_a == difference.vertex_a;
        });
        if (same != places_.end()) {
            if (!isWorse(difference, *same)) return;
            places_.erase(same);
        }
        places_.insert(std::upper_bound(places_.begin(), places_.end(), difference, isWorse), difference);
        if (places_.size() > max_) places_.pop_back();
    }

    [[nodiscard]] const std::vector<FrameDifference>& places() const { return places_; }

  private:
    /// Returns the largest angle of a corner. The angle of the bitangent includes differences of the sign, which
    /// reverse the bitangent.
    static double worstOf(const FrameDifference& d) { return std::max({d.tangent_deg, d.normal_deg, d.bitangent_deg}); }
    static bool isWorse(const FrameDifference& a, const FrameDifference& b) { return worstOf(a) > worstOf(b); }

    std::size_t max_;
    std::vector<FrameDifference> places_ = {};  ///< sorted, the worst first
};

class Comparison {
  public:
    explicit Comparison(const DiffOptions& options) : worst_(options.worst_count) {}

    void compare(const Scene& a, const Scene& b) {
        for (const PrimitivePair& pair : pairPrimitives(a, b)) {
            const ScenePrimitive* in_a = pair.a == kNoPrimitive ? nullptr : &a.primitives[pair.a];
            const ScenePrimitive* in_b = pair.b == kNoPrimitive ? nullptr : &b.primitives[pair.b];
            PrimitiveDiff& diff = result_.primitives.emplace_back(describe(in_a, in_b, pair));
            result_.unpaired_triangle_count +=
                diff.triangle_count_a + diff.triangle_count_b - 2 * diff.paired_triangle_count;
            if (in_a == nullptr || in_b == nullptr) continue;
            result_.missing_count += diff.has_tangents_a != diff.has_tangents_b;
            compareCorners(*in_a, *in_b, pair, diff);
        }
    }

    FrameDiff result() {
        result_.tangents = all_.tangents.statistics();
        result_.normals = all_.normals.statistics();
        result_.bitangents = all_.bitangents.statistics();
        result_.worst = worst_.places();
        return std::move(result_);
    }

  private:
    static PrimitiveDiff describe(const ScenePrimitive* a, const ScenePrimitive* b, const PrimitivePair& pair) {
        PrimitiveDiff diff;
        if (a != nullptr) {
            diff.place_a = a->place;
            diff.mesh_a = a->mesh;
            diff.primitive_a = a->primitive;
            diff.triangle_count_a = a->corners.size() / 3;
            diff.has_tangents_a = !a->tangents.empty();
            diff.tangents_not_read_a = a->tangents_not_read;
            diff.has_normals_a = !a->normals.empty();
        }
        if (b != nullptr) {
            diff.place_b = b->place;
            diff.mesh_b = b->mesh;
            diff.primitive_b = b->primitive;
            diff.triangle_count_b = b->corners.size() / 3;
            diff.has_tangents_b = !b->tangents.empty();
            diff.tangents_not_read_b = b->tangents_not_read;
            diff.has_normals_b = !b->normals.empty();
        }
        diff.mesh_name = a != nullptr ? a->mesh_name : b->mesh_name;
        diff.paired_by = pair.paired_by;
        diff.paired_triangle_count = pair.triangles.size();
        return diff;
    }

    void compareCorners(const ScenePrimitive& a, const ScenePrimitive& b, const PrimitivePair& pair,
                        PrimitiveDiff& diff) {
        FrameSamples samples;
        for (const TrianglePair& triangles : pair.triangles) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex_a = a.corners[std::size_t{3} * triangles.a + k];
                const std::uint32_t vertex_b = b.corners[std::size_t{3} * triangles.b + (k + triangles.rotation) % 3];
                compareFrames(a, b, vertex_a, vertex_b, diff, samples);
            }
        }
        result_.corner_count += pair.triangles.size() * 3;
        result_.sign_change_count += diff.sign_change_count;
        diff.tangents = samples.tangents.statistics();
        diff.normals = samples.normals.statistics();
        diff.bitangents = samples.bitangents.statistics();
        all_.append(samples);
    }

    void compareFrames(const ScenePrimitive& a, const ScenePrimitive& b, std::uint32_t vertex_a, std::uint32_t vertex_b,
                       PrimitiveDiff& diff, FrameSamples& samples) {
        FrameDifference difference{.mesh_a = a.mesh,
                                   .primitive_a = a.primitive,
                                   .vertex_a = vertex_a,
                                   .mesh_b = b.mesh,
                                   .primitive_b = b.primitive,
                                   .vertex_b = vertex_b,
                                   .position = a.positions[vertex_a]};
        const bool has_normals = diff.has_normals_a && diff.has_normals_b;
        if (has_normals) difference.normal_deg = samples.normals.add(a.normals[vertex_a], b.normals[vertex_b]);
        if (diff.has_tangents_a && diff.has_tangents_b) {
            const Vec4& tangent_a = a.tangents[vertex_a];
            const Vec4& tangent_b = b.tangents[vertex_b];
            difference.tangent_deg = samples.tangents.add(xyz(tangent_a), xyz(tangent_b));
            difference.sign_differs = signOf(tangent_a.w) != signOf(tangent_b.w);
            diff.sign_change_count += difference.sign_differs;
            if (has_normals) {
                difference.bitangent_deg = samples.bitangents.add(bitangentOf(a.normals[vertex_a], tangent_a),
                                                                  bitangentOf(b.normals[vertex_b], tangent_b));
            }
        }
        worst_.offer(difference);
    }

    FrameDiff result_ = {};
    FrameSamples all_ = {};
    WorstPlaces worst_;
};

/// Reads a scene; an error states which of the two files it refers to.
Scene readNumbered(const std::string& path, const FileOptions& options, std::uint64_t number) {
    try {
        return readScene(path, options, false);
    } catch (FileError& failure) {
        failure.error.element = number;
        throw;
    }
}

}  // namespace

bool FrameDiff::isWithin(double tolerance_deg) const {
    const auto within = [&](const AngleStatistics& angles) {
        return angles.unusable_count == 0 && angles.max_deg <= tolerance_deg;
    };
    return unpaired_triangle_count == 0 && missing_count == 0 && sign_change_count == 0 && within(tangents) &&
           within(normals) && within(bitangents);
}

Result<FrameDiff> diffFiles(const std::string& a, const std::string& b, const DiffOptions& options) {
    return atFileBorder([&]() -> Result<FrameDiff> {
        const Scene scene_a = readNumbered(a, options.file, 0);
        const Scene scene_b = readNumbered(b, options.file_b.value_or(options.file), 1);
        Comparison comparison(options);
        comparison.compare(scene_a, scene_b);
        FrameDiff result = comparison.result();
        for (const std::string& warning : scene_a.warnings) result.warnings.push_back(a + ": " + warning);
        for (const std::string& warning : scene_b.warnings) result.warnings.push_back(b + ": " + warning);
        return result;
    });
}

}  // namespace tspace

namespace tspace::options {

OptionList diffOptions(DiffRequest& request) {
    OptionList list;
    const auto add = adder(list, "Comparing");
    addAllowExternal(list, request.options.file);
    add(degrees("--tolerance", request.tolerance_deg, 180,
                "Exit with code 1 if an angle exceeds this tolerance, a sign differs, or a triangle has no match. In "
                "degrees, 0 to 180."));
    add(number("--worst", request.options.worst_count, 10000,
               "Number of vertices to list, in order of decreasing difference."));
    addLimits(list, request.options.file);
    return list;
}

OptionList identifyOptions(IdentifyOptions& options) {
    OptionList list;
    addAllowExternal(list, options.file);
    add(list, "Comparing",
        degrees("--tolerance", options.tolerance_deg, 180,
                "Tangents that differ by at most this angle are treated as equal. In degrees, 0 to 180."));
    addThreads(list, options.execution,
               "Number of threads; 0: one per core. The results are the same for any number of threads.");
    addLimits(list, options.file);
    return list;
}

OptionList inspectOptions(FileOptions& options) {
    OptionList list;
    addAllowExternal(list, options);
    addLimits(list, options);
    return list;
}

OptionList flipGreenOptions(FlipGreenOptions& options) {
    OptionList list;
    add(list, kInputAndOutput, dryRunOption(options.dry_run));
    addMemoryLimit(list, options.memory_limit_bytes);
    addSync(list, options.sync);
    return list;
}

}  // namespace tspace::options

namespace tspace::report {
namespace {

Json anglesJson(const AngleStatistics& angles) {
    return Json::object({{"corners", angles.count},
                         {"unusable", angles.unusable_count},
                         {"meanDeg", angles.mean_deg},
                         {"medianDeg", angles.median_deg},
                         {"p95Deg", angles.p95_deg},
                         {"maxDeg", angles.max_deg},
                         {"histogram", angles.histogram}});
}

Json sideJson(const PrimitiveDiff& p, bool is_a) {
    const std::string& place = is_a ? p.place_a : p.place_b;
    if (place.empty()) return nullptr;
    return Json::object({{"place", place},
                         {"mesh", is_a ? p.mesh_a : p.mesh_b},
                         {"primitive", is_a ? p.primitive_a : p.primitive_b},
                         {"triangles", is_a ? p.triangle_count_a : p.triangle_count_b},
                         {"hasTangents", is_a ? p.has_tangents_a : p.has_tangents_b},
                         {"tangentsNotRead", is_a ? p.tangents_not_read_a : p.tangents_not_read_b},
                         {"hasNormals", is_a ? p.has_normals_a : p.has_normals_b}});
}

Json comparedPrimitiveJson(const PrimitiveDiff& p) {
    return Json::object({{"a", sideJson(p, true)},
                         {"b", sideJson(p, false)},
                         {"meshName", p.mesh_name},
                         {"pairedBy", p.paired_by},
                         {"pairedTriangles", p.paired_triangle_count},
                         {"signChanges", p.sign_change_count},
                         {"tangents", anglesJson(p.tangents)},
                         {"normals", anglesJson(p.normals)},
                         {"bitangents", anglesJson(p.bitangents)}});
}

Json worstJson(const FrameDifference& d) {
    return Json::object({{"meshA", d.mesh_a},
                         {"primitiveA", d.primitive_a},
                         {"vertexA", d.vertex_a},
                         {"meshB", d.mesh_b},
                         {"primitiveB", d.primitive_b},
                         {"vertexB", d.vertex_b},
                         {"position", Json::array({d.position.x, d.position.y, d.position.z})},
                         {"tangentDeg", d.tangent_deg},
                         {"normalDeg", d.normal_deg},
                         {"bitangentDeg", d.bitangent_deg},
                         {"signDiffers", d.sign_differs}});
}

}  // namespace

std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code) {
    Json json = documentJson("tspace.diff/1", diff.ok(), exit_code);
    json["a"] = a;
    json["b"] = b;
    json["error"] = errorJson(diff ? nullptr : &diff.error());
    if (!diff) return jsonText(json);
    json["toleranceDeg"] = tolerance_deg;
    json["isWithinTolerance"] = diff->isWithin(tolerance_deg);
    json["corners"] = diff->corner_count;
    json["signChanges"] = diff->sign_change_count;
    json["unpairedTriangles"] = diff->unpaired_triangle_count;
    json["missingTangents"] = diff->missing_count;
    json["histogramUpperDeg"] = kAngleBins;
    json["tangents"] = anglesJson(diff->tangents);
    json["normals"] = anglesJson(diff->normals);
    json["bitangents"] = anglesJson(diff->bitangents);
    json["warnings"] = diff->warnings;
    json["worst"] = listJson(diff->worst, worstJson);
    json["primitives"] = listJson(diff->primitives, comparedPrimitiveJson);
    return jsonText(json);
}

}  // namespace tspace::report
