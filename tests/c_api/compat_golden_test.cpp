// SPDX-License-Identifier: MIT
// The drop-in gives the reference's words for every golden mesh. The layout of the files is in the README
// beside them.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "support/shared_data.h"
#include "tspace/compat/mikktspace.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kInputWords = 8;    // position, normal, uv
constexpr std::size_t kResultWords = 10;  // tangent, bitangent, both magnitudes, orientation, sign

float asFloat(std::uint32_t word) {
    float value;
    std::memcpy(&value, &word, sizeof(value));
    return value;
}

std::uint32_t asWord(float value) {
    std::uint32_t word;
    std::memcpy(&word, &value, sizeof(word));
    return word;
}

bool isNan(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

struct Golden {
    float threshold = 0;
    std::uint32_t returned = 0;
    std::vector<std::uint32_t> sizes, first_corners;
    Words inputs, expected, results;

    explicit Golden(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        Words words(std::filesystem::file_size(path) / 4);
        file.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
        if (words.size() < 5 || words[0] != 0x31475354u) return;
        const std::size_t faces = words[1], corners = words[2];
        if (words.size() != 5 + faces + corners * (kInputWords + kResultWords)) return;
        threshold = asFloat(words[3]);
        returned = words[4];
        const auto at = [&](std::size_t i) { return words.begin() + static_cast<std::ptrdiff_t>(i); };
        sizes.assign(at(5), at(5 + faces));
        inputs.assign(at(5 + faces), at(5 + faces + corners * kInputWords));
        expected.assign(at(5 + faces + corners * kInputWords), words.end());
        results.assign(expected.size(), 0);
        std::uint32_t corner = 0;
        for (const std::uint32_t size : sizes) {
            first_corners.push_back(corner);
            corner += size;
        }
    }

    [[nodiscard]] std::size_t corner(int face, int vertex) const {
        return first_corners[static_cast<std::size_t>(face)] + static_cast<std::size_t>(vertex);
    }
};

Golden& of(const SMikkTSpaceContext* context) { return *static_cast<Golden*>(context->m_pUserData); }

template <std::size_t first, std::size_t count>
void get(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
    const Golden& golden = of(context);
    for (std::size_t k = 0; k < count; ++k)
        out[k] = asFloat(golden.inputs[golden.corner(face, vertex) * kInputWords + first + k]);
}

int numFaces(const SMikkTSpaceContext* context) { return static_cast<int>(of(context).sizes.size()); }

int numVertices(const SMikkTSpaceContext* context, const int face) {
    return static_cast<int>(of(context).sizes[static_cast<std::size_t>(face)]);
}

void setFull(const SMikkTSpaceContext* context, const float tangent[], const float bitangent[],
             const float mag_s, const float mag_t, const tbool preserving, const int face, const int vertex) {
    Golden& golden = of(context);
    std::uint32_t* words = &golden.results[golden.corner(face, vertex) * kResultWords];
    for (std::size_t k = 0; k < 3; ++k) words[k] = asWord(tangent[k]);
    for (std::size_t k = 0; k < 3; ++k) words[3 + k] = asWord(bitangent[k]);
    words[6] = asWord(mag_s);
    words[7] = asWord(mag_t);
    words[8] = static_cast<std::uint32_t>(preserving);
}

/// Comes after setFull and must give the same tangent.
void setBasic(const SMikkTSpaceContext* context, const float tangent[], const float sign, const int face,
              const int vertex) {
    Golden& golden = of(context);
    std::uint32_t* words = &golden.results[golden.corner(face, vertex) * kResultWords];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(words[k], asWord(tangent[k]));
    words[9] = asWord(sign);
}

std::size_t countDifferent(const Golden& golden) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < golden.expected.size(); ++i) {
        const std::uint32_t a = golden.expected[i], b = golden.results[i];
        different += a != b && !(isNan(a) && isNan(b)) ? 1 : 0;
    }
    return different;
}

TEST(CompatGolden, EveryWordIsTheReferences) {
    TSPACE_NEEDS_SHARED("golden/mikktspace");
    SMikkTSpaceInterface calls = {numFaces, numVertices, get<0, 3>, get<3, 3>, get<6, 2>, setBasic, setFull};
    std::size_t mesh_count = 0, equal_count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(tspace::test::shared("golden/mikktspace"))) {
        if (entry.path().extension() != ".tsg") continue;
        ++mesh_count;
        Golden golden(entry.path());
        ASSERT_FALSE(golden.sizes.empty()) << entry.path();
        const SMikkTSpaceContext context = {&calls, &golden};
        const tbool returned = genTangSpace(&context, golden.threshold);
        EXPECT_EQ(golden.returned, static_cast<std::uint32_t>(returned)) << entry.path();
        const std::size_t different = countDifferent(golden);
        EXPECT_EQ(different, 0u) << entry.path();
        equal_count += different == 0 ? 1 : 0;
    }
    RecordProperty("meshes", static_cast<int>(mesh_count));
    EXPECT_EQ(equal_count, mesh_count);
    EXPECT_GT(mesh_count, 0u);
}

}  // namespace
