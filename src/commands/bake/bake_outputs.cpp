// SPDX-License-Identifier: MIT
#include "commands/bake/bake_outputs.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "maps/layout/uv_coverage.h"
#include "model/gltf/container.h"
#include "model/io/file_error.h"
#include "model/io/file_io.h"

namespace tspace {
namespace {

/// Returns the position of a path's extension, or the end of the path.
std::size_t extensionOf(const std::string& path) {
    const std::size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
    const bool has_extension = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    return has_extension ? dot : path.size();
}

/// Returns a material name in which every character that is unsuitable for file names is replaced by `_`. Names are cut
/// after 100 bytes, because file systems limit file names to 255 bytes, and the names of the output, a layer and a tile
/// are added.
std::string fileNamePart(const std::string& name) {
    constexpr std::size_t kMostBytes = 100;
    std::string suffix;
    for (const char letter : std::string_view(name).substr(0, kMostBytes)) {
        const bool is_plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                              (letter >= '0' && letter <= '9') || letter == '-' || letter == '_';
        suffix += is_plain ? letter : '_';
    }
    return suffix.empty() ? "material" : suffix;
}

/// Returns the paths of all files that a bake writes: the maps of each image, the pictures, and the model.
std::vector<std::string> outputsOf(const BakeNames& bake, const BakeFileOptions& options,
                                   const std::vector<std::string>& suffixes) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& path) {
        if (path.empty()) return;
        for (const std::string& suffix : suffixes) names.push_back(withSuffix(path, suffix));
    };
    if (options.layers.has_normal) add(bake.output);
    const std::string& layers_output = bake.layers_output.empty() ? bake.output : bake.layers_output;
    for (const MapLayer layer : options.layers.layers) add(withLayer(layers_output, layer));
    add(options.misses);
    add(options.heat);
    if (options.out_mesh.empty()) return names;
    names.push_back(options.out_mesh);
    for (std::string& buffer : gltf::bufferFilesOf(options.out_mesh)) names.push_back(std::move(buffer));
    return names;
}

/// Returns whether inserting names of materials and tiles can turn one of the paths `plain` into `path`.
bool mayBecome(const std::vector<std::string>& plain, const std::string& path) {
    for (const std::string& shorter : withoutSuffixes(path)) {
        const std::string identity = identityOf(shorter);
        if (std::any_of(plain.begin(), plain.end(),
                        [&](const std::string& name) { return identityOf(name) == identity; }))
            return true;
    }
    return false;
}

}  // namespace

std::string withSuffix(const std::string& path, const std::string& suffix) {
    if (path.empty() || suffix.empty()) return path;
    const std::size_t at = extensionOf(path);
    return path.substr(0, at) + "." + suffix + path.substr(at);
}

std::string withLayer(const std::string& path, MapLayer layer) {
    const std::size_t at = extensionOf(path);
    return path.substr(0, at) + "_" + layerName(layer) + path.substr(at);
}

std::vector<std::string> imageSuffixes(const LowModel& low) {
    if (low.images.size() < 2) return std::vector<std::string>(low.images.size());
    std::vector<std::string> suffixes;
    std::set<std::string> known;
    for (const LowModel::Image& image : low.images) {
        const std::string suffix = fileNamePart(image.material);
        std::string fresh = suffix;
        for (int i = 2; !known.insert(fresh).second; ++i) fresh = suffix + "_" + std::to_string(i);
        suffixes.push_back(std::move(fresh));
    }
    return suffixes;
}

std::string tileSuffix(const std::string& image, std::uint32_t tile) {
    return image.empty() ? std::to_string(tile) : image + "." + std::to_string(tile);
}

std::vector<std::string> plainOutputs(const BakeNames& bake, const BakeFileOptions& options) {
    return outputsOf(bake, options, {""});
}

std::vector<std::string> outputsToCompare(const std::vector<std::string>& others, const std::string& low,
                                          const BakeNames& bake, const BakeFileOptions& options) {
    std::vector<std::string> names = plainOutputs(bake, options);
    if (std::none_of(others.begin(), others.end(),
                     [&](const std::string& other) { return !other.empty() && mayBecome(names, other); }))
        return names;
    // A low poly that cannot be read is reported by the bake itself.
    static_cast<void>(tryFile([&] { names = outputsFor(low, bake, options); }));
    return names;
}

std::vector<std::string> outputsFor(const std::string& low, const BakeNames& bake, const BakeFileOptions& options) {
    const LowModel model = readLowImages(low, options);
    std::vector<std::string> suffixes = imageSuffixes(model);
    if (!options.udim) return outputsOf(bake, options, suffixes);
    std::set<std::string> of_tiles;
    for (std::size_t i = 0; i < suffixes.size(); ++i) {
        const LowPart& part = model.images[i].part;
        for (std::size_t triangle = 0; triangle < part.triangleCount(); ++triangle) {
            if (const std::uint32_t tile = tileOf(&part.corners.uvs[3 * triangle]); tile != 0)
                of_tiles.insert(tileSuffix(suffixes[i], tile));
        }
    }
    return outputsOf(bake, options, {of_tiles.begin(), of_tiles.end()});
}

std::vector<std::string> withoutSuffixes(const std::string& path) {
    const std::size_t end = extensionOf(path);
    const std::string extension = path.substr(end);
    std::vector<std::string> names;
    for (std::string stem = path.substr(0, end); extensionOf(stem) != stem.size();) {
        stem.resize(extensionOf(stem));
        names.push_back(stem + extension);
    }
    return names;
}

}  // namespace tspace
