// SPDX-License-Identifier: MIT
// Model files as the arrays that baking takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asset/scene.h"
#include "tspace/bake_file.h"

namespace tspace {

/// Triangles of a low poly, three entries each.
struct LowPart {
    std::vector<Vec3> positions = {}, normals = {}, cage = {};
    std::vector<Vec4> tangents = {};
    std::vector<Vec2> uvs = {};
    std::vector<std::uint32_t> groups = {};

    [[nodiscard]] LowPoly view() const {
        return {.positions = positions,
                .normals = normals,
                .tangents = tangents,
                .uvs = uvs,
                .cage = cage,
                .groups = groups};
    }
    [[nodiscard]] std::size_t triangleCount() const { return positions.size() / 3; }
    /// Appends a triangle of another one.
    void addTriangle(const LowPart& from, std::size_t triangle);
};

/// What of a low poly shares a material, and so an image.
struct LowModel {
    struct Image {
        std::string material = {};
        LowPart part = {};
    };
    std::vector<Image> images = {};
    std::vector<std::string> warnings = {};
    bool frames_made = false;

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] bool hasCage() const { return !images.empty() && !images.front().part.cage.empty(); }
};

struct HighModel {
    std::vector<Vec3> positions = {}, normals = {};
    std::vector<std::uint32_t> corners = {}, groups = {};
    std::vector<std::string> warnings = {};

    [[nodiscard]] HighPoly view() const {
        return {.positions = positions, .normals = normals, .corners = corners, .groups = groups};
    }
};

/// Both models of a bake.
struct BakeModels {
    LowModel low = {};
    HighModel high = {};
    bool matched_by_name = false;
};

/// Reads the models, makes the frames that the low poly lacks, and matches meshes by name. Throws FileError: also where the
/// low poly has no UVs, where the cage has other triangles, and where one of them has none at all.
BakeModels readBakeModels(const std::string& low, const std::string& high, const BakeFileOptions& options);

/// The low poly with tangents of `options`.tangents computed anew on these faces, in the order that readBakeModels gives. Nothing
/// where that method gives another number of triangles. Throws FileError.
std::optional<LowModel> readLowAnew(const std::string& low, const BakeFileOptions& options, Faces faces,
                                    const LowModel& known);

}  // namespace tspace
