// SPDX-License-Identifier: MIT
// generate --fix-winding on files of all formats, followed by check.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr int kAround = 24, kAlong = 12;

/// Returns a torus whose upper half has another material. `damaged`: every seventh triangle is flipped.
std::string torus(bool with_normals, bool damaged = true) {
    std::string text = "mtllib a.mtl\n", faces;
    const auto number = [](double x) { return std::to_string(std::lround(1e6 * x) / 1e6) + " "; };
    constexpr double kTurn = 6.283185307179586;
    for (int j = 0; j < kAlong; ++j) {
        for (int i = 0; i < kAround; ++i) {
            const double u = kTurn * i / kAround, v = kTurn * j / kAlong, r = 1 + 0.4 * std::cos(v);
            text += "v " + number(r * std::cos(u)) + number(r * std::sin(u)) + number(0.4 * std::sin(v)) + "\n";
            text += "vn " + number(std::cos(v) * std::cos(u)) + number(std::cos(v) * std::sin(u)) +
                    number(std::sin(v)) + "\n";
        }
    }
    for (int j = 0; j <= kAlong; ++j) {
        for (int i = 0; i <= kAround; ++i) text += "vt " + number(1.0 * i / kAround) + number(1.0 * j / kAlong) + "\n";
    }
    const auto corner = [&](int i, int j) {
        const int v = 1 + j % kAlong * kAround + i % kAround, t = 1 + j * (kAround + 1) + i;
        return " " + std::to_string(v) + "/" + std::to_string(t) + (with_normals ? "/" + std::to_string(v) : "");
    };
    int count = 0;
    const auto add = [&](std::string a, const std::string& b, const std::string& c) {
        const bool is_turned = damaged && count++ % 7 == 3;
        faces += "f" + a + (is_turned ? c + b : b + c) + "\n";
    };
    for (int j = 0; j < kAlong; ++j) {
        if (j == 0 || j == kAlong / 2) faces += j == 0 ? "usemtl a\n" : "usemtl b\n";
        for (int i = 0; i < kAround; ++i) {
            add(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
            add(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
    }
    return text + faces;
}
constexpr int kTurned = (2 * kAround * kAlong + 3) / 7;

void writeTorus(const TempFolder& folder, bool with_normals, bool damaged = true) {
    folder.write("a.mtl", "newmtl a\nnewmtl b\n");
    folder.write("a.obj", torus(with_normals, damaged));
}

Json fileReport(const TempFolder& folder, const std::string& arguments) {
    const ToolRun run = runTool(folder, arguments + " --json");
    EXPECT_EQ(0, run.exit_code) << arguments << run.err;
    const Json json = Json::parse(run.out, nullptr, false);
    return json.is_object() ? json["files"][0] : Json::object();
}

void expectMended(const Json& report, int turned, int components = 1) {
    ASSERT_EQ(1u, report["windings"].size());
    const Json& winding = report["windings"][0];
    EXPECT_EQ(turned, winding["turned"].get<int>());
    EXPECT_EQ(0, winding["conflictsAfter"].get<int>());
    EXPECT_EQ(components, winding["components"].get<int>());
    int in_primitives = 0, in_ranges = 0;
    for (const Json& primitive : report["primitives"]) {
        in_primitives += primitive["windingMended"].get<int>();
        for (const Json& range : primitive["windingMendedRanges"]) in_ranges += range["count"].get<int>();
    }
    EXPECT_EQ(turned, in_primitives);
    EXPECT_EQ(turned, in_ranges);
}

bool findsNormalsAgainstWinding(const TempFolder& folder, const std::string& file) {
    return runTool(folder, "check --json " + file).out.find("\"normalsAgainstWinding\"") != std::string::npos;
}

TEST(FixWindingOfFiles, FlipsFacesOfObjBeforeNormalsAreComputed) {
    TempFolder folder;
    writeTorus(folder, false);
    const Json report = fileReport(folder, "generate --all --normals angle --fix-winding a.obj -o b.glb");
    expectMended(report, kTurned);
    EXPECT_EQ(1, report["windings"][0]["byVolume"].get<int>());
    for (const Json& primitive : report["primitives"]) EXPECT_EQ(0, primitive["normalsBehind"].get<int>());
    EXPECT_FALSE(findsNormalsAgainstWinding(folder, "b.glb"));
    // The repaired file must equal the result for a file without damage.
    writeTorus(folder, false, false);
    ASSERT_EQ(0, runTool(folder, "generate -q --all --normals angle a.obj -o c.glb").exit_code);
    EXPECT_EQ(0, runTool(folder, "diff b.glb c.glb").exit_code);
    EXPECT_NE(std::string::npos,
              runTool(folder, "generate --fix-winding c.glb -o d.glb").out.find("--fix-winding has no effect"));
    EXPECT_EQ(folder.read("c.glb"), folder.read("d.glb"));
}

TEST(FixWindingOfFiles, LeavesNoFindingForAnyCompression) {
    TempFolder folder;
    writeTorus(folder, true);
    for (const std::string packed : {"none", "meshopt", "draco"}) {
        ASSERT_EQ(0, runTool(folder, "generate -q --all a.obj -o a.glb").exit_code);
        if (runTool(folder, "generate -q --compress " + packed + " a.glb -o b.glb").exit_code != 0) continue;
        EXPECT_TRUE(findsNormalsAgainstWinding(folder, "b.glb")) << packed;
        const ToolRun found = runTool(folder, "check --verbose b.glb");
        EXPECT_NE(std::string::npos, (found.out + found.err).find("tspace generate --fix-winding")) << found.out;
        for (const std::string more : {"", " --compress none", " --compress meshopt"}) {
            const Json report = fileReport(folder, "generate --fix-winding" + more + " b.glb -o c.glb");
            // Draco quantizes the positions of each primitive on a grid of its own, so the primitives do not share
            // positions.
            const int components = packed == "draco" ? 2 : 1;
            expectMended(report, kTurned, components);
            EXPECT_EQ(components, report["windings"][0]["byNormals"].get<int>());
            EXPECT_FALSE(findsNormalsAgainstWinding(folder, "c.glb")) << packed << more;
            EXPECT_EQ(0,
                      fileReport(folder, "generate --fix-winding c.glb -o d.glb")["windings"][0]["turned"].get<int>());
        }
    }
}

TEST(FixWindingOfFiles, FollowsTheVolumeIfNormalsAreRecomputed) {
    TempFolder folder;
    writeTorus(folder, true);
    ASSERT_EQ(0, runTool(folder, "generate -q --all a.obj -o a.glb").exit_code);
    const Json report = fileReport(folder, "generate --fix-winding --overwrite-normals a.glb -o b.glb");
    expectMended(report, kTurned);
    EXPECT_EQ(1, report["windings"][0]["byVolume"].get<int>());
    EXPECT_FALSE(findsNormalsAgainstWinding(folder, "b.glb"));
}

/// Cards around a point. Their normals point away from the point, and every second card has the opposite winding.
TEST(FixWindingOfFiles, FlipsEachCardTowardItsOwnNormals) {
    TempFolder folder;
    constexpr int kCards = 10;
    std::string text, faces;
    const auto put = [&](const char* what, double x, double y, double z) {
        text += what + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    };
    for (int i = 0; i < kCards; ++i) {
        const double angle = 6.283185307179586 * i / kCards, c = std::cos(angle), s = std::sin(angle);
        for (const double up : {-0.2, 0.2}) {
            for (const double aside : {-0.2, 0.2}) {
                put("v ", c - s * aside, s + c * aside, up);
                const double length = std::sqrt(1 + aside * aside + up * up);
                put("vn ", (c - s * aside) / length, (s + c * aside) / length, up / length);
            }
        }
        const auto corner = [&](int k) {
            const std::string v = std::to_string(4 * i + k);
            return " " + v + "//" + v;
        };
        faces += i % 2 == 0 ? "f" + corner(1) + corner(2) + corner(4) + corner(3) + "\n"
                            : "f" + corner(1) + corner(3) + corner(4) + corner(2) + "\n";
    }
    folder.write("a.obj", text + faces);
    ASSERT_EQ(0, runTool(folder, "generate -q a.obj -o a.glb").exit_code);
    const ToolRun found = runTool(folder, "check a.glb");
    EXPECT_NE(std::string::npos, found.out.find("tspace generate --fix-winding")) << found.out;
    const Json report = fileReport(folder, "generate --fix-winding a.glb -o b.glb");
    expectMended(report, kCards, kCards);
    EXPECT_EQ(kCards, report["windings"][0]["byNormals"].get<int>());
    EXPECT_FALSE(findsNormalsAgainstWinding(folder, "b.glb"));
    EXPECT_EQ(0, fileReport(folder, "generate --fix-winding b.glb -o c.glb")["windings"][0]["turned"].get<int>());
}

/// Returns a tetrahedron as a primitive of the given mode. `corners`: the points of its faces, written as indices or as
/// vertices.
std::string tetrahedron(unsigned mode, const std::vector<int>& corners, bool with_indices) {
    constexpr float kPoints[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::string bytes;
    const auto put = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
    const std::size_t vertex_count = with_indices ? 4 : corners.size();
    for (std::size_t i = 0; i < vertex_count; ++i) put(kPoints[with_indices ? static_cast<int>(i) : corners[i]], 12);
    if (with_indices) {
        for (const int corner : corners) put(&corner, 1);
    }
    static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string base64;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (int k = 3; k >= 0; --k) base64 += kDigits[word >> (6 * k) & 63];
    }
    Json json = {{"asset", {{"version", "2.0"}}}};
    const std::size_t position_bytes = 12 * vertex_count;
    const std::string padding(bytes.size() % 3 == 0 ? 0 : 3 - bytes.size() % 3, '=');
    base64.replace(base64.size() - padding.size(), padding.size(), padding);
    json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64}}};
    json["bufferViews"] = {{{"buffer", 0}, {"byteLength", position_bytes}}};
    json["accessors"] = {{{"bufferView", 0},
                          {"componentType", 5126},
                          {"type", "VEC3"},
                          {"count", vertex_count},
                          {"min", {0, 0, 0}},
                          {"max", {1, 1, 1}}}};
    json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"mode", mode}}}}}};
    if (with_indices) {
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", position_bytes}, {"byteLength", bytes.size() - position_bytes}});
        json["accessors"].push_back(
            {{"bufferView", 1}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", corners.size()}});
        json["meshes"][0]["primitives"][0]["indices"] = 1;
    }
    return json.dump();
}

TEST(FixWindingOfFiles, ConvertsStripsAndUnindexedPrimitivesToLists) {
    TempFolder folder;
    // The tetrahedron is inside out in a strip and in unindexed triangles. The third one has one flipped face.
    folder.write("strip.gltf", tetrahedron(5, {0, 1, 2, 3, 0, 1}, true));
    folder.write("bare.gltf", tetrahedron(4, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}, false));
    folder.write("one.gltf", tetrahedron(4, {0, 2, 1, 0, 3, 1, 0, 3, 2, 1, 2, 3}, true));
    for (const auto& [name, turned] : {std::pair{"strip", 4}, std::pair{"bare", 4}, std::pair{"one", 1}}) {
        const std::string from = std::string(name) + ".gltf", to = std::string(name) + "2.gltf";
        expectMended(fileReport(folder, "generate --fix-winding " + from + " -o " + to), turned);
        expectMended(fileReport(folder, "generate --fix-winding " + to + " -o again.gltf"), 0);
        const Json json = Json::parse(folder.read(to));
        const Json& primitive = json["meshes"][0]["primitives"][0];
        EXPECT_EQ(4u, primitive["mode"].get<unsigned>());
        EXPECT_EQ(12u, json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<unsigned>());
    }
}

}  // namespace
}  // namespace tspace::test
