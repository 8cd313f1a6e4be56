// SPDX-License-Identifier: MIT
// compressMapFile: reads the image, computes mip levels, encodes blocks, and measures the error. Also its options, and
// its report as JSON.
#include "tspace/map_files.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "commands/compress_map/compress_map_report.h"
#include "commands/compress_map/pack_texture.h"
#include "commands/shared/file_options.h"
#include "commands/shared/map_image_file.h"
#include "commands/shared/request.h"
#include "images/texture_vectors.h"
#include "maps/texels/shading.h"
#include "model/io/atomic_output.h"
#include "model/io/file_error.h"
#include "model/io/output_name.h"
#include "textures/texture_levels.h"

namespace tspace {
namespace {

enum class Container { ktx2, dds, png, folder };

Container containerOf(const std::string& output, bool takes_png) {
    const std::string extension = lowerExtension(output);
    if (!output.empty() && (output.back() == '/' || output.back() == '\\')) return Container::folder;
    if (extension == ".ktx2") return Container::ktx2;
    if (extension == ".dds") return Container::dds;
    if (extension == ".png" && takes_png) return Container::png;
    if (takes_png) failEnding(output, {".ktx2", ".dds", ".png", "/ (a folder of PNGs)"});
    failEnding(output, {".ktx2", ".dds", "/ (a folder of PNGs)"});
}

[[noreturn]] void failAstcenc() {
    failFile(ErrorCode::outOfMemory, "the library astcenc failed to encode the mip levels");
}

class MapCompression {
  public:
    MapCompression(const std::string& input, const std::string& output, const CompressMapFileOptions& options)
        : input_(input), output_(output), options_(options), parallel_(options.execution) {}

    CompressMapFileReport run() {
        checkOptions();
        if (options_.content.data() == nullptr) inputs_.add(input_);
        if (!options_.roughness.empty()) inputs_.add(options_.roughness);
        FloatImage image = readMapImage(input_, options_.content, options_.file);
        beginReport(image, report_);
        const bool has_roughness = !options_.roughness.empty();
        const RoughnessLevel roughness = readRoughness(image);
        map_ = makeMapLevels(std::move(image), options_, has_roughness, container_ == Container::folder, parallel_,
                             report_);
        AtomicOutput files(
            {.sink = options_.sink, .is_dry_run = options_.dry_run, .sync = options_.file.sync, .inputs = &inputs_});
        if (has_roughness) writeRoughness(roughness, files);
        if (!options_.levels) map_.levels.resize(1);
        report_.level_count = static_cast<std::uint32_t>(map_.levels.size());
        writeNormals(files);
        files.commit();
        return std::move(report_);
    }

  private:
    void checkOptions() {
        constexpr unsigned kMaxZstd = 22;
        container_ = options_.sink ? Container::ktx2 : containerOf(output_, false);
        if (options_.roughness.empty() != options_.roughness_output.empty())
            failFile(ErrorCode::invalidOption, "a roughness texture needs both --roughness and --roughness-output");
        if (options_.sink && !options_.roughness.empty())
            failFile(ErrorCode::invalidOption, "only one output can be written to stdout");
        if (!options_.roughness.empty()) roughness_container_ = containerOf(options_.roughness_output, true);
        if (options_.bits != 8 && options_.bits != 16)
            failFile(ErrorCode::invalidOption, "a PNG must have 8 or 16 bits per channel");
        if (std::optional<Error> fault = textureFault(options_, container_ == Container::dds))
            throw FileError{*std::move(fault)};
        if (options_.dds_header != DdsHeader::dx10 && container_ != Container::dds &&
            roughness_container_ != Container::dds)
            failFile(ErrorCode::invalidOption, "--dds-header can only be used with outputs that end in .dds");
        if (options_.zstd_level == 0) return;
        if (options_.zstd_level > kMaxZstd)
            failFile(ErrorCode::invalidOption, "the Zstandard level must be from 1 to 22");
        if (const char* why_not = whyNotZstd()) failFile(ErrorCode::unsupportedFile, why_not);
        if (container_ != Container::ktx2 && roughness_container_ != Container::ktx2)
            failFile(ErrorCode::invalidOption, "Zstandard supercompression can only be used with .ktx2");
    }

    RoughnessLevel readRoughness(const FloatImage& map) {
        if (options_.roughness.empty()) return {};
        try {
            FloatImage image = readMapImage(options_.roughness, {}, options_.file, ImageUse::numbers);
            RoughnessLevel level{image.width, image.height, std::move(image.texels)};
            if (const std::string why = whyGridsDiffer(level, map.width, map.height); !why.empty())
                failFile(ErrorCode::invalidOption, why);
            if (const std::string remarks = takeRemarks(image); !remarks.empty())
                report_.warnings.push_back("the roughness texture: " + remarks);
            if (!image.alpha.empty())
                report_.warnings.emplace_back("the alpha channel of the roughness texture is ignored");
            return level;
        } catch (FileError& failure) {
            failure.error.message = "the roughness " + pathInQuotes(options_.roughness) + ": " + failure.error.message;
            throw;
        }
    }

    void writeNormals(AtomicOutput& files) {
        if (container_ == Container::folder) {
            writeFolder(files);
            return;
        }
        const std::optional<Texture> texture = packLevels(map_, options_, parallel_, report_);
        if (!texture) failAstcenc();
        report_.output_bytes = addTexture(*texture, container_, output_, files);
    }

    std::uint64_t addTexture(const Texture& texture, Container container, const std::string& output,
                             AtomicOutput& files) const {
        std::vector<std::uint8_t> bytes;
        if (container == Container::dds) {
            bytes = ddsFileOf(texture, options_.dds_header);
        } else {
            std::optional<std::vector<std::uint8_t>> file = writeKtx2(texture, static_cast<int>(options_.zstd_level));
            if (!file) failFile(ErrorCode::outOfMemory, "out of memory while writing the mip levels as KTX2");
            bytes = *std::move(file);
        }
        files.add(output, std::span<const std::uint8_t>(bytes));
        return bytes.size();
    }

    static std::uint64_t addPng(const FloatImage& image, unsigned bits, const std::string& path, AtomicOutput& files) {
        const std::optional<std::vector<std::uint8_t>> png = encodePng(image, bits);
        if (!png) failFile(ErrorCode::unsupportedFile, "this build of tspace cannot write PNG");
        files.add(path, std::span<const std::uint8_t>(*png));
        return png->size();
    }

    void writeFolder(AtomicOutput& files) {
        report_.format = options_.bits == 8 ? "PNG of 8 bits" : "PNG of 16 bits";
        const float most = options_.bits == 8 ? 255.0F : 65535.0F;
        const auto rounded = [&](float part) { return std::floor((0.5F * part + 0.5F) * most + 0.5F) / most; };
        for (std::size_t i = 0; i < map_.levels.size(); ++i) {
            const NormalLevel& level = map_.levels[i];
            FloatImage image{level.width, level.height, options_.bits, {}, {}};
            for (const Vec3& normal : level.normals)
                image.texels.push_back({rounded(normal.x), rounded(normal.y), rounded(normal.z)});
            report_.output_bytes += addPng(image, options_.bits, levelPath(output_, input_, i), files);
            if (i > 0) continue;
            for (Vec3& texel : image.texels) texel = 2.0F * texel - Vec3{1, 1, 1};
            keepError(measureFiltered(level, image.texels, false, parallel_), report_);
        }
    }

    void writeRoughness(const RoughnessLevel& first, AtomicOutput& files) {
        std::vector<RoughnessLevel> levels = makeRoughness(first, options_, map_, parallel_, report_);
        const std::string& output = options_.roughness_output;
        if (roughness_container_ == Container::png || roughness_container_ == Container::folder) {
            const bool is_folder = roughness_container_ == Container::folder;
            if (!is_folder) {
                levels.resize(1);
                report_.warnings.emplace_back(
                    "a PNG has no mip levels, so the roughness does not include the spread of the normals; write a "
                    ".ktx2, a .dds or a folder");
            }
            for (std::size_t i = 0; i < levels.size(); ++i) {
                const FloatImage image{levels[i].width, levels[i].height, 8, levels[i].texels, {}};
                report_.roughness_bytes +=
                    addPng(image, 8, is_folder ? levelPath(output, options_.roughness, i) : output, files);
            }
            return;
        }
        report_.roughness_bytes = addTexture(roughnessTexture(levels), roughness_container_, output, files);
    }

    const std::string &input_, &output_;
    const CompressMapFileOptions& options_;
    Parallel parallel_;
    InputFiles inputs_ = {};
    Container container_ = Container::ktx2, roughness_container_ = Container::png;
    MapLevels map_ = {};
    CompressMapFileReport report_ = {};
};

}  // namespace

std::string levelPath(const std::string& folder, const std::string& input, std::size_t level) {
    std::string name = fileNameOf(input);
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0) name.resize(dot);
    return folder + (name.empty() || name == "-" ? "map" : name) + "." + std::to_string(level) + ".png";
}

bool isTextureName(const std::string& path) {
    const std::string extension = lowerExtension(path);
    return extension == ".ktx2" || extension == ".dds";
}

std::vector<std::uint8_t> packTexture(const std::string& name, std::uint32_t width, std::uint32_t height,
                                      std::span<const Vec3> texels, const Execution& execution,
                                      std::vector<float> coverage, DdsHeader header) {
    NormalLevel first{width, height, {}, {}, std::move(coverage)};
    first.normals.reserve(texels.size());
    for (const Vec3& texel : texels) first.normals.push_back(toFloat(decodeTexel(texel, {})));
    Parallel parallel(execution);
    Texture texture{.width = width, .height = height, .kind = TexelKind::bc5, .levels = {}};
    for (const NormalLevel& level : makeNormalLevels(std::move(first), parallel))
        texture.levels.push_back(packLevel(level, {}, parallel)->bytes);
    if (lowerExtension(name) == ".dds") return ddsFileOf(texture, header);
    std::optional<std::vector<std::uint8_t>> file = writeKtx2(texture);
    if (!file) failFile(ErrorCode::outOfMemory, "out of memory while writing the mip levels as KTX2");
    return *std::move(file);
}

Result<CompressMapFileReport> compressMapFile(const std::string& input, const std::string& output,
                                              const CompressMapFileOptions& options) {
    return atFileBorder(
        [&]() -> Result<CompressMapFileReport> { return MapCompression(input, output, options).run(); });
}

}  // namespace tspace

namespace tspace::options {
namespace {

constexpr Named<TextureFormat> kFormats[] = {{"bc5", TextureFormat::bc5},
                                             {"eac-rg11", TextureFormat::eacRg11},
                                             {"astc-4x4", TextureFormat::astc4x4},
                                             {"rg8", TextureFormat::rg8}};
constexpr Named<TextureQuality> kQualities[] = {
    {"quick", TextureQuality::quick}, {"fast", TextureQuality::fast}, {"best", TextureQuality::best}};

Option formatOption(TextureFormat& format) {
    Option made = choice("--format", "FORMAT", kFormats, format,
                         "Texture format. bc5: desktop and consoles; eac-rg11: mobile (.ktx2 only); astc-4x4: mobile, "
                         "with x in red and y in alpha (.ktx2 only; needs the library astcenc); rg8: uncompressed.");
    made.take = [take = made.take](const std::string& name) {
        if (name == "uastc")
            return std::string(
                "not supported; use basisu to encode UASTC, or PNG or lossless WebP for a lossless map in a glTF");
        return take(name);
    };
    return made;
}

Option factorOption(double& factor) {
    const auto take = [&factor](const std::string& value) {
        double number = 0;
        if (!parseReal(value, number) || number < 0 || number > 1) return std::string("must be a number from 0 to 1");
        factor = number;
        return std::string();
    };
    Option option = options::option("--roughness-factor", "NUMBER", take,
                                    "roughnessFactor of the material. It is multiplied into the texture, so set it to "
                                    "1 in the material afterwards.");
    option.default_text = std::string("1");  // a string object, because GCC 12 warns about a literal here
    option.needs = "--roughness";
    return option;
}

void addRoughness(OptionList& list, CompressMapFileOptions& options) {
    const auto add = adder(list, "Roughness");
    add(fileOption(
            "--roughness", "IMAGE", options.roughness,
            "A glTF texture of occlusion, roughness and metalness. Its mip levels are made rougher according to the "
            "spread of the normals within each texel, so that distant surfaces do not sparkle. Its size must be that "
            "of the normal map, or that size multiplied or divided by a power of two (the same for width and height).",
            InputKind::image))
        .needs = "--roughness-output";
    add(fileOption("-o2, --roughness-output", "OUT", options.roughness_output,
                   "Output file of the roughness texture: .ktx2, .dds, .png (first mip level only), or a folder "
                   "of PNGs (a name that ends in /)."))
        .needs = "--roughness";
    add(factorOption(options.roughness_factor));
}

}  // namespace

OptionList compressMapOptions(CompressMapFileOptions& options) {
    OptionList list;
    const auto add = adder(list, "Texture");
    add(formatOption(options.format));
    add(choice("--quality", "QUALITY", kQualities, options.quality,
               "Encoder quality. quick: encodes each channel separately; fast: minimizes the error of the filtered "
               "texture; best: like fast, with more iterations. Compared with fast, depending on the format and the "
               "map, quick has about 10% to 75% more error and takes about 35% to 60% of the time; best has up to 3% "
               "less error (astc-4x4: 2% to 33%) and takes 2.1 to 2.3 times as long."));
    add(flag("--signed", options.is_signed,
             "Write signed channels (SNORM), for engines that expect them. Flat areas, whose normal is (0, 0, 1), are "
             "then exact if the input has more than 8 bits."));
    add(alphaOption(options.alpha));
    add(ddsHeaderOption(options.dds_header));
    add(setting("--mips", options.levels, true,
                "Write all mip levels, each computed from the first one. This is the default."));
    add(setting("--no-levels", options.levels, false, "Write only the first mip level.")).excludes = {"--mips"};
    add(number("--zstd", options.zstd_level, 22,
               "Zstandard supercompression level of a .ktx2, from 1 (fast) to 22 (smallest); 0: none. Textures of "
               "detailed maps hardly become smaller."));
    add(number("--bits", options.bits, 16, "Bits per channel of the normal-map PNGs, if OUT is a folder: 8 or 16."));
    addRoughness(list, options);
    options::add(list, kInputAndOutput, dryRunOption(options.dry_run));
    addThreads(list, options.execution);
    addMemoryLimit(list, options.file.memory_limit_bytes);
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
    json["format"] = result->format;
    json["levels"] = result->level_count;
    json["outputBytes"] = result->output_bytes;
    json["roughnessBytes"] = result->roughness_bytes;
    json["meanErrorDeg"] = result->mean_error_deg;
    json["p99ErrorDeg"] = result->p99_error_deg;
    json["maxErrorDeg"] = result->max_error_deg;
    json["maxErrorX"] = result->max_error_x;
    json["maxErrorY"] = result->max_error_y;
    json["belowHorizon"] = result->below_horizon;
    json["notUnit"] = result->not_unit;
    json["meanRoughness"] = result->mean_roughness;
    json["meanWidenedRoughness"] = result->mean_widened_roughness;
    json["warnings"] = result->warnings;
    return jsonText(json);
}

}  // namespace tspace::report
