// SPDX-License-Identifier: MIT
// Packed frames: any bytes are valid frames; any floats can be packed; unpacked frames pack to the same bytes. generate
// repacks models with valid or invalid packed frames, and check then has no findings.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "made_model.h"
#include "tspace/check.h"
#include "tspace/generate.h"
#include "tspace/pack.h"
#include "tspace/result.h"

namespace {

using namespace tspace;

void requireUnit(const std::vector<Vec3>& normals, const std::vector<Vec4>& tangents) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Vec3& n = normals[i];
        const Vec4& t = tangents[i];
        require(std::fabs(std::sqrt(double{n.x} * n.x + double{n.y} * n.y + double{n.z} * n.z) - 1) < 1e-6 &&
                    std::fabs(std::sqrt(double{t.x} * t.x + double{t.y} * t.y + double{t.z} * t.z) - 1) < 1e-6,
                "unpacked vectors are unit");
        require(t.w == 1 || t.w == -1, "an unpacked sign is +1 or -1");
    }
}

/// Checks that any bytes unpack to unit frames that can be packed again and, if `is_exact`, that these unpack to the
/// same frames.
void checkBytes(FrameFormat format, std::span<const std::byte> bytes, bool is_exact) {
    const std::size_t count = bytes.size() / frameBytes(format);
    std::vector<Vec3> normals(count), again_normals(count);
    std::vector<Vec4> tangents(count), again_tangents(count);
    require(unpackFrames(bytes, format, std::span(normals), std::span(tangents)).ok(), "any bytes are frames");
    requireUnit(normals, tangents);
    std::vector<std::byte> again(bytes.size());
    require(packFrames(std::span<const Vec3>(normals), std::span<const Vec4>(tangents), format, again).ok() &&
                unpackFrames(again, format, std::span(again_normals), std::span(again_tangents)).ok(),
            "unpacked frames can be packed");
    for (std::size_t i = 0; is_exact && i < count; ++i) {
        require(std::memcmp(&normals[i], &again_normals[i], sizeof(Vec3)) == 0 &&
                    std::memcmp(&tangents[i], &again_tangents[i], sizeof(Vec4)) == 0,
                "unpacked frames come back");
    }
}

void checkFloats(ByteReader& in, FrameFormat format) {
    constexpr std::size_t kCount = 9;  // more than any SIMD target has lanes
    std::vector<Vec3> normals;
    std::vector<Vec4> tangents;
    const auto value = [&in] {
        const std::uint8_t b = in.byte();
        return b >= 250 ? in.any() : static_cast<float>(b % 17) / 8 - 1;
    };
    for (std::size_t i = 0; i < kCount; ++i) {
        normals.push_back({value(), value(), value()});
        tangents.push_back({value(), value(), value(), value()});
    }
    std::vector<std::byte> bytes(kCount * frameBytes(format));
    require(packFrames(std::span<const Vec3>(normals), std::span<const Vec4>(tangents), format, bytes).ok(),
            "any floats can be packed");
    checkBytes(format, bytes, false);
}

void checkModel(ByteReader& in, FrameFormat format) {
    GenerateOptions options{.selection = {.all = in.byte() % 2 == 0}};
    options.selection.existing = static_cast<ExistingTangents>(in.byte() % 3);
    options.storage.pack = format;
    options.storage.pack_drop = static_cast<PackDrop>(in.byte() % 3);
    options.execution.thread_count = 1;
    options.storage.format = static_cast<VectorFormat>(in.byte() % 3);
    const std::vector<std::uint8_t> model = fuzz::ModelMaker(in).glb();
    options.file.content = model;
    std::vector<std::uint8_t> output;
    options.sink = [&output](std::span<const std::uint8_t> piece) {
        output.insert(output.end(), piece.begin(), piece.end());
        return true;
    };
    const bool is_sound = checkFile("a.glb", {.file = options.file}).ok();
    const Result<GenerateReport> report = generateFile("a.glb", "b.glb", options);
    if (!report) return require(!report.error().message.empty(), "an error has a message");
    // generate copies primitives that it does not change, so faults that only check detects may remain in them.
    if (!is_sound) return;
    const Result<CheckReport> checked = checkFile("b.glb", {.file = {.content = output}});
    require(checked.ok(), "what was written can be read");
    for (const PrimitiveReport& primitive : report->primitives) {
        if (!primitive.frames_packed) continue;
        bool is_found = false;
        for (const PackedFramesInfo& info : checked->packed_frames) {
            if (info.format != format || info.mesh != primitive.mesh || info.primitive != primitive.primitive) continue;
            is_found = true;
            require(info.is_readable, "packed frames that were written can be read");
            if (!info.is_compared) continue;
            require(info.differing_sign_count == 0, "packed signs are exact");
        }
        require(is_found, "packed frames that are told of are there");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(data, size);
    const auto format = static_cast<FrameFormat>(in.byte() % 9);
    const std::size_t count = size / frameBytes(format);
    // Only the formats up to oct32 guarantee exact round trips (see the header).
    checkBytes(format, {reinterpret_cast<const std::byte*>(data), count * frameBytes(format)},
               format <= FrameFormat::oct32);
    checkFloats(in, format);
    checkModel(in, format);
    return 0;
}
