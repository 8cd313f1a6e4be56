// SPDX-License-Identifier: MIT
// HTML report of check, with pictures of the findings before and after the fix.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/check/check_report.h"
#include "commands/pages/page_parts.h"
#include "model/scene/scene.h"
#include "tspace/callbacks.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/render.h"

namespace tspace {

// Runs the command of a remedy in memory.

/// Returns the options of a generate command, or nothing if it has placeholders.
std::optional<GenerateOptions> optionsOf(const RemedyCommand& command);

/// Returns the result of a command on a model, with its images, as a scene to draw. `file`: options for reading
/// `input`. Throws FileError.
DrawnScene fixedScene(const std::string& input, const FileOptions& file, GenerateOptions options);

// Pictures of the locations of findings.

struct FindingPicture {
    std::vector<std::uint8_t> before = {};  ///< PNG of the location in the original file; empty: no pictures
    /// PNG of the location after the command of the remedy; empty if there is no visible difference.
    std::vector<std::uint8_t> after = {};
    std::vector<std::uint8_t> difference = {};  ///< PNG of the difference; `caption` explains it
    std::string caption = {};
    std::string command = {};       ///< command of the remedy; empty: none
    std::string why_no_after = {};  ///< if there is a command without a picture: the reason, as a sentence
    bool is_clay = false;           ///< base colors are omitted, because they would hide the difference
};

/// Draws the findings of a checked model.
class FindingPictures {
  public:
    /// Reads the model. Throws FileError.
    FindingPictures(const std::string& input, const FileOptions& options);
    ~FindingPictures();
    FindingPictures(const FindingPictures&) = delete;
    FindingPictures& operator=(const FindingPictures&) = delete;

    /// Draws the location of a finding, before and after the command of its remedy. With both pictures, camera and
    /// light are chosen to show the difference best (drawPair). Without a picture after the command, the camera is
    /// above the triangles at the finding's vertices, or shows the whole primitive if the finding lists no vertices.
    /// There is no picture at all if the scene does not draw the primitive, or if the command makes no visible
    /// difference. Each command is run once for all findings that name it. Throws FileError.
    FindingPicture draw(const Finding& finding);

  private:
    struct Model;

    /// Fills `result`, or returns why there is no picture after the command.
    std::string drawAfter(const RemedyCommand& command, std::size_t primitive, std::span<const std::size_t> triangles,
                          RenderFrames frames, FindingPicture& result);

    std::unique_ptr<Model> model_;
};

/// Returns the pictures of checkPage as JSON: a list with the indexes of file and finding, the caption, and the PNG.
Json picturesJson(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file,
                  const Progress& progress = {});

/// Returns the section of a page about one file, with a heading. `room`: limit for pictures, in bytes.
std::string checkedFileHtml(const report::CheckOutcome& outcome, std::size_t number, const FileOptions& file,
                            std::size_t room, const Progress& progress = {});

/// Returns a self-contained HTML page: a summary, an overview if there are several files, and the findings of each
/// file, with pictures of their locations before and after the fix where possible. Files are read again for the
/// pictures, with the options `file`; files that cannot be read again, such as stdin, have none. All text from files is
/// escaped. Pictures take at most 1.5 MB per file and 12 MB per page; further findings have none.
std::string checkPage(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file,
                      const PageOrigin& origin, const Progress& progress = {});

/// Returns the section of a report page about one file, without pictures.
std::string findingsHtml(const report::CheckOutcome& outcome);

}  // namespace tspace
