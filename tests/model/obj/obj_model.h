// SPDX-License-Identifier: MIT
// Models that tests generate from an OBJ text.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "model/gltf/load_document.h"
#include "model/gltf/primitive_reader.h"
#include "support/temp_folder.h"
#include "tspace/generate.h"
#include "tspace/result.h"

namespace tspace::test {

inline constexpr const char* kQuad =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

/// The result of generating from an OBJ text, read from its output.
struct ObjModel {
    GenerateReport report = {};
    gltf::Document document = {};
    std::vector<gltf::Primitive> primitives = {};

    [[nodiscard]] std::vector<Vec3> vec3(const char* name, std::size_t primitive = 0) const {
        return gltf::readVec3(document, primitives[primitive], name);
    }
    [[nodiscard]] std::vector<std::uint32_t> corners(std::size_t primitive = 0) const {
        return gltf::readTriangleCorners(document, primitives[primitive]);
    }
};

inline GenerateOptions everything() {
    GenerateOptions options;
    options.selection.all = true;
    return options;
}

inline Result<GenerateReport> tryMake(const TempFolder& folder, const std::string& obj,
                                      const GenerateOptions& options) {
    return generateFile(folder.write("in/model.obj", obj), (folder.path() / "out.glb").string(), options);
}

inline ObjModel make(const TempFolder& folder, const std::string& obj, const GenerateOptions& options = everything()) {
    Result<GenerateReport> report = tryMake(folder, obj, options);
    EXPECT_TRUE(report) << (report ? "" : report.error().message);
    if (!report) return {};
    ObjModel made{.report = *report, .document = gltf::loadDocument(folder.path() / "out.glb", {})};
    made.primitives = gltf::readPrimitives(made.document);
    return made;
}

inline bool mentions(const std::vector<std::string>& sentences, const std::string& text) {
    return std::any_of(sentences.begin(), sentences.end(),
                       [&](const std::string& s) { return s.find(text) != std::string::npos; });
}

}  // namespace tspace::test
