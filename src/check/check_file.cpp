// SPDX-License-Identifier: MIT
// checkFile: reads a scene, checks each geometry once, and puts the findings in order.
#include <algorithm>
#include <cmath>
#include <map>

#include "asset/file_error.h"
#include "asset/scene.h"
#include "asset/work_together.h"
#include "check/check_images.h"
#include "check/findings.h"
#include "check/primitive_checks.h"
#include "tspace/check.h"

namespace tspace {

namespace {

constexpr std::size_t kNone = ~std::size_t{0};

/// Primitives with one key get the same findings. Arrays that a file shares have one address.
std::string keyOf(const ScenePrimitive& primitive) {
    std::string key = primitive.mode;
    const auto append = [&key](const auto& value) { key.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    append(primitive.corners.data());
    append(primitive.positions.data());
    append(primitive.normals.data());
    append(primitive.tangents.data());
    for (const SharedArray<Vec2>& uvs : primitive.uv_sets) append(uvs.data());
    append(primitive.morph_targets.size());
    for (const SceneMorphTarget& target : primitive.morph_targets) {
        append(target.positions.data());
        append(target.normals.data());
        append(target.tangents.data());
    }
    for (const TangentUse& use : primitive.uses) {
        key += use.needed_by;
        append(use.uv_set);
        append(use.transform.rotation);
        append(use.transform.scale);
    }
    return key;
}

/// Which primitives are checked, and whose findings each primitive gets.
struct Work {
    std::vector<std::size_t> primitives = {};  ///< the first of each key
    std::vector<std::size_t> result_of = {};   ///< per primitive of the scene: index into `primitives`
};

Work collectWork(const Scene& scene) {
    Work work;
    std::map<std::string, std::size_t> known;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const auto [entry, is_new] = known.try_emplace(keyOf(scene.primitives[i]), work.primitives.size());
        if (is_new) work.primitives.push_back(i);
        work.result_of.push_back(entry->second);
    }
    return work;
}

std::vector<std::vector<Finding>> checkAll(const Scene& scene, const Work& work, const CheckOptions& options) {
    std::vector<std::vector<Finding>> results(work.primitives.size());
    const bool is_gltf = scene.format == "glb" || scene.format == "gltf";
    const auto primitiveAt = [&](std::size_t i) -> const ScenePrimitive& {
        return scene.primitives[work.primitives[i]];
    };
    const auto bytesOf = [&](std::size_t i) {
        const ScenePrimitive& primitive = primitiveAt(i);
        return checkBytes(primitive.corners.size(), primitive.positions.size(), !primitive.tangents.empty());
    };
    Parallel parallel(options.execution);
    workTogether(scene.memory.get(), results.size(), parallel, bytesOf,
                 [&](std::size_t i) { results[i] = valueOrThrow(checkPrimitive(primitiveAt(i), options, is_gltf)); });
    return results;
}

void checkOptions(const CheckOptions& options) {
    for (const double value : {options.direction_deg, options.error_deg, options.orthogonal_deg, options.split_deg,
                               options.unit_tolerance, options.error_share}) {
        if (!(value >= 0) || !std::isfinite(value)) {
            failFile(ErrorCode::invalidOption, "an angle, tolerance or share is negative or not a number");
        }
    }
}

/// A finding of the first primitive of its key, made one of this primitive.
Finding placed(Finding finding, const ScenePrimitive& primitive, const ScenePrimitive& checked) {
    if (finding.place.empty()) {
        finding.place = primitive.place;
    } else if (finding.place.rfind(checked.place, 0) == 0) {
        finding.place = primitive.place + finding.place.substr(checked.place.size());
    }
    finding.mesh = primitive.mesh;
    finding.primitive = primitive.primitive;
    finding.mesh_name = primitive.mesh_name;
    finding.material_name = primitive.material_name;
    return finding;
}

/// Inverted signs and a green channel that points down cancel out. Then it renders right, though both are against glTF.
void softenWhatCancels(const Scene& scene, ImageFindings& images, const std::vector<Finding*>& inverted_signs) {
    std::vector<bool> is_inverted(scene.primitives.size(), false);
    for (std::size_t i = 0; i < inverted_signs.size(); ++i) {
        if (inverted_signs[i] == nullptr) continue;
        is_inverted[i] = true;
        if (i >= images.primitive_green.size() || images.primitive_green[i] != GreenSide::down) continue;
        inverted_signs[i]->severity = std::min(inverted_signs[i]->severity, Severity::warning);
        inverted_signs[i]->message += "; but green points down in its normal map too, and the two cancel out";
    }
    std::vector<bool> is_needed(scene.images.size(), false);  // by a primitive whose signs are right
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (use.image && !is_inverted[i]) is_needed[*use.image] = true;
        }
    }
    for (std::size_t i = 0; i < images.findings.size(); ++i) {
        Finding& finding = images.findings[i];
        if (finding.code != FindingCode::greenFlipped || is_needed[images.images[i]]) continue;
        finding.severity = Severity::note;
        finding.message += "; but the signs of its meshes are inverted too, and the two cancel out";
    }
}

/// What reading the file had to say. It is about the file, so no primitive is named.
Finding fileRemark(const std::string& warning) {
    const Tally one{.count = 1, .total = 1};
    return makeFinding(FindingCode::fileRemark, Severity::note, one, "files", warning);
}

CheckReport check(const std::string& input, const CheckOptions& options) {
    checkOptions(options);
    const Scene scene = readScene(input, options.file, options.images);
    CheckReport report;
    report.format = scene.format;
    report.generator = scene.generator;
    report.primitive_count = scene.primitives.size();
    const Work work = collectWork(scene);
    const std::vector<std::vector<Finding>> results = checkAll(scene, work, options);
    ImageFindings images;
    if (options.images) images = checkImages(scene, options);
    report.image_count = images.looked_at;
    std::vector<std::size_t> inverted_at(scene.primitives.size(), kNone);
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        const ScenePrimitive& primitive = scene.primitives[i];
        report.tangents_count += !primitive.tangents.empty() && !primitive.corners.empty();
        const ScenePrimitive& checked = scene.primitives[work.primitives[work.result_of[i]]];
        for (const Finding& finding : results[work.result_of[i]]) {
            if (finding.code == FindingCode::signsInverted) inverted_at[i] = report.findings.size();
            report.findings.push_back(placed(finding, primitive, checked));
        }
    }
    std::vector<Finding*> inverted_signs;
    for (const std::size_t at : inverted_at) inverted_signs.push_back(at == kNone ? nullptr : &report.findings[at]);
    softenWhatCancels(scene, images, inverted_signs);
    for (Finding& finding : images.findings) report.findings.push_back(std::move(finding));
    for (const std::string& warning : scene.warnings) report.findings.push_back(fileRemark(warning));
    std::stable_sort(report.findings.begin(), report.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
    for (const Finding& finding : report.findings) {
        report.error_count += finding.severity == Severity::error;
        report.warning_count += finding.severity == Severity::warning;
        report.note_count += finding.severity == Severity::note;
    }
    return report;
}

}  // namespace

Result<CheckReport> checkFile(const std::string& input, const CheckOptions& options) {
    return atFileBorder([&]() -> Result<CheckReport> { return check(input, options); });
}

}  // namespace tspace
