// SPDX-License-Identifier: MIT
// OBJ files: lines, the model, reading.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/vec_math.h"
#include "model/io/file_io.h"
#include "model/io/memory_budget.h"
#include "model/io/named_files.h"
#include "model/io/path.h"
#include "model/io/uri.h"
#include "tspace/file_options.h"

namespace tspace::obj {

// A first pass over the text of an OBJ file: makes it safe for the parser, and collects what the parser does not report.

/// One `f` line that has corners.
struct FaceLine {
    std::uint32_t line = 0;  ///< from 1
    std::uint32_t smoothing_group = 0;
};

struct LineNotes {
    std::vector<FaceLine> faces = {};                  ///< in file order: the parser reports exactly these
    std::vector<std::string> material_libraries = {};  ///< arguments of `mtllib`, in file order
    bool is_utf8 = true;
    bool has_smoothing_groups = false;
    std::uint64_t unreadable_number_count = 0;  ///< in v, vt, vn lines: not a number, or NaN or infinity by name
    std::uint32_t unreadable_number_line = 0;   ///< the first of them
    bool has_vertex_colors = false;
    bool has_lines_or_points = false;
    bool has_free_form = false;  ///< curves and surfaces
};

/// Turns all line ends into \n, and blanks NUL bytes and a byte order mark.
void makeLineEndsPlain(std::string& text);

/// makeLineEndsPlain; also joins lines that end in a backslash (their line end becomes spaces) and blanks
/// comments behind faces. Fails with invalidFile on an index with more than 9 digits, which the parser would
/// wrap around silently. Linear.
LineNotes prepareLines(std::string& text);

// An OBJ file in memory: checked, with its own structure of faces, corners and smoothing groups.

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Indices of one corner; kNone where the face gives none.
struct Corner {
    std::uint32_t position = kNone;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
};

struct Face {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0;
    std::uint32_t shape = 0;     ///< into Model::shape_names
    std::uint32_t material = 0;  ///< into Model::materials
    std::uint32_t smoothing_group = 0;
    std::uint32_t line = 0;  ///< in the file, from 1
};

/// A texture that a material names. `file` is as the MTL file has it, relative to `folder`.
struct Texture {
    std::string file = {};
    Path folder = {};
    [[nodiscard]] bool used() const { return !file.empty(); }
    /// Equal for textures that name one file by the same path.
    [[nodiscard]] std::string path() const { return (folder / file).string(); }
};

struct Material {
    std::string name = {};
    bool found = false;  ///< false: the faces name it, but no MTL file has it (or there is none)
    Vec3 base_color{1, 1, 1};
    float opacity = 1;
    Vec3 emission{0, 0, 0};
    float metallic = 0;
    float roughness = 1;
    Texture base_color_texture = {};
    Texture normal_texture = {};
    bool normal_is_bump = false;  ///< it is named by map_bump, which takes height maps too
    float normal_scale = 1;       ///< -bm: the scale of a normal map, or the height of white in a height map
    /// Replaces the normal texture in the output; null: the texture stays.
    std::shared_ptr<const Bytes> made_normal_map = {};
};

struct Model {
    NamedFiles files = {};             ///< files that the model names
    std::vector<Vec3> positions = {};  ///< all finite; without `offset`
    DVec3 offset = {};                 ///< subtracted from the file's coordinates; zero near the origin
    bool keeps_offset = false;         ///< one would have been subtracted but for FileOptions::keep_coordinates
    std::vector<Vec2> uvs = {};        ///< with v running down, as in glTF
    std::vector<Vec3> normals = {};    ///< unit or zero; corners never refer to zero ones
    std::vector<Corner> corners = {};  ///< every index is in range
    std::vector<Face> faces = {};      ///< in file order, at least 3 corners each; never empty
    std::vector<std::string> shape_names = {};
    std::vector<Material> materials = {};  ///< in order of first use by a face
    bool has_smoothing_groups = false;     ///< the file has `s` lines
    /// Replacements of normal maps in the output, by Texture::path.
    std::map<std::string, Bytes> flipped_maps = {};
    std::uint64_t input_bytes = 0;              ///< the OBJ and its MTL files
    std::vector<std::string> input_files = {};  ///< all files that were read
    std::vector<std::string> warnings = {};
    std::shared_ptr<MemoryBudget> memory = std::make_shared<MemoryBudget>();  ///< remaining memory budget
};

// Reads OBJ and MTL files into a Model. Functions throw FileError.

/// Fails with cannotRead, invalidFile (place: "line N") and unsupportedFile. MTL files that are missing or
/// forbidden are left out with a warning.
Model readModel(const Path& path, const FileOptions& options);

/// The materials of the named libraries. `names` is what stands after `mtllib`: a file name, or several with
/// spaces between.
std::vector<Material> readMaterials(const std::vector<std::string>& names, Model& model);

}  // namespace tspace::obj
