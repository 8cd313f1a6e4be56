// SPDX-License-Identifier: MIT
// Compares the C file API with the tool (bytes, JSON and messages must be equal), and tests its errors for models in
// memory.
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "api/made_bytes.h"
#include "model/json/json.h"
#include "support/shared_data.h"
#include "tool/run_tool.h"

namespace tspace::test {
namespace {

/// A model in memory, with the other files of its folder.
class MemoryModel {
  public:
    MemoryModel(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

    static MemoryModel ofFile(const std::filesystem::path& path) {
        const auto read = [](const std::filesystem::path& file) {
            std::ostringstream text;
            text << std::ifstream(file, std::ios::binary).rdbuf();
            return text.str();
        };
        MemoryModel model(path.filename().string(), read(path));
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path.parent_path())) {
            if (entry.is_regular_file())
                model.files[entry.path().lexically_relative(path.parent_path()).generic_string()] = read(entry.path());
        }
        return model;
    }

    /// Returns a view of the model, which is valid as long as this object is not moved.
    [[nodiscard]] tspace_Model view(bool with_files = true) {
        tspace_Model model;
        TSPACE_INIT(model);
        model.data = reinterpret_cast<const std::uint8_t*>(bytes_.data());
        model.size = bytes_.size();
        model.name = name_.c_str();
        if (with_files) model.find_file = find;
        model.user = this;
        return model;
    }

    std::map<std::string, std::string> files = {};
    std::vector<std::string> asked = {};
    tspace_ErrorCode fail_with = TSPACE_OK;  ///< returned for every file if not TSPACE_OK

  private:
    static tspace_ErrorCode find(void* user, const char* path, const std::uint8_t** data, std::size_t* size) {
        auto& self = *static_cast<MemoryModel*>(user);
        self.asked.emplace_back(path);
        if (self.fail_with != TSPACE_OK) return self.fail_with;
        const auto found = self.files.find(path);
        if (found == self.files.end()) return TSPACE_ERROR_CANNOT_READ;
        *data = reinterpret_cast<const std::uint8_t*>(found->second.data());
        *size = found->second.size();
        return TSPACE_OK;
    }

    std::string name_, bytes_;
};

std::vector<std::filesystem::path> someModels() {
    std::vector<std::filesystem::path> models;
    for (const char* name :
         {"models/khronos/NormalTangentTest.glb", "models/khronos/Suzanne/Suzanne.gltf", "models/obj/spot.obj",
          "models/khronos/AnimatedMorphCube.glb", "models/features/BoxTextured_meshopt.glb",
          "models/khronos/SimpleSparseAccessor.gltf", "models/khronos/Lantern.glb"}) {
        models.push_back(shared(name));
    }
    return models;
}

#define NEEDS_MODELS TSPACE_NEEDS_SHARED("models/khronos/NormalTangentTest.glb")

TEST(CFiles, GenerateWritesTheBytesAndTheReportOfTheTool) {
    NEEDS_MODELS;
    for (const std::filesystem::path& model : someModels()) {
        SCOPED_TRACE(model);
        const TempFolder folder;
        const ToolRun run =
            runTool(folder, "generate '" + model.string() + "' -o out.glb --all --json --normals angle");
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const std::string bytes = folder.read("out.glb");
        std::filesystem::current_path(folder.path());
        std::filesystem::remove("out.glb");
        Made report;
        tspace_Error error;
        ASSERT_EQ(tspace_generateFile(model.c_str(), "out.glb", R"({"all": true, "normals": "angle"})", &report.bytes,
                                      &error),
                  TSPACE_OK)
            << error.message;
        EXPECT_TRUE(folder.read("out.glb") == bytes);
        EXPECT_EQ(withoutSeconds(report.text()), withoutSeconds(run.out));

        MemoryModel in_memory = MemoryModel::ofFile(model);
        const tspace_Model view = in_memory.view();
        Made output, memory_report;
        ASSERT_EQ(tspace_generateBytes(&view, R"({"all": true, "normals": "angle"})", &output.bytes,
                                       &memory_report.bytes, &error),
                  TSPACE_OK)
            << error.message;
        EXPECT_TRUE(output.text() == bytes);
        EXPECT_EQ(Json::parse(memory_report.text()).at("files")[0].at("totals").dump(),
                  Json::parse(run.out).at("files")[0].at("totals").dump());
    }
}

TEST(CFiles, ReportsOfOtherCallsAreThoseOfTheTool) {
    NEEDS_MODELS;
    for (const std::filesystem::path& model : someModels()) {
        SCOPED_TRACE(model);
        const TempFolder folder;
        const std::string path = model.string();
        const auto expectToolsReport = [&](const std::string& command, const Made& report) {
            EXPECT_EQ(report.text(), runTool(folder, command + " --json").out) << command;
        };
        Made check, inspect, identify, diff;
        ASSERT_EQ(
            tspace_checkFile(path.c_str(), R"({"severity": "warning", "ignore": ["tangentsUnused", "uvsMissing"]})",
                             &check.bytes, nullptr),
            TSPACE_OK);
        expectToolsReport("check '" + path + "' --severity warning --ignore tangentsUnused,uvsMissing", check);
        ASSERT_EQ(tspace_inspectFile(path.c_str(), nullptr, &inspect.bytes, nullptr), TSPACE_OK);
        expectToolsReport("inspect '" + path + "'", inspect);
        ASSERT_EQ(tspace_identifyFile(path.c_str(), R"({"tolerance": 0.5})", &identify.bytes, nullptr), TSPACE_OK);
        expectToolsReport("identify '" + path + "' --tolerance 0.5", identify);
        ASSERT_EQ(tspace_diffFiles(path.c_str(), path.c_str(), R"({"worst": 3})", &diff.bytes, nullptr), TSPACE_OK);
        expectToolsReport("diff '" + path + "' '" + path + "' --worst 3", diff);
    }
}

TEST(CFiles, BytesGiveTheReportsOfFiles) {
    NEEDS_MODELS;
    for (const std::filesystem::path& model : someModels()) {
        SCOPED_TRACE(model);
        MemoryModel in_memory = MemoryModel::ofFile(model);
        const tspace_Model view = in_memory.view();
        const auto expectEqual = [&](const Made& bytes, const Made& file) {
            std::string text = file.text();
            for (std::size_t at; (at = text.find(model.string())) != std::string::npos;)
                text.replace(at, model.string().size(), model.filename().string());
            EXPECT_EQ(bytes.text(), text);
        };
        Made bytes[4], files[4];
        EXPECT_EQ(tspace_checkBytes(&view, nullptr, &bytes[0].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_checkFile(model.c_str(), nullptr, &files[0].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_inspectBytes(&view, nullptr, &bytes[1].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_inspectFile(model.c_str(), nullptr, &files[1].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_identifyBytes(&view, nullptr, &bytes[2].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_identifyFile(model.c_str(), nullptr, &files[2].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_diffBytes(&view, &view, nullptr, &bytes[3].bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(tspace_diffFiles(model.c_str(), model.c_str(), nullptr, &files[3].bytes, nullptr), TSPACE_OK);
        for (int i = 0; i < 4; ++i) expectEqual(bytes[i], files[i]);
    }
}

TEST(CFiles, AnObjAndItsMaterialsAndMapsComeFromMemory) {
    const TempFolder folder;
    writeFoldedObj(folder, "folded.obj");
    writeBumpMap(folder);
    const std::string path = folder.path("folded.obj").string();
    ASSERT_EQ(runTool(folder, "generate folded.obj -q -o folder/out.glb").exit_code, 0);
    MemoryModel model = MemoryModel::ofFile(path);
    const tspace_Model view = model.view();
    Made output;
    tspace_Error error;
    ASSERT_EQ(tspace_generateBytes(&view, nullptr, &output.bytes, nullptr, &error), TSPACE_OK) << error.message;
    EXPECT_TRUE(output.text() == folder.read("folder/out.glb"));
    // The model is valid even without its material library.
    const tspace_Model alone = model.view(false);
    Made plain;
    EXPECT_EQ(tspace_generateBytes(&alone, R"({"all": true})", &plain.bytes, nullptr, &error), TSPACE_OK)
        << error.message;
}

/// Returns one triangle; its buffer is "b/the bytes.bin", and it has a normal map if `image` is not empty.
std::string triangleModel(const std::string& buffer_uri, const std::string& image = "") {
    std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"uri": ")" + buffer_uri + R"(", "byteLength": 96}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "material": 0}]}],)";
    if (!image.empty())
        text += R"("images": [{"uri": ")" + image + R"("}], "textures": [{"source": 0}],
                   "materials": [{"normalTexture": {"index": 0}}]})";
    else
        text += R"("materials": [{}]})";
    return text;
}

std::string triangleBytes() {
    const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    return {reinterpret_cast<const char*>(values), sizeof(values)};
}

TEST(CFilesInMemory, PathsAreDecodedAndHaveSlashes) {
    MemoryModel model("a.gltf", triangleModel("./b\\\\the%20bytes.bin", "maps/n.png"));
    model.files = {{"b/the bytes.bin", triangleBytes()},
                   {"maps/n.png", std::string(std::begin(kFlatPng), std::end(kFlatPng))}};
    const tspace_Model view = model.view();
    Made output;
    tspace_Error error;
    ASSERT_EQ(tspace_generateBytes(&view, nullptr, &output.bytes, nullptr, &error), TSPACE_OK) << error.message;
    EXPECT_EQ(std::set<std::string>(model.asked.begin(), model.asked.end()),
              (std::set<std::string>{"b/the bytes.bin", "maps/n.png"}));
    EXPECT_NE(output.text().find("IHDR"), std::string::npos) << "the image goes into the GLB";
}

TEST(CFilesInMemory, AnOutputHasTheNameOfItsModel) {
    for (const auto& [name, output] : {std::pair("a.b/c", "a.b/c.glb"), std::pair("c.gltf", "c.glb"),
                                       std::pair("c", "c.glb"), std::pair("", "model.glb")}) {
        MemoryModel model(name, triangleModel("b.bin"));
        model.files = {{"b.bin", triangleBytes()}};
        const tspace_Model view = model.view();
        Made bytes, report;
        ASSERT_EQ(tspace_generateBytes(&view, nullptr, &bytes.bytes, &report.bytes, nullptr), TSPACE_OK);
        EXPECT_EQ(Json::parse(report.text()).at("files")[0].at("output").text(), output);
    }
}

TEST(CFilesInMemory, AMissingBufferIsAnErrorWithItsLocation) {
    MemoryModel model("a.gltf", triangleModel("b.bin"));
    tspace_Error error;
    for (const bool has_callback : {true, false}) {
        const tspace_Model view = model.view(has_callback);
        Made output, report;
        EXPECT_EQ(tspace_generateBytes(&view, nullptr, &output.bytes, &report.bytes, &error),
                  TSPACE_ERROR_INVALID_FILE);
        EXPECT_NE(std::string(error.message).find("'b.bin'"), std::string::npos) << error.message;
        EXPECT_NE(std::string(error.message).find("(at /buffers/0/uri)"), std::string::npos) << error.message;
        EXPECT_TRUE(output.isEmpty() && report.isEmpty());
    }
}

TEST(CFilesInMemory, AMissingImageStaysExternal) {
    MemoryModel model("a.gltf", triangleModel("b.bin", "n.png"));
    model.files = {{"b.bin", triangleBytes()}};
    const tspace_Model view = model.view();
    Made output, report;
    ASSERT_EQ(tspace_generateBytes(&view, nullptr, &output.bytes, &report.bytes, nullptr), TSPACE_OK);
    const Json warnings = Json::parse(report.text()).at("files")[0].at("warnings");
    ASSERT_FALSE(warnings.empty());
    EXPECT_EQ(warnings[0].text(),
              "the image 'n.png' was not embedded in the GLB, and its URI was kept: it does not exist");
}

TEST(CFilesInMemory, AnErrorOfTheCallerEndsTheCallWithItsCode) {
    for (const tspace_ErrorCode code : std::initializer_list<tspace_ErrorCode>{
             TSPACE_ERROR_INTERNAL, TSPACE_ERROR_OUT_OF_MEMORY, TSPACE_ERROR_TOO_LARGE, 4711}) {
        MemoryModel model("a.gltf", triangleModel("b.bin"));
        model.fail_with = code;
        const tspace_Model view = model.view();
        Made output, report;
        tspace_Error error;
        EXPECT_EQ(tspace_generateBytes(&view, nullptr, &output.bytes, &report.bytes, &error), code);
        EXPECT_STREQ(error.message, "find_file failed for the file 'b.bin'");
        EXPECT_TRUE(output.isEmpty() && report.isEmpty());
        EXPECT_EQ(tspace_checkBytes(&view, nullptr, &report.bytes, &error), code);
    }
}

TEST(CFilesInMemory, AnErrorOfTheCallerEndsTheCallForImagesToo) {
    std::string text = triangleModel("b.bin", "n.png");
    struct State {
        std::string bytes = triangleBytes();
    } state;
    tspace_Model view = MemoryModel("", "").view();
    view.data = reinterpret_cast<const std::uint8_t*>(text.data());
    view.size = text.size();
    view.name = "a.gltf";
    view.user = &state;
    view.find_file = [](void* user, const char* path, const std::uint8_t** data,
                        std::size_t* size) -> tspace_ErrorCode {
        if (std::string(path) != "b.bin") return TSPACE_ERROR_INTERNAL;
        *data = reinterpret_cast<const std::uint8_t*>(static_cast<State*>(user)->bytes.data());
        *size = static_cast<State*>(user)->bytes.size();
        return TSPACE_OK;
    };
    Made output, report;
    EXPECT_EQ(tspace_checkBytes(&view, nullptr, &report.bytes, nullptr), TSPACE_ERROR_INTERNAL);
    EXPECT_EQ(tspace_generateBytes(&view, R"({"flip-green": true})", &output.bytes, nullptr, nullptr),
              TSPACE_ERROR_INTERNAL);
}

TEST(CFilesInMemory, FilesOutsideTheModelsFolderAreNotRequested) {
    for (const char* uri : {"../b.bin", "/b.bin", "b/../../b.bin", "%2e%2e/b.bin", "http://a.b/b.bin", "..\\\\b.bin"}) {
        MemoryModel model("a.gltf", triangleModel(uri));
        const tspace_Model view = model.view();
        EXPECT_EQ(tspace_inspectBytes(&view, nullptr, nullptr, nullptr), TSPACE_ERROR_FORBIDDEN_PATH) << uri;
        EXPECT_TRUE(model.asked.empty()) << uri;
    }
    MemoryModel model("a.gltf", triangleModel("../b.bin"));
    model.files = {{"../b.bin", triangleBytes()}};
    const tspace_Model view = model.view();
    EXPECT_EQ(tspace_inspectBytes(&view, R"({"allow-external": true})", nullptr, nullptr), TSPACE_OK);
}

TEST(CFilesInMemory, MalformedBytesCauseAnErrorAndNoOutput) {
    NEEDS_MODELS;
    std::ifstream file(shared("models/khronos/AnimatedMorphCube.glb"), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        std::string broken = bytes;
        if (i % 2 == 0) broken.resize(random() % broken.size());
        for (int k = 0; k < 20 && !broken.empty(); ++k)
            broken[random() % std::min<std::size_t>(broken.size(), 4000)] = static_cast<char>(random());
        MemoryModel model("a.glb", broken);
        const tspace_Model view = model.view();
        Made output, report;
        tspace_Error error;
        const tspace_ErrorCode code =
            tspace_generateBytes(&view, R"({"all": true})", &output.bytes, &report.bytes, &error);
        EXPECT_NE(code, TSPACE_ERROR_INTERNAL) << error.message;
        EXPECT_EQ(code != TSPACE_OK, output.isEmpty());
        EXPECT_EQ(code != TSPACE_OK, report.isEmpty());
    }
}

TEST(CFilesOptions, InvalidOptionsHaveTheMessagesOfTheTool) {
    struct Wrong {
        const char* json;
        const char* command_line;
    };
    for (const Wrong& wrong : {Wrong{R"({"methd": "best"})", "--methd best"},
                               {R"({"method": "bset"})", "--method bset"},
                               {R"({"crease": 181})", "--crease 181"},
                               {R"({"crease": "x"})", "--crease x"},
                               {R"({"refine": 3})", "--refine 3"},
                               {R"({"strip": true, "all": true})", "--strip --all"},
                               {R"({"pack-drop": "all"})", "--pack-drop all"},
                               {R"({"memory-limit": 5})", "--memory-limit 5"},
                               {R"({"frame": "symmetric"})", "--frame symmetric"}}) {
        const ToolRun run = runTool(TempFolder(), std::string("generate a.glb -o b.glb ") + wrong.command_line);
        tspace_Error error;
        EXPECT_EQ(tspace_generateFile("a.glb", "b.glb", wrong.json, nullptr, &error), TSPACE_ERROR_INVALID_OPTION);
        EXPECT_EQ(run.err, "tspace: " + std::string(error.message) + " (see tspace generate --help)\n");
    }
}

TEST(CFilesOptions, UnknownOptionsAreRejected) {
    const auto messageOf = [](const char* json) {
        tspace_Error error;
        EXPECT_EQ(tspace_generateFile("a.glb", "b.glb", json, nullptr, &error), TSPACE_ERROR_INVALID_OPTION) << json;
        return std::string(error.message);
    };
    EXPECT_EQ(messageOf("[]"), "the options must be a JSON object");
    EXPECT_EQ(messageOf("{"), "the options cannot be read: the JSON has a syntax error (at byte 2)");
    EXPECT_EQ(messageOf(R"({"all": 1})"), "--all must be true or false");
    EXPECT_EQ(messageOf(R"({"all": "true"})"), "--all must be true or false");
    EXPECT_EQ(messageOf(R"({"method": true})"), "--method needs a value: NAME");
    EXPECT_EQ(messageOf(R"({"method": ["best"]})"), "--method needs a value: NAME");
    EXPECT_EQ(messageOf(R"({"method": {}})"), "--method needs a value: NAME");
    EXPECT_EQ(messageOf(R"({"output": "c.glb"})").rfind("unknown option '--output'", 0), 0u);
    EXPECT_EQ(messageOf(R"({"a\nb": 1})").find('\n'), std::string::npos);
}

TEST(CFilesNull, ARequiredArgumentThatIsNullIsAnError) {
    tspace_Error error;
    tspace_Bytes output;
    tspace_Model model;
    TSPACE_INIT(model);
    EXPECT_EQ(tspace_generateFile(nullptr, "b.glb", nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_generateFile("a.glb", nullptr, nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_generateBytes(nullptr, nullptr, &output, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_generateBytes(&model, nullptr, &output, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_generateBytes(&model, nullptr, nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_checkFile(nullptr, nullptr, nullptr, nullptr), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_diffFiles("a.glb", nullptr, nullptr, nullptr, nullptr), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_diffBytes(&model, nullptr, nullptr, nullptr, nullptr), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(tspace_flipGreenBytes(nullptr, 0, nullptr, &output, nullptr, nullptr), TSPACE_ERROR_NULL_DATA);
    model.struct_size = 4;
    EXPECT_EQ(tspace_checkBytes(&model, nullptr, nullptr, &error), TSPACE_ERROR_INVALID_OPTION);
}

TEST(CFilesDiff, ErrorsNameTheModel) {
    MemoryModel good("a.gltf", triangleModel("b.bin")), bad("b.glb", "glTF");
    good.files = {{"b.bin", triangleBytes()}};
    const tspace_Model a = good.view(), b = bad.view();
    tspace_Error error;
    EXPECT_EQ(tspace_diffBytes(&a, &b, nullptr, nullptr, &error), TSPACE_ERROR_INVALID_FILE);
    EXPECT_EQ(error.element, 1u);
    EXPECT_EQ(tspace_diffBytes(&b, &a, nullptr, nullptr, &error), TSPACE_ERROR_INVALID_FILE);
    EXPECT_EQ(error.element, 0u);
}

/// Checks that a function that writes out.png from bump.png gives the same bytes and report as the tool's `command`,
/// and reports errors.
template <class Function>
void expectFilesOfTheTool(Function* make, const std::string& command, const char* options, const char* unknown) {
    const TempFolder folder;
    writeBumpMap(folder);
    writeFoldedObj(folder, "wall.obj");
    const ToolRun run = runTool(folder, command + " --json");
    if (run.exit_code != 0) GTEST_SKIP() << run.err;
    const std::string bytes = folder.read("out.png");
    std::filesystem::current_path(folder.path());
    Made report;
    ASSERT_EQ(make("bump.png", "out.png", options, &report.bytes, nullptr), TSPACE_OK);
    EXPECT_EQ(report.text(), run.out);
    EXPECT_TRUE(folder.read("out.png") == bytes);
    tspace_Error error;
    EXPECT_EQ(make("none.png", "out.png", nullptr, nullptr, &error), TSPACE_ERROR_CANNOT_READ);
    EXPECT_EQ(make("bump.png", "out.jpg", nullptr, nullptr, &error), TSPACE_ERROR_INVALID_OPTION);
    EXPECT_EQ(make("bump.png", "out.png", unknown, nullptr, &error), TSPACE_ERROR_INVALID_OPTION);
    EXPECT_EQ(make(nullptr, "out.png", nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_EQ(make("bump.png", nullptr, nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    EXPECT_TRUE(folder.read("out.png") == bytes);
}

TEST(CFilesConvertMap, FilesAreThoseOfTheTool) {
    expectFilesOfTheTool(
        tspace_convertMapFile,
        "convert-map bump.png -o out.png --mesh wall.obj --to object --from-convention directx --bits 8",
        R"({"mesh":"wall.obj","to":"object","from-convention":"directx","bits":"8"})", R"({"into":"object"})");
}

TEST(CFilesConvertMap, CombinedOptionsAreApplied) {
    // The channels are inverted after all options are known, so both options apply. The option to-mesh (the model that
    // will use the map) is an error without the option mesh (the original model).
    expectFilesOfTheTool(tspace_convertMapFile, "convert-map bump.png -o out.png --flip-green --flip-red",
                         R"({"flip-green":true,"flip-red":true})", R"({"to-mesh":"wall.obj"})");
}

TEST(CFilesHeightToNormal, FilesAreThoseOfTheTool) {
    expectFilesOfTheTool(
        tspace_heightToNormalFile,
        "height-to-normal bump.png -o out.png --mesh wall.obj --strength 0.5 --clamp --convention directx --bits 8",
        R"({"mesh":"wall.obj","strength":0.5,"clamp":true,"convention":"directx","bits":"8"})", R"({"strong":1})");
}

TEST(CFilesCompressMap, FilesAndBytesAreThoseOfTheTool) {
    const TempFolder folder;
    writeBumpMap(folder);
    const ToolRun run = runTool(folder, "compress-map bump.png -o out.ktx2 --format rg8 --signed --json");
    if (run.exit_code != 0) GTEST_SKIP() << run.err;
    const std::string bytes = folder.read("out.ktx2"), image = folder.read("bump.png");
    std::filesystem::current_path(folder.path());
    const char* options = R"({"format":"rg8","signed":true})";
    Made report, output;
    ASSERT_EQ(tspace_compressMapFile("bump.png", "out.ktx2", options, &report.bytes, nullptr), TSPACE_OK);
    EXPECT_EQ(report.text(), run.out);
    EXPECT_TRUE(folder.read("out.ktx2") == bytes);
    ASSERT_EQ(tspace_compressMapBytes(reinterpret_cast<const std::uint8_t*>(image.data()), image.size(), options,
                                      &output.bytes, nullptr, nullptr),
              TSPACE_OK);
    EXPECT_TRUE(output.text() == bytes);
    tspace_Error error;
    EXPECT_EQ(tspace_compressMapFile("none.png", "out.dds", nullptr, nullptr, &error), TSPACE_ERROR_CANNOT_READ);
    EXPECT_EQ(tspace_compressMapFile("bump.png", "out.png", nullptr, nullptr, &error), TSPACE_ERROR_INVALID_OPTION);
    EXPECT_EQ(tspace_compressMapFile("bump.png", "out.dds", R"({"format":"uastc"})", nullptr, &error),
              TSPACE_ERROR_INVALID_OPTION);
    EXPECT_NE(std::string(error.message).find("basisu"), std::string::npos) << error.message;
    EXPECT_EQ(tspace_compressMapFile("bump.png", nullptr, nullptr, nullptr, &error), TSPACE_ERROR_NULL_DATA);
    Made nothing;
    EXPECT_EQ(tspace_compressMapBytes(nullptr, 0, nullptr, &nothing.bytes, nullptr, &error), TSPACE_ERROR_NULL_DATA);
}

TEST(CFilesFlipGreen, FilesAndBytesAreThoseOfTheTool) {
    const TempFolder folder;
    writeBumpMap(folder);
    const ToolRun run = runTool(folder, "flip-green bump.png -o out.png --json");
    if (run.exit_code != 0) GTEST_SKIP() << run.err;
    const std::string bytes = folder.read("out.png"), image = folder.read("bump.png");
    std::filesystem::current_path(folder.path());
    Made report, output, memory_report;
    ASSERT_EQ(tspace_flipGreenFile("bump.png", "out.png", nullptr, &report.bytes, nullptr), TSPACE_OK);
    EXPECT_EQ(report.text(), run.out);
    EXPECT_TRUE(folder.read("out.png") == bytes);
    ASSERT_EQ(tspace_flipGreenBytes(reinterpret_cast<const std::uint8_t*>(image.data()), image.size(), "{}",
                                    &output.bytes, &memory_report.bytes, nullptr),
              TSPACE_OK);
    EXPECT_TRUE(output.text() == bytes);
}

}  // namespace
}  // namespace tspace::test
