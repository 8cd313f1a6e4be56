// SPDX-License-Identifier: MIT
#include "commands/pages/picture_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>
#include <optional>

#include "commands/pages/page_parts.h"
#include "commands/pages/place_pictures.h"
#include "commands/shared/picture/colors.h"
#include "core/base/vec_math.h"
#include "maps/rays/map_surfaces.h"

namespace tspace {
namespace {

constexpr PictureSize kTrial{80, 60, 1}, kWhole{kPlaceWidth, kPlaceHeight, 2};
/// Minimum visible difference of a color channel, on a scale of 0 to 255.
constexpr int kSeenStep = 12;

/// One side of a comparison: all meshes of its model, or only the primitive.
struct Side {
    const ModelPicture& model;
    std::size_t number = 0;  ///< index of the mesh that draws the primitive

    [[nodiscard]] RgbImage draw(RenderShow show, const PlaceView& view, const PictureSize& size, const DVec3& to_light,
                                std::span<const ShownSurface* const> surfaces) const {
        return drawView(show, model.meshes(), surfaces, number, view, size, to_light);
    }
};

/// Surfaces without base colors. Surfaces with holes keep their base color, whose alpha defines the holes.
class Clay {
  public:
    explicit Clay(std::span<const ShownSurface* const> surfaces) {
        for (const ShownSurface* surface : surfaces) {
            ShownSurface& clay = surfaces_.emplace_back(*surface);
            if (clay.alpha_cutoff == 0) {
                clay.base = {};
                clay.base_color = {0.75f, 0.75f, 0.75f, 1};
                clay.colors = {};
            }
            pointers_.push_back(&clay);
        }
    }
    [[nodiscard]] std::span<const ShownSurface* const> surfaces() const { return pointers_; }

  private:
    std::deque<ShownSurface> surfaces_ = {};
    std::vector<const ShownSurface*> pointers_ = {};
};

DVec3 ringLight(const Camera& camera, int number) {
    // Lights on two rings around the viewing direction: grazing lights show relief, steeper ones whole faces.
    constexpr int kPerRing = 8;
    const SineCosine around = sineCosine(2 * kPi * (number % kPerRing) / kPerRing);
    const double back = number < kPerRing ? 0.35 : 1.1;
    DVec3 light = around.cosine * camera.right() + around.sine * camera.up() + back * camera.back();
    normalize(light);
    return light;
}
constexpr int kLights = 16;

/// Returns the normal that a pixel of RenderShow::mapped encodes.
DVec3 pixelNormal(const RgbImage& image, std::size_t pixel) {
    const auto component = [&](std::size_t c) { return image.rgb[3 * pixel + c] / 127.5 - 1; };
    return {component(0), component(1), component(2)};
}

/// Returns for each pixel whether one of the sides shows the primitive there. Other primitives may differ too, because
/// of other faults.
std::vector<bool> pixelsOfPrimitive(const Side& before, const Side& after, const PlaceView& view,
                                    const PictureSize& size) {
    const std::size_t count = std::size_t{size.width} * size.height;
    if (view.is_alone) return std::vector<bool>(count, true);
    std::vector<bool> shown(count, false);
    for (const Side* side : {&before, &after}) {
        WorkLimit work_limit(std::uint64_t{1} << 30);
        const VisibleTriangles visible(side->model.meshes(), view.camera(size), size.width * size.samples,
                                       size.height * size.samples, work_limit);
        // A primitive that several nodes draw has one surface.
        const std::span<const ShownSurface* const> surfaces = side->model.surfaces();
        for (std::uint32_t y = 0; y < size.height * size.samples; ++y) {
            const std::span<const std::uint32_t> row = visible.row(y);
            for (std::size_t x = 0; x < row.size(); ++x) {
                if (row[x] == VisibleTriangles::kNone) continue;
                if (surfaces[visible.placeOf(row[x]).mesh] == surfaces[side->number])
                    shown[std::size_t{y / size.samples} * size.width + x / size.samples] = true;
            }
        }
    }
    return shown;
}

/// A camera and a light, and the mean difference of the two pictures, from 0 to 1. Pixels that show no surface after
/// the fix are not counted: a surface whose winding was fixed is not drawn from behind.
struct Trial {
    PlaceView view = {};
    DVec3 to_light = {};
    double difference = 0;
    double framed_difference = 0;  ///< mean difference of the pixels around the location
    std::size_t pixel = 0;         ///< pixel of the largest difference, see densestPixel
};

class PairSearch {
  public:
    PairSearch(const Side& before, const Side& after) : before_(before), after_(after) {}

    Trial tryView(const PlaceView& view) const {
        const RgbImage a = before_.draw(RenderShow::mapped, view, kTrial, {0, 0, 1}, before_.model.surfaces()),
                       b = after_.draw(RenderShow::mapped, view, kTrial, {0, 0, 1}, after_.model.surfaces());
        const Camera camera = view.camera(kTrial);
        const std::vector<bool> shown = pixelsOfPrimitive(before_, after_, view, kTrial);
        const std::size_t pixels = shown.size();
        const std::array<std::uint8_t, 3> background{roundedChannel(kBackground.x), roundedChannel(kBackground.y),
                                                     roundedChannel(kBackground.z)};
        Trial best{.view = view, .to_light = ringLight(camera, 0)};
        for (int i = 0; i < kLights; ++i) {
            const DVec3 light = ringLight(camera, i);
            std::vector<double> differences(pixels, 0.0);
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                if (!shown[pixel] || std::equal(&a.rgb[3 * pixel], &a.rgb[3 * pixel] + 3, &b.rgb[3 * pixel])) continue;
                if (std::equal(background.begin(), background.end(), &b.rgb[3 * pixel])) continue;
                differences[pixel] = std::fabs(std::max(0.0, dot(pixelNormal(a, pixel), light)) -
                                               std::max(0.0, dot(pixelNormal(b, pixel), light)));
            }
            const double mean =
                std::accumulate(differences.begin(), differences.end(), 0.0) / static_cast<double>(pixels);
            if (!(mean > best.difference)) continue;
            best.to_light = light;
            best.difference = mean;
            best.framed_difference = framedDifference(differences, camera, view.points);
            best.pixel = densestPixel(differences);
        }
        return best;
    }

    /// Returns the triangles around the largest difference of a view that shows only the primitive.
    [[nodiscard]] std::vector<std::size_t> trianglesAt(const Trial& trial) const {
        WorkLimit work_limit(std::uint64_t{1} << 30);
        const std::span<const DrawnMesh> meshes = before_.model.meshes().subspan(before_.number, 1);
        const VisibleTriangles visible(meshes, trial.view.camera(kTrial), kTrial.width, kTrial.height, work_limit);
        const std::uint32_t seen =
            visible.row(static_cast<std::uint32_t>(trial.pixel / kTrial.width))[trial.pixel % kTrial.width];
        if (seen == VisibleTriangles::kNone) return {};
        return trianglesNear(meshes[0], visible.placeOf(seen).triangle);
    }

  private:
    /// Returns the mean of the pixels around a location.
    static double framedDifference(std::span<const double> differences, const Camera& camera,
                                   const PlacePoints& place) {
        const std::optional<PictureBox> box = boxAround(camera, place, kTrial.samples);
        if (!box) return 0;
        constexpr double kBeside = 1;
        double sum = 0;
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < kTrial.height; ++y) {
            for (std::uint32_t x = 0; x < kTrial.width; ++x) {
                if (x + 1 < box->left - kBeside || x > box->right + kBeside) continue;
                if (y + 1 < box->top - kBeside || y > box->bottom + kBeside) continue;
                sum += differences[std::size_t{y} * kTrial.width + x];
                ++count;
            }
        }
        return count == 0 ? 0 : sum / static_cast<double>(count);
    }

    /// Finds the block of pixels with the largest sum, and returns the pixel with the largest difference in it.
    static std::size_t densestPixel(std::span<const double> differences) {
        constexpr std::uint32_t kBlock = 10;
        double most = -1;
        std::size_t pixel = 0;
        for (std::uint32_t top = 0; top + kBlock <= kTrial.height; top += kBlock / 2) {
            for (std::uint32_t left = 0; left + kBlock <= kTrial.width; left += kBlock / 2) {
                double sum = 0, largest = -1;
                std::size_t at = 0;
                for (std::uint32_t i = 0; i < kBlock * kBlock; ++i) {
                    const std::size_t one = std::size_t{top + i / kBlock} * kTrial.width + left + i % kBlock;
                    sum += differences[one];
                    if (differences[one] > largest) {
                        largest = differences[one];
                        at = one;
                    }
                }
                if (!(sum > most)) continue;
                most = sum;
                pixel = at;
            }
        }
        return pixel;
    }

    /// Returns the triangles whose centers are near that of `triangle`: within a seventh of the bounding-box diagonal.
    static std::vector<std::size_t> trianglesNear(const DrawnMesh& mesh, std::size_t triangle) {
        const auto center = [&](std::size_t i) {
            DVec3 sum;
            for (std::size_t k = 0; k < 3; ++k) sum = sum + toDouble(mesh.positions[mesh.corners[3 * i + k]]);
            return mesh.to_world.point((1.0 / 3) * sum);
        };
        std::vector<DVec3> centers(mesh.corners.size() / 3);
        PositionBox box;
        for (std::size_t i = 0; i < centers.size(); ++i) box.add(centers[i] = center(i));
        const DVec3 size = box.most - box.least;
        const double radius_squared = dot(size, size) / (7.0 * 7.0);
        std::vector<std::size_t> near;
        for (std::size_t i = 0; i < centers.size(); ++i) {
            const DVec3 way = centers[i] - centers[triangle];
            if (i == triangle || dot(way, way) <= radius_squared) near.push_back(i);
        }
        return near;
    }

    const Side& before_;
    const Side& after_;
};

/// Returns the camera and light with the largest difference.
Trial bestTrial(const Side& before, const Side& after, std::span<const std::size_t> triangles) {
    constexpr ViewAngles kSides[] = {{35, 20}, {215, 20}, {125, 20}, {-55, 20}, {35, 70}, {35, -70}};
    const PairSearch search(before, after);
    const DrawnMesh& mesh = before.model.meshes()[before.number];
    Trial place;
    if (!triangles.empty()) {
        PlaceView view = viewOver(before.model.meshes(), before.number, triangles);
        place = search.tryView(view);
        if (!(place.difference > 0)) {  // the triangles face away from the camera, so the other side is tried
            view.angles = {view.angles.yaw_deg + 180, -view.angles.pitch_deg};
            place = search.tryView(view);
        }
    }
    std::vector<std::size_t> all(mesh.corners.size() / 3);
    std::iota(all.begin(), all.end(), std::size_t{0});
    const PlacePoints whole(mesh, all);
    Trial best;
    for (const ViewAngles& angles : kSides) {
        const Trial trial = search.tryView({.points = whole, .angles = angles, .is_alone = true});
        if (trial.difference > best.difference) best = trial;
    }
    const double whole_difference = best.difference;
    if (whole_difference > 0) {
        const std::vector<std::size_t> near = search.trianglesAt(best);
        if (!near.empty()) {
            const Trial trial = search.tryView(
                {.points = PlacePoints(mesh, near), .angles = best.view.angles, .around = 1.2, .is_alone = true});
            if (trial.difference > best.difference) best = trial;
        }
    }
    // A frame around a location where nothing differs would mislead.
    constexpr double kMinFramed = 0.5;
    place.view.is_place = place.framed_difference >= kMinFramed * place.difference;
    // A fault that is clearly visible on the whole surface is shown there, because the model is recognizable.
    constexpr double kPlainDifference = 0.08;
    const bool is_plain = whole_difference > kPlainDifference;
    return place.difference > 0 && !is_plain && 2 * place.difference >= best.difference ? place : best;
}

int largestDifference(const RgbImage& a, const RgbImage& b, std::size_t pixel) {
    int most = 0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) most = std::max(most, std::abs(a.rgb[c] - b.rgb[c]));
    return most;
}

/// Returns the difference in perceived brightness, in thousandths of a byte step; blue contributes least.
std::uint64_t brightnessDifference(const RgbImage& a, const RgbImage& b, std::size_t pixel) {
    constexpr int kWeights[] = {213, 715, 72};
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += kWeights[c] * (a.rgb[3 * pixel + c] - b.rgb[3 * pixel + c]);
    return static_cast<std::uint64_t>(std::abs(sum));
}

struct Compared {
    RgbImage before = {}, after = {};
    std::vector<int> difference =
        {};                 ///< largest difference of any channel of each pixel of the primitive, otherwise 0
    std::uint64_t sum = 0;  ///< sum of brightness differences
    std::size_t seen_count = 0;
    int most = 0;
};

/// Draws both sides, and compares the pixels for which `shown` is true.
Compared comparedSides(const Side& before, const Side& after, const Trial& trial, const std::vector<bool>& shown,
                       bool is_clay) {
    const auto drawn = [&](const Side& side) {
        if (!is_clay) return side.draw(RenderShow::lit, trial.view, kWhole, trial.to_light, side.model.surfaces());
        const Clay clay(side.model.surfaces());
        return side.draw(RenderShow::lit, trial.view, kWhole, trial.to_light, clay.surfaces());
    };
    Compared result{.before = drawn(before), .after = drawn(after)};
    result.difference.resize(shown.size());
    for (std::size_t pixel = 0; pixel < shown.size(); ++pixel) {
        if (!shown[pixel]) continue;
        const int difference = largestDifference(result.before, result.after, pixel);
        result.difference[pixel] = difference;
        result.sum += brightnessDifference(result.before, result.after, pixel);
        result.seen_count += difference >= kSeenStep;
        result.most = std::max(result.most, difference);
    }
    return result;
}

std::optional<Side> sideOf(const PicturedPrimitive& pictured) {
    const std::optional<std::size_t> number = meshOf(pictured.model, pictured.primitive);
    if (!number) return {};
    return Side{pictured.model, *number};
}

}  // namespace

PicturePair drawPair(const PicturedPrimitive& before, std::span<const std::size_t> triangles,
                     const PicturedPrimitive& after) {
    constexpr double kMinShare = 0.002;
    // The base color counts as hiding the difference if the difference with base color is below this fraction of the
    // difference without it.
    constexpr double kHidden = 0.7;
    PicturePair pair;
    const std::optional<Side> a = sideOf(before), b = sideOf(after);
    if (!a || !b) return pair;
    std::vector<std::size_t> held(triangles.begin(), triangles.end());
    std::sort(held.begin(), held.end());
    const Trial trial = bestTrial(*a, *b, held);
    if (!(trial.difference > 0)) return pair;
    const std::vector<bool> pixels = pixelsOfPrimitive(*a, *b, trial.view, kWhole);
    Compared shown = comparedSides(*a, *b, trial, pixels, false), clay = comparedSides(*a, *b, trial, pixels, true);
    pair.is_clay = static_cast<double>(shown.sum) < kHidden * static_cast<double>(clay.sum);
    if (pair.is_clay) shown = std::move(clay);
    pair.differing_share = static_cast<double>(shown.seen_count) /
                           (static_cast<double>(kWhole.width) * static_cast<double>(kWhole.height));
    if (pair.differing_share < kMinShare) return pair;
    while (pair.gain < 8 && 2 * static_cast<int>(pair.gain) * shown.most <= 255) pair.gain *= 2;
    RgbImage difference{.width = kWhole.width, .height = kWhole.height};
    difference.rgb.resize(shown.before.rgb.size());
    for (std::size_t pixel = 0; 3 * pixel < difference.rgb.size(); ++pixel) {
        const int value = static_cast<int>(pair.gain) * shown.difference[pixel];
        std::fill_n(&difference.rgb[3 * pixel], 3, static_cast<std::uint8_t>(value));
    }
    if (trial.view.is_place) {
        const Camera camera = trial.view.camera(kWhole);
        for (RgbImage* image : {&shown.before, &shown.after, &difference})
            drawFrame(*image, camera, PlacePoints(a->model.meshes()[a->number], held));
    }
    pair.before = encodePicture(shown.before);
    pair.after = encodePicture(shown.after);
    pair.difference = encodePicture(difference);
    return pair;
}

}  // namespace tspace
