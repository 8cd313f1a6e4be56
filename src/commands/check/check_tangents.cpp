// SPDX-License-Identifier: MIT
// Checks whether needed tangents exist, and whether they are correct for the UVs that they should follow. If they are
// not, tests whether they fit quads, other axes or other UVs.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "commands/check/findings.h"
#include "commands/check/primitive_checks.h"
#include "core/base/vec_math.h"
#include "core/mesh/quads/quads.h"
#include "core/mesh/surface/uvs.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Returns whether there are faults that tangents computed on quads could explain.
bool hasFaults(const FrameHealth& health) {
    for (const Tally* tally : {&health.signs_mixed, &health.signs_wrong, &health.mirrored_seams, &health.uv_seams,
                               &health.directions_wrong, &health.frames_differ}) {
        if (tally->count != 0) return true;
    }
    return false;
}

double uvArea(const TangentView& mesh, std::size_t triangle) {
    const auto uv = [&](std::size_t k) { return mesh.uvs[mesh.corners[3 * triangle + k]]; };
    return std::fabs(signedUvArea(uv(0), uv(1), uv(2), false));
}

/// Gives both halves of a quad one orientation, as the MikkTSpace reference does: if the quad is folded in the UV map,
/// the larger half decides.
void unifyQuadOrientations(const TangentView& mesh, std::span<const std::uint32_t> faces, Surface& surface) {
    for (std::size_t t = 0; t + 1 < faces.size(); ++t) {
        SurfaceFrame &first = surface.faces[t], &second = surface.faces[t + 1];
        if (faces[t] != faces[t + 1] || first.orientation * second.orientation != -1) continue;
        if (uvArea(mesh, t) >= uvArea(mesh, t + 1)) {
            second.orientation = first.orientation;
        } else {
            first.orientation = second.orientation;
        }
    }
}

QuadReading cutQuads(const TangentView& mesh, const QuadFaces& faces) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(faces.corners.size());
    for (const std::uint32_t corner : faces.corners) vertices.push_back(mesh.corners[corner]);
    MeshView polygons;
    polygons.positions = mesh.positions;
    polygons.uvs = mesh.uvs;
    polygons.indices = IndexView(std::span<const std::uint32_t>(vertices));
    polygons.face_sizes = faces.sizes;
    const Triangulation cut = valueOrThrow(triangulate(polygons));
    QuadReading reading;
    reading.corners.reserve(cut.corners.size());
    for (const std::uint32_t corner : cut.corners) reading.corners.push_back(vertices[corner]);
    TangentView other = mesh;
    other.corners = reading.corners;
    reading.surface = describeSurface(other);
    unifyQuadOrientations(other, cut.faces, reading.surface);
    return reading;
}

}  // namespace

std::optional<QuadReading> findQuads(const TangentView& mesh, const FrameHealth& health, const CheckOptions& options) {
    const bool try_quads = options.faces == Faces::quads || (options.faces == Faces::automatic && hasFaults(health));
    if (!try_quads || mesh.normals.empty() || mesh.uvs.empty()) return {};
    const QuadFaces faces =
        valueOrThrow(chooseFaces(mesh.triangles(), mesh.tangents, false, options.faces, {.thread_count = 1}));
    return faces.quad_count == 0 ? std::optional<QuadReading>() : cutQuads(mesh, faces);
}

namespace {

// Detects tangents that were not rotated with their mesh, for example from Z up to Y up.

/// Other axes are tried if tangents are tilted out of at least this share of the surface.
constexpr double kManyTilted = 0.2;
/// Axes are correct if at most this share of the surface has tilted tangents, and at most this share has wrong
/// directions.
constexpr double kMaxWrong = 0.02;

/// Permutation of signed axes: component i of the result is `sign[i]` times component `from[i]`.
struct AxisExchange {
    std::array<std::size_t, 3> from = {0, 1, 2};
    std::array<float, 3> sign = {1, 1, 1};

    [[nodiscard]] Vec4 operator()(const Vec4& t) const {
        const std::array<float, 3> v{t.x, t.y, t.z};
        return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]], t.w};
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (std::size_t i = 0; i < 3; ++i)
            text += std::string(i == 0 ? "" : ", ") + (sign[i] < 0 ? "-" : "") + "xyz"[from[i]];
        return text;
    }
};

double tiltedShare(const PrimitiveFacts& facts, std::span<const Vec4> tangents) {
    double tilted_area = 0;
    for (std::uint32_t v = 0; v < tangents.size(); ++v) {
        DVec3 n = toDouble(facts.mesh.normals[v]), t = toDouble(xyz(tangents[v]));
        if (!normalize(n) || !normalize(t)) continue;
        const double tilt = std::fabs(90 - angleBetween(n, t) * 180 / kPi);
        if (tilt > facts.options.orthogonal_deg) tilted_area += facts.surface.vertex_areas[v];
    }
    return tilted_area / facts.surface.area;
}

double wrongShare(const PrimitiveFacts& facts, std::span<const Vec4> tangents) {
    TangentView mesh = facts.mesh;
    mesh.tangents = tangents;
    const double limit = facts.options.direction_deg;
    const std::vector<float> directions = directionDistances(mesh, facts.surface, limit);
    double wrong = 0;
    for (std::uint32_t v = 0; v < directions.size(); ++v)
        wrong += directions[v] > limit ? facts.surface.known_areas[v] : 0;
    return wrong / facts.surface.known_area;
}

/// Finds axes in which the tangents fit nearly everywhere, if many stored tangents are tilted out of the surface.
/// Returns the axes in terms of the stored vectors ("x, z, -y"), or an empty string if there are none. All 48 signed
/// permutations of the axes are tried.
std::string findOtherAxes(const PrimitiveFacts& facts, const FrameHealth& health) {
    if (facts.mesh.uvs.empty() || !(facts.surface.known_area > 0)) return {};
    if (health.not_orthogonal.surface_share + health.parallel.surface_share < kManyTilted ||
        health.directions_wrong.count == 0)
        return {};
    std::vector<Vec4> turned(facts.mesh.tangents.size());
    AxisExchange axes;
    do {
        for (unsigned signs = 0; signs < 8; ++signs) {
            for (std::size_t i = 0; i < 3; ++i) axes.sign[i] = (signs >> i & 1) != 0 ? -1.0f : 1.0f;
            std::transform(facts.mesh.tangents.begin(), facts.mesh.tangents.end(), turned.begin(), axes);
            if (tiltedShare(facts, turned) <= kMaxWrong && wrongShare(facts, turned) <= kMaxWrong) return axes.text();
        }
    } while (std::next_permutation(axes.from.begin(), axes.from.end()));
    return {};
}

// Tangents that do not follow the expected UVs may follow other UVs.

struct OtherReading {
    UvReading reading = {};
    Surface surface = {};
    FrameHealth health = {};
    /// Index of a use of the primitive whose texture is sampled with these UVs, if there is one: then the tangents may
    /// follow these UVs on purpose.
    std::optional<std::size_t> use = {};
};

/// Other UVs are tried only if the directions are wrong on more than this share of the surface that has UV area.
constexpr double kClearlyWrong = 0.2;
/// The primitive's own UV set without its texture transform, which may mirror, is also tried if the signs are wrong on
/// more than this share.
constexpr double kSomeSigns = 0.1;
/// UVs explain the tangents only if directions, and also signs (unless all are inverted, for another UV set), are wrong
/// on at most this share.
constexpr double kExplained = 0.02;
/// Other UVs explain the tangents only if they have area on at least this share of the surface that has UV area in the
/// expected UVs.
constexpr double kCovered = 0.95;

struct Faults {
    double directions = 0, signs = 0;
};

double shareOf(const Tally& tally, const Surface& surface) {
    return surface.known_area > 0 ? tally.area / surface.known_area : 0;
}

Faults faultsOf(const FrameHealth& health, const Surface& surface) {
    return {shareOf(health.directions_wrong, surface) + shareOf(health.uv_seams, surface) +
                shareOf(health.mirrored_seams, surface),
            health.wrong_sign_share};
}

/// Returns the share of the surface with UV area in `own` that also has UV area in `other`.
double coverage(const Surface& own, const Surface& other) {
    double covered = 0;
    for (std::size_t f = 0; f < own.faces.size(); ++f) {
        if (own.faces[f].orientation != 0 && other.faces[f].orientation != 0) covered += own.faces[f].area;
    }
    return own.known_area > 0 ? covered / own.known_area : 0;
}

bool readsLike(const UvReading& reading, const ScenePrimitive& primitive, const TangentUse& use) {
    return !reading.transformed && reading.uv_set == use.uv_set && !readingOf(primitive, use).transformed;
}

class Search {
  public:
    Search(const PrimitiveFacts& facts, const Faults& now) : facts_(facts), now_(now) {}

    /// Returns whether the interpretation explains the tangents; if so, fills `found`.
    bool test(UvReading&& reading, bool is_own_set, OtherReading& found) const {
        if (reading.uvs.empty()) return false;
        TangentView mesh = facts_.mesh;
        mesh.uvs = reading.uvs;
        Surface surface = describeSurface(mesh);
        if (coverage(facts_.surface, surface) < kCovered) return false;
        FrameHealth health = examineTangents(mesh, surface, facts_.options);
        const Faults with_other = faultsOf(health, surface);
        const bool signs_fit = with_other.signs <= kExplained || (!is_own_set && health.all_signs_wrong);
        if (with_other.directions > kExplained || !signs_fit) return false;
        if (now_.directions <= kClearlyWrong && !(is_own_set && now_.signs > kSomeSigns)) return false;
        found.reading = std::move(reading);
        found.surface = std::move(surface);
        found.health = std::move(health);
        return true;
    }

  private:
    const PrimitiveFacts& facts_;
    Faults now_;
};

/// Returns whether directions, not only signs, are wrong, so that another interpretation must fix the directions.
bool areDirectionsWrong(const FrameHealth& health, const Surface& surface) {
    return faultsOf(health, surface).directions > kClearlyWrong;
}

/// Returns the first interpretation that the tangents fit: the same set without its transform, then other sets, then
/// UVs of further textures of the primitive. The test is strict, because coincidences are common. The other UVs must
/// have area nearly everywhere the own UVs have it. The tangents must follow them nearly everywhere, and clearly not
/// follow the own UVs. `health`: result for facts.reading. Fails as examineTangents does.
std::optional<OtherReading> findOtherReading(const PrimitiveFacts& facts, const FrameHealth& health) {
    const ScenePrimitive& primitive = facts.primitive;
    const Faults now = faultsOf(health, facts.surface);
    const bool signs_matter = facts.reading.transformed && now.signs > kSomeSigns;
    if (now.directions <= kClearlyWrong && !signs_matter) return {};
    const Search search(facts, now);
    OtherReading found;
    for (std::size_t i = 0; i <= primitive.uv_sets.size(); ++i) {
        const std::size_t set = i == 0 ? facts.reading.uv_set : i - 1;
        const bool is_own = set == facts.reading.uv_set;
        if (is_own && (i > 0 || !facts.reading.transformed)) continue;
        UvReading reading = plainReading(primitive, set);
        std::optional<std::size_t> use;
        for (std::size_t u = 1; u < primitive.uses.size() && !use; ++u) {
            if (readsLike(reading, primitive, primitive.uses[u])) use = u;
        }
        found.use = use;
        if (search.test(std::move(reading), is_own, found)) return found;
    }
    for (std::size_t u = 1; u < primitive.uses.size(); ++u) {
        UvReading reading = readingOf(primitive, primitive.uses[u]);
        if (!reading.transformed) continue;
        const bool is_own = reading.uv_set == facts.reading.uv_set;
        found.use = u;
        if (search.test(std::move(reading), is_own, found)) return found;
    }
    return {};
}

/// Reports that the tangents fit other UVs. This is an error only if it would be one without the explanation, and if no
/// other texture of the primitive uses these UVs.
void addExplanation(PrimitiveFacts& facts, const FrameHealth& health, const OtherReading& other) {
    const std::string set = "TEXCOORD_" + std::to_string(facts.reading.uv_set);
    const Tally& wrong = areDirectionsWrong(health, facts.surface) ? health.directions_wrong : health.signs_wrong;
    FindingCode code = FindingCode::textureTransformIgnored;
    Severity severity = Severity::warning;
    std::string cause = "the tangents follow " + set +
                        " without the rotation or mirroring of KHR_texture_transform for " +
                        facts.primitive.uses.front().needed_by;
    if (other.reading.uv_set != facts.reading.uv_set) {
        code = FindingCode::uvSetWrong;
        cause =
            "the tangents follow TEXCOORD_" + std::to_string(other.reading.uv_set) + ", but the texture uses " + set;
        if (!other.use && !whyTangentsAreWrong(health, facts.options).empty()) severity = Severity::error;
    }
    if (other.use)
        cause += "; " + facts.primitive.uses[*other.use].needed_by + " uses the UVs that the tangents follow";
    facts.add(code, severity, wrong, "vertices",
              {.symptom = "the relief is lit from the wrong direction", .cause = std::move(cause)});
    // The vertices are faulty even if another texture uses the UVs that the tangents fit, because the first texture
    // decides.
    for (const std::uint32_t vertex : facts.mesh.corners) facts.faults[vertex] |= faultBit(code);
}

void checkUnreadable(PrimitiveFacts& facts) {
    for (const SceneTangentFault& fault : facts.primitive.tangent_faults) {
        const std::string what =
            fault.target < 0 ? "the tangents" : "the tangent deltas of morph target " + std::to_string(fault.target);
        facts.add(FindingCode::tangentsUnreadable, Severity::error, Tally::all(facts.mesh.positions.size()), "vertices",
                  {.cause = what + " cannot be read: " + fault.why});
    }
}

bool isUnreadable(const ScenePrimitive& primitive) {
    return std::any_of(primitive.tangent_faults.begin(), primitive.tangent_faults.end(),
                       [](const SceneTangentFault& fault) { return fault.target < 0; });
}

void checkTangentsMissing(PrimitiveFacts& facts) {
    // If an attribute cannot be read, its own finding states the fix.
    if (facts.primitive.uses.empty() || isUnreadable(facts.primitive) || !facts.primitive.attribute_faults.empty())
        return;
    Tally all = Tally::all(facts.mesh.positions.size());
    const char* state = facts.primitive.tangents_not_read ? "cannot be read from this format" : "are missing";
    const std::string& user = facts.primitive.uses.front().needed_by;
    if (const ScenePacked* packed = facts.primitive.packedAlone()) {
        facts.add(FindingCode::tangentsMissing, Severity::note, all, "vertices",
                  {.cause = user + " needs tangents, which exist only in the packed frames of " + packed->attribute});
        return;
    }
    facts.add(FindingCode::tangentsMissing, facts.is_gltf ? Severity::warning : Severity::note, all, "vertices",
              {.cause = user + (facts.is_gltf ? std::string(" needs tangents, but the primitive has none, so the "
                                                            "relief may look different in each renderer")
                                              : std::string(" needs tangents, but they ") + state +
                                                    "; tspace generate writes a glTF file with tangents")});
}

/// Replaces the triangles by the quads on which the tangents were computed, if any.
void readOnQuads(PrimitiveFacts& facts, FrameHealth& health) {
    std::optional<QuadReading> quads = findQuads(facts.mesh, health, facts.options);
    if (!quads) return;
    facts.quads = *std::move(quads);
    facts.mesh.corners = facts.quads.corners;
    facts.surface = facts.quads.surface;
    health = examineTangents(facts.mesh, facts.surface, facts.options);
}

}  // namespace

void checkTangents(PrimitiveFacts& facts) {
    checkUnreadable(facts);
    if (facts.mesh.tangents.empty()) {
        checkTangentsMissing(facts);
        return;
    }
    Tally all = Tally::all(facts.mesh.positions.size());
    if (facts.primitive.uses.empty() && !facts.primitive.mayHaveAuthoredTangents()) {
        // No material reads these tangents, so faults in them are invisible.
        facts.add(FindingCode::tangentsUnused, Severity::note, all, "vertices",
                  {.symptom = "the file is larger than necessary",
                   .cause = "the primitive has tangents, but its material needs none"});
        return;
    }
    if (facts.mesh.normals.empty()) {
        if (facts.primitive.findFault("NORMAL") != nullptr) return;
        facts.add(FindingCode::tangentsIgnored, Severity::warning, all, "vertices",
                  {.symptom = "the tangents have no effect",
                   .cause = "without normals, glTF requires readers to ignore tangents"});
        return;
    }
    FrameHealth health = examineTangents(facts.mesh, facts.surface, facts.options);
    readOnQuads(facts, health);
    std::optional<OtherReading> other = findOtherReading(facts, health);
    facts.examined_values = true;
    facts.faults = std::move(health.faults);
    facts.wrong_sign_share = health.wrong_sign_share;
    if (other) {
        facts.faults.assign(facts.mesh.positions.size(), 0);
        addExplanation(facts, health, *other);
        health = std::move(other->health);
        facts.wrong_sign_share = health.wrong_sign_share;
        facts.reading = std::move(other->reading);
        facts.surface = std::move(other->surface);
        facts.mesh.uvs = facts.reading.uvs;
        for (std::size_t v = 0; v < health.faults.size(); ++v) facts.faults[v] |= health.faults[v];
    }
    const std::string axes = other ? std::string() : findOtherAxes(facts, health);
    if (!axes.empty()) {
        // All tangents are marked as wrong, because they have one cause: some are close to the correct ones only by
        // chance.
        for (const std::uint32_t vertex : facts.mesh.corners) facts.fault(vertex, FindingCode::directionsWrong);
    }
    for (Finding& finding : tangentFindings(health, facts.options)) {
        if (finding.code == FindingCode::directionsWrong && !axes.empty()) {
            extendCause(finding, "; they fit if the stored vectors are read as (" + axes +
                                     "), so the mesh was rotated to other axes without its tangents");
        }
        // Without a texture, the direction in which v increases is seldom visible.
        if (finding.code == FindingCode::signsMixed && facts.primitive.mayHaveAuthoredTangents())
            finding.severity = Severity::warning;
        facts.findings.push_back(std::move(finding));
    }
}

}  // namespace tspace
