// SPDX-License-Identifier: MIT
#include "commands/shared/map_image_file.h"

#include <array>
#include <optional>

#include "maps/grey.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"
#include "model/io/memory_budget.h"

namespace tspace {

namespace {

constexpr std::uint64_t kMostMapPixels = std::uint64_t{1} << 28;

}  // namespace

FloatImage readMapImage(const std::string& input, ByteSpan content, const FileOptions& file) {
    Bytes read;
    ByteSpan bytes = content;
    if (bytes.data() == nullptr) {
        read = readFile(input);
        bytes = read;
    }
    if (const char* why_not = whyNotRead(imageFormat(bytes))) failFile(ErrorCode::unsupportedFile, why_not);
    if (file.memory_limit_bytes != 0) {
        MemoryBudget budget(file.memory_limit_bytes);
        budget.require(bytes.size() + imageWorkBytes(bytes) + kMapPixelBytes * claimedSize(bytes).pixels(), {});
    }
    std::string why;
    std::optional<FloatImage> image = decodeFloatImage(bytes, kMostMapPixels, why);
    if (!image) failFile(ErrorCode::invalidFile, why);
    return *std::move(image);
}

MapMesh readNamedMapMesh(const std::string& model, const MapMeshChoice& choice, const TangentOptions& tangents,
                         const FileOptions& file, const Execution& execution) {
    try {
        return readMapMesh(model, choice, tangents, file, execution);
    } catch (FileError& failure) {
        failure.error.message = "the model " + pathInQuotes(model) + ": " + failure.error.message;
        throw;
    }
}

std::string fileNameOf(const std::string& path) {
    const std::size_t folder = path.find_last_of("/\\");
    return folder == std::string::npos ? path : path.substr(folder + 1);
}

void writeMapImage(const FloatImage& image, ImageFormat format, unsigned bits, const std::string& output,
                   const OutputWay& way) {
    const std::optional<std::vector<std::uint8_t>> file =
        format == ImageFormat::png ? encodePng(image, bits) : encodeExr(image, bits);
    if (!file) failFile(ErrorCode::outOfMemory, "the image cannot be packed");
    AtomicOutput files(way);
    files.add(output, std::span<const std::uint8_t>(*file));
    files.commit();
}

std::string readTextureVectors(FloatImage& image) {
    const MapLayout layout = image.texture.layout;
    if (layout == MapLayout{}) return {};
    const auto readsAlpha = [](const MapComponent& component) { return component.channel == MapChannel::alpha; };
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = readTexel(image.texels[i], image.alpha.empty() ? 1 : image.alpha[i], layout);
    if (readsAlpha(layout.x) || readsAlpha(layout.y)) image.alpha.clear();
    image.texture.layout = {};
    constexpr const char* kNames[] = {"red", "green", "blue", "alpha", ""};
    const auto nameOf = [&](const MapComponent& component) {
        return kNames[static_cast<std::size_t>(component.channel)];
    };
    const std::string where = std::string("x is read from ") + nameOf(layout.x) + " and y from " + nameOf(layout.y) +
                              (layout.z.channel == MapChannel::none ? ", and z is made of them" : "");
    return "the map is " + image.texture.name +
           (image.texture.is_guessed ? ", whose texels look as if it held x and y alone: " : ": ") + where;
}

bool isGreyImage(const FloatImage& image) {
    return isGrey(image.texels.size(), [&](std::size_t i) {
        const Vec3& texel = image.texels[i];
        return std::array<double, 3>{255 * double{texel.x}, 255 * double{texel.y}, 255 * double{texel.z}};
    });
}

std::vector<float> heightsOf(const FloatImage& image) {
    std::vector<float> heights;
    heights.reserve(image.texels.size());
    for (const Vec3& texel : image.texels) {
        const bool is_one = texel.x == texel.y && texel.y == texel.z;
        heights.push_back(is_one ? texel.x : (texel.x + texel.y + texel.z) / 3);
    }
    return heights;
}

MapSide tangentSide(const MapMesh& mesh) {
    return {.uvs = mesh.uvs, .normals = mesh.normals, .tangents = mesh.tangents, .positions = mesh.positions};
}

}  // namespace tspace
