// SPDX-License-Identifier: MIT
// Reads OBJ files: lines, and the model that they describe.
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

// First pass over the text of an OBJ file: makes it safe for the parser, and collects what the parser does not report.

/// One `f` line that has corners.
struct FaceLine {
    std::uint32_t line = 0;  ///< line number, starting at 1
    std::uint32_t smoothing_group = 0;
};

struct LineNotes {
    std::vector<FaceLine> faces = {};                  ///< faces, in file order; the parser reports exactly these
    std::vector<std::string> material_libraries = {};  ///< arguments of `mtllib`, in file order
    bool is_utf8 = true;
    bool has_smoothing_groups = false;
    /// number of values in v, vt and vn lines that are not numbers, or NaN or infinity by name
    std::uint64_t unreadable_number_count = 0;
    std::uint32_t unreadable_number_line = 0;  ///< line of the first unreadable number
    bool has_vertex_colors = false;
    bool has_lines_or_points = false;
    bool has_free_form = false;  ///< the file has curves or surfaces
};

/// Converts all line ends to line feeds, and replaces NUL bytes and a byte order mark by blanks.
void makeLineEndsPlain(std::string& text);

/// Prepares the text of an OBJ file: calls makeLineEndsPlain, joins lines that end in a backslash (the line end becomes
/// spaces), and blanks comments after faces. Fails with invalidFile for an index with more than 9 digits, which would
/// overflow in the parser without an error. Linear.
LineNotes prepareLines(std::string& text);

// OBJ file in memory: checked, with its original faces, corners and smoothing groups.

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Indices of one corner; kNone for missing ones.
struct Corner {
    std::uint32_t position = kNone;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
};

struct Face {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0;
    std::uint32_t shape = 0;     ///< index into Model::shape_names
    std::uint32_t material = 0;  ///< index into Model::materials
    std::uint32_t smoothing_group = 0;
    std::uint32_t line = 0;  ///< line number in the file, starting at 1
};

/// Texture of a material. `file` is the name in the MTL file, relative to `folder`.
struct Texture {
    std::string file = {};
    Path folder = {};
    [[nodiscard]] bool used() const { return !file.empty(); }
    /// Returns `folder` and `file` joined. Used as a key: different spellings of one file give different paths.
    [[nodiscard]] std::string path() const { return (folder / file).string(); }
};

struct Material {
    std::string name = {};
    bool found = false;  ///< false: faces use the material, but no MTL file defines it (or there is none)
    Vec3 base_color{1, 1, 1};
    float opacity = 1;
    Vec3 emission{0, 0, 0};
    float metallic = 0;
    float roughness = 1;
    Texture base_color_texture = {};
    Texture normal_texture = {};
    bool normal_is_bump = false;  ///< from map_bump, which also allows height maps
    float normal_scale = 1;       ///< -bm: scale of a normal map, or the height of white in a height map
    /// Replacement of the normal texture in the output; null: the texture is kept.
    std::shared_ptr<const Bytes> converted_normal_map = {};
};

struct Model {
    NamedFiles files = {};             ///< files that the model references
    std::vector<Vec3> positions = {};  ///< all finite; after subtraction of `offset`
    DVec3 offset = {};                 ///< offset subtracted from the file's coordinates; zero near the origin
    bool keeps_offset = false;         ///< FileOptions::keep_coordinates prevented a nonzero offset
    std::vector<Vec2> uvs = {};        ///< v points down, as in glTF
    std::vector<Vec3> normals = {};    ///< unit length or zero; corners never refer to zero normals
    std::vector<Corner> corners = {};  ///< all indices are in range
    std::vector<Face> faces = {};      ///< faces, in file order, with at least 3 corners each; never empty
    std::vector<std::string> shape_names = {};
    std::vector<Material> materials = {};  ///< materials, in the order of their first use by a face
    bool has_smoothing_groups = false;     ///< the file has `s` lines
    /// Replacements of normal maps in the output, keyed by Texture::path.
    std::map<std::string, Bytes> flipped_maps = {};
    std::uint64_t input_bytes = 0;              ///< size of the OBJ and its MTL files
    std::vector<std::string> input_files = {};  ///< all files that were read
    std::vector<std::string> warnings = {};
    std::shared_ptr<MemoryBudget> memory = std::make_shared<MemoryBudget>();  ///< remaining memory budget
};

// Reads OBJ and MTL files into a Model. Functions throw FileError.

/// Reads a model. Fails with cannotRead, invalidFile (place: "line N") and unsupportedFile. MTL files that are missing
/// or forbidden are skipped with a warning.
Model readModel(const Path& path, const FileOptions& options);

/// Returns the materials of the given libraries. `names`: arguments of `mtllib`, each a file name or several names
/// separated by spaces.
std::vector<Material> readMaterials(const std::vector<std::string>& names, Model& model);

}  // namespace tspace::obj
