// SPDX-License-Identifier: MIT
#include "commands/shared/page/diff_pictures.h"

#include <algorithm>

#include "commands/render/draw_model.h"
#include "commands/render/picture_file.h"

namespace tspace {

namespace {

/// The parts of the frames that both primitives of a pair have, at the corners of A.
OtherFrames framesAtCorners(const ScenePrimitive& a, const ScenePrimitive& b, const PrimitivePair& pair) {
    OtherFrames frames;
    const bool has_normals = !a.normals.empty() && !b.normals.empty();
    // Tangents that only one of them has cannot be compared.
    if (has_normals) frames.normals.resize(a.corners.size());
    if (!a.tangents.empty() || !b.tangents.empty()) frames.tangents.resize(a.corners.size());
    for (const TrianglePair& two : pair.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = std::size_t{3} * two.a + k;
            const std::uint32_t vertex = b.corners[std::size_t{3} * two.b + (k + two.rotation) % 3];
            if (has_normals) frames.normals[corner] = b.normals[vertex];
            if (!b.tangents.empty()) frames.tangents[corner] = b.tangents[vertex];
        }
    }
    return frames;
}

}  // namespace

DiffPictures::DiffPictures(const std::string& a, const std::string& b, const DiffOptions& options)
    : a_(a, options.file),
      b_(b, options.file_b.value_or(options.file)),
      pairs_(pairPrimitives(a_.scene(), b_.scene())),
      others_(framesOfB()) {}

std::vector<OtherFrames> DiffPictures::framesOfB() const {
    std::vector<OtherFrames> others(a_.scene().primitives.size());
    for (const PrimitivePair& pair : pairs_) {
        if (pair.a == kNoPrimitive || pair.b == kNoPrimitive) continue;
        others[pair.a] = framesAtCorners(a_.scene().primitives[pair.a], b_.scene().primitives[pair.b], pair);
    }
    return others;
}

const ModelPicture& DiffPictures::heat() {
    if (!heat_) {
        const FrameChoice choice{.frames = RenderFrames::stored, .always = true, .others = others_};
        heat_ = std::make_unique<ModelPicture>(a_.drawn(), RenderShow::error, choice, MapReading{}, nullptr);
    }
    return *heat_;
}

std::vector<std::uint8_t> DiffPictures::heatMap(Side side) {
    if (heat().meshes().empty()) return {};
    RenderOptions options{.show = RenderShow::error, .width = kHeatWidth, .height = kHeatHeight};
    if (side == Side::back) {
        options.yaw_deg += 180;
        options.pitch_deg = -options.pitch_deg;
    }
    return encodePicture(drawModel(heat(), options).image);
}

DiffPictures::Place DiffPictures::place(const FrameDifference& difference) {
    const std::size_t primitive = findPrimitive(a_.scene(), difference.mesh_a, difference.primitive_a);
    const auto pair = std::find_if(pairs_.begin(), pairs_.end(),
                                   [&](const PrimitivePair& candidate) { return candidate.a == primitive; });
    if (primitive == kNoPrimitive || pair == pairs_.end() || pair->b == kNoPrimitive) return {};
    const std::uint32_t vertices[] = {difference.vertex_a};
    const std::vector<std::size_t> triangles = trianglesAt(a_.scene().primitives[primitive], vertices);
    const std::vector<std::size_t> partners = partnersOf(*pair, triangles);
    if (triangles.empty() || partners.empty()) return {};
    return {drawPlace(a_.lit(RenderFrames::stored), RenderShow::lit, primitive, triangles),
            drawPlace(b_.lit(RenderFrames::stored), RenderShow::lit, pair->b, partners),
            drawPlace(heat(), RenderShow::error, primitive, triangles)};
}

}  // namespace tspace
