// SPDX-License-Identifier: MIT
// Reads OBJ text into a Model with the callbacks of tinyobjloader, which support faces of any size (its mesh interface
// cuts faces at 255 corners). The parser is not trusted: every index is checked here. Coordinates are read as doubles;
// takePositions() describes their conversion to floats.
#include "model/obj/obj_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "core/mesh/surface/float_loss.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/legacy_text.h"
#include "model/io/text_encoding.h"
#include "model/json/json.h"
#include "model/obj/tiny_obj_loader.h"
#include "tspace/mesh.h"

namespace tspace::obj {

// First pass over the text of an OBJ file, before the parser.

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Removes the next run of non-blank characters from the front of `line` and returns it; empty at the end.
std::string_view takeToken(std::string_view& line) {
    std::size_t begin = 0;
    while (begin < line.size() && isBlank(line[begin])) ++begin;
    std::size_t end = begin;
    while (end < line.size() && !isBlank(line[end])) ++end;
    const std::string_view token = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return token;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::string lineName(std::uint32_t line) { return "line " + std::to_string(line); }

/// Returns the group number; 0 for "off" and for anything that is not a number.
std::uint32_t smoothingGroup(std::string_view rest) {
    std::uint32_t group = 0;
    for (const char c : takeToken(rest)) {
        if (!isDigit(c)) return 0;
        // The number may wrap around, but equal texts still give equal numbers.
        group = group * 10 + static_cast<std::uint32_t>(c - '0');
    }
    return group;
}

void noteFace(std::string_view rest, std::uint32_t line, std::uint32_t smoothing_group, LineNotes& notes) {
    constexpr std::size_t kMaxDigits = 9;  // fits a 32-bit int; no file can have more vertices
    std::size_t digits = 0;
    bool empty = true;
    for (const char c : rest) {
        empty = empty && isBlank(c);
        digits = isDigit(c) ? digits + 1 : 0;
        if (digits > kMaxDigits)
            failFile(ErrorCode::invalidFile, "a vertex index of a face is too large", lineName(line));
    }
    if (!empty) notes.faces.push_back({line, smoothing_group});
}

void noteNumbers(std::string_view rest, std::uint32_t line, bool is_position, LineNotes& notes) {
    std::size_t count = 0;
    for (std::string_view token = takeToken(rest); !token.empty(); token = takeToken(rest)) {
        if (token.front() == '#') break;
        ++count;
        std::string_view digits = token;
        if (digits.front() == '+' || digits.front() == '-') digits.remove_prefix(1);
        if (!digits.empty() && (isDigit(digits.front()) || digits.front() == '.')) continue;
        if (notes.unreadable_number_count++ == 0) notes.unreadable_number_line = line;
    }
    if (is_position && count >= 6) notes.has_vertex_colors = true;
}

/// Blanks a comment after a face, whose words the parser would interpret as indices.
void blankFaceComment(std::string& text, std::size_t begin, std::size_t end) {
    while (begin < end && isBlank(text[begin])) ++begin;
    if (begin + 1 >= end || text[begin] != 'f' || !isBlank(text[begin + 1])) return;
    // The search is limited to the line, because text.find() would search the rest of the file for each face.
    const auto first = text.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = text.begin() + static_cast<std::ptrdiff_t>(end);
    std::fill(std::find(first, last, '#'), last, ' ');
}

struct LineState {
    std::uint32_t line = 1;
    std::uint32_t smoothing_group = 0;
};

void noteLine(std::string_view line, LineState& state, LineNotes& notes) {
    const std::string_view keyword = takeToken(line);
    if (keyword.empty() || keyword.front() == '#' || line.empty()) return;
    if (keyword == "f") {
        noteFace(line, state.line, state.smoothing_group, notes);
    } else if (keyword == "v" || keyword == "vt" || keyword == "vn") {
        noteNumbers(line, state.line, keyword == "v", notes);
    } else if (keyword == "s") {
        state.smoothing_group = smoothingGroup(line);
        notes.has_smoothing_groups = true;
    } else if (keyword == "mtllib") {
        notes.material_libraries.emplace_back(trimmed(line));
    } else if (keyword == "l" || keyword == "p") {
        notes.has_lines_or_points = true;
    } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
        notes.has_free_form = true;
    }
}

}  // namespace

void makeLineEndsPlain(std::string& text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\0') text[i] = ' ';
        if (text[i] == '\r') text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
    }
}

LineNotes prepareLines(std::string& text) {
    makeLineEndsPlain(text);
    LineNotes notes;
    notes.is_utf8 = isUtf8(text);
    LineState state;
    std::size_t begin = 0;
    std::uint32_t joined = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && text[i] != '\n') continue;
        std::size_t last = i;
        while (last > begin && isBlank(text[last - 1])) --last;
        const bool is_continued = i < text.size() && last > begin && text[last - 1] == '\\';
        if (is_continued && (notes.is_utf8 || !isSecondByte(text, last - 1))) {
            text[last - 1] = ' ';
            text[i] = ' ';
            ++joined;
            continue;
        }
        blankFaceComment(text, begin, i);
        noteLine(std::string_view(text).substr(begin, i - begin), state, notes);
        state.line += 1 + joined;
        joined = 0;
        begin = i + 1;
    }
    return notes;
}

namespace {

/// Formats a number with the fewest digits that round-trip.
std::string spelled(double value) {
    const std::string text = Json(value).dump();
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string spelled(const DVec3& v) { return "(" + spelled(v.x) + ", " + spelled(v.y) + ", " + spelled(v.z) + ")"; }

bool isNone(const DVec3& offset) { return offset.x == 0 && offset.y == 0 && offset.z == 0; }

/// Returns a text such as "120 of 121 edges of faces".
std::string changedEdges(const FloatLoss& loss) {
    return std::to_string(loss.changed_count) + " of " + std::to_string(loss.edge_count) + " edges of faces";
}

void warnOfOffset(const FloatLoss& loss, Model& model) {
    model.warnings.push_back("the coordinates are so far from the origin that 32-bit floats would change " +
                             changedEdges(loss) + "; " + spelled(model.offset) +
                             " was subtracted from them first, and is the translation of the nodes in glTF (generate "
                             "--keep-coordinates disables this)");
}

void warnOfLoss(const FloatLoss& loss, bool can_subtract_offset, Model& model) {
    model.warnings.push_back(
        "the coordinates are too large for the 32-bit floats of glTF: rounding changes " + changedEdges(loss) +
        (can_subtract_offset
             ? "; omit --keep-coordinates to subtract an offset from them"
             : ", and no common offset fixes this; split the model, and move each part to its own origin"));
}

}  // namespace

/// Sets the positions of the model; faces and corners must be set already. If the coordinates are so far from the
/// origin that floats would distort edges, Model::offset is subtracted from all of them first (one offset for the whole
/// file, unless `keep_coordinates`), with a warning. A second warning reports edges that floats still distort.
/// Positions that are not finite become zero.
void takePositions(std::vector<DVec3> positions, const FileOptions& options, Model& model) {
    const VisitEdges edges = [&](const auto& visit) {
        for (const Face& face : model.faces) {
            const Corner* const corner = &model.corners[face.first_corner];
            for (std::uint32_t i = 0; i < face.corner_count; ++i)
                visit(positions[corner[i].position], positions[corner[(i + 1) % face.corner_count].position]);
        }
    };
    const FloatLoss before = floatLoss(edges, {});
    if (before.isNoticeable()) {
        const DVec3 offset = offsetForFloats(edges);
        model.keeps_offset = options.keep_coordinates && !isNone(offset);
        if (!options.keep_coordinates) model.offset = offset;
        if (!isNone(model.offset)) warnOfOffset(before, model);
        const FloatLoss after = floatLoss(edges, model.offset);
        if (after.isNoticeable()) warnOfLoss(after, isNone(model.offset) && !isNone(offset), model);
    }
    model.positions.reserve(positions.size());
    for (const DVec3& position : positions) {
        const Vec3 rounded = toFloat(position - model.offset);
        model.positions.push_back(isFinite(rounded) ? rounded : Vec3{});
    }
}
namespace {

/// Corner indices that refer to missing elements: their number, and the first line with one.
struct DeadIndices {
    std::uint64_t count = 0;
    std::uint32_t first_line = kNone;

    void add(std::uint32_t line) {
        ++count;
        first_line = std::min(first_line, line);
    }
};

/// State of the parser's callbacks.
struct Build {
    Model* model = nullptr;
    const LineNotes* notes = nullptr;
    std::vector<DVec3> positions = {};  // not finite if a float would overflow
    std::size_t face_line = 0;          // index of the next entry of notes->faces
    std::string object = {}, group = {};
    std::map<std::pair<std::string, std::string>, std::uint32_t> shapes = {};
    std::uint32_t shape = kNone;  // kNone: determined at the next face
    std::map<std::string, std::uint32_t> materials = {};
    std::string material_name = {};
    std::uint32_t material = kNone;
    std::uint64_t bad_position_count = 0;
    std::uint64_t bad_uv_count = 0;
    std::uint64_t bad_normal_count = 0;
    std::uint64_t small_face_count = 0;
    DeadIndices dead_uvs = {};
    DeadIndices dead_normals = {};
};

Build& buildOf(void* user) { return *static_cast<Build*>(user); }

std::string currentPlace(const Build& build) {
    return "line " + std::to_string(build.notes->faces[build.face_line].line);
}

void addPosition(void* user, double x, double y, double z, double) {
    Build& build = buildOf(user);
    DVec3 position{x, y, z};
    if (!isFinite(toFloat(position))) {
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        position = {kNaN, kNaN, kNaN};
        ++build.bad_position_count;
    }
    build.positions.push_back(position);
}

void addUv(void* user, double u, double v, double) {
    Build& build = buildOf(user);
    Vec2 uv{static_cast<float>(u), 1.0f - static_cast<float>(v)};
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
        uv = {};
        ++build.bad_uv_count;
    }
    build.model->uvs.push_back(uv);
}

/// Adds a normal with unit length, which glTF requires and OBJ does not. Normals within the tolerance of the glTF
/// validator keep their exact values.
void addNormal(void* user, double x, double y, double z) {
    Build& build = buildOf(user);
    const Vec3 given = toFloat({x, y, z});
    const double size = length(toDouble(given));
    Vec3 normal{};
    if (std::isfinite(size) && size > 1e-30) {
        normal = std::abs(size - 1) <= 5e-4
                     ? given
                     : Vec3{static_cast<float>(given.x / size), static_cast<float>(given.y / size),
                            static_cast<float>(given.z / size)};
    } else {
        ++build.bad_normal_count;
    }
    build.model->normals.push_back(normal);
}

/// Converts an index of the file to a zero-based one. In the file, 1 is the first element, and -1 the latest element so
/// far. Positive indices may refer to elements that follow later. Returns kNone for negative indices that refer to
/// elements before the first.
std::uint32_t resolveIndex(int index, std::size_t count_so_far) {
    if (index > 0) return static_cast<std::uint32_t>(index - 1);
    const auto back = static_cast<std::size_t>(-static_cast<std::int64_t>(index));
    return back > count_so_far ? kNone : static_cast<std::uint32_t>(count_so_far - back);
}

std::uint32_t resolvePosition(const Build& build, int index) {
    const std::size_t count_so_far = build.positions.size();
    const std::uint32_t position = resolveIndex(index, count_so_far);
    if (position == kNone) {
        failFile(ErrorCode::invalidFile,
                 "a relative index of a face refers to vertex " + std::to_string(index) + ", but there are only " +
                     std::to_string(count_so_far) + " before it",
                 currentPlace(build));
    }
    return position;
}

/// Returns the index of a UV or normal. Returns kNone for 0, which some exporters write for "none", and for negative
/// indices that refer to missing elements, which are added to `dead`.
std::uint32_t resolveOptional(int index, std::size_t count_so_far, std::uint32_t line, DeadIndices& dead) {
    if (index == 0) return kNone;
    const std::uint32_t resolved = resolveIndex(index, count_so_far);
    if (resolved == kNone) dead.add(line);
    return resolved;
}

/// Memory of a primitive (one per shape and material with faces): lists, report, and JSON.
constexpr std::uint64_t kPrimitiveBytes = 4000;

std::uint32_t currentShape(Build& build) {
    if (build.shape == kNone) {
        const auto next = static_cast<std::uint32_t>(build.model->shape_names.size());
        const auto [entry, is_new] = build.shapes.emplace(std::pair(build.object, build.group), next);
        if (is_new) {
            build.model->memory->take(kPrimitiveBytes, currentPlace(build));
            const bool both = !build.object.empty() && !build.group.empty();
            build.model->shape_names.push_back(build.object + (both ? "/" : "") + build.group);
        }
        build.shape = entry->second;
    }
    return build.shape;
}

std::uint32_t currentMaterial(Build& build) {
    if (build.material == kNone) {
        const auto next = static_cast<std::uint32_t>(build.model->materials.size());
        const auto [entry, is_new] = build.materials.emplace(build.material_name, next);
        if (is_new) {
            build.model->memory->take(kPrimitiveBytes, currentPlace(build));
            build.model->materials.push_back({.name = build.material_name});
        }
        build.material = entry->second;
    }
    return build.material;
}

void addFace(void* user, tinyobj::index_t* indices, int count) {
    Build& build = buildOf(user);
    Model& model = *build.model;
    if (build.face_line >= build.notes->faces.size())
        failFile(ErrorCode::internal, "internal error: the OBJ parser found more faces than the first pass");
    Face face{.first_corner = static_cast<std::uint32_t>(model.corners.size()),
              .corner_count = static_cast<std::uint32_t>(count),
              .smoothing_group = build.notes->faces[build.face_line].smoothing_group,
              .line = build.notes->faces[build.face_line].line};
    if (model.corners.size() + face.corner_count > kMaxCorners) {
        failFile(ErrorCode::unsupportedFile,
                 "the file has more than " + std::to_string(kMaxCorners) + " face corners, the limit of a mesh",
                 currentPlace(build));
    }
    for (int i = 0; i < count; ++i) {
        const tinyobj::index_t& index = indices[i];
        if (index.vertex_index == 0) {
            failFile(ErrorCode::invalidFile, "a corner of a face has no valid vertex index; OBJ indices start at 1",
                     currentPlace(build));
        }
        model.corners.push_back(
            {.position = resolvePosition(build, index.vertex_index),
             .uv = resolveOptional(index.texcoord_index, model.uvs.size(), face.line, build.dead_uvs),
             .normal = resolveOptional(index.normal_index, model.normals.size(), face.line, build.dead_normals)});
    }
    if (count < 3) {
        ++build.small_face_count;
        model.corners.resize(face.first_corner);
    } else {
        face.shape = currentShape(build);
        face.material = currentMaterial(build);
        model.faces.push_back(face);
    }
    ++build.face_line;
}

void setGroup(void* user, const char** names, int count) {
    Build& build = buildOf(user);
    build.group.clear();
    for (int i = 0; i < count; ++i) build.group.append(i == 0 ? "" : " ").append(names[i]);
    // Exporters use these names for "no group".
    if (build.group == "default" || build.group == "off") build.group.clear();
    build.shape = kNone;
}

void setObject(void* user, const char* name) {
    Build& build = buildOf(user);
    build.object = name;
    build.object.erase(build.object.find_last_not_of(" \t") + 1);
    build.shape = kNone;
}

void setMaterial(void* user, const char* name, int) {
    Build& build = buildOf(user);
    build.material_name = name;
    build.material_name.erase(build.material_name.find_last_not_of(" \t") + 1);
    build.material = kNone;
}

void parse(std::string& text, Build& build) {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = addPosition;
    callbacks.texcoord_cb = addUv;
    callbacks.normal_cb = addNormal;
    callbacks.index_cb = addFace;
    callbacks.group_cb = setGroup;
    callbacks.object_cb = setObject;
    callbacks.usemtl_cb = setMaterial;
    if (!parseObj(text, callbacks, &build)) failFile(ErrorCode::invalidFile, "the file is not a valid OBJ file");
}

/// Checks positive indices at the end of the file, since they may point ahead. A missing position is an error; UVs and
/// normals that do not exist, and zero normals, are dropped from corners.
void checkIndices(Build& build) {
    Model& model = *build.model;
    for (const Face& face : model.faces) {
        for (std::uint32_t i = 0; i < face.corner_count; ++i) {
            Corner& corner = model.corners[face.first_corner + i];
            if (corner.position >= build.positions.size()) {
                failFile(ErrorCode::invalidFile,
                         "a face refers to vertex " + std::to_string(std::uint64_t{corner.position} + 1) +
                             ", but the number of vertices is " + std::to_string(build.positions.size()),
                         "line " + std::to_string(face.line));
            }
            if (corner.uv != kNone && corner.uv >= model.uvs.size()) {
                build.dead_uvs.add(face.line);
                corner.uv = kNone;
            }
            if (corner.normal == kNone) continue;
            const bool is_dead = corner.normal >= model.normals.size();
            if (is_dead) build.dead_normals.add(face.line);
            if (is_dead || model.normals[corner.normal] == Vec3{}) corner.normal = kNone;
        }
    }
}

void addWarnings(const Build& build, Model& model) {
    const LineNotes& notes = *build.notes;
    const auto warn = [&model](const std::string& text) { model.warnings.push_back(text); };
    const auto warnCount = [&](std::uint64_t count, const char* one, const char* several,
                               const std::string& rest = {}) {
        if (count != 0) warn(std::to_string(count) + " " + (count == 1 ? one : several) + rest);
    };
    const auto firstIn = [](std::uint64_t line) { return ", the first in line " + std::to_string(line); };
    warnCount(notes.unreadable_number_count, "invalid value was read as 0", "invalid values were read as 0",
              firstIn(notes.unreadable_number_line));
    if (!notes.is_utf8) warn(kNotUtf8);
    warnCount(build.bad_position_count, "position is not finite and was moved to the origin",
              "positions are not finite and were moved to the origin");
    warnCount(build.bad_uv_count, "texture coordinate is not finite and was set to 0",
              "texture coordinates are not finite and were set to 0");
    warnCount(build.bad_normal_count, "normal is zero or not finite", "normals are zero or not finite",
              "; faces that use such normals get new ones");
    const auto warnDead = [&](const DeadIndices& dead, const std::string& what, const char* result) {
        warnCount(dead.count, "index refers to ", "indices refer to ",
                  what + " that do not exist" + firstIn(dead.first_line) + "; " + result);
    };
    warnDead(build.dead_uvs, "texture coordinates", "faces that use them are treated as having no texture coordinates");
    warnDead(build.dead_normals, "normals", "faces that use them get new normals");
    warnCount(build.small_face_count, "face with fewer than 3 corners was ignored",
              "faces with fewer than 3 corners were ignored");
    if (notes.has_vertex_colors) warn("vertex colors are ignored");
    if (notes.has_lines_or_points) warn("lines and points are ignored");
    if (notes.has_free_form) warn("free-form curves and surfaces are ignored");
}

/// Fills in the materials that faces use, from the MTL files.
void fillMaterials(Model& model, std::vector<Material> library) {
    std::map<std::string, std::size_t> by_name;
    for (std::size_t i = 0; i < library.size(); ++i) by_name.emplace(library[i].name, i);
    for (Material& material : model.materials) {
        const auto entry = by_name.find(material.name);
        if (entry != by_name.end()) {
            material = library[entry->second];
        } else if (!material.name.empty()) {
            model.warnings.push_back("the material '" + material.name + "' is not in any material library");
        }
    }
}

}  // namespace

/// Checks the memory that later steps need for faces. Polygons need more than triangles, because they are triangulated.
void requireFaces(const Model& model) {
    constexpr std::uint64_t kTriangleCornerBytes = 128, kPolygonCornerBytes = 200;
    std::uint64_t bytes = 0;
    for (const Face& face : model.faces)
        bytes += face.corner_count * (face.corner_count == 3 ? kTriangleCornerBytes : kPolygonCornerBytes);
    model.memory->require(bytes, {});
}

Model readModel(const Path& path, const FileOptions& options) {
    // Beyond this size, vertex counts might exceed 32 bits.
    constexpr std::uint64_t kMaxBytes = std::uint64_t{8} << 30;
    const bool is_in_memory = options.content.data() != nullptr;
    const std::uint64_t size = is_in_memory ? options.content.size() : fileSize(path);
    if (size > kMaxBytes) failFile(ErrorCode::unsupportedFile, "the OBJ file is larger than 8 GiB");
    Bytes bytes = is_in_memory ? Bytes(options.content.begin(), options.content.end()) : readFile(path);
    Model model;
    model.files = NamedFiles(path, options);
    model.input_bytes = bytes.size();
    model.input_files.push_back(path.string());
    model.memory = std::make_shared<MemoryBudget>(options.memory_limit_bytes);
    model.memory->allow(bytes.size());
    model.memory->take(bytes.size(), {});
    std::string text(bytes.begin(), bytes.end());
    Bytes().swap(bytes);
    narrowText(text);
    const LineNotes notes = prepareLines(text);
    model.has_smoothing_groups = notes.has_smoothing_groups;

    Build build{.model = &model, .notes = &notes};
    parse(text, build);
    std::string().swap(text);
    if (build.face_line != notes.faces.size())
        failFile(ErrorCode::internal, "internal error: the OBJ parser found fewer faces than the first pass");
    checkIndices(build);
    if (model.faces.empty()) failFile(ErrorCode::invalidFile, "the OBJ file has no faces");
    requireFaces(model);
    addWarnings(build, model);
    takePositions(std::move(build.positions), options, model);
    fillMaterials(model, readMaterials(notes.material_libraries, model));
    return model;
}

}  // namespace tspace::obj
