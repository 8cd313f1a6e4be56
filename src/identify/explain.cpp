// SPDX-License-Identifier: MIT
// Runs a method on the primitive's own data and counts how many of the stored tangents it gives.
#include "identify/explain.h"

#include <algorithm>

#include "core/angle.h"
#include "generate/uv_matrix.h"

namespace tspace {

namespace {

Vec3 directionOf(const Vec4& tangent) { return {tangent.x, tangent.y, tangent.z}; }
bool isDirection(const Vec3& v) { return isFinite(v) && (v.x != 0 || v.y != 0 || v.z != 0); }

/// The set that the first use reads; the first there is when no texture asks.
std::size_t texturesSet(const ScenePrimitive& primitive) {
    if (!primitive.uses.empty()) return primitive.uses.front().uv_set;
    std::size_t set = 0;
    while (set + 1 < primitive.uv_sets.size() && primitive.uv_sets[set].empty()) ++set;
    return set;
}

/// UVs that tangents may follow.
struct Reading {
    std::size_t uv_set = 0;
    bool is_transformed = false;
    std::vector<Vec2> own = {};  ///< the transformed ones
    std::span<const Vec2> uvs = {};
};

/// Every set as it is stored. The texture's set comes before that as its transform makes it, where that changes frames.
std::vector<Reading> readingsOf(const ScenePrimitive& primitive) {
    std::vector<Reading> readings;
    for (std::size_t set = 0; set < primitive.uv_sets.size(); ++set) {
        if (primitive.uv_sets[set].empty()) continue;
        if (!primitive.uses.empty() && set == texturesSet(primitive)) {
            const UvTransform& transform = primitive.uses.front().transform;
            const UvMatrix matrix = uvMatrix(transform.rotation, transform.scale[0], transform.scale[1]);
            if (!matrix.isIdentity()) {
                Reading& reading = readings.emplace_back();
                reading.uv_set = set;
                reading.is_transformed = true;
                reading.own = transformUvs(primitive.uv_sets[set].span(), matrix);
            }
        }
        Reading& plain = readings.emplace_back();
        plain.uv_set = set;
        plain.uvs = primitive.uv_sets[set].span();
    }
    for (Reading& reading : readings) {
        if (reading.is_transformed) reading.uvs = reading.own;
    }
    return readings;
}

/// Whether each vertex has a corner whose tangent is near the stored one.
std::vector<char> nearVertices(const ScenePrimitive& primitive, const std::vector<char>& near_corners) {
    std::vector<char> near(primitive.positions.size(), 0);
    for (std::size_t c = 0; c < near_corners.size(); ++c) near[primitive.corners[c]] |= near_corners[c];
    return near;
}

/// `computed` has the raw sign, one per corner.
void compare(const ScenePrimitive& primitive, const std::vector<Vec4>& computed, double tolerance_deg,
             Explanation& explanation) {
    std::vector<char> is_near(computed.size(), 0);
    double sum_deg = 0;
    for (std::size_t c = 0; c < computed.size(); ++c) {
        const Vec4& stored = primitive.tangents[primitive.corners[c]];
        if (!isDirection(directionOf(stored))) continue;
        ++explanation.corner_count;
        if (!isDirection(directionOf(computed[c]))) {
            sum_deg += 180;
            continue;
        }
        const double angle =
            angleBetween(toDouble(directionOf(stored)), toDouble(directionOf(computed[c]))) * (180 / kPi);
        sum_deg += angle;
        is_near[c] = angle <= tolerance_deg;
        explanation.near_count += static_cast<unsigned char>(is_near[c]);
        // glTF's v runs down, so it wants the opposite of the raw orientation.
        explanation.gltf_sign_count += stored.w * computed[c].w < 0;
        explanation.inverted_sign_count += stored.w * computed[c].w > 0;
    }
    if (explanation.corner_count != 0) explanation.mean_deg = sum_deg / static_cast<double>(explanation.corner_count);
    const std::vector<char> near_at_vertex = nearVertices(primitive, is_near);
    for (std::size_t c = 0; c < computed.size(); ++c) {
        explanation.near_any_count += static_cast<unsigned char>(near_at_vertex[primitive.corners[c]]);
    }
}

}  // namespace

std::vector<Method> knownMethods() {
    return {Method::mikktspace, Method::angle, Method::area, Method::uniform,
            Method::lengyel,    Method::flat,  Method::fast, Method::best};
}

Result<std::vector<Explanation>> explainTangents(const ScenePrimitive& primitive, const IdentifyOptions& options) {
    std::vector<Explanation> explanations;
    std::vector<Vec4> computed(primitive.corners.size());
    for (const Reading& reading : readingsOf(primitive)) {
        const MeshView mesh{.positions = primitive.positions.span(),
                            .normals = primitive.normals.span(),
                            .uvs = reading.uvs,
                            .indices = primitive.corners.span()};
        for (const Method method : knownMethods()) {
            const TangentOptions how{.method = method, .execution = options.execution};
            const Result<TangentReport> done = generateTangents(mesh, how, {.tangents = std::span(computed)});
            if (!done) return done.error();
            Explanation& explanation = explanations.emplace_back();
            explanation.method = method;
            explanation.uv_set = static_cast<std::int32_t>(reading.uv_set);
            explanation.is_textures_set = reading.uv_set == texturesSet(primitive);
            explanation.is_transformed = reading.is_transformed;
            compare(primitive, computed, options.tolerance_deg, explanation);
        }
    }
    return explanations;
}

void sortExplanations(std::vector<Explanation>& explanations) {
    std::stable_sort(explanations.begin(), explanations.end(), [](const Explanation& a, const Explanation& b) {
        return a.near_count != b.near_count ? a.near_count > b.near_count : a.near_any_count > b.near_any_count;
    });
}

}  // namespace tspace
