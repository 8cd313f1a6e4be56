// SPDX-License-Identifier: MIT
// Normal maps of a glTF file that follow its tangents: what the model showed with the old ones, it shows with the new.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "model/gltf/container.h"
#include "model/gltf/editor.h"
#include "model/gltf/model.h"
#include "model/scene/scene.h"

namespace tspace::gltf {

class MapConversion {
  public:
    /// Takes what the model shows now: call it before anything in it is changed. Both must outlive it.
    MapConversion(Model& model, const GenerateOptions& options);

    /// Once the model has the new tangents, and wasEdited: puts new maps in where they bring the picture closer to the old one.
    /// `reports`: of all primitives. Files beside the document are never changed: the output has new ones.
    std::vector<ConvertedMapReport> run(Editor& editor, const OutputTarget& target,
                                        std::span<const PrimitiveReport> reports);

  private:
    Model& model_;
    const GenerateOptions& options_;
    std::vector<std::size_t> numbers_ = {};     ///< primitives that show normal maps
    Scene before_ = {};                         ///< these, in this order
    std::map<std::size_t, Bytes> images_ = {};  ///< the files of their maps, by number of the image
};

}  // namespace tspace::gltf
