// SPDX-License-Identifier: MIT
// Which method and which convention made the tangents of a model: every known method is run on the file's own
// positions, normals and UVs, and compared with what the file has. CMake target tspace::asset. Changes nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tspace/asset.h"
#include "tspace/execution.h"
#include "tspace/result.h"
#include "tspace/tangents.h"

namespace tspace {

/// What the stored signs mean, seen over all corners.
enum class SignReading : std::uint32_t {
    none = 0,      ///< nothing to go by: no corner has an orientation
    gltf = 1,      ///< as glTF wants it, B against growing v: the method was fed (u, 1 - v), or its sign negated
    inverted = 2,  ///< the opposite: the method was fed the file's raw UVs and its sign was stored as it came
    mixed = 3,     ///< neither holds for 95 % of the corners
};
/// "none", "gltf", "inverted", "mixed".
const char* signReadingName(SignReading reading);

/// How well one method explains the tangents. Corners of triangles whose UVs say nothing (without area, or so little
/// that rounding decides) vote in nothing: they are in no count but the last.
struct Explanation {
    Method method = Method::mikktspace;  ///< `best` with as many steps (TangentOptions::refine) as explain most
    /// quads: the method ran on quads that triangles were paired to (mikktspace only). There is such an entry only where
    /// it explains clearly more than the triangles do.
    Faces faces = Faces::triangles;
    std::int32_t uv_set = -1;     ///< n of the TEXCOORD_n followed; -1 over several primitives: the texture's set
    bool is_textures_set = true;  ///< it is the set that the material's texture is read with
    /// The UVs were taken as the texture's transform (KHR_texture_transform) turns or mirrors them; false: as they are
    /// stored.
    bool is_transformed = false;
    std::uint64_t corner_count = 0;  ///< corners compared: those with a stored tangent that has a direction
    std::uint64_t near_count = 0;    ///< of those, within the tolerance of the method's tangent at this corner
    /// Within the tolerance of the method's tangent at some corner of the same vertex: what remains when results per
    /// corner were written through the old index list, so that one corner's tangent serves all.
    std::uint64_t near_any_count = 0;
    double mean_deg = 0;                    ///< angle to the method's tangent at the corner
    std::uint64_t gltf_sign_count = 0;      ///< corners whose sign is what glTF wants for the method's orientation
    std::uint64_t inverted_sign_count = 0;  ///< corners whose stored sign is the opposite
    std::uint64_t undecided_count = 0;      ///< corners with a direction whose triangle's UVs say nothing

    [[nodiscard]] double nearShare() const { return corner_count == 0 ? 0 : double(near_count) / double(corner_count); }
    [[nodiscard]] double nearAnyShare() const {
        return corner_count == 0 ? 0 : double(near_any_count) / double(corner_count);
    }
    [[nodiscard]] SignReading signs() const;
};

struct PrimitiveIdentity {
    std::string place = {};  ///< JSON pointer (OBJ: "usemtl NAME")
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;     ///< in its mesh
    std::string mesh_name = {};      ///< may be empty
    std::string material_name = {};  ///< may be empty
    std::string skipped = {};        ///< why it was not looked at, for a person; empty: it was
    /// The best first; every method with every UV set that has an area.
    std::vector<Explanation> explanations = {};
    /// The texture's transform changes frames, so that its UV set has two readings, and one explains more corners.
    bool has_two_readings = false;
};

struct IdentifyOptions {
    FileOptions file = {};
    /// Tangents nearer than this count as the same: degrees, 0 to 180. Storing in 8 bits turns them by less than the default.
    double tolerance_deg = 1;
    Execution execution = {};  ///< changes no figure
};

struct Identification {
    std::string format = {};                 ///< "glb", "gltf", "obj"
    std::string generator = {};              ///< may be empty
    std::vector<std::string> warnings = {};  ///< sentences about the file, found while it was read
    /// Over all primitives, the best first: every method, along the texture's set in the reading that explains more.
    std::vector<Explanation> explanations = {};
    std::vector<PrimitiveIdentity> primitives = {};  ///< in file order
    std::string verdict = {};                        ///< two or three plain sentences
};

/// Reads a model and compares its tangents with those of mikktspace, angle, area, uniform, lengyel, flat and the other
/// methods of tspace that follow UVs; mikktspace also on quads, where pairs of triangles explain clearly more. "The
/// best" is the one with the most near corners; of those within half a percent the nearest in the mean, where that is
/// more than rounding, else the better known (that order). `fast` and `best`, which only tspace has, must explain 5 % more
/// than any other. Errors: those of generateFile for reading.
/// Time: about that of generating with each method. Thread-safe; the same result for any number of threads.
Result<Identification> identifyFile(const std::string& input, const IdentifyOptions& options = {});

}  // namespace tspace
