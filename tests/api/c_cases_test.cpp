// SPDX-License-Identifier: MIT
// The C API with the cases that all languages share: tests/cases/arrays.json.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/c_api/struct_fields.h"

namespace tspace::test {
namespace {

using Json = nlohmann::json;

/// Returns an option as a number. `type`: the name of the option's enum in C.
double numberOf(const Json& value, const char* type) {
    if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
    return value.is_string() ? kEnumerators.at(type).at(value.get<std::string>()) : value.get<double>();
}

template <class T>
std::vector<T> listOf(const Json& object, const std::string& name) {
    std::vector<T> list;
    for (const Json& number : object.value(name, Json::array())) list.push_back(static_cast<T>(number.get<double>()));
    return list;
}

/// The arrays of a test case, and a mesh that refers to them.
struct CaseMesh {
    explicit CaseMesh(const Json& arrays)
        : positions(listOf<float>(arrays, "positions")), normals(listOf<float>(arrays, "normals")),
          uvs(listOf<float>(arrays, "uvs")), indices(listOf<std::uint32_t>(arrays, "indices")),
          normal_indices(listOf<std::uint32_t>(arrays, "normal_indices")),
          uv_indices(listOf<std::uint32_t>(arrays, "uv_indices")),
          face_sizes(listOf<std::uint32_t>(arrays, "face_sizes")) {
        TSPACE_INIT(mesh);
        mesh.positions = {positions.data(), positions.size() / 3, 0};
        mesh.normals = {normals.data(), normals.size() / 3, 0};
        mesh.uvs = {uvs.data(), uvs.size() / 2, 0};
        mesh.indices = view(indices);
        mesh.normal_indices = view(normal_indices);
        mesh.uv_indices = view(uv_indices);
        mesh.face_size = arrays.value("face_size", 3u);
        mesh.face_sizes = face_sizes.empty() ? nullptr : face_sizes.data();
        mesh.face_count = face_sizes.size();
    }
    static tspace_Indices view(const std::vector<std::uint32_t>& list) {
        return {list.data(), list.size(), list.empty() ? TSPACE_INDEX_NONE : TSPACE_INDEX_U32};
    }

    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices, normal_indices, uv_indices, face_sizes;
    tspace_Mesh mesh;
};

struct CaseCall {
    CaseCall(const Json& arrays, const Json& given) : arrays_(arrays), mesh(arrays_.mesh), options(given) {}

    /// Returns a struct with its default values, overwritten by the options of the test case.
    template <class Struct>
    Struct prepared() const {
        Struct made;
        TSPACE_INIT(made);
        set(made, options);
        return made;
    }
    template <class Struct>
    static void set(Struct& made, const Json& given) {
        visitFields(made, [&given](const char* name, const char* type, auto& field) {
            if (given.contains(name)) field = static_cast<std::decay_t<decltype(field)>>(numberOf(given[name], type));
        });
        if constexpr (requires { made.convention; }) {
            if (given.contains("convention"))
                tspace_findConvention(given["convention"].get<std::string>().c_str(), &made.convention, nullptr);
        }
    }

    template <class T>
    void keep(const std::string& name, const T* data, std::size_t count) {
        outputs[name].assign(data, data + count);
    }
    template <class T>
    void keep(const std::string& name, const std::vector<T>& list) {
        keep(name, list.data(), list.size());
    }
    template <class Struct>
    void keepReport(const std::string& name, Struct report) {
        visitFields(report,
                    [&](const std::string& field, const char*, auto& value) { keep(name + "." + field, &value, 1); });
    }

  private:
    CaseMesh arrays_;

  public:
    tspace_Mesh& mesh;
    const Json& options;
    tspace_Error error{};
    std::map<std::string, std::vector<double>> outputs;  // lists by name, fields of reports as "report.field"
};

tspace_TangentOptions tangentOptionsOf(const CaseCall& call) {
    auto made = call.prepared<tspace_TangentOptions>();
    // The C API rejects options in which both are 0, as uninitialized. No method uses both, so the unused one is set.
    if (made.angular_threshold_deg == 0 && made.refine == 0) {
        if (made.method == TSPACE_METHOD_BEST) made.angular_threshold_deg = 180;
        if (made.method != TSPACE_METHOD_BEST) made.refine = 1;
    }
    return made;
}

void runTangents(CaseCall& call) {
    const tspace_TangentOptions options = tangentOptionsOf(call);
    const std::size_t count =
        options.domain == TSPACE_DOMAIN_VERTEX ? call.mesh.positions.count : tspace_cornerCount(&call.mesh);
    std::vector<float> tangents(4 * count), bitangents(3 * count), s(count), t(count), posed(4 * count);
    std::vector<std::uint8_t> has(count);
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = {tangents.data(), count, 0};
    out.bitangents = {bitangents.data(), count, 0};
    out.magnitudes_s = {s.data(), count, 0};
    out.magnitudes_t = {t.data(), count, 0};
    out.has_tangent = {has.data(), count, 0};
    tspace_TangentReport report;
    TSPACE_INIT(report);
    if (tspace_generateTangents(&call.mesh, &options, &out, nullptr, &report, &call.error) != TSPACE_OK) return;
    call.keep("tangents", tangents);
    call.keep("bitangents", bitangents);
    call.keep("magnitudes_s", s);
    call.keep("magnitudes_t", t);
    call.keep("has_tangent", has);
    call.keepReport("report", report);

    tspace_TangentPlan* plan = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_planTangents(&call.mesh, &options, nullptr, &plan, nullptr));
    tspace_Pose pose;
    TSPACE_INIT(pose);
    pose.positions = call.mesh.positions;
    pose.normals = call.mesh.normals;
    out.tangents.data = posed.data();
    EXPECT_EQ(TSPACE_OK, tspace_evaluateTangents(plan, &pose, &out, nullptr, nullptr, nullptr));
    EXPECT_EQ(posed, tangents);
    tspace_destroyTangentPlan(plan);
}

void runNormals(CaseCall& call) {
    auto options = call.prepared<tspace_NormalOptions>();
    // The C API rejects options of zeros as uninitialized. `flat` is 0, and uses no other option, so an unused one is
    // set.
    if (options.weighting == TSPACE_NORMAL_WEIGHTING_FLAT && options.refine == 0) options.refine = 1;
    const auto groups = listOf<std::uint32_t>(call.options, "smoothing_groups");
    options.smoothing_groups = groups.empty() ? nullptr : groups.data();
    options.smoothing_group_count = groups.size();
    std::vector<float> normals(3 * tspace_cornerCount(&call.mesh));
    tspace_NormalReport report;
    TSPACE_INIT(report);
    const tspace_Span out = {normals.data(), normals.size() / 3, 0};
    tspace_generateNormals(&call.mesh, &options, out, nullptr, &report, &call.error);
    call.keep("normals", normals);
    call.keepReport("report", report);
}

void runPositionNoise(CaseCall& call) {
    tspace_PositionNoise report;
    TSPACE_INIT(report);
    tspace_measurePositionNoise(&call.mesh, nullptr, &report, &call.error);
    call.keepReport("report", report);
}

void runSanitize(CaseCall& call) {
    const auto options = call.prepared<tspace_SanitizeOptions>();
    auto tangents = listOf<float>(call.options, "tangents");
    tspace_SanitizeReport report;
    TSPACE_INIT(report);
    const tspace_Span span = {tangents.data(), tangents.size() / 4, 0};
    tspace_sanitizeTangents(&call.mesh, &options, span, nullptr, &report, &call.error);
    call.keep("tangents", tangents);
    call.keepReport("report", report);
}

void runIndexedFrames(CaseCall& call) {
    const tspace_TangentOptions tangents = tangentOptionsOf(call);
    auto options = call.prepared<tspace_IndexedFramesOptions>();
    options.tangents = &tangents;
    tspace_IndexedFrames* frames = nullptr;
    if (tspace_makeIndexedFrames(&call.mesh, &options, nullptr, &frames, &call.error) != TSPACE_OK) return;
    call.keep("indices", frames->indices, frames->corner_count);
    call.keep("source_vertices", frames->source_vertices, frames->vertex_count);
    call.keep("source_corners", frames->source_corners, frames->vertex_count);
    call.keep("normals", frames->normals, 3 * frames->vertex_count);
    call.keep("tangents", frames->tangents, 4 * frames->vertex_count);
    call.keepReport("tangents_report", *frames->tangent_report);
    if (frames->normal_report != nullptr) call.keepReport("normals_report", *frames->normal_report);
    if (frames->sanitize_report != nullptr) call.keepReport("sanitize_report", *frames->sanitize_report);
    tspace_destroyIndexedFrames(frames);
}

void runWinding(CaseCall& call) {
    const auto options = call.prepared<tspace_WindingOptions>();
    std::vector<std::uint8_t> turned(tspace_faceCount(&call.mesh));
    tspace_WindingReport report;
    TSPACE_INIT(report);
    tspace_mendWinding(&call.mesh, &options, turned.data(), turned.size(), nullptr, &report, &call.error);
    call.keep("turned", turned);
    call.keepReport("report", report);
}

void runTriangulate(CaseCall& call) {
    tspace_Triangulation* made = nullptr;
    if (tspace_triangulate(&call.mesh, &made, &call.error) != TSPACE_OK) return;
    call.keep("corners", made->corners, 3 * made->triangle_count);
    call.keep("faces", made->faces, made->triangle_count);
    tspace_destroyTriangulation(made);
}

void runSplit(CaseCall& call) {
    const auto list = listOf<std::uint32_t>(call.options, "indices");
    const tspace_Indices indices = CaseMesh::view(list);
    const std::size_t vertices = call.options["vertex_count"], corners = list.empty() ? vertices : list.size();
    std::vector<std::vector<float>> data;
    std::vector<tspace_CornerAttribute> attributes;
    for (const Json& attribute : call.options["attributes"]) {
        data.push_back(listOf<float>(attribute, "data"));
        attributes.push_back({data.back().data(), 0, attribute["size"], call.options.value("tolerance", 0.0f)});
    }
    tspace_SplitResult* made = nullptr;
    tspace_splitVertices(&indices, vertices, corners, attributes.data(), attributes.size(), nullptr, &made,
                         &call.error);
    if (made == nullptr) return;
    call.keep("indices", made->indices, made->corner_count);
    call.keep("source_vertices", made->source_vertices, made->vertex_count);
    call.keep("source_corners", made->source_corners, made->vertex_count);
    tspace_destroySplitResult(made);
}

void runPack(CaseCall& call) {
    auto normals = listOf<float>(call.options, "normals"), tangents = listOf<float>(call.options, "tangents");
    const auto format = static_cast<tspace_FrameFormat>(numberOf(call.options["format"], "FrameFormat"));
    const std::size_t count = normals.size() / 3;
    std::vector<std::uint8_t> bytes(count * tspace_frameBytes(format));
    tspace_PackReport report;
    TSPACE_INIT(report);
    tspace_packFrames({normals.data(), count, 0}, {tangents.data(), tangents.size() / 4, 0}, format, bytes.data(),
                      bytes.size(), &report, &call.error);
    if (call.error.code != TSPACE_OK) return;
    EXPECT_EQ(TSPACE_OK, tspace_unpackFrames(bytes.data(), bytes.size(), format, {normals.data(), count, 0},
                                             {tangents.data(), count, 0}, nullptr));
    call.keep("bytes", bytes);
    call.keep("normals", normals);
    call.keep("tangents", tangents);
    call.keepReport("report", report);
}

void runPlanBuffers(CaseCall& call) {
    const tspace_TangentOptions tangents = tangentOptionsOf(call);
    const auto indices = listOf<std::uint32_t>(call.options, "indices");
    const auto source_corners = listOf<std::uint32_t>(call.options, "source_corners");
    tspace_NormalOptions normals;
    TSPACE_INIT(normals);
    tspace_PlanBufferOptions options;
    TSPACE_INIT(options);
    options.indices = indices.data();
    options.index_count = indices.size();
    options.source_corners = source_corners.data();
    options.source_corner_count = source_corners.size();
    if (call.options.contains("normals")) {
        CaseCall::set(normals, call.options["normals"]);
        options.mesh = &call.mesh;
        options.normals = &normals;
    }
    tspace_TangentPlan* plan = nullptr;
    ASSERT_EQ(TSPACE_OK, tspace_planTangents(&call.mesh, &tangents, nullptr, &plan, nullptr));
    tspace_PlanBuffers* buffers = nullptr;
    if (tspace_planBuffers(plan, &options, nullptr, &buffers, &call.error) == TSPACE_OK)
        call.keep("words", buffers->words, buffers->word_count);
    tspace_destroyPlanBuffers(buffers);
    tspace_destroyTangentPlan(plan);
}

void runConvention(CaseCall& call) {
    tspace_Convention found;
    const std::string name = call.options["name"];
    if (tspace_findConvention(name.c_str(), &found, &call.error) == TSPACE_OK) call.keepReport("convention", found);
}

const std::map<std::string, void (*)(CaseCall&)> kCalls = {
    {"tangents", runTangents},
    {"normals", runNormals},
    {"sanitize", runSanitize},
    {"split", runSplit},
    {"triangulate", runTriangulate},
    {"make_indexed_frames", runIndexedFrames},
    {"pack", runPack},
    {"mend_winding", runWinding},
    {"plan_buffers", runPlanBuffers},
    {"convention", runConvention},
    {"position_noise", runPositionNoise},
};

void expectOutputs(CaseCall& call, const Json& wanted) {
    const auto bits = [](const std::vector<double>& list) {
        std::vector<std::uint64_t> words(list.size());
        std::transform(list.begin(), list.end(), words.begin(),
                       [](double x) { return std::bit_cast<std::uint64_t>(x); });
        return words;
    };
    tspace_Convention convention{};
    for (const auto& [output, value] : wanted.items()) {
        if (value.is_array()) {
            auto list = listOf<double>(wanted, output);
            for (double& x : list) x = x == std::floor(x) ? x : static_cast<double>(static_cast<float>(x));
            EXPECT_EQ(bits(call.outputs.at(output)), bits(list)) << output;
        } else if (output == "convention") {
            CaseCall::set(convention, value);
            CaseCall expected(Json::object(), value);
            expected.keepReport(output, convention);
            EXPECT_EQ(call.outputs, expected.outputs);
        } else if (value.is_object()) {
            for (const auto& [field, number] : value.items())
                EXPECT_EQ(call.outputs.at(output + "." + field).front(), numberOf(number, "")) << output + "." + field;
        }
    }
}

TEST(CCases, GiveTheResultsOfTheTable) {
    const Json table = Json::parse(std::ifstream(TSPACE_CASES_DIR "/arrays.json"));
    for (const Json& one : table["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        Json arrays = one.contains("mesh") ? table["meshes"][one["mesh"].get<std::string>()] : Json::object();
        arrays.merge_patch(one.value("change", Json::object()));
        const Json options = one.value("options", Json::object());
        CaseCall call(arrays, options);
        kCalls.at(one["call"])(call);
        if (one.contains("error")) {
            EXPECT_EQ(tspace_errorName(call.error.code), one["error"]["code"].get<std::string>());
            EXPECT_EQ(call.error.element, one["error"].value("element", call.error.element));
        } else {
            EXPECT_EQ(call.error.code, TSPACE_OK) << call.error.message;
            if (call.error.code == TSPACE_OK) expectOutputs(call, one["gives"]);
        }
    }
}

}  // namespace
}  // namespace tspace::test
