// SPDX-License-Identifier: MIT
// Decoding of accessors: all component types, layouts, sparse parts, and limits.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "gltf_builder.h"
#include "model/gltf/accessor.h"
#include "model/gltf/load_document.h"
#include "model/gltf/references.h"

namespace tspace::gltf {
namespace {

using test::bytesOfValues;
using test::errorOf;
using test::GltfBuilder;
using test::parse;

struct TypeCase {
    int component_type;
    Bytes bytes;  // one element with 3 components
    Vec3 plain, normalized;
    const char* name;
};

std::vector<TypeCase> typeCases() {
    return {
        {5120, bytesOfValues<std::int8_t>({-128, 127, -64}), {-128, 127, -64}, {-1, 1, -64 / 127.0f}, "snorm8x3"},
        {5121, bytesOfValues<std::uint8_t>({0, 255, 51}), {0, 255, 51}, {0, 1, 0.2f}, "unorm8x3"},
        {5122, bytesOfValues<std::int16_t>({-32768, 32767, 1}), {-32768, 32767, 1}, {-1, 1, 1 / 32767.0f}, "snorm16x3"},
        {5123, bytesOfValues<std::uint16_t>({0, 65535, 13107}), {0, 65535, 13107}, {0, 1, 0.2f}, "unorm16x3"},
        {5126, bytesOfValues<float>({-1.5f, 1e30f, 0}), {-1.5f, 1e30f, 0}, {-1.5f, 1e30f, 0}, "float3"},
    };
}

TEST(Accessor, DecodesEveryComponentType) {
    for (const TypeCase& test : typeCases()) {
        for (const bool normalized : {false, true}) {
            GltfBuilder builder;
            builder.addView(test.bytes);
            builder.json()["accessors"].push_back({{"bufferView", 0},
                                                   {"componentType", test.component_type},
                                                   {"normalized", normalized},
                                                   {"count", 1},
                                                   {"type", "VEC3"}});
            const Document document = parse(builder);
            const Accessor accessor = readAccessor(document, 0);
            const std::vector<Vec3> values = decodeVec3(document, accessor, "");
            ASSERT_EQ(values.size(), 1u);
            EXPECT_EQ(values[0], normalized ? test.normalized : test.plain) << test.component_type;
            if (normalized) {
                EXPECT_EQ(formatName(accessor), test.name);
            }
            EXPECT_EQ(copyElements(document, accessor), test.bytes);
        }
    }
}

TEST(Accessor, ReadsInterleavedElements) {
    GltfBuilder builder;
    builder.addView(bytesOfValues<float>({0, 1, 10, 2, 3, 11, 4, 5, 12}));
    builder.json()["bufferViews"][0]["byteStride"] = 12;
    builder.json()["accessors"].push_back({{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
    builder.json()["accessors"].push_back(
        {{"bufferView", 0}, {"byteOffset", 8}, {"componentType", 5126}, {"count", 3}, {"type", "SCALAR"}});
    const Document document = parse(builder);
    EXPECT_EQ(decodeVec2(document, readAccessor(document, 0), ""), (std::vector<Vec2>{{0, 1}, {2, 3}, {4, 5}}));
    EXPECT_EQ(copyElements(document, readAccessor(document, 1)), bytesOfValues<float>({10, 11, 12}));
}

TEST(Accessor, PadsColumnsOfSmallMatrices) {
    const struct {
        const char* type;
        int component_type;
        std::size_t bytes;
    } cases[] = {{"MAT2", 5121, 8}, {"MAT3", 5121, 12}, {"MAT3", 5123, 24}, {"MAT4", 5126, 64}, {"MAT2", 5123, 8}};
    for (const auto& test : cases) {
        GltfBuilder builder;
        builder.addView(Bytes(test.bytes, 0));
        builder.json()["accessors"].push_back(
            {{"bufferView", 0}, {"componentType", test.component_type}, {"count", 1}, {"type", test.type}});
        EXPECT_EQ(readAccessor(parse(builder), 0).element_bytes, test.bytes) << test.type;
    }
}

GltfBuilder sparseBuilder(bool with_view) {
    GltfBuilder builder;
    builder.addView(bytesOfValues<std::uint16_t>({1, 3}));
    builder.addView(bytesOfValues<float>({7, 8, 9, 10}));
    builder.addView(bytesOfValues<float>({0, 1, 2, 3, 4, 5, 6, 7}));
    Json accessor = Json::parse(R"({"componentType":5126,"count":4,"type":"VEC2","sparse":{"count":2,
        "indices":{"bufferView":0,"componentType":5123},"values":{"bufferView":1}}})");
    if (with_view) accessor["bufferView"] = 2;
    builder.json()["accessors"].push_back(accessor);
    return builder;
}

TEST(Accessor, AppliesSparseValues) {
    const Document plain = parse(sparseBuilder(false)), based = parse(sparseBuilder(true));
    EXPECT_EQ(decodeVec2(plain, readAccessor(plain, 0), ""), (std::vector<Vec2>{{0, 0}, {7, 8}, {0, 0}, {9, 10}}));
    EXPECT_EQ(decodeVec2(based, readAccessor(based, 0), ""), (std::vector<Vec2>{{0, 1}, {7, 8}, {4, 5}, {9, 10}}));
}

TEST(Accessor, RejectsSparseDefects) {
    const auto place = [](const std::function<void(Json&)>& change) {
        GltfBuilder builder = sparseBuilder(true);
        change(builder.json()["accessors"][0]["sparse"]);
        return errorOf([&] {
                   const Document document = parse(builder);
                   copyElements(document, readAccessor(document, 0));
               })
            .place;
    };
    EXPECT_EQ(place([](Json& sparse) { sparse["count"] = 5; }), "/accessors/0/sparse/count");
    EXPECT_EQ(place([](Json& sparse) { sparse["count"] = 3; }), "/accessors/0/sparse/indices");
    EXPECT_EQ(place([](Json& sparse) { sparse["indices"]["bufferView"] = 9; }),
              "/accessors/0/sparse/indices/bufferView");
    EXPECT_EQ(place([](Json& sparse) { sparse["indices"]["componentType"] = 5122; }),
              "/accessors/0/sparse/indices/componentType");
    EXPECT_EQ(place([](Json& sparse) { sparse["values"]["byteOffset"] = 4; }), "/accessors/0/sparse/values");
    EXPECT_EQ(place([](Json& sparse) { sparse["indices"]["bufferView"] = 1; }), "/accessors/0/sparse/indices");
    EXPECT_EQ(place([](Json& sparse) { sparse.erase("values"); }), "/accessors/0/sparse");
    EXPECT_EQ(place([](Json& sparse) { sparse = 3; }), "/accessors/0/sparse");
}

TEST(Accessor, StaysInsideItsView) {
    const auto code = [](std::size_t offset, std::size_t count, std::size_t stride) {
        GltfBuilder builder;
        builder.addView(Bytes(48, 0));
        if (stride != 0) builder.json()["bufferViews"][0]["byteStride"] = stride;
        builder.json()["accessors"].push_back(
            {{"bufferView", 0}, {"byteOffset", offset}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
        return errorOf([&] { parse(builder); }).code;
    };
    EXPECT_EQ(code(0, 4, 0), ErrorCode::ok);
    EXPECT_EQ(code(0, 5, 0), ErrorCode::invalidFile);
    EXPECT_EQ(code(36, 1, 0), ErrorCode::ok);
    EXPECT_EQ(code(40, 1, 0), ErrorCode::invalidFile);
    EXPECT_EQ(code(0, 3, 16), ErrorCode::ok);
    EXPECT_EQ(code(8, 3, 16), ErrorCode::invalidFile);
    EXPECT_EQ(code(0, 2, 8), ErrorCode::invalidFile);
    EXPECT_EQ(code(std::numeric_limits<std::size_t>::max(), 1, 0), ErrorCode::invalidFile);
    EXPECT_EQ(code(0, 0x7fffffff, 0), ErrorCode::invalidFile);
    EXPECT_EQ(code(0, 2, std::numeric_limits<std::size_t>::max()), ErrorCode::invalidFile);
}

TEST(Accessor, RejectsFourBillionVerticesBeforeAllocating) {
    GltfBuilder builder;
    builder.json()["accessors"].push_back({{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}});
    EXPECT_EQ(errorOf([&] { parse(builder); }).code, ErrorCode::unsupportedFile);
    builder.json()["accessors"][0]["count"] = 2000000000u;
    const Document document = parse(builder);
    EXPECT_EQ(errorOf([&] { copyElements(document, readAccessor(document, 0)); }).code, ErrorCode::unsupportedFile);
}

TEST(Accessor, ChecksEveryIndex) {
    const auto decode = [](const GltfBuilder& builder, std::size_t vertex_count) {
        const Document document = parse(builder);
        return decodeIndices(document, readAccessor(document, 0), vertex_count, "/indices");
    };
    GltfBuilder bytes, shorts, words, floats;
    bytes.addAccessor<std::uint8_t>({0, 255}, 5121, "SCALAR", 2);
    shorts.addAccessor<std::uint16_t>({0, 65535}, 5123, "SCALAR", 2);
    words.addAccessor<std::uint32_t>({0, 4294967295u}, 5125, "SCALAR", 2);
    floats.addAccessor<float>({0, 1}, 5126, "SCALAR", 2);
    EXPECT_EQ(decode(bytes, 256), (std::vector<std::uint32_t>{0, 255}));
    EXPECT_EQ(errorOf([&] { decode(bytes, 255); }).place, "/indices");
    EXPECT_EQ(errorOf([&] { decode(shorts, 65535); }).place, "/indices");
    EXPECT_EQ(errorOf([&] { decode(words, 4294967295u); }).place, "/indices");
    EXPECT_EQ(errorOf([&] { decode(floats, 9); }).code, ErrorCode::invalidFile);
}

TEST(Accessor, RejectsAnAttributeWithAWrongComponentCount) {
    GltfBuilder builder;
    builder.addFloats({1, 2, 3, 4}, 4);
    const Document document = parse(builder);
    EXPECT_EQ(errorOf([&] { decodeVec3(document, readAccessor(document, 0), "/here"); }).place, "/here");
}

TEST(Accessor, NeedsNoPaddingAfterTheLastColumnOfMatrices) {
    // A MAT3 of bytes has columns of 3 bytes, each of which starts at a multiple of 4 bytes.
    const std::vector<std::uint8_t> two = {1,  2,  3,  0, 4,  5,  6,  0, 7,  8,  9, 0,
                                           11, 12, 13, 0, 14, 15, 16, 0, 17, 18, 19};
    GltfBuilder builder;
    builder.addAccessor(two, 5121, "MAT3", 2);
    const Document document = parse(builder);
    Bytes padded(two.begin(), two.end());
    padded.push_back(0);
    EXPECT_EQ(copyElements(document, readAccessor(document, 0)), padded);
    const Extent extent = extentOf(document, readAccessor(document, 0));
    EXPECT_EQ(extent.end - extent.begin, two.size());

    GltfBuilder short_of_one;
    short_of_one.addAccessor(std::vector<std::uint8_t>(two.begin(), two.end() - 1), 5121, "MAT3", 2);
    EXPECT_EQ(errorOf([&] { parse(short_of_one); }).place, "/accessors/0");
}

TEST(Accessor, CopiesSparseMatricesWithoutPaddingAtTheEnd) {
    GltfBuilder builder;
    const std::size_t indices = builder.addView({1});
    const std::size_t values = builder.addView({1, 2, 0, 0, 3, 4});
    builder.json()["accessors"].push_back({{"componentType", 5121},
                                           {"type", "MAT2"},
                                           {"count", 2},
                                           {"sparse",
                                            {{"count", 1},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                             {"values", {{"bufferView", values}}}}}});
    const Document document = parse(builder);
    EXPECT_EQ(copyElements(document, readAccessor(document, 0)),
              (Bytes{0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 3, 4, 0, 0}));
}

TEST(Accessor, OfUnknownTypeIsAnErrorOnlyWhenItsElementsAreNeeded) {
    GltfBuilder builder;
    builder.addAccessor(std::vector<float>(40), 5126, "VEC9", 1000);
    builder.json()["accessors"][0]["sparse"] = {{"count", 3},
                                                {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                                {"values", {{"bufferView", 0}, {"byteOffset", 10000}}}};
    const Document document = parse(builder);
    const Accessor accessor = readAccessor(document, 0);
    EXPECT_EQ(formatName(accessor), "float with an unknown accessor type");
    for (const Extent& extent : collectExtents(document)) {
        EXPECT_LE(extent.end, 160u);
    }
    const std::vector<std::function<void()>> readers = {
        [&] { copyElements(document, accessor); },
        [&] { decodeVec3(document, accessor, "/here"); },
        [&] { decodeIndices(document, accessor, 5, "/here"); },
    };
    for (const auto& read : readers) EXPECT_EQ(errorOf(read).code, ErrorCode::invalidFile);
    EXPECT_EQ(errorOf(readers[0]).place, "/accessors/0/type");
}

TEST(Accessor, OfABufferWithoutDataIsAnErrorOnlyWhenItsElementsAreNeeded) {
    GltfBuilder builder;
    builder.addFloats({1, 2, 3}, 3);
    Json json = builder.json();
    json["buffers"] = Json::array({Json{{"byteLength", 12}}});
    const Document document = parseDocument(test::toBytes(json.dump()), "model.gltf", {});
    const Accessor accessor = readAccessor(document, 0);
    EXPECT_FALSE(hasData(document, accessor));
    EXPECT_EQ(errorOf([&] { copyElements(document, accessor); }).code, ErrorCode::unsupportedFile);
    const Document with_data = parse(builder);
    EXPECT_TRUE(hasData(with_data, readAccessor(with_data, 0)));
}

TEST(Accessor, ReadsEveryQuantizedType) {
    // KHR_mesh_quantization: integers are normalized, or used by value.
    GltfBuilder builder;
    builder.addAccessor(std::vector<std::int8_t>{-128, -127, 127, 0}, 5120, "VEC3", 1);
    builder.addAccessor(std::vector<std::uint8_t>{0, 51, 255, 0}, 5121, "VEC3", 1);
    builder.addAccessor(std::vector<std::int16_t>{-32768, -32767, 32767, 0}, 5122, "VEC3", 1);
    builder.addAccessor(std::vector<std::uint16_t>{0, 13107, 65535, 0}, 5123, "VEC3", 1);
    const auto read = [&](std::size_t index, bool normalized) {
        GltfBuilder model = builder;
        model.json()["accessors"][index]["normalized"] = normalized;
        const Document document = parse(model);
        return decodeVec3(document, readAccessor(document, index), "").at(0);
    };
    EXPECT_EQ(read(0, false), (Vec3{-128, -127, 127}));
    EXPECT_EQ(read(0, true), (Vec3{-1, -1, 1}));
    EXPECT_EQ(read(1, false), (Vec3{0, 51, 255}));
    EXPECT_EQ(read(1, true), (Vec3{0, 0.2f, 1}));
    EXPECT_EQ(read(2, false), (Vec3{-32768, -32767, 32767}));
    EXPECT_EQ(read(2, true), (Vec3{-1, -1, 1}));
    EXPECT_EQ(read(3, false), (Vec3{0, 13107, 65535}));
    EXPECT_EQ(read(3, true), (Vec3{0, 0.2f, 1}));
}

}  // namespace
}  // namespace tspace::gltf
