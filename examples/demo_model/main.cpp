// SPDX-License-Identifier: MIT
// tspace_demo_model FILE.glb [SIZE]: writes the procedural model that scripts/demo uses, with images of SIZE by SIZE
// texels. It is a crate with a normal map, mirrored UVs, UV seams and bevels, and without tangents. Every run writes
// the same bytes.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "crate.h"
#include "model/json/json.h"

static_assert(std::endian::native == std::endian::little, "a GLB is little-endian and is written as it lies");

namespace {

using tspace::Json;

// Constants of the glTF format.
constexpr int kFloat = 5126, kUnsignedShort = 5123, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kRepeat = 10497;

/// The binary chunk, and the JSON that describes its parts.
struct Builder {
    std::string binary;
    Json views = Json::array();
    Json accessors = Json::array();

    std::size_t addView(const void* data, std::size_t bytes, int target) {
        views.push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}});
        if (target != 0) {
            views.back()["target"] = target;
        }
        binary.append(static_cast<const char*>(data), bytes);
        binary.resize((binary.size() + 3) / 4 * 4);
        return views.size() - 1;
    }

    template <class T>
    std::size_t addAccessor(const std::vector<T>& values, std::size_t width, int type, const char* shape, int target) {
        const std::size_t view = addView(values.data(), values.size() * sizeof(T), target);
        accessors.push_back(
            {{"bufferView", view}, {"componentType", type}, {"count", values.size() / width}, {"type", shape}});
        return accessors.size() - 1;
    }

    std::size_t addImage(const crate::Image& image) {
        std::string png;
        const auto append = [](void* to, void* data, int bytes) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(bytes));
        };
        stbi_write_png_to_func(append, &png, image.size, image.size, 3, image.rgb.data(), image.size * 3);
        return addView(png.data(), png.size(), 0);
    }
};

Json bounds(const std::vector<float>& values, bool upper) {
    Json result = Json::array();
    for (std::size_t k = 0; k < 3; ++k) {
        float extreme = values[k];
        for (std::size_t i = k; i < values.size(); i += 3) {
            extreme = upper ? std::max(extreme, values[i]) : std::min(extreme, values[i]);
        }
        result.push_back(extreme);
    }
    return result;
}

std::string makeGlb(int image_size) {
    const crate::Mesh mesh = crate::makeMesh();
    const crate::Textures textures = crate::makeTextures(image_size);
    Builder builder;
    const auto positions = builder.addAccessor(mesh.positions, 3, kFloat, "VEC3", kArrayBuffer);
    builder.accessors[positions]["min"] = bounds(mesh.positions, false);
    builder.accessors[positions]["max"] = bounds(mesh.positions, true);
    const auto normals = builder.addAccessor(mesh.normals, 3, kFloat, "VEC3", kArrayBuffer);
    const auto uvs = builder.addAccessor(mesh.uvs, 2, kFloat, "VEC2", kArrayBuffer);
    const auto indices = builder.addAccessor(mesh.indices, 1, kUnsignedShort, "SCALAR", kElementArrayBuffer);
    const auto color_view = builder.addImage(textures.base_color);
    const auto normal_view = builder.addImage(textures.normal);

    Json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "tspace_demo_model"}};
    root["scene"] = 0;
    root["scenes"] = {{{"nodes", {0}}}};
    root["nodes"] = {{{"name", "crate"}, {"mesh", 0}}};
    root["meshes"] = {{{"name", "crate"},
                       {"primitives",
                        {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                          {"indices", indices},
                          {"material", 0}}}}}};
    root["materials"] = {{{"name", "painted steel"},
                          {"pbrMetallicRoughness",
                           {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.1}, {"roughnessFactor", 0.55}}},
                          {"normalTexture", {{"index", 1}}}}};
    root["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}, {"sampler", 0}}};
    root["samplers"] = {
        {{"magFilter", kLinear}, {"minFilter", kLinearMipmapLinear}, {"wrapS", kRepeat}, {"wrapT", kRepeat}}};
    root["images"] = {{{"name", "base color"}, {"mimeType", "image/png"}, {"bufferView", color_view}},
                      {{"name", "normal"}, {"mimeType", "image/png"}, {"bufferView", normal_view}}};
    root["accessors"] = builder.accessors;
    root["bufferViews"] = builder.views;
    root["buffers"] = {{{"byteLength", builder.binary.size()}}};

    std::string json = root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string glb;
    const auto word = [&glb](std::size_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        glb.append(reinterpret_cast<const char*>(&bits), sizeof bits);
    };
    glb += "glTF";
    word(2);
    word(12 + 8 + json.size() + 8 + builder.binary.size());
    word(json.size());
    glb += "JSON" + json;
    word(builder.binary.size());
    glb.append("BIN\0", 4);
    return glb + builder.binary;
}

}  // namespace

int main(int argc, char** argv) {
    const int image_size = argc == 3 ? std::atoi(argv[2]) : 1024;
    if (argc < 2 || argc > 3 || image_size < 1 || image_size > 8192) {
        std::fputs("usage: tspace_demo_model FILE.glb [SIZE]\n", stderr);
        return 2;
    }
    const std::string glb = makeGlb(image_size);
    std::ofstream file(argv[1], std::ios::binary);
    file.write(glb.data(), static_cast<std::streamsize>(glb.size()));
    file.close();
    if (!file) {
        std::fprintf(stderr, "tspace_demo_model: cannot write %s\n", argv[1]);
        return 4;
    }
    return 0;
}
