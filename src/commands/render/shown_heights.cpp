// SPDX-License-Identifier: MIT
#include "commands/render/shown_heights.h"

#include <map>
#include <optional>

#include "commands/generate/mend_maps.h"

namespace tspace {

std::vector<std::string> showHeights(Method method, const Execution& execution, DrawnScene& drawn) {
    GenerateOptions options;
    options.tangents.method = method;
    options.execution = execution;
    std::vector<std::string> warnings;
    Scene& scene = drawn.scene;
    struct Shown {
        bool is_height_map = false;
        std::optional<std::size_t> image = {};
    };
    std::map<std::size_t, Shown> shown_of;  // per material
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
        SurfaceLook& look = drawn.looks[i];
        for (const TangentUse& use : scene.primitives[i].uses) {
            if (!use.may_be_heights || !use.image || !look.normal_texture) continue;
            const auto [entry, is_new] = shown_of.try_emplace(use.material);
            Shown& shown = entry->second;
            if (is_new) {
                MadeOfHeights made = makeOfHeights(scene, use.material, *use.image, look.normal_scale, options);
                shown.is_height_map = made.is_height_map;
                const std::string name = scene.images[*use.image].uri;
                if (!made.file.empty()) {
                    scene.memory->take(made.file.size(), {});
                    shown.image = scene.images.size();
                    scene.images.push_back({.name = name, .uri = name});
                    scene.images.back().bytes.assign(made.file.begin(), made.file.end());
                } else if (made.is_height_map) {
                    warnings.push_back("the height map '" + name + "' is not shown: " + made.why_not);
                }
            }
            if (!shown.is_height_map) continue;
            look.normal_texture->image = shown.image;
            look.normal_scale = 1;
        }
    }
    return warnings;
}

}  // namespace tspace
