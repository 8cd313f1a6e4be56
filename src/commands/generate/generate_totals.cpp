// SPDX-License-Identifier: MIT
// Adding up.
#include "commands/generate/generate_totals.h"

namespace tspace::report {

bool wasComputed(PrimitiveAction action) {
    return action == PrimitiveAction::generated || action == PrimitiveAction::replaced ||
           action == PrimitiveAction::unchanged;
}

Totals totalsOf(const GenerateReport& report) {
    Totals totals;
    for (const PrimitiveReport& primitive : report.primitives) {
        ++totals.primitive_count;
        ++totals.actions[static_cast<std::size_t>(primitive.action)];
        totals.normals_generated += primitive.normals_generated;
        totals.normals_replaced += primitive.normals_replaced;
        totals.morph_normals_computed += primitive.morph_normals_computed;
        totals.on_quads += primitive.faces == Faces::quads ? 1 : 0;
        totals.quad_count += primitive.quad_count;
        totals.bitangents_generated += primitive.bitangents_generated;
        totals.frames_packed += primitive.frames_packed;
        totals.packed_mended += primitive.packing.mendedCount();
        totals.tangents_dropped += primitive.tangents_dropped;
        totals.normals_dropped += primitive.normals_dropped;
        totals.morph_deltas_computed += primitive.morph_deltas_computed;
        totals.morph_sign_flip_count += primitive.morph_sign_flip_count;
        if (!wasComputed(primitive.action)) continue;
        totals.triangle_count += primitive.triangle_count;
        totals.vertices_before += primitive.vertices_before;
        totals.vertices_after += primitive.vertices_after;
        totals.degenerate_uv_count += primitive.tangents.degenerate_uv_count;
        totals.degenerate_triangle_count += primitive.tangents.degenerate_triangle_count;
        totals.reference_order_abandoned |= primitive.tangents.reference_order_abandoned;
        for (const NamedCount& cause : kCauses) totals.sanitize.*cause.count += primitive.sanitize.*cause.count;
        for (const NamedCount& cure : kCures) totals.sanitize.*cure.count += primitive.sanitize.*cure.count;
        totals.sanitize.bad_normal_count += primitive.sanitize.bad_normal_count;
    }
    return totals;
}

}  // namespace tspace::report
