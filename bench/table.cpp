// SPDX-License-Identifier: MIT
// Prints rows as Markdown (for pasting into the docs) and as JSON.
#include "table.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "floor.h"
#include "machine.h"
#include "plain_loop.h"
#include "race.h"

namespace tspace::bench {

namespace {

using Json = nlohmann::ordered_json;

struct Section {
    const char* title;
    std::vector<Row> rows;
};

std::string valueText(const Cell& cell, const std::string& unit) {
    return cell.value ? fmt::format("{:.2f}{}", *cell.value, unit) : std::string();
}

std::string askedText(const Cell& cell) { return cell.asked ? fmt::format("{:g}", *cell.asked) : std::string(); }

std::string verdict(const Cell& cell) {
    if (!cell.value || !cell.asked) return {};
    if (cell.pass()) return "pass";
    return cell.busy ? "busy" : "missed";
}

/// Joins the texts of two cells; empty if both are empty.
std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + "; " + b; }

std::string spreadText(const Cell& cell) {
    return cell.high > 0 ? fmt::format("{:.2f} to {:.2f}", cell.low, cell.high) : std::string();
}

std::string nsText(const Cell& cell) { return cell.ns > 0 ? fmt::format("{:.1f}", cell.ns) : std::string(); }

void printRow(const RowResult& row) {
    const Cell &a = row.one_thread, &b = row.two_threads;
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.title, valueText(a, row.unit), askedText(a),
               row.wrong ? "WRONG" : verdict(a), valueText(b, row.unit), askedText(b), verdict(b),
               joined(nsText(a), nsText(b)), joined(spreadText(a), spreadText(b)), row.note);
    std::fflush(stdout);
}

void printHead(const char* title) {
    fmt::print(
        "\n**{}**\n\n"
        "| measurement | 1 thread | target | result | 2 threads | target | result | ns/triangle | interquartile range "
        "| notes |\n"
        "|---|---|---|---|---|---|---|---|---|---|\n",
        title);
}

Json cellJson(const Cell& cell) {
    Json json = Json::object();
    if (cell.value) json["value"] = *cell.value;
    if (cell.asked) json["asked"] = *cell.asked;
    if (cell.value && cell.asked) json["pass"] = cell.pass();
    if (cell.busy) json["busy"] = true;
    if (cell.high > 0) {
        json["low"] = cell.low;
        json["high"] = cell.high;
    }
    if (cell.ns > 0) json["nsPerTriangle"] = cell.ns;
    return json;
}

Json rowJson(const char* section, const RowResult& row) {
    return {{"section", section},
            {"title", row.title},
            {"unit", row.unit},
            {"oneThread", cellJson(row.one_thread)},
            {"twoThreads", cellJson(row.two_threads)},
            {"note", row.note},
            {"wrong", row.wrong}};
}

/// Times of the plain loop, and of reading and writing memory alone, to which all other times are compared.
struct Yardsticks {
    double plain, plain_shuffled, floor_vertex, floor_corner;  ///< ns per triangle
};

Yardsticks measureYardsticks(Lab& lab) {
    const Mesh &natural = lab.mesh("torus_" + lab.size()), &random = lab.mesh("torus_" + lab.size() + "_shuffled");
    std::vector<Vec4> per_vertex(natural.positions.size()), per_corner(natural.cornerCount());
    Race race;
    race.add([&] { plainLoop(natural, per_vertex); });
    race.add([&] { plainLoop(random, per_vertex); });
    race.add([&] { memoryFloor(natural, per_vertex); });
    race.add([&] { memoryFloor(natural, per_corner); });
    race.run(lab.rounds());
    const auto ns = [&](std::size_t runner) {
        return 1e9 * race.best(runner) / static_cast<double>(natural.triangleCount());
    };
    return {ns(0), ns(1), ns(2), ns(3)};
}

}  // namespace

int printTable(Lab& lab, const TableOptions& options) {
    const std::regex pattern(options.pattern, std::regex::icase);
    std::vector<Section> sections;
    sections.push_back({"Time relative to the plain loop", speedRows()});
    sections.push_back({"Real models, and sizes where a cliff may be", manyMeshRows()});
    sections.push_back({"Files", fileRows()});
    sections.push_back({"Packed frames: time of one", packRows()});
    sections.push_back({"Memory in addition to inputs and outputs", memoryRows()});
    sections.push_back({"Worst cases: time per triangle, 200k relative to 20k triangles", worstCaseRows()});

    const bool print = options.json != "-";
    const Yardsticks yard = measureYardsticks(lab);
    Json json = {{"machine", machineJson()},
                 {"triangles", lab.size()},
                 {"nsPerTriangle",
                  {{"plainLoop", yard.plain},
                   {"plainLoopShuffled", yard.plain_shuffled},
                   {"floorPerVertex", yard.floor_vertex},
                   {"floorPerCorner", yard.floor_corner}}},
                 {"rows", Json::array()}};
    if (print) {
        fmt::print(
            "{}\n\nTorus of {} triangles. Plain loop: {:.1f} ns per triangle, {:.1f} in random order. Memory "
            "floor: {:.2f} with a result per vertex, {:.2f} per corner.\n",
            machineText(), lab.size(), yard.plain, yard.plain_shuffled, yard.floor_vertex, yard.floor_corner);
    }
    bool any = false, wrong = false;
    for (const Section& section : sections) {
        bool printed_head = false;
        for (const Row& row : section.rows) {
            if (!std::regex_search(row.title + " " + section.title, pattern)) continue;
            const RowResult result = row.measure(lab);
            any = true;
            wrong = wrong || result.wrong;
            json["rows"].push_back(rowJson(section.title, result));
            if (!print) continue;
            if (!printed_head) printHead(section.title);
            printed_head = true;
            printRow(result);
        }
    }
    if (!any) fmt::print(stderr, "bench: no row matches\n");
    if (options.json == "-") {
        fmt::print("{}\n", json.dump(2));
    } else if (!options.json.empty() && !(std::ofstream(options.json) << json.dump(2) << '\n')) {
        fmt::print(stderr, "bench: cannot write {}\n", options.json);
        return 1;
    }
    return any && !wrong ? 0 : 1;
}

}  // namespace tspace::bench
