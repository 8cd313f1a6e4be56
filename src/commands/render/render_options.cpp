// SPDX-License-Identifier: MIT
// Options of tspace render: view, camera and light.
#include <array>
#include <cstdlib>

#include "commands/shared/file_options.h"
#include "commands/shared/request.h"
#include "core/base/vec_math.h"

namespace tspace::options {
namespace {

constexpr Named<RenderShow> kShows[] = {
    {"lit", RenderShow::lit},       {"normals", RenderShow::normals}, {"tangents", RenderShow::tangents},
    {"sign", RenderShow::sign},     {"error", RenderShow::error},     {"uv", RenderShow::uv},
    {"mapped", RenderShow::mapped}, {"both", RenderShow::both},
};
constexpr Named<RenderFrames> kShownFrames[] = {
    {"auto", RenderFrames::automatic},
    {"stored", RenderFrames::stored},
    {"computed", RenderFrames::computed},
};
struct NamedView {
    const char* name;
    double yaw_deg, pitch_deg;
};
constexpr NamedView kViews[] = {{"front", 0, 0}, {"back", 180, 0},   {"left", -90, 0},         {"right", 90, 0},
                                {"top", 0, 90},  {"bottom", 0, -90}, {"three-quarter", 35, 20}};

/// Parses exactly `count` numbers, separated by commas.
template <std::size_t count>
bool parseNumbers(const std::string& text, std::array<double, count>& numbers) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t end = i + 1 < count ? text.find(',', begin) : text.size();
        if (end == std::string::npos || !parseReal(text.substr(begin, end - begin), numbers[i])) return false;
        begin = end + 1;
    }
    return true;
}

Vec3 directionOf(double yaw_deg, double pitch_deg) {
    const SineCosine yaw = sineCosine(yaw_deg * (kPi / 180)), pitch = sineCosine(pitch_deg * (kPi / 180));
    return toFloat({yaw.sine * pitch.cosine, pitch.sine, yaw.cosine * pitch.cosine});
}

Option viewOption(RenderOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        for (const NamedView& view : kViews) {
            if (text != view.name) continue;
            options.yaw_deg = view.yaw_deg;
            options.pitch_deg = view.pitch_deg;
            return {};
        }
        std::array<double, 2> angles{};
        if (!parseNumbers(text, angles) || std::abs(angles[0]) > 360 || std::abs(angles[1]) > 90) {
            return "must be front, back, left, right, top, bottom, three-quarter, or YAW,PITCH in degrees, yaw from "
                   "-360 to 360 and pitch from -90 to 90";
        }
        options.yaw_deg = angles[0];
        options.pitch_deg = angles[1];
        return {};
    };
    Option made = option("--view", "VIEW", take,
                         "Camera position: front (at +z, the front of glTF models), back, left, right (at +x), top (at "
                         "+y), bottom, three-quarter, or YAW,PITCH in degrees.");
    made.default_text = "three-quarter";
    return made;
}

Option lightOption(RenderOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        std::array<double, 2> angles{};
        std::array<double, 3> toward{};
        if (parseNumbers(text, toward)) {
            options.to_light = {static_cast<float>(toward[0]), static_cast<float>(toward[1]),
                                static_cast<float>(toward[2])};
        } else if (parseNumbers(text, angles) && std::abs(angles[0]) <= 360 && std::abs(angles[1]) <= 90) {
            options.to_light = directionOf(angles[0], angles[1]);
        } else {
            return "must be X,Y,Z, or YAW,PITCH in degrees, yaw from -360 to 360 and pitch from -90 to 90";
        }
        const Vec3& light = options.to_light;
        return light.x == 0 && light.y == 0 && light.z == 0 ? "must not be 0" : "";
    };
    Option made = option("--light", "DIRECTION", take,
                         "Direction to the light for lit and both, in camera space. X,Y,Z: right, up, and toward the "
                         "camera; YAW,PITCH in degrees, where 0,0 is the direction to the camera.");
    made.default_text = "-0.45,0.65,0.8";
    return made;
}

Option sizeOption(RenderOptions& options) {
    const auto take = [&options](const std::string& text) -> std::string {
        const std::size_t cross = text.find('x');
        std::uint64_t width = 0, height = 0;
        const std::string second = cross == std::string::npos ? text : text.substr(cross + 1);
        constexpr std::uint64_t kMin = 16, kMax = 8192;
        if (!parseNumber(text.substr(0, cross), width) || !parseNumber(second, height) || width < kMin ||
            height < kMin || width > kMax || height > kMax)
            return "must be N or WIDTHxHEIGHT, 16 to 8192 pixels";
        options.width = static_cast<std::uint32_t>(width);
        options.height = static_cast<std::uint32_t>(height);
        return {};
    };
    Option made = option("--size", "SIZE", take, "Picture size in pixels: N for a square, or WIDTHxHEIGHT.");
    made.default_text = "1024";
    return made;
}

}  // namespace

OptionList renderOptions(RenderOptions& options) {
    OptionList list;
    const auto add = adder(list, "Picture"), addFrame = adder(list, "Frames");
    options::add(list, kInputAndOutput, dryRunOption(options.dry_run));
    addAllowExternal(list, options.file);
    add(choice("--show", "WHAT", kShows, options.show,
               "Content of the picture. lit: the model under one light, with its normal maps; normals: N as colors; "
               "tangents: T as colors; sign: the tangent sign w, with stripes where UVs are mirrored; error: the angle "
               "between the file's tangents and those of --method; uv: the UV map with its islands; mapped: the "
               "normals after normal mapping, as used by the mode lit, shown as colors; both: lit, divided by a line, "
               "with the file's tangents on its left and those of --method on its right."));
    add(viewOption(options));
    add(lightOption(options));
    add(sizeOption(options));
    add(degrees("--fov", options.field_of_view_deg, 120,
                "Field of view along the shorter side, in degrees, 0 to 120; 0: orthographic."));
    add(number("--samples", options.samples, 4,
               "Number of samples along each side of a pixel, 1 to 4. 1: only the pixel center, so that colors are "
               "exact."));
    add(number("--turntable", options.turntable, 999,
               "Number of pictures of a turntable about the vertical axis: OUT_000.png, OUT_001.png, ... The camera "
               "keeps its distance. 1: a single picture, OUT."));
    add(setting("--no-legend", options.legend, false, "Omit the legend below the picture."));
    add(setting("--no-pose", options.pose, false, "Ignore bones and morph targets: draw the model in its bind pose."));
    addFrame(
        choice("--frames", "SOURCE", kShownFrames, options.frames,
               "Source of the tangents shown. auto: the file's tangents, or those of --method if the file has none; "
               "stored: only the file's; computed: always those of --method. --show error always compares both."));
    addFrame(choice("--method", "NAME", kMethods, options.method, "Method of the computed tangents, as in generate."));
    addFrame(readingOption("--reading", options.reading,
                           "Program whose shading convention for normal maps is used: gltf (green up; N and T are used "
                           "as interpolated, because glTF does not specify that they are normalized), opengl, directx, "
                           "unreal, unity, blender, godot or three. Tangents always follow the glTF convention."))
        .value = "PROGRAM";
    addFrame(setting("--no-textures", options.textures, false, "Ignore base color textures and normal maps."));
    addRunning(list, options.execution, options.file,
               "Number of threads; 0: one per core. The picture is the same for any number of threads.");
    return list;
}

}  // namespace tspace::options
