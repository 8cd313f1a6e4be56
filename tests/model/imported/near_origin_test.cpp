// SPDX-License-Identifier: MIT
// What tspace-import reads and writes before Assimp does. Every byte may be hostile.
#include "near_origin/near_origin.h"

#include <gtest/gtest.h>

#include <random>

#include "far_files.h"
#include "near_origin/coordinates.h"
#include "near_origin/fbx_records.h"

namespace tspace::test {
namespace {

constexpr std::array kFormats = {FarFormat::stlText,        FarFormat::collada,     FarFormat::fbxText,
                                 FarFormat::fbxRaw,         FarFormat::fbxDeflated, FarFormat::fbxRaw7500,
                                 FarFormat::fbxDeflated7500};

import::Coordinates read(FarFormat format, const std::string& file){std::vector<char> bytes(file.begin(), file.end());
if (format == FarFormat::stlText) return import::readStl(std::move(bytes));
if (format == FarFormat::collada) return import::readCollada(std::move(bytes));
return import::readFbx(std::move(bytes));
}  // namespace

/// Reads and writes whatever the file is.
void readAnything(FarFormat format, const std::string& file) {
    const import::Coordinates coordinates = read(format, file);
    if (coordinates == nullptr) return;
    for (import::VertexList& list : coordinates->lists) {
        EXPECT_EQ(list.values.size() % 3, 0U);
        list.is_moved = true;
    }
    static_cast<void>(coordinates->rewritten());
    const std::vector<char> bytes(file.begin(), file.end());
    if (format == FarFormat::collada) static_cast<void>(import::placesInCollada(bytes));
    if (format != FarFormat::collada && format != FarFormat::stlText) static_cast<void>(import::placesInFbx(bytes));
}

std::vector<Part> twoParts(const DVec3& place) {
    std::vector<Part> parts = {sheet(4, place), sheet(3, place)};
    parts[0].translation = DVec3{1, 2, 3};
    return parts;
}

TEST(NearOrigin, MovedNumbersReadAsTheyWereWritten) {
    for (const FarFormat format : kFormats) {
        const import::Coordinates file = read(format, fileOf(format, twoParts({500000, 5200000, 412})));
        ASSERT_EQ(file->lists.size(), 2U);
        for (import::VertexList& list : file->lists) {
            for (double& value : list.values) value *= -0.3;
            list.is_moved = true;
        }
        const std::vector<char> bytes = file->rewritten();
        const import::Coordinates again = read(format, std::string(bytes.begin(), bytes.end()));
        ASSERT_EQ(again->lists.size(), 2U);
        for (const std::size_t i : {0, 1}) EXPECT_EQ(again->lists[i].values, file->lists[i].values);
    }
}

TEST(NearOrigin, AFileOfWhichNothingMovesKeepsItsBytes) {
    for (const FarFormat format : kFormats) {
        const std::string text = fileOf(format, twoParts({0, 0, 0}));
        const std::vector<char> bytes = read(format, text)->rewritten();
        EXPECT_EQ(std::string(bytes.begin(), bytes.end()), text);
    }
}

TEST(NearOrigin, RecordsOfFbxStayWholeWhenArraysGrow) {
    for (const FarFormat format :
         {FarFormat::fbxRaw, FarFormat::fbxDeflated, FarFormat::fbxRaw7500, FarFormat::fbxDeflated7500}) {
        const std::string text = fileOf(format, twoParts({500000, 5200000, 412}));
        const auto namesOf = [](std::string_view file) {
            std::vector<std::string> names;
            import::FbxRecords records(file);
            while (const std::optional<import::FbxRecord> record = records.next()) names.emplace_back(record->name);
            EXPECT_TRUE(records.isWhole());
            return names;
        };
        const import::Coordinates file = read(format, text);
        file->lists[1].is_moved = true;  // the first stays compressed
        const std::vector<char> bytes = file->rewritten();
        EXPECT_EQ(namesOf({bytes.data(), bytes.size()}), namesOf(text));
    }
}

TEST(NearOrigin, CutFilesAreNoTrouble) {
    for (const FarFormat format : kFormats) {
        const std::string text = fileOf(format, twoParts({500000, 5200000, 412}));
        for (std::size_t size = 0; size < text.size(); ++size) readAnything(format, text.substr(0, size));
    }
}

TEST(NearOrigin, ChangedBytesAreNoTrouble) {
    std::mt19937 random(7);
    for (const FarFormat format : kFormats) {
        const std::string text = fileOf(format, twoParts({500000, 5200000, 412}));
        for (int i = 0; i < 3000; ++i) {
            std::string changed = text;
            const int count = 1 + static_cast<int>(random() % 4);
            for (int k = 0; k < count; ++k) {
                constexpr std::array kValues = {
                    0U, 1U, 8U, 127U, 255U, unsigned{'"'}, unsigned{'<'}, unsigned{'{'}, unsigned{'}'}, unsigned{' '}};
                changed[random() % changed.size()] = static_cast<char>(kValues[random() % kValues.size()]);
            }
            readAnything(format, changed);
        }
    }
}

TEST(NearOrigin, ArraysThatClaimMoreThanTheirBytesHoldAreLeftAlone) {
    for (const std::uint32_t claim : {49U, 1000000U, 0xffffffffU, 0x80000000U, 0x20000001U}) {
        for (const FarFormat format : {FarFormat::fbxRaw, FarFormat::fbxDeflated7500})
            EXPECT_TRUE(read(format, fileOf(format, twoParts({0, 0, 0}), {.claimed_count = claim}))->lists.empty())
                << claim;
    }
}

TEST(NearOrigin, ColladaIsReadByItsAccessors) {
    const auto file = [](const std::string& accessor, const std::string& parameters) {
        return "<COLLADA><mesh><source id='p'><float_array id='a'>9 1 2 3 4 5 6 7 8</float_array><accessor "
               "source='#a' " +
               accessor + ">" + parameters +
               "</accessor></source><vertices><input semantic='POSITION' source='#p'/></vertices></mesh></COLLADA>";
    };
    const std::string xyz = "<param name='X'/><param name='Y'/><param name='Z'/>";
    const auto values = [&](const std::string& accessor, const std::string& parameters) {
        const import::Coordinates coordinates = read(FarFormat::collada, file(accessor, parameters));
        return coordinates->lists.empty() ? std::vector<double>() : coordinates->lists[0].values;
    };
    EXPECT_EQ(values("count='2' stride='4' offset='1'", xyz + "<param/>"), (std::vector<double>{1, 2, 3, 5, 6, 7}));
    EXPECT_EQ(values("count='1' stride='4'", "<param name='Z'/><param/><param name='X'/><param name='Y'/>"),
              (std::vector<double>{2, 3, 9}));
    for (const char* accessor : {"count='4' stride='3'", "count='4294967295' stride='4294967295'",
                                 "count='1' stride='0'", "count='1' stride='3' offset='4294967295'",
                                 "count='-1' stride='3'", "count='nan' stride='3'", "count='0' stride='3'"})
        EXPECT_TRUE(values(accessor, xyz).empty()) << accessor;
    EXPECT_TRUE(values("count='1' stride='2'", "<param name='X'/><param name='Y'/>").empty());
}

}  // namespace tspace::test
}  // namespace tspace::test
