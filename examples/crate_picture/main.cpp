// SPDX-License-Identifier: MIT
// tspace_crate_picture BEFORE.png AFTER.png: the demo's crate, lit from above, with and without the sign of its
// tangents. AFTER has what tspace makes. In BEFORE every sign is +1, as where a program drops w. The crate's left half
// shows the texture mirrored, so there, and only there, bumps become dents.
#include <cstdio>
#include <fstream>
#include <utility>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "raster.h"
#include "tspace/tspace.hpp"

namespace {

constexpr int kSize = 440;

/// The crate's corners, with the tangents of `mikktspace` as glTF stores them.
tspace::Result<std::vector<picture::Corner>> litCorners(const crate::Mesh& crate) {
    std::vector<picture::Corner> vertices;
    for (std::size_t v = 0; v < crate.positions.size() / 3; ++v) {
        const float *p = &crate.positions[3 * v], *n = &crate.normals[3 * v], *uv = &crate.uvs[2 * v];
        vertices.push_back({{p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv[0], uv[1]}, {}});
    }
    const auto count = vertices.size();
    constexpr std::size_t kStride = sizeof(picture::Corner);
    const tspace::MeshView mesh{.positions = {&vertices[0].position, count, kStride},
                                .normals = {&vertices[0].normal, count, kStride},
                                .uvs = {&vertices[0].uv, count, kStride},
                                .indices = std::span(crate.indices)};
    std::vector<tspace::Vec4> tangents(mesh.cornerCount());
    const auto report =
        tspace::generateTangents(mesh, {.convention = tspace::conventions::gltf}, {.tangents = tangents});
    if (!report) return report.error();
    std::vector<picture::Corner> corners;
    for (std::size_t c = 0; c < tangents.size(); ++c) {
        corners.push_back(vertices[mesh.indices[c]]);
        corners.back().tangent = tangents[c];
    }
    return corners;
}

bool writePng(const char* path, const std::vector<std::uint8_t>& pixels) {
    std::ofstream file(path, std::ios::binary);
    const auto append = [](void* to, void* data, int bytes) {
        static_cast<std::ofstream*>(to)->write(static_cast<const char*>(data), bytes);
    };
    stbi_write_png_compression_level = 100;
    stbi_write_png_to_func(append, &file, kSize, kSize, 3, pixels.data(), kSize * 3);
    file.close();
    return static_cast<bool>(file);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: tspace_crate_picture BEFORE.png AFTER.png\n", stderr);
        return 2;
    }
    const crate::Textures textures = crate::makeTextures();
    const auto corners = litCorners(crate::makeMesh());
    if (!corners) {
        std::fprintf(stderr, "tspace_crate_picture: %s\n", corners.error().message.c_str());
        return 5;
    }
    picture::Scene scene{.corners = *corners,
                         .textures = &textures,
                         .eye = {0.62f, 0.80f, 3.0f},
                         .target = {-0.06f, -0.05f, 0},
                         .zoom = 4.6f,
                         .to_key_light = {-0.35f, 1.0f, 0.5f}};
    const std::vector<std::uint8_t> after = picture::draw(scene, kSize);
    for (picture::Corner& corner : scene.corners) corner.tangent.w = 1;
    const std::vector<std::uint8_t> before = picture::draw(scene, kSize);
    for (const auto& [path, pixels] : {std::pair(argv[1], &before), std::pair(argv[2], &after)}) {
        if (!writePng(path, *pixels)) {
            std::fprintf(stderr, "tspace_crate_picture: cannot write %s\n", path);
            return 4;
        }
    }
    return 0;
}
