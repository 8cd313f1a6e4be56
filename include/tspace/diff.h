// SPDX-License-Identifier: MIT
// How much the frames of two models differ, when the models show the same surface: before and after a tool, two
// methods, two exporters. CMake target tspace::asset. Reads what asset.h reads, and changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/execution.h"
#include "tspace/result.h"
#include "tspace/vec.h"

namespace tspace {

/// Upper ends, in degrees, of the histogram's bins; each bin holds what is above the one before it.
inline constexpr std::array<double, 9> kAngleBins = {0.001, 0.01, 0.1, 1, 5, 10, 30, 90, 180};

/// Angles between two sets of directions, over pairs of corners.
struct AngleStatistics {
    std::uint64_t count = 0;           ///< pairs in which both directions are finite and not zero
    std::uint64_t unusable_count = 0;  ///< pairs in which one is not, and the other is not the same
    double mean_deg = 0;
    double median_deg = 0;  ///< half of the pairs differ by this or less
    double p95_deg = 0;     ///< 95 % of the pairs
    double max_deg = 0;
    std::array<std::uint64_t, kAngleBins.size()> histogram = {};  ///< pairs per bin of kAngleBins
};

/// One of the worst pairs.
struct FrameDifference {
    std::uint32_t mesh_a = 0, primitive_a = 0, vertex_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0, vertex_b = 0;
    Vec3 position = {};  ///< in A
    double tangent_deg = 0;
    double normal_deg = 0;
    double bitangent_deg = 0;
    bool sign_differs = false;
};

/// Two primitives that show the same surface, or one without a partner.
struct PrimitiveDiff {
    std::string place_a = {}, place_b = {};  ///< JSON pointers (OBJ: "usemtl NAME"); empty: no partner
    std::uint32_t mesh_a = 0, primitive_a = 0;
    std::uint32_t mesh_b = 0, primitive_b = 0;
    std::string mesh_name = {};  ///< that of A, or of B when there is no A; may be empty
    /// "geometry" (same triangles, in any order and split or not), "name", "order" (neither fits, but the counts do),
    /// or "none": it has no partner.
    std::string paired_by = {};
    std::uint64_t triangle_count_a = 0, triangle_count_b = 0;
    std::uint64_t paired_triangle_count = 0;
    bool has_tangents_a = false, has_tangents_b = false;
    /// It has none as it was read, but the importer cannot tell that there are none in the file.
    bool tangents_not_read_a = false, tangents_not_read_b = false;
    bool has_normals_a = false, has_normals_b = false;
    std::uint64_t sign_change_count = 0;  ///< pairs of corners whose signs differ
    AngleStatistics tangents = {};
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};  ///< sign * cross(N, T), rebuilt as a shader does it
};

struct DiffOptions {
    FileOptions file = {};
    std::optional<FileOptions> file_b = {};  ///< how B is opened, where that is not how A is
    std::size_t worst_count = 8;             ///< how many of the worst places are listed
};

struct FrameDiff {
    std::vector<PrimitiveDiff> primitives = {};  ///< those of A in file order, then those of B without a partner
    AngleStatistics tangents = {};               ///< over all pairs of the file
    AngleStatistics normals = {};
    AngleStatistics bitangents = {};
    std::uint64_t corner_count = 0;  ///< pairs of corners that were looked at
    std::uint64_t sign_change_count = 0;
    std::uint64_t unpaired_triangle_count = 0;  ///< triangles of A and B without a partner
    std::uint64_t missing_count = 0;            ///< paired primitives of which only one has tangents
    std::vector<FrameDifference> worst = {};    ///< the largest angle of T, B or N first; equal vertices once
    std::vector<std::string> warnings =
        {};  ///< sentences about A, then B, found while they were read; each names its file

    /// True when every triangle has a partner, no sign differs, and no angle is above `tolerance_deg`.
    [[nodiscard]] bool isWithin(double tolerance_deg) const;
};

/// Reads two models and compares their frames corner by corner.
///
/// Primitives are paired by their triangles: as sets of corner positions (and UVs), so that the order of triangles and
/// vertices, split vertices and other indices do not matter. What is left is paired by name, then by place in the file
/// when it has as many triangles; its triangles are paired where they lie at the same place but for rounding (1/1000 of
/// the primitive's size) once both primitives are scaled to one box, as after quantisation. Errors: those of
/// generateFile for reading; `element` is 0 when A is at fault, 1 when B is. Expected time n log n in the number of
/// corners. Thread-safe.
Result<FrameDiff> diffFiles(const std::string& a, const std::string& b, const DiffOptions& options = {});

}  // namespace tspace
