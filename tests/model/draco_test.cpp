// SPDX-License-Identifier: MIT
// Draco-compressed primitives: decoding, encoding without changing values, and rejected data.
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "compressed_model.h"
#include "gltf_builder.h"
#include "model/gltf/accessor.h"
#include "model/gltf/draco_primitives.h"
#include "model/gltf/load_document.h"
#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"
#include "model_files.h"

namespace tspace::gltf {
namespace {

using test::bytesOfValues;
using test::CompressedRun;
using test::errorOf;
using test::expectOrderWhateverByteIsChanged;
using test::generateAll;
using test::GltfBuilder;
using test::shared;

constexpr int kU16 = 5123, kFloat = 5126;

/// Returns a bumpy grid of 4 x 4 quads with a UV map that is mirrored at its middle column.
DracoMesh grid() {
    DracoMesh mesh;
    std::vector<float> positions, normals, uvs;
    for (std::size_t y = 0; y < 5; ++y) {
        for (std::size_t x = 0; x < 5; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            positions.insert(positions.end(), {fx / 3, fy / 7, std::sin(fx * fy)});
            const float length = std::sqrt(1 + 0.01f * fx * fx);
            normals.insert(normals.end(), {0.1f * fx / length, 0, 1 / length});
            uvs.insert(uvs.end(), {static_cast<float>(x > 2 ? 4 - x : x) / 3, (4 - fy) / 3});
            const auto a = static_cast<std::uint32_t>(y * 5 + x);
            if (x == 4 || y == 4) continue;
            mesh.corners.insert(mesh.corners.end(), {a, a + 1, a + 6, a, a + 6, a + 5});
        }
    }
    mesh.point_count = 25;
    const auto add = [&](DracoKind kind, std::size_t components, int bits, const std::vector<float>& values) {
        mesh.attributes.push_back({.kind = kind, .component_count = components, .values = bytesOfValues(values)});
        mesh.attributes.back().rounding.bits = bits;
    };
    add(DracoKind::position, 3, 11, positions);
    add(DracoKind::normal, 3, 8, normals);
    add(DracoKind::uv, 2, 10, uvs);
    return mesh;
}

/// Returns a model with the accessors 0 POSITION, 1 NORMAL, 2 TEXCOORD_0 and 3 indices, none of which has a view. The
/// compressed data is view 0.
GltfBuilder model(const DracoMesh& of) {
    DracoMesh mesh = of;
    Bytes data;
    EXPECT_TRUE(encodeDraco(mesh, false, data));
    GltfBuilder builder;
    builder.addView(data);
    Json& json = builder.json();
    for (const DracoAttribute& attribute : mesh.attributes) {
        json["accessors"].push_back({{"componentType", kFloat},
                                     {"count", mesh.point_count},
                                     {"type", "VEC" + std::to_string(attribute.component_count)}});
    }
    json["accessors"].push_back({{"componentType", kU16}, {"count", mesh.corners.size()}, {"type", "SCALAR"}});
    Json& primitive = builder.addPrimitive({{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}});
    primitive["indices"] = 3;
    primitive["extensions"][kDraco] = {{"bufferView", 0},
                                       {"attributes",
                                        {{"POSITION", mesh.attributes[0].id},
                                         {"NORMAL", mesh.attributes[1].id},
                                         {"TEXCOORD_0", mesh.attributes[2].id}}}};
    json["extensionsUsed"] = json["extensionsRequired"] = {kDraco};
    return builder;
}

Json& extension(GltfBuilder& builder) { return builder.json()["meshes"][0]["primitives"][0]["extensions"][kDraco]; }

Document load(const GltfBuilder& builder) { return parseDocument(builder.glb(), "model.glb", {}); }

Bytes elementsOf(const Document& document, std::size_t accessor) {
    return copyElements(document, readAccessor(document, accessor));
}

TEST(Draco, ReadsWhatTheLibraryReads) {
    TSPACE_NEEDS_SHARED("models");
    for (const char* file : {"assets/Sneaker_draco.glb", "derived/Suzanne_draco.glb", "features/DenseSphere.glb",
                             "features/BoxDraco/BoxDraco.gltf"}) {
        SCOPED_TRACE(file);
        const Document document = loadDocument(shared("models") / file, {});
        const Json& primitive = document.json["meshes"][0]["primitives"][0];
        const Json& packed = primitive["extensions"][kDraco];
        const BufferView view = readBufferView(document, packed["bufferView"].get<std::size_t>());
        const auto data = document.buffers[view.buffer].bytes.range(view.begin, view.byte_count);
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
        draco::Decoder decoder;
        const auto mesh = std::move(decoder.DecodeMeshFromBuffer(&buffer)).value();
        for (const auto& [name, id] : packed["attributes"].items()) {
            const draco::PointAttribute& attribute = *mesh->GetAttributeByUniqueId(id.get<std::uint32_t>());
            const Bytes ours = elementsOf(document, primitive["attributes"][name].get<std::size_t>());
            Bytes theirs;
            for (draco::PointIndex i(0); i < mesh->num_points(); ++i) {
                const std::uint8_t* value = attribute.GetAddressOfMappedIndex(i);
                theirs.insert(theirs.end(), value, value + attribute.byte_stride());
            }
            EXPECT_TRUE(ours == theirs) << name;
        }
        const std::vector<std::uint32_t> corners = decodeIndices(
            document, readAccessor(document, primitive["indices"].get<std::size_t>()), mesh->num_points(), "");
        ASSERT_EQ(corners.size(), std::size_t{mesh->num_faces()} * 3);
        for (std::size_t i = 0; i < corners.size(); ++i)
            ASSERT_EQ(corners[i], mesh->face(draco::FaceIndex(static_cast<std::uint32_t>(i / 3)))[i % 3].value());
    }
}

TEST(DracoKeep, ChangesNoValueAndNoRoundingOfWhatItEncodesAgain) {
    const CompressedRun outcome = generateAll(model(grid()).glb());
    EXPECT_GT(outcome.report.primitives.at(0).vertices_after, 25u) << "the middle column is split";
    const Json& packed = outcome.after.json["meshes"][0]["primitives"][0]["extensions"][kDraco];
    EXPECT_EQ(packed["attributes"].size(), 4u);
    const auto view = packed["bufferView"].get<std::size_t>();
    EXPECT_EQ(view, 0u) << "the entry is used again";
    const auto bits = [&](const char* name) {
        return outcome.after.draco_roundings.at({view, packed["attributes"][name].get<std::uint32_t>()}).bits;
    };
    EXPECT_EQ(bits("POSITION"), 11);
    EXPECT_EQ(bits("NORMAL"), 8);
    EXPECT_EQ(bits("TEXCOORD_0"), 10);
    EXPECT_EQ(bits("TANGENT"), 0) << "frames are stored exactly";
    EXPECT_EQ(outcome.after.json["bufferViews"].size(), 1u);
    for (const Json& accessor : outcome.after.json["accessors"]) EXPECT_FALSE(accessor.contains("bufferView"));
    EXPECT_LT(outcome.after.buffers[0].bytes.size(),
              outcome.after.json["bufferViews"][0]["byteLength"].get<std::size_t>() + 16)
        << "the old data are gone";
}

TEST(Draco, DecodesWhatItEncodesVeryWell) {
    // A flat grid with one normal. Compressed triangles would take so few bytes that decoders would reject them.
    constexpr std::uint32_t kSize = 100;
    DracoMesh mesh;
    std::vector<float> positions, normals;
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        positions.insert(positions.end(), {static_cast<float>(i % kSize), static_cast<float>(i / kSize), 0});
        normals.insert(normals.end(), {0, 0, 1});
        if (i % kSize == kSize - 1 || i / kSize == kSize - 1) continue;
        for (const std::uint32_t corner : {i, i + 1, i + kSize}) mesh.corners.push_back(corner);
    }
    mesh.point_count = kSize * kSize;
    mesh.attributes.push_back({.kind = DracoKind::position, .values = bytesOfValues(positions)});
    mesh.attributes.push_back({.kind = DracoKind::normal, .values = bytesOfValues(normals)});
    for (DracoAttribute& attribute : mesh.attributes) attribute.rounding.bits = 8;
    const std::vector<std::uint32_t> corners = mesh.corners;
    Bytes data;
    ASSERT_TRUE(encodeDraco(mesh, false, data));
    ASSERT_EQ(decodeDraco(data, {corners.size(), mesh.point_count, ~std::size_t{0}}, mesh), "");
    EXPECT_EQ(mesh.corners, corners);
}

TEST(DracoKeep, SharesTheDataOfPrimitivesThatShareTheirs) {
    GltfBuilder builder = model(grid());
    Json& primitives = builder.json()["meshes"][0]["primitives"];
    primitives.push_back(Json(primitives[0]));
    const CompressedRun outcome = generateAll(builder.glb());
    const Json& after = outcome.after.json["meshes"][0]["primitives"];
    EXPECT_EQ(after[0], after[1]);
    EXPECT_EQ(outcome.after.json["bufferViews"].size(), 1u);
}

TEST(DracoKeep, KeepsMorphTargetsOutsideTheData) {
    GltfBuilder builder = model(grid());
    std::vector<float> deltas;
    for (int i = 0; i < 75; ++i) deltas.push_back(static_cast<float>(i));
    const std::size_t target = builder.addFloats(deltas, 3);
    builder.json()["meshes"][0]["primitives"][0]["targets"] = Json::array({Json{{"POSITION", target}}});
    const CompressedRun outcome = generateAll(builder.glb());
    const Primitive primitive = readPrimitives(outcome.after).at(0);
    EXPECT_TRUE(readAccessor(outcome.after, primitive.targets.at(0).at(0).second).view.has_value());
}

/// Returns a model of two primitives that share their vertices. No triangle uses the last vertex, which target 0 moves
/// the farthest.
GltfBuilder sharedVertices() {
    GltfBuilder builder;
    builder.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 9, 9, 9}, 3);
    builder.json()["accessors"][0]["min"] = {0, 0, 0};
    builder.json()["accessors"][0]["max"] = {9, 9, 9};
    builder.addFloats({0, 0, 1, 0, 1, 1, 0, 1, 0, 0}, 2);
    const std::size_t target = builder.addFloats({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 7}, 3);
    builder.json()["accessors"][target]["min"] = {0, 0, 0};
    builder.json()["accessors"][target]["max"] = {0, 0, 7};
    for (const std::vector<std::uint16_t>& indices : {std::vector<std::uint16_t>{0, 1, 2}, {0, 2, 3}}) {
        Json& primitive = builder.addPrimitive({{"POSITION", 0}, {"TEXCOORD_0", 1}});
        primitive["targets"] = Json::array({Json{{"POSITION", target}}});
        primitive["indices"] = builder.addAccessor(indices, kU16, "SCALAR", 3);
    }
    return builder;
}

TEST(DracoPack, BoundsOfTargetsFollowTheVerticesThatStay) {
    const CompressedRun outcome = generateAll(sharedVertices().glb(), {.storage = {.compression = Compression::draco}});
    std::vector<double> highest;
    for (const Primitive& primitive : readPrimitives(outcome.after)) {
        const std::size_t target = *findAttribute(primitive.targets.at(0), "POSITION");
        highest.push_back(outcome.after.json["accessors"][target]["max"][2].get<double>());
    }
    EXPECT_EQ(highest, (std::vector<double>{1, 0})) << "nobody draws the vertex that moves by 7";
}

TEST(DracoPack, EncodesDisconnectedMeshesWithUnusedVertices) {
    GltfBuilder builder = sharedVertices();
    // With flat normals and a mirrored UV map, every corner needs a vertex of its own.
    builder.json()["meshes"][0]["primitives"].erase(0);
    Json& primitive = builder.json()["meshes"][0]["primitives"][0];
    primitive.erase("targets");
    builder.json()["accessors"][0]["count"] = 4;  // removes the last vertex, which no triangle uses
    builder.json()["accessors"][1]["count"] = 4;
    primitive["indices"] = builder.addAccessor(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 0}, kU16, "SCALAR", 6);
    const CompressedRun outcome = generateAll(builder.glb(), {.storage = {.compression = Compression::draco}});
    ASSERT_EQ(outcome.report.primitives.size(), 1u);
    EXPECT_EQ(outcome.report.primitives[0].vertices_after, 6u);
}

TEST(DracoKeep, SeparatesAccessorsThatSeveralCompressedPrimitivesShare) {
    DracoMesh other = grid();
    std::vector<float> moved(75);
    std::memcpy(moved.data(), other.attributes[0].values.data(), 300);
    for (float& value : moved) value += 1;
    other.attributes[0].values = bytesOfValues(moved);
    GltfBuilder builder = model(grid());
    Bytes data;
    ASSERT_TRUE(encodeDraco(other, false, data));
    Json second = builder.json()["meshes"][0]["primitives"][0];
    second["extensions"][kDraco]["bufferView"] = builder.addView(data);
    builder.json()["meshes"][0]["primitives"].push_back(second);
    const Document document = load(builder);
    const std::vector<Primitive> primitives = readPrimitives(document);
    const std::vector<Vec3> a = readVec3(document, primitives[0], "POSITION"),
                            b = readVec3(document, primitives[1], "POSITION");
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].x + 1, b[i].x, 0.01);
}

TEST(DracoKeep, UpdatesUncompressedFallbackData) {
    const DracoMesh mesh = grid();
    GltfBuilder builder = model(mesh);
    Json& accessors = builder.json()["accessors"];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t view = builder.addView(mesh.attributes[i].values);
        accessors[i]["bufferView"] = view;
    }
    const std::vector<std::uint16_t> indices(mesh.corners.begin(), mesh.corners.end());
    const std::size_t view = builder.addView(bytesOfValues(indices));
    accessors[3]["bufferView"] = view;
    builder.json().erase("extensionsRequired");
    const CompressedRun outcome = generateAll(builder.glb());
    EXPECT_TRUE(outcome.after.elements.empty()) << "plain data are there, so they are read";
    // The compressed data contains the same mesh as the uncompressed data, including tangents.
    const Json& primitive = outcome.after.json["meshes"][0]["primitives"][0];
    const Json& packed = primitive["extensions"][kDraco];
    const BufferView data = readBufferView(outcome.after, packed["bufferView"].get<std::size_t>());
    DracoMesh decoded;
    decoded.attributes.push_back({.id = packed["attributes"]["TANGENT"].get<std::uint32_t>(), .component_count = 4});
    decoded.attributes.push_back({.id = packed["attributes"]["POSITION"].get<std::uint32_t>()});
    const DracoLimits limits{.corner_count = 1000, .point_count = 100, .bytes = 100000};
    ASSERT_EQ(decodeDraco(outcome.after.buffers[data.buffer].bytes.range(data.begin, data.byte_count), limits, decoded),
              "");
    EXPECT_EQ(decoded.attributes[0].values,
              elementsOf(outcome.after, primitive["attributes"]["TANGENT"].get<std::size_t>()));
    EXPECT_EQ(decoded.attributes[1].values,
              elementsOf(outcome.after, primitive["attributes"]["POSITION"].get<std::size_t>()));
}

Error loadError(const GltfBuilder& builder) {
    return errorOf([&] { static_cast<void>(load(builder)); });
}

TEST(DracoHostile, NamesTheLocationOfEveryWrongMember) {
    const auto expectRefused = [](const char* what, const std::function<void(GltfBuilder&)>& spoil) {
        GltfBuilder builder = model(grid());
        spoil(builder);
        const Error error = loadError(builder);
        EXPECT_EQ(error.code, ErrorCode::invalidFile) << what << ": " << error.message;
        EXPECT_EQ(error.place.rfind("/meshes/0/primitives/0", 0), 0u) << what << ": " << error.place;
    };
    expectRefused("no view", [](GltfBuilder& b) { extension(b).erase("bufferView"); });
    expectRefused("view out of range", [](GltfBuilder& b) { extension(b)["bufferView"] = 1; });
    expectRefused("no attributes", [](GltfBuilder& b) { extension(b).erase("attributes"); });
    expectRefused("an id that is missing", [](GltfBuilder& b) { extension(b)["attributes"]["NORMAL"] = 77; });
    expectRefused("an id out of range", [](GltfBuilder& b) { extension(b)["attributes"]["NORMAL"] = 4294967296u; });
    expectRefused("another attribute's id", [](GltfBuilder& b) { extension(b)["attributes"]["NORMAL"] = 2; });
    expectRefused("fewer vertices", [](GltfBuilder& b) {
        for (int i = 0; i < 3; ++i) b.json()["accessors"][i]["count"] = 24;
    });
    expectRefused("fewer indices", [](GltfBuilder& b) { b.json()["accessors"][3]["count"] = 93; });
    expectRefused("four billion vertices", [](GltfBuilder& b) {
        for (int i = 0; i < 3; ++i) b.json()["accessors"][i]["count"] = 2'000'000'000u;
    });
    expectRefused("points", [](GltfBuilder& b) { b.json()["meshes"][0]["primitives"][0]["mode"] = 0; });
}

TEST(DracoHostile, RejectsTruncatedData) {
    const std::size_t length = model(grid()).json()["bufferViews"][0]["byteLength"].get<std::size_t>();
    for (std::size_t left = 0; left < length; ++left) {
        GltfBuilder builder = model(grid());
        builder.json()["bufferViews"][0]["byteLength"] = left;
        EXPECT_EQ(loadError(builder).code, ErrorCode::invalidFile) << left;
    }
}

TEST(DracoHostile, SurvivesEveryFlippedByte) { expectOrderWhateverByteIsChanged(model(grid())); }

TEST(DracoHostile, RejectsCountsInTheDataBeforeAllocating) {
    // The header, then the numbers of faces and points in the library's encoding, and nothing else.
    for (const std::uint8_t method : {std::uint8_t{0}, std::uint8_t{1}}) {
        Bytes data = {'D', 'R', 'A', 'C', 'O', 2, 2, 1, method, 0, 0};
        if (method == 1) data.push_back(0);  // type of the traversal
        for (int i = 0; i < 2; ++i) data.insert(data.end(), {0xff, 0xff, 0xff, 0xff, 0x0f});
        DracoMesh mesh;
        const std::string fault = decodeDraco(data, {.corner_count = 300, .point_count = 100, .bytes = 10000}, mesh);
        EXPECT_NE(fault.find("more points"), std::string::npos) << fault;
    }
}

}  // namespace
}  // namespace tspace::gltf
