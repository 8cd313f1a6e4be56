// SPDX-License-Identifier: MIT
// Calls of the library Draco. Its decoders are given limits, because their counts come from the file.
#include "model/gltf/codecs/codecs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#ifdef TSPACE_HAS_DRACO
#include <draco/attributes/attribute_octahedron_transform.h>
#include <draco/attributes/attribute_quantization_transform.h>
#include <draco/compression/expert_encode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#endif

namespace tspace::gltf {

#ifndef TSPACE_HAS_DRACO

std::string dracoMissing() { return "this build of tspace does not include the library Draco"; }
std::string decodeDraco(std::span<const std::uint8_t>, const DracoLimits&, DracoMesh&) { return dracoMissing(); }
bool encodeDracoUnchecked(DracoMesh&, Bytes&) { return false; }

#else

namespace {

constexpr const char* kTooMuch = "the Draco data declares more points, triangles or attributes than the accessors";

/// Decoder of the library that checks counts before it allocates memory.
template <class Decoder>
class Limited : public Decoder {
  public:
    explicit Limited(const DracoLimits& limits) : limits_(limits) {}
    [[nodiscard]] bool isTooLarge() const { return is_too_large_; }

  protected:
    bool DecodeConnectivity() override {
        draco::DecoderBuffer ahead = *this->buffer();
        std::uint32_t first = 0, second = 0;
        if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
        // Edgebreaker data declares vertices, then faces; sequential data declares faces, then points.
        constexpr bool vertices_first = std::is_base_of_v<draco::MeshEdgebreakerDecoder, Decoder>;
        const std::size_t faces = vertices_first ? second : first, points = vertices_first ? first : second;
        return fits(faces <= limits_.corner_count / 3 && points <= limits_.point_count) &&
               Decoder::DecodeConnectivity() && fits(this->mesh()->num_points() <= limits_.point_count);
    }

    bool DecodeAllAttributes() override {
        // Draco stores an additional copy of each component as a 4-byte integer.
        std::size_t point_bytes = 0;
        for (std::int32_t i = 0; i < this->point_cloud()->num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *this->point_cloud()->attribute(i);
            point_bytes += static_cast<std::size_t>(attribute.byte_stride()) +
                           std::size_t{4} * static_cast<std::size_t>(attribute.num_components());
        }
        const std::size_t points = this->mesh()->num_points();
        return fits(points == 0 || point_bytes <= limits_.bytes / points) && Decoder::DecodeAllAttributes();
    }

  private:
    bool fits(bool is_true) {
        is_too_large_ = is_too_large_ || !is_true;
        return is_true;
    }
    DracoLimits limits_;
    bool is_too_large_ = false;
};

template <class Decoder>
std::string runDecoder(draco::DecoderBuffer& buffer, const DracoLimits& limits, draco::Mesh& mesh) {
    // Keep quantized values as integers with their grid, so that encoding again reproduces the same grid.
    draco::DecoderOptions options;
    for (int kind = 0; kind < draco::GeometryAttribute::NAMED_ATTRIBUTES_COUNT; ++kind)
        options.SetAttributeBool(static_cast<draco::GeometryAttribute::Type>(kind), "skip_attribute_transform", true);
    Limited<Decoder> decoder(limits);
    if (decoder.Decode(options, &buffer, &mesh).ok()) return {};
    return decoder.isTooLarge() ? kTooMuch : "the Draco data is damaged";
}

std::string decodeMesh(std::span<const std::uint8_t> data, const DracoLimits& limits, draco::Mesh& mesh) {
    if (std::string fault = dracoHeaderFault(data); !fault.empty()) return fault;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
    if (isEdgebreaker(data)) return runDecoder<draco::MeshEdgebreakerDecoder>(buffer, limits, mesh);
    return runDecoder<draco::MeshSequentialDecoder>(buffer, limits, mesh);
}

/// Converts quantized integers to floats and sets the rounding. Returns null if the attribute is not quantized.
std::unique_ptr<draco::PointAttribute> originalValues(const draco::PointAttribute& stored, DracoRounding& rounding,
                                                      bool& is_sound) {
    const draco::AttributeTransformData* transform = stored.GetAttributeTransformData();
    if (transform == nullptr || transform->transform_type() == draco::ATTRIBUTE_NO_TRANSFORM) return nullptr;
    const bool is_octahedral = transform->transform_type() == draco::ATTRIBUTE_OCTAHEDRON_TRANSFORM;
    auto values = std::make_unique<draco::PointAttribute>();
    const auto component_count = static_cast<std::int8_t>(is_octahedral ? 3 : stored.num_components());
    values->Init(stored.attribute_type(), component_count, draco::DT_FLOAT32, false, stored.size());
    rounding.is_octahedral = is_octahedral;
    if (is_octahedral) {
        draco::AttributeOctahedronTransform octahedron;
        is_sound = octahedron.InitFromAttribute(stored) && octahedron.InverseTransformAttribute(stored, values.get());
        rounding.bits = octahedron.quantization_bits();
    } else {
        draco::AttributeQuantizationTransform box;
        is_sound = box.InitFromAttribute(stored) && box.InverseTransformAttribute(stored, values.get());
        rounding.bits = box.quantization_bits();
        rounding.origin = box.min_values();
        rounding.range = box.range();
    }
    return values;
}

template <class Component>
bool copyValues(const draco::PointAttribute& values, const draco::PointAttribute& mapping, std::size_t point_count,
                DracoAttribute& to) {
    const std::size_t element = sizeof(Component) * to.component_count;
    to.values.resize(point_count * element);
    std::vector<Component> one(to.component_count);
    for (std::size_t i = 0; i < point_count; ++i) {
        const draco::AttributeValueIndex value = mapping.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        if (value.value() >= values.size()) return false;
        if (!values.ConvertValue<Component>(value, static_cast<std::int8_t>(to.component_count), one.data()))
            return false;
        std::memcpy(to.values.data() + i * element, one.data(), element);
    }
    return true;
}

bool copyAs(const draco::PointAttribute& values, const draco::PointAttribute& mapping, std::size_t point_count,
            DracoAttribute& to) {
    switch (to.component) {
        case ComponentType::i8: return copyValues<std::int8_t>(values, mapping, point_count, to);
        case ComponentType::u8: return copyValues<std::uint8_t>(values, mapping, point_count, to);
        case ComponentType::i16: return copyValues<std::int16_t>(values, mapping, point_count, to);
        case ComponentType::u16: return copyValues<std::uint16_t>(values, mapping, point_count, to);
        case ComponentType::u32: return copyValues<std::uint32_t>(values, mapping, point_count, to);
        case ComponentType::f32: break;
    }
    return copyValues<float>(values, mapping, point_count, to);
}

std::string readAttribute(const draco::Mesh& mesh, DracoAttribute& to) {
    const std::string name = "the Draco attribute " + std::to_string(to.id);
    const draco::PointAttribute* stored = mesh.GetAttributeByUniqueId(to.id);
    if (stored == nullptr) return name + " does not exist";
    bool is_sound = true;
    const std::unique_ptr<draco::PointAttribute> original = originalValues(*stored, to.rounding, is_sound);
    const draco::PointAttribute& values = original ? *original : *stored;
    if (static_cast<std::size_t>(values.num_components()) != to.component_count)
        return name + " has a different number of components than its accessor";
    if (!is_sound || !copyAs(values, *stored, mesh.num_points(), to))
        return "the values of " + name + " are damaged or cannot be converted to the component type of its accessor";
    return {};
}

draco::DataType dataType(ComponentType component) {
    switch (component) {
        case ComponentType::i8: return draco::DT_INT8;
        case ComponentType::u8: return draco::DT_UINT8;
        case ComponentType::i16: return draco::DT_INT16;
        case ComponentType::u16: return draco::DT_UINT16;
        case ComponentType::u32: return draco::DT_UINT32;
        case ComponentType::f32: break;
    }
    return draco::DT_FLOAT32;
}

draco::GeometryAttribute::Type attributeType(DracoKind kind) {
    switch (kind) {
        case DracoKind::position: return draco::GeometryAttribute::POSITION;
        case DracoKind::normal: return draco::GeometryAttribute::NORMAL;
        case DracoKind::color: return draco::GeometryAttribute::COLOR;
        case DracoKind::uv: return draco::GeometryAttribute::TEX_COORD;
        case DracoKind::other: break;
    }
    return draco::GeometryAttribute::GENERIC;
}

void addAttribute(draco::Mesh& mesh, DracoAttribute& from) {
    draco::GeometryAttribute format;
    const std::size_t element = bytesOf(from.component) * from.component_count;
    format.Init(attributeType(from.kind), nullptr, static_cast<std::uint8_t>(from.component_count),
                dataType(from.component), from.normalized, static_cast<std::int64_t>(element), 0);
    const int number = mesh.AddAttribute(format, true, mesh.num_points());
    mesh.attribute(number)->buffer()->Write(0, from.values.data(), from.values.size());
    from.id = mesh.attribute(number)->unique_id();
}

/// Formats a float so that the library reads back the same bits (its own writer keeps six decimals). The format is a
/// hexadecimal integer with a power of two: the library parses with strtod, whose decimal point depends on the locale.
std::string exactText(float value) {
    int exponent = 0;
    const auto whole = static_cast<int>(std::ldexp(std::frexp(value, &exponent), 24));
    char text[32];
    std::snprintf(text, sizeof text, "%s0x%xp%d", std::signbit(value) ? "-" : "",
                  static_cast<unsigned>(std::abs(whole)), exponent - 24);
    return text;
}

void setRounding(draco::ExpertEncoder& encoder, int number, const DracoAttribute& attribute) {
    const DracoRounding& rounding = attribute.rounding;
    if (rounding.bits == 0 || attribute.component != ComponentType::f32) return;
    draco::Options options;
    options.SetInt("quantization_bits", rounding.bits);
    if (!rounding.is_octahedral && !rounding.origin.empty()) {
        std::string origin;
        for (const float value : rounding.origin) origin += exactText(value) + ' ';
        options.SetString("quantization_origin", origin);
        options.SetString("quantization_range", exactText(rounding.range));
    }
    encoder.options().SetAttributeOptions(number, options);
}

bool encodeWith(DracoMesh& from, bool packs_triangles, Bytes& data) {
    draco::Mesh mesh;
    mesh.set_num_points(static_cast<std::uint32_t>(from.point_count));
    mesh.SetNumFaces(from.corners.size() / 3);
    for (std::size_t i = 0; i < from.corners.size() / 3; ++i) {
        const std::uint32_t* corner = &from.corners[i * 3];
        mesh.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i)),
                     {draco::PointIndex(corner[0]), draco::PointIndex(corner[1]), draco::PointIndex(corner[2])});
    }
    for (DracoAttribute& attribute : from.attributes) addAttribute(mesh, attribute);
    draco::ExpertEncoder encoder(mesh);
    // Edgebreaker reorders points and triangles, which would change the last bits of frames.
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    encoder.options().SetGlobalBool("compress_connectivity", packs_triangles);
    for (std::size_t i = 0; i < from.attributes.size(); ++i)
        setRounding(encoder, static_cast<int>(i), from.attributes[i]);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeToBuffer(&buffer).ok()) return false;
    const auto* first = reinterpret_cast<const std::uint8_t*>(buffer.data());
    data.assign(first, first + buffer.size());
    return true;
}

}  // namespace

std::string dracoMissing() { return {}; }

std::string decodeDraco(std::span<const std::uint8_t> data, const DracoLimits& limits, DracoMesh& mesh) {
    draco::Mesh decoded;
    if (std::string fault = decodeMesh(data, limits, decoded); !fault.empty()) return fault;
    mesh.point_count = decoded.num_points();
    mesh.corners.clear();
    mesh.corners.reserve(std::size_t{decoded.num_faces()} * 3);
    for (std::uint32_t i = 0; i < decoded.num_faces(); ++i) {
        for (const draco::PointIndex& point : decoded.face(draco::FaceIndex(i))) {
            if (point.value() >= mesh.point_count)
                return "a triangle of the Draco data refers to a point that does not exist";
            mesh.corners.push_back(point.value());
        }
    }
    for (DracoAttribute& attribute : mesh.attributes) {
        if (std::string fault = readAttribute(decoded, attribute); !fault.empty()) return fault;
    }
    return {};
}

bool encodeDracoUnchecked(DracoMesh& from, Bytes& data) {
    // Draco's decoders reject sequential data with fewer than three bytes per triangle after the header, even if the
    // triangles compress better. Uncompressed triangles take at least three bytes.
    constexpr std::size_t kHeaderBytes = 64;
    if (!encodeWith(from, true, data)) return false;
    return data.size() >= from.corners.size() + kHeaderBytes || encodeWith(from, false, data);
}

#endif

}  // namespace tspace::gltf
