// SPDX-License-Identifier: MIT

#include "commands/pages/diff_page.h"

#include <algorithm>

#include "commands/diff/diff_report.h"
#include "commands/pages/page_parts.h"
#include "commands/render/model_picture.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Returns the normals and tangents of B at the corners of A. Vectors that B lacks are zero; a list is empty if it is
/// not compared.
OtherFrames framesAtCorners(const ScenePrimitive& a, const ScenePrimitive& b, const PrimitivePair& pair) {
    OtherFrames frames;
    const bool has_normals = !a.normals.empty() && !b.normals.empty();
    // The list of tangents is not empty if only one side has tangents, so that its corners count as not comparable.
    if (has_normals) frames.normals.resize(a.corners.size());
    if (!a.tangents.empty() || !b.tangents.empty()) frames.tangents.resize(a.corners.size());
    for (const TrianglePair& two : pair.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = std::size_t{3} * two.a + k;
            const std::uint32_t vertex = b.corners[std::size_t{3} * two.b + (k + two.rotation) % 3];
            if (has_normals) frames.normals[corner] = b.normals[vertex];
            if (!b.tangents.empty()) frames.tangents[corner] = b.tangents[vertex];
        }
    }
    return frames;
}

}  // namespace

DiffPictures::DiffPictures(const std::string& a, const std::string& b, const DiffOptions& options)
    : a_(a, options.file), b_(b, options.file_b.value_or(options.file)), pairs_(pairPrimitives(a_.scene(), b_.scene())),
      others_(framesOfB()) {}

std::vector<OtherFrames> DiffPictures::framesOfB() const {
    std::vector<OtherFrames> others(a_.scene().primitives.size());
    for (const PrimitivePair& pair : pairs_) {
        if (pair.a == kNoPrimitive || pair.b == kNoPrimitive) continue;
        others[pair.a] = framesAtCorners(a_.scene().primitives[pair.a], b_.scene().primitives[pair.b], pair);
    }
    return others;
}

const ModelPicture& DiffPictures::heat() {
    if (!heat_) {
        const FrameChoice choice{.frames = RenderFrames::stored, .always = true, .others = others_};
        heat_ = std::make_unique<ModelPicture>(a_.drawn(), RenderShow::error, choice, MapReading{}, nullptr);
    }
    return *heat_;
}

std::vector<std::uint8_t> DiffPictures::heatMap(Side side) {
    if (heat().meshes().empty()) return {};
    RenderOptions options{.show = RenderShow::error, .width = kHeatWidth, .height = kHeatHeight};
    if (side == Side::back) {
        options.yaw_deg += 180;
        options.pitch_deg = -options.pitch_deg;
    }
    return encodePicture(drawModel(heat(), options).image);
}

DiffPictures::Place DiffPictures::place(const FrameDifference& difference) {
    const std::size_t primitive = findPrimitive(a_.scene(), difference.mesh_a, difference.primitive_a);
    const auto pair = std::find_if(pairs_.begin(), pairs_.end(),
                                   [&](const PrimitivePair& candidate) { return candidate.a == primitive; });
    if (primitive == kNoPrimitive || pair == pairs_.end() || pair->b == kNoPrimitive) return {};
    const std::uint32_t vertices[] = {difference.vertex_a};
    const std::vector<std::size_t> triangles = trianglesAt(a_.scene().primitives[primitive], vertices);
    const std::vector<std::size_t> partners = partnersOf(*pair, triangles);
    if (triangles.empty() || partners.empty()) return {};
    return {drawPlace(a_.lit(RenderFrames::stored), RenderShow::lit, primitive, triangles),
            drawPlace(b_.lit(RenderFrames::stored), RenderShow::lit, pair->b, partners),
            drawPlace(heat(), RenderShow::error, primitive, triangles)};
}

namespace {

std::string tableHtml(const report::TextTable& table) {
    if (table.size() < 2) return {};
    std::string html = std::string(kWideTable) + "\n";
    for (std::size_t i = 0; i < table.size(); ++i) {
        const std::string name = i == 0 ? "th" : "td";
        html += "<tr>";
        for (const std::string& cell : table[i]) html += "<" + name + ">" + htmlText(cell) + "</" + name + ">";
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string histogramHtml(const AngleStatistics& tangents) {
    if (tangents.count == 0) return {};
    const std::uint64_t most = *std::max_element(tangents.histogram.begin(), tangents.histogram.end());
    std::string html =
        "<h2>Corners by the angle between their tangents, in degrees</h2>\n" + std::string(kWideTable) + "\n";
    for (std::size_t i = 0; i < kAngleBins.size(); ++i) {
        const std::uint64_t count = tangents.histogram[i];
        // Lengths are in thousandths of the longest bar, and at least one thousandth.
        const std::uint64_t length = count == 0 ? 0 : std::max<std::uint64_t>(1, 1000 * count / most);
        html += "<tr><td>" + report::binText(i) + "</td><td>" + std::to_string(count) +
                "</td><td class=\"wide\"><span class=\"bar\" style=\"width:" + std::to_string(length / 10) + "." +
                std::to_string(length % 10) + "%\"></span></td></tr>\n";
    }
    return html + "</table></div>\n";
}

/// Limits the total size of figures.
class SizeLimit {
  public:
    /// Returns `figures`, or nothing once the limit is exceeded.
    std::string take(std::string figures) {
        if (figures.size() > left_) left_ = 0;
        if (left_ == 0) return {};
        left_ -= figures.size();
        return figuresHtml(figures);
    }

  private:
    std::size_t left_ = kMaxModelBytes;
};

std::string heatHtml(DiffPictures& pictures) {
    std::string figures;
    for (const DiffPictures::Side side : {DiffPictures::Side::front, DiffPictures::Side::back}) {
        figures += figureHtml(pictures.heatMap(side), DiffPictures::kHeatWidth, DiffPictures::kHeatHeight,
                              side == DiffPictures::Side::front ? "the angle between the frames, in degrees"
                                                                : "the angle between the frames, from behind");
    }
    return figures.empty() ? noFigureHtml("There is no heat map, because the scene of A contains nothing to draw.")
                           : figures;
}

std::string placesHtml(const FrameDiff& diff, DiffPictures& pictures, SizeLimit& size_limit) {
    constexpr std::size_t kMaxPlaces = 12;
    std::string html;
    for (std::size_t i = 0; i < std::min(kMaxPlaces, diff.worst.size()); ++i) {
        const FrameDifference& place = diff.worst[i];
        const DiffPictures::Place pair = pictures.place(place);
        if (pair.a.empty() && pair.b.empty()) continue;
        const std::string figures = figureHtml(pair.a, kPlaceWidth, kPlaceHeight, "A") +
                                    figureHtml(pair.b, kPlaceWidth, kPlaceHeight, "B") +
                                    figureHtml(pair.angle, kPlaceWidth, kPlaceHeight, "the angle between them");
        const std::string taken = size_limit.take(figures);
        if (taken.empty()) break;
        html += "<article>\n<h3>" + std::to_string(place.mesh_a) + ":" + std::to_string(place.primitive_a) +
                ", vertex " + std::to_string(place.vertex_a) + " of A, " + std::to_string(place.vertex_b) +
                " of B</h3>\n" + taken + "</article>\n";
    }
    return html;
}

}  // namespace

std::string diffPage(const std::string& a, const std::string& b, const FrameDiff& diff, const DiffOptions& options,
                     const PageOrigin& origin) {
    const report::DiffWords words = report::diffWords(a, b, diff);
    std::string heat, places;
    try {
        DiffPictures pictures(a, b, options);
        SizeLimit size_limit;
        heat = size_limit.take(heatHtml(pictures));
        places = placesHtml(diff, pictures, size_limit);
    } catch (const FileError& failure) {
        if (heat.empty()) heat = figuresHtml(noFigureHtml("No pictures: " + failure.error.message + "."));
    }
    std::string html = pageHead("tspace diff");
    html += "<h1>Frames of two models</h1>\n<p>" + htmlText(words.summary) + "</p>\n";
    for (const std::string& remark : words.remarks) html += "<p>" + htmlText(remark) + "</p>\n";
    html += originHtml(origin) +
            "<p class=\"dim\">T is the tangent, N the normal, B the bitangent as reconstructed by shaders; angles are "
            "in degrees, over triangle corners.</p>\n";
    html += heat +
            "<p class=\"dim\">The largest of the angles between the two T, N and B vectors, shown on the surface of A. "
            "Gray areas cannot be compared.</p>\n";
    html += tableHtml(words.angles) + histogramHtml(diff.tangents);
    html += "<h2>Primitives</h2>\n" + tableHtml(words.primitives);
    if (!words.worst.empty()) html += "<h2>Largest differences</h2>\n" + tableHtml(words.worst) + places;
    return html + pageEnd();
}

}  // namespace tspace
