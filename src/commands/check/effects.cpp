// SPDX-License-Identifier: MIT
// Visible effects of findings: the symptom that a user sees in a picture. remedy.cpp has causes and remedies.
#include <array>

#include "tspace/check.h"

namespace tspace {

const char* findingEffect(FindingCode code) {
    // Entries are in the order of FindingCode.
    static constexpr std::array kEffects{
        "Parts of the mesh are missing, or stretched to infinity.",
        "The texture is missing, or shows one flat color.",
        "The texture is smeared or missing on some triangles.",
        "Some triangles show one stretched texel, so they have no bumps.",
        "The surface looks faceted.",
        "Black or missing pixels.",
        "Shading and bumps are too strong or too weak in some viewers.",
        "Parts of the surface are lit as if the light came from behind them.",
        "Bumps may look different in every viewer, with seams where its tangents differ from those of the bake.",
        "Nothing is visible: the file is only larger than necessary.",
        "Bumps look as if the file had no tangents.",
        "Pixels in the bumps are black or missing.",
        "Bumps are too strong or too weak along one direction.",
        "Bumps are lit slightly from the wrong direction.",
        "Bumps are too weak along one direction, or missing.",
        "Bumps flatten to a streak along the mirror line.",
        "Bumps look like dents along one direction, on the whole model.",
        "Bumps look like dents on a part of the model, usually the mirrored half.",
        "A dark seam runs along the mirror line.",
        "The lighting has seams along the borders of UV islands.",
        "Bumps are lit from the wrong side.",
        "Bumps are lit from the wrong side, as if the normal map were rotated.",
        "Bumps are lit from the wrong side in viewers that use the stored tangents.",
        "The lighting has edges where the surface is smooth.",
        "Bumps are lit from the wrong side while the shape morphs.",
        "Bumps are lit from the wrong side while the shape morphs.",
        "The bumps of one of the textures are lit from the wrong side.",
        "Bumps look like dents: they are lit from below instead of from above.",
        "Unknown: the normal map could not be examined.",
        "Unknown: a part of the file was ignored.",
        "Bumps look like dents in one part of the texture.",
        "Programs that use the packed frames light the model incorrectly, or reject it.",
        "Programs that use the packed frames light the model differently.",
        "Programs reject the file, or light bumps incorrectly.",
        "The lighting is rough or faceted on small details.",
        "The lighting has a visible line where the material changes.",
        "Flat faces are shaded as if they were round, so boxes look inflated.",
        "The shape moves, but its lighting does not.",
        "The lighting jumps or turns dark while the shape morphs.",
        "Bumps are too weak, or the surface is lit from behind.",
        "Bumps are too strong.",
        "Bumps are lit from the wrong side.",
        "Flat areas are lit as if they were tilted.",
        "The lighting is wrong everywhere, in patches of different brightness.",
        "The lighting is wrong everywhere: gray levels are read as directions.",
        "Bumps are missing or inverted.",
        "The lighting is wrong everywhere: colors are read as directions.",
        "The shading is rough where the surface should be smooth.",
        "Highlights show the blocks of a lossy image format.",
        "The surface shimmers at a distance.",
        "Bumps change their strength with distance.",
        "No bumps are visible.",
        "Flat areas are tilted by a fraction of a degree.",
        "Programs reject the file, or draw the attribute incorrectly.",
    };
    static_assert(kEffects.size() == kFindingCodeCount);
    const auto number = static_cast<std::size_t>(code);
    return number < kEffects.size() ? kEffects[number] : "";
}

}  // namespace tspace
