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

struct EmbeddedFile {
    std::string name;
    Bytes bytes;
};

/// Returns the model, then each file that it references. Converting the model to GLB opens all of them.
std::vector<EmbeddedFile> filesOf(const Path& input, const FileOptions& options, InputFiles& inputs) {
    if (!isGltfName(input) && lowerExtension(input) != ".obj") {
        failFile(
            ErrorCode::unsupportedFile,
            "the page supports .glb, .vrm, .gltf and .obj; convert the model first with tspace generate IN -o OUT.glb");
    }
    const std::string& path = input.string();
    const fs::path folder = fs::path(folderOf(input)).lexically_normal();
    std::mutex mutex;
    std::set<std::string> named;
    GenerateOptions ask;
    ask.file = options;
    inputs.watch(ask.file);
    ask.file.opened = [&, told = ask.file.opened](const std::string& file) {
        told(file);
        const std::lock_guard lock(mutex);
        if (file != path)
            named.insert(Path(fs::path(Path(file)).lexically_normal().lexically_relative(folder)).string());
    };
    ask.file.named = {};  // `opened` receives them
    ask.sink = [](std::span<const std::uint8_t>) { return true; };
    valueOrThrow(generateFile(path, "view.glb", ask));
    std::vector<EmbeddedFile> files;
    files.push_back({path.substr(path.rfind('/') + 1), readFile(input)});
    for (const std::string& name : named) files.push_back({name, readFile(folderOf(input) / name)});
    return files;
}

/// Returns a lit picture from the front; empty if nothing can be drawn.
std::string pictureHtml(const Path& input, const FileOptions& options) {
    const RenderOptions render{.width = 480, .height = 360, .legend = false};
    try {
        const PosedScene posed = readPosedScene(input.string(), options, true);
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
std::string stillHtml(const Path& input, const FileOptions& options, const PageOrigin& origin) {
    const std::string name = fileNameOf(input.string());
    return "<noscript><div class=\"still\">\n" + originHtml(origin) + pictureHtml(input, options) +
           findingsHtml({.input = name, .result = checkFile(input.string(), {.file = options})}) +
           "</div></noscript>\n";
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
        ViewReport report;
        std::string made(text.substr(0, place));
        for (const EmbeddedFile& file : filesOf(input, options, inputs)) {
            made += "<script type=\"application/octet-stream\" data-name=\"" + htmlText(file.name) + "\">";
            made += encodeBase64(file.bytes);
            made += "</script>\n";
            report.files.push_back(file.name);
        }
        made += originBlock(origin) + stillHtml(input, options, origin);
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
