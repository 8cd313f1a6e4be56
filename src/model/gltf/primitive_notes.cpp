// SPDX-License-Identifier: MIT
// Notes on textures that disagree, on texture transforms, and on their animations.
#include "model/gltf/primitive_notes.h"

#include "model/io/file_error.h"

namespace tspace::gltf {

namespace {

/// The most notes per primitive: a file may have any number of variants.
constexpr std::size_t kMaxDifferences = 8;

std::string nameOf(const TangentUse& use) {
    return use.needed_by + " of material " + std::to_string(use.material) + (use.only_in_variant ? " (a variant)" : "");
}

/// Why tangents for `first` do not fit `other`.
std::string difference(const TangentUse& first, const TangentUse& other) {
    if (first.uv_set != other.uv_set) {
        return "follow TEXCOORD_" + std::to_string(first.uv_set) + " for " + nameOf(first) + ", but " + nameOf(other) +
               " is on TEXCOORD_" + std::to_string(other.uv_set);
    }
    return "fit the KHR_texture_transform of " + nameOf(first) + ", but " + nameOf(other) +
           " is turned or mirrored in another way";
}

void addDifferences(const std::vector<TangentUse>& uses, TextureTransform reading, std::vector<std::string>& notes) {
    std::size_t count = 0;
    for (const TangentUse& use : uses) {
        if (haveSameTangents(uses[0], use, reading) || ++count > kMaxDifferences) continue;
        notes.push_back("the tangents " + difference(uses[0], use));
    }
    if (count > kMaxDifferences) {
        notes.push_back("neither do they fit " + std::to_string(count - kMaxDifferences) + " more textures");
    }
}

void addTransform(const TangentUse& use, TextureTransform reading, std::vector<std::string>& notes) {
    const UvMatrix matrix = uvMatrixOf(use, TextureTransform::apply);
    if (matrix.isIdentity()) return;
    notes.push_back(kTransformNote + std::string(matrix.mirrors() ? "mirrors " : "turns ") + nameOf(use) +
                    (reading == TextureTransform::apply ? ": the tangents follow the transformed UVs"
                                                        : ": as asked for, the tangents follow the UVs before it"));
}

void addAnimations(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                   std::vector<std::string>& notes) {
    for (const TangentUse& use : uses) {
        const std::string transform = use.place + "/extensions/KHR_texture_transform/";
        if (animated.count(transform + "rotation") == 0 && animated.count(transform + "scale") == 0) continue;
        notes.push_back("an animation moves the KHR_texture_transform of " + nameOf(use) +
                        ": the tangents fit the values in the material only");
        return;
    }
}

}  // namespace

UvMatrix uvMatrixOf(const TangentUse& use, TextureTransform reading) {
    if (reading == TextureTransform::ignore) return {};
    return uvMatrix(use.transform.rotation, use.transform.scale[0], use.transform.scale[1]);
}

bool haveSameTangents(const TangentUse& a, const TangentUse& b, TextureTransform reading) {
    return a.uv_set == b.uv_set && uvMatrixOf(a, reading) == uvMatrixOf(b, reading);
}

std::set<std::string> animatedPointers(const Document& document) {
    std::set<std::string> pointers;
    for (const Json& animation : rootArray(document, "animations")) {
        const Json* channels = findMember(animation, "channels");
        if (channels == nullptr || !channels->is_array()) continue;
        for (const Json& channel : *channels) {
            const Json* target = findMember(channel, "target");
            const Json* extension = target == nullptr ? nullptr : findExtension(*target, "KHR_animation_pointer");
            const Json* pointer = extension == nullptr ? nullptr : findMember(*extension, "pointer");
            if (pointer != nullptr && pointer->is_string()) pointers.insert(pointer->get<std::string>());
        }
    }
    return pointers;
}

std::vector<std::string> notesOf(const std::vector<TangentUse>& uses, const std::set<std::string>& animated,
                                 TextureTransform reading, bool computed) {
    std::vector<std::string> notes;
    if (uses.empty()) return notes;
    if (computed) addTransform(uses[0], reading, notes);
    addDifferences(uses, reading, notes);
    addAnimations(uses, animated, notes);
    return notes;
}

}  // namespace tspace::gltf
