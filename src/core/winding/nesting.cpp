// SPDX-License-Identifier: MIT
// Which closed components lie in others: rays from points of their faces, counted through the faces of all others.
#include <cmath>

#include "core/winding/components.h"

namespace tspace::winding {

namespace {

struct Ray {
    DVec3 from, direction;
    double inverse[3];

    Ray(const DVec3& f, const DVec3& d) : from(f), direction(d), inverse{1 / d.x, 1 / d.y, 1 / d.z} {}

    [[nodiscard]] bool meets(const Box& box) const {
        const double at[3] = {from.x, from.y, from.z};
        double near = 0, far = 1e300;
        for (int k = 0; k < 3; ++k) {
            const double a = (double{box.least[k]} - at[k]) * inverse[k],
                         b = (double{box.most[k]} - at[k]) * inverse[k];
            near = std::max(near, std::min(a, b));
            far = std::min(far, std::max(a, b));
        }
        // Boxes are a little too small by rounding.
        return near <= far * (1 + 1e-12);
    }
    /// Moeller and Trumbore 1997.
    [[nodiscard]] bool meets(const DVec3& a, const DVec3& b, const DVec3& c) const {
        const DVec3 ab = b - a, ac = c - a, across = cross(direction, ac);
        const double scale = dot(ab, across);
        if (scale == 0) return false;
        const DVec3 to = from - a;
        const double u = dot(to, across) / scale;
        if (u < 0 || u > 1) return false;
        const DVec3 turn = cross(to, ab);
        const double v = dot(direction, turn) / scale;
        return v >= 0 && u + v <= 1 && dot(ac, turn) / scale > 0;
    }
};

/// How often the ray runs through a face, by the triangles about its first corner.
unsigned crossings(const Surface& surface, std::uint32_t face, const Ray& ray) {
    const std::uint32_t first = surface.faces.first(face), past = surface.faces.past(face);
    unsigned count = 0;
    for (std::uint32_t c = first + 1; c + 1 < past; ++c)
        count += ray.meets(surface.position(first), surface.position(c), surface.position(c + 1)) ? 1U : 0U;
    return count;
}

/// Box by box: whether any other holds that of component i.
bool isHeld(const BoxTree& boxes, const Buffer<Component>& closed, std::size_t i) {
    bool held = false;
    boxes.visit([&](const Box& box) { return !held && box.holds(closed[i].box); },
                [&](std::uint32_t other) { held |= other != i; });
    return held;
}

}  // namespace

void findNested(const WindingCall& call, const Buffer<std::uint32_t>& order, const Buffer<Component>& closed,
                std::size_t count, Buffer<std::uint8_t>& inside) {
    if (count < 2) return;
    const Surface& surface = call.surface;
    Buffer<std::uint32_t> held(call.allocator(), count);
    std::size_t held_count = 0;
    {
        Buffer<Box> boxes(call.allocator(), count);
        for (std::size_t i = 0; i < count; ++i) boxes[i] = closed[i].box;
        const BoxTree tree(boxes, count, call.allocator());
        for (std::size_t i = 0; i < count; ++i) {
            if (isHeld(tree, closed, i)) held[held_count++] = static_cast<std::uint32_t>(i);
        }
    }
    if (held_count == 0) return;
    std::size_t face_count = 0;
    for (std::size_t i = 0; i < count; ++i) face_count += closed[i].size();
    Buffer<std::uint32_t> faces(call.allocator(), face_count), owners(call.allocator(), face_count);
    Buffer<Box> boxes(call.allocator(), face_count, Box{});
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::uint32_t k = closed[i].begin; k < closed[i].end; ++k, ++next) {
            faces[next] = order[k];
            owners[next] = static_cast<std::uint32_t>(i);
            for (std::uint32_t c = surface.faces.first(order[k]); c < surface.faces.past(order[k]); ++c)
                boxes[next].add(surface.mesh.positions[surface.mesh.indices[c]]);
        }
    }
    const BoxTree tree(boxes, face_count, call.allocator());
    // In no plane that a modeller draws.
    constexpr DVec3 kDirections[] = {{0.8129, 0.3571, 0.4603}, {-0.2887, 0.9013, -0.3233}, {0.1733, -0.4441, 0.8791}};
    constexpr std::uint32_t kRays = 16;  // in each direction
    constexpr double kClear = 0.7;
    call.parallel.forRanges(held_count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            const Component& own = closed[held[h]];
            int odd = 0, even = 0;
            for (std::uint32_t p = 0; p < kRays; ++p) {
                const std::uint64_t place = (2 * std::uint64_t{p} + 1) * own.size() / (2 * kRays);
                const std::uint32_t face = order[own.begin + static_cast<std::uint32_t>(place)];
                // Not the middle, which edges of faces beyond often lie behind.
                const std::uint32_t c = surface.faces.first(face);
                const DVec3 from =
                    0.46 * surface.position(c) + 0.33 * surface.position(c + 1) + 0.21 * surface.position(c + 2);
                for (const DVec3& direction : kDirections) {
                    const Ray ray(from, direction);
                    unsigned through = 0;
                    tree.visit([&](const Box& box) { return ray.meets(box); },
                               [&](std::uint32_t number) {
                                   if (owners[number] != held[h]) through += crossings(surface, faces[number], ray);
                               });
                    ++(through % 2 != 0 ? odd : even);
                }
            }
            inside[held[h]] = odd - even > kClear * (odd + even) ? 1 : 0;
        }
    });
}

}  // namespace tspace::winding
