// SPDX-License-Identifier: MIT
// compressMapFile: the image, its levels, their blocks, and how far they are off. Its options, and its report as JSON.
#include "tspace/map_compress_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/compress_map/compress_map_report.h"
#include "commands/shared/file_options.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/request.h"
#include "images/pack_bc4.h"
#include "images/texel_format.h"
#include "images/write_texture.h"
#include "maps/normal_levels.h"
#include "maps/shading.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"

namespace tspace {
namespace {

/// Unit vectors with z of at least 0, and what of the image was none.
NormalLevel normalsOf(const FloatImage& image, CompressMapFileReport& report) {
    constexpr double kMostOff = 0.1;
    NormalLevel level{image.width, image.height, std::vector<Vec3>(image.texels.size())};
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        DVec3 vector = decodeTexel(image.texels[i], {});
        const double size = length(vector);
        if (std::fabs(size - 1) > kMostOff) ++report.not_unit;
        if (vector.z < 0) {
            ++report.below_horizon;
            vector.z = 0;
        }
        level.normals[i] = normalize(vector) ? toFloat(vector) : Vec3{0, 0, 1};
    }
    return level;
}

/// The blocks of a level, row by row. At the edges the last texels are taken once more.
std::vector<std::uint8_t> packLevel(const NormalLevel& level, bool is_signed, Parallel& parallel) {
    const std::size_t across = (level.width + 3) / 4, down = (level.height + 3) / 4;
    std::vector<std::uint8_t> blocks(16 * across * down);
    parallel.forRanges(down, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin * across; block < end * across; ++block) {
            std::array<float, 16> x{}, y{};
            for (std::size_t i = 0; i < 16; ++i) {
                const std::size_t column = std::min<std::size_t>(block % across * 4 + i % 4, level.width - 1);
                const std::size_t row = std::min<std::size_t>(block / across * 4 + i / 4, level.height - 1);
                const Vec3& normal = level.normals[row * level.width + column];
                x[i] = 0.5F * normal.x + 0.5F;
                y[i] = 0.5F * normal.y + 0.5F;
            }
            const std::array<std::uint8_t, 8> red = packBc4(x, is_signed), green = packBc4(y, is_signed);
            std::copy(red.begin(), red.end(), &blocks[16 * block]);
            std::copy(green.begin(), green.end(), &blocks[16 * block + 8]);
        }
    });
    return blocks;
}

/// x and y of a level as they are decoded.
std::vector<Vec2> decodedLevel(const NormalLevel& level, const std::vector<std::uint8_t>& blocks, bool is_signed) {
    const TexelFormat format = texelFormat(is_signed ? TexelKind::bc5s : TexelKind::bc5);
    const std::size_t across = (level.width + 3) / 4;
    std::vector<Vec2> texels(level.normals.size());
    std::array<Rgba, 16> block{};
    for (std::size_t i = 0; i < blocks.size() / 16; ++i) {
        format.decode(format, &blocks[16 * i], block.data());
        for (std::size_t k = 0; k < 16; ++k) {
            const std::size_t column = i % across * 4 + k % 4, row = i / across * 4 + k / 4;
            if (column < level.width && row < level.height)
                texels[row * level.width + column] = {2 * block[k][0] - 1, 2 * block[k][1] - 1};
        }
    }
    return texels;
}

/// What a renderer shades at points between texels, of three channels and of two. The map repeats.
class FilteredError {
  public:
    FilteredError(const NormalLevel& level, const std::vector<Vec2>& decoded) : level_(level), decoded_(decoded) {}

    void measure(CompressMapFileReport& report) {
        constexpr std::size_t kMostPoints = std::size_t{1} << 22;
        const std::size_t row_points = std::size_t{9} * level_.width;
        const std::size_t step = row_points * level_.height / kMostPoints + 1;
        std::vector<float> angles;
        double sum = 0;
        for (std::size_t y = step / 2; y < level_.height; y += step) {
            for (std::size_t x = 0; x < level_.width; ++x) {
                for (int point = 0; point < 9; ++point) {
                    const double angle = angleAt(x, y, (point % 3) / 3.0, static_cast<double>(point / 3) / 3.0);
                    sum += angle;
                    angles.push_back(static_cast<float>(angle));
                }
            }
        }
        report.mean_error_deg = sum / static_cast<double>(angles.size());
        const auto near_end = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() * 99 / 100);
        std::nth_element(angles.begin(), near_end, angles.end());
        report.p99_error_deg = static_cast<double>(*near_end);
        report.max_error_deg = static_cast<double>(*std::max_element(near_end, angles.end()));
    }

  private:
    [[nodiscard]] double angleAt(std::size_t x, std::size_t y, double right, double down) const {
        const std::size_t next_x = (x + 1) % level_.width, next_y = (y + 1) % level_.height;
        const std::array<std::size_t, 4> places{y * level_.width + x, y * level_.width + next_x,
                                                next_y * level_.width + x, next_y * level_.width + next_x};
        const std::array<double, 4> weights{(1 - right) * (1 - down), right * (1 - down), (1 - right) * down,
                                            right * down};
        DVec3 shaded{}, packed{};
        for (std::size_t i = 0; i < 4; ++i) {
            shaded = shaded + weights[i] * toDouble(level_.normals[places[i]]);
            packed.x += weights[i] * static_cast<double>(decoded_[places[i]].x);
            packed.y += weights[i] * static_cast<double>(decoded_[places[i]].y);
        }
        packed.z = std::sqrt(std::max(0.0, 1 - packed.x * packed.x - packed.y * packed.y));
        return degreesBetween(shaded, packed);
    }

    const NormalLevel& level_;
    const std::vector<Vec2>& decoded_;
};

void addCompressWarnings(const FloatImage& image, CompressMapFileReport& report) {
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    const std::uint64_t total = image.texels.size();
    if (!image.alpha.empty()) warn("the image has alpha, which BC5 has no room for");
    if (report.below_horizon > 0)
        warn(std::to_string(report.below_horizon) + " texels look below the horizon, which two channels cannot say");
    if (report.not_unit > total / 10)
        warn(std::to_string(report.not_unit) + " of " + std::to_string(total) +
             " texels are no unit vectors: is it a normal map in tangent space?");
}

CompressMapFileReport compress(const std::string& input, const std::string& output,
                               const CompressMapFileOptions& options) {
    InputFiles inputs;
    if (options.content.data() == nullptr) inputs.add(input);
    const std::string extension = lowerExtension(output);
    if (!options.sink && extension != ".dds" && extension != ".ktx2")
        failFile(ErrorCode::unsupportedFile,
                 "the output " + pathInQuotes(output) + " ends neither in .dds nor in .ktx2");
    FloatImage image = readMapImage(input, options.content, options.file);
    CompressMapFileReport report{.width = image.width, .height = image.height, .bits_before = image.bits};
    if (std::string how_read = readTextureVectors(image); !how_read.empty())
        report.warnings.push_back(std::move(how_read));
    Parallel parallel(options.execution);
    std::vector<NormalLevel> levels;
    NormalLevel first = normalsOf(image, report);
    if (options.levels) {
        levels = makeNormalLevels(std::move(first), parallel);
    } else {
        levels.push_back(std::move(first));
    }
    report.level_count = static_cast<std::uint32_t>(levels.size());
    Bc5Texture texture{.width = image.width, .height = image.height, .is_signed = options.is_signed};
    for (const NormalLevel& level : levels) texture.levels.push_back(packLevel(level, options.is_signed, parallel));
    const std::vector<Vec2> decoded = decodedLevel(levels.front(), texture.levels.front(), options.is_signed);
    FilteredError(levels.front(), decoded).measure(report);
    addCompressWarnings(image, report);
    const std::vector<std::uint8_t> file = extension == ".dds" ? writeDds(texture) : writeKtx2(texture);
    report.output_bytes = file.size();
    AtomicOutput files(
        {.sink = options.sink, .is_dry_run = options.dry_run, .sync = options.file.sync, .inputs = &inputs});
    files.add(output, std::span<const std::uint8_t>(file));
    files.commit();
    return report;
}

}  // namespace

Result<CompressMapFileReport> compressMapFile(const std::string& input, const std::string& output,
                                              const CompressMapFileOptions& options) {
    return atFileBorder([&]() -> Result<CompressMapFileReport> { return compress(input, output, options); });
}

}  // namespace tspace

namespace tspace::options {

OptionList compressMapOptions(CompressMapFileOptions& options) {
    OptionList list;
    add(list, "Texture",
        flag("--signed", options.is_signed,
             "Write BC5 with a sign (SNORM). Flat parts of maps of more than 8 bits are then exact; engines must be "
             "told."));
    add(list, "Texture",
        setting("--no-levels", options.levels, false, "Write the first level alone. By default all smaller ones too."));
    add(list, kInputAndOutput, flag("--dry-run", options.dry_run, "Do everything but write."));
    addThreads(list, options.execution,
               "Threads; 0: as many as there are cores. The output is the same for any number.");
    addLimits(list, options.file);
    addSync(list, options.file.sync);
    return list;
}

}  // namespace tspace::options

namespace tspace::report {

std::string compressMapJson(const Outcome<CompressMapFileReport>& outcome, ExitCode exit_code) {
    const Result<CompressMapFileReport>& result = outcome.result;
    Json json = madeFileJson("tspace.compress-map/1", outcome, exit_code);
    if (!result) return jsonText(json);
    json["width"] = result->width;
    json["height"] = result->height;
    json["bitsBefore"] = result->bits_before;
    json["levels"] = result->level_count;
    json["outputBytes"] = result->output_bytes;
    json["meanErrorDeg"] = result->mean_error_deg;
    json["p99ErrorDeg"] = result->p99_error_deg;
    json["maxErrorDeg"] = result->max_error_deg;
    json["belowHorizon"] = result->below_horizon;
    json["notUnit"] = result->not_unit;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
