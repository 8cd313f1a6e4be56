// SPDX-License-Identifier: MIT
// generateNormals: checks, then the weighted mean of face normals in each component around each point. For another pose
// points and components are those of the mesh; faces and weights are the pose's.
#include "tspace/normals.h"

#include <optional>
#include <utility>

#include "core/border.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/sum_ranges.h"
#include "core/unit.h"
#include "normals/best_normal.h"
#include "normals/pose_normals.h"
#include "normals/smooth_triangles.h"
#include "normals/smoothing.h"
#include "normals/topology.h"
#include "normals/weighting.h"

namespace tspace {

namespace {

constexpr std::size_t kGrain = 1024;

// Below this fraction of the weights a sum is what rounding left of normals that cancel.
constexpr double kVanished = 1e-10;

Error checkOptions(const MeshView& mesh, const NormalOptions& options, const StridedSpan<Vec3>& out) {
    if (static_cast<std::uint32_t>(options.weighting) > static_cast<std::uint32_t>(NormalWeighting::best)) {
        return {ErrorCode::invalidOption, "weighting is not one of NormalWeighting"};
    }
    if (!(options.crease_angle_deg >= 0 && options.crease_angle_deg <= 180)) {
        return {ErrorCode::invalidOption, "crease_angle_deg is not between 0 and 180"};
    }
    if (!options.smoothing_groups.empty()) {
        const StridedSpan<const std::uint32_t> groups = options.smoothing_groups;
        if (Error e = checkSpan(groups, mesh.faceCount(), "smoothing_groups"); e.code != ErrorCode::ok) return e;
    }
    return checkSpan(out, mesh.cornerCount(), "out");
}

/// A weighted sum of unit normals.
struct Mean {
    DVec3 sum;
    double weights = 0;  ///< 0: nothing was added, and the quotient below is not a number

    void add(double weight, const DVec3& normal) {
        sum = sum + weight * normal;
        weights += weight;
    }
    /// Writes the unit mean; false when it vanishes.
    bool write(Vec3& out) const {
        DVec3 unit = sum;
        if (!(length((1 / weights) * sum) > kVanished) || !normalize(unit)) return false;
        out = toFloat(unit);
        return true;
    }
};

class Averager {
  public:
    /// `posed` is the mesh itself, or the same mesh with other positions.
    Averager(const MeshView& mesh, const MeshView& posed, const NormalOptions& options, StridedSpan<Vec3> out,
             Parallel& parallel)
        : mesh_(mesh),
          posed_(posed),
          is_best_(options.weighting == NormalWeighting::best),
          weighting_(is_best_ ? NormalWeighting::angleArea : options.weighting),
          factor_(normalFactor(options.convention)),
          rule_(makeSmoothingRule(options)),
          allocator_(options.execution.allocator),
          out_(out),
          parallel_(parallel) {}

    NormalReport run(bool weld_positions) {
        faces_ = makeFaceTable(posed_, factor_, allocator_, parallel_);
        writeFaceNormals();
        if (weighting_ != NormalWeighting::flat || faces_.degenerate_count != 0) average(weld_positions);
        return {faces_.used_count, faces_.degenerate_count, fallback_count_};
    }

  private:
    [[nodiscard]] bool isPosed() const { return &mesh_ != &posed_; }

    /// The result of `flat`, and what other weightings fall back to.
    void writeFaceNormals() {
        parallel_.forRanges(mesh_.cornerCount(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) out_[c] = toFloat(faces_.normals[faces_.corner_faces[c]].unit);
        });
    }

    void average(bool weld_positions) {
        points_ = makePointTable(mesh_, faces_, weld_positions, allocator_, parallel_);
        if (weighting_ != NormalWeighting::flat && !rule_.connectsAll()) {
            if (isPosed()) deciding_faces_ = makeFaceTable(mesh_, factor_, allocator_, parallel_);
            links_ = Buffer<Link>(allocator_, 2 * points_.corners.size());
            parents_ = Buffer<std::uint32_t>(allocator_, points_.corners.size());
        }
        if (is_best_) sharp_ = Buffer<Vec3>(allocator_, mesh_.cornerCount(), Vec3{});
        fallback_count_ = sumRanges(parallel_, mesh_.vertexCount(), kGrain, [&](std::size_t begin, std::size_t end) {
            std::uint64_t count = 0;
            for (std::size_t p = begin; p < end; ++p) {
                if (points_.begins[p] != points_.begins[p + 1]) count += averagePoint(static_cast<std::uint32_t>(p));
            }
            return count;
        });
        if (is_best_) refine();
    }

    /// From the means by angle * area, which are in out_, to the normals of `best`.
    void refine() {
        Buffer<Vec3> robust(allocator_, mesh_.cornerCount());
        parallel_.forRanges(mesh_.cornerCount(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) robust[c] = out_[c];
        });
        const BestSource source{posed_, faces_, points_, robust.data(), sharp_.data()};
        parallel_.forRanges(mesh_.vertexCount(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) refinePoint(source, points_.begins[p], points_.begins[p + 1]);
        });
    }

    /// One component after the other, as averagePoint left them.
    void refinePoint(const BestSource& source, std::uint32_t begin, std::uint32_t end) {
        if (rule_.connectsAll()) {
            if (begin != end) refineComponent(source, nullptr, begin, end - begin);
            return;
        }
        const Link* const links = links_.data() + 2 * std::size_t{begin};
        for (std::uint32_t first = 0, past = 0; first < end - begin; first = past) {
            while (past < end - begin && links[past].key == links[first].key) ++past;
            refineComponent(source, links + first, begin, past - first);
        }
    }

    /// Where a mean vanishes, the corners keep what they have.
    void refineComponent(const BestSource& source, const Link* links, std::uint32_t begin, std::uint32_t count) {
        const auto cornerOf = [&](std::uint32_t i) {
            return points_.corners[links != nullptr ? links[i].slot : begin + i];
        };
        if (sharp_[cornerOf(0)] == Vec3{}) return;
        const Vec3 normal = bestNormal(source, links, begin, count);
        for (std::uint32_t i = 0; i < count; ++i) out_[cornerOf(i)] = normal;
    }

    /// Returns how many corners got a substitute.
    std::uint64_t averagePoint(std::uint32_t point) {
        const std::uint32_t begin = points_.begins[point];
        const std::uint32_t end = points_.begins[point + 1];
        if (weighting_ == NormalWeighting::flat) return mendFlat(begin, end);
        if (rule_.connectsAll()) {
            const Mean all = mean(begin, end);
            return write(
                all, begin, end, [](std::uint32_t i) { return i; }, [&] { return all; });
        }

        Link* const links = links_.data() + 2 * std::size_t{begin};
        findComponents(mesh_, isPosed() ? deciding_faces_ : faces_, points_, rule_, point, links, parents_.data());
        std::uint64_t fallbacks = 0;
        const auto slotOf = [&](std::uint32_t i) { return links[i].slot; };
        std::optional<Mean> all;  // taken once, however many components vanish
        const auto meanOfAll = [&] {
            if (!all) all = mean(begin, end);
            return *all;
        };
        for (std::uint32_t first = 0; first < end - begin;) {
            std::uint32_t past = first;
            Mean component;
            for (; past < end - begin && links[past].key == links[first].key; ++past) add(component, links[past].slot);
            fallbacks += write(component, first, past, slotOf, meanOfAll);
            first = past;
        }
        return fallbacks;
    }

    /// Gives the mean to the corners of slotOf(first .. past), or to each its substitute; returns how many of
    /// these.
    template <class SlotOf, class MeanOfAll>
    std::uint64_t write(const Mean& component, std::uint32_t first, std::uint32_t past, SlotOf&& slotOf,
                        MeanOfAll&& meanOfAll) {
        Vec3 normal;
        if (component.write(normal)) {
            for (std::uint32_t i = first; i < past; ++i) out_[points_.corners[slotOf(i)]] = normal;
            if (is_best_) writeSharp(first, past, slotOf);
            return 0;
        }
        bool has_substitute = false;
        for (std::uint32_t i = first; i < past; ++i) {
            const std::uint32_t corner = points_.corners[slotOf(i)];
            if (!faces_.normals[faces_.corner_faces[corner]].isDegenerate()) continue;  // keeps the face normal
            if (!has_substitute && !meanOfAll().write(normal)) normal = {0, 0, 1};
            has_substitute = true;
            out_[corner] = normal;
        }
        return past - first;
    }

    template <class SlotOf>
    void writeSharp(std::uint32_t first, std::uint32_t past, SlotOf&& slotOf) {
        Mean component;
        for (std::uint32_t i = first; i < past; ++i) add(component, slotOf(i), NormalWeighting::max);
        Vec3 normal;
        if (!component.write(normal)) return;
        for (std::uint32_t i = first; i < past; ++i) sharp_[points_.corners[slotOf(i)]] = normal;
    }

    std::uint64_t mendFlat(std::uint32_t begin, std::uint32_t end) {
        std::uint64_t fallbacks = 0;
        Vec3 normal;
        for (std::uint32_t slot = begin; slot < end; ++slot) {
            const std::uint32_t corner = points_.corners[slot];
            if (!faces_.normals[faces_.corner_faces[corner]].isDegenerate()) continue;
            if (fallbacks++ == 0 && !mean(begin, end).write(normal)) normal = {0, 0, 1};
            out_[corner] = normal;
        }
        return fallbacks;
    }

    void add(Mean& mean, std::uint32_t slot) const { add(mean, slot, weighting_); }
    void add(Mean& mean, std::uint32_t slot, NormalWeighting weighting) const {
        const std::uint32_t corner = points_.corners[slot];
        const FaceNormal& normal = faces_.normals[faces_.corner_faces[corner]];
        if (normal.isDegenerate()) return;
        mean.add(cornerWeight(posed_, faces_, points_, weighting, factor_, corner), normal.unit);
    }
    [[nodiscard]] Mean mean(std::uint32_t begin, std::uint32_t end) const {
        Mean all;
        for (std::uint32_t slot = begin; slot < end; ++slot) add(all, slot);
        return all;
    }

    const MeshView& mesh_;
    const MeshView& posed_;
    bool is_best_;
    NormalWeighting weighting_;  ///< of the means
    double factor_;
    SmoothingRule rule_;
    const Allocator* allocator_;
    StridedSpan<Vec3> out_;
    Parallel& parallel_;
    FaceTable faces_;           ///< of the pose
    FaceTable deciding_faces_;  ///< of the mesh: which edges are hard; empty where faces_ are these
    PointTable points_;
    Buffer<Link> links_;
    Buffer<std::uint32_t> parents_;
    Buffer<Vec3> sharp_;  ///< for `best`: the mean by max weights of each corner; zero where one mean vanishes
    std::uint64_t fallback_count_ = 0;
};

Result<NormalReport> checkAndGenerate(const MeshView& mesh, const MeshView& posed, const NormalOptions& options,
                                      StridedSpan<Vec3> out) {
    const bool is_short = canSmoothTriangles(mesh, options);
    if (Error e = checkAllButIndices(mesh); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(posed.positions, mesh.vertexCount(), "positions"); e.code != ErrorCode::ok) return e;
    if (Error e = checkOptions(mesh, options, out); e.code != ErrorCode::ok) return e;
    if (!is_short) {
        if (Error e = checkIndices(mesh.indices, mesh.vertexCount()); e.code != ErrorCode::ok) return e;
    }
    Parallel parallel(options.execution);
    if (is_short) return smoothTriangles(mesh, posed.positions, options, out, parallel);
    return Averager(mesh, posed, options, out, parallel).run(options.weld_positions);
}

}  // namespace

Result<NormalReport> generateNormals(const MeshView& mesh, const NormalOptions& options, StridedSpan<Vec3> out) {
    return atBorder([&] { return checkAndGenerate(mesh, mesh, options, out); });
}

Result<NormalReport> generatePoseNormals(const MeshView& mesh, const StridedSpan<const Vec3>& positions,
                                         const NormalOptions& options, StridedSpan<Vec3> out) {
    return atBorder([&] {
        MeshView posed = mesh;
        posed.positions = positions;
        return checkAndGenerate(mesh, posed, options, out);
    });
}

}  // namespace tspace
