// SPDX-License-Identifier: MIT
// Pictures of the places that findings are about.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tspace/check.h"

namespace tspace {

/// PNG files; empty: there is none.
struct FindingPicture {
    std::vector<std::uint8_t> before = {};  ///< the place as the file is, its triangles outlined
    std::vector<std::uint8_t> after = {};   ///< the same with what the remedy gives, where that can be shown
};

/// A model that was checked.
class FindingPictures {
  public:
    /// Throws FileError.
    FindingPictures(const std::string& input, const FileOptions& options);
    ~FindingPictures();
    FindingPictures(const FindingPictures&) = delete;
    FindingPictures& operator=(const FindingPictures&) = delete;

    /// The camera stands over the triangles of the finding's vertices, or sees all of a primitive where it names none. No
    /// picture where the file's scene does not draw it. Throws FileError.
    FindingPicture draw(const Finding& finding);

  private:
    struct Model;
    std::unique_ptr<Model> model_;
};

}  // namespace tspace
