// SPDX-License-Identifier: MIT
#include "methods.h"

#include <cstdio>
#include <cstdlib>

namespace tspace::accuracy {

namespace {

template <class Value>
void stopOnError(const Result<Value>& result) {
    if (result) return;
    std::fprintf(stderr, "accuracy: %s\n", result.error().message.c_str());
    std::exit(1);
}

}  // namespace

std::vector<NamedMethod> methods() {
    std::vector<NamedMethod> all;
    for (const Method method : {Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                Method::flat, Method::fast, Method::best}) {
        if (method == Method::best) all.push_back({kFitAlone, method, 0});
        all.push_back({methodName(method), method});
    }
    all.push_back({kTwoSteps, Method::best, 2});
    return all;
}

Frames framesBy(Method method, const TestMesh& mesh, std::uint32_t refine) {
    Frames frames;
    frames.tangents.resize(mesh.indices.size());
    frames.bitangents.resize(mesh.indices.size());
    TangentOptions options{.convention = conventions::opengl};
    options.method = method;
    options.refine = refine;
    TangentOutput out;
    out.tangents = frames.tangents;
    out.bitangents = frames.bitangents;
    stopOnError(generateTangents(mesh.view(), options, out));
    return frames;
}

Frames exactFrames(const TestMesh& mesh) {
    Frames frames;
    for (const std::uint32_t vertex : mesh.indices) {
        const ExactFrame& frame = mesh.frames[vertex];
        const Vec3 t = toFloat(frame.tangentAcross(toDouble(mesh.normals[vertex])));
        frames.tangents.push_back({t.x, t.y, t.z, static_cast<float>(frame.sign)});
        frames.bitangents.push_back(toFloat(unit(frame.bitangent)));
    }
    return frames;
}

std::vector<NamedWeighting> weightings() {
    return {
        {"uniform", NormalWeighting::uniform}, {"area", NormalWeighting::area},
        {"angle", NormalWeighting::angle},     {"angle-area", NormalWeighting::angleArea},
        {"max", NormalWeighting::max},         {kFitAlone, NormalWeighting::best, 0},
        {kOneStep, NormalWeighting::best, 1},  {"best", NormalWeighting::best},
    };
}

std::vector<Vec3> normalsBy(NormalWeighting weighting, const TestMesh& mesh, std::uint32_t refine) {
    std::vector<Vec3> normals(mesh.indices.size());
    NormalOptions options;
    options.weighting = weighting;
    options.refine = refine;
    stopOnError(generateNormals(mesh.view(), options, normals));
    return normals;
}

}  // namespace tspace::accuracy
