// SPDX-License-Identifier: MIT
#include "tspace/mesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace tspace {
namespace {

struct MeshBorder : testing::Test {
    std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    std::vector<Vec3> normals{4, Vec3{0, 0, 1}};
    std::vector<Vec2> uvs{4};
    std::vector<std::uint16_t> indices{0, 1, 2, 2, 1, 3};
    MeshView mesh;

    MeshBorder() {
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uvs = uvs;
        mesh.indices = IndexView(std::span<const std::uint16_t>(indices));
    }
    ErrorCode code() const {
        const Result<Done> result = validate(mesh);
        return result ? ErrorCode::ok : result.error().code;
    }
};

TEST_F(MeshBorder, AcceptsASoundMesh) { EXPECT_EQ(code(), ErrorCode::ok); }

TEST_F(MeshBorder, AcceptsAnEmptyMesh) {
    mesh = MeshView{};
    EXPECT_EQ(code(), ErrorCode::ok);
}

TEST_F(MeshBorder, NamesTheCornerWhoseIndexIsOutOfRange) {
    indices[4] = 4;
    const Result<Done> result = validate(mesh);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::indexOutOfRange);
    EXPECT_EQ(result.error().element, 4u);
    EXPECT_FALSE(result.error().message.empty());
}

TEST_F(MeshBorder, FindsTheInvalidIndexOfEveryWidthAtEveryPosition) {
    const auto expectFound = [&](auto index, auto bad) {
        for (std::size_t at = 0; at < 66; ++at) {
            std::vector<decltype(index)> many(66, index);
            mesh.indices = IndexView(std::span<const decltype(index)>(many));
            ASSERT_EQ(code(), ErrorCode::ok);
            many[at] = bad;
            const Result<Done> result = validate(mesh);
            ASSERT_FALSE(result);
            EXPECT_EQ(result.error().code, ErrorCode::indexOutOfRange);
            EXPECT_EQ(result.error().element, at);
        }
    };
    for (const std::uint8_t bad : {std::uint8_t{4}, std::uint8_t{255}}) expectFound(std::uint8_t{3}, bad);
    for (const std::uint16_t bad : {std::uint16_t{4}, std::uint16_t{0xffff}}) expectFound(std::uint16_t{3}, bad);
    for (const std::uint32_t bad : {4u, 0x7fffffffu, 0x80000000u, 0x80000003u, 0xffffffffu}) {
        expectFound(std::uint32_t{3}, bad);
    }
}

TEST_F(MeshBorder, RejectsVertexArraysOfDifferentLength) {
    mesh.normals.count = 3;
    EXPECT_EQ(code(), ErrorCode::countMismatch);
}

TEST_F(MeshBorder, RejectsNullWithACount) {
    mesh.uvs.data = nullptr;
    EXPECT_EQ(code(), ErrorCode::nullData);
    mesh.uvs = uvs;
    mesh.indices.data = nullptr;
    EXPECT_EQ(code(), ErrorCode::nullData);
}

TEST_F(MeshBorder, RejectsOverlappingElements) {
    mesh.positions.stride_bytes = 8;
    EXPECT_EQ(code(), ErrorCode::strideTooSmall);
}

TEST_F(MeshBorder, RejectsMisalignedData) {
    mesh.positions.data = reinterpret_cast<const Vec3*>(reinterpret_cast<const char*>(positions.data()) + 1);
    EXPECT_EQ(code(), ErrorCode::misaligned);
    mesh.positions = positions;
    mesh.positions.stride_bytes = 13;
    EXPECT_EQ(code(), ErrorCode::misaligned);
}

TEST_F(MeshBorder, RejectsSizesThatOverflow) {
    mesh.positions.count = std::size_t{1} << 62;
    EXPECT_EQ(code(), ErrorCode::tooLarge);
    mesh.positions = positions;
    mesh.positions.stride_bytes = ~std::size_t{3};
    EXPECT_EQ(code(), ErrorCode::tooLarge);
}

TEST_F(MeshBorder, RejectsFacesThatDoNotAddUpToTheCorners) {
    const std::vector<std::uint32_t> too_few{3};
    const std::vector<std::uint32_t> wraps{0xffffffffu, 0xffffffffu, 8};
    mesh.face_sizes = too_few;
    EXPECT_EQ(code(), ErrorCode::countMismatch);
    mesh.face_sizes = wraps;
    EXPECT_EQ(code(), ErrorCode::countMismatch);
    mesh.face_sizes = {};
    mesh.face_size = 4;
    EXPECT_EQ(code(), ErrorCode::countMismatch);
    mesh.face_size = 0;
    EXPECT_EQ(code(), ErrorCode::invalidOption);
}

TEST_F(MeshBorder, AcceptsFacesThatAreIgnored) {
    const std::vector<std::uint32_t> sizes{0, 1, 2, 3};
    mesh.face_sizes = sizes;
    EXPECT_EQ(code(), ErrorCode::ok);
}

}  // namespace
}  // namespace tspace
