// SPDX-License-Identifier: MIT
// Runs each command that check prints as a remedy, as a user would. Its finding must disappear, and no new finding may
// appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "model/model_files.h"
#include "tool/faulty_models.h"
#include "tool/model_images.h"
#include "tool/normal_models.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;
using Places = std::set<std::pair<std::string, std::string>>;  // (code, place) of findings

std::string inQuotes(const std::string& path) { return "'" + path + "'"; }

/// Returns the findings of a file, or an empty list if it cannot be read. Checks that the text output contains every
/// remedy, and that messages consist of an optional symptom and the cause.
Json findingsOf(const TempFolder& folder, const std::string& file) {
    const ToolRun run = runTool(folder, "check --json --fail-on error " + inQuotes(file));
    const Json report = Json::parse(run.out, nullptr, false);
    if (!report.is_object() || !report["files"][0].contains("findings")) return {};
    const std::string text = runTool(folder, "check " + inQuotes(file)).out;
    for (const Json& finding : report["files"][0]["findings"]) {
        EXPECT_NE(text.find(finding["remedy"]), std::string::npos) << finding["remedy"];
        const std::string message = finding["message"], cause = finding["cause"];
        EXPECT_FALSE(cause.empty()) << message;
        EXPECT_TRUE(message == cause || message.ends_with(": " + cause)) << message << "\n" << cause;
    }
    return report["files"][0]["findings"];
}

/// A command that a remedy names, without the word "tspace".
struct NamedCommand {
    std::string line;
    /// contains a placeholder for something that the file does not contain, such as the high poly
    bool needs_more = false;

    bool operator<(const NamedCommand& other) const { return line < other.line; }
};

/// Returns the commands of a finding. Checks that every command line in its remedy is one of them.
std::vector<NamedCommand> commandsOf(const Json& finding) {
    const std::string start = "tspace ", remedy = finding["remedy"];
    std::vector<NamedCommand> commands;
    std::size_t at = 0;
    for (const Json& command : finding["commands"]) {
        const std::string line = command["line"];
        EXPECT_EQ(remedy.find(start, at), remedy.find(line, at)) << remedy;
        at = remedy.find(line, at) + line.size();
        static const std::set<std::string> kKnown = {"MAP", "OUT.png", "MODEL", "S"};
        const Json& words = command["placeholders"];
        const bool needs_more =
            std::any_of(words.begin(), words.end(), [](const Json& word) { return !kKnown.contains(word); });
        commands.push_back({line.substr(start.size()), needs_more});
    }
    EXPECT_EQ(remedy.find(start, at), std::string::npos) << remedy;
    return commands;
}

/// Returns the findings without notes that need no action. Worse findings at the same place hide such notes: for
/// example, normals that point to the back of their triangles are not compared with them.
Json withoutHarmless(const Json& findings) {
    Json rest = Json::array();
    for (const Json& finding : findings) {
        const bool may_be_meant = finding["remedy"].get<std::string>().rfind("No action is needed", 0) == 0;
        if (finding["severity"] != "note" || !may_be_meant) rest.push_back(finding);
    }
    return rest;
}

Places placesOf(const Json& findings, bool with_place) {
    Places places;
    for (const Json& finding : findings)
        places.emplace(finding["code"], with_place ? finding["place"].get<std::string>() : "");
    return places;
}

/// Prefix of the names of generated models.
constexpr const char* kMade = "made/";

class Advice : public testing::TestWithParam<std::string> {
  public:
    void SetUp() override {
        if (GetParam().empty()) GTEST_SKIP() << "test data is missing";
        input_ = std::filesystem::absolute(shared(GetParam())).string();
        for (const FaultyModel& model : faultyModels()) {
            if (GetParam() == kMade + std::string(model.name)) input_ = writeFaulty(folder_, model);
        }
        for (const SheetFault& fault : sheetFaults()) {
            if (GetParam() != kMade + std::string(fault.name)) continue;
            Sheet sheet = bentSheetWithTangents();
            fault.apply(sheet);
            input_ = writeSheet(folder_, "sheet.gltf", sheet);
        }
        const std::string extension = lowerExtension(input_);
        is_gltf_ = extension == ".glb" || extension == ".gltf" || extension == ".vrm";
        output_ = "out/o" + (is_gltf_ ? extension : ".glb");
    }

    /// Runs a command that writes a model. Returns whether it succeeded.
    bool runOnModel(const std::string& command) {
        const ToolRun run = runTool(folder_, command + " " + inQuotes(input_) + " -o " + inQuotes(output_));
        EXPECT_EQ(run.exit_code, 0) << command << ": " << run.err;
        return run.exit_code == 0;
    }

    /// Runs a command on each image that the findings are about, and stores the new images in a copy of the model.
    /// Returns whether it succeeded.
    bool runOnImages(const std::string& command, const Json& findings) {
        ModelImages model(input_);
        model.copyFiles(folder_.path("out"));
        std::set<std::size_t> images;
        for (const Json& finding : findings) images.insert(model.imageAt(finding["place"]));
        for (const std::size_t image : images) {
            folder_.write("out/MAP", model.read(image));
            std::istringstream words(command);
            std::string arguments;
            for (std::string word; words >> word;) {
                const bool is_input = arguments.find(' ') == std::string::npos && !arguments.empty();
                arguments += (arguments.empty() ? "" : " ") + (is_input          ? "out/MAP"
                                                               : word == "MODEL" ? inQuotes(input_)
                                                               : word == "S"     ? "0.1"
                                                                                 : word);
            }
            const ToolRun run = runTool(folder_, arguments);
            EXPECT_EQ(run.exit_code, 0) << arguments << ": " << run.err;
            if (run.exit_code != 0) return false;
            model.replace(image, folder_.read("OUT.png"));
        }
        folder_.write(output_, model.file());
        return true;
    }

  protected:
    TempFolder folder_;
    std::string input_, output_;
    bool is_gltf_ = false;
};

TEST_P(Advice, FixesItsFindingAndCausesNoNewOne) {
    const Json before = findingsOf(folder_, input_);
    std::map<NamedCommand, Json> commands;  // each command, with the findings that name it
    for (const Json& finding : before) {
        for (const NamedCommand& command : commandsOf(finding)) commands[command].push_back(finding);
    }
    for (const auto& [named, findings] : commands) {
        if (named.needs_more) continue;
        const std::string& command = named.line;
        std::filesystem::create_directories(folder_.path("out"));
        const bool is_of_model = command.rfind("generate", 0) == 0;
        // In other formats, materials refer to images in other ways.
        if (!is_of_model && !is_gltf_) continue;
        if (is_of_model ? !runOnModel(command) : !runOnImages(command, findings)) continue;
        // Models of other formats become glTF, in which places have other names.
        const Json after = findingsOf(folder_, output_);
        Places old = placesOf(before, is_gltf_);
        const Places now = placesOf(after, is_gltf_);
        // glTF cannot reference an image that does not exist, so the new material has no normal map.
        if (!is_gltf_ && old.contains({"normalMapUnreadable", ""})) old.insert({"tangentsUnused", ""});
        for (const auto& [code, place] : placesOf(findings, is_gltf_))
            EXPECT_FALSE(now.contains({code, place})) << command << " does not mend " << code << " at " << place;
        for (const auto& [code, place] : placesOf(withoutHarmless(after), is_gltf_))
            EXPECT_TRUE(old.contains({code, place})) << command << " makes " << code << " at " << place;
        std::filesystem::remove_all(folder_.path("out"));
    }
}

#ifdef TSPACE_EVERY_MODEL
/// Returns all models of the shared data.
std::vector<std::string> models() {
    std::vector<std::string> names;
    for (const std::string folder : {"models", "reports", "bad"}) {
        if (!std::filesystem::exists(shared(folder))) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared(folder))) {
            static const std::set<std::string> kExtensions = {".glb", ".gltf", ".vrm", ".obj"};
            const std::string name = std::filesystem::relative(entry.path(), shared("")).generic_string();
            if (name.rfind("models/perf", 0) != 0 && kExtensions.contains(lowerExtension(entry.path())))
                names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    if (names.empty()) names.emplace_back();
    return names;
}
#else
/// Returns small models that together have each finding whose remedy is a command.
std::vector<std::string> models() {
    std::vector<std::string> names;
    for (const std::string name : {
             "models/derived/AnimatedMorphCube_quantized.glb",             // morphNormalsMissing
             "models/features/DracoSparseMesh/DracoSparseMesh.gltf",       // tangentsUnused
             "models/khronos/AnisotropyBarnLamp/AnisotropyBarnLamp.gltf",  // signsMixed, mirroredSeamAveraged
             "reports/aniso_normal_rot90_tan.glb",                         // textureTransformIgnored
             "reports/box_degenerate_zero.glb",                            // tangentsNotUnit
             "reports/green_dx.glb",                                       // greenFlipped
             "reports/map_dxt5nm.glb",                                     // normalMapChannels
             "reports/map_height.glb",                                     // normalMapIsHeight
             "reports/map_object.glb",                                     // normalMapInObjectSpace
             "reports/map_srgb.glb",                                       // normalMapIsSrgb
             "reports/map_swapped_rb.glb",                                 // normalMapChannels
             "reports/map_xy_blue0.glb",                                   // normalMapTwoChannels
             "reports/morph_normal_is_position.glb",                       // morphNormalsWrong, morphTangentsWrong
             "reports/pillar_smoothed.glb",                                // normalsFarFromFaces
             "reports/second/foliage_tan.glb",                             // normalsAgainstWinding
             "reports/second/img_turned90.glb",                            // normalMapChannels
             "reports/second/lone.gltf",                                   // greenFlipped, tangentsMissing
             "reports/second/map_hemioct.glb",                             // normalMapTwoChannels
             "reports/second/vrm1_w_bad_nounlit.vrm",                      // signsInverted
             "reports/stride3.glb",                                        // signsNotOne
             "reports/tangent_vec3.glb",                                   // tangentsUnreadable
             "reports/tangent_zup.glb",                                    // directionsWrong
             "reports/two_prims_bare.glb",                                 // normalsMissing
             "reports/winding16.glb",                                      // normalsAgainstWinding
         }) {
        if (std::filesystem::exists(shared(name))) names.push_back(name);
    }
    for (const FaultyModel& model : faultyModels()) names.push_back(kMade + std::string(model.name));
    for (const SheetFault& fault : sheetFaults()) names.push_back(kMade + std::string(fault.name));
    return names;
}
#endif

INSTANTIATE_TEST_SUITE_P(Models, Advice, testing::ValuesIn(models()),
                         [](const auto& model) { return testName(model.param); });

}  // namespace
}  // namespace tspace::test
