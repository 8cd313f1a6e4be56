// SPDX-License-Identifier: MIT
// Small glTF files whose geometry is, or is declared to be, far larger than the file.
#include <gtest/gtest.h>

#include "expect_bounded.h"
#include "model/gltf_builder.h"

namespace tspace {
namespace {

using test::GltfBuilder;
using test::Json;
using test::TempFolder;

constexpr int kU8 = 5121, kU32 = 5125, kFloat = 5126;

int expectBounded(const TempFolder& folder, const GltfBuilder& builder, const std::vector<std::string>& options = {}) {
    const std::string path = folder.write("model.glb", std::span<const std::uint8_t>(builder.glb()));
    return test::expectBounded(path, std::filesystem::file_size(path), options);
}

std::size_t addPlain(GltfBuilder& builder, std::size_t view, int component, const char* type, std::size_t count,
                     std::size_t offset = 0) {
    Json accessor = {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (offset != 0) accessor["byteOffset"] = offset;
    builder.json()["accessors"].push_back(accessor);
    return builder.json()["accessors"].size() - 1;
}

/// Accessors of a bumpy sheet of n x n vertices with normals and UVs. `attributes`: {POSITION, NORMAL, TEXCOORD_0}.
struct Sheet {
    Json attributes = {};
    std::size_t indices = 0;
};

Sheet addSheet(GltfBuilder& builder, std::uint32_t n) {
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            positions.insert(positions.end(), {fx, fy, static_cast<float>((x * 7 + y * 3) % 5)});
            normals.insert(normals.end(), {0, 0, 1});
            uvs.insert(uvs.end(), {fx / 64, fy / 64});
            if (x + 1 == n || y + 1 == n) continue;
            const std::uint32_t a = y * n + x;
            indices.insert(indices.end(), {a, a + 1, a + n + 1, a, a + n + 1, a + n});
        }
    }
    Sheet sheet;
    sheet.attributes = {{"POSITION", builder.addFloats(positions, 3)},
                        {"NORMAL", builder.addFloats(normals, 3)},
                        {"TEXCOORD_0", builder.addFloats(uvs, 2)}};
    sheet.indices = builder.addAccessor(indices, kU32, "SCALAR", indices.size());
    return sheet;
}

TEST(MemoryCeiling, HoldsForFourBillionClaimedVertices) {
    const TempFolder folder;
    GltfBuilder builder;
    const std::size_t view = builder.addView(Bytes(36, 0));
    builder.addPrimitive({{"POSITION", addPlain(builder, view, kFloat, "VEC3", 4'000'000'000u)}});
    EXPECT_EQ(expectBounded(folder, builder), 4);
}

TEST(MemoryCeiling, HoldsForZerosWithoutData) {
    const TempFolder folder;
    GltfBuilder builder;
    const auto zeros = [&](const char* type) {
        builder.json()["accessors"].push_back({{"componentType", kFloat}, {"count", 16'000'000}, {"type", type}});
        return builder.json()["accessors"].size() - 1;
    };
    builder.addPrimitive({{"POSITION", zeros("VEC3")}, {"NORMAL", zeros("VEC3")}, {"TEXCOORD_0", zeros("VEC2")}});
    EXPECT_GE(expectBounded(folder, builder), 3);
}

TEST(MemoryCeiling, HoldsForSparseElementsOverZeros) {
    const TempFolder folder;
    GltfBuilder builder;
    const std::size_t view = builder.addView(Bytes(36, 1));
    const auto sparse = [&](const char* type) {
        builder.json()["accessors"].push_back({{"componentType", kFloat},
                                               {"count", 4'000'000},
                                               {"type", type},
                                               {"sparse",
                                                {{"count", 1},
                                                 {"indices", {{"bufferView", view}, {"componentType", kU8}}},
                                                 {"values", {{"bufferView", view}}}}}});
        return builder.json()["accessors"].size() - 1;
    };
    builder.addPrimitive({{"POSITION", sparse("VEC3")}, {"NORMAL", sparse("VEC3")}, {"TEXCOORD_0", sparse("VEC2")}});
    EXPECT_GE(expectBounded(folder, builder), 3);
}

TEST(MemoryCeiling, HoldsForAStripOfOneByteIndices) {
    const TempFolder folder;
    GltfBuilder builder;
    Sheet sheet = addSheet(builder, 15);
    Bytes indices(4'000'000);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint8_t>((i * 37 + i / 225) % 225);
    Json& primitive = builder.addPrimitive(sheet.attributes);
    primitive["mode"] = 5;
    primitive["indices"] = addPlain(builder, builder.addView(indices), kU8, "SCALAR", indices.size());
    expectBounded(folder, builder);
}

TEST(MemoryCeiling, HoldsForAThousandPrimitivesThatShareVerticesAndTurnThem) {
    const TempFolder folder;
    GltfBuilder builder;
    const Sheet sheet = addSheet(builder, 100);
    for (int i = 0; i < 1000; ++i) {
        builder.json()["materials"].push_back(
            {{"normalTexture",
              {{"index", 0},
               {"extensions", {{"KHR_texture_transform", {{"rotation", 0.001 * (i + 1)}, {"scale", {1, 2}}}}}}}}});
        Json& primitive = builder.addPrimitive(sheet.attributes);
        primitive["indices"] = sheet.indices;
        primitive["material"] = i;
    }
    builder.json()["textures"] = Json::array({Json{{"source", 0}}});
    builder.json()["images"] = Json::array({Json{{"uri", "none.png"}}});
    expectBounded(folder, builder);
}

/// The results of many small primitives must not fragment the heap that all threads share.
TEST(MemoryCeiling, HoldsForThousandsOfSmallPrimitivesAndManyThreads) {
    const TempFolder folder;
    GltfBuilder builder;
    const Sheet sheet = addSheet(builder, 20);
    builder.json()["materials"] = Json::parse(R"([{"normalTexture": {"index": 0}}])");
    builder.json()["textures"] = Json::array({Json::object()});
    for (int i = 0; i < 3000; ++i) {
        // Accessors of their own, so that no result is shared.
        Json attributes = Json::object();
        for (const char* name : {"POSITION", "TEXCOORD_0"}) {
            Json accessor = builder.json()["accessors"][sheet.attributes[name].get<std::size_t>()];
            builder.json()["accessors"].push_back(std::move(accessor));
            attributes[name] = builder.json()["accessors"].size() - 1;
        }
        Json& primitive = builder.addPrimitive(attributes);
        primitive["indices"] = sheet.indices;
        primitive["material"] = 0;
    }
    const std::string path = folder.write("model.glb", std::span<const std::uint8_t>(builder.glb()));
    const std::uint64_t ceiling = test::kCeilingRatio * std::filesystem::file_size(path) + test::kCeilingBase;
    const test::MeasuredRun run = test::runMeasured({"check", "--threads", "8", path}, folder.path("messages"));
    EXPECT_LE(run.exit_code, 1) << folder.read("messages");
    EXPECT_LE(run.peak_bytes, ceiling);
}

TEST(MemoryCeiling, HoldsForAccessorsThatOverlap) {
    const TempFolder folder;
    GltfBuilder builder;
    const std::size_t view = builder.addView(Bytes(1'000'000, 1));
    for (std::size_t i = 0; i < 1000; ++i) {
        Json attributes = {{"POSITION", addPlain(builder, view, kFloat, "VEC3", 80'000, 4 * i)},
                           {"NORMAL", addPlain(builder, view, kFloat, "VEC3", 80'000, 4 * i + 4)},
                           {"TEXCOORD_0", addPlain(builder, view, kFloat, "VEC2", 80'000, 4 * i + 8)}};
        builder.addPrimitive(attributes);
    }
    expectBounded(folder, builder);
}

TEST(MemoryCeiling, HoldsForIndicesThatOverlap) {
    const TempFolder folder;
    GltfBuilder builder;
    const Sheet sheet = addSheet(builder, 15);
    const std::size_t view = builder.addView(Bytes(300'000, 1));
    for (std::size_t i = 0; i < 1000; ++i) {
        Json& primitive = builder.addPrimitive(sheet.attributes);
        primitive["indices"] = addPlain(builder, view, kU8, "SCALAR", 290'000, i);
    }
    expectBounded(folder, builder);
}

TEST(MemoryCeiling, HoldsForAThousandMorphTargetsOverOneView) {
    for (const bool one_accessor : {true, false}) {
        const TempFolder folder;
        GltfBuilder builder;
        const Sheet sheet = addSheet(builder, 100);
        const std::size_t view = builder.addView(Bytes(200'000, 1));
        Json& primitive = builder.addPrimitive(sheet.attributes);
        primitive["indices"] = sheet.indices;
        for (std::size_t i = 0; i < 1000; ++i) {
            const std::size_t accessor = one_accessor ? sheet.attributes["NORMAL"].get<std::size_t>()
                                                      : addPlain(builder, view, kFloat, "VEC3", 10'000, 4 * i);
            primitive["targets"].push_back({{"POSITION", accessor}});
        }
        expectBounded(folder, builder);
    }
}

TEST(MemoryCeiling, HoldsForBuffersThatNameOneFile) {
    const TempFolder folder;
    folder.write("data.bin", std::string(1'000'000, '\1'));
    Json json = {{"asset", {{"version", "2.0"}}}};
    for (int i = 0; i < 1000; ++i) {
        json["buffers"].push_back({{"byteLength", 1'000'000}, {"uri", "data.bin"}});
        json["bufferViews"].push_back({{"buffer", i}, {"byteLength", 1'000'000}});
        json["accessors"].push_back(
            {{"bufferView", i}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", 80'000}});
        json["meshes"].push_back({{"primitives", Json::array({Json{{"attributes", {{"POSITION", i}}}}})}});
    }
    const std::string path = folder.write("model.gltf", json.dump());
    test::expectBounded(path, test::bytesOf({path, folder.path("data.bin")}));
}

TEST(MemoryCeiling, HoldsForCustomAttributesOfSharedVertices) {
    const TempFolder folder;
    GltfBuilder builder;
    const Sheet sheet = addSheet(builder, 200);
    const std::size_t view = builder.addView(Bytes(44'100, 1));
    for (std::size_t i = 0; i < 1000; ++i) {
        Json attributes = sheet.attributes;
        attributes["_ID"] = addPlain(builder, view, kU8, "SCALAR", 40'000, i);
        builder.addPrimitive(attributes)["indices"] = sheet.indices;
    }
    expectBounded(folder, builder);
}

/// The limit for compressed data depends on its decompressed size, which is limited separately; the limit for a small
/// file is still small.
TEST(MemoryCeiling, HoldsForMeshoptViewsOverOneStream) {
    const TempFolder folder;
    GltfBuilder builder;
    const std::size_t bytes = 20'000, rows = bytes * 64 / 16;
    builder.addView(Bytes(bytes, 0xa0));
    builder.json()["buffers"] = Json::array({Json::object(), Json::object()});
    for (std::size_t i = 0; i < 50; ++i) {
        builder.json()["bufferViews"].push_back({{"buffer", 1},
                                                 {"byteOffset", i * rows * 16},
                                                 {"byteLength", rows * 16},
                                                 {"byteStride", 16},
                                                 {"extensions",
                                                  {{"EXT_meshopt_compression",
                                                    {{"buffer", 0},
                                                     {"byteLength", bytes},
                                                     {"byteStride", 16},
                                                     {"count", rows},
                                                     {"mode", "ATTRIBUTES"}}}}}});
        builder.addPrimitive({{"POSITION", addPlain(builder, i + 1, kFloat, "VEC3", rows)}});
    }
    Json json = builder.json();
    json["buffers"] = {
        {{"byteLength", bytes}, {"uri", encodeDataUri("application/octet-stream", builder.bytes())}},
        {{"byteLength", 50 * rows * 16}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    const std::string path = folder.write("model.gltf", json.dump());
    EXPECT_EQ(test::expectBounded(path, std::filesystem::file_size(path)), 4);
}

TEST(MemoryCeiling, HoldsForAnEmptyFallbackBuffer) {
    const TempFolder folder;
    Json json = {{"asset", {{"version", "2.0"}}}};
    json["buffers"] = {
        {{"byteLength", 4}, {"uri", "data:;base64,oKCgoA=="}},
        {{"byteLength", 60'000'000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    json["bufferViews"].push_back(
        {{"buffer", 1},
         {"byteLength", 16},
         {"extensions",
          {{"EXT_meshopt_compression",
            {{"buffer", 0}, {"byteLength", 4}, {"byteStride", 16}, {"count", 1}, {"mode", "ATTRIBUTES"}}}}}});
    const std::string path = folder.write("model.gltf", json.dump());
    EXPECT_EQ(test::expectBounded(path, std::filesystem::file_size(path)), 4);
}

TEST(MemoryCeiling, HoldsForDracoHeadersThatClaimMuch) {
    for (const std::size_t count : {100'000, 300'000, 4'000'000}) {
        for (const int method : {0, 1}) {
            const TempFolder folder;
            GltfBuilder builder;
            // The Draco header (name, version 2.2, mesh, method, flags) and two counts with seven bits per byte; then
            // invalid data.
            Bytes data = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, static_cast<std::uint8_t>(method), 0, 0};
            for (int i = 0; i < 2; ++i) {
                std::size_t rest = count / 2;
                for (; rest > 127; rest >>= 7) data.push_back(static_cast<std::uint8_t>(rest | 128));
                data.push_back(static_cast<std::uint8_t>(rest));
            }
            data.resize(2000, 0);
            const std::size_t view = builder.addView(data);
            const auto claim = [&](const char* type, int component, std::size_t elements) {
                builder.json()["accessors"].push_back(
                    {{"componentType", component}, {"count", elements}, {"type", type}});
                return builder.json()["accessors"].size() - 1;
            };
            Json& primitive = builder.addPrimitive({{"POSITION", claim("VEC3", kFloat, count / 2)}});
            primitive["indices"] = claim("SCALAR", kU32, count / 2 * 3);
            primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                     {"attributes", {{"POSITION", 0}}}};
            EXPECT_EQ(expectBounded(folder, builder), 4);
        }
    }
}

}  // namespace
}  // namespace tspace
