// SPDX-License-Identifier: MIT
// Errors of formats and mip levels of normal maps, as tables (scripts/maps --textures).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <random>
#include <string_view>

#ifdef TSPACE_HAS_SQUISH
#include <squish.h>
#endif

#include "compressed_cases.h"
#include "images/float_image.h"
#include "images/textures/texel_format.h"
#include "textures/blocks/filtered_error.h"
#include "textures/blocks/fit_blocks.h"
#include "textures/write_texture.h"

namespace tspace::bench {
namespace {

constexpr std::uint32_t kSeed = 11;  ///< seed of the maps for the tables in docs/guides/compress-map.md
constexpr double kDegrees = 57.29577951308232;

/// Compresses a map and returns x and y of the decoded texels.
using Pack = std::function<std::vector<Vec3>(const NormalLevel&, Parallel&)>;

struct Row {
    const char* name;
    Pack pack;
};

Pack blocks(TextureFormat format, TextureQuality quality, bool is_signed = false) {
    return [=](const NormalLevel& level, Parallel& parallel) {
        std::vector<Vec3> texels;
        for (const Vec2& texel : fitBlocks(level, {format, is_signed, quality}, parallel).texels)
            texels.push_back({texel.x, texel.y, 0});
        return texels;
    };
}

std::vector<Vec3> rounded(const NormalLevel& level, Parallel&) {
    std::vector<Vec3> texels;
    const auto of = [](float part) { return std::floor((part + 1) * 127.5F + 0.5F) / 127.5F - 1; };
    for (const Vec3& normal : level.normals) texels.push_back({of(normal.x), of(normal.y), 0});
    return texels;
}

std::vector<Vec3> exact(const NormalLevel& level, Parallel&) { return level.normals; }

/// Packs BC5 blocks by search: tries all pairs of end points near the extremes and both kinds of palettes, and
/// minimizes the squared error of each channel.
std::vector<Vec3> leastSquares(const NormalLevel& level, Parallel& parallel) {
    std::vector<Vec3> texels(level.normals.size());
    const std::size_t across = level.width / 4;
    const auto packChannel = [&](std::size_t block, float Vec3::*channel) {
        std::array<float, 16> values{}, best{};
        const auto placeOf = [&](std::size_t k) {
            return (block / across * 4 + k / 4) * level.width + block % across * 4 + k % 4;
        };
        for (std::size_t k = 0; k < 16; ++k) values[k] = 127.5F * (level.normals[placeOf(k)].*channel + 1);
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const float aside = 4 + 0.15F * (*high - *low);
        float least = 1e30F;
        for (int a = std::max(0, static_cast<int>(*low - aside)); a <= static_cast<int>(*low + aside); ++a) {
            const int last = std::min(255, static_cast<int>(*high + aside));
            for (int b = std::max(a, static_cast<int>(*high - aside)); b <= last; ++b) {
                for (const float parts : {5.0F, 7.0F}) {
                    const auto first = static_cast<float>(a), step = static_cast<float>(b - a) / parts;
                    const float scale = step > 0 ? 1 / step : 0;
                    std::array<float, 16> chosen{};
                    float sum = 0;
                    for (std::size_t k = 0; k < 16; ++k) {
                        const float place = std::clamp((values[k] - first) * scale, 0.0F, parts);
                        chosen[k] = first + step * static_cast<float>(static_cast<int>(place + 0.5F));
                        sum += (chosen[k] - values[k]) * (chosen[k] - values[k]);
                    }
                    if (sum >= least) continue;
                    least = sum;
                    best = chosen;
                }
            }
        }
        for (std::size_t k = 0; k < 16; ++k) texels[placeOf(k)].*channel = best[k] / 127.5F - 1;
    };
    parallel.forRanges(level.normals.size() / 16, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block) {
            packChannel(block, &Vec3::x);
            packChannel(block, &Vec3::y);
        }
    });
    return texels;
}

#ifdef TSPACE_HAS_SQUISH
/// Packs BC5 blocks from texels with 8 bits per channel, as the library squish requires.
std::vector<Vec3> bySquish(const NormalLevel& level, Parallel&) {
    std::vector<Vec3> texels(level.normals.size());
    const TexelFormat format = texelFormat(TexelKind::bc5);
    const std::size_t across = level.width / 4;
    for (std::size_t block = 0; block < level.normals.size() / 16; ++block) {
        std::array<std::uint8_t, 64> pixels{};
        std::array<std::uint8_t, 16> packed{};
        std::array<Rgba, 16> decoded{};
        const auto placeOf = [&](std::size_t k) {
            return (block / across * 4 + k / 4) * level.width + block % across * 4 + k % 4;
        };
        for (std::size_t k = 0; k < 16; ++k) {
            const Vec3& normal = level.normals[placeOf(k)];
            const std::array<float, 4> parts{normal.x, normal.y, normal.z, 1};
            for (std::size_t i = 0; i < 4; ++i)
                pixels[4 * k + i] = static_cast<std::uint8_t>((parts[i] + 1) * 127.5F + 0.5F);
        }
        squish::Compress(pixels.data(), packed.data(), squish::kBc5);
        format.decode(format, packed.data(), decoded.data());
        for (std::size_t k = 0; k < 16; ++k) texels[placeOf(k)] = {2 * decoded[k][0] - 1, 2 * decoded[k][1] - 1, 0};
    }
    return texels;
}
#endif

/// Compresses with the library astcenc. `fits`: first optimizes x and y for filtering; otherwise they are compressed
/// unchanged.
Pack astc(TextureQuality quality, bool fits) {
    return [=](const NormalLevel& level, Parallel& parallel) {
        std::vector<Vec2> wanted;
        if (fits) {
            wanted = fitTexels(level, parallel);
        } else {
            for (const Vec3& normal : level.normals) wanted.push_back({normal.x, normal.y});
        }
        std::vector<Vec3> texels;
        if (!packAstc(level.width, level.height, quality, wanted, parallel)) std::exit(1);
        for (const Vec2& texel : wanted) texels.push_back({texel.x, texel.y, 0});
        return texels;
    };
}

void printFormats(const std::vector<CompressedCase>& cases, Parallel& parallel) {
    std::vector<Row> rows = {
        {"R16G16", exact},
        {"RG8", rounded},
#ifdef TSPACE_HAS_SQUISH
        {"BC5, libsquish", bySquish},
#endif
        {"BC5, least squares of all ends", leastSquares},
        {"BC5 quick", blocks(TextureFormat::bc5, TextureQuality::quick)},
        {"BC5 fast", blocks(TextureFormat::bc5, TextureQuality::fast)},
        {"BC5 best", blocks(TextureFormat::bc5, TextureQuality::best)},
        {"BC5 fast, signed", blocks(TextureFormat::bc5, TextureQuality::fast, true)},
        {"EAC RG11 quick", blocks(TextureFormat::eacRg11, TextureQuality::quick)},
        {"EAC RG11 fast", blocks(TextureFormat::eacRg11, TextureQuality::fast)},
        {"EAC RG11 best", blocks(TextureFormat::eacRg11, TextureQuality::best)},
    };
    if (whyNoAstcWritten() == nullptr) {
        rows.push_back({"ASTC 4x4, astcenc (medium) alone", astc(TextureQuality::fast, false)});
        rows.push_back({"ASTC 4x4 quick", astc(TextureQuality::quick, true)});
        rows.push_back({"ASTC 4x4 fast", astc(TextureQuality::fast, true)});
        rows.push_back({"ASTC 4x4 best", astc(TextureQuality::best, true)});
    }
    std::printf("Degrees, filtered, mean / p99; microseconds a texel of one thread (processor).\n\n| |");
    for (const CompressedCase& one : cases) std::printf(" %s |", one.name.c_str());
    std::printf(" time |\n|---|");
    for (std::size_t i = 0; i <= cases.size(); ++i) std::printf("---|");
    std::printf("\n");
    for (const Row& row : rows) {
        std::printf("| %s |", row.name);
        double seconds = 0, texel_count = 0;
        for (const CompressedCase& one : cases) {
            const std::clock_t start = std::clock();
            const std::vector<Vec3> texels = row.pack(one.level, parallel);
            seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
            texel_count += static_cast<double>(texels.size());
            const FilteredError error = measureFiltered(one.level, texels, true, parallel);
            std::printf(" %.3f / %.2f |", error.mean_deg, error.p99_deg);
        }
        std::printf(" %.2f |\n", 1e6 * seconds / texel_count);
    }
}

/// Writes the maps as PNGs with 8 and 16 bits, for other programs: NAME.8.png, NAME.16.png.
bool writeMaps(const std::vector<CompressedCase>& cases, const std::string& folder) {
    for (const CompressedCase& one : cases) {
        FloatImage image{one.level.width, one.level.height, 16, {}, {}};
        for (const Vec3& normal : one.level.normals)
            image.texels.push_back({0.5F + 0.5F * normal.x, 0.5F + 0.5F * normal.y, 0.5F + 0.5F * normal.z});
        for (const unsigned bits : {8U, 16U}) {
            const auto png = encodePng(image, bits);
            std::ofstream file(folder + "/" + one.name + "." + std::to_string(bits) + ".png", std::ios::binary);
            if (!png ||
                !file.write(reinterpret_cast<const char*>(png->data()), static_cast<std::streamsize>(png->size())))
                return false;
        }
    }
    return true;
}

// Mip levels: a texel is shaded by one normal and one roughness, instead of by all normals that it covers.

/// Returns the GGX reflection with height-correlated Smith shadowing, as in glTF, without Fresnel, times the cosine.
double shaded(const DVec3& normal, double alpha, const DVec3& view, const DVec3& light) {
    const double nv = dot(normal, view), nl = dot(normal, light);
    if (nv <= 0 || nl <= 0) return 0;
    DVec3 half = view + light;
    normalize(half);
    const double nh = dot(normal, half), a2 = alpha * alpha, below = nh * nh * (a2 - 1) + 1;
    const double smith = nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2);
    return a2 / (3.141592653589793 * below * below) * 0.5 / smith * nl;
}

class LevelShading {
  public:
    /// `normals`: the normals covered by the texel.
    LevelShading(std::vector<DVec3> normals, const DVec3& mean, double spread, double roughness, std::uint32_t seed)
        : normals_(std::move(normals)), mean_(mean), alpha_(roughness * roughness), engine_(seed) {
        wide_ = std::min(1.0, std::sqrt(alpha_ * alpha_ + spread));
    }

    /// Returns the relative RMS errors of the shading, integrated over lights: with the original roughness, and with
    /// the widened one.
    std::array<double, 2> errors() {
        constexpr int kViews = 6, kLights = 66;
        std::array<double, 2> off{};
        double all = 0;
        for (int view = 0; view < kViews; ++view) {
            const DVec3 from = direction(0.35 + 0.65 * random());
            for (int light = 0; light < kLights; ++light) {
                const double alphas[] = {alpha_, wide_, 0.5};
                const DVec3 half = halfVector(light % 2 == 0 ? mean_ : normals_[pick()], alphas[light / 2 % 3]);
                const DVec3 to = 2 * dot(from, half) * half - from;
                const double density = densityOf(half, alphas) / (4 * std::max(1e-6, dot(from, half)));
                if (to.z <= 0 || dot(from, half) <= 0 || !(density > 0)) continue;
                double truth = 0;
                for (const DVec3& normal : normals_) truth += shaded(normal, alpha_, from, to);
                truth /= static_cast<double>(normals_.size());
                const double as_was = shaded(mean_, alpha_, from, to) - truth,
                             widened = shaded(mean_, wide_, from, to) - truth;
                off[0] += as_was * as_was / density;
                off[1] += widened * widened / density;
                all += truth * truth / density;
            }
        }
        return {std::sqrt(off[0] / all), std::sqrt(off[1] / all)};
    }

    /// Returns, for both roughnesses, the absolute value of the logarithm of the ratio of two angles: the angle that
    /// contains half of the energy of the lobe of half vectors, according to the roughness, and the true one.
    std::array<double, 2> widths() {
        constexpr std::size_t kSamples = 2001;
        std::vector<double> angles;
        for (std::size_t i = 0; i < kSamples; ++i)
            angles.push_back(std::acos(std::clamp(dot(halfVector(normals_[pick()], alpha_), mean_), -1.0, 1.0)));
        std::nth_element(angles.begin(), angles.begin() + kSamples / 2, angles.end());
        const double truth = angles[kSamples / 2];
        return {std::fabs(std::log(std::atan(alpha_) / truth)), std::fabs(std::log(std::atan(wide_) / truth))};
    }

  private:
    double random() { return static_cast<double>(engine_()) / 4294967296.0; }
    std::size_t pick() { return engine_() % normals_.size(); }
    DVec3 direction(double z) {
        const double around = 6.283185307179586 * random(), across = std::sqrt(1 - z * z);
        return {across * std::cos(around), across * std::sin(around), z};
    }
    DVec3 halfVector(const DVec3& normal, double alpha) {
        const double u = random(), z = 1 / std::sqrt(1 + alpha * alpha * u / (1 - u));
        const DVec3 local = direction(z);
        DVec3 right = std::fabs(normal.x) < 0.9 ? DVec3{1, 0, 0} : DVec3{0, 1, 0};
        right = right - dot(right, normal) * normal;
        normalize(right);
        return local.x * right + local.y * cross(normal, right) + local.z * normal;
    }
    [[nodiscard]] double densityOf(const DVec3& half, const double (&alphas)[3]) const {
        const auto around = [&](const DVec3& normal) {
            const double nh = dot(normal, half);
            double sum = 0;
            for (const double alpha : alphas) {
                const double a2 = alpha * alpha, below = nh * nh * (a2 - 1) + 1;
                if (nh > 0) sum += a2 / (3.141592653589793 * below * below) * nh;
            }
            return sum / 3;
        };
        double sum = 0;
        for (const DVec3& normal : normals_) sum += around(normal);
        return 0.5 * around(mean_) + 0.5 * sum / static_cast<double>(normals_.size());
    }

    std::vector<DVec3> normals_;
    DVec3 mean_;
    double alpha_, wide_ = 0;
    std::mt19937 engine_;
};

/// Returns the unit vector that a renderer samples at a position. x, y: in texels; integers are corners of texels.
DVec3 filteredAt(const NormalLevel& level, double x, double y) {
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), right = x - 0.5 - left, down = y - 0.5 - top;
    const auto at = [&](double column, double row) {
        const auto wrap = [](double place, std::uint32_t size) {
            return static_cast<std::size_t>(place + size) % size;
        };
        return toDouble(level.normals[wrap(row, level.height) * level.width + wrap(column, level.width)]);
    };
    DVec3 sum = (1 - down) * ((1 - right) * at(left, top) + right * at(left + 1, top)) +
                down * ((1 - right) * at(left, top + 1) + right * at(left + 1, top + 1));
    normalize(sum);
    return sum;
}

void printLevels(const std::vector<CompressedCase>& cases, std::uint32_t seed, Parallel& parallel) {
    constexpr std::size_t kTexels = 24, kMostNormals = 256;
    std::printf(
        "\nLevels 1 to 5, geometric means over maps and levels: the error of what is shaded with the roughness "
        "widened, in "
        "parts of that with the roughness as it was; and the error of the lobe's width, |ln|, of both.\n\n"
        "| roughness | error | width as it was | width, widened |\n|---|---|---|---|\n");
    std::mt19937 engine(seed);
    for (const double roughness : {0.1, 0.3, 0.6}) {
        double ratio = 0, count = 0;
        std::array<double, 2> widths{};
        for (const CompressedCase& one : cases) {
            const std::vector<NormalLevel> levels = makeNormalLevels(one.level, parallel, true);
            for (std::size_t k = 1; k <= 5; ++k) {
                const NormalLevel& level = levels[k];
                std::array<double, 2> off{}, wide{};
                for (std::size_t i = 0; i < kTexels; ++i) {
                    const std::size_t texel = engine() % level.normals.size();
                    const std::size_t x = texel % level.width << k, y = texel / level.width << k;
                    std::vector<DVec3> normals;
                    // Between texels, a renderer samples filtered values, so small footprints are sampled more finely
                    // than once per texel.
                    const std::size_t points = k <= 2 ? 4 : k == 3 ? 2 : 1;
                    const std::size_t side = points << k, all = side * side,
                                      step = std::max<std::size_t>(1, all / kMostNormals);
                    for (std::size_t j = 0; j < all; j += step) {
                        const std::size_t n = step == 1 ? j : j + engine() % step;
                        const auto part = [&](std::size_t of) {
                            return (static_cast<double>(of) + 0.5) / static_cast<double>(points);
                        };
                        normals.push_back(filteredAt(one.level, static_cast<double>(x) + part(n % side),
                                                     static_cast<double>(y) + part(n / side)));
                    }
                    LevelShading shading(std::move(normals), toDouble(level.normals[texel]),
                                         static_cast<double>(level.spreads[texel]), roughness, engine());
                    const std::array<double, 2> errors = shading.errors(), lobe = shading.widths();
                    for (std::size_t j = 0; j < 2; ++j) {
                        off[j] += errors[j] / kTexels;
                        wide[j] += lobe[j] / kTexels;
                    }
                }
                ratio += std::log(off[1] / off[0]);
                for (std::size_t j = 0; j < 2; ++j) widths[j] += wide[j];
                ++count;
            }
        }
        std::printf("| %.1f | %.3f | %.3f | %.3f |\n", roughness, std::exp(ratio / count), widths[0] / count,
                    widths[1] / count);
    }
}

}  // namespace
}  // namespace tspace::bench

int main(int argc, char** argv) {
    const char* folder = nullptr;
    std::uint32_t seed = tspace::bench::kSeed, size = 512;
    bool is_wrong = false;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--write" && i + 1 < argc) {
            folder = argv[++i];
        } else if (argument == "--seed" && i + 1 < argc) {
            seed = static_cast<std::uint32_t>(std::atoi(argv[++i]));
        } else {
            size = static_cast<std::uint32_t>(std::atoi(argv[i]));
            is_wrong = is_wrong || size < 64 || size % 64 != 0;
        }
    }
    if (is_wrong) {
        std::fprintf(stderr, "usage: tspace_compress_bench [--write FOLDER] [--seed N] [SIZE]: a multiple of 64\n");
        return 2;
    }
    tspace::Parallel parallel(tspace::Execution{.thread_count = 1});
    const auto cases = tspace::bench::compressedCases(size, seed);
    if (folder != nullptr) return tspace::bench::writeMaps(cases, folder) ? 0 : 1;
    tspace::bench::printFormats(cases, parallel);
    tspace::bench::printLevels(cases, seed, parallel);
    return 0;
}
