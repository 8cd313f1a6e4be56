// SPDX-License-Identifier: MIT
// The drop-in gives the reference's words for every golden mesh whose bits are promised. The README next to the files
// describes their layout.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

#include "support/golden_file.h"
#include "support/shared_data.h"
#include "tspace/compat/mikktspace.h"

namespace {

using tspace::test::GoldenFile;
using Words = std::vector<std::uint32_t>;

bool isNan(std::uint32_t word) { return (word & 0x7fffffffu) > 0x7f800000u; }

/// A golden file, and the results of the drop-in in the same layout.
struct Golden : GoldenFile {
    std::vector<std::uint32_t> first_corners;
    Words computed;

    explicit Golden(const std::filesystem::path& path)
        : GoldenFile(path), first_corners(face_sizes.size()), computed(results.size(), 0) {
        std::exclusive_scan(face_sizes.begin(), face_sizes.end(), first_corners.begin(), 0u);
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
        out[k] = std::bit_cast<float>(golden.input(golden.corner(face, vertex))[first + k]);
}

int numFaces(const SMikkTSpaceContext* context) { return static_cast<int>(of(context).face_sizes.size()); }

int numVertices(const SMikkTSpaceContext* context, const int face) {
    return static_cast<int>(of(context).face_sizes[static_cast<std::size_t>(face)]);
}

void setFull(const SMikkTSpaceContext* context, const float tangent[], const float bitangent[], const float mag_s,
             const float mag_t, const tbool preserving, const int face, const int vertex) {
    Golden& golden = of(context);
    std::uint32_t* words = &golden.computed[golden.corner(face, vertex) * Golden::kResultWords];
    for (std::size_t k = 0; k < 3; ++k) words[k] = std::bit_cast<std::uint32_t>(tangent[k]);
    for (std::size_t k = 0; k < 3; ++k) words[3 + k] = std::bit_cast<std::uint32_t>(bitangent[k]);
    words[6] = std::bit_cast<std::uint32_t>(mag_s);
    words[7] = std::bit_cast<std::uint32_t>(mag_t);
    words[8] = static_cast<std::uint32_t>(preserving);
}

/// The drop-in calls this after setFull, with the same tangent.
void setBasic(const SMikkTSpaceContext* context, const float tangent[], const float sign, const int face,
              const int vertex) {
    Golden& golden = of(context);
    std::uint32_t* words = &golden.computed[golden.corner(face, vertex) * Golden::kResultWords];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(words[k], std::bit_cast<std::uint32_t>(tangent[k]));
    words[9] = std::bit_cast<std::uint32_t>(sign);
}

std::size_t countDifferent(const Golden& golden) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < golden.results.size(); ++i) {
        const std::uint32_t a = golden.results[i], b = golden.computed[i];
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
        Golden golden(entry.path());
        ASSERT_FALSE(golden.face_sizes.empty()) << entry.path();
        if (!golden.hasPromisedBits()) continue;
        ++mesh_count;
        const SMikkTSpaceContext context = {&calls, &golden};
        const tbool returned = genTangSpace(&context, golden.angular_threshold_deg);
        EXPECT_EQ(golden.returned, static_cast<std::uint32_t>(returned)) << entry.path();
        const std::size_t different = countDifferent(golden);
        EXPECT_EQ(different, 0u) << entry.path();
        equal_count += different == 0 ? 1 : 0;
    }
    RecordProperty("meshes", static_cast<int>(mesh_count));
    EXPECT_EQ(equal_count, mesh_count);
    EXPECT_GT(mesh_count, 300u);
}

}  // namespace
