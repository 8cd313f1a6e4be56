// SPDX-License-Identifier: MIT

#include "commands/pages/page_parts.h"

#include "model/io/uri.h"
#include "tspace/version.h"

namespace tspace {
namespace {

constexpr const char* kBeforeTitle = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>)";
constexpr const char* kAfterTitle = R"(</title>
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
figure{margin:0;flex:1 1 220px;max-width:320px}img{display:block;width:100%;height:auto;border-radius:3px}
figcaption{color:var(--dim);font-size:.875rem}
figure.wide{flex-basis:320px;max-width:440px}td.wide{width:60%}.bar{display:inline-block;height:.7rem;background:var(--note);border-radius:2px}
.none{display:flex;align-items:center;border:1px dashed var(--line);border-radius:3px;padding:1rem;max-width:320px;
color:var(--dim);font-size:.875rem}
a{color:inherit}code{overflow-wrap:anywhere}
@media print{article,figure{break-inside:avoid}}
</style></head><body><main>
)";

}  // namespace

std::string pageHead(std::string_view title) { return kBeforeTitle + std::string(title) + kAfterTitle; }

std::string pageEnd() { return "</main></body></html>\n"; }

std::string originHtml(const PageOrigin& origin) {
    std::string html = "<p class=\"dim\">tspace " TSPACE_VERSION_STRING;
    if (!origin.date.empty()) html += ", " + htmlText(origin.date);
    if (!origin.command.empty()) html += ": <code>" + htmlText(origin.command) + "</code>";
    return html + "</p>\n";
}

std::string figureHtml(const std::vector<std::uint8_t>& png, std::uint32_t width, std::uint32_t height,
                       std::string_view caption) {
    if (png.empty()) return {};
    const std::string words = htmlText(caption);
    return std::string("<figure") + (width > kPlaceWidth ? " class=\"wide\"" : "") + "><img alt=\"" + words +
           "\" width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height) + "\" src=\"" +
           encodeDataUri("image/png", Bytes(png.begin(), png.end())) + "\"><figcaption>" + words +
           "</figcaption></figure>\n";
}

std::string noFigureHtml(std::string_view sentence) { return "<p class=\"none\">" + htmlText(sentence) + "</p>\n"; }

std::string figuresHtml(const std::string& figures) {
    return figures.empty() ? figures : "<div class=\"pictures\">\n" + figures + "</div>\n";
}

std::string shellWord(const std::string& word) {
    constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+@%-";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string htmlText(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            case '\'': result += "&#39;"; break;
            default:
                if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
                    result += "&#" + std::to_string(static_cast<int>(c)) + ";";
                else
                    result += c;
        }
    }
    return result;
}

}  // namespace tspace
