// SPDX-License-Identifier: MIT
// Reads primitives: attributes, indices, and the triangles of lists, strips and fans.
#include "model/gltf/primitive_reader.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <string_view>

#include "core/base/numbers.h"
#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "model/gltf/component_rules.h"
#include "model/gltf/packed_layout.h"
#include "model/io/file_error.h"

namespace tspace::gltf {
namespace {

AttributeList readAttributes(const Json& object, const std::string& place, std::size_t accessor_count) {
    // The number of attributes is limited, because attribute lookup is a linear search and is done for each attribute.
    constexpr std::size_t kMaxAttributes = 1000;
    if (object.size() > kMaxAttributes)
        failFile(ErrorCode::unsupportedFile, "more than 1000 attributes are not supported", place);
    AttributeList list;
    for (const auto& [name, value] : object.items())
        list.emplace_back(name, toIndex(value, join(place, name), accessor_count, "accessor"));
    return list;
}

/// Moves packed frames with a wrong number of elements to `miscounted`. They do not make a file invalid, because they
/// can be recomputed.
void separateMiscounted(const Document& document, Primitive& primitive) {
    const auto is_good = [&](const auto& entry) {
        return !isPackedAttribute(entry.first) || readAccessor(document, entry.second).count == primitive.vertex_count;
    };
    AttributeList& list = primitive.attributes;
    const auto bad = std::stable_partition(list.begin(), list.end(), is_good);
    primitive.miscounted.assign(bad, list.end());
    list.erase(bad, list.end());
}

/// Returns why the accessor cannot contain tangents (`is_base`) or tangent offsets of a morph target; empty if it can.
std::string whyUnreadable(const Accessor& accessor, bool is_base, std::size_t vertex_count) {
    const std::size_t wanted = is_base ? 4 : 3;
    if (accessor.type != "VEC" + std::to_string(wanted))
        return "they do not have " + std::to_string(wanted) + " components";
    const bool is_signed = accessor.component == ComponentType::i8 || accessor.component == ComponentType::i16;
    if (accessor.component != ComponentType::f32 && !(is_signed && (accessor.normalized || !is_base)))
        return "they are " + formatName(accessor) + ", but must be floats or normalized signed integers";
    if (accessor.count == vertex_count) return {};
    return "there are " + std::to_string(accessor.count) + " of them for " + std::to_string(vertex_count) + " vertices";
}

/// Moves TANGENT attributes that cannot be read to unreadable_tangents, so that they do not make the file invalid.
void separateUnreadable(const Document& document, Primitive& primitive) {
    const auto setApart = [&](AttributeList& list, std::ptrdiff_t target) {
        const auto entry =
            std::find_if(list.begin(), list.end(), [](const auto& attribute) { return attribute.first == "TANGENT"; });
        if (entry == list.end()) return;
        std::string why = whyUnreadable(readAccessor(document, entry->second), target < 0, primitive.vertex_count);
        if (why.empty()) return;
        primitive.unreadable_tangents.push_back({target, entry->second, std::move(why)});
        list.erase(entry);
    };
    setApart(primitive.attributes, -1);
    for (std::size_t i = 0; i < primitive.targets.size(); ++i)
        setApart(primitive.targets[i], static_cast<std::ptrdiff_t>(i));
}

/// Returns the minimum and maximum number of components of an attribute; 0, 0: any.
std::pair<std::size_t, std::size_t> componentRange(const std::string& name) {
    if (name == "POSITION" || name == "NORMAL") return {3, 3};
    if (name.starts_with("TEXCOORD_")) return {2, 2};
    if (name.starts_with("COLOR_")) return {3, 4};
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) return {4, 4};
    return {};
}

/// Returns the number of components of a vector; 0 if the accessor has no vectors.
std::size_t vectorSize(const Accessor& accessor) {
    return accessor.type.starts_with("VEC") ? accessor.component_count : 0;
}

/// Returns whether joints and weights of a set have one element per vertex and the same number of components. The
/// missing components are then unused influences and can be filled with zeros. If only the weights have fewer
/// components, zeros may be wrong: readers compute the missing weight from the others.
bool lackSameInfluences(const Document& document, const Primitive& primitive, const std::string& name) {
    const std::string set = name.substr(name.find('_'));
    const auto joints = primitive.find("JOINTS" + set), weights = primitive.find("WEIGHTS" + set);
    if (!joints || !weights) return false;
    const Accessor a = readAccessor(document, *joints), b = readAccessor(document, *weights);
    const std::size_t size = vectorSize(a);
    return size != 0 && size == vectorSize(b) && a.count == primitive.vertex_count && b.count == primitive.vertex_count;
}

AttributeRepair repairOf(const std::string& name, const AttributeList& list, bool is_target) {
    // Programs reject an empty morph target, and removing a target would renumber targets and weights.
    if (is_target && list.size() == 1) return AttributeRepair::none;
    const bool is_needed = name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
    return is_needed ? AttributeRepair::none : AttributeRepair::remove;
}

/// Returns nullopt if the attribute is valid: one element per vertex, of a type that its name allows.
std::optional<AttributeFault> attributeFault(const Document& document, const Primitive& primitive,
                                             const AttributeList& list, std::ptrdiff_t target,
                                             const AttributeList::value_type& attribute) {
    const auto& [name, index] = attribute;
    const Accessor accessor = readAccessor(document, index);
    const auto [least, most] = componentRange(name);
    AttributeFault fault{.name = name, .target = target, .accessor = index};
    fault.repair = repairOf(name, list, target >= 0);
    const std::size_t size = vectorSize(accessor);
    if (accessor.count != primitive.vertex_count) {
        fault.why = "there are " + std::to_string(accessor.count) + " of them for " +
                    std::to_string(primitive.vertex_count) + " vertices";
    } else if (most != 0 && (size < least || size > most)) {
        fault.why = "they do not have " + std::string(least != most ? "3 or 4" : std::to_string(most)) + " components";
        const bool is_influence = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
        if (size > most || (is_influence && lackSameInfluences(document, primitive, name))) {
            fault.repair = AttributeRepair::resize;
            fault.new_count = most;
        }
    } else {
        return {};
    }
    return fault;
}

/// Moves attributes that cannot be read to `attribute_faults`. They do not make a file invalid: findings state the
/// remedy, and the rest of the model is processed.
void separateFaulty(const Document& document, Primitive& primitive) {
    const auto goodOf = [&](const AttributeList& list, std::ptrdiff_t target) {
        AttributeList good;
        for (const auto& attribute : list) {
            std::optional<AttributeFault> fault = attributeFault(document, primitive, list, target, attribute);
            if (fault) {
                primitive.attribute_faults.push_back(*std::move(fault));
            } else {
                good.push_back(attribute);
            }
        }
        return good;
    };
    AttributeList attributes = goodOf(primitive.attributes, -1);
    for (std::size_t i = 0; i < primitive.targets.size(); ++i)
        primitive.targets[i] = goodOf(primitive.targets[i], static_cast<std::ptrdiff_t>(i));
    primitive.attributes = std::move(attributes);
}

std::size_t trianglesOf(Mode mode, std::size_t corners) {
    if (mode == Mode::triangles) return corners / 3;
    return hasTriangles(mode) && corners >= 3 ? corners - 2 : 0;
}

Primitive readPrimitive(const Document& document, const Json& object, std::uint32_t mesh, std::uint32_t index) {
    Primitive primitive;
    primitive.mesh = mesh;
    primitive.index = index;
    const std::string place = primitive.place();
    const std::size_t accessor_count = rootArray(document, "accessors").size();
    const std::uint64_t mode = readWhole(object, "mode", place, static_cast<std::uint64_t>(Mode::triangles));
    if (mode > static_cast<std::uint64_t>(Mode::triangleFan))
        failFile(ErrorCode::invalidFile, "the mode " + std::to_string(mode) + " does not exist", join(place, "mode"));
    primitive.mode = static_cast<Mode>(mode);
    primitive.indices = readIndex(object, "indices", place, accessor_count, "accessor");
    primitive.material = readIndex(object, "material", place, rootArray(document, "materials").size(), "material");
    primitive.attributes =
        readAttributes(requireObject(object, "attributes", place), join(place, "attributes"), accessor_count);
    const Json& targets = readArray(object, "targets", place);
    for (std::size_t i = 0; i < targets.size(); ++i)
        primitive.targets.push_back(readAttributes(targets[i], join(join(place, "targets"), i), accessor_count));
    if (!primitive.attributes.empty()) {
        const auto position = primitive.find("POSITION");
        primitive.vertex_count = readAccessor(document, position.value_or(primitive.attributes[0].second)).count;
    }
    separateMiscounted(document, primitive);
    separateUnreadable(document, primitive);
    separateFaulty(document, primitive);
    primitive.corner_count =
        primitive.indices ? readAccessor(document, *primitive.indices).count : primitive.vertex_count;
    return primitive;
}

template <class Vec>
std::optional<StridedSpan<const Vec>> viewVectors(const Document& document, const Accessor& accessor) {
    // Big-endian systems convert elements while copying.
    if constexpr (std::endian::native != std::endian::little) return {};
    const bool is_float = accessor.component == ComponentType::f32 && accessor.type[0] == 'V';
    if (!is_float || accessor.element_bytes != sizeof(Vec)) return {};
    const std::optional<ElementView> elements = viewElements(document, accessor);
    // The alignment must be checked: a file may place floats at any address.
    if (!elements || reinterpret_cast<std::uintptr_t>(elements->data) % alignof(Vec) != 0) return {};
    if (elements->stride % alignof(Vec) != 0) return {};
    return StridedSpan<const Vec>(reinterpret_cast<const Vec*>(elements->data), accessor.count, elements->stride);
}

/// Returns the factor that gives a normal unit length. Like unitScale, but also scales shorter normals, down to a
/// squared length that is a normal (not subnormal) float, because shaders can normalize these too.
double storedScale(const Vec3& normal) {
    constexpr double kMin = 0x1p-63;
    const double size = length(toDouble(normal));
    return size >= kMin && size < kLeastLength ? 1 / size : unitScale(normal);
}

/// Scales of the normals of one accessor, and those without a direction; null if there are none.
struct NormalLengths {
    std::shared_ptr<const NormalScales> scales = {};
    std::shared_ptr<const InvalidNormals> invalid = {};
};

NormalLengths findLengths(const Document& document, const Accessor& accessor) {
    if (accessor.type != "VEC3" || !hasData(document, accessor)) return {};
    // Normals that are not stored are all zero, and the file size does not limit their number.
    const bool is_stored = accessor.view || accessor.sparse || document.elements.count(accessor.index) != 0;
    if (!is_stored) return {.invalid = std::make_shared<InvalidNormals>(InvalidNormals{.are_all = true})};
    std::optional<StridedSpan<const Vec3>> normals = viewVectors<Vec3>(document, accessor);
    std::vector<Vec3> decoded;
    if (!normals) {
        document.memory->require(std::uint64_t{accessor.count} * sizeof(Vec3), accessor.place());
        decoded = decodeVec3(document, accessor, accessor.place());
        normals = StridedSpan<const Vec3>(std::span<const Vec3>(decoded));
    }
    std::shared_ptr<NormalScales> scales;
    std::shared_ptr<InvalidNormals> invalid;
    for (std::size_t v = 0; v < normals->count; ++v) {
        const Vec3& normal = (*normals)[v];
        const double scale = storedScale(normal);
        if (scale == 1) {
            if (length(toDouble(normal)) >= kLeastLength && isFinite(normal)) continue;
            if (invalid == nullptr) {
                document.memory->take(normals->count / 8, accessor.place());
                invalid = std::make_shared<InvalidNormals>();
                invalid->of_vertices.resize(normals->count);
            }
            invalid->of_vertices[v] = true;
            continue;
        }
        if (scales == nullptr) {
            document.memory->take(std::uint64_t{normals->count} * sizeof(double), accessor.place());
            scales = std::make_shared<NormalScales>();
            scales->of_vertices.assign(normals->count, 1);
            scales->min_length = scales->max_length = 1 / scale;
        }
        scales->of_vertices[v] = scale;
        scales->min_length = std::min(scales->min_length, 1 / scale);
        scales->max_length = std::max(scales->max_length, 1 / scale);
        ++scales->count;
    }
    return {std::move(scales), std::move(invalid)};
}

/// Examines the lengths of all normals. Skips unreadable normals: reading them later reports the reason.
void findLengths(const Document& document, std::vector<Primitive>& primitives) {
    std::map<std::size_t, NormalLengths> known;
    for (Primitive& primitive : primitives) {
        const auto index = primitive.find("NORMAL");
        if (!index) continue;
        const auto [entry, is_new] = known.try_emplace(*index);
        std::optional<Error> failure;
        if (is_new)
            failure =
                tryFile([&, &found = entry->second] { found = findLengths(document, readAccessor(document, *index)); });
        if (failure && failure->code == ErrorCode::tooLarge) throw FileError{*failure};
        primitive.normal_scales = entry->second.scales;
        primitive.invalid_normals = entry->second.invalid;
    }
}

/// Charges the memory that a primitive needs in addition to its arrays: lists, report, and findings.
void takePrimitive(const Document& document, const Json& object, std::size_t mesh, std::size_t index) {
    constexpr std::size_t kPrimitiveBytes = 1500, kTargetBytes = 100;
    const Json* targets = findMember(object, "targets");
    const std::size_t count = targets != nullptr && targets->is_array() ? targets->size() : 0;
    document.memory->take(kPrimitiveBytes + count * kTargetBytes, join(join("/meshes", mesh) + "/primitives", index));
}

Accessor attributeAccessor(const Document& document, const Primitive& primitive, const std::string& name) {
    const auto index = primitive.find(name);
    if (!index)
        failFile(ErrorCode::invalidFile, "the attribute " + name + " is missing",
                 join(primitive.place(), "attributes"));
    return readAccessor(document, *index);
}

bool isNormal(const char* attribute) { return std::string_view(attribute) == "NORMAL"; }

std::string attributePlace(const Primitive& primitive, const std::string& name) {
    return join(join(primitive.place(), "attributes"), name);
}

}  // namespace

const char* modeName(Mode mode) {
    switch (mode) {
        case Mode::points: return "points";
        case Mode::lines: return "lines";
        case Mode::lineLoop: return "line loop";
        case Mode::lineStrip: return "line strip";
        case Mode::triangles: return "triangles";
        case Mode::triangleStrip: return "triangle strip";
        case Mode::triangleFan: return "triangle fan";
    }
    return "";
}

std::optional<std::size_t> findAttribute(const AttributeList& list, const std::string& name) {
    for (const auto& [key, accessor] : list) {
        if (key == name) return accessor;
    }
    return {};
}

std::string vertexKey(const Primitive& primitive) {
    std::string key;
    const auto append = [&key](AttributeList list) {
        sortList(list.begin(), list.end());
        for (const auto& [name, accessor] : list)
            key += std::to_string(name.size()) + name + ' ' + std::to_string(accessor) + ' ';
        key += '|';
    };
    append(primitive.attributes);
    for (const AttributeList& target : primitive.targets) append(target);
    return key;
}

std::size_t Primitive::triangleCount() const { return trianglesOf(mode, corner_count); }

bool Primitive::canRepairFaults() const {
    return std::none_of(attribute_faults.begin(), attribute_faults.end(),
                        [](const AttributeFault& fault) { return fault.repair == AttributeRepair::none; });
}

std::vector<Primitive> readPrimitives(const Document& document) {
    std::vector<Primitive> primitives;
    const Json& meshes = rootArray(document, "meshes");
    for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
        const std::string place = join("/meshes", mesh);
        const std::string name = readString(meshes[mesh], "name", place);
        const Json& list = readArray(meshes[mesh], "primitives", place);
        for (std::size_t index = 0; index < list.size(); ++index) {
            takePrimitive(document, list[index], mesh, index);
            primitives.push_back(readPrimitive(document, list[index], static_cast<std::uint32_t>(mesh),
                                               static_cast<std::uint32_t>(index)));
            primitives.back().mesh_name = name;
        }
    }
    findLengths(document, primitives);
    return primitives;
}

namespace {

/// Names of the first primitives that a warning is about.
class NamedPrimitives {
  public:
    void add(const Primitive& primitive) {
        constexpr std::size_t kMaxNamed = 3;
        if (count_++ < kMaxNamed)
            text_ += (text_.empty() ? "mesh " : "; mesh ") + std::to_string(primitive.mesh) + ", primitive " +
                     std::to_string(primitive.index);
        else
            ++more_count_;
    }
    [[nodiscard]] std::string text() const {
        return " (" + text_ + (more_count_ == 0 ? "" : "; and " + std::to_string(more_count_) + " more") + ")";
    }

  private:
    std::string text_ = {};
    std::size_t count_ = 0, more_count_ = 0;
};

std::vector<std::uint32_t> withoutRepeats(std::vector<std::uint32_t>&& numbers) {
    sortList(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return std::move(numbers);
}

std::string verticesText(std::size_t count) { return std::to_string(count) + (count == 1 ? " vertex" : " vertices"); }

/// Returns the vertices that triangles use and whose normals have no direction. Returns none if the indices cannot be
/// read: reading them later reports the reason.
std::vector<std::uint32_t> usedInvalidNormals(const Document& document, const Primitive& primitive) {
    std::vector<std::uint32_t> used;
    if (primitive.invalid_normals == nullptr) return used;
    const std::optional<Error> failure = tryFile([&] {
        document.memory->require(std::uint64_t{12} * primitive.triangleCount(), primitive.place());
        used = readTriangleCorners(document, primitive);
    });
    if (failure && failure->code == ErrorCode::tooLarge) throw FileError{*failure};
    std::erase_if(used, [&](std::uint32_t vertex) { return !primitive.invalid_normals->contains(vertex); });
    return withoutRepeats(std::move(used));
}

void addWarning(Document& document, std::string&& facts, const std::string& rest,
                std::optional<NormalsWarning>& warning) {
    document.warnings.push_back(facts + rest);
    warning = {.number = document.warnings.size() - 1, .facts = std::move(facts)};
}

void warnOfScaledNormals(Document& document, std::span<const Primitive> primitives) {
    std::set<const NormalScales*> known;
    NamedPrimitives named;
    std::size_t count = 0;
    double least = 0, most = 0;
    bool are_some_unsigned = false;
    for (const Primitive& primitive : primitives) {
        const NormalScales* const scales = primitive.normal_scales.get();
        if (scales == nullptr) continue;
        are_some_unsigned = are_some_unsigned || areUnsigned(document, primitive.find("NORMAL"));
        named.add(primitive);
        if (!known.insert(scales).second) continue;
        least = count == 0 ? scales->min_length : std::min(least, scales->min_length);
        most = std::max(most, scales->max_length);
        count += scales->count;
    }
    if (count == 0) return;
    addWarning(document,
               "normals that do not have unit length: " + verticesText(count) + named.text() + " with lengths " +
                   "from " + shortNumber(least) + " to " + shortNumber(most),
               std::string(". They were normalized for the computation, and the file keeps them unchanged (tspace "
                           "generate --repair writes unit normals") +
                   (are_some_unsigned ? ", except where normals are stored as unsigned integers; --overwrite-normals "
                                        "replaces those too)"
                                      : ")"),
               document.scaled_normals);
}

void warnOfInvalidNormals(Document& document, std::span<const Primitive> primitives) {
    std::map<const InvalidNormals*, std::vector<std::uint32_t>> used_of;
    NamedPrimitives named;
    for (const Primitive& primitive : primitives) {
        const std::vector<std::uint32_t> used = usedInvalidNormals(document, primitive);
        if (used.empty()) continue;
        named.add(primitive);
        // Primitives that share normals are counted together.
        std::vector<std::uint32_t>& all = used_of[primitive.invalid_normals.get()];
        all.insert(all.end(), used.begin(), used.end());
        all = withoutRepeats(std::move(all));
    }
    std::size_t count = 0;
    for (const auto& [normals, used] : used_of) count += used.size();
    if (count == 0) return;
    addWarning(document, std::string(kInvalidNormals) + ": " + verticesText(count) + named.text(),
               ". Frames and shading at vertices without a usable normal are arbitrary (tspace generate "
               "--overwrite-normals computes new normals)",
               document.invalid_normals);
}

}  // namespace

bool usesInvalidNormals(const Document& document, const Primitive& primitive) {
    return !usedInvalidNormals(document, primitive).empty();
}

void warnOfNormals(Document& document, std::span<const Primitive> primitives) {
    const auto remove = [&](std::optional<NormalsWarning>& warning, std::optional<NormalsWarning>& other) {
        if (!warning) return;
        document.warnings.erase(document.warnings.begin() + static_cast<std::ptrdiff_t>(warning->number));
        if (other && other->number > warning->number) --other->number;
        warning.reset();
    };
    remove(document.scaled_normals, document.invalid_normals);
    remove(document.invalid_normals, document.scaled_normals);
    warnOfScaledNormals(document, primitives);
    warnOfInvalidNormals(document, primitives);
}

std::vector<std::uint32_t> readTriangleCorners(const Document& document, const Primitive& primitive) {
    std::vector<std::uint32_t> list;
    if (primitive.indices) {
        list = decodeIndices(document, readAccessor(document, *primitive.indices), primitive.vertex_count,
                             join(primitive.place(), "indices"));
    } else {
        list.resize(primitive.vertex_count);
        for (std::size_t i = 0; i < list.size(); ++i) list[i] = static_cast<std::uint32_t>(i);
    }
    const std::size_t triangles = primitive.triangleCount();
    if (primitive.mode == Mode::triangles) {
        list.resize(triangles * 3);
        return list;
    }
    std::vector<std::uint32_t> corners;
    corners.reserve(triangles * 3);
    for (std::size_t i = 0; i < triangles; ++i) {
        if (primitive.mode == Mode::triangleFan) {
            corners.insert(corners.end(), {list[i + 1], list[i + 2], list[0]});
        } else {
            // Every second triangle of a strip has the opposite winding.
            corners.insert(corners.end(), {list[i], list[i + 1 + i % 2], list[i + 2 - i % 2]});
        }
    }
    return corners;
}

std::vector<Vec2> readUvs(const Document& document, const Primitive& primitive, std::size_t uv_set) {
    const std::string name = "TEXCOORD_" + std::to_string(uv_set);
    return decodeVec2(document, attributeAccessor(document, primitive, name), attributePlace(primitive, name));
}

std::vector<Vec3> readVec3(const Document& document, const Primitive& primitive, const char* attribute) {
    std::vector<Vec3> values =
        decodeVec3(document, attributeAccessor(document, primitive, attribute), attributePlace(primitive, attribute));
    if (isNormal(attribute)) scaleNormals(primitive, values);
    return values;
}

std::optional<StridedSpan<const Vec2>> lendUvs(const Document& document, const Primitive& primitive,
                                               std::size_t uv_set) {
    return viewVectors<Vec2>(document, attributeAccessor(document, primitive, "TEXCOORD_" + std::to_string(uv_set)));
}

std::optional<StridedSpan<const Vec3>> lendVec3(const Document& document, const Primitive& primitive,
                                                const char* attribute) {
    if (isNormal(attribute) && primitive.normal_scales != nullptr) return {};
    return viewVectors<Vec3>(document, attributeAccessor(document, primitive, attribute));
}

std::vector<Vec4> readTangents(const Document& document, const Primitive& primitive) {
    return decodeVec4(document, attributeAccessor(document, primitive, "TANGENT"),
                      attributePlace(primitive, "TANGENT"));
}

std::vector<Vec3> readOffsets(const Document& document, const Primitive& primitive, std::size_t target,
                              const char* attribute) {
    const auto index = findAttribute(primitive.targets[target], attribute);
    if (!index) return {};
    const std::string place = join(join(join(primitive.place(), "targets"), target), attribute);
    std::vector<Vec3> offsets = decodeVec3(document, readAccessor(document, *index), place);
    if (isNormal(attribute)) scaleNormals(primitive, offsets);
    return offsets;
}

void scaleNormals(const Primitive& primitive, std::vector<Vec3>& normals) {
    if (primitive.normal_scales == nullptr) return;
    const std::vector<double>& scales = primitive.normal_scales->of_vertices;
    for (std::size_t v = 0; v < normals.size() && v < scales.size(); ++v) {
        if (scales[v] != 1) normals[v] = toFloat(scales[v] * toDouble(normals[v]));
    }
}

}  // namespace tspace::gltf
