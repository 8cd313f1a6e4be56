// SPDX-License-Identifier: MIT
#include "figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tspace::accuracy {

namespace {

// The name of the tessellations `irregular` and `random` together, in figures.
const char* const kScattered = "scattered";

template <class RecordType>
bool fits(const RecordType& record, const std::string& tessellation) {
    return tessellation == kScattered ? record.isIrregular() : record.tessellation == tessellation;
}

template <class RecordType>
double meanOf(const std::vector<RecordType>& records, const std::function<bool(const RecordType&)>& wanted,
              const std::function<double(const RecordType&)>& value) {
    return geometricMean(collect<RecordType>(records, wanted, value));
}

/// Returns the mean value over all surfaces without damage, tessellated with `cells` cells per side.
template <class RecordType>
double cleanMean(const std::vector<RecordType>& records, const std::string& method, const std::string& tessellation,
                 int cells, bool held_out, const std::function<double(const RecordType&)>& value) {
    return meanOf<RecordType>(
        records,
        [&](const RecordType& r) {
            return r.method == method && r.held_out == held_out && r.damage == "none" && r.cells == cells &&
                   fits(r, tessellation);
        },
        value);
}

/// Returns the mean vertex error of damaged meshes whose amount of damage is in [low, high].
template <class RecordType>
double damagedMean(const std::vector<RecordType>& records, const std::string& method, const std::string& damage,
                   double low, double high, bool held_out) {
    return meanOf<RecordType>(
        records,
        [&](const RecordType& r) {
            return r.method == method && r.held_out == held_out && r.damage.ends_with(damage) && r.share >= low &&
                   r.share <= high;
        },
        [](const RecordType& r) { return r.all.mean; });
}

template <class RecordType>
std::vector<double> bevelValues(const std::vector<RecordType>& records, const std::string& method,
                                const std::function<double(const RecordType&)>& value) {
    return collect<RecordType>(
        records, [&](const RecordType& r) { return r.method == method && r.surface.starts_with("bevel"); }, value);
}

double arithmeticMean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) {
    return values.empty() ? std::nan("") : *std::max_element(values.begin(), values.end());
}

/// Returns the order of convergence p: the error is proportional to the cell size to the power p. `factor`: ratio of
/// the two cell sizes.
double order(double coarse, double fine, double factor) { return std::log(coarse / fine) / std::log(factor); }

Figure shadingFigure(const std::string& tessellation, int cells) {
    return {fmt::format("shading_{}_{}", tessellation, cells), fmt::format("shading {0}x{0} {1}", cells, tessellation),
            [=](const Study& study, const std::string& method, bool held_out) {
                return shadingError(study, method, tessellation, cells, held_out);
            }};
}

Figure vertexFigure(const std::string& tessellation, int cells) {
    return {fmt::format("vertex_{}_{}", tessellation, cells), fmt::format("vertex {0}x{0} {1}", cells, tessellation),
            [=](const Study& study, const std::string& method, bool held_out) {
                return tangentError(study, method, tessellation, cells, held_out);
            }};
}

Figure spreadFigure(const char* key, const char* title, double Spread::*part) {
    return {key, title, [=](const Study& study, const std::string& method, bool held_out) {
                return cleanMean<Record>(study.records, method, kScattered, 32, held_out,
                                         [=](const Record& r) { return r.inside.*part; });
            }};
}

Figure orderFigure(int coarse, int fine) {
    return {fmt::format("order_{}_{}", coarse, fine), fmt::format("order {} to {}", coarse, fine),
            [=](const Study& study, const std::string& method, bool held_out) {
                if (method == kFloor) return std::nan("");
                return order(tangentError(study, method, kScattered, coarse, held_out),
                             tangentError(study, method, kScattered, fine, held_out), double{1} * fine / coarse);
            }};
}

Figure damageFigure(const std::string& key, const std::string& title, const std::string& damage, double low,
                    double high) {
    return {key, title, [=](const Study& study, const std::string& method, bool held_out) {
                return damagedMean(study.records, method, damage, low, high, held_out);
            }};
}

Figure bitangentFigure(const char* key, const char* title, double Record::*value) {
    return {key, title, [=](const Study& study, const std::string& method, bool held_out) {
                return cleanMean<Record>(study.records, method, kScattered, 32, held_out,
                                         [=](const Record& r) { return r.*value; });
            }};
}

Figure bakedFigure(const std::string& tessellation, int cells) {
    return {fmt::format("baked_{}_{}", tessellation, cells),
            fmt::format("baked with mikktspace, {0}x{0} {1}", cells, tessellation),
            [=](const Study& study, const std::string& method, bool held_out) {
                return cleanMean<Record>(study.records, method, tessellation, cells, held_out,
                                         [](const Record& r) { return r.from_mikktspace; });
            }};
}

Figure bevelFigure(const char* key, const char* title, double Record::*value) {
    return {key, title, [=](const Study& study, const std::string& method, bool) {
                return arithmeticMean(
                    bevelValues<Record>(study.records, method, [=](const Record& r) { return r.*value; }));
            }};
}

/// Returns the figure for the gap at mirrored seams (folds): the mean over the surfaces that have one.
Figure foldFigure() {
    return {"fold_gap_scattered_32", "both sides of a fold, 32x32 scattered",
            [](const Study& study, const std::string& method, bool held_out) {
                return meanOf<Record>(
                    study.records,
                    [&](const Record& r) {
                        return r.method == method && r.held_out == held_out && r.damage == "none" && r.cells == 32 &&
                               r.isIrregular() && r.fold_gap > 0;
                    },
                    [](const Record& r) { return r.fold_gap; });
            }};
}

std::vector<Figure> makeTangentFigures() {
    std::vector<Figure> all = {
        shadingFigure(kScattered, 8),
        shadingFigure("loops", 8),
        shadingFigure(kScattered, 32),
        shadingFigure("loops", 32),
        shadingFigure("anisotropic", 32),
        shadingFigure(kScattered, 128),
        shadingFigure("loops", 128),
        vertexFigure("regular", 32),
        vertexFigure(kScattered, 32),
        spreadFigure("vertex_p95_scattered_32", "95th percentile", &Spread::p95),
        spreadFigure("vertex_max_scattered_32", "worst", &Spread::max),
        bitangentFigure("vertex_border_scattered_32", "vertex 32x32 scattered, border", &Record::border),
        vertexFigure("loops", 32),
        foldFigure(),
        orderFigure(8, 32),
        orderFigure(32, 128),
        bevelFigure("bevel_shading", "bevel, flat part", &Record::shading),
        {"bevel_worst", "bevel, worst vertex",
         [](const Study& study, const std::string& method, bool) {
             return largest(bevelValues<Record>(study.records, method, [](const Record& r) { return r.all.max; }));
         }},
        damageFigure("noise_2", "noise 2 %", "noise", 0.01, 0.03),
        damageFigure("position_noise_10_20", "position noise 10-20 %", "position-noise", 0.05, 0.3),
        damageFigure("uv_noise_10_20", "UV noise 10-20 %", "uv-noise", 0.05, 0.3),
        damageFigure("welded_2", "welded UVs 2 %", "welded-uvs", 0.01, 0.03),
        damageFigure("welded_10", "welded UVs 10 %", "welded-uvs", 0.05, 0.3),
        bitangentFigure("bitangent", "bitangent", &Record::bitangent),
        bitangentFigure("cross", "cross(N, T)", &Record::cross),
        bakedFigure(kScattered, 32),
        bakedFigure("loops", 8),
        bevelFigure("baked_bevel", "baked with mikktspace, bevel, flat part", &Record::from_mikktspace),
    };
    return all;
}

Figure normalFigure(const std::string& tessellation, int cells) {
    return {fmt::format("normal_{}_{}", tessellation, cells), fmt::format("{0}x{0} {1}", cells, tessellation),
            [=](const Study& study, const std::string& weighting, bool held_out) {
                return normalError(study, weighting, tessellation, cells, held_out);
            }};
}

Figure normalDamageFigure(const std::string& key, const std::string& title, const std::string& damage, double share) {
    return {key, title, [=](const Study& study, const std::string& weighting, bool held_out) {
                return damagedMean(study.normals, weighting, damage, share - 0.001, share + 0.001, held_out);
            }};
}

Figure normalShadingFigure(const char* key, const char* title, double NormalRecord::*value) {
    return {key, title, [=](const Study& study, const std::string& weighting, bool held_out) {
                return cleanMean<NormalRecord>(study.normals, weighting, kScattered, 32, held_out,
                                               [=](const NormalRecord& r) { return r.*value; });
            }};
}

std::vector<Figure> makeNormalFigures() {
    std::vector<Figure> all;
    for (const char* tessellation : {"regular", kScattered, "loops"}) {
        for (const int cells : {8, 32, 128}) all.push_back(normalFigure(tessellation, cells));
    }
    all.push_back(normalShadingFigure("normal_flat_32", "flat map, 32x32 scattered", &NormalRecord::flat_shading));
    all.push_back(normalShadingFigure("normal_bent_32", "bent map, tangents by `best`", &NormalRecord::bent_shading));
    all.push_back({"normal_bevel", "bevel, flat part", [](const Study& study, const std::string& weighting, bool) {
                       return arithmeticMean(bevelValues<NormalRecord>(
                           study.normals, weighting, [](const NormalRecord& r) { return r.all.mean; }));
                   }});
    all.push_back({"normal_bevel_worst", "bevel, worst", [](const Study& study, const std::string& weighting, bool) {
                       return largest(bevelValues<NormalRecord>(study.normals, weighting,
                                                                [](const NormalRecord& r) { return r.all.max; }));
                   }});
    all.push_back(normalDamageFigure("normal_position_noise_2", "position noise 2 %", "position-noise", 0.02));
    all.push_back(normalDamageFigure("normal_position_noise_10", "10 %", "position-noise", 0.1));
    all.push_back(normalDamageFigure("normal_position_noise_20", "20 %", "position-noise", 0.2));
    return all;
}

}  // namespace

std::span<const Figure> tangentFigures() {
    static const std::vector<Figure> all = makeTangentFigures();
    return all;
}

std::span<const Figure> normalFigures() {
    static const std::vector<Figure> all = makeNormalFigures();
    return all;
}

const Figure& tangentFigure(const std::string& key) {
    const std::span<const Figure> all = tangentFigures();
    return *std::find_if(all.begin(), all.end(), [&](const Figure& figure) { return figure.key == key; });
}

double tangentError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out) {
    return cleanMean<Record>(study.records, method, tessellation, cells, held_out,
                             [](const Record& r) { return r.inside.mean; });
}

double shadingError(const Study& study, const std::string& method, const std::string& tessellation, int cells,
                    bool held_out) {
    return cleanMean<Record>(study.records, method, tessellation, cells, held_out,
                             [](const Record& r) { return r.shading; });
}

double normalError(const Study& study, const std::string& weighting, const std::string& tessellation, int cells,
                   bool held_out) {
    return cleanMean<NormalRecord>(study.normals, weighting, tessellation, cells, held_out,
                                   [](const NormalRecord& r) { return r.all.mean; });
}

}  // namespace tspace::accuracy
