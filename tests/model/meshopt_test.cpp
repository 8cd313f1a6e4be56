// SPDX-License-Identifier: MIT
// Meshopt-compressed buffer views: decoding, encoding, data that must not change, and rejected data.
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "compressed_model.h"
#include "gltf_builder.h"
#include "model/gltf/accessor.h"
#include "model/gltf/container.h"
#include "model/gltf/load_document.h"
#include "model/gltf/meshopt_views.h"
#include "model/gltf/primitive_reader.h"
#include "model/read/read_scene.h"

namespace tspace::gltf {
namespace {

using test::bytesOfValues;
using test::CompressedRun;
using test::errorOf;
using test::expectOrderWhateverByteIsChanged;
using test::generateAll;
using test::GltfBuilder;
using test::TempFolder;

constexpr int kI8 = 5120, kU16 = 5123, kFloat = 5126;

void encodeExponential(Bytes& rows, std::size_t count, std::size_t stride, int bits, const std::vector<float>& values) {
#if MESHOPTIMIZER_VERSION >= 200
    meshopt_encodeFilterExp(rows.data(), count, stride, bits, values.data(), meshopt_EncodeExpSharedVector);
#else
    meshopt_encodeFilterExp(rows.data(), count, stride, bits, values.data());
#endif
}

/// A model whose views are all compressed, with a fallback buffer that has no data.
class PackedModel {
  public:
    explicit PackedModel(const char* extension = kExtMeshopt) : extension_(extension) {
        Json& json = builder_.json();
        json["buffers"] = Json::array({Json::object(), Json::object()});
        json["extensionsUsed"] = json["extensionsRequired"] = {extension_};
        builder_.addView(Bytes(4, 0));  // comes first and is not compressed, so that no offset is 0
    }

    /// Adds a compressed view and returns its index. `rows`: the data before the filter is applied.
    std::size_t addView(MeshoptCoding coding, const Bytes& rows, const char* mode, const char* filter = nullptr) {
        coding.stride = rows.size() / coding.count;
        coding.is_khr = extension_ == kKhrMeshopt;
        Bytes data;
        EXPECT_TRUE(encodeMeshopt(coding, rows, data));
        const std::size_t view = builder_.addView(data);
        Json& object = builder_.json()["bufferViews"][view];
        Json extension = object;
        extension["count"] = coding.count;
        extension["byteStride"] = coding.stride;
        extension["mode"] = mode;
        if (filter != nullptr) extension["filter"] = filter;
        object["buffer"] = 1;
        object["byteOffset"] = fallback_bytes_;
        object["byteLength"] = rows.size();
        if (coding.mode == MeshoptMode::attributes) object["byteStride"] = coding.stride;
        object["extensions"][extension_] = extension;
        fallback_bytes_ += (rows.size() + 3) / 4 * 4;
        return view;
    }
    std::size_t addAccessor(std::size_t view, int component, const char* type, std::size_t count,
                            bool normalized = false) {
        Json accessor = {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
        if (normalized) accessor["normalized"] = true;
        builder_.json()["accessors"].push_back(accessor);
        return builder_.json()["accessors"].size() - 1;
    }

    Json& json() { return builder_.json(); }
    Json& extension(std::size_t view) { return json()["bufferViews"][view]["extensions"][extension_]; }
    Bytes& bytes() { return builder_.bytes(); }

    [[nodiscard]] Bytes glb() const {
        Json json = GltfBuilder(builder_).json();
        json["buffers"] =
            Json::array({Json{{"byteLength", GltfBuilder(builder_).bytes().size()}},
                         Json{{"byteLength", fallback_bytes_}, {"extensions", {{extension_, {{"fallback", true}}}}}}});
        const Bytes bin = GltfBuilder(builder_).bytes();
        const GlbFrame frame = frameGlb(json.dump(), bin.size(), {});
        Bytes file = frame.head;
        file.insert(file.end(), bin.begin(), bin.end());
        file.insert(file.end(), frame.tail.begin(), frame.tail.end());
        return file;
    }
    void setFallbackBytes(std::size_t count) { fallback_bytes_ = count; }
    [[nodiscard]] Document load() const { return parseDocument(glb(), "model.glb", {}); }

  private:
    std::string extension_;
    GltfBuilder builder_;
    std::size_t fallback_bytes_ = 0;
};

Bytes viewBytes(const Document& document, std::size_t view) {
    const BufferView range = readBufferView(document, view);
    const auto bytes = document.buffers[range.buffer].bytes.range(range.begin, range.byte_count);
    return Bytes(bytes.begin(), bytes.end());
}

Bytes randomBytes(std::size_t count, unsigned seed) {
    Bytes bytes(count);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>((seed = seed * 1664525u + 1013904223u) >> 24);
    return bytes;
}

RC_GTEST_PROP(Meshopt, ReadsAttributesAsTheyWereEncoded, ()) {
    const auto count = *rc::gen::inRange<std::size_t>(1, 600);
    const auto stride = 4 * *rc::gen::inRange<std::size_t>(1, 65);
    const Bytes rows = randomBytes(count * stride, static_cast<unsigned>(count));
    PackedModel model;
    const std::size_t view = model.addView({.count = count}, rows, "ATTRIBUTES");
    RC_ASSERT(viewBytes(model.load(), view) == rows);
}

RC_GTEST_PROP(Meshopt, ReadsRowsOfIndicesAsTheyWereEncoded, (std::vector<std::uint16_t> indices)) {
    RC_PRE(!indices.empty());
    PackedModel model;
    const Bytes rows = bytesOfValues(indices);
    const std::size_t view = model.addView({.mode = MeshoptMode::indices, .count = indices.size()}, rows, "INDICES");
    RC_ASSERT(viewBytes(model.load(), view) == rows);
}

TEST(Meshopt, ReadsTriangles) {
    // A fan of triangles, each of which shares an edge with the previous one. The codec does not rotate their corners.
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 40; ++i) {
        const std::vector<std::uint32_t> fan = {0, i + 1, i + 2};
        indices.insert(indices.end(), fan.begin(), fan.end());
    }
    MeshoptCoding coding{.mode = MeshoptMode::triangles, .count = indices.size(), .stride = 4};
    Bytes data;
    ASSERT_TRUE(encodeMeshopt(coding, bytesOfValues(indices), data));
    ASSERT_EQ(coding.mode, MeshoptMode::triangles);
    PackedModel model;
    const std::size_t view =
        model.addView({.mode = MeshoptMode::triangles, .count = indices.size()}, bytesOfValues(indices), "TRIANGLES");
    EXPECT_EQ(viewBytes(model.load(), view), bytesOfValues(indices));
}

RC_GTEST_PROP(Meshopt, EncodesTrianglesSoThatNoCornerTurns, (std::vector<std::uint8_t> random)) {
    std::vector<std::uint16_t> indices(random.begin(), random.end());
    indices.resize(indices.size() / 3 * 3);
    RC_PRE(!indices.empty());
    MeshoptCoding coding{.mode = MeshoptMode::triangles, .count = indices.size(), .stride = 2};
    const Bytes rows = bytesOfValues(indices);
    Bytes data, decoded(rows.size());
    RC_ASSERT(encodeMeshopt(coding, rows, data));
    RC_ASSERT(decodeMeshopt(coding, data, decoded));
    RC_ASSERT(decoded == rows);
}

/// Returns `count` unit vectors or quaternions, with four floats each.
std::vector<float> directions(std::size_t count) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = static_cast<float>(i), b = 0.3f * a;
        values.insert(values.end(), {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b), 0});
    }
    return values;
}

TEST(Meshopt, AppliesTheOctahedralFilter) {
    constexpr std::size_t kCount = 37;
    const std::vector<float> expected = directions(kCount);
    for (const std::size_t stride : {4, 8}) {
        Bytes rows(kCount * stride);
        meshopt_encodeFilterOct(rows.data(), kCount, stride, stride == 4 ? 8 : 16, expected.data());
        PackedModel model;
        const std::size_t view = model.addView({.count = kCount}, rows, "ATTRIBUTES", "OCTAHEDRAL");
        const std::size_t accessor = model.addAccessor(view, stride == 4 ? kI8 : 5122, "VEC3", kCount, true);
        const Document document = model.load();
        const std::vector<Vec3> decoded = decodeVec3(document, readAccessor(document, accessor), "");
        for (std::size_t i = 0; i < kCount; ++i) {
            EXPECT_NEAR(decoded[i].x, expected[i * 4], stride == 4 ? 0.02 : 0.0001);
            EXPECT_NEAR(decoded[i].y, expected[i * 4 + 1], stride == 4 ? 0.02 : 0.0001);
            EXPECT_NEAR(decoded[i].z, expected[i * 4 + 2], stride == 4 ? 0.02 : 0.0001);
        }
    }
}

TEST(Meshopt, AppliesTheQuaternionFilter) {
    constexpr std::size_t kCount = 37;
    const std::vector<float> expected = directions(kCount);
    Bytes rows(kCount * 8);
    meshopt_encodeFilterQuat(rows.data(), kCount, 8, 16, expected.data());
    PackedModel model;
    const std::size_t view = model.addView({.count = kCount}, rows, "ATTRIBUTES", "QUATERNION");
    const std::size_t accessor = model.addAccessor(view, 5122, "VEC4", kCount, true);
    const Document document = model.load();
    const std::vector<Vec4> decoded = decodeVec4(document, readAccessor(document, accessor), "");
    for (std::size_t i = 0; i < kCount; ++i) {
        // A quaternion and its negative are the same rotation.
        const double dot = decoded[i].x * expected[i * 4] + decoded[i].y * expected[i * 4 + 1] +
                           decoded[i].z * expected[i * 4 + 2] + decoded[i].w * expected[i * 4 + 3];
        EXPECT_NEAR(std::abs(dot), 1, 0.001);
    }
}

TEST(Meshopt, AppliesTheExponentialFilter) {
    constexpr std::size_t kCount = 37;
    std::vector<float> expected;
    for (std::size_t i = 0; i < kCount * 3; ++i) expected.push_back(static_cast<float>(i) * 0.75f - 20);
    Bytes rows(kCount * 12);
    encodeExponential(rows, kCount, 12, 20, expected);
    PackedModel model;
    const std::size_t view = model.addView({.count = kCount}, rows, "ATTRIBUTES", "EXPONENTIAL");
    const std::size_t accessor = model.addAccessor(view, kFloat, "VEC3", kCount);
    const Document document = model.load();
    const std::vector<Vec3> decoded = decodeVec3(document, readAccessor(document, accessor), "");
    for (std::size_t i = 0; i < kCount; ++i) EXPECT_NEAR(decoded[i].y, expected[i * 3 + 1], 0.001);
}

/// Returns a grid of 4 x 4 quads with a UV map that is mirrored at the middle column, whose 5 vertices are therefore
/// split. Normals are stored with the octahedral filter, and positions with the exponential one. Accessors: POSITION 0,
/// NORMAL 1, TEXCOORD_0 2, indices 3.
PackedModel packedGrid(const char* extension = kExtMeshopt) {
    constexpr std::size_t kCount = 25;
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint16_t> indices;
    for (std::size_t y = 0; y < 5; ++y) {
        for (std::size_t x = 0; x < 5; ++x) {
            positions.insert(positions.end(),
                             {static_cast<float>(x), static_cast<float>(y), 0.1f * static_cast<float>(x * y)});
            normals.insert(normals.end(), {0, 0, 1, 0});
            uvs.insert(uvs.end(), {static_cast<float>(x > 2 ? 4 - x : x), static_cast<float>(4 - y)});
            const std::size_t a = y * 5 + x;
            if (x == 4 || y == 4) continue;
            for (const std::size_t i : {a, a + 1, a + 6, a, a + 6, a + 5})
                indices.push_back(static_cast<std::uint16_t>(i));
        }
    }
    PackedModel model(extension);
    Bytes rows(kCount * 12);
    encodeExponential(rows, kCount, 12, 16, positions);
    model.addAccessor(model.addView({.count = kCount}, rows, "ATTRIBUTES", "EXPONENTIAL"), kFloat, "VEC3", kCount);
    rows.resize(kCount * 4);
    meshopt_encodeFilterOct(rows.data(), kCount, 4, 8, normals.data());
    model.addAccessor(model.addView({.count = kCount}, rows, "ATTRIBUTES", "OCTAHEDRAL"), kI8, "VEC3", kCount, true);
    model.addAccessor(model.addView({.count = kCount}, bytesOfValues(uvs), "ATTRIBUTES"), kFloat, "VEC2", kCount);
    model.addAccessor(
        model.addView({.mode = MeshoptMode::indices, .count = indices.size()}, bytesOfValues(indices), "INDICES"), kU16,
        "SCALAR", indices.size());
    model.json()["meshes"] =
        Json::parse(R"([{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3}]}])");
    return model;
}

TEST(MeshoptKeep, EncodesSplitVerticesWithTheirFilter) {
    const CompressedRun outcome = generateAll(packedGrid().glb());
    EXPECT_EQ(outcome.report.primitives.at(0).vertices_after, 30u);
    const Primitive primitive = readPrimitives(outcome.after).at(0);
    const auto filter = [&](const char* name) {
        const Accessor accessor = readAccessor(outcome.after, *primitive.find(name));
        EXPECT_TRUE(readMeshoptView(outcome.after, *accessor.view)) << name;
        return filterOf(outcome.after, accessor);
    };
    EXPECT_EQ(filter("POSITION"), MeshoptFilter::exponential);
    EXPECT_EQ(filter("NORMAL"), MeshoptFilter::octahedral);
    EXPECT_EQ(filter("TEXCOORD_0"), MeshoptFilter::none);
    EXPECT_EQ(filter("TANGENT"), MeshoptFilter::none);
    EXPECT_EQ(outcome.after.buffers.size(), 2u);
    EXPECT_EQ(outcome.after.buffers[1].source, BufferSource::decoded) << "no plain copy is written";
    for (const Json& view : outcome.after.json["bufferViews"])
        EXPECT_TRUE(!view.contains("target") || meshoptExtension(view) != nullptr);
}

TEST(MeshoptPack, LeavesNoBufferEmpty) {
    const test::TempFolder folder;
    // Buffer 1 contains the compressed data of all of buffer 0.
    Json json = Json::parse(R"({"asset":{"version":"2.0"},
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,0]},
                     {"bufferView":1,"componentType":5123,"type":"SCALAR","count":3}],
        "bufferViews":[{"buffer":0,"byteLength":36,"target":34962},{"buffer":1,"byteLength":6,"target":34963}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})");
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0};
    const std::vector<std::uint16_t> indices = {0, 1, 2, 0};
    json["buffers"] = Json::array(
        {Json{{"byteLength", 36}, {"uri", encodeDataUri("application/octet-stream", bytesOfValues(positions))}},
         Json{{"byteLength", 8}, {"uri", encodeDataUri("application/octet-stream", bytesOfValues(indices))}}});
    const std::string output = folder.path("out.gltf").string();
    ASSERT_TRUE(
        generateFile(folder.write("in.gltf", json.dump()), output, {.storage = {.compression = Compression::meshopt}}));
    const Document document = loadDocument(output, {});
    for (const Json& buffer : document.json["buffers"]) EXPECT_GT(buffer["byteLength"], 0u) << buffer.dump();
    EXPECT_EQ(decodeVec3(document, readAccessor(document, 0), "")[2], (Vec3{1, 1, 0}));
}

TEST(MeshoptKeep, KeepsCompressedBytesOfUnchangedViews) {
    PackedModel model = packedGrid();
    // These UVs are not mirrored, so nothing is split, and only tangents are new.
    std::vector<float> uvs;
    for (std::size_t i = 0; i < 25; ++i)
        uvs.insert(uvs.end(), {static_cast<float>(i % 5), static_cast<float>(4 - i / 5)});
    model.json()["accessors"][2]["bufferView"] = model.addView({.count = 25}, bytesOfValues(uvs), "ATTRIBUTES");
    const CompressedRun outcome = generateAll(model.glb());
    ASSERT_EQ(outcome.report.primitives.at(0).vertices_after, 25u);
    for (std::size_t i = 1; i < outcome.before.json["bufferViews"].size(); ++i) {
        const MeshoptView a = *readMeshoptView(outcome.before, i), b = *readMeshoptView(outcome.after, i);
        const auto before = outcome.before.buffers[a.buffer].bytes.range(a.begin, a.byte_count);
        const auto after = outcome.after.buffers[b.buffer].bytes.range(b.begin, b.byte_count);
        EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin(), after.end())) << i;
    }
}

TEST(MeshoptKeep, MovesBetweenContainers) {
    const CompressedRun outcome = generateAll(packedGrid().glb(), {}, "out.gltf");
    EXPECT_EQ(outcome.after.buffers[1].source, BufferSource::decoded);
    EXPECT_FALSE(outcome.after.json["buffers"][1].contains("uri"));
}

TEST(MeshoptKeep, UpdatesBothUncompressedAndCompressedData) {
    // The fallback buffer becomes part of BIN.
    PackedModel model = packedGrid();
    const Document packed = model.load();
    const Bytes plain = packed.buffers[1].bytes.joined();
    Json& views = model.json()["bufferViews"];
    for (std::size_t i = 1; i < views.size(); ++i) {
        const BufferView range = readBufferView(packed, i);
        while (model.bytes().size() % 4 != 0) model.bytes().push_back(0);
        views[i]["buffer"] = 0;
        views[i]["byteOffset"] = model.bytes().size();
        model.bytes().insert(model.bytes().end(), plain.begin() + static_cast<std::ptrdiff_t>(range.begin),
                             plain.begin() + static_cast<std::ptrdiff_t>(range.begin + range.byte_count));
    }
    model.json().erase("extensionsRequired");
    const CompressedRun outcome = generateAll(model.glb());
    const Primitive primitive = readPrimitives(outcome.after).at(0);
    for (const auto& [name, index] : primitive.attributes) {
        const std::size_t view = *readAccessor(outcome.after, index).view;
        ASSERT_EQ(readBufferView(outcome.after, view).buffer, 0u) << "plain data are still there";
        const MeshoptView again = *readMeshoptView(outcome.after, view);
        Bytes decoded(again.coding.byteCount());
        ASSERT_TRUE(
            decodeMeshopt(again.coding, outcome.after.buffers[0].bytes.range(again.begin, again.byte_count), decoded));
        EXPECT_EQ(decoded, viewBytes(outcome.after, view)) << name;
    }
}

TEST(MeshoptKeep, LeavesNoOldCompressedBytesBehind) {
    const CompressedRun outcome = generateAll(packedGrid().glb());
    std::size_t compressed = 4;  // 4 bytes of the uncompressed view at the start
    for (std::size_t i = 1; i < outcome.after.json["bufferViews"].size(); ++i)
        compressed += readMeshoptView(outcome.after, i)->byte_count;
    EXPECT_LT(outcome.after.buffers[0].bytes.size(), compressed + 16 * 6) << "a little stays at each cut";
}

#if MESHOPTIMIZER_VERSION >= 1000

TEST(MeshoptKhr, IsReadAndKept) {
    const CompressedRun outcome = generateAll(packedGrid(kKhrMeshopt).glb());
    const Primitive primitive = readPrimitives(outcome.after).at(0);
    for (const auto& [name, index] : primitive.attributes) {
        const auto view = readMeshoptView(outcome.after, *readAccessor(outcome.after, index).view);
        ASSERT_TRUE(view) << name;
        EXPECT_TRUE(view->coding.is_khr) << name;
    }
    EXPECT_EQ(outcome.after.json["extensionsRequired"], Json{kKhrMeshopt});
}

TEST(MeshoptKhr, AppliesTheColorFilter) {
    constexpr std::size_t kCount = 37;
    std::vector<float> expected;
    for (std::size_t i = 0; i < kCount * 4; ++i) expected.push_back(static_cast<float>(i * 7 % 256) / 255);
    Bytes rows(kCount * 8);
    meshopt_encodeFilterColor(rows.data(), kCount, 8, 16, expected.data());
    PackedModel model(kKhrMeshopt);
    const std::size_t view = model.addView({.count = kCount}, rows, "ATTRIBUTES", "COLOR");
    const std::size_t accessor = model.addAccessor(view, kU16, "VEC4", kCount, true);
    const Document document = model.load();
    const std::vector<Vec4> decoded = decodeVec4(document, readAccessor(document, accessor), "");
    for (std::size_t i = 0; i < kCount; ++i) {
        EXPECT_NEAR(decoded[i].x, expected[i * 4], 0.001);
        EXPECT_NEAR(decoded[i].w, expected[i * 4 + 3], 0.001);
    }
}

#else

TEST(MeshoptKhr, IsRejectedWithTheInstalledAndTheRequiredVersion) {
    const TempFolder folder;
    const std::string input = folder.write("in.glb", packedGrid(kKhrMeshopt).glb());
    const auto report = generateFile(input, folder.path("out.glb").string(), {.selection = {.all = true}});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::unsupportedFile);
    EXPECT_NE(report.error().message.find(kKhrMeshopt), std::string::npos) << report.error().message;
    EXPECT_NE(report.error().message.find("needs version 1.0 or later"), std::string::npos) << report.error().message;
}

#endif

Error loadError(const PackedModel& model) {
    return errorOf([&] { static_cast<void>(model.load()); });
}

TEST(MeshoptHostile, NamesTheLocationOfEveryWrongMember) {
    const auto expectRefused = [](const char* member, const Json& value) {
        PackedModel model = packedGrid();
        model.extension(1)[member] = value;
        const Error error = loadError(model);
        EXPECT_EQ(error.code, ErrorCode::invalidFile) << member << " " << value << ": " << error.message;
        EXPECT_EQ(error.place.rfind("/bufferViews/1/extensions/EXT_meshopt_compression", 0), 0u) << error.place;
    };
    expectRefused("buffer", 2);
    expectRefused("buffer", 1);  // the fallback buffer itself, which has no data
    expectRefused("buffer", "0");
    expectRefused("byteOffset", 1000000);
    expectRefused("byteLength", 1000000);
    expectRefused("byteLength", 0);
    expectRefused("byteLength", 18446744073709551615ull);
    expectRefused("byteStride", 0);
    expectRefused("byteStride", 2);
    expectRefused("byteStride", 260);
    expectRefused("byteStride", 18446744073709551612ull);
    expectRefused("count", 0);
    expectRefused("count", 24);
    expectRefused("count", 4294967295u);
    expectRefused("count", 1537228672809129302ull);  // 12 times this number exceeds 2^64
    expectRefused("mode", "TRIANGLES");
    expectRefused("mode", "VERTICES");
    expectRefused("mode", 3);
    expectRefused("filter", "QUATERNION");
    expectRefused("filter", "COLOR");
    expectRefused("filter", "SHARPEN");
}

TEST(MeshoptHostile, RejectsAFallbackBufferFarLargerThanItsViews) {
    PackedModel model = packedGrid();
    model.setFallbackBytes(4'000'000'000u);
    const Error error = loadError(model);
    EXPECT_EQ(error.code, ErrorCode::invalidFile);
    EXPECT_EQ(error.place, "/buffers/1/byteLength");
}

TEST(MeshoptHostile, RejectsViewsThatTogetherDeclareTooMuch) {
    // Each view is valid by itself, but all of them refer to the same few bytes.
    PackedModel model;
    const std::size_t view = model.addView({.count = 25600}, Bytes(25600 * 4, 7), "ATTRIBUTES");
    for (int i = 0; i < 200; ++i) model.json()["bufferViews"].push_back(Json(model.json()["bufferViews"][view]));
    const Error error = loadError(model);
    EXPECT_EQ(error.code, ErrorCode::invalidFile);
    EXPECT_NE(error.message.find("more data than the file can contain"), std::string::npos) << error.message;
}

TEST(MeshoptHostile, RejectsTruncatedData) {
    for (std::size_t view = 1; view < 5; ++view) {
        PackedModel model = packedGrid();
        model.extension(view)["byteLength"] = model.extension(view)["byteLength"].get<std::size_t>() - 1;
        EXPECT_EQ(loadError(model).code, ErrorCode::invalidFile) << view;
    }
}

TEST(MeshoptHostile, SurvivesEveryFlippedByte) { expectOrderWhateverByteIsChanged(packedGrid()); }

}  // namespace
}  // namespace tspace::gltf
