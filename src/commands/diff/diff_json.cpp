// SPDX-License-Identifier: MIT
// Differences as JSON.
#include "commands/diff/diff_report.h"

namespace tspace::report {
namespace {

Json anglesJson(const AngleStatistics& angles) {
    return Json::object({{"corners", angles.count},
                         {"unusable", angles.unusable_count},
                         {"meanDeg", angles.mean_deg},
                         {"medianDeg", angles.median_deg},
                         {"p95Deg", angles.p95_deg},
                         {"maxDeg", angles.max_deg},
                         {"histogram", angles.histogram}});
}

Json sideJson(const PrimitiveDiff& p, bool is_a) {
    const std::string& place = is_a ? p.place_a : p.place_b;
    if (place.empty()) return nullptr;
    return Json::object({{"place", place},
                         {"mesh", is_a ? p.mesh_a : p.mesh_b},
                         {"primitive", is_a ? p.primitive_a : p.primitive_b},
                         {"triangles", is_a ? p.triangle_count_a : p.triangle_count_b},
                         {"hasTangents", is_a ? p.has_tangents_a : p.has_tangents_b},
                         {"tangentsNotRead", is_a ? p.tangents_not_read_a : p.tangents_not_read_b},
                         {"hasNormals", is_a ? p.has_normals_a : p.has_normals_b}});
}

Json comparedPrimitiveJson(const PrimitiveDiff& p) {
    return Json::object({{"a", sideJson(p, true)},
                         {"b", sideJson(p, false)},
                         {"meshName", p.mesh_name},
                         {"pairedBy", p.paired_by},
                         {"pairedTriangles", p.paired_triangle_count},
                         {"signChanges", p.sign_change_count},
                         {"tangents", anglesJson(p.tangents)},
                         {"normals", anglesJson(p.normals)},
                         {"bitangents", anglesJson(p.bitangents)}});
}

Json worstJson(const FrameDifference& d) {
    return Json::object({{"meshA", d.mesh_a},
                         {"primitiveA", d.primitive_a},
                         {"vertexA", d.vertex_a},
                         {"meshB", d.mesh_b},
                         {"primitiveB", d.primitive_b},
                         {"vertexB", d.vertex_b},
                         {"position", Json::array({d.position.x, d.position.y, d.position.z})},
                         {"tangentDeg", d.tangent_deg},
                         {"normalDeg", d.normal_deg},
                         {"bitangentDeg", d.bitangent_deg},
                         {"signDiffers", d.sign_differs}});
}

}  // namespace

std::string diffJson(const std::string& a, const std::string& b, double tolerance_deg, const Result<FrameDiff>& diff,
                     ExitCode exit_code) {
    Json json = documentJson("tspace.diff/1", diff.ok(), exit_code);
    json["a"] = a;
    json["b"] = b;
    json["error"] = errorJson(diff ? nullptr : &diff.error());
    if (!diff) return jsonText(json);
    json["toleranceDeg"] = tolerance_deg;
    json["isWithinTolerance"] = diff->isWithin(tolerance_deg);
    json["corners"] = diff->corner_count;
    json["signChanges"] = diff->sign_change_count;
    json["unpairedTriangles"] = diff->unpaired_triangle_count;
    json["missingTangents"] = diff->missing_count;
    json["histogramUpperDeg"] = kAngleBins;
    json["tangents"] = anglesJson(diff->tangents);
    json["normals"] = anglesJson(diff->normals);
    json["bitangents"] = anglesJson(diff->bitangents);
    json["worst"] = listJson(diff->worst, worstJson);
    json["primitives"] = listJson(diff->primitives, comparedPrimitiveJson);
    return jsonText(json);
}

}  // namespace tspace::report
