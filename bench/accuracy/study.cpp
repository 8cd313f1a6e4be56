// SPDX-License-Identifier: MIT
#include "study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tspace::accuracy {

namespace {

constexpr int kShadingPoints = 6000;

struct Place {
    const Surface* surface;
    bool held_out;
    std::uint64_t number;
};

class Runner {
  public:
    explicit Runner(const StudyOptions& options) {
        study_.options = options;
        for (const NamedMethod& method : methods()) study_.methods.push_back(method.name);
        study_.methods.emplace_back(kFloor);
        for (const NamedWeighting& weighting : weightings()) study_.weightings.push_back(weighting.name);
        for (const Surface& surface : surfaces()) places_.push_back({&surface, false, places_.size()});
        if (!options.held_out) return;
        for (const Surface& surface : heldOutSurfaces()) places_.push_back({&surface, true, places_.size()});
    }

    Study run() {
        for (const Place& place : places_) {
            measureSurface(place);
            measureDamage(place);
        }
        measureBevels();
        return std::move(study_);
    }

  private:
    [[nodiscard]] bool quick() const { return study_.options.quick; }
    [[nodiscard]] Random seedOf(const Place& place, std::uint64_t kind, std::uint64_t cells) const {
        return Random{study_.options.seed, place.number, kind, cells};
    }

    void measureSurface(const Place& place) {
        using enum Tessellation;
        for (const Tessellation kind : {regular, alternating, irregular, random, anisotropic, loops}) {
            for (const int cells : {8, 16, 32, 64, 128, 256, 512}) {
                if (!isWanted(kind, cells)) continue;
                const auto number = static_cast<std::uint64_t>(kind);
                const Random seed = seedOf(place, number, static_cast<std::uint64_t>(cells));
                const TestMesh mesh = tessellate(*place.surface, kind, cells, seed);
                measure(mesh, {place.surface->name, nameOf(kind), "none", "", place.held_out, cells}, true, seed);
            }
        }
    }

    /// Returns whether a size is needed; the largest meshes are only needed for plots.
    [[nodiscard]] bool isWanted(Tessellation kind, int cells) const {
        if (quick()) return cells == 8 || cells == 32 || (cells == 64 && kind == Tessellation::irregular);
        if (kind == Tessellation::anisotropic) return cells <= 128;
        return cells <= 128 || kind == Tessellation::irregular;
    }

    void measureDamage(const Place& place) {
        using enum Damage;
        struct Case {
            Damage kind;
            double share;
        };
        constexpr Case kCases[] = {{position_noise, 0.02}, {position_noise, 0.1}, {position_noise, 0.2},
                                   {uv_noise, 0.02},       {uv_noise, 0.1},       {uv_noise, 0.2},
                                   {welded_uvs, 0.02},     {welded_uvs, 0.1}};
        constexpr int kCells = 32;
        for (const Tessellation kind : {Tessellation::irregular, Tessellation::random}) {
            for (const Case& one : kCases) {
                const auto number = 100 + static_cast<std::uint64_t>(one.kind);
                Random seed = seedOf(place, number, static_cast<std::uint64_t>(1000 * one.share));
                TestMesh mesh = tessellate(*place.surface, kind, kCells, seed);
                damage(mesh, one.kind, one.share, seed);
                Record record{place.surface->name, nameOf(kind), nameOf(one.kind), "", place.held_out, kCells};
                record.share = one.share;
                measure(mesh, record, false, seed);
            }
        }
    }

    void measureBevels() {
        std::uint64_t number = 0;
        for (const Bevel& bevel : bevels()) {
            const Random seed{study_.options.seed, 999, ++number};
            const TestMesh mesh = bevelMesh(bevel, seed);
            measure(mesh, {bevel.shear_deg != 0 ? "bevel-sheared" : "bevel", "", "none", ""}, true, seed);
        }
    }

    void measure(const TestMesh& mesh, Record record, bool with_shading, const Random& seed) {
        std::optional<Shading> shading;
        if (with_shading) shading.emplace(mesh, quick() ? kShadingPoints / 4 : kShadingPoints, seed);
        const Frames baked = framesBy(Method::mikktspace, mesh);
        const auto add = [&](const std::string& name, const Frames& frames) {
            record.method = name;
            const bool is_bevel = mesh.surface == nullptr;
            record.inside = tangentErrors(mesh, frames, is_bevel ? Corners::measured : Corners::inside);
            record.all = tangentErrors(mesh, frames, is_bevel ? Corners::measured : Corners::all);
            record.border = is_bevel ? 0 : tangentErrors(mesh, frames, Corners::border).mean;
            record.fold_gap = foldGap(mesh, frames);
            record.bitangent = bitangentErrors(mesh, frames, Corners::inside).mean;
            record.cross = crossErrors(mesh, frames, Corners::inside).mean;
            if (shading) {
                record.shading = shading->meanError(frames);
                record.from_mikktspace = shading->meanDifference(frames, baked);
            }
            study_.records.push_back(record);
        };
        for (const NamedMethod& method : methods()) add(method.name, framesBy(method.method, mesh, method.refine));
        add(kFloor, exactFrames(mesh));
        const bool is_flat = mesh.surface != nullptr && mesh.surface->is_flat;
        if (!is_flat) measureNormals(mesh, record, shading ? &*shading : nullptr);  // they would be exact
    }

    /// Measures all weightings. `shading`: null if shading is not to be measured.
    void measureNormals(const TestMesh& mesh, const Record& of, const Shading* shading) {
        for (const NamedWeighting& weighting : weightings()) {
            const std::vector<Vec3> normals = normalsBy(weighting.weighting, mesh, weighting.refine);
            NormalRecord record{of.surface,  of.tessellation, of.damage, weighting.name,
                                of.held_out, of.cells,        of.share};
            const bool is_bevel = mesh.surface == nullptr;
            record.inside = normalErrors(mesh, normals, is_bevel ? Corners::measured : Corners::inside);
            record.all = normalErrors(mesh, normals, is_bevel ? Corners::measured : Corners::all);
            if (shading != nullptr && !is_bevel) {
                TestMesh generated = mesh;
                for (std::size_t c = 0; c < normals.size(); ++c) generated.normals[mesh.indices[c]] = normals[c];
                record.flat_shading = shading->meanNormalError(generated.normals);
                const Frames frames = framesBy(Method::best, generated);
                record.bent_shading = shading->meanError(frames, generated.normals);
            }
            study_.normals.push_back(record);
        }
    }

    Study study_;
    std::vector<Place> places_;
};

}  // namespace

Study runStudy(const StudyOptions& options) { return Runner(options).run(); }

double geometricMean(const std::vector<double>& values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (const double value : values) sum += std::log(std::max(value, 1e-6));
    return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace tspace::accuracy
