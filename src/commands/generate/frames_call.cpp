// SPDX-License-Identifier: MIT
// Converts GenerateOptions and PrimitiveReport to and from the types of computeFrames.
#include "commands/generate/frames_call.h"

namespace tspace {

FramesOptions framesOptions(const GenerateOptions& options) {
    return {.tangents = options.tangents.compute,
            .normals = options.normals.compute,
            .sanitize = options.tangents.sanitize,
            .sanitize_options = options.tangents.sanitize_options,
            .bitangents = options.tangents.bitangents,
            .format = options.storage.format,
            .faces = options.tangents.faces};
}

void copyReportOfKept(const FramesReport& computed, PrimitiveReport& report) {
    report.morph_sign_flip_count = computed.morph_sign_flip_count;
    report.normals_behind_count = computed.normals_behind_count;
    report.turned_triangle_count = computed.turned_triangle_count;
    report.two_sided_triangle_count = computed.two_sided_triangle_count;
}

void copyReport(const FramesReport& computed, PrimitiveReport& report) {
    copyReportOfKept(computed, report);
    report.normals = computed.normals;
    report.tangents = computed.tangents;
    report.negative_uv_count = computed.negative_uv_count;
    report.sanitize = computed.sanitize;
    report.mended_vertex_count = computed.mended_vertex_count;
    report.faces = computed.faces;
    report.quad_count = computed.quad_count;
}

const char* actionName(PrimitiveAction action) {
    switch (action) {
        case PrimitiveAction::generated: return "generated";
        case PrimitiveAction::replaced: return "replaced";
        case PrimitiveAction::unchanged: return "unchanged";
        case PrimitiveAction::kept: return "kept";
        case PrimitiveAction::notNeeded: return "notNeeded";
        case PrimitiveAction::notTriangles: return "notTriangles";
        case PrimitiveAction::impossible: return "impossible";
        case PrimitiveAction::removed: return "removed";
    }
    return "unknown";
}

}  // namespace tspace
