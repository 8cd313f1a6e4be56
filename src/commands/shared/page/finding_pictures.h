// SPDX-License-Identifier: MIT
// Pictures of the places that findings are about.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tspace/check.h"

namespace tspace {

struct FindingPicture {
    std::vector<std::uint8_t> before =
        {};  ///< a PNG of the place as the file is; empty: there is none, and nothing else
    std::vector<std::uint8_t> after = {};  ///< a PNG of that place after the remedy's command
    std::string command = {};              ///< that command; empty: the remedy names none
    std::string why_no_after = {};         ///< where there is a command: a sentence
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
    /// picture where the file's scene does not draw it. A command is run once for all findings that name it. Throws
    /// FileError.
    FindingPicture draw(const Finding& finding);

  private:
    struct Model;
    std::unique_ptr<Model> model_;
};

}  // namespace tspace
