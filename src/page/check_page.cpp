// SPDX-License-Identifier: MIT
#include "page/check_page.h"

#include <algorithm>
#include <memory>

#include "asset/file_error.h"
#include "asset/uri.h"
#include "page/finding_pictures.h"

namespace tspace {

namespace {

constexpr std::size_t kMostPicturedFindings = 12, kMostFileBytes = 1500000, kMostPageBytes = 12000000;

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>tspace check</title>
<style>
:root{color-scheme:light dark;--paper:#fbfcfd;--ink:#1d2329;--dim:#5a6570;--line:#d7dde3;--card:#fff;
--error:#b3261e;--warning:#8a5a00;--note:#2c5f8a;--good:#2b6b3c}
@media(prefers-color-scheme:dark){:root{--paper:#14181c;--ink:#e4e9ed;--dim:#9aa7b2;--line:#333c45;--card:#1c2228;
--error:#ff8a80;--warning:#f2bd5a;--note:#8ec5f2;--good:#86d39a}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
main{max-width:60rem;margin:0 auto;padding:1.5rem 1rem 4rem}
h1{font-size:1.4rem;margin:0 0 .25rem}h2{font-size:1.15rem;margin:2.5rem 0 .25rem;overflow-wrap:anywhere}
p{margin:.25rem 0}.dim{color:var(--dim)}
.scroll{overflow-x:auto}table{border-collapse:collapse;width:100%;margin:1rem 0}
th,td{text-align:left;padding:.35rem .6rem .35rem 0;border-bottom:1px solid var(--line)}
td:first-child{overflow-wrap:anywhere}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}
article{background:var(--card);border:1px solid var(--line);border-left:4px solid var(--note);border-radius:4px;
padding:.75rem 1rem;margin:.75rem 0;overflow-wrap:anywhere}
article.error{border-left-color:var(--error)}article.warning{border-left-color:var(--warning)}
h3{font-size:1rem;margin:0}.error>h3>b,b.error{color:var(--error)}.warning>h3>b,b.warning{color:var(--warning)}
.note>h3>b,b.note{color:var(--note)}b.good{color:var(--good)}
.pictures{display:flex;flex-wrap:wrap;gap:.75rem;margin-top:.75rem}
figure{margin:0;flex:0 1 320px}img{display:block;width:100%;height:auto;border-radius:3px}
figcaption{color:var(--dim);font-size:.875rem}
a{color:inherit}
</style></head><body><main>
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            default:
                result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    }
    return result;
}

std::string pluralText(std::uint64_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string severityCounts(const CheckReport& report) {
    if (report.findings.empty()) return "<b class=\"good\">nothing found</b>";
    return "<b class=\"error\">" + pluralText(report.error_count, "error") + "</b>, <b class=\"warning\">" +
           pluralText(report.warning_count, "warning") + "</b>, <b class=\"note\">" +
           pluralText(report.note_count, "note") + "</b>";
}

std::string whereHtml(const Finding& finding) {
    if (finding.place.empty()) return {};
    std::string text = "mesh " + std::to_string(finding.mesh);
    if (!finding.mesh_name.empty()) text += " \"" + escaped(finding.mesh_name) + "\"";
    text += ", primitive " + std::to_string(finding.primitive);
    if (!finding.material_name.empty()) text += ", material \"" + escaped(finding.material_name) + "\"";
    return "<p class=\"dim\">" + text + " (at " + escaped(finding.place) + ")</p>\n";
}

std::string figureHtml(const std::vector<std::uint8_t>& png, const char* caption) {
    if (png.empty()) return {};
    return "<figure><img alt=\"" + std::string(caption) + "\" width=\"320\" height=\"240\" src=\"" +
           encodeDataUri("image/png", Bytes(png.begin(), png.end())) + "\"><figcaption>" + caption +
           "</figcaption></figure>\n";
}

/// Pictures of one file, as long as there is room; nothing where they cannot be had. The file is read when the first is
/// asked for.
class PictureSource {
  public:
    PictureSource(std::string input, const FileOptions& file, std::size_t room)
        : input_(std::move(input)), file_(file), room_(room) {}

    std::string html(const Finding& finding) {
        if (finding.place.empty() || is_over_ || input_ == "-") return {};
        std::string figures;
        try {
            if (!pictures_) pictures_ = std::make_unique<FindingPictures>(input_, file_);
            const FindingPicture picture = pictures_->draw(finding);
            const bool has_two = !picture.after.empty();
            figures = figureHtml(picture.before, has_two ? "as the file is" : "the place") +
                      figureHtml(picture.after, "mended");
        } catch (const FileError&) {
            // What is wrong with the file has been said.
            is_over_ = true;
        }
        if (figures.empty()) return {};
        is_over_ = is_over_ || figures.size() > room_ || ++count_ >= kMostPicturedFindings;
        if (figures.size() > room_) return {};
        room_ -= figures.size();
        return "<div class=\"pictures\">\n" + figures + "</div>\n";
    }

  private:
    std::string input_;
    FileOptions file_;
    std::unique_ptr<FindingPictures> pictures_ = {};
    std::size_t room_, count_ = 0;
    bool is_over_ = false;
};

std::string findingHtml(const Finding& finding, PictureSource& pictures) {
    std::string html = "<article class=\"" + std::string(severityName(finding.severity)) + "\">\n<h3><b>" +
                       severityName(finding.severity) + "</b> " + findingName(finding.code) + "</h3>\n";
    html += "<p>" + escaped(finding.message) + "</p>\n" + whereHtml(finding);
    html += "<p>Mend: " + escaped(finding.remedy) + "</p>\n" + pictures.html(finding);
    return html + "</article>\n";
}

std::string anchorOf(std::size_t number) { return "file-" + std::to_string(number + 1); }

std::string fileHtml(const report::CheckOutcome& outcome, std::size_t number, const FileOptions& file,
                     std::size_t room) {
    std::string html = "<section id=\"" + anchorOf(number) + "\">\n<h2>" + escaped(outcome.input) + "</h2>\n";
    if (!outcome.result) {
        return html + "<article class=\"error\"><h3><b>error</b> not read</h3><p>" +
               escaped(outcome.result.error().message) + "</p></article>\n</section>\n";
    }
    const CheckReport& report = *outcome.result;
    html += "<p>" + severityCounts(report) + " in " + pluralText(report.primitive_count, "primitive") + ", " +
            std::to_string(report.tangents_count) + " of them with tangents; looked at " +
            pluralText(report.image_count, "normal map") + "</p>\n";
    if (!report.generator.empty()) html += "<p class=\"dim\">made by " + escaped(report.generator) + "</p>\n";
    PictureSource pictures(outcome.input, file, room);
    for (const Finding& finding : report.findings) html += findingHtml(finding, pictures);
    return html + "</section>\n";
}

std::string overviewHtml(const std::vector<report::CheckOutcome>& outcomes) {
    std::string html =
        "<div class=\"scroll\"><table><thead><tr><th>file</th><th class=\"n\">errors</th><th class=\"n\">warnings</th>"
        "<th class=\"n\">notes</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        html += "<tr><td><a href=\"#" + anchorOf(i) + "\">" + escaped(outcomes[i].input) + "</a></td>";
        if (const auto& result = outcomes[i].result; result) {
            for (const std::uint64_t count : {result->error_count, result->warning_count, result->note_count})
                html += "<td class=\"n\">" + std::to_string(count) + "</td>";
        } else {
            html += "<td colspan=\"3\" class=\"n\"><b class=\"error\">not read</b></td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

}  // namespace

std::string checkPage(const std::vector<report::CheckOutcome>& outcomes, const FileOptions& file) {
    std::string html = kHead;
    html += "<h1>Frames of " + pluralText(outcomes.size(), "file") + "</h1>\n";
    html +=
        "<p class=\"dim\">Found by tspace check. An error surely renders wrong; a warning renders wrong in some "
        "renderers, "
        "in a small part, or only perhaps; a note is worth knowing. Triangles of a finding are outlined.</p>\n";
    if (outcomes.size() > 1) html += overviewHtml(outcomes);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const std::size_t left = html.size() < kMostPageBytes ? kMostPageBytes - html.size() : 0;
        html += fileHtml(outcomes[i], i, file, std::min(left, kMostFileBytes));
    }
    return html + "</main></body></html>\n";
}

}  // namespace tspace
