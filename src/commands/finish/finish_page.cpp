// SPDX-License-Identifier: MIT
// HTML report of tspace finish.
#include <algorithm>

#include "commands/finish/finish_report.h"
#include "commands/pages/check_page.h"
#include "commands/pages/page_parts.h"
#include "commands/render/model_picture.h"
#include "model/io/file_error.h"
#include "model/read/read_scene.h"
#include "tspace/version.h"

namespace tspace {
namespace {

constexpr std::uint32_t kViewWidth = 440, kViewHeight = 360;
constexpr double kYawDeg = 35, kBehindDeg = 215;

/// Returns whether a picture shows nothing: an open surface with a single-sided material is not drawn from behind.
bool isBlank(const RgbImage& image) {
    for (std::size_t i = 3; i < image.rgb.size(); ++i) {
        if (image.rgb[i] != image.rgb[i - 3]) return false;
    }
    return true;
}

}  // namespace

std::string viewsHtml(ModelFile& model, const std::string& caption) {
    std::string figures;
    const std::optional<Error> failure = tryFile([&] {
        const DrawnScene drawn = model.drawnScene(true);
        ModelTextures textures(drawn.scene, RenderOptions{}.most_pixels);
        const auto add = [&](RenderShow show, double yaw_deg, const std::string& words) {
            RenderOptions options;
            options.show = show;
            options.width = kViewWidth;
            options.height = kViewHeight;
            options.yaw_deg = yaw_deg;
            const ModelPicture picture(drawn, show, {}, {}, &textures);
            const Legend legend = picture.legend();
            const std::uint32_t rows = legendRows(legend, options.width, options.height);
            options.legend = false;
            options.height -= rows;
            RgbImage image = drawModel(picture, options).image;
            if (isBlank(image)) {
                figures += noFigureHtml(caption + ", " + words + ": nothing is visible from this side.");
                return;
            }
            addLegend(legend, rows, image);
            figures += figureHtml(encodePicture(image), kViewWidth, kViewHeight, caption + ", " + words);
        };
        add(RenderShow::lit, kYawDeg, "lit");
        add(RenderShow::lit, kBehindDeg, "lit, from behind");
        add(RenderShow::mapped, kYawDeg, "the shaded normals, as colors");
    });
    if (failure) figures += noFigureHtml("No picture: " + failure->message + ".");
    return figuresHtml(figures);
}

namespace {

std::string countsRow(const std::string& what, const CheckReport& check) {
    std::string row = "<tr><td>" + htmlText(what) + "</td>";
    for (const std::uint64_t count : {check.error_count, check.warning_count, check.note_count})
        row += "<td class=\"n\">" + std::to_string(count) + "</td>";
    return row + "</tr>\n";
}

std::string listHtml(const std::vector<std::string>& sentences) {
    if (sentences.empty()) return {};
    std::string html = "<ul>\n";
    for (const std::string& sentence : sentences) html += "<li>" + htmlText(sentence) + "</li>\n";
    return html + "</ul>\n";
}

std::string beforeHtml(const FinishedModel& model, const std::string& views) {
    return "<h2>" + htmlText(model.path) + "</h2>\n" + listHtml(report::doneTo(model)) + views;
}

std::string mapsHtml(const BakeFileReport& bake) {
    std::string rows;
    const auto add = [&](const std::string& map, const std::string& path, const std::string& words) {
        rows +=
            "<tr><td>" + htmlText(path) + "</td><td>" + htmlText(map) + "</td><td>" + htmlText(words) + "</td></tr>\n";
    };
    for (const BakedFile& map : bake.files) {
        const std::string size = std::to_string(map.map.width) + " x " + std::to_string(map.map.height);
        if (!map.path.empty()) {
            const auto hundredths = static_cast<std::uint64_t>(map.map.error.mean_deg * 100 + 0.5);
            const std::string digits = std::to_string(100 + hundredths % 100).substr(1);
            add("normal", map.path,
                size + ", error " + std::to_string(hundredths / 100) + "." + digits + " degrees on average");
        }
        for (const BakedLayerFile& layer : map.layers) add(layerName(layer.layer), layer.path, size);
    }
    return "<h2>Maps</h2>\n" + std::string(kWideTable) +
           "<thead><tr><th>file</th><th>content</th><th></th></tr></thead><tbody>\n" + rows +
           "</tbody></table></div>\n";
}

}  // namespace

std::string finishPage(const FinishReport& report, const FinishViews& views, const std::string& output_path,
                       std::span<const std::uint8_t> output, const FileOptions& file, const PageOrigin& origin) {
    FileOptions finished = file;
    finished.content = output;
    std::string html = pageHead("tspace finish");
    html += "<h1>" + htmlText(output_path) + "</h1>\n" + originHtml(origin) +
            "<p class=\"dim\">tspace finish changes only data that is missing or wrong. The table counts the findings "
            "of tspace check.</p>\n";
    html += kWideTable;
    html +=
        "<thead><tr><th>model</th><th class=\"n\">errors</th><th class=\"n\">warnings</th>"
        "<th class=\"n\">notes</th></tr></thead><tbody>\n";
    html += countsRow(report.model.path + " (before)", report.model.before);
    if (report.low) html += countsRow(report.low->path + " (before)", report.low->before);
    html += countsRow(output_path, report.check) + "</tbody></table></div>\n";
    html += listHtml(report.remarks);
    if (report.bake) html += listHtml(report.bake->findings) + listHtml(report.bake->warnings);
    html += beforeHtml(report.model, views.model);
    if (report.low) html += beforeHtml(*report.low, views.low);
    html += "<h2>Now</h2>\n" + views.now;
    if (report.bake) html += mapsHtml(*report.bake);
    report::CheckOutcome outcome{.input = output_path};
    outcome.result = report.check;
    return html + checkedFileHtml(outcome, 0, finished, kMaxModelBytes) + pageEnd();
}

}  // namespace tspace
