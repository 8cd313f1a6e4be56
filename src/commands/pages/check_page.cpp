// SPDX-License-Identifier: MIT

#include "commands/pages/check_page.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "commands/check/check_image.h"
#include "commands/check/findings.h"
#include "commands/generate/generate_model.h"
#include "commands/pages/picture_pair.h"
#include "commands/pages/place_pictures.h"
#include "commands/shared/report.h"
#include "commands/shared/request.h"
#include "model/io/file_error.h"
#include "model/io/uri.h"

namespace tspace {
namespace {

constexpr const char* kNothingToSee = "The fix changes nothing that is visible in this picture.";

/// Returns the first command of a finding that operates on the model, or null.
const RemedyCommand* modelCommand(const Finding& finding) {
    const auto found = std::find_if(finding.commands.begin(), finding.commands.end(),
                                    [](const RemedyCommand& command) { return command.verb == "generate"; });
    return found == finding.commands.end() ? nullptr : &*found;
}

}  // namespace

std::optional<GenerateOptions> optionsOf(const RemedyCommand& command) {
    if (!command.placeholders.empty()) return {};
    GenerateOptions result;
    const options::OptionList list = options::generateOptions(result);
    options::Given given;
    for (const RemedyOption& part : command.options) {
        const options::Option* option = options::findOption(list, "--" + part.name);
        const bool is_known = option != nullptr && option->value.empty() == part.value.empty();
        if (!is_known || !options::giveValue(*option, part.value, given).empty()) return {};
    }
    if (!options::checkTogether(list, given).empty() || !options::finish(given, result).empty()) return {};
    return result;
}

DrawnScene fixedScene(const std::string& input, const FileOptions& file, GenerateOptions options) {
    options.file = file;
    return generateModel(input, options, true).model.drawnScene(true);
}

struct FindingPictures::Model {
    /// The model after a command was applied.
    struct FixedModel {
        FixedModel(const std::string& input, const FileOptions& options, const Scene& before,
                   const GenerateOptions& command)
            : model(fixedScene(input, options, command)), pairs(pairPrimitives(before, model.scene())) {}

        PicturedModel model;
        std::vector<PrimitivePair> pairs;
    };

    /// The result of running a command: a model, or the reason why there is none.
    struct FixResult {
        std::unique_ptr<FixedModel> model = {};
        std::string why_not = {};
    };

    Model(std::string path, const FileOptions& options) : input(std::move(path)), file(options), before(input, file) {}

    /// Returns the result of a command, which is run at the first call. `line`: the command line of `command`.
    FixResult& resultOf(const std::string& line, const GenerateOptions& command) {
        const auto [fix, is_new] = fixes.try_emplace(line);
        if (is_new) run(command, fix->second);
        return fix->second;
    }

    void run(const GenerateOptions& command, FixResult& fix) {
        try {
            fix.model = std::make_unique<FixedModel>(input, file, before.scene(), command);
        } catch (const FileError& failure) {
            fix.why_not = "The fix could not be run for this report: " + failure.error.message + ".";
        }
    }

    std::string input;
    FileOptions file;
    PicturedModel before;
    std::map<std::string, FixResult> fixes = {};
};

FindingPictures::FindingPictures(const std::string& input, const FileOptions& options)
    : model_(std::make_unique<Model>(input, options)) {}

FindingPictures::~FindingPictures() = default;

FindingPicture FindingPictures::draw(const Finding& finding) {
    FindingPicture result;
    const std::size_t primitive = findPrimitive(model_->before.scene(), finding.mesh, finding.primitive);
    if (finding.place.empty() || primitive == kNoPrimitive) return result;
    // The picture before the fix must not contain computed tangents, which would hide that the file has none.
    const bool lacks = finding.code == FindingCode::tangentsMissing || finding.code == FindingCode::tangentsIgnored;
    const RenderFrames frames = lacks ? RenderFrames::stored : RenderFrames::automatic;
    const std::vector<std::size_t> triangles =
        trianglesAt(model_->before.scene().primitives[primitive], finding.vertices);
    if (const RemedyCommand* const command = modelCommand(finding)) {
        result.command = commandLine(*command);
        result.why_no_after = drawAfter(*command, primitive, triangles, frames, result);
        if (!result.after.empty() || result.why_no_after == kNothingToSee) return result;
    }
    result.before = drawPlace(model_->before.lit(frames), RenderShow::lit, primitive, triangles);
    return result;
}

std::string FindingPictures::drawAfter(const RemedyCommand& command, std::size_t primitive,
                                       std::span<const std::size_t> triangles, RenderFrames frames,
                                       FindingPicture& result) {
    const std::optional<GenerateOptions> options = optionsOf(command);
    if (!options) return "The command contains a value that must be chosen.";
    const Model::FixResult& fix = model_->resultOf(commandLine(command), *options);
    if (!fix.model) return fix.why_not;
    const auto pair = std::find_if(fix.model->pairs.begin(), fix.model->pairs.end(),
                                   [&](const PrimitivePair& candidate) { return candidate.a == primitive; });
    if (pair == fix.model->pairs.end() || pair->b == kNoPrimitive)
        return "The fix triangulates this area differently, so pictures before and after would not correspond.";
    PicturePair drawn =
        drawPair({model_->before.lit(frames), primitive}, triangles, {fix.model->model.lit(frames), pair->b});
    if (drawn.before.empty()) return kNothingToSee;
    result.before = std::move(drawn.before);
    result.after = std::move(drawn.after);
    result.difference = std::move(drawn.difference);
    result.is_clay = drawn.is_clay;
    const auto tenths = static_cast<std::uint64_t>(1000 * drawn.differing_share);
    result.caption = "difference" +
                     (drawn.gain == 1 ? std::string() : ", " + std::to_string(drawn.gain) + " times as bright") + ": " +
                     std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % of the pixels differ";
    return {};
}

namespace {

using report::counted;

constexpr std::size_t kMaxPicturedFindings = 12;

std::string severityCounts(const CheckReport& report) {
    if (report.findings.empty()) return "<b class=\"good\">nothing found</b>";
    return "<b class=\"error\">" + counted(report.error_count, "error") + "</b>, <b class=\"warning\">" +
           counted(report.warning_count, "warning") + "</b>, <b class=\"note\">" + counted(report.note_count, "note") +
           "</b>";
}

std::string whereHtml(const Finding& finding) {
    if (finding.place.empty()) return {};
    std::string text = "mesh " + std::to_string(finding.mesh);
    if (!finding.mesh_name.empty()) text += " \"" + htmlText(finding.mesh_name) + "\"";
    text += ", primitive " + std::to_string(finding.primitive);
    if (!finding.material_name.empty()) text += ", material \"" + htmlText(finding.material_name) + "\"";
    return "<p class=\"dim\">" + text + " (at " + htmlText(finding.place) + ")</p>\n";
}

/// Returns whether a finding is about morph targets, which pictures of the base mesh do not show.
bool concernsTargets(const Finding& finding) { return finding.place.find("/targets/") != std::string::npos; }

/// The pictures of a finding with their captions, and a sentence that explains a missing picture.
struct Figures {
    struct Figure {
        std::vector<std::uint8_t> png;
        std::string caption;
    };
    std::vector<Figure> figures = {};
    std::string remark = {};
};

Figures figuresOf(const Finding& finding, FindingPicture&& picture) {
    if (picture.before.empty()) {
        if (picture.why_no_after.empty()) return {};
        return {.remark = "No pictures: " + picture.command + " changes nothing that is visible in a picture" +
                          (concernsTargets(finding) ? " of the base mesh; the fault appears when it deforms."
                                                    : " of this primitive.")};
    }
    const std::string command = "after " + picture.command;
    Figures result;
    result.figures.push_back(
        {std::move(picture.before), picture.is_clay ? "as in the file, without base color" : "as in the file"});
    if (!picture.after.empty()) {
        result.figures.push_back({std::move(picture.after), command});
        result.figures.push_back({std::move(picture.difference), std::move(picture.caption)});
    } else {
        result.remark = picture.command.empty()
                            ? "No picture of the fix was made, because no tspace command performs it."
                            : "There is no picture " + command + ". " + picture.why_no_after;
    }
    return result;
}

/// Draws the pictures of one file until the size limit is reached; draws none if the file cannot be drawn. The file is
/// read when the first picture is requested.
class PictureSource {
  public:
    PictureSource(std::string input, const FileOptions& file, std::size_t room, const Progress& progress)
        : input_(std::move(input)), file_(file), progress_(progress), room_(room) {}

    [[nodiscard]] const std::string& input() const { return input_; }

    Figures draw(const Finding& finding) {
        if (finding.place.empty() || is_exhausted_ || input_ == "-") return {};
        Figures result;
        if (progress_) progress_("drawing pictures", count_, kMaxPicturedFindings);
        try {
            if (!pictures_) pictures_ = std::make_unique<FindingPictures>(input_, file_);
            result = figuresOf(finding, pictures_->draw(finding));
        } catch (const FileError&) {
            // The error of the file has already been reported.
            is_exhausted_ = true;
        }
        if (result.figures.empty()) return result;
        std::size_t size = 0;
        for (const Figures::Figure& figure : result.figures) size += (figure.png.size() + 2) / 3 * 4;  // as base64
        is_exhausted_ = is_exhausted_ || size > room_ || ++count_ >= kMaxPicturedFindings;
        if (size > room_) return {};
        room_ -= size;
        return result;
    }

  private:
    std::string input_;
    FileOptions file_;
    const Progress& progress_;
    std::unique_ptr<FindingPictures> pictures_ = {};
    std::size_t room_, count_ = 0;
    bool is_exhausted_ = false;
};

std::string picturesHtml(const Figures& pictures) {
    std::string html;
    for (const Figures::Figure& figure : pictures.figures)
        html += figureHtml(figure.png, kPlaceWidth, kPlaceHeight, figure.caption);
    if (!pictures.remark.empty()) html += noFigureHtml(pictures.remark);
    return figuresHtml(html);
}

/// Returns a finding as HTML. `pictures` may be null: no pictures.
std::string findingHtml(const Finding& finding, PictureSource* pictures) {
    std::string html = "<article class=\"" + std::string(severityName(finding.severity)) + "\">\n<h3><b>" +
                       severityName(finding.severity) + "</b> " + findingName(finding.code) + "</h3>\n";
    html += "<p>" + htmlText(finding.message) + "</p>\n" + whereHtml(finding);
    html += "<p>Fix: " + htmlText(finding.remedy) + "</p>\n";
    if (pictures == nullptr) return html + "</article>\n";
    html += picturesHtml(pictures->draw(finding));
    if (const char* look = findingView(finding.code);
        *look != '\0' && pictures->input() != "-" && !finding.place.empty())
        html += "<p>A larger picture: <code>" +
                htmlText("tspace render " + shellWord(pictures->input()) + " -o picture.png --show " + look) +
                "</code></p>\n";
    return html + "</article>\n";
}

std::string anchorOf(std::size_t number) { return "file-" + std::to_string(number + 1); }

std::string fileHtml(const report::CheckOutcome& outcome, std::size_t number, PictureSource* pictures) {
    std::string html = "<section id=\"" + anchorOf(number) + "\">\n<h2>" + htmlText(outcome.input) + "</h2>\n";
    if (!outcome.result) {
        return html + "<article class=\"error\"><h3><b>error</b> not read</h3><p>" +
               htmlText(outcome.result.error().message) + "</p></article>\n</section>\n";
    }
    const CheckReport& report = *outcome.result;
    if (report.image) {
        html += "<p>" + severityCounts(report) + "; " + htmlText(imageText(report)) + "</p>\n";
        for (const Finding& finding : report.findings) html += findingHtml(finding, nullptr);
        return html + "</section>\n";
    }
    html += "<p>" + severityCounts(report) + " in " + counted(report.primitive_count, "primitive") + ", " +
            std::to_string(report.tangents_count) + " of them with tangents; examined " +
            counted(report.image_count, "normal map") +
            "; checked channel contents, and the direction of green (determined for " +
            std::to_string(report.green_count) + " of them)</p>\n";
    if (!report.generator.empty()) html += "<p class=\"dim\">made by " + htmlText(report.generator) + "</p>\n";
    for (const Finding& finding : report.findings) html += findingHtml(finding, pictures);
    return html + "</section>\n";
}

std::string overviewHtml(const std::vector<report::CheckOutcome>& outcomes) {
    std::string html(kWideTable);
    html +=
        "<thead><tr><th>file</th><th class=\"n\">errors</th><th class=\"n\">warnings</th>"
        "<th class=\"n\">notes</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        html += "<tr><td><a href=\"#" + anchorOf(i) + "\">" + htmlText(outcomes[i].input) + "</a></td>";
        if (const auto& result = outcomes[i].result; result) {
            for (const std::uint64_t count : {result->error_count, result->warning_count, result->note_count})
                html += "<td class=\"n\">" + std::to_string(count) + "</td>";
        } else {
            html += "<td colspan=\"3\" class=\"n\"><b class=\"error\">could not be read</b></td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

Json picturesJson(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file,
                  const Progress& progress) {
    Json list = Json::array();
    std::size_t left = kMaxPageBytes;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (!outcomes[i].result || outcomes[i].result->image) continue;
        PictureSource source(outcomes[i].input, file, std::min(left, kMaxModelBytes), progress);
        for (std::size_t k = 0; k < outcomes[i].result->findings.size(); ++k) {
            for (const auto& [png, caption] : source.draw(outcomes[i].result->findings[k]).figures) {
                const std::string text = encodeBase64({png.begin(), png.end()});
                left -= std::min(left, text.size());
                list.push_back(Json::object({{"file", i}, {"finding", k}, {"caption", caption}, {"png", text}}));
            }
        }
    }
    return list;
}

std::string checkedFileHtml(const report::CheckOutcome& outcome, std::size_t number, const FileOptions& file,
                            std::size_t room, const Progress& progress) {
    PictureSource pictures(outcome.input, file, room, progress);
    return fileHtml(outcome, number, &pictures);
}

std::string findingsHtml(const report::CheckOutcome& outcome) { return fileHtml(outcome, 0, nullptr); }

std::string checkPage(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file,
                      const PageOrigin& origin, const Progress& progress) {
    std::string html = pageHead("tspace check");
    html += "<h1>Findings in " + counted(outcomes.size(), "file") + "</h1>\n";
    html += originHtml(origin) +
            "<p class=\"dim\">Severities: error: wrong shading in every renderer; warning: wrong shading in some "
            "renderers or in a small area, or uncertain; note: harmless. A frame marks the location of a finding. "
            "Pictures before "
            "and after the fix use the camera and the light that show the difference best.</p>\n";
    if (outcomes.size() > 1) html += overviewHtml(outcomes);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const std::size_t left = html.size() < kMaxPageBytes ? kMaxPageBytes - html.size() : 0;
        html += checkedFileHtml(outcomes[i], i, file, std::min(left, kMaxModelBytes), progress);
    }
    return html + pageEnd();
}

}  // namespace tspace
