// SPDX-License-Identifier: MIT
// Computes cones of directions around vertices.
#include "commands/check/direction_cones.h"

#include <algorithm>
#include <cmath>

#include "core/base/sort.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"

namespace tspace {
namespace {

constexpr double kTurn = 2 * kPi;
constexpr double kDegrees = 180 / kPi;

/// Minimum length of a unit tangent projected to the plane of N. Tangents within 6 degrees of N have no reliable
/// direction there.
constexpr double kMinInPlane = 0.1;
/// Minimum projected length of a triangle's unit direction. Methods weight directions regardless of this length, so
/// nearly all are used; shorter ones are rounding errors.
constexpr double kMinOfTriangle = 1e-6;
/// Minimum projected length of a unit edge. An edge along N has no direction in the plane.
constexpr double kMinOfEdge = 1e-4;

double signedAngle(double x, double y) { return y < 0 ? -polarAngle(x, -y) : polarAngle(x, y); }

/// Projects v to the plane perpendicular to the unit vector n, and normalizes it. Returns false if the projection of
/// the unit vector is shorter than `least`.
bool projectUnit(const DVec3& n, DVec3& v, double least) {
    if (!normalize(v)) return false;
    v = v - dot(n, v) * n;
    const double left = length(v);
    if (!(left >= least)) return false;
    v = (1 / left) * v;
    return true;
}

double angleInPlane(const Vec3& normal, const Vec3& v, double least, bool& found) {
    DVec3 n = toDouble(normal);
    DVec3 d = toDouble(v);
    found = normalize(n) && projectUnit(n, d, least);
    if (!found) return 0;
    const PlaneAxes axes = planeAxes(n);
    return signedAngle(dot(axes.x, d), dot(axes.y, d));
}

double withinTurn(double angle) { return angle > kPi ? angle - kTurn : angle < -kPi ? angle + kTurn : angle; }

/// Returns the maximum angle, in radians, by which rounding of the positions may rotate a triangle's direction in the
/// plane perpendicular to n; pi: any angle.
double errorInPlane(const DVec3& n, const SurfaceFrame& face) {
    if (face.tangent_error == 0) return 0;
    const double part = length(cross(n, toDouble(face.tangent)));
    const double sine = face.tangent_error / part;
    return sine < 1 ? polarAngle(std::sqrt(1 - sine * sine), sine) : kPi;
}

/// Returns whether the angle at the corner, seen along N, exceeds the rounding error of floats. Methods that weight by
/// this angle, such as MikkTSpace, give other corners no weight or an arbitrary one.
bool spansAngle(const TangentView& mesh, std::size_t corner) {
    constexpr double kMinAngle = 1e-3;  // the arc cosine of the largest float below 1 is 3.5e-4
    const std::size_t face = corner / 3 * 3, place = corner - face;
    const auto position = [&](std::size_t k) { return toDouble(mesh.positions[mesh.corners[face + k % 3]]); };
    DVec3 n = toDouble(mesh.normals[mesh.corners[corner]]);
    DVec3 a = position(place + 1) - position(place), b = position(place + 2) - position(place);
    if (!normalize(n) || !projectUnit(n, a, kMinOfEdge) || !projectUnit(n, b, kMinOfEdge)) return false;
    return dot(a, b) < 0 || length(cross(a, b)) > kMinAngle;
}

/// Sets distances beyond the tolerance to unknown if no triangle with a direction spans an angle at the vertex: the
/// result of methods that weight by this angle is arbitrary there.
void excludeThinCorners(const TangentView& mesh, const Surface& surface, double tolerance_deg,
                        std::vector<float>& distances) {
    std::vector<bool> spans(distances.size(), false);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const std::uint32_t v = mesh.corners[c];
        if (!(distances[v] > tolerance_deg) || spans[v] || surface.faces[c / 3].tangent == Vec3{}) continue;
        spans[v] = spansAngle(mesh, c);
    }
    for (std::size_t v = 0; v < distances.size(); ++v) {
        if (distances[v] > tolerance_deg && !spans[v]) distances[v] = kUnknownDirection;
    }
}

/// Finds, for each vertex, the nearest directions of its triangles on both sides of its tangent.
class NearestDirections {
  public:
    explicit NearestDirections(const TangentView& mesh)
        : mesh_(mesh), left_(mesh.positions.size(), kNone), right_(mesh.positions.size(), kNone) {}

    void add(std::uint32_t vertex, const SurfaceFrame& face) {
        DVec3 n = toDouble(mesh_.normals[vertex]);
        DVec3 t = toDouble(xyz(mesh_.tangents[vertex]));
        DVec3 d = toDouble(face.tangent);
        if (!normalize(n) || !projectUnit(n, t, kMinInPlane)) return;
        if (!projectUnit(n, d, kMinOfTriangle)) {
            // Projected to the plane, a direction along N is a rounding error that may point anywhere, but methods give
            // it full weight. So any tangent is possible here, including the stored one.
            if (face.tangent != Vec3{}) addAngle(vertex, 0);
            return;
        }
        const double off = errorInPlane(n, face);
        addArc(vertex, signedAngle(dot(t, d), dot(cross(n, t), d)), off);
        if (face.orientation == 0) addArc(vertex, signedAngle(-dot(t, d), -dot(cross(n, t), d)), off);
    }
    /// Adds all directions within `off` of an angle.
    void addArc(std::uint32_t vertex, double angle, double off) {
        if (off >= std::fabs(angle)) addAngle(vertex, 0);
        addAngle(vertex, static_cast<float>(angle));
        if (off == 0) return;
        addAngle(vertex, static_cast<float>(withinTurn(angle - off)));
        addAngle(vertex, static_cast<float>(withinTurn(angle + off)));
    }
    void addAngle(std::uint32_t vertex, float angle) {
        if (angle >= 0) left_[vertex] = std::min(left_[vertex], angle);
        if (angle <= 0) right_[vertex] = std::min(right_[vertex], -angle);
    }
    /// Returns the angle in degrees between the tangent of a vertex and the nearest direction of its triangles; 0 if
    /// the tangent lies between their directions; kUnknownDirection if no triangle defines a direction.
    [[nodiscard]] float distance(std::size_t vertex) const {
        const float left = left_[vertex], right = right_[vertex];
        if (left == kNone && right == kNone) return kUnknownDirection;
        // The tangent is between two directions that are less than 180 degrees apart.
        if (left + right < static_cast<float>(kPi)) return 0;
        return static_cast<float>(std::min(left, right) * kDegrees);
    }

  private:
    static constexpr float kNone = 100;

    const TangentView& mesh_;
    std::vector<float> left_, right_;
};

/// Also considers, for vertices beyond the tolerance, the triangles around equal vertices, except those of the opposite
/// orientation.
void considerEqualVertices(const TangentView& mesh, const Surface& surface, double tolerance_deg,
                           std::vector<float>& distances) {
    const std::vector<std::uint8_t> orientations = vertexOrientations(mesh, surface);
    EqualVertices equal = findEqualVertices(mesh, true);
    for (const std::uint8_t other : {std::uint8_t{2}, std::uint8_t{1}}) {
        std::vector<bool> wanted(equal.class_count, false);
        for (std::size_t v = 0; v < distances.size(); ++v) {
            if (distances[v] > tolerance_deg && orientations[v] != 3 && orientations[v] != other)
                wanted[equal.class_of[v]] = true;
        }
        std::vector<std::uint32_t> classes(distances.size(), kNoClass);
        for (std::size_t v = 0; v < distances.size(); ++v) {
            if (orientations[v] != other && wanted[equal.class_of[v]]) classes[v] = equal.class_of[v];
        }
        const std::vector<DirectionCone> cones = conesOfClasses(mesh, surface, classes, equal.class_count);
        for (std::size_t v = 0; v < distances.size(); ++v) {
            if (classes[v] == kNoClass || !(distances[v] > tolerance_deg)) continue;
            bool found = false;
            const double angle = planeAngle(mesh.normals[v], xyz(mesh.tangents[v]), found);
            if (!found || cones[classes[v]].empty()) continue;
            distances[v] = std::min(distances[v], static_cast<float>(cones[classes[v]].distanceTo(angle) * kDegrees));
        }
    }
}

}  // namespace

double DirectionCone::distanceTo(double angle) const {
    if (width >= kTurn) return 0;
    double behind = std::fmod(angle - begin, kTurn);
    if (behind < 0) behind += kTurn;
    if (behind <= width) return 0;
    return std::min(behind - width, kTurn - behind);
}

DirectionCone coneAround(std::span<double> angles) {
    if (angles.empty()) return {};
    sortList(angles.begin(), angles.end());
    double largest = angles.front() + kTurn - angles.back();
    std::size_t behind = 0;  // index of the first angle after the largest gap
    for (std::size_t i = 1; i < angles.size(); ++i) {
        if (angles[i] - angles[i - 1] <= largest) continue;
        largest = angles[i] - angles[i - 1];
        behind = i;
    }
    if (largest <= kPi) return {angles[behind], kTurn};
    return {angles[behind], kTurn - largest};
}

double planeAngle(const Vec3& normal, const Vec3& v, bool& found) {
    return angleInPlane(normal, v, kMinInPlane, found);
}

std::vector<std::uint8_t> vertexOrientations(const TangentView& mesh, const Surface& surface) {
    std::vector<std::uint8_t> result(mesh.positions.size(), 0);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const std::int8_t orientation = surface.faces[c / 3].orientation;
        if (orientation != 0) result[mesh.corners[c]] |= orientation > 0 ? 1 : 2;
    }
    return result;
}

std::vector<DirectionCone> conesOfClasses(const TangentView& mesh, const Surface& surface,
                                          std::span<const std::uint32_t> class_of_vertex, std::size_t class_count) {
    struct Entry {
        std::uint32_t of_class;
        double angle;
    };
    std::vector<Entry> entries;
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) {
        const std::uint32_t vertex = mesh.corners[c];
        const SurfaceFrame& face = surface.faces[c / 3];
        if (class_of_vertex[vertex] == kNoClass) continue;
        bool found = false;
        const double angle = angleInPlane(mesh.normals[vertex], face.tangent, kMinOfTriangle, found);
        if (!found) continue;
        DVec3 n = toDouble(mesh.normals[vertex]);
        const double off = normalize(n) ? errorInPlane(n, face) : 0;
        const auto add = [&](double at) {
            entries.push_back({class_of_vertex[vertex], at});
            if (off == 0) return;
            // If the direction is undetermined, these angles widen the cone to the full circle.
            for (const double part : {-1.0, -0.5, 0.5, 1.0})
                entries.push_back({class_of_vertex[vertex], withinTurn(at + part * off)});
        };
        add(angle);
        if (face.orientation == 0) add(angle > 0 ? angle - kPi : angle + kPi);
    }
    sortList(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.of_class < b.of_class; });
    std::vector<DirectionCone> cones(class_count);
    std::vector<double> angles;
    for (std::size_t i = 0; i < entries.size();) {
        const std::uint32_t of_class = entries[i].of_class;
        angles.clear();
        for (; i < entries.size() && entries[i].of_class == of_class; ++i) angles.push_back(entries[i].angle);
        cones[of_class] = coneAround(angles);
    }
    return cones;
}

std::vector<float> directionDistances(const TangentView& mesh, const Surface& surface, double tolerance_deg) {
    NearestDirections nearest(mesh);
    for (std::size_t c = 0; c < surface.faces.size() * 3; ++c) nearest.add(mesh.corners[c], surface.faces[c / 3]);
    std::vector<float> distances(mesh.positions.size());
    bool is_any_far = false;
    for (std::size_t v = 0; v < distances.size(); ++v) {
        distances[v] = nearest.distance(v);
        is_any_far = is_any_far || distances[v] > tolerance_deg;
    }
    if (!is_any_far) return distances;
    excludeThinCorners(mesh, surface, tolerance_deg, distances);
    considerEqualVertices(mesh, surface, tolerance_deg, distances);
    return distances;
}

}  // namespace tspace
