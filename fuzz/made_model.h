// SPDX-License-Identifier: MIT
// Creates a GLB from the input. Most of its structure is valid, so that the code after the reader runs, on arbitrary
// values. Other fuzz targets cover invalid files.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "byte_reader.h"
#include "model/gltf/container.h"
#include "model/gltf/packed_layout.h"

namespace tspace::fuzz {

/// Component type of an accessor, and whether it is normalized.
struct NumberFormat {
    gltf::ComponentType component;
    bool is_normalized = false;
    [[nodiscard]] std::size_t bytes() const { return gltf::bytesOf(component); }
};

class ModelMaker {
  public:
    /// `image`: the image file for the model's textures; empty: the model has no textures.
    explicit ModelMaker(ByteReader& in, std::vector<std::uint8_t> image = {}) : in_(in), image_(std::move(image)) {}

    std::vector<std::uint8_t> glb() {
        const std::string materials = this->materials(), meshes = this->meshes(), nodes = this->nodes();
        std::string json =
            R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_mesh_quantization","KHR_texture_transform"],)"
            R"("extensionsRequired":["KHR_mesh_quantization"],"scene":0,"scenes":[{"nodes":[0]}],)";
        json += "\"nodes\":[" + nodes + "],\"meshes\":[" + meshes + "],\"materials\":[" + materials + "],";
        if (!image_.empty()) {
            const std::size_t view = addView(image_);
            json += R"("textures":[{"source":0,"sampler":0},{"source":0}],"samplers":[{"wrapS":)" + wrap() +
                    ",\"wrapT\":" + wrap() + R"(}],"images":[{"mimeType":"image/png","bufferView":)" +
                    std::to_string(view) + "}],";
        }
        json += "\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
                "],\"buffers\":[{\"byteLength\":" + std::to_string(bytes_.size()) + "}]}";
        const gltf::GlbFrame frame = gltf::frameGlb(json, bytes_.size(), {});
        std::vector<std::uint8_t> file(frame.head.begin(), frame.head.end());
        file.insert(file.end(), bytes_.begin(), bytes_.end());
        file.insert(file.end(), frame.tail.begin(), frame.tail.end());
        return file;
    }

  private:
    using ComponentType = gltf::ComponentType;
    using Numbers = NumberFormat;

    /// Returns a value: usually a multiple of a small step, so that corners are welded and triangles meet; sometimes a
    /// float with arbitrary bits.
    float value() {
        const std::uint8_t b = in_.byte();
        return b == 255 ? in_.any() : static_cast<float>(b % 17) / 8 - 1;
    }
    /// Returns a number that JSON can represent.
    std::string number() {
        const float x = value();
        char text[40];
        std::snprintf(text, sizeof text, "%.9g", std::isfinite(x) ? static_cast<double>(x) : 1e30);
        return text;
    }
    std::string numbers(std::size_t count) {
        std::string list = "[";
        for (std::size_t i = 0; i < count; ++i) list += (i == 0 ? "" : ",") + number();
        return list + "]";
    }
    bool one(unsigned of) { return in_.byte() % of == 0; }

    std::size_t addView(const std::vector<std::uint8_t>& content) {
        views_ += (views_.empty() ? "" : ",") + std::string("{\"buffer\":0,\"byteOffset\":") +
                  std::to_string(bytes_.size()) + ",\"byteLength\":" + std::to_string(content.size()) + "}";
        bytes_.insert(bytes_.end(), content.begin(), content.end());
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return view_count_++;
    }

    /// Adds an accessor of `count` elements with `width` numbers each, and returns its index. `is_aligned`: elements
    /// are aligned to four bytes.
    std::size_t addAccessor(const Numbers& kind, const char* type, std::size_t width, std::size_t count,
                            bool is_aligned) {
        const std::size_t stride = is_aligned ? (kind.bytes() * width + 3) / 4 * 4 : kind.bytes() * width;
        std::vector<std::uint8_t> content(stride * count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < width; ++k) {
                std::uint8_t* const to = content.data() + i * stride + k * kind.bytes();
                if (kind.component == ComponentType::f32) {
                    const float x = value();
                    std::memcpy(to, &x, sizeof x);
                } else {
                    for (std::size_t b = 0; b < kind.bytes(); ++b) to[b] = in_.byte();
                }
            }
        }
        return addAccessor(content, stride, kind, type, count);
    }
    std::size_t addAccessor(const std::vector<std::uint8_t>& content, std::size_t stride, const Numbers& kind,
                            const char* type, std::size_t count) {
        const std::size_t view = addView(content);
        if (stride % 4 == 0 && stride > 0) {
            views_.pop_back();
            views_ += ",\"byteStride\":" + std::to_string(stride) + "}";
        }
        accessors_ += (accessors_.empty() ? "" : ",") + std::string("{\"bufferView\":") + std::to_string(view) +
                      ",\"componentType\":" + std::to_string(static_cast<int>(kind.component)) +
                      ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"" +
                      (kind.is_normalized ? ",\"normalized\":true" : "") + "}";
        return accessor_count_++;
    }

    static constexpr Numbers kFloat{ComponentType::f32};
    /// Returns a format for vectors: floats, or integers as in KHR_mesh_quantization.
    Numbers vectorNumbers() {
        constexpr Numbers kKinds[] = {kFloat, kFloat, kFloat, {ComponentType::i8, true}, {ComponentType::i16, true}};
        return kKinds[in_.byte() % 5];
    }
    Numbers uvNumbers() {
        constexpr Numbers kKinds[] = {
            kFloat, kFloat, kFloat, {ComponentType::u8, true}, {ComponentType::u16, true}, {ComponentType::i16, true}};
        return kKinds[in_.byte() % 6];
    }

    void addAttribute(std::string& list, const std::string& name, const Numbers& kind, const char* type,
                      std::size_t width, std::size_t count) {
        list +=
            (list.empty() ? "\"" : ",\"") + name + "\":" + std::to_string(addAccessor(kind, type, width, count, true));
    }

    std::size_t addIndices(std::size_t vertex_count) {
        constexpr Numbers kKinds[] = {{ComponentType::u8}, {ComponentType::u16}, {ComponentType::u32}};
        const Numbers kind = kKinds[in_.byte() % 3];
        const std::size_t count = 3 * (in_.byte() % 24u);
        const bool is_sound = !one(16);
        std::vector<std::uint8_t> content;
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t index = in_.byte();
            if (is_sound) index %= vertex_count;
            for (std::size_t b = 0; b < kind.bytes(); ++b)
                content.push_back(static_cast<std::uint8_t>(b == 0 ? index : 0));
        }
        return addAccessor(content, 0, kind, "SCALAR", count);
    }

    void addPacked(std::string& attributes, std::size_t vertex_count) {
        const auto layouts = gltf::packedLayouts();
        for (const gltf::PackedPart& part : layouts[in_.byte() % layouts.size()].parts) {
            const std::string type = part.type;
            addAttribute(attributes, part.attribute, Numbers{part.component, part.normalized}, part.type,
                         static_cast<std::size_t>(type.back() - '0'), vertex_count);
        }
    }

    std::string primitive() {
        const unsigned has = in_.byte();
        const std::size_t vertex_count = 1 + in_.byte() % 24u;
        std::string attributes, targets;
        addAttribute(attributes, "POSITION", one(8) ? Numbers{ComponentType::i16, true} : kFloat, "VEC3", 3,
                     vertex_count);
        if ((has & 1) == 0) addAttribute(attributes, "TEXCOORD_0", uvNumbers(), "VEC2", 2, vertex_count);
        if ((has & 2) == 0) addAttribute(attributes, "NORMAL", vectorNumbers(), "VEC3", 3, vertex_count);
        if ((has & 4) == 0) addAttribute(attributes, "TANGENT", vectorNumbers(), "VEC4", 4, vertex_count);
        if ((has & 8) != 0) addPacked(attributes, vertex_count);
        if ((has & 16) != 0) {
            for (std::size_t n = 1 + in_.byte() % 2u; n > 0; --n) {
                std::string target;
                addAttribute(target, "POSITION", kFloat, "VEC3", 3, vertex_count);
                if (one(2)) addAttribute(target, "NORMAL", vectorNumbers(), "VEC3", 3, vertex_count);
                if (one(4)) addAttribute(target, "TANGENT", kFloat, "VEC3", 3, vertex_count);
                targets += (targets.empty() ? "{" : ",{") + target + "}";
            }
        }
        std::string text = "{\"attributes\":{" + attributes + "}";
        if (!targets.empty()) text += ",\"targets\":[" + targets + "]";
        if ((has & 32) == 0) text += ",\"indices\":" + std::to_string(addIndices(vertex_count));
        if ((has & 192) == 192) text += ",\"mode\":" + std::to_string(in_.byte() % 7);
        return text + ",\"material\":" + std::to_string(in_.byte() % 2) + "}";
    }

    std::string meshes() {
        std::string list;
        for (std::size_t m = 0; m < 2; ++m) {
            std::string primitives;
            for (std::size_t p = 1 + in_.byte() % 2u; p > 0; --p) primitives += primitive() + (p > 1 ? "," : "");
            list += (m == 0 ? "" : ",") + std::string(R"({"name":"m","primitives":[)") + primitives + "]}";
        }
        return list;
    }

    /// Returns the JSON of a chain of nodes that starts at node 0. Their matrices may be singular or mirroring.
    std::string nodes() {
        std::string list;
        for (std::size_t n = 0; n < 3; ++n) {
            list += (n == 0 ? "" : ",") + std::string("{\"mesh\":") + std::to_string(in_.byte() % 2);
            switch (in_.byte() % 4) {
                case 0: list += ",\"matrix\":" + numbers(16); break;
                case 1: list += ",\"scale\":" + numbers(3) + ",\"translation\":" + numbers(3); break;
                case 2: list += ",\"rotation\":" + numbers(4); break;
                default: break;
            }
            list += n < 2 ? ",\"children\":[" + std::to_string(n + 1) + "]}" : "}";
        }
        return list;
    }

    std::string texture(const std::string& more = {}) {
        std::string text = "{\"index\":" + std::to_string(in_.byte() % 2) + more;
        if (one(3)) {
            text += R"(,"extensions":{"KHR_texture_transform":{"rotation":)" + number() + ",\"scale\":" + numbers(2) +
                    ",\"offset\":" + numbers(2) + "}}";
        }
        return text;
    }
    std::string wrap() {
        constexpr const char* kModes[] = {"10497", "33071", "33648"};
        return kModes[in_.byte() % 3];
    }

    std::string materials() {
        std::string list;
        for (std::size_t m = 0; m < 2; ++m) {
            list += (m == 0 ? "{" : ",{") + std::string("\"name\":\"") + (m == 0 ? "a" : "b") + "\"";
            if (!image_.empty() && !one(4)) {
                list += ",\"normalTexture\":" + texture(",\"scale\":" + number()) + "}";
                if (one(3)) list += ",\"pbrMetallicRoughness\":{\"baseColorTexture\":" + texture() + "}}";
            }
            if (one(2)) list += ",\"doubleSided\":true";
            if (one(4)) list += R"(,"alphaMode":"MASK")";
            list += "}";
        }
        return list;
    }

    ByteReader& in_;
    std::vector<std::uint8_t> image_, bytes_ = {};
    std::string views_ = {}, accessors_ = {};
    std::size_t view_count_ = 0, accessor_count_ = 0;
};

}  // namespace tspace::fuzz
