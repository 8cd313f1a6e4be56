// SPDX-License-Identifier: MIT
#include "surface/uv_votes.h"

#include "surface/surface.h"

namespace tspace {

std::vector<std::uint8_t> uvVotes(const TangentView& mesh) {
    const Surface surface = describeSurface(mesh);
    std::vector<std::uint8_t> votes;
    votes.reserve(surface.faces.size());
    for (const SurfaceFrame& face : surface.faces) votes.push_back(face.orientation != 0 ? 1 : 0);
    return votes;
}

}  // namespace tspace
