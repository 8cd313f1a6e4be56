// SPDX-License-Identifier: MIT
// renderFile: reads a model, draws it, and writes the picture; its report as JSON.
#include <algorithm>
#include <cmath>
#include <deque>

#include "commands/render/model_picture.h"
#include "commands/render/render_report.h"
#include "core/base/vec_math.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"

namespace tspace {
namespace {

void checkRenderOptions(const RenderOptions& options) {
    constexpr std::uint32_t kMinPixels = 16, kMaxPixels = 8192, kMaxSamples = 16384;
    constexpr std::uint64_t kMaxInAll = std::uint64_t{1} << 26;
    for (const std::uint32_t pixels : {options.width, options.height}) {
        if (pixels < kMinPixels || pixels > kMaxPixels)
            failFile(ErrorCode::invalidOption, "the width and height of a picture must be from 16 to 8192 pixels");
        if (options.samples < 1 || options.samples > 4 || pixels * options.samples > kMaxSamples)
            failFile(ErrorCode::invalidOption,
                     "the number of samples per side of a pixel must be from 1 to 4, and the picture may have at most "
                     "16384 samples per side");
    }
    if (std::uint64_t{options.width} * options.samples * options.height * options.samples > kMaxInAll)
        failFile(ErrorCode::invalidOption, "the picture has more than 67108864 samples; use fewer samples per pixel");
    if (!std::isfinite(options.yaw_deg) || !std::isfinite(options.pitch_deg))
        failFile(ErrorCode::invalidOption, "the angles of the view must be finite numbers");
    if (!(options.field_of_view_deg >= 0 && options.field_of_view_deg <= 120))
        failFile(ErrorCode::invalidOption, "the field of view must be from 0 to 120 degrees");
    DVec3 light = toDouble(options.to_light);
    if (!normalize(light)) failFile(ErrorCode::invalidOption, "the direction to the light must not be zero");
    if (options.turntable < 1 || options.turntable > 999)
        failFile(ErrorCode::invalidOption, "the number of pictures of a turntable must be from 1 to 999");
    if (!std::isfinite(options.reading.scale))
        failFile(ErrorCode::invalidOption, "the scale of the normal map must be a finite number");
}

bool showsTangents(RenderShow show) {
    return show == RenderShow::tangents || show == RenderShow::sign || show == RenderShow::error;
}

/// Draws one model. Contains one ModelPicture, or two for RenderShow::both (stored and computed frames).
class ModelPictures {
  public:
    ModelPictures(const PosedScene& posed, ModelTextures* textures, const RenderOptions& options) : options_(options) {
        const std::span<const ScenePose> poses =
            options.pose ? std::span<const ScenePose>(posed.poses) : std::span<const ScenePose>();
        const bool compares = options.show == RenderShow::error;
        const auto add = [&](RenderShow show, RenderFrames frames) {
            const FrameChoice choice{.frames = frames,
                                     .method = options.method,
                                     .always = showsTangents(options.show),
                                     .compare = compares,
                                     .execution = options.execution};
            models_.emplace_back(posed.drawn, show, choice, options.reading, textures, poses);
        };
        if (options.show == RenderShow::both) {
            add(RenderShow::lit, RenderFrames::stored);
            add(RenderShow::lit, RenderFrames::computed);
        } else {
            add(options.show, compares ? RenderFrames::stored : options.frames);
        }
    }

    /// Returns the model whose frames the report counts.
    [[nodiscard]] const ModelPicture& counted() const { return models_.back(); }

    /// Returns the picture with the camera rotated by `yaw_deg`.
    [[nodiscard]] SurfacePicture draw(double yaw_deg) const {
        RenderOptions options = options_;
        options.yaw_deg = yaw_deg;
        if (models_.size() == 1) return drawModel(models_.front(), options);
        const Legend legend =
            options.legend ? legendOfBoth(models_[0].tangentSources(), models_[1].tangentSources(), options.method)
                           : Legend{};
        const std::uint32_t rows = legendRows(legend, options.width, options.height);
        options.show = RenderShow::lit;
        options.legend = false;
        options.height -= rows;
        SurfacePicture picture{
            .image = sideBySide(drawModel(models_[0], options).image, drawModel(models_[1], options).image)};
        addLegend(legend, rows, picture.image);
        return picture;
    }

  private:
    const RenderOptions& options_;
    std::deque<ModelPicture> models_ = {};
};

/// Returns "turn_007.png" for "turn.png" and 7.
std::string numbered(const std::string& output, std::uint32_t number) {
    const std::size_t dot = output.rfind('.');
    std::string digits = std::to_string(number);
    digits.insert(0, 3 - std::min<std::size_t>(3, digits.size()), '0');
    return dot == std::string::npos ? output + "_" + digits : output.substr(0, dot) + "_" + digits + output.substr(dot);
}

RenderReport renderModel(const std::string& input, const std::string& output, const RenderOptions& options) {
    checkRenderOptions(options);
    const auto tell = [&](const char* what, std::uint32_t done, std::uint32_t total) {
        if (options.progress) options.progress(what, done, total);
    };
    tell("reading", 0, 1);
    InputFiles inputs;
    FileOptions file_options = options.file;
    inputs.watch(file_options);
    PosedScene posed = readPosedScene(input, file_options, options.textures);
    DrawnScene& drawn = posed.drawn;
    tell("computing frames", 0, 1);
    std::vector<std::string> height_warnings;
    if (options.textures && options.show != RenderShow::uv)
        height_warnings = showHeights(options.method, options.execution, drawn);
    ModelTextures textures(drawn.scene, options.most_pixels);
    const ModelPictures pictures(posed, options.textures ? &textures : nullptr, options);
    const ModelPicture& model = pictures.counted();
    RenderReport report{.show = options.show, .width = options.width, .height = options.height};
    report.picture_count = options.turntable;
    report.primitive_count = drawn.scene.primitives.size();
    report.warnings = drawn.scene.warnings;
    for (const DrawnMesh& mesh : model.meshes()) report.triangle_count += mesh.corners.size() / 3;
    for (std::size_t i = 0; i < drawn.scene.primitives.size(); ++i) {
        const ModelSurface& surface = model.surfaceOf(i);
        report.computed_count += !surface.computed.empty();
        report.without_tangents_count +=
            !drawn.scene.primitives[i].corners.empty() && showsTangents(options.show) && surface.shown.tangents.empty();
    }
    AtomicOutput files(
        {.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.file.sync, .inputs = &inputs});
    ErrorStatistics errors;
    std::deque<std::vector<std::uint8_t>> pngs;
    for (std::uint32_t i = 0; i < options.turntable; ++i) {
        tell("drawing", i, options.turntable);
        const SurfacePicture picture = pictures.draw(options.yaw_deg + 360.0 * i / options.turntable);
        errors.add(picture.errors);
        pngs.push_back(encodePicture(picture.image));
        files.add(options.turntable == 1 ? output : numbered(output, i), std::span<const std::uint8_t>(pngs.back()));
    }
    report.error_sample_count = errors.count;
    report.max_error_deg = errors.max_deg;
    if (errors.count > 0) report.mean_error_deg = errors.sum_deg / static_cast<double>(errors.count);
    report.warnings.insert(report.warnings.end(), height_warnings.begin(), height_warnings.end());
    report.warnings.insert(report.warnings.end(), textures.warnings.begin(), textures.warnings.end());
    files.commit();
    return report;
}

}  // namespace

const char* renderShowName(RenderShow show) {
    constexpr const char* kNames[] = {"lit", "normals", "tangents", "sign", "error", "uv", "mapped", "both"};
    const auto number = static_cast<std::size_t>(show);
    return number < std::size(kNames) ? kNames[number] : "";
}

Result<RenderReport> renderFile(const std::string& input, const std::string& output, const RenderOptions& options) {
    return atFileBorder([&]() -> Result<RenderReport> { return renderModel(input, output, options); });
}

}  // namespace tspace

namespace tspace::report {

std::string renderJson(const Outcome<RenderReport>& outcome, ExitCode exit_code) {
    const Result<RenderReport>& result = outcome.result;
    Json json = madeFileJson("tspace.render/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["show"] = renderShowName(result->show);
    json["width"] = result->width;
    json["height"] = result->height;
    json["pictures"] = result->picture_count;
    json["primitives"] = result->primitive_count;
    json["triangles"] = result->triangle_count;
    json["primitivesComputed"] = result->computed_count;
    json["primitivesWithoutTangents"] = result->without_tangents_count;
    json["tangentError"] = nullptr;
    if (result->error_sample_count > 0) {
        json["tangentError"] = Json::object({{"samples", result->error_sample_count},
                                             {"meanDeg", result->mean_error_deg},
                                             {"maxDeg", result->max_error_deg}});
    }
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
