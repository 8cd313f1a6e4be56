// SPDX-License-Identifier: MIT
// The table that compares shipped tangents with the reference implementation: `identify` reproduces each row, and so
// does `diff` with the output of `generate`.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "model/model_files.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/inspect.h"

namespace tspace::test {
namespace {

/// A row for one file, with shares in percent of its corners. The table was computed with glTF UVs as stored (v down),
/// so corners with the inverted sign, `sign_flipped`, have the correct one.
struct Row {
    std::string file = {};
    std::uint64_t corner_count = 0;
    double within_1_deg = 0, within_10_deg = 0, sign_same = 0, sign_flipped = 0;
};

std::vector<Row> readTable() {
    std::vector<Row> rows;
    std::ifstream stream(shared("models/GOLDEN.md"));
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> cells;
        std::istringstream words(line);
        for (std::string cell; std::getline(words, cell, '|');) {
            const std::size_t first = cell.find_first_not_of(' ');
            if (first != std::string::npos) cells.push_back(cell.substr(first, cell.find_last_not_of(' ') - first + 1));
        }
        if (cells.size() != 6 || cells[0].find('/') == std::string::npos) continue;
        rows.push_back({cells[0], std::stoull(cells[1]), std::stod(cells[2]), std::stod(cells[3]), std::stod(cells[4]),
                        std::stod(cells[5])});
    }
    return rows;
}

/// Tolerances in percent. The table has one decimal. Its angles were computed with floats, in which one degree
/// corresponds to the last few bits of a cosine: up to 0.46 % of the corners are on the other side of a limit.
constexpr double kSignSlack = 0.15, kAngleSlack = 0.5;

double percentOf(std::uint64_t count, std::uint64_t total) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(total);
}

TEST(GoldenTable, IsWhatIdentifyFinds) {
    TSPACE_NEEDS_SHARED("models/GOLDEN.md");
    const std::vector<Row> rows = readTable();
    EXPECT_EQ(rows.size(), 22u);
    for (const Row& row : rows) {
        const Result<Identification> result = identifyFile(shared("models/" + row.file).string());
        ASSERT_TRUE(result) << row.file << ": " << result.error().message;
        std::uint64_t corners = 0, undecided = 0, near = 0, gltf = 0, inverted = 0;
        for (const PrimitiveIdentity& primitive : result->primitives) {
            for (const Explanation& entry : primitive.explanations) {
                // The table uses TEXCOORD_0 as stored, regardless of which UV set the textures use.
                if (entry.method != Method::mikktspace || entry.uv_set != 0 || entry.is_transformed) continue;
                if (entry.faces != Faces::triangles) continue;
                corners += entry.corner_count;
                undecided += entry.undecided_count;
                near += entry.near_count;
                gltf += entry.gltf_sign_count;
                inverted += entry.inverted_sign_count;
            }
        }
        // The table counts every corner. Corners with indeterminate UVs are not compared, so either state is accepted
        // for them.
        EXPECT_LE(corners + undecided, row.corner_count) << row.file;
        const std::uint64_t left_out = row.corner_count - corners;
        const auto expectAllBut = [&](std::uint64_t count, double percent, double slack) {
            EXPECT_LE(percentOf(count, row.corner_count), percent + slack) << row.file;
            EXPECT_GE(percentOf(count + left_out, row.corner_count), percent - slack) << row.file;
        };
        expectAllBut(near, row.within_1_deg, kAngleSlack);
        expectAllBut(gltf, row.sign_flipped, kSignSlack);
        expectAllBut(inverted, row.sign_same, kSignSlack);
        // Primitives without any UV area are skipped, so their corners are in neither count.
        EXPECT_TRUE(undecided != 0 || corners == 0 || corners == row.corner_count) << row.file;
    }
}

std::uint64_t countUpTo(const AngleStatistics& angles, double degrees) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < kAngleBins.size() && kAngleBins[i] <= degrees; ++i) count += angles.histogram[i];
    return count;
}

TEST(GoldenTable, IsWhatDiffFinds) {
    TSPACE_NEEDS_SHARED("models/GOLDEN.md");
    const TempFolder folder;
    for (const Row& row : readTable()) {
        GenerateOptions options{.selection = {.all = true, .existing = ExistingTangents::replace},
                                .tangents = {.texture_transform = TextureTransform::ignore, .sanitize = false}};
        const std::string input = shared("models/" + row.file).string(), output = folder.path("out.glb").string();
        const auto report = generateFile(input, output, options);
        ASSERT_TRUE(report) << row.file << ": " << report.error().message;
        const bool follows_set_0 = std::all_of(report->primitives.begin(), report->primitives.end(),
                                               [](const PrimitiveReport& primitive) { return primitive.uv_set <= 0; });
        const Result<FrameDiff> diff = diffFiles(input, output);
        ASSERT_TRUE(diff) << row.file << ": " << diff.error().message;
        EXPECT_EQ(diff->unpaired_triangle_count, 0u) << row.file;
        // The table contains only TEXCOORD_0.
        if (!follows_set_0) continue;
        std::uint64_t corners = 0, within_1 = 0, within_10 = 0, changes = 0;
        for (const PrimitiveDiff& primitive : diff->primitives) {
            // Primitives without UVs keep their tangents, and are not in the table.
            const bool is_computed =
                std::any_of(report->primitives.begin(), report->primitives.end(), [&](const PrimitiveReport& made) {
                    return made.mesh == primitive.mesh_a && made.primitive == primitive.primitive_a && made.uv_set == 0;
                });
            if (!primitive.has_tangents_a || !is_computed) continue;
            corners += 3 * primitive.paired_triangle_count;
            within_1 += countUpTo(primitive.tangents, 1);
            within_10 += countUpTo(primitive.tangents, 10);
            changes += primitive.sign_change_count;
        }
        ASSERT_EQ(corners, row.corner_count) << row.file;
        EXPECT_NEAR(percentOf(within_1, corners), row.within_1_deg, kAngleSlack) << row.file;
        EXPECT_NEAR(percentOf(within_10, corners), row.within_10_deg, kAngleSlack) << row.file;
        EXPECT_NEAR(percentOf(changes, corners), row.sign_same, kSignSlack) << row.file;
    }
}

}  // namespace
}  // namespace tspace::test
