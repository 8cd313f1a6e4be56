// SPDX-License-Identifier: MIT
// Commands that read maps and models and write files: convert-map, height-to-normal, bake and map-error with any
// models, images and options. A call that fails leaves no file; written files must be readable.
#include <filesystem>
#include <string>
#include <vector>

#include "files.h"
#include "images/image.h"
#include "made_image.h"
#include "made_model.h"
#include "tspace/bake_file.h"
#include "tspace/map_files.h"

namespace {

using namespace tspace;
namespace fs = std::filesystem;

struct Files {
    fs::path folder = fuzz::makeFolder(), out_folder = folder / "out";
    std::string map = (folder / "map.png").string(), a = (folder / "a.glb").string(), b = (folder / "b.glb").string();
    std::string out = (out_folder / "out.png").string();
};

MapReading readingOf(ByteReader& in) {
    const unsigned flags = in.byte();
    MapReading reading{.green = (flags & 1) != 0 ? Green::down : Green::up};
    reading.bitangent = (flags & 2) != 0 ? BitangentPlace::perVertex : BitangentPlace::perPixel;
    reading.unit_vectors = (flags & 4) != 0;
    reading.two_channels = (flags & 8) != 0;
    reading.scale = (flags & 16) != 0 ? static_cast<float>(in.byte()) / 32 - 4 : 1.0F;
    return reading;
}

MapComponent componentOf(ByteReader& in) {
    const unsigned byte = in.byte();
    return {static_cast<MapChannel>(byte % 5), byte >= 128};
}

template <class Report>
void requireWhole(const Result<Report>& report, const Files& files) {
    std::error_code ignored;
    require(report.ok() || !report.error().message.empty(), "an error has a message");
    require(report.ok() == fs::exists(files.out_folder, ignored), "there is an output exactly when the call succeeds");
    for (const auto& entry : report.ok() ? fs::directory_iterator(files.out_folder) : fs::directory_iterator()) {
        std::FILE* file = std::fopen(entry.path().c_str(), "rb");
        std::vector<std::uint8_t> bytes(fs::file_size(entry.path()));
        const bool is_read = file != nullptr && std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size();
        require(is_read && std::fclose(file) == 0, "an output can be read");
        std::string why;
        if (entry.path().extension() != ".glb")
            require(decodeImage(bytes, 1 << 20, why).has_value(), "an output is an image");
    }
    fs::remove_all(files.out_folder, ignored);
}

void convert(ByteReader& in, const Files& files) {
    ConvertMapFileOptions options;
    const unsigned flags = in.byte();
    if ((flags & 1) == 0) options.mesh = files.a;
    if ((flags & 2) != 0) options.to_mesh = files.b;
    if ((flags & 4) != 0) options.material = "a";
    if ((flags & 8) != 0) options.tile = 1001;
    options.from = static_cast<MapFileSpace>(in.byte() % 3);
    options.to = static_cast<MapFileSpace>(in.byte() % 3);
    options.from_reading = readingOf(in);
    options.to_reading = readingOf(in);
    if ((flags & 16) != 0)
        options.layout = {componentOf(in), componentOf(in), componentOf(in), static_cast<MapCurve>(in.byte() % 3)};
    options.padding = in.byte() % 4U;
    options.tangents.method = static_cast<Method>(in.byte() % 10);
    options.execution.thread_count = 1;
    options.file.sync = false;
    requireWhole(convertMapFile(files.map, files.out, options), files);
}

void heights(ByteReader& in, const Files& files) {
    HeightToNormalFileOptions options{.strength = in.byte() - 100.0};
    if (in.byte() % 2 == 0) options.mesh = files.a;
    options.clamp = in.byte() % 2 == 0;
    options.bits = in.byte() % 2 == 0 ? 8 : 16;
    options.execution.thread_count = 1;
    options.file.sync = false;
    requireWhole(heightToNormalFile(files.map, files.out, options), files);
}

void bake(ByteReader& in, const Files& files) {
    BakeFileOptions options;
    options.map.width = 1 + in.byte() % 16U;
    options.map.height = 1 + in.byte() % 16U;
    options.map.reading = readingOf(in);
    options.map.space = in.byte() % 4 == 0 ? MapSpace::object : MapSpace::tangent;
    options.execution.thread_count = 1;
    const unsigned flags = in.byte();
    options.udim = (flags & 1) != 0;
    options.unit = (flags & 2) != 0;
    if ((flags & 4) != 0) options.out_mesh = (files.out_folder / "mesh.glb").string();
    if ((flags & 8) != 0) options.heat = (files.out_folder / "heat.png").string();
    if ((flags & 16) != 0) options.misses = (files.out_folder / "misses.png").string();
    if ((flags & 32) != 0) options.cage = files.a;
    options.file.sync = false;
    requireWhole(bakeFile(files.a, files.b, files.out, options), files);
}

void measure(ByteReader& in, const Files& files) {
    MapErrorFileOptions options;
    options.map.point_count = 200;
    options.map.reading = readingOf(in);
    options.execution.thread_count = 1;
    options.two_channels = in.byte() % 4 == 0;
    options.heat = files.out;
    options.file.sync = false;
    const Result<MapErrorFileReport> report = mapErrorFile(files.map, files.a, files.b, options);
    if (report) {
        require(report->error.mean_deg >= 0 && report->error.max_deg <= 180.001, "angles are within 0 and 180");
        require(!report->verdict.empty(), "a measured map has a verdict");
    }
    requireWhole(report, files);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Files files;
    ByteReader in(data, size);
    const unsigned call = in.byte();
    const std::vector<std::uint8_t> image = fuzz::makePng(in);
    fuzz::writeFile(files.map, image);
    fuzz::writeFile(files.a, fuzz::ModelMaker(in, image).glb());
    fuzz::writeFile(files.b, fuzz::ModelMaker(in).glb());
    switch (call % 4) {
        case 0: convert(in, files); break;
        case 1: heights(in, files); break;
        case 2: bake(in, files); break;
        default: measure(in, files);
    }
    return 0;
}
