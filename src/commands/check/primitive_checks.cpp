// SPDX-License-Identifier: MIT
// Checks one primitive, except for its tangents and morph targets.
#include "commands/check/primitive_checks.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "commands/check/findings.h"
#include "commands/check/frame_health.h"
#include "commands/check/remedy.h"
#include "commands/shared/reportable_noise.h"
#include "core/base/mesh_loops.h"
#include "core/base/numbers.h"
#include "core/base/vec_math.h"
#include "core/mesh/surface/surface.h"
#include "tspace/winding.h"

namespace tspace {
namespace {

std::string setName(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }

// Checks of positions and normals: finite, unit length, and on the front side of their triangles.

/// Cosine of the angle between a normal and the face normal below which the normal points to the back (angles over 96
/// degrees). The margin over 90 degrees allows for coarse smooth shading.
constexpr double kMinFacing = -0.1;
/// Share of the surface from which the whole mesh is reported as inside out; kNearlyAll if it is double-sided.
constexpr double kSurfaceMajority = 0.5;
constexpr double kNearlyAll = 0.95;
constexpr double kSomeNormals = 0.01;
/// Minimum angle in degrees between a normal and the nearest triangle normal. A mean over an edge of a box is 45
/// degrees from both faces.
constexpr double kFarDeg = 40;
/// Share of the surface from which normals far from their triangles are reported.
constexpr double kSomeFar = 0.5;

/// Returns whether `generate --overwrite-normals` computes normals for the primitive.
bool canRecomputeNormals(const ScenePrimitive& primitive) {
    const auto isFatal = [](const SceneAttributeFault& fault) { return fault.repair == AttributeRepair::none; };
    const std::vector<SceneAttributeFault>& faults = primitive.attribute_faults;
    if (primitive.packedAlone() != nullptr || std::any_of(faults.begin(), faults.end(), isFatal)) return false;
    const std::size_t uv_set = primitive.uses.empty() ? 0 : primitive.uses.front().uv_set;
    return primitive.tangents.empty() || !plainReading(primitive, uv_set).uvs.empty();
}

/// Returns the remedy for normals that have no direction.
Remedy invalidNormalsRemedy(const PrimitiveFacts& facts) {
    if (facts.surface.area == 0) return {"Export the mesh again: its triangles have no area, so they have no normals."};
    if (!canRecomputeNormals(facts.primitive))
        return {"Export the normals again; tspace cannot compute new ones that fit the other data of the primitive."};
    return usualRemedy(FindingCode::normalsNotFinite);
}

void checkNormalValues(PrimitiveFacts& facts) {
    const TangentView& mesh = facts.mesh;
    const NormalScales* const scales = facts.primitive.normal_scales.get();
    Tally not_finite, not_unit;
    std::uint64_t zero_count = 0;
    double far_share = 0;
    constexpr double kRounding = 1e-6;  // so that a stored length of 0.9 does not count as far
    for (std::uint32_t v = 0; v < facts.used.size(); ++v) {
        if (!facts.used[v]) continue;
        ++not_finite.total;
        ++not_unit.total;
        if (!isFinite(mesh.normals[v])) {
            not_finite.add(v, facts.surface.vertex_areas[v]);
            continue;
        }
        // The mesh contains normals that were scaled to length 1, so the length in the file is checked.
        const bool is_scaled = scales != nullptr && scales->of_vertices[v] != 1;
        const double size = is_scaled ? 1 / scales->of_vertices[v] : length(toDouble(mesh.normals[v]));
        if (std::fabs(size - 1) > facts.options.unit_tolerance) not_unit.add(v, facts.surface.vertex_areas[v]);
        if (std::fabs(size - 1) > kFarFromUnit + kRounding) far_share += facts.surface.vertex_areas[v];
        zero_count += !is_scaled && size < kLeastLength ? 1 : 0;
    }
    not_finite.finish(facts.surface.area);
    not_unit.finish(facts.surface.area);
    if (not_finite.count > 0) {
        facts.add(FindingCode::normalsNotFinite, Severity::error, not_finite, "vertices",
                  {.symptom = "the surface has black spots",
                   .cause = "the normals of " + countText(not_finite, "vertices") + " are NaN or infinite"});
        setRemedy(facts.findings.back(), invalidNormalsRemedy(facts));
    }
    if (not_unit.count > 0) {
        // A single normal of length 0 gives NaN in shaders. Other lengths make the relief steeper or flatter in readers
        // that do not normalize N, and tangents that follow such N are wrong.
        const bool is_far =
            facts.surface.area > 0 && far_share >= facts.options.error_share * facts.surface.area && far_share > 0;
        std::string lengths;
        if (scales != nullptr)
            lengths = " (from " + shortNumber(scales->min_length) + " to " + shortNumber(scales->max_length) + ")";
        facts.add(FindingCode::normalsNotUnit, zero_count != 0 || is_far ? Severity::error : Severity::warning,
                  not_unit, "vertices",
                  {.symptom = "the shading may be too dark or too bright, and bumps too strong or too weak",
                   .cause = "the normals of " + countText(not_unit, "vertices") + " do not have unit length" + lengths +
                            (zero_count != 0 ? "; " + std::to_string(zero_count) + " of them have length 0" : "")});
        if (zero_count != 0) {
            // Normals of length 0 cannot be normalized.
            setRemedy(facts.findings.back(), invalidNormalsRemedy(facts));
        }
    }
}

/// Unit normals of vertices; zero for normals without direction.
using Directions = std::vector<DVec3>;

Directions directionsOf(const StridedSpan<const Vec3>& normals) {
    Directions directions(normals.count);
    for (std::size_t v = 0; v < directions.size(); ++v) {
        directions[v] = toDouble(normals[v]);
        if (!normalize(directions[v])) directions[v] = {};
    }
    return directions;
}

/// Returns the cosine between the mean vertex normal of a face and the normal of the face; 0 if one of them has no
/// direction.
double facingOf(const PrimitiveFacts& facts, const Directions& directions, std::size_t face) {
    const std::uint32_t* const v = facts.mesh.corners.data() + 3 * face;
    const DVec3 sum = directions[v[0]] + directions[v[1]] + directions[v[2]];
    const double size = length(sum);
    return size > 0 ? dot(sum, toDouble(facts.surface.faces[face].normal)) / size : 0;
}

/// Returns whether one of these triangles shares an edge with a consistently wound triangle whose normals point to the
/// front: mendWinding flips both or neither.
bool haveSoundNeighbors(const PrimitiveFacts& facts, const Directions& directions,
                        std::span<const std::uint32_t> against) {
    const std::span<const std::uint32_t> corners = facts.mesh.corners;
    std::vector<bool> is_near(facts.mesh.positions.size(), false);
    for (const std::uint32_t face : against)
        for (std::size_t k = 0; k < 3; ++k) is_near[corners[3 * face + k]] = true;
    const auto forHalves = [&](const auto& add) {
        for (std::uint32_t c = 0; c < corners.size(); ++c) {
            const std::uint32_t from = corners[c], to = corners[c % 3 == 2 ? c - 2 : c + 1];
            if (is_near[from] && is_near[to] && facts.surface.faces[c / 3].area != 0)
                add(std::min(from, to), std::max(from, to), c);
        }
    };
    bool have = false;
    forEachEdge(is_near.size(), nullptr, forHalves,
                [&](std::uint32_t, std::uint32_t, std::span<const HalfEdge> halves) {
                    if (have || halves.size() != 2) return;
                    const std::uint32_t c = cornerOf(halves[0]), d = cornerOf(halves[1]);
                    if (corners[c] == corners[d]) return;  // both run in the same direction
                    const double a = facingOf(facts, directions, c / 3), b = facingOf(facts, directions, d / 3);
                    have = std::min(a, b) < kMinFacing && std::max(a, b) > -kMinFacing;
                });
    return have;
}

/// Returns whether no normal would point to the back after flipping triangles as `generate --fix-winding` does.
bool areTrianglesFlipped(const PrimitiveFacts& facts, const Directions& directions,
                         std::span<const std::uint32_t> against) {
    if (haveSoundNeighbors(facts, directions, against)) return false;
    std::vector<std::uint8_t> turned(facts.surface.faces.size());
    const WindingOptions how{.weld_distance = facts.options.weld_distance};
    if (!mendWinding(facts.mesh.triangles(), how, turned, facts.options.execution)) return false;
    for (std::size_t f = 0; f < turned.size(); ++f) {
        const double facing = facts.surface.faces[f].area == 0 ? 0 : facingOf(facts, directions, f);
        if ((turned[f] != 0 ? -facing : facing) < kMinFacing) return false;
    }
    return true;
}

/// Tangents may have been computed for the wrong winding; then their signs are wrong after triangles are flipped.
Remedy windingRemedy(bool has_tangents) {
    if (!has_tangents) return {"Reverse the winding of those triangles: {}.", {toCommand("generate --fix-winding")}};
    return {"Reverse the winding of those triangles: {}. Existing tangents are kept where they are right afterwards.",
            {toCommand("generate --fix-winding --repair")}};
}

void checkWinding(PrimitiveFacts& facts, const Directions& directions) {
    const TangentView& mesh = facts.mesh;
    Tally against;
    std::vector<std::uint32_t> faces_against;
    for (std::uint32_t f = 0; f < facts.surface.faces.size(); ++f) {
        const SurfaceFrame& face = facts.surface.faces[f];
        if (face.area == 0) continue;
        ++against.total;
        if (facingOf(facts, directions, f) >= kMinFacing) continue;
        against.add(mesh.corners[3 * f], face.area);
        faces_against.push_back(f);
    }
    against.finish(facts.surface.area);
    if (against.count == 0) return;
    // Double-sided leaves and grass often have the normals of the whole tree or ground on purpose.
    const double mostly = facts.primitive.is_double_sided ? kNearlyAll : kSurfaceMajority;
    const Severity severity = against.surface_share >= mostly         ? Severity::error
                              : against.surface_share >= kSomeNormals ? Severity::warning
                                                                      : Severity::note;
    facts.add(FindingCode::normalsAgainstWinding, severity, against, "triangles",
              {.symptom = "parts are lit from the wrong side",
               .cause = "the normals of " + countText(against, "triangles") + " point to the back (" +
                        shareText(against.surface_share) + " of the surface)"});
    if (areTrianglesFlipped(facts, directions, faces_against))
        setRemedy(facts.findings.back(), windingRemedy(!facts.primitive.tangents.empty()));
}

/// Reports normals that are far from the normals of all their triangles. They may be smoothed over hard edges, copied
/// from a simpler shape (such as a whole tree for its leaves), or belong to another shape. Some are intended, so the
/// finding is a note.
void checkFarNormals(PrimitiveFacts& facts, const Directions& directions) {
    const TangentView& mesh = facts.mesh;
    const EqualVertices equal = findEqualVertices(mesh, false);
    // Cosine to the nearest triangle normal, by class of equal normals.
    std::vector<double> nearest(equal.class_count, -1);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
        const SurfaceFrame& face = facts.surface.faces[c / 3];
        if (face.area == 0) continue;
        const std::uint32_t vertex = mesh.corners[c];
        double& cosine = nearest[equal.class_of[vertex]];
        cosine = std::max(cosine, dot(directions[vertex], toDouble(face.normal)));
    }
    Tally far;
    for (std::uint32_t v = 0; v < facts.used.size(); ++v) {
        if (!facts.used[v] || !isDirection(mesh.normals[v]) || facts.surface.vertex_areas[v] == 0) continue;
        ++far.total;
        // Normals that point to the back are reported by another finding.
        const double cosine = nearest[equal.class_of[v]];
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        // rounded to float, the precision of the face normals
        const auto angle = static_cast<float>(polarAngle(cosine, sine) * 180 / kPi);
        if (angle > kFarDeg && angle <= 90) far.add(v, facts.surface.vertex_areas[v], angle);
    }
    far.finish(facts.surface.area);
    if (far.surface_share < kSomeFar) return;
    facts.add(
        FindingCode::normalsFarFromFaces, Severity::note, far, "vertices",
        {.symptom = "the shading may look bent",
         .cause = "the normals of " + countText(far, "vertices") + " are more than " + decimalText(kFarDeg) +
                  " and up to " + decimalText(far.worst_deg) + " degrees from the normal of every adjacent triangle (" +
                  shareText(far.surface_share) + " of the surface)"});
}

}  // namespace

void checkPositions(PrimitiveFacts& facts) {
    Tally bad;
    for (std::uint32_t v = 0; v < facts.used.size(); ++v) {
        if (!facts.used[v]) continue;
        ++bad.total;
        if (!isFinite(facts.mesh.positions[v])) bad.add(v, 0);
    }
    if (bad.count == 0) return;
    facts.add(FindingCode::positionsNotFinite, Severity::error, bad, "vertices",
              {.symptom = "parts of the mesh are missing or distorted",
               .cause = "the positions of " + countText(bad, "vertices") + " are NaN or infinite"});
}

/// Reports random offsets of positions. Only positions are examined, because the stored normals may have been computed
/// without the noise.
void checkNoise(PrimitiveFacts& facts) {
    const double noise = reportableNoise(facts.mesh.triangles(), facts.mesh.position_step, facts.options.weld_distance);
    if (noise == 0) return;
    facts.add(FindingCode::positionsNoisy, Severity::note, Tally::all(facts.mesh.positions.size()), "vertices",
              {.symptom = "the shading may look noisy",
               .cause = "the positions deviate from a smooth surface by " + stepText(noise) +
                        " of an edge length (root mean square)"});
}

namespace {

/// Returns a remedy that names a command only if the command removes the finding and adds no other.
Remedy attributeRemedy(const ScenePrimitive& primitive, const SceneAttributeFault& fault) {
    const auto isNeeded = [&](const TangentUse& use) { return use.has_texture && fault.name == setName(use.uv_set); };
    const auto isFatal = [](const SceneAttributeFault& other) { return other.repair == AttributeRepair::none; };
    const std::vector<SceneAttributeFault>& faults = primitive.attribute_faults;
    if (fault.repair == AttributeRepair::none)
        return {"Export the mesh again: no command can repair this attribute, and commands skip this primitive."};
    if (std::any_of(faults.begin(), faults.end(), isFatal))
        return {"Export the mesh again: another attribute cannot be repaired, so commands skip this primitive."};
    const RemedyCommand repair = toCommand("generate --repair");
    if (fault.repair == AttributeRepair::resize) {
        const bool is_influence = fault.name.starts_with("JOINTS_") || fault.name.starts_with("WEIGHTS_");
        return {is_influence ? "Fill the missing influences with zeros: {}." : "Drop the surplus components: {}.",
                {repair}};
    }
    if (fault.target >= 0 && fault.name == "NORMAL" && !primitive.normals.empty())
        return {"Export the morph target again; or compute new normal deltas: {}.",
                {withOption(repair, "morph-normals", "missing")}};
    if (fault.target < 0 && fault.name == "NORMAL") {
        if (!canRecomputeNormals(primitive)) return {"Export the normals again."};
        return {"Export the normals again; or compute new ones: {}.", {toCommand("generate --overwrite-normals")}};
    }
    if (fault.target < 0 && std::any_of(primitive.uses.begin(), primitive.uses.end(), isNeeded))
        return {"Export the UVs again: tangents follow them."};
    return {"Export the attribute again; or remove it: {}.", {repair}};
}

}  // namespace

void reportAttributeFaults(PrimitiveFacts& facts) {
    for (const SceneAttributeFault& fault : facts.primitive.attribute_faults) {
        const std::string name = attributeText(fault.name, fault.target);
        const bool was_read = fault.target < 0 && fault.name == "NORMAL" && !facts.primitive.normals.empty();
        // Unsigned normals that have unit length are correct if no component should be negative.
        const bool may_be_right = was_read && facts.primitive.normal_scales == nullptr;
        facts.add(FindingCode::attributeUnreadable, may_be_right ? Severity::warning : Severity::error,
                  Tally::all(fault.vertex_count), "vertices",
                  was_read ? FindingText{.symptom = "the surface may be lit from wrong directions",
                                         .cause = "the elements of NORMAL " + fault.why}
                           : FindingText{.cause = "the elements of " + name + " cannot be read: " + fault.why});
        setRemedy(facts.findings.back(), attributeRemedy(facts.primitive, fault));
    }
    for (const SceneComponentFault& fault : facts.primitive.component_faults) {
        facts.add(FindingCode::attributeUnreadable, Severity::warning, Tally::all(fault.vertex_count), "vertices",
                  {.symptom = "some programs reject the file or read other values",
                   .cause = "the elements of " + fault.name + " are " + fault.found + ", but glTF allows only " +
                            fault.allowed + "; tspace uses them unchanged"});
        setRemedy(facts.findings.back(), {"Export the attribute again, as " + fault.allowed + "."});
    }
}

void checkNormals(PrimitiveFacts& facts) {
    if (facts.primitive.findFault("NORMAL") != nullptr) return;
    if (facts.mesh.normals.empty()) {
        facts.add(FindingCode::normalsMissing, Severity::note, Tally::all(facts.mesh.positions.size()), "vertices",
                  facts.is_gltf
                      ? FindingText{.symptom = "the surface looks faceted",
                                    .cause = "the primitive has no normals, so glTF readers shade it flat"}
                      : FindingText{.cause = "some or all faces have no normals, so tspace computes normals for them"});
        return;
    }
    const std::size_t first = facts.findings.size();
    checkNormalValues(facts);
    const Directions directions = directionsOf(facts.mesh.normals);
    checkWinding(facts, directions);
    checkFarNormals(facts, directions);
    if (!facts.primitive.is_unlit) return;
    for (Finding& finding : std::span(facts.findings).subspan(first)) {
        finding.severity = Severity::note;
        extendCause(finding, "; the material is unlit, so this is not visible");
    }
}

// Checks of the UVs that tangents follow.

namespace {

/// Area share above which UV-degenerate triangles are reported.
constexpr double kSomeUvs = 0.01;

bool isFinite(const Vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }

void checkUvsMissing(PrimitiveFacts& facts) {
    std::set<std::size_t> reported;
    for (const TangentUse& use : facts.primitive.uses) {
        if (!use.has_texture) continue;
        if (!plainReading(facts.primitive, use.uv_set).uvs.empty() || !reported.insert(use.uv_set).second) continue;
        if (facts.primitive.findFault(setName(use.uv_set)) != nullptr) continue;
        facts.add(FindingCode::uvsMissing, Severity::error, Tally::all(facts.mesh.positions.size()), "vertices",
                  facts.is_gltf
                      ? FindingText{.cause = use.needed_by + " uses " + setName(use.uv_set) + ", which does not exist"}
                      : FindingText{.symptom = "the relief cannot be shown",
                                    .cause = "the material has a normal map, but the faces have no texture "
                                             "coordinates"});
    }
}

void checkFinite(PrimitiveFacts& facts) {
    Tally bad;
    for (std::uint32_t v = 0; v < facts.mesh.uvs.size(); ++v) {
        ++bad.total;
        if (!isFinite(facts.mesh.uvs[v])) bad.add(v, facts.surface.vertex_areas[v]);
    }
    bad.finish(facts.surface.area);
    if (bad.count == 0) return;
    facts.add(FindingCode::uvsNotFinite, onShare(Severity::error, bad.surface_share, facts.options), bad, "vertices",
              {.symptom = "the texture looks black or garbled",
               .cause = setName(facts.reading.uv_set) + " is NaN or infinite at " + countText(bad, "vertices")});
}

void checkDegenerate(PrimitiveFacts& facts) {
    Tally degenerate;
    for (std::size_t f = 0; f < facts.surface.faces.size(); ++f) {
        const SurfaceFrame& face = facts.surface.faces[f];
        if (face.area == 0) continue;
        ++degenerate.total;
        if (face.orientation == 0) degenerate.add(facts.mesh.corners[3 * f], face.area);
    }
    degenerate.finish(facts.surface.area);
    if (degenerate.count == 0) return;
    const bool matters = !facts.primitive.uses.empty() && degenerate.surface_share >= kSomeUvs;
    facts.add(
        FindingCode::uvsDegenerate, matters ? Severity::warning : Severity::note, degenerate, "triangles",
        {.symptom = matters ? "the relief may be lit from an arbitrary direction" : "",
         .cause = countText(degenerate, "triangles") + " have no area in " + setName(facts.reading.uv_set) + " (" +
                  shareText(degenerate.surface_share) + " of the surface), so their tangent direction is undefined"});
}

}  // namespace

void checkUvs(PrimitiveFacts& facts) {
    checkUvsMissing(facts);
    // UVs that no tangents follow are irrelevant.
    if (facts.mesh.uvs.empty() || (facts.primitive.uses.empty() && facts.mesh.tangents.empty())) return;
    checkFinite(facts);
    checkDegenerate(facts);
}

// Checks whether several textures of one primitive need different tangents; a vertex can store only one.

namespace {

/// Returns the triangles on which two interpretations of the UVs give different frames.
Tally compareReadings(const PrimitiveFacts& facts, const UvReading& reading) {
    TangentView other = facts.mesh;
    other.uvs = reading.uvs;
    const Surface surface = describeSurface(other);
    Tally different;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const SurfaceFrame &a = facts.surface.faces[f], &b = surface.faces[f];
        if (a.orientation == 0 || b.orientation == 0) continue;
        ++different.total;
        const double angle = angleBetween(toDouble(a.tangent), toDouble(b.tangent)) * 180 / kPi;
        if (a.orientation != b.orientation || angle > facts.options.direction_deg)
            different.add(facts.mesh.corners[3 * f], a.area, angle);
    }
    different.finish(facts.surface.area);
    return different;
}

bool readsTheSame(const TangentUse& a, const TangentUse& b) {
    return a.uv_set == b.uv_set && a.transform.rotation == b.transform.rotation &&
           a.transform.scale[0] == b.transform.scale[0] && a.transform.scale[1] == b.transform.scale[1];
}

/// Returns the name of the texture, with its material if there are several (KHR_materials_variants).
std::string textureText(const TangentUse& use, bool with_material) {
    return with_material ? textureName(use) : use.needed_by;
}

}  // namespace

void checkTextures(PrimitiveFacts& facts) {
    const std::vector<TangentUse>& uses = facts.primitive.uses;
    if (facts.mesh.uvs.empty()) return;
    for (std::size_t i = 1; i < uses.size(); ++i) {
        bool known = false;
        for (std::size_t j = 0; j < i; ++j) known = known || readsTheSame(uses[j], uses[i]);
        const UvReading reading = readingOf(facts.primitive, uses[i]);
        if (known || reading.uvs.empty()) continue;
        const Tally different = compareReadings(facts, reading);
        if (different.count == 0) continue;
        const bool of_two = uses[i].material != uses[0].material;
        facts.add(
            FindingCode::texturesDisagree, Severity::warning, different, "triangles",
            {.cause = textureText(uses[i], of_two) + " needs different tangents than " + textureText(uses[0], of_two) +
                      " on " + countText(different, "triangles") +
                      ", so one of the two is lit incorrectly; a vertex has only one tangent, and tspace computes it "
                      "for " +
                      textureText(uses[0], of_two)});
        facts.findings.back().place = uses[i].place;
    }
}

// Checks one primitive: selects the UVs that its tangents should follow, and runs all checks.

void PrimitiveFacts::add(FindingCode code, Severity severity, const Tally& tally, const char* unit, FindingText text) {
    findings.push_back(makeFinding(code, severity, tally, unit, std::move(text)));
}

namespace {

std::vector<bool> usedVertices(const TangentView& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t vertex : mesh.corners) used[vertex] = true;
    return used;
}

/// Returns the share of the surface where UVs determine tangents and positions are precise enough for a comparison.
double comparedShare(const PrimitiveFacts& facts) {
    const double most = sineCosine(facts.options.direction_deg * kPi / 180).sine;
    double area = 0;
    for (const SurfaceFrame& face : facts.surface.faces) {
        if (face.orientation != 0 && face.tangent_error <= most) area += face.area;
    }
    return facts.surface.area > 0 ? area / facts.surface.area : 0;
}

/// Reports positions that are rounded so coarsely that the triangles' tangents, and perhaps their normals, are
/// unreliable.
void checkRounding(PrimitiveFacts& facts) {
    PositionRounding rounding = facts.surface.rounding;
    // Rounding before the conversion to floats affects only tangents. If nothing uses tangents, only other rounding is
    // reported.
    const bool has_readers = !facts.primitive.uses.empty() || !facts.primitive.tangents.empty();
    if (rounding.was_before && !has_readers) {
        const std::span<const std::uint32_t> corners = facts.mesh.corners;
        rounding = roundingOf(facts.mesh.positions, {}, {&corners, 1}, facts.mesh.position_step);
    }
    const RotatedTriangles turned =
        rotatedBy(rounding, facts.mesh.positions, facts.mesh.corners, facts.options.direction_deg);
    if (turned.share < kLeastRotatedShare) return;
    const Tally tally{.count = turned.count,
                      .total = turned.total,
                      .surface_share = turned.share,
                      .worst_deg = turned.worst_deg,
                      .vertices = {turned.first}};
    facts.add(FindingCode::positionsRounded, Severity::warning, tally, "triangles",
              {.cause = "tangents and normals are unreliable: positions up to " + stepText(rounding.far) +
                        " from the origin are rounded to steps of " + stepText(rounding.step) + ", which can rotate " +
                        countText(tally, "triangles") + " by " + decimalText(facts.options.direction_deg) +
                        " degrees or more (at most " + decimalText(turned.worst_deg) + " degrees; " +
                        shareText(turned.share) + " of the surface); tangents there are not reported as errors"});
    if (rounding.was_before) {
        setRemedy(facts.findings.back(),
                  "Use the model from before its positions were rounded, or round them to smaller steps, and keep the "
                  "original tangents and normals.");
    }
}

}  // namespace

PrimitiveVerdict judgePrimitive(const ScenePrimitive& primitive, const CheckOptions& options, bool is_gltf,
                                std::span<const ScenePrimitive> scene) {
    PrimitiveFacts facts{.primitive = primitive, .options = options, .is_gltf = is_gltf};
    facts.all = scene;
    reportAttributeFaults(facts);
    if (primitive.corners.empty()) {
        // In glTF, points and lines are shaded with their tangents if the material has a normal map.
        const bool has_positions = primitive.findFault("POSITION") == nullptr;
        if (has_positions && !primitive.tangents.empty() && primitive.uses.empty()) {
            facts.add(
                FindingCode::tangentsUnused, Severity::note, Tally::all(1), "primitives",
                {.cause = "the primitive has tangents, but draws " + primitive.mode + ", and no material needs them"});
        }
        return PrimitiveVerdict{.findings = std::move(facts.findings)};
    }
    facts.reading = primitive.uses.empty() ? plainReading(primitive, 0) : readingOf(primitive, primitive.uses.front());
    facts.mesh = {.positions = primitive.positions.span(),
                  .normals = primitive.normals.span(),
                  .tangents = primitive.tangents.span(),
                  .uvs = primitive.mayHaveAuthoredTangents() ? std::span<const Vec2>{} : facts.reading.uvs,
                  .corners = primitive.corners.span(),
                  .position_step = primitive.position_step};
    facts.surface = describeSurface(facts.mesh);
    facts.used = usedVertices(facts.mesh);
    checkPositions(facts);
    checkRounding(facts);
    checkNormals(facts);
    checkNoise(facts);
    checkMorphValues(facts);
    // Targets with an array that cannot be read are skipped, because another finding reports them.
    const bool are_targets_read = std::none_of(primitive.attribute_faults.begin(), primitive.attribute_faults.end(),
                                               [](const SceneAttributeFault& fault) { return fault.target >= 0; });
    if (are_targets_read) checkMorphNormals(facts);
    checkUvs(facts);
    checkTextures(facts);
    checkTangents(facts);
    if (are_targets_read) checkMorphTargets(facts);
    const double compared = facts.examined_values ? comparedShare(facts) : 0;
    return PrimitiveVerdict{std::move(facts.findings), std::move(facts.faults), facts.wrong_sign_share, compared};
}

}  // namespace tspace
