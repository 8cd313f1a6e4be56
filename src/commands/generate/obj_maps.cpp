// SPDX-License-Identifier: MIT
#include "commands/generate/obj_maps.h"

#include <algorithm>
#include <utility>

#include "commands/check/judge_maps.h"
#include "commands/generate/mend_maps.h"
#include "core/base/numbers.h"
#include "model/obj/obj_primitives.h"

namespace tspace::obj {

namespace {

void leaveOut(Material& material, const std::string& why, Model& model) {
    model.warnings.push_back("the height map '" + material.normal_texture.file +
                             "' was left out, and no normal map was made of it: " + why);
    material.normal_texture = {};
    material.normal_scale = 1;
}

/// A grey map_bump becomes a normal map; others are normal maps. `image`: of the scene.
void convertHeightMap(const Scene& scene, std::size_t image, const GenerateOptions& options, Material& material,
                      Model& model, std::vector<NormalMapReport>& reports) {
    const auto number = static_cast<std::size_t>(&material - model.materials.data());
    const auto strength = static_cast<double>(material.normal_scale);
    MadeOfHeights made = makeOfHeights(scene, number, image, strength, options);
    if (!made.is_height_map) return;
    if (made.file.empty()) return leaveOut(material, made.why_not, model);
    model.memory->take(made.file.size(), "material");
    material.made_normal_map = std::make_shared<const Bytes>(std::move(made.file));
    material.normal_scale = 1;
    const std::string lean = shortNumber(made.mean_lean_deg) + " degrees in the mean";
    NormalMapReport& report = reports.emplace_back();
    report.image = static_cast<std::uint32_t>(image);
    report.name = material.normal_texture.file;
    report.mended = true;
    report.reason =
        "it held heights; white stands " + shortNumber(strength) + " units high (-bm), and normals lean by " + lean;
    constexpr double kSteepDeg = 60;
    if (made.mean_lean_deg > kSteepDeg) {
        model.warnings.push_back("the normal map made of '" + material.normal_texture.file + "' is very steep (" +
                                 lean + "): -bm is taken for how many units of the model white stands above black");
    }
}

void convertHeights(const Scene& scene, const GenerateOptions& options, Model& model,
                    std::vector<NormalMapReport>& reports) {
    std::vector<bool> is_done(model.materials.size());
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            if (!use.may_be_heights || !use.image || is_done[use.material]) continue;
            is_done[use.material] = true;
            convertHeightMap(scene, *use.image, options, model.materials[use.material], model, reports);
        }
    }
}

}  // namespace

std::vector<NormalMapReport> prepareMaps(std::span<const ObjPrimitive> primitives, const GenerateOptions& options,
                                         Model& model) {
    std::vector<NormalMapReport> reports;
    const bool is_asked = options.flip_green != FlipGreen::none || options.mend_maps;
    const bool has_bumps = std::any_of(model.materials.begin(), model.materials.end(), [](const Material& material) {
        return material.normal_is_bump && material.normal_texture.used();
    });
    if (!is_asked && !has_bumps) return reports;
    const std::int64_t left = model.memory->left();
    const Scene scene = sceneOf(model, primitives, true);
    convertHeights(scene, options, model, reports);
    std::vector<JudgedMap> maps;
    if (is_asked) maps = judgeMaps(scene, std::vector<bool>(scene.primitives.size()), options);
    std::vector<const Texture*> textures(scene.images.size());
    for (const ScenePrimitive& primitive : scene.primitives) {
        for (const TangentUse& use : primitive.uses) {
            const Material& material = model.materials[use.material];
            if (material.normal_texture.used() && !material.made_normal_map)
                textures[*use.image] = &material.normal_texture;
        }
    }
    std::vector<std::pair<std::string, Bytes>> made;
    for (JudgedMap& map : maps) {
        if (textures[map.image] == nullptr) continue;
        Bytes bytes;
        if (options.mend_maps) {
            const std::string why_not_flipped = map.report.reason;
            const ByteSpan source =
                map.flipped.empty() ? ByteSpan(scene.images[map.image].bytes) : ByteSpan(map.flipped);
            bytes = mendMap(scene, source, options, map);
            if (bytes.empty() && map.report.flipped) map.report.reason.clear();
            if (bytes.empty() && !why_not_flipped.empty()) map.report.reason = why_not_flipped;
        }
        if (bytes.empty()) bytes = std::move(map.flipped);
        reports.push_back(std::move(map.report));
        if (!bytes.empty()) made.emplace_back(textures[map.image]->path(), std::move(bytes));
    }
    model.memory->giveBack(left);
    for (auto& [path, bytes] : made) {
        model.memory->take(bytes.size(), "material");
        model.flipped_maps[path] = std::move(bytes);
    }
    return reports;
}

}  // namespace tspace::obj
