// SPDX-License-Identifier: MIT
// Embeds the files of a model as blocks of data in the page, adds the content that is shown without scripts, and writes
// the report as JSON. Browsers do not execute a script element whose type is not a script language.
#include "commands/view/view_report.h"

#include <filesystem>
#include <mutex>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "commands/check/scene_checks.h"
#include "commands/pages/check_page.h"
#include "commands/pages/page_parts.h"
#include "commands/render/model_picture.h"
#include "commands/shared/map_image_file.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/uri.h"
#include "model/read/read_scene.h"
#include "tspace/version.h"

namespace tspace {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPlaceOfModel = "<!-- model -->";

/// Returns a lit picture from the front; empty if nothing can be drawn.
std::string pictureHtml(ModelFile& model) {
    const RenderOptions render{.width = 480, .height = 360, .legend = false};
    try {
        const PosedScene posed = model.posedScene(true);
        ModelTextures textures(posed.drawn.scene, render.most_pixels);
        const ModelPicture picture(posed.drawn, RenderShow::lit, {}, {}, &textures, posed.poses);
        if (picture.meshes().empty()) return {};
        return figuresHtml(
            figureHtml(encodePicture(drawModel(picture, render).image), render.width, render.height, "as in the file"));
    } catch (const FileError&) {
        return {};
    }
}

/// Returns the content for readers that execute no script: mail, previews, text browsers.
std::string stillHtml(const Path& input, ModelFile& model, const PageOrigin& origin) {
    report::CheckOutcome outcome{.input = fileNameOf(input.string())};
    // Arrays that cannot be read are reported by a finding on the page.
    outcome.result = atFileBorder([&]() -> Result<CheckReport> { return checkScene(model.scene(true), {}).report; });
    return "<noscript><div class=\"still\">\n" + originHtml(origin) + pictureHtml(model) + findingsHtml(outcome) +
           "</div></noscript>\n";
}

/// Content of the page that is computed from the model.
struct ViewedModel {
    std::string still = {};            ///< content without scripts
    std::set<std::string> files = {};  ///< files that the model references, relative to its folder
};

ViewedModel readViewed(const Path& input, const FileOptions& options, const PageOrigin& origin, InputFiles& inputs) {
    if (!isGltfName(input) && lowerExtension(input) != ".obj") {
        failFile(
            ErrorCode::unsupportedFile,
            "the page supports .glb, .vrm, .gltf and .obj; convert the model first with tspace generate IN -o OUT.glb");
    }
    const fs::path folder = fs::path(folderOf(input)).lexically_normal();
    ViewedModel viewed;
    std::mutex mutex;
    FileOptions watched = options;
    inputs.watch(watched);
    watched.opened = [&, told = watched.opened](const std::string& file) {
        told(file);
        const std::lock_guard lock(mutex);
        if (file != input.string())
            viewed.files.insert(Path(fs::path(Path(file)).lexically_normal().lexically_relative(folder)).string());
    };
    watched.named = {};  // null: images are reported to `opened`, too
    ModelFile model(input.string(), watched);
    if (!model.isObj()) static_cast<void>(model.gltf().primitives());  // fails if the primitives are invalid
    viewed.still = stillHtml(input, model, origin);
    return viewed;
}

std::string embeddedFile(const std::string& name, const Path& file) {
    return "<script type=\"application/octet-stream\" data-name=\"" + htmlText(name) + "\">" +
           encodeBase64(readFile(file)) + "</script>\n";
}

/// Returns the origin of the page as a data block for its scripts.
std::string originBlock(const PageOrigin& origin) {
    const Json json = {{"version", TSPACE_VERSION_STRING}, {"date", origin.date}, {"command", origin.command}};
    std::string html = "<script type=\"application/json\" id=\"origin\">";
    for (const char c : report::jsonText(json)) html += c == '<' ? "\\u003c" : std::string(1, c);
    return html + "</script>\n";
}

}  // namespace

Result<ViewReport> writeViewPage(const Path& input, const Path& output, const Path& page, const FileOptions& options,
                                 const PageOrigin& origin) {
    return atFileBorder([&]() -> Result<ViewReport> {
        InputFiles inputs;
        inputs.add(page);
        const Bytes html = readFile(page);
        const std::string_view text(reinterpret_cast<const char*>(html.data()), html.size());
        const std::size_t place = text.find(kPlaceOfModel);
        if (place == std::string_view::npos)
            failFile(ErrorCode::unsupportedFile, "the page " + pathInQuotes(page) + " is not a page of tspace view");
        const ViewedModel viewed = readViewed(input, options, origin, inputs);
        ViewReport report;
        report.files.push_back(fileNameOf(input.string()));
        std::string made(text.substr(0, place));
        made += embeddedFile(report.files[0], input);
        for (const std::string& name : viewed.files) {
            made += embeddedFile(name, folderOf(input) / name);
            report.files.push_back(name);
        }
        made += originBlock(origin) + viewed.still;
        made += text.substr(place + kPlaceOfModel.size());
        AtomicOutput target({.sync = options.sync, .inputs = &inputs});
        target.add(output, std::span(reinterpret_cast<const std::uint8_t*>(made.data()), made.size()));
        target.commit();
        report.output_bytes = target.byteCount();
        return report;
    });
}

}  // namespace tspace

namespace tspace::report {

std::string viewJson(const Outcome<ViewReport>& outcome, ExitCode exit_code) {
    const Result<ViewReport>& result = outcome.result;
    Json json = documentJson("tspace.view/1", result.ok(), exit_code);
    json["input"] = outcome.input;
    json["output"] = outcome.output;
    json["error"] = errorJson(result ? nullptr : &result.error());
    if (!result) return jsonText(json);
    json["files"] = result->files;
    json["outputBytes"] = result->output_bytes;
    return jsonText(json);
}

}  // namespace tspace::report
