// SPDX-License-Identifier: MIT
// Runs each command that check prints for a normal map with several faults. Each command alone must fix all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "images/float_image.h"
#include "images/images.h"
#include "images/textures.h"
#include "tool/folder_files.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kSide = 128;

struct Texel {
    float r = 0, g = 0, b = 0, a = 1;
};

struct ChannelFault {
    const char* name;
    Texel (*store)(float x, float y, float z);
    bool has_alpha = false;
    bool is_small = false;  ///< reported only beside another fault
};

const ChannelFault kChannelFaults[] = {
    {"none",
     [](float x, float y, float z) {
         return Texel{x, y, z};
     },
     false, true},
    {"z in red",
     [](float x, float y, float z) {
         return Texel{z, y, x};
     }},
    {"z in green",
     [](float x, float y, float z) {
         return Texel{x, z, y};
     }},
    {"rotated channels",
     [](float x, float y, float z) {
         return Texel{y, z, x};
     }},
    {"x and y exchanged",
     [](float x, float y, float z) {
         return Texel{y, x, z};
     }},
    {"z inverted",
     [](float x, float y, float z) {
         return Texel{x, y, 1 - z};
     }},
    {"no z",
     [](float x, float y, float) {
         return Texel{x, y, 0};
     }},
    {"z of one value",
     [](float x, float y, float) {
         return Texel{x, y, 1};
     },
     false, true},
    {"z without sign",
     [](float x, float y, float z) {
         return Texel{x, y, 2 * z - 1};
     }},
    {"x in alpha",
     [](float x, float y, float) {
         return Texel{1, y, 1, x};
     },
     true},
    {"x in alpha beside gray",
     [](float x, float y, float) {
         return Texel{y, y, y, x};
     },
     true},
};

float withCurve(float c) {
    return c <= 0.0031308F ? 12.92F * c : static_cast<float>(1.055 * std::pow(static_cast<double>(c), 1 / 2.4) - 0.055);
}
float withoutCurve(float c) {
    return c <= 0.04045F ? c / 12.92F : static_cast<float>(std::pow((static_cast<double>(c) + 0.055) / 1.055, 2.4));
}
float sameCurve(float c) { return c; }

const std::pair<const char*, float (*)(float)> kCurves[] = {
    {"linear", sameCurve}, {"sRGB", withCurve}, {"linearized", withoutCurve}};

using Texels = std::vector<Texel>;

std::string rgbaBytes(const Texels& texels) {
    std::string bytes;
    for (const Texel& texel : texels) {
        for (const float c : {texel.r, texel.g, texel.b, texel.a})
            bytes += static_cast<char>(static_cast<std::uint8_t>(std::lround(255 * c)));
    }
    return bytes;
}

std::string pngBytes(const Texels& texels) {
    FloatImage image{kSide, kSide, 8, {}, {}};
    const bool is_opaque = std::all_of(texels.begin(), texels.end(), [](const Texel& t) { return t.a == 1; });
    for (const Texel& texel : texels) {
        image.texels.push_back({texel.r, texel.g, texel.b});
        if (!is_opaque) image.alpha.push_back(texel.a);
    }
    const auto file = encodePng(image, 8);
    return file ? std::string(file->begin(), file->end()) : std::string();
}

std::string exrOf(const Texels& texels, const std::function<float(float)>& stored) {
    std::vector<ExrChannel> channels{{"A", {}}, {"B", {}}, {"G", {}}, {"R", {}}};
    for (const Texel& texel : texels) {
        const float values[] = {texel.a, texel.b, texel.g, texel.r};
        for (std::size_t i = 0; i < 4; ++i) channels[i].values.push_back(stored(values[i]));
    }
    if (std::all_of(texels.begin(), texels.end(), [](const Texel& t) { return t.a == 1; }))
        channels.erase(channels.begin());
    return exrFile(kSide, kSide, channels);
}

std::string exrBytes(const Texels& texels) {
    return exrOf(texels, [](float c) { return c; });
}
std::string signedExrBytes(const Texels& texels) {
    return exrOf(texels, [](float c) { return 2 * c - 1; });
}

struct Container {
    const char* file;
    const char* extension;  ///< glTF extension that refers to the file; null: none
    std::string (*bytes)(const Texels& texels);
};

const Container kContainers[] = {
    {"map.png", nullptr, pngBytes},
    {"map.ktx2", "KHR_texture_basisu",
     [](const Texels& texels) {
         Ktx2Parts parts{.format = 43, .width = kSide, .height = kSide, .levels = {rgbaBytes(texels)}};
         parts.transfer = 2;
         return ktx2File(parts);
     }},
    {"map.exr", nullptr, exrBytes},
    {"signed.exr", nullptr, signedExrBytes},
};

/// Writes model.gltf, a square with the map.
void writeModel(const TempFolder& folder, const std::string& map, const char* extension) {
    folder.write("square.mtl", "newmtl a\nnorm flat.png\n");
    folder.write("flat.png", std::string(kFlatPng, kFlatPng + sizeof kFlatPng));
    folder.write("square.obj",
                 "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                 "usemtl a\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
    ASSERT_EQ(runTool(folder, "generate -q square.obj -o model.gltf").exit_code, 0);
    Json model = Json::parse(folder.read("model.gltf"));
    model["images"][0] = {{"uri", map}};
    if (extension != nullptr) {
        model["textures"][0] = {{"extensions", {{extension, {{"source", 0}}}}}};
        model["extensionsUsed"] = model["extensionsRequired"] = {extension};
    }
    folder.write("model.gltf", model.dump());
}

double differenceOf(const FloatImage& image, const RgbImage& right) {
    double sum = 0;
    for (std::size_t i = 0; i < image.texels.size() && 3 * i < right.rgb.size(); ++i) {
        const float parts[] = {image.texels[i].x, image.texels[i].y, image.texels[i].z};
        for (std::size_t k = 0; k < 3; ++k)
            sum += std::fabs(static_cast<double>(parts[k]) - right.rgb[3 * i + k] / 255.0);
    }
    return sum / static_cast<double>(right.rgb.size());
}

/// Runs each command of all findings on a file. None may leave a finding, and the first command for the image of each
/// finding must restore it. `map`: file of the normal map.
void expectEachCommandFixesAll(const TempFolder& folder, const std::string& file, const std::string& map,
                               const RgbImage& right, const std::string& what) {
    for (const Json& finding : findingsIn(folder, file)) {
        const std::string title = what + ", " + file + ", " + finding["code"].get<std::string>();
        bool is_restored = false;
        for (const Json& command : finding["commands"]) {
            std::string line = command["line"].get<std::string>().substr(std::string("tspace ").size());
            if (line.find("--high") != std::string::npos) continue;
            const bool is_of_model = line.rfind("generate", 0) == 0;
            if (const std::size_t at = line.find("MAP"); at != std::string::npos) line.replace(at, 3, map);
            if (is_of_model) line += " " + file + " -o fixed/model.gltf";
            const ToolRun run = runTool(folder, line);
            ASSERT_EQ(run.exit_code, 0) << title << ": " << line << run.err;
            Json rest = findingsIn(folder, is_of_model ? "fixed/model.gltf" : "OUT.png");
            for (Json& one : rest) one = one["code"];
            EXPECT_EQ(rest, Json::array()) << title << ": " << line;
            is_restored = is_restored || (!is_of_model && differenceOf(imageIn(folder, "OUT.png"), right) < 0.01);
            std::filesystem::remove_all(folder.path("fixed"));
        }
        // In a model, the command for inverted green inverts it in the model, and the command for the image red.
        EXPECT_TRUE(is_restored || finding["code"] == "greenFlipped") << title;
    }
}

TEST(MapRemedies, EachCommandFixesAllFaultsOfAMap) {
    const bool has_exr = whyNotRead(ImageFormat::exr) == nullptr;
    const RgbImage right = normalMapOf(kSide, bumpsApart);
    for (const ChannelFault& fault : kChannelFaults) {
        for (const auto& [curve_name, curve] : kCurves) {
            for (const bool is_down : {false, true}) {
                const RgbImage from = normalMapOf(kSide, bumpsApart, is_down);
                Texels texels;
                for (std::size_t i = 0; i < from.rgb.size(); i += 3) {
                    const auto part = [&](std::size_t k) { return static_cast<float>(from.rgb[i + k]) / 255; };
                    Texel texel = fault.store(part(0), part(1), part(2));
                    for (float* c : {&texel.r, &texel.g, &texel.b}) *c = curve(*c);
                    texels.push_back(texel);
                }
                for (const Container& container : kContainers) {
                    const std::string name = container.file;
                    // A few pairs suffice for containers that are read by the code for PNG, and for inverted green.
                    const bool is_linear = curve == sameCurve;
                    const bool is_needed = name == "map.png"    ? !is_down || is_linear || fault.has_alpha
                                           : name == "map.ktx2" ? is_linear
                                                                : has_exr && is_linear && fault.has_alpha && !is_down;
                    if (!is_needed) continue;
                    const TempFolder folder;
                    const std::string what =
                        std::string(fault.name) + ", " + curve_name + (is_down ? ", green down, " : ", ") + name;
                    folder.write(name, container.bytes(texels));
                    const bool is_sound = name == "map.png" && is_linear && !is_down && fault.is_small;
                    EXPECT_EQ(findingsIn(folder, name).empty(), is_sound) << what;
                    expectEachCommandFixesAll(folder, name, name, right, what);
                    writeModel(folder, name, container.extension);
                    expectEachCommandFixesAll(folder, "model.gltf", name, right, what);
                }
            }
        }
    }
}

}  // namespace
}  // namespace tspace::test
