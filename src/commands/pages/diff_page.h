// SPDX-License-Identifier: MIT
// HTML report of diff, with pictures of the differences.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/pages/page_parts.h"
#include "commands/pages/place_pictures.h"
#include "tspace/inspect.h"

namespace tspace {

// Pictures of the differences of two models.

class DiffPictures {
  public:
    static constexpr std::uint32_t kHeatWidth = 440, kHeatHeight = 360;

    /// Reads both models. Throws FileError.
    DiffPictures(const std::string& a, const std::string& b, const DiffOptions& options);

    enum class Side { front, back };
    /// Returns a PNG of all of A, colored by the largest angle between its frames and those of B, with the color scale.
    /// Empty if the scene draws nothing. Throws FileError.
    [[nodiscard]] std::vector<std::uint8_t> heatMap(Side side);

    struct Place {
        std::vector<std::uint8_t> a = {}, b = {}, angle = {};
    };
    /// Returns PNGs of the triangles at a vertex, outlined: in A and in B, lit, and in the colors of heatMap; empty if
    /// they are not drawn. Throws FileError.
    [[nodiscard]] Place place(const FrameDifference& difference);

  private:
    [[nodiscard]] std::vector<OtherFrames> framesOfB() const;
    const ModelPicture& heat();

    PicturedModel a_, b_;
    std::vector<PrimitivePair> pairs_;
    std::vector<OtherFrames> others_;  ///< frames of B at the corners of A
    std::unique_ptr<ModelPicture> heat_ = {};
};

/// Returns a self-contained HTML page: the summary, a heat map of the largest angle between the frames on the surface
/// of A, the tables of the text report, and the worst corners in A and in B. Both files are read again for the
/// pictures, with `options`; if a file cannot be read again or drawn, a sentence replaces its pictures. All text from
/// files is escaped. Pictures take at most 1.5 MB.
std::string diffPage(const std::string& a, const std::string& b, const FrameDiff& diff, const DiffOptions& options,
                     const PageOrigin& origin);

}  // namespace tspace
