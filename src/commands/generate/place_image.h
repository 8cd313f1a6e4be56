// SPDX-License-Identifier: MIT
// New image files in the place of those of a glTF document.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "model/gltf/container.h"
#include "model/gltf/editor.h"

namespace tspace::gltf {

/// Puts one image file in the place of another. Files beside the document are never changed: the output has new ones.
class ImagePlacer {
  public:
    /// `ending`: of the names of new files, "-green-up".
    ImagePlacer(Document& document, Editor& editor, const OutputTarget& target, std::string ending)
        : document_(document), editor_(editor), target_(target), ending_(std::move(ending)) {}

    /// Images that have their bytes from one place get one new place. `keeps_old`: somebody else still needs what the image
    /// had.
    void place(std::size_t image, Bytes&& bytes, bool keeps_old);
    /// The same for this image alone.
    void placeOwn(std::size_t image, Bytes&& bytes) { put(image, std::move(bytes), false, false); }
    /// A new entry of /images, otherwise like entry `like`. Returns its index.
    std::size_t add(std::size_t like, Bytes&& bytes);

  private:
    void put(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all);
    void takeIn(std::size_t image, Bytes&& bytes);
    void putInView(std::size_t image, Bytes&& bytes, bool keeps_old, bool is_of_all);
    void putInFile(std::size_t image, const std::string& uri, Bytes&& bytes, bool is_of_all);
    std::string freeName(const std::string& uri, const Bytes& bytes);

    Document& document_;
    Editor& editor_;
    const OutputTarget& target_;
    std::string ending_;
    std::map<std::size_t, std::size_t> views_ = {};  ///< from views to those that took their place
    std::map<std::string, std::string> files_ = {};  ///< from URIs to new names
};

/// The file of an image, if it lies in one, is part of the input.
void noteInputFile(Document& document, std::size_t image);

}  // namespace tspace::gltf
