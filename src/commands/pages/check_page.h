// SPDX-License-Identifier: MIT
// Findings as a page for people, with pictures of their places before and after the remedy.
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

/// Options of a generate command; nothing if it leaves a choice open.
std::optional<GenerateOptions> optionsOf(const RemedyCommand& command);

/// Result of a command on a model, with its images, as a scene to draw. `file`: how `input` is opened. Throws FileError.
DrawnScene mendedScene(const std::string& input, const FileOptions& file, GenerateOptions options);

// Pictures of the places that findings are about.

struct FindingPicture {
    std::vector<std::uint8_t> before =
        {};  ///< a PNG of the place as the file is; empty: there is none, and nothing else
    std::vector<std::uint8_t> after =
        {};  ///< a PNG of that place after the remedy's command, where it shows a difference
    std::vector<std::uint8_t> difference = {};  ///< a PNG of the difference; `caption` says how it is to be read
    std::string caption = {};
    std::string command = {};       ///< the remedy's command; empty: it names none
    std::string why_no_after = {};  ///< if there is a command without a picture: the reason, a sentence
    bool is_clay = false;           ///< base colors are left out, because they would hide the difference
};

/// A model that was checked.
class FindingPictures {
  public:
    /// Throws FileError.
    FindingPictures(const std::string& input, const FileOptions& options);
    ~FindingPictures();
    FindingPictures(const FindingPictures&) = delete;
    FindingPictures& operator=(const FindingPictures&) = delete;

    /// With a picture after the command, camera and light are those that show the difference best (drawPair); else the camera
    /// stands over the triangles of the finding's vertices, or sees all of a primitive where it names none. No
    /// picture where the file's scene does not draw it, or where the command changes nothing that can be seen. A command is run once for
    /// all findings that name it. Throws FileError.
    FindingPicture draw(const Finding& finding);

  private:
    struct Model;

    /// Fills `result`, or returns why there is no picture after the command.
    std::string drawAfter(const RemedyCommand& command, std::size_t primitive, std::span<const std::size_t> triangles,
                          RenderFrames frames, FindingPicture& result);

    std::unique_ptr<Model> model_;
};

/// The part of a page about one file, under a heading. `room`: for pictures, in bytes.
std::string checkedFileHtml(const report::CheckOutcome& outcome, std::size_t number, const FileOptions& file,
                            std::size_t room, const Progress& progress = {});

/// One HTML file that needs nothing else: a summary, an overview where there are several files, and of each file its
/// findings, with pictures of their places before and after the remedy where that can be shown. Files are read once more
/// for the pictures, as `file` says; of one that cannot be, such as stdin, there are none. All text from files is
/// escaped. Pictures of one file take 1.5 MB at most, and of all 12 MB; then findings come without.
std::string checkPage(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file,
                      const PageOrigin& origin, const Progress& progress = {});

/// The part of such a page about one file, without pictures.
std::string findingsHtml(const report::CheckOutcome& outcome);

}  // namespace tspace
