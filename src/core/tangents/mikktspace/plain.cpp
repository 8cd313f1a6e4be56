// SPDX-License-Identifier: MIT
// MikkTSpace (Morten S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), step by step, with the bits of
// the reference implementation at commit 3e895b4. docs/concepts/methods/mikktspace.md has the same steps.
//
// All arithmetic is single precision in the written order; where the order of operations or of list entries looks
// arbitrary, it is the order of the reference, and the last bits depend on it. A comparison that is written as !(a > b)
// is true for NaN.
#include "core/tangents/mikktspace/plain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tspace::mikk {
namespace {

// ------------------------------------------------------------------------------------------------------------- Vectors

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(float k, Vec3 v) { return {k * v.x, k * v.y, k * v.z}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length(Vec3 v) { return std::sqrt(dot(v, v)); }
float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Returns whether x is not zero by the reference's test, in which denormal numbers and NaN count as zero.
bool isNotZero(float x) { return std::fabs(x) > 1.17549435e-38f; }

/// Returns v divided by its length. A vector whose components all count as zero is returned unchanged.
Vec3 unit(Vec3 v) {
    if (!isNotZero(v.x) && !isNotZero(v.y) && !isNotZero(v.z)) return v;
    return (1.0f / length(v)) * v;
}

/// Returns the unit vector along the projection of v onto the plane perpendicular to n. n is used as given; its length
/// is not corrected.
Vec3 unitInPlane(Vec3 n, Vec3 v) { return unit(v - dot(n, v) * n); }

// ---------------------------------------------------------------------------------------------------------------- Data

constexpr std::uint32_t kNone = 0xffffffffu;

/// Attributes of the corners of a mesh.
struct Corners {
    const MeshView& mesh;

    [[nodiscard]] Vec3 position(std::size_t c) const { return mesh.positions[mesh.indices[c]]; }
    [[nodiscard]] Vec3 normal(std::size_t c) const { return mesh.normals[entry(mesh.normal_indices, c)]; }
    [[nodiscard]] Vec2 uv(std::size_t c) const { return mesh.uvs[entry(mesh.uv_indices, c)]; }

  private:
    [[nodiscard]] std::size_t entry(const IndexView& own, std::size_t c) const {
        return own.type == IndexType::none ? mesh.indices[c] : own[c];
    }
};

/// Corner k of a triangle, and the edge from corner k to the next corner.
struct HalfEdge {
    std::uint32_t triangle = kNone;
    int k = 0;
};
int next(int k) { return k == 2 ? 0 : k + 1; }
int previous(int k) { return k == 0 ? 2 : k - 1; }

struct Triangle {
    std::uint32_t face = 0;                  ///< first corner of the triangle's face
    std::array<std::uint32_t, 3> corners{};  ///< corners of the mesh, which receive the results
    std::array<std::uint32_t, 3> nodes{};    ///< representative of the corners that each corner is welded to
    bool has_degenerate_half = false;        ///< true: the other triangle of the same quad is degenerate

    Vec3 s{}, t{};                     ///< unit directions of dP/du and dP/dv
    float length_s = 0, length_t = 0;  ///< lengths of dP/du and dP/dv
    float uv_area = 0;                 ///< twice the signed area in UV space
    bool faces_up = false;             ///< true: positive UV area; false: the UVs are mirrored
    /// true: no UV area, so the triangle takes the orientation of the first group that reaches it
    bool has_no_direction = true;
    std::array<HalfEdge, 3> neighbors{};  ///< half-edge across the edge from corner k to the next corner
    std::array<std::uint32_t, 3> groups{kNone, kNone, kNone};
};

/// Corners at one node that share an orientation.
struct Group {
    std::uint32_t node = 0;
    bool faces_up = false;
    std::vector<HalfEdge> members = {};
};

/// Result of one corner, initialized with the values for a corner that no group reaches.
struct Frame {
    Vec3 s{1, 0, 0}, t{0, 1, 0};
    float length_s = 1, length_t = 1;
    bool faces_up = false;
    bool is_written = false;
};

// --------------------------------------------------------------------------------------------------- Step 1. Triangles

float distanceSquared(Vec2 a, Vec2 b) { return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y); }
float distanceSquared(Vec3 a, Vec3 b) { return dot(a - b, a - b); }

/// Returns whether a quad is cut between its corners 1 and 3: along the diagonal that is shorter in UV space; if both
/// are equal, along the diagonal that is shorter in space, and from corner 0 to 2 if those are equal too.
bool isCutFrom1To3(const Corners& data, std::uint32_t c) {
    const float d02 = distanceSquared(data.uv(c), data.uv(c + 2)),
                d13 = distanceSquared(data.uv(c + 1), data.uv(c + 3));
    if (d02 < d13) return false;
    if (d13 < d02) return true;
    return distanceSquared(data.position(c + 1), data.position(c + 3)) <
           distanceSquared(data.position(c), data.position(c + 2));
}

/// Cuts faces into triangles. Faces with neither 3 nor 4 corners are ignored.
std::vector<Triangle> cutFaces(const Corners& data) {
    std::vector<Triangle> triangles;
    const MeshView& mesh = data.mesh;
    std::uint32_t face = 0;
    for (std::size_t i = 0; i < mesh.faceCount(); ++i) {
        const std::uint32_t size = mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[i];
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            triangles.push_back({.face = face, .corners = {face + a, face + b, face + c}});
        };
        if (size == 3) {
            add(0, 1, 2);
        } else if (size == 4 && isCutFrom1To3(data, face)) {
            add(0, 1, 3), add(1, 2, 3);
        } else if (size == 4) {
            add(0, 1, 2), add(0, 2, 3);
        }
        face += size;
    }
    return triangles;
}

// -------------------------------------------------------------------------------------------------------- Step 2. Weld

/// Finds the node of each entry, where an entry is a corner of a triangle: entries with equal position, normal and UV
/// get the same node. Which of the equal corners represents the node depends on the order in which this search compares
/// them.
class Welding {
  public:
    Welding(const Corners& data, std::vector<std::uint32_t>& corners) : data_(data), nodes_(corners) {}

    /// Distributes the entries to 2048 cells along the longest side of the bounding box and searches each cell.
    void run() {
        if (nodes_.empty()) return;
        Box box(data_.position(0));  // the first corner of the mesh, even if its face is ignored
        for (std::size_t i = 1; i < nodes_.size(); ++i) box.add(data_.position(nodes_[i]));
        const int axis = box.longestAxis();
        const float low = component(box.low, axis), high = component(box.high, axis);
        std::map<int, std::vector<Entry>> cells;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            const Vec3 p = data_.position(nodes_[i]);
            cells[cellOf(2048.0f * ((component(p, axis) - low) / (high - low)))].push_back({p, i});
        }
        for (auto& [number, cell] : cells) weld(cell.data(), static_cast<std::ptrdiff_t>(cell.size()));
    }

  private:
    struct Entry {
        Vec3 position;
        std::uint32_t number;
    };

    struct Box {
        Vec3 low, high;

        explicit Box(Vec3 first) : low(first), high(first) {}
        void add(Vec3 p) {
            const auto extend = [](float& lowest, float& highest, float x) {
                if (lowest > x)
                    lowest = x;
                else if (highest < x)
                    highest = x;
            };
            extend(low.x, high.x, p.x), extend(low.y, high.y, p.y), extend(low.z, high.z, p.z);
        }
        [[nodiscard]] int longestAxis() const {
            const Vec3 d = high - low;
            if (d.y > d.x && d.y > d.z) return 1;
            return d.z > d.x ? 2 : 0;
        }
    };

    /// Returns the cell of a coordinate. Converts to int32 as x86-64 does, where NaN and out-of-range values become the
    /// smallest integer and therefore the first cell.
    static int cellOf(float q) { return q > 0 && q < 2147483648.0f ? std::min(static_cast<int>(q), 2047) : 0; }

    /// Splits the entries in place at the center of their longest axis, until positions are equal or not finite.
    void weld(Entry* entries, std::ptrdiff_t count) {
        if (count < 2) return;
        Box box(entries[0].position);
        for (std::ptrdiff_t i = 1; i < count; ++i) box.add(entries[i].position);
        const int axis = box.longestAxis();
        const float low = component(box.low, axis), high = component(box.high, axis), center = 0.5f * (high + low);
        if (!std::isfinite(center)) return;  // nothing in this range can be welded
        if (!(center < high && center > low)) return weldEqual(entries, count);
        const auto isLeft = [&](std::ptrdiff_t i) { return component(entries[i].position, axis) < center; };
        std::ptrdiff_t left = 0, right = count - 1;
        while (left < right) {
            while (left < right && isLeft(left)) ++left;
            while (left < right && !isLeft(right)) --right;
            if (left < right) std::swap(entries[left++], entries[right--]);
        }
        if (left == right && isLeft(left)) ++left;
        weld(entries, left);
        weld(entries + left, count - left);
    }

    /// Gives each entry the node of the first earlier entry that is equal.
    void weldEqual(const Entry* entries, std::ptrdiff_t count) {
        for (std::ptrdiff_t i = 1; i < count; ++i) {
            for (std::ptrdiff_t j = 0; j < i; ++j) {
                if (!isEqual(nodes_[entries[i].number], nodes_[entries[j].number])) continue;
                nodes_[entries[i].number] = nodes_[entries[j].number];
                break;
            }
        }
    }
    [[nodiscard]] bool isEqual(std::uint32_t a, std::uint32_t b) const {
        return data_.position(a) == data_.position(b) && data_.normal(a) == data_.normal(b) &&
               data_.uv(a) == data_.uv(b);
    }

    const Corners& data_;
    std::vector<std::uint32_t>& nodes_;
};

void weldCorners(const Corners& data, std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> nodes;
    for (const Triangle& t : triangles) nodes.insert(nodes.end(), t.corners.begin(), t.corners.end());
    Welding(data, nodes).run();
    for (std::size_t i = 0; i < nodes.size(); ++i) triangles[i / 3].nodes[i % 3] = nodes[i];
}

/// Removes the triangles with two corners at one position from the list and returns them.
std::vector<Triangle> takeDegenerate(const Corners& data, std::vector<Triangle>& triangles) {
    const auto isDegenerate = [&](const Triangle& t) {
        const Vec3 a = data.position(t.nodes[0]), b = data.position(t.nodes[1]), c = data.position(t.nodes[2]);
        return a == b || a == c || b == c;
    };
    for (std::size_t i = 1; i < triangles.size(); ++i) {
        Triangle &first = triangles[i - 1], &second = triangles[i];
        if (first.face == second.face && isDegenerate(first) != isDegenerate(second))
            first.has_degenerate_half = second.has_degenerate_half = true;
    }
    const auto end =
        std::stable_partition(triangles.begin(), triangles.end(), [&](const Triangle& t) { return !isDegenerate(t); });
    std::vector<Triangle> degenerate(end, triangles.end());
    triangles.erase(end, triangles.end());
    return degenerate;
}

// ------------------------------------------------------------------------------------------------ Step 3. Face vectors

void computeFaceVectors(const Corners& data, Triangle& triangle) {
    const auto [a, b, c] = triangle.nodes;
    const Vec2 uv0 = data.uv(a), uv1 = data.uv(b), uv2 = data.uv(c);
    const float s1 = uv1.x - uv0.x, t1 = uv1.y - uv0.y, s2 = uv2.x - uv0.x, t2 = uv2.y - uv0.y;
    const Vec3 e1 = data.position(b) - data.position(a), e2 = data.position(c) - data.position(a);
    const float area = s1 * t2 - s2 * t1;
    triangle.uv_area = area;
    triangle.faces_up = area > 0;
    if (!isNotZero(area)) return;
    const Vec3 s = t2 * e1 - t1 * e2, t = -s2 * e1 + s1 * e2;
    const float length_s = length(s), length_t = length(t), sign = triangle.faces_up ? 1.0f : -1.0f;
    if (isNotZero(length_s)) triangle.s = (sign / length_s) * s;
    if (isNotZero(length_t)) triangle.t = (sign / length_t) * t;
    triangle.length_s = length_s / std::fabs(area);
    triangle.length_t = length_t / std::fabs(area);
    triangle.has_no_direction = !isNotZero(triangle.length_s) || !isNotZero(triangle.length_t);
}

/// Assigns the orientation of the half with the larger UV area to both halves of a quad. Their directions are
/// unchanged.
void unifyQuads(std::vector<Triangle>& triangles) {
    for (std::size_t i = 1; i < triangles.size(); ++i) {
        Triangle &first = triangles[i - 1], &second = triangles[i];
        if (first.face != second.face || first.faces_up == second.faces_up) continue;
        if (second.has_no_direction || std::fabs(first.uv_area) >= std::fabs(second.uv_area))
            second.faces_up = first.faces_up;
        else
            first.faces_up = second.faces_up;
    }
}

// --------------------------------------------------------------------------------------------------- Step 4. Neighbors

struct Edge {
    std::uint32_t low, high;  ///< nodes of its ends, with the smaller number first
    HalfEdge half_edge;
    bool runs_up;  ///< true: the edge runs from `low` to `high`
};

/// Sorts edges by `low`, with the quicksort of the reference. It is not stable, and the order that it leaves matters
/// for the last bucket.
void sortByLow(std::vector<Edge>& edges) {
    struct Range {
        std::ptrdiff_t first, last;
        std::uint32_t seed;
    };
    std::vector<Range> ranges{{0, static_cast<std::ptrdiff_t>(edges.size()) - 1, 39871946}};
    while (!ranges.empty()) {
        auto [first, last, seed] = ranges.back();
        ranges.pop_back();
        if (first >= last) continue;
        if (last - first == 1) {
            if (edges[first].low > edges[last].low) std::swap(edges[first], edges[last]);
            continue;
        }
        const std::uint32_t turn = seed & 31;
        seed += (seed << turn | seed >> ((32 - turn) & 31)) + 3;
        const std::uint32_t pivot = edges[first + seed % static_cast<std::uint32_t>(last - first + 1)].low;
        std::ptrdiff_t i = first, j = last;
        do {
            while (edges[i].low < pivot) ++i;
            while (edges[j].low > pivot) --j;
            if (i <= j) std::swap(edges[i++], edges[j--]);
        } while (i <= j);
        ranges.push_back({first, j, seed});
        ranges.push_back({i, last, seed});
    }
}

bool comesBefore(const Edge& a, const Edge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.half_edge.triangle < b.half_edge.triangle;
}

/// Sorts edges by their nodes and triangles. With Pairing::reference, the last bucket (all edges with the largest
/// `low`) keeps the order of the quicksort, except that runs of equal `high` are sorted by triangle, all but the last
/// run.
void sortEdges(std::vector<Edge>& edges, Pairing pairing) {
    if (edges.empty()) return;
    if (pairing == Pairing::corrected) return std::sort(edges.begin(), edges.end(), comesBefore);
    sortByLow(edges);
    const auto last_bucket =
        std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e.low == edges.back().low; });
    std::sort(edges.begin(), last_bucket, comesBefore);
    for (auto run = last_bucket; run != edges.end();) {
        const auto end = std::find_if(run, edges.end(), [&](const Edge& e) { return e.high != run->high; });
        if (end != edges.end()) std::sort(run, end, comesBefore);
        run = end;
    }
}

/// Pairs each edge with the next edge in the list between the same nodes that is opposite and not yet paired.
void pairEdges(std::vector<Triangle>& triangles, Pairing pairing) {
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles[t].nodes[k], b = triangles[t].nodes[next(k)];
            edges.push_back({std::min(a, b), std::max(a, b), {t, k}, a < b});
        }
    }
    sortEdges(edges, pairing);
    const auto neighbor = [&](const Edge& e) -> HalfEdge& {
        return triangles[e.half_edge.triangle].neighbors[e.half_edge.k];
    };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        if (neighbor(edge).triangle != kNone) continue;
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            const Edge& other = edges[j];
            if (other.low != edge.low || other.high != edge.high) break;
            if (other.runs_up == edge.runs_up || neighbor(other).triangle != kNone) continue;
            neighbor(edge) = other.half_edge;
            neighbor(other) = edge.half_edge;
            break;
        }
    }
}

// ------------------------------------------------------------------------------------------------------ Step 5. Groups

/// Adds the triangles that follow `from` around the node to the group, until one is missing, belongs to a group
/// already, or has the other orientation.
void walk(std::vector<Triangle>& triangles, HalfEdge from, bool forward, std::uint32_t number, Group& group) {
    for (;;) {
        const HalfEdge& across = triangles[from.triangle].neighbors[forward ? from.k : previous(from.k)];
        if (across.triangle == kNone) return;
        Triangle& triangle = triangles[across.triangle];
        // The neighbor's edge has the opposite direction: it ends at the node where the edge that is crossed begins.
        const int k = forward ? next(across.k) : across.k;
        if (triangle.groups[k] != kNone) return;
        const auto& taken = triangle.groups;
        if (triangle.has_no_direction && taken[0] == kNone && taken[1] == kNone && taken[2] == kNone)
            triangle.faces_up = group.faces_up;
        if (triangle.faces_up != group.faces_up) return;
        triangle.groups[k] = number;
        from = {across.triangle, k};
        group.members.push_back(from);
    }
}

std::vector<Group> makeGroups(std::vector<Triangle>& triangles) {
    std::vector<Group> groups;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            Triangle& triangle = triangles[t];
            if (triangle.has_no_direction || triangle.groups[k] != kNone) continue;
            const auto number = static_cast<std::uint32_t>(groups.size());
            Group& group = groups.emplace_back(Group{triangle.nodes[k], triangle.faces_up, {{t, k}}});
            triangle.groups[k] = number;
            walk(triangles, {t, k}, true, number, group);
            walk(triangles, {t, k}, false, number, group);
        }
    }
    return groups;
}

// -------------------------------------------------------------------------------------------------------- Step 6. Mean

/// Returns the angle of a corner between its two edges in the plane perpendicular to n. The arc cosine is computed in
/// double precision.
float projectedAngle(const Corners& data, const Triangle& triangle, int k, Vec3 n) {
    const Vec3 here = data.position(triangle.nodes[k]);
    const Vec3 back = unitInPlane(n, data.position(triangle.nodes[previous(k)]) - here);
    const Vec3 ahead = unitInPlane(n, data.position(triangle.nodes[next(k)]) - here);
    float cosine = dot(back, ahead);
    if (cosine > 1) cosine = 1;
    if (cosine < -1) cosine = -1;
    return static_cast<float>(std::acos(static_cast<double>(cosine)));
}

/// Returns the mean of the corners in `members`, which are sorted by triangle, weighted by their angles.
Frame meanFrame(const Corners& data, const std::vector<Triangle>& triangles, const std::vector<HalfEdge>& members,
                const Group& group) {
    Vec3 s{}, t{};
    float length_s = 0, length_t = 0, sum = 0;
    const Vec3 n = data.normal(group.node);
    for (const auto& [number, k] : members) {
        const Triangle& triangle = triangles[number];
        if (triangle.has_no_direction) continue;
        const float angle = projectedAngle(data, triangle, k, n);
        s = s + angle * unitInPlane(n, triangle.s);
        t = t + angle * unitInPlane(n, triangle.t);
        length_s = length_s + angle * triangle.length_s;
        length_t = length_t + angle * triangle.length_t;
        sum = sum + angle;
    }
    if (sum > 0) length_s = length_s / sum, length_t = length_t / sum;
    return {unit(s), unit(t), length_s, length_t, group.faces_up, true};
}

/// Returns whether two triangles of a group are averaged: their directions must differ by less than the threshold.
bool isAveraged(const Triangle& a, const Triangle& b, Vec3 n, float cosine) {
    if (a.has_no_direction || b.has_no_direction || a.face == b.face) return true;
    return dot(unitInPlane(n, a.s), unitInPlane(n, b.s)) > cosine &&
           dot(unitInPlane(n, a.t), unitInPlane(n, b.t)) > cosine;
}

/// Writes the result of a corner. The two triangles of a quad that meet at its diagonal both write the corner there,
/// which gets the mean of the two.
void writeFrame(Frame& slot, const Frame& frame) {
    const bool is_equal =
        slot.length_s == frame.length_s && slot.length_t == frame.length_t && slot.s == frame.s && slot.t == frame.t;
    if (!slot.is_written) {
        slot = frame;
    } else if (!is_equal) {
        slot.length_s = 0.5f * (slot.length_s + frame.length_s);
        slot.length_t = 0.5f * (slot.length_t + frame.length_t);
        slot.s = unit(slot.s + frame.s);
        slot.t = unit(slot.t + frame.t);
    }
    slot.faces_up = frame.faces_up;
}

void averageGroup(const Corners& data, const std::vector<Triangle>& triangles, const Group& group, float cosine,
                  std::vector<Frame>& frames) {
    const auto comesFirst = [](const HalfEdge& a, const HalfEdge& b) { return a.triangle < b.triangle; };
    std::vector<std::uint32_t> last;  // triangles of the subset to which `mean` belongs
    Frame mean;
    for (const auto& [number, k] : group.members) {
        std::vector<HalfEdge> subset;
        for (const HalfEdge& other : group.members) {
            if (isAveraged(triangles[number], triangles[other.triangle], data.normal(group.node), cosine))
                subset.push_back(other);
        }
        std::sort(subset.begin(), subset.end(), comesFirst);
        std::vector<std::uint32_t> numbers;
        for (const HalfEdge& other : subset) numbers.push_back(other.triangle);
        if (numbers != last) mean = meanFrame(data, triangles, subset, group);
        last = std::move(numbers);
        writeFrame(frames[triangles[number].corners[k]], mean);
    }
}

/// Returns the cosine of the threshold. It is computed in float except for the cosine itself, as in the reference; 180
/// degrees give exactly -1.
float thresholdCosine(float degrees) {
    return static_cast<float>(std::cos(static_cast<double>(degrees * 3.14159274f / 180.0f)));
}

// ---------------------------------------------------------------------------------------- Step 7. Degenerate triangles

/// Copies results to the corners of degenerate triangles. Each corner gets the result of the first other corner at its
/// node. A quad with one degenerate half has one corner that its other half lacks: that corner copies the corner of the
/// other half at the same position.
void copyToDegenerate(const Corners& data, const std::vector<Triangle>& triangles,
                      const std::vector<Triangle>& degenerate, std::vector<Frame>& frames) {
    std::unordered_map<std::uint32_t, std::uint32_t> first_corners;  // first corner of each node
    for (const Triangle& triangle : triangles) {
        for (int k = 0; k < 3; ++k) first_corners.try_emplace(triangle.nodes[k], triangle.corners[k]);
    }
    for (const Triangle& triangle : degenerate) {
        if (triangle.has_degenerate_half) continue;
        for (int k = 0; k < 3; ++k) {
            const auto found = first_corners.find(triangle.nodes[k]);
            if (found != first_corners.end()) frames[triangle.corners[k]] = frames[found->second];
        }
    }
    for (const Triangle& triangle : triangles) {
        if (!triangle.has_degenerate_half) continue;
        const auto& [a, b, c] = triangle.corners;
        const std::uint32_t missing = 4 * triangle.face + 6 - (a + b + c);  // 6 = 0 + 1 + 2 + 3
        for (const std::uint32_t corner : triangle.corners) {
            if (data.position(corner) != data.position(missing)) continue;
            frames[missing] = frames[corner];
            break;
        }
    }
}

// -------------------------------------------------------------------------------------------------------- Step 8. Sign

/// Writes the frames of all corners; corners of ignored faces get zeros.
void writeFrames(const MeshView& mesh, const std::vector<Frame>& frames, float sign_factor, const TangentOutput& out) {
    std::size_t corner = 0;
    for (std::size_t face = 0; face < mesh.faceCount(); ++face) {
        const std::uint32_t size = mesh.face_sizes.empty() ? mesh.face_size : mesh.face_sizes[face];
        const bool is_used = size == 3 || size == 4;
        for (const std::size_t end = corner + size; corner < end; ++corner) {
            const auto& [s, t, length_s, length_t, faces_up, is_written] = frames[corner];
            const float sign = faces_up ? sign_factor : -sign_factor;
            if (!out.tangents.empty()) out.tangents[corner] = is_used ? Vec4{s.x, s.y, s.z, sign} : Vec4{};
            if (!out.bitangents.empty()) out.bitangents[corner] = is_used ? sign_factor * t : Vec3{};
            if (!out.magnitudes_s.empty()) out.magnitudes_s[corner] = is_used ? length_s : 0;
            if (!out.magnitudes_t.empty()) out.magnitudes_t[corner] = is_used ? length_t : 0;
        }
    }
}

}  // namespace

void plainMikktspace(const MeshView& mesh, const TangentOptions& options, const TangentOutput& out) {
    const Corners data{mesh};
    std::vector<Triangle> triangles = cutFaces(data);  // step 1
    weldCorners(data, triangles);                      // step 2
    const std::vector<Triangle> degenerate = takeDegenerate(data, triangles);
    for (Triangle& triangle : triangles) computeFaceVectors(data, triangle);  // step 3
    unifyQuads(triangles);
    pairEdges(triangles, options.pairing);                    // step 4
    const std::vector<Group> groups = makeGroups(triangles);  // step 5
    std::vector<Frame> frames(mesh.cornerCount());
    const float cosine = thresholdCosine(options.angular_threshold_deg);
    for (const Group& group : groups) averageGroup(data, triangles, group, cosine, frames);  // step 6
    copyToDegenerate(data, triangles, degenerate, frames);                                   // step 7
    writeFrames(mesh, frames, signFactor(options.convention), out);                          // step 8
}

}  // namespace tspace::mikk
