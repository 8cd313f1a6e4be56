// SPDX-License-Identifier: MIT
// Normal maps of a glTF file whose green channel is inverted, or that are written anew: where they lie, who else reads them, and putting the new
// ones in their place.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "model/gltf/container.h"
#include "model/gltf/editor.h"
#include "model/gltf/model.h"

namespace tspace::gltf {

struct MapFlips {
    std::map<std::size_t, Bytes> images = {};  ///< image files with green inverted, by number of their image
    std::map<std::size_t, Bytes> mended = {};  ///< the same of images that are written anew, green inverted or not
    std::vector<NormalMapReport> reports = {};
};

/// Decides about the normal maps of the document, before anything in it is changed. An image that another format of the
/// same texture stands beside goes only with it. `reports`: what becomes of the tangents of its primitives, which are all
/// of the document's.
MapFlips planFlips(Model& model, std::span<const PrimitiveReport> reports, const GenerateOptions& options);

/// Puts them in. An image that is something else as well, such as a base colour, stays, and the normal maps get one of
/// their own. Files beside the document are never changed: the output has new ones.
void applyFlips(Document& document, Editor& editor, const OutputTarget& target, MapFlips&& flips);

}  // namespace tspace::gltf
