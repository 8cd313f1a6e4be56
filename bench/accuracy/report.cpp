// SPDX-License-Identifier: MIT
#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "figures.h"

namespace tspace::accuracy {

namespace {

using Json = nlohmann::ordered_json;

/// Targets of `fast` and `best` for a figure. A target of 0 means that there is none.
struct Target {
    const char* key;
    double fast, best;
    bool is_least = false;  ///< the target is a minimum, not a maximum
};

constexpr Target kTargets[] = {
    {"vertex_scattered_32", 0.14, 0.024}, {"vertex_loops_32", 0.21, 0.12}, {"shading_scattered_32", 0.076, 0.046},
    {"shading_loops_8", 1.41, 1.10},      {"bevel_shading", 0.14, 0.036},  {"bevel_worst", 12, 9},
    {"position_noise_10_20", 4.5, 4.48},  {"uv_noise_10_20", 5.1, 5.08},   {"order_32_128", 0, 1.7, true},
};

std::string text(double value) {
    if (std::isnan(value)) return "";
    if (value < 1e-5) return "0";  // the rest is float rounding
    return fmt::format("{:.3g}", value);
}

bool has(const Study& study, const std::string& method) {
    return std::find(study.methods.begin(), study.methods.end(), method) != study.methods.end();
}

bool passes(double value, double asked, bool is_least) { return is_least ? value >= asked : value <= asked; }

/// Returns three columns: measured value, target and verdict. They are empty if the method was not measured or has no
/// target.
std::string targetText(const Study& study, const Target& target, const std::string& method, double asked) {
    if (!has(study, method)) return " | | |";
    const double value = tangentFigure(target.key).value(study, method, false);
    if (asked == 0 || std::isnan(value)) return fmt::format(" {} | | |", text(value));
    return fmt::format(" {} | {}{:g} | {} |", text(value), target.is_least ? ">= " : "", asked,
                       passes(value, asked, target.is_least) ? "pass" : "missed");
}

void printTargets(const Study& study) {
    fmt::print("**Targets** in degrees; means over the twelve surfaces\n\n");
    fmt::print(
        "| figure | mikktspace | area | fast | target | result | best | target | result "
        "|\n|---|---|---|---|---|---|---|---|---|\n");
    for (const Target& target : kTargets) {
        const Figure& figure = tangentFigure(target.key);
        fmt::print("| {} | {} | {} |{}{}\n", figure.title, text(figure.value(study, "mikktspace", false)),
                   text(figure.value(study, "area", false)), targetText(study, target, "fast", target.fast),
                   targetText(study, target, "best", target.best));
    }
}

/// Prints one row per figure, with one column per method.
void printFigures(const Study& study, std::span<const Figure> figures, const std::vector<std::string>& methods,
                  bool held_out) {
    fmt::print("| case |");
    for (const std::string& method : methods) fmt::print(" {} |", method);
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < methods.size(); ++i) fmt::print("---|");
    fmt::print("\n");
    for (const Figure& figure : figures) {
        if (std::isnan(figure.value(study, methods.front(), held_out))) continue;
        // The figures of bevels use no surface of either set, so they are printed only once.
        if (held_out && figure.key.find("bevel") != std::string::npos) continue;
        fmt::print("| {} |", figure.title);
        for (const std::string& method : methods) fmt::print(" {} |", text(figure.value(study, method, held_out)));
        fmt::print("\n");
    }
}

/// Prints one row per surface: vertex errors inside, 32x32, irregular and random.
void printSurfaces(const Study& study) {
    fmt::print("| surface |");
    for (const std::string& method : study.methods) fmt::print(" {} |", method);
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < study.methods.size(); ++i) fmt::print("---|");
    fmt::print("\n");
    const auto row = [&](const Surface& surface) {
        fmt::print("| {} |", surface.name);
        for (const std::string& method : study.methods) {
            const std::vector<double> values = collect<Record>(
                study.records,
                [&](const Record& r) {
                    return r.surface == surface.name && r.method == method && r.damage == "none" && r.cells == 32 &&
                           r.isIrregular();
                },
                [](const Record& r) { return r.inside.mean; });
            fmt::print(" {} |", text(geometricMean(values)));
        }
        fmt::print("\n");
    };
    for (const Surface& surface : surfaces()) row(surface);
    for (const Surface& surface : heldOutSurfaces()) row(surface);
}

Json figuresJson(const Study& study, std::span<const Figure> figures, const std::vector<std::string>& methods) {
    Json json = Json::object();
    for (const std::string& method : methods) {
        Json& of_method = json[method];
        for (const bool held_out : {false, true}) {
            Json& part = of_method[held_out ? "heldOut" : "surfaces"];
            for (const Figure& figure : figures) {
                const double value = figure.value(study, method, held_out);
                if (!std::isnan(value)) part[figure.key] = value;
            }
        }
    }
    return json;
}

Json recordsJson(const Study& study) {
    Json json = Json::array();
    for (const Record& r : study.records) {
        if (r.tessellation.empty() || r.damage != "none") continue;
        json.push_back({{"surface", r.surface},
                        {"heldOut", r.held_out},
                        {"tessellation", r.tessellation},
                        {"cells", r.cells},
                        {"method", r.method},
                        {"inside", {r.inside.mean, r.inside.p95, r.inside.max}},
                        {"all", {r.all.mean, r.all.p95, r.all.max}},
                        {"shading", r.shading}});
    }
    return json;
}

}  // namespace

void printTables(const Study& study) {
    printTargets(study);
    fmt::print("\n**Tangents, the twelve surfaces and bevels**\n\n");
    printFigures(study, tangentFigures(), study.methods, false);
    fmt::print("\n**Tangents, held-out surfaces**\n\n");
    printFigures(study, tangentFigures(), study.methods, true);
    fmt::print("\n**Tangents by surface**: vertex error, 32x32 scattered\n\n");
    printSurfaces(study);
    fmt::print("\n**Normals, the twelve surfaces and bevels**\n\n");
    printFigures(study, normalFigures(), study.weightings, false);
    fmt::print("\n**Normals, held-out surfaces**\n\n");
    printFigures(study, normalFigures(), study.weightings, true);
}

bool writeJson(const Study& study, const std::string& path) {
    Json json = {{"seed", study.options.seed}, {"quick", study.options.quick}};
    json["tangents"] = figuresJson(study, tangentFigures(), study.methods);
    json["normals"] = figuresJson(study, normalFigures(), study.weightings);
    json["meshes"] = recordsJson(study);
    if (path == "-") {
        std::cout << json.dump(1) << '\n';
        return static_cast<bool>(std::cout.flush());
    }
    std::ofstream file(path);
    file << json.dump(1) << '\n';
    return static_cast<bool>(file.flush());
}

}  // namespace tspace::accuracy
