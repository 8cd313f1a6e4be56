// SPDX-License-Identifier: MIT
// Images of any model with any options: the result is an error, or a PNG of the requested size that is equal for one
// and two threads.
#include <string>
#include <vector>

#include "images/image.h"
#include "made_image.h"
#include "made_model.h"
#include "tspace/render.h"

namespace {

using namespace tspace;

RenderOptions optionsOf(ByteReader& in) {
    RenderOptions options{.show = static_cast<RenderShow>(in.byte() % 7),
                          .width = 16U + in.byte() % 24U,
                          .height = 16U + in.byte() % 24U,
                          .samples = 1U + in.byte() % 4U};
    options.yaw_deg = in.byte() == 255 ? static_cast<double>(in.any()) : in.byte() * 1.5;
    options.pitch_deg = in.byte() * 0.75 - 90;
    options.field_of_view_deg = in.byte() % 121;
    options.to_light = {static_cast<float>(in.byte()) - 128, static_cast<float>(in.byte()) - 128, 1};
    options.frames = static_cast<RenderFrames>(in.byte() % 3);
    options.method = static_cast<Method>(in.byte() % 10);
    const unsigned flags = in.byte();
    options.reading.two_channels = (flags & 1) != 0;
    options.reading.unit_vectors = (flags & 2) != 0;
    options.reading.green = (flags & 4) != 0 ? Green::down : Green::up;
    options.reading.bitangent = (flags & 8) != 0 ? BitangentPlace::perVertex : BitangentPlace::perPixel;
    options.textures = (flags & 16) == 0;
    return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(data, size);
    RenderOptions options = optionsOf(in);
    const std::vector<std::uint8_t> image = fuzz::makePng(in), model = fuzz::ModelMaker(in, image).glb();
    std::vector<std::uint8_t> pngs[2];
    options.file.content = model;
    for (std::size_t i = 0; i < 2; ++i) {
        options.execution.thread_count = static_cast<unsigned>(1 + i);
        options.sink = [&png = pngs[i]](std::span<const std::uint8_t> piece) {
            png.insert(png.end(), piece.begin(), piece.end());
            return true;
        };
        const Result<RenderReport> report = renderFile("a.glb", "a.png", options);
        require(report.ok() || !report.error().message.empty(), "an error has a message");
        if (!report) {
            require(pngs[i].empty(), "a call that fails gives no picture");
            continue;
        }
        std::string why;
        const auto picture = decodeImage(pngs[i], 1 << 20, why);
        require(picture && picture->width == options.width && picture->height == options.height,
                "the picture has the size that was asked for");
        require(report->mean_error_deg >= 0 && report->mean_error_deg <= report->max_error_deg + 1e-9 &&
                    report->max_error_deg <= 180.001,
                "angles are in order");
    }
    require(pngs[0] == pngs[1], "two threads draw the same picture");
    return 0;
}
