// SPDX-License-Identifier: MIT
// A comparison as a page for people, with pictures of how two models differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/pages/page_parts.h"
#include "commands/pages/place_pictures.h"
#include "tspace/inspect.h"

namespace tspace {

// Pictures of how two models differ.

class DiffPictures {
  public:
    static constexpr std::uint32_t kHeatWidth = 440, kHeatHeight = 360;

    /// Throws FileError.
    DiffPictures(const std::string& a, const std::string& b, const DiffOptions& options);

    enum class Side { front, back };
    /// A PNG of all of A, each point in the colour of the largest angle between its frame and that of B, and the scale
    /// of the colours. Empty where its scene draws nothing. Throws FileError.
    [[nodiscard]] std::vector<std::uint8_t> heatMap(Side side);

    struct Place {
        std::vector<std::uint8_t> a = {}, b = {}, angle = {};
    };
    /// PNGs of the triangles at a vertex, outlined: in A and in B, lit, and in the colours of heatMap; empty where that is
    /// not drawn. Throws FileError.
    [[nodiscard]] Place place(const FrameDifference& difference);

  private:
    [[nodiscard]] std::vector<OtherFrames> framesOfB() const;
    const ModelPicture& heat();

    PicturedModel a_, b_;
    std::vector<PrimitivePair> pairs_;
    std::vector<OtherFrames> others_;  ///< frames of B at the corners of A
    std::unique_ptr<ModelPicture> heat_ = {};
};

/// One HTML file that needs nothing else: the summary, a heat map of the largest angle between the frames on the surface of
/// A, the tables of the text, and the worst places in A and in B. Both files are read once more for the pictures, as
/// `options` says; where one cannot be, or is not drawn, they are missing and a sentence says why. All text from files is
/// escaped. Pictures take 1.5 MB at most.
std::string diffPage(const std::string& a, const std::string& b, const FrameDiff& diff, const DiffOptions& options,
                     const PageOrigin& origin);

}  // namespace tspace
