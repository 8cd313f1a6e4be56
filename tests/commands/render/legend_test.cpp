// SPDX-License-Identifier: MIT
// Legends below pictures.
#include "commands/shared/picture/legend.h"

#include "commands/render/drawn.h"
#include "commands/shared/picture/colors.h"

namespace tspace::test {
namespace {

constexpr RenderShow kEveryShow[] = {RenderShow::lit,   RenderShow::normals, RenderShow::tangents, RenderShow::sign,
                                     RenderShow::error, RenderShow::uv,      RenderShow::mapped,   RenderShow::both};

std::string wordsOf(const Legend& legend) {
    std::string words;
    for (const LegendEntry& entry : legend.entries) words += "[" + entry.text + "]";
    return words;
}

std::vector<std::uint8_t> rowsOf(const RgbImage& image, std::uint32_t from, std::uint32_t to) {
    const std::size_t row = std::size_t{3} * image.width;
    return {image.rgb.begin() + static_cast<std::ptrdiff_t>(from * row),
            image.rgb.begin() + static_cast<std::ptrdiff_t>(to * row)};
}

TEST(RenderLegend, IsBelowEveryViewWithoutChangingThePicture) {
    const GltfBuilder model = SquareModel().build();
    for (const RenderShow show : kEveryShow) {
        RenderOptions options = plainView(show, 512);
        options.legend = RenderOptions{}.legend;
        const RgbImage with = draw(model, options).image;
        ASSERT_EQ(with.height, 512U) << renderShowName(show);
        // A legend has one to three lines of text with two pixels per dot, with or without a scale.
        options.legend = false;
        std::uint32_t fitting = 0;
        for (const std::uint32_t dots : {17U, 28U, 39U, 37U, 48U, 59U}) {
            options.height = 512 - 2 * dots;
            if (draw(model, options).image.rgb == rowsOf(with, 0, options.height)) fitting = 2 * dots;
        }
        ASSERT_GT(fitting, 0U) << renderShowName(show);
        int inked = 0;
        for (const std::uint8_t byte : rowsOf(with, 512 - fitting, 512)) inked += byte == roundedChannel(kPictureInk.x);
        EXPECT_GT(inked, 300) << renderShowName(show);
    }
}

TEST(RenderLegend, FitsIntoPicturesOfAnyWidth) {
    const TangentSources sources{.stored = true, .computed = true, .missing = true, .has_map = true};
    for (const RenderShow show : kEveryShow) {
        const Legend legend = show == RenderShow::both ? legendOfBoth(sources, sources, Method::mikktspace)
                                                       : legendOf(show, sources, Method::mikktspace);
        for (std::uint32_t width = 100; width < 2200; width += 37) {
            const std::uint32_t rows = legendRows(legend, width, 4096);
            EXPECT_EQ(rows > 0, width >= 200);
            EXPECT_EQ(legendRows(legend, width, rows * 3 - 1), 0U) << "no more than a third";
            if (rows == 0) continue;
            RgbImage image{.width = width, .height = 16, .rgb = std::vector<std::uint8_t>(std::size_t{3} * 16 * width)};
            addLegend(legend, rows, image);
            ASSERT_EQ(image.height, 16 + rows);
            for (std::uint32_t y = 16; y < image.height; ++y) {
                const std::size_t last = std::size_t{3} * ((std::size_t{y} + 1) * width - 1);
                EXPECT_EQ(image.rgb[last], roundedChannel(kBackground.x)) << renderShowName(show) << ' ' << width;
            }
        }
    }
}

TEST(RenderLegend, NamesTheSourceOfTheTangents) {
    const auto words = [](const TangentSources& sources) {
        return wordsOf(legendOf(RenderShow::lit, sources, Method::fast));
    };
    EXPECT_EQ(words({.stored = true, .has_map = true}), "[LIT BY ONE LAMP][TANGENTS OF THE FILE]");
    EXPECT_EQ(words({.computed = true, .has_map = true}), "[LIT BY ONE LAMP][TANGENTS BY FAST]");
    EXPECT_EQ(words({.stored = true, .computed = true}), "[LIT BY ONE LAMP][TANGENTS OF THE FILE,][ELSE BY FAST]");
    EXPECT_EQ(words({.missing = true}), "[LIT BY ONE LAMP][NO NORMAL MAP]");
    EXPECT_EQ(words({.missing = true, .has_map = true}), "[LIT BY ONE LAMP][NO TANGENTS, FLAT]");
    EXPECT_EQ(wordsOf(legendOf(RenderShow::error, {.stored = true}, Method::mikktspace)), "[DEGREES FROM MIKKTSPACE]");
    EXPECT_EQ(wordsOf(legendOf(RenderShow::error, {.missing = true, .has_other = true}, Method::mikktspace)),
              "[DEGREES FROM THE OTHER MODEL][NOT COMPARED]");
    EXPECT_EQ(wordsOf(legendOfBoth({.missing = true, .has_map = true}, {.computed = true}, Method::best)),
              "[LEFT: NO TANGENTS, FLAT][RIGHT: TANGENTS BY BEST]");
}

TEST(RenderLegend, ExplainsGrayIfItOccurs) {
    EXPECT_EQ(wordsOf(legendOf(RenderShow::sign, {.stored = true}, Method::mikktspace)),
              "[W = +1][W = -1][UV MIRRORED][WRONG SIGN][NEITHER][TANGENTS OF THE FILE]");
    EXPECT_EQ(wordsOf(legendOf(RenderShow::tangents, {.missing = true}, Method::mikktspace)),
              "[+X][+Y][+Z][NO TANGENTS]");
}

}  // namespace
}  // namespace tspace::test
