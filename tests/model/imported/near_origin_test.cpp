// SPDX-License-Identifier: MIT
// Parsing and rewriting of files by tspace-import before Assimp reads them. Every byte may be malicious.
#include "near_origin/near_origin.h"

#include <gtest/gtest.h>

#include <random>

#include "far_files.h"
#include "near_origin/coordinates.h"

namespace tspace::test {
namespace {

import::Coordinates read(const std::string& file){return import::readStl({file.begin(), file.end()});
}

std::string plyText(const DVec3& place) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double z\nproperty double x\nproperty uchar red\n"
        "property double y\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const DVec3& p : {DVec3{0, 0, 0}, DVec3{1, 0, 0}, DVec3{0, 1, 0}}) {
        const DVec3 at = p + place;
        text += std::to_string(at.z) + ' ' + std::to_string(at.x) + " 255 " + std::to_string(at.y) + '\n';
    }
    return text + "3 0 1 2\n";
}

/// Reads an arbitrary file and rewrites it.
void readAnything(const std::string& file) {
    for (const auto& reader : {import::readStl, import::readPly}) {
        const import::Coordinates coordinates = reader({file.begin(), file.end()});
        if (coordinates == nullptr) continue;
        for (import::VertexList& list : coordinates->lists) {
            EXPECT_EQ(list.values.size() % 3, 0U);
            list.is_moved = true;
        }
        static_cast<void>(coordinates->rewritten());
    }
}

std::string farStl() {
    return fileOf(FarFormat::stlText, {sheet(4, {500000, 5200000, 412}), sheet(3, {500000, 5200000, 412})});
}

TEST(NearOrigin, MovedNumbersReadAsTheyWereWritten) {
    const import::Coordinates file = read(farStl());
    ASSERT_EQ(file->lists.size(), 2U);
    for (import::VertexList& list : file->lists) {
        for (double& value : list.values) value *= -0.3;
        list.is_moved = true;
    }
    const std::vector<char> bytes = file->rewritten();
    const import::Coordinates again = read({bytes.begin(), bytes.end()});
    ASSERT_EQ(again->lists.size(), 2U);
    for (const std::size_t i : {0, 1}) EXPECT_EQ(again->lists[i].values, file->lists[i].values);
}

TEST(NearOrigin, AnUnmovedFileKeepsItsBytes) {
    const std::vector<char> bytes = read(farStl())->rewritten();
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), farStl());
}

TEST(NearOrigin, PlyHasItsNumbersInAnyOrder) {
    const std::string text = plyText({500000, 5200000, 412});
    const import::Coordinates file = import::readPly({text.begin(), text.end()});
    ASSERT_EQ(file->lists.size(), 1U);
    const std::vector<double> values = file->lists[0].values;
    EXPECT_EQ(values[4], 5200000);
    for (double& value : file->lists[0].values) value *= 0.5;
    file->lists[0].is_moved = true;
    const import::Coordinates again = import::readPly(file->rewritten());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(again->lists[0].values[i], 0.5 * values[i]);
}

TEST(NearOrigin, SurvivesTruncatedFiles) {
    for (const std::string& text : {farStl(), plyText({500000, 5200000, 412})}) {
        for (std::size_t size = 0; size < text.size(); ++size) readAnything(text.substr(0, size));
    }
}

TEST(NearOrigin, SurvivesChangedBytes) {
    std::mt19937 random(7);
    for (const std::string& text : {farStl(), plyText({500000, 5200000, 412})}) {
        for (int i = 0; i < 3000; ++i) {
            std::string changed = text;
            const int count = 1 + static_cast<int>(random() % 4);
            for (int k = 0; k < count; ++k) {
                constexpr std::array<int, 8> kValues = {0, 1, 8, 127, 255, 32, 57, 45};
                changed[random() % changed.size()] = static_cast<char>(kValues[random() % kValues.size()]);
            }
            readAnything(changed);
        }
    }
}

}  // namespace tspace::test
}  // namespace tspace::test
