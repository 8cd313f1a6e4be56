// SPDX-License-Identifier: MIT
// Reads, pairs, compares corner by corner.
#include <algorithm>
#include <cmath>
#include <set>

#include "commands/diff/angle_samples.h"
#include "commands/diff/pair_primitives.h"
#include "core/base/vec_math.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"
#include "tspace/diff.h"

namespace tspace {

namespace {

struct FrameSamples {
    AngleSamples tangents = {}, normals = {}, bitangents = {};

    void append(const FrameSamples& other) {
        tangents.append(other.tangents);
        normals.append(other.normals);
        bitangents.append(other.bitangents);
    }
};

/// 1, -1, 0, or 2 for a NaN: a value that is no sign differs from every sign, but not from itself.
int signOf(float w) {
    if (std::isnan(w)) return 2;
    return (w > 0) - (w < 0);
}

Vec3 bitangentOf(const Vec3& normal, const Vec4& tangent) { return tangent.w * cross(normal, xyz(tangent)); }

/// The worst places found so far, each vertex of A once.
class WorstPlaces {
  public:
    explicit WorstPlaces(std::size_t most) : most_(most) {}

    void offer(const FrameDifference& difference) {
        if (most_ == 0 || worstOf(difference) == 0) return;
        if (places_.size() == most_ && !isWorse(difference, places_.back())) return;
        const auto same = std::find_if(places_.begin(), places_.end(), [&](const FrameDifference& place) {
            return place.mesh_a == difference.mesh_a && place.primitive_a == difference.primitive_a &&
                   place.vertex_a == difference.vertex_a;
        });
        if (same != places_.end()) {
            if (!isWorse(difference, *same)) return;
            places_.erase(same);
        }
        places_.insert(std::upper_bound(places_.begin(), places_.end(), difference, isWorse), difference);
        if (places_.size() > most_) places_.pop_back();
    }

    [[nodiscard]] const std::vector<FrameDifference>& places() const { return places_; }

  private:
    /// A differing sign turns B round, so it counts by the angle of B.
    static double worstOf(const FrameDifference& d) { return std::max({d.tangent_deg, d.normal_deg, d.bitangent_deg}); }
    static bool isWorse(const FrameDifference& a, const FrameDifference& b) { return worstOf(a) > worstOf(b); }

    std::size_t most_;
    std::vector<FrameDifference> places_ = {};  ///< the worst first
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

/// An error says which of the two files it is about.
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
        return comparison.result();
    });
}

}  // namespace tspace
