// SPDX-License-Identifier: MIT
// mendWinding: checks, and how each component is decided.
#include "tspace/winding.h"

#include <cmath>

#include "core/base/border.h"
#include "core/base/mesh_loops.h"
#include "core/base/weld.h"
#include "core/winding/components.h"

namespace tspace {

namespace {

using winding::Component;

constexpr std::uint32_t kFewest = 4;  // faces of a component that is decided: a tetrahedron has four

class Mending {
  public:
    Mending(const winding::WindingCall& call, WindingReport& report)
        : call_(call),
          report_(report),
          order_(call.allocator(), call.surface.mesh.faceCount()),
          reached_(call.allocator(), call.surface.mesh.faceCount(), 0),
          closed_(call.allocator(), call.surface.mesh.faceCount() / kFewest + 1) {}

    void run() {
        const Faces& faces = call_.surface.faces;
        const auto count = static_cast<std::uint32_t>(call_.surface.mesh.faceCount());
        std::uint32_t done = 0;
        for (std::uint32_t face = 0; face < count; ++face) {
            if (reached_[face] != 0 || !faces.isUsed(face)) continue;
            Component component = flood(call_, face, done, order_, reached_);
            done = component.end;
            decide(component);
        }
        decideClosed();
    }

  private:
    void decide(Component& component) {
        ++report_.component_count;
        report_.conflict_count_before += component.conflicts_before;
        if (component.size() < kFewest) return leave(component, report_.small_count);
        if (component.conflicts_after != 0 && component.conflicts_after >= component.conflicts_before)
            return leave(component, report_.one_sided_count);
        measure(call_, order_, component);
        // Half of the area has normals, and four fifths of that agree.
        if (component.faced > 0.5 * component.area && std::fabs(component.facing) > 0.6 * component.faced) {
            finish(component, component.facing < 0, report_.by_normals_count);
        } else if (component.is_closed && hasVolume(component)) {
            // Which of them lie in others can be seen when all are known.
            closed_[closed_count_++] = component;
        } else {
            decideOpen(component);
        }
    }

    /// Nothing is turned.
    void leave(const Component& component, std::uint64_t& counter) {
        for (std::uint32_t i = component.begin; i < component.end; ++i) call_.turned[order_[i]] = 0;
        ++counter;
        report_.conflict_count_after += component.conflicts_before;
    }

    /// Counts a component, and turns all of its faces if it `is_inside_out`.
    void finish(const Component& component, bool is_inside_out, std::uint64_t& counter) {
        std::uint32_t turned = component.turned_count;
        if (is_inside_out) {
            turned = component.size() - turned;
            for (std::uint32_t i = component.begin; i < component.end; ++i) call_.turned[order_[i]] ^= 1;
        }
        ++counter;
        report_.turned_count += turned;
        report_.turned_component_count += turned > component.size() - turned ? 1U : 0U;
        report_.conflict_count_after += component.conflicts_after;
    }

    /// A sheet that is closed because it has two sides has none. A cube has 1/15 of its area to the power of 3/2, a box of
    /// 1 x 1 x 0.0001 still 1/30,000.
    static bool hasVolume(const Component& component) {
        const double area = 0.5 * component.area, volume = component.volume / 6;
        return std::fabs(volume) > 1e-7 * area * std::sqrt(area);
    }

    void decideOpen(const Component& component) {
        // 0 on average where no side is inside, 1/2 where it is nearly closed.
        constexpr double kLeast = 0.15;
        const double number = ownWindingNumber(call_, order_, component);
        if (std::fabs(number) > kLeast) {
            finish(component, number < 0, report_.by_winding_number_count);
        } else {
            finish(component, component.kept < 0, report_.by_majority_count);
        }
    }

    /// A cavity is wound the other way, a body in a body is not: what the input mostly says is right, unless it says nothing.
    void decideClosed() {
        constexpr double kClear = 0.2;
        Buffer<std::uint8_t> inside(call_.allocator(), closed_count_, 0);
        findNested(call_, order_, closed_, closed_count_, inside);
        for (std::size_t i = 0; i < closed_count_; ++i) {
            const Component& component = closed_[i];
            const bool is_negative = component.volume < 0;
            if (inside[i] == 0) {
                finish(component, is_negative, report_.by_volume_count);
            } else if (std::fabs(component.kept) > kClear * component.area) {
                finish(component, component.kept < 0, report_.by_nesting_count);
            } else {
                finish(component, !is_negative, report_.by_nesting_count);
            }
        }
    }

    const winding::WindingCall& call_;
    WindingReport& report_;
    Buffer<std::uint32_t> order_;
    Buffer<std::uint8_t> reached_;
    Buffer<Component> closed_;
    std::size_t closed_count_ = 0;
};

Buffer<std::uint32_t> pointsOfCorners(const MeshView& mesh, const Call<WindingOptions>& options, Parallel& parallel) {
    const Allocator* const allocator = options.execution.allocator;
    const Buffer<std::uint32_t> roots =
        options.weld_positions ? weldPositions(mesh, allocator, parallel) : Buffer<std::uint32_t>();
    Buffer<std::uint32_t> points(allocator, mesh.cornerCount());
    withIndices(mesh.indices, [&](auto vertexOf) {
        parallel.forRanges(points.size(), Parallel::kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) points[c] = roots.empty() ? vertexOf(c) : roots[vertexOf(c)];
        });
    });
    return points;
}

Result<WindingReport> checkAndMend(const MeshView& mesh, const Call<WindingOptions>& options,
                                   StridedSpan<std::uint8_t> turned) {
    // About four times what a mean of normals takes.
    Parallel parallel(options.execution, 4 * mesh.cornerCount());
    if (Error e = checkMesh(mesh, &parallel); e.code != ErrorCode::ok) return e;
    if (Error e = checkSpan(turned, mesh.faceCount(), "turned"); e.code != ErrorCode::ok) return e;
    const Allocator* const allocator = options.execution.allocator;
    for (std::size_t face = 0; face < turned.count; ++face) turned[face] = 0;
    const Faces faces(mesh, allocator);
    WindingReport report{.face_count = faces.usedCount()};
    if (report.face_count == 0) return report;
    const Buffer<std::uint32_t> corner_points = pointsOfCorners(mesh, options, parallel);
    const winding::Surface surface{mesh, faces, corner_points};
    const Buffer<std::uint32_t> partners = pairEdges(surface, allocator);
    Mending({surface, options, partners, turned, parallel, normalFactor(options.convention)}, report).run();
    return report;
}

}  // namespace

Result<WindingReport> mendWinding(const MeshView& mesh, const WindingOptions& options, StridedSpan<std::uint8_t> turned,
                                  const Execution& execution) {
    return atBorder([&] { return checkAndMend(mesh, {options, execution}, turned); });
}

}  // namespace tspace
