// SPDX-License-Identifier: MIT
// Comparison of two models: values are consistent and within their bounds, both directions give equal numbers of pairs,
// and a model does not differ from itself.
#include <cmath>

#include "made_model.h"
#include "tspace/inspect.h"

namespace {

using namespace tspace;

void requireSound(const AngleStatistics& angles) {
    require(angles.median_deg <= angles.p95_deg && angles.p95_deg <= angles.max_deg, "quantiles are in order");
    require(angles.mean_deg >= 0 && angles.max_deg <= 180.001, "angles are within 0 and 180");
    std::uint64_t binned = 0;
    for (const std::uint64_t count : angles.histogram) binned += count;
    require(binned == angles.count, "every pair is in a bin");
}

void requireSound(const FrameDiff& diff) {
    requireSound(diff.tangents), requireSound(diff.normals), requireSound(diff.bitangents);
    for (const PrimitiveDiff& primitive : diff.primitives) {
        requireSound(primitive.tangents), requireSound(primitive.normals), requireSound(primitive.bitangents);
        require(primitive.paired_triangle_count <= primitive.triangle_count_a &&
                    primitive.paired_triangle_count <= primitive.triangle_count_b,
                "no triangle is paired twice");
    }
    require(diff.worst.size() <= 8, "no more places are listed than asked for");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader in(data, size);
    const auto a = fuzz::ModelMaker(in).glb(), b = fuzz::ModelMaker(in).glb();
    DiffOptions options;
    options.file.content = a;
    options.file_b = FileOptions{.content = b};
    const Result<FrameDiff> diff = diffFiles("a.glb", "b.glb", options);
    require(diff.ok() || !diff.error().message.empty(), "an error has a message");
    if (diff) {
        requireSound(*diff);
        const Result<FrameDiff> back = diffFiles("b.glb", "a.glb", {.file = *options.file_b, .file_b = options.file});
        require(back && back->unpaired_triangle_count == diff->unpaired_triangle_count &&
                    back->corner_count == diff->corner_count,
                "the order of the models does not decide who is paired");
    }
    options.file_b = options.file;
    const Result<FrameDiff> same = diffFiles("a.glb", "a.glb", options);
    if (!same) return 0;
    requireSound(*same);
    require(same->unpaired_triangle_count == 0, "every triangle of a model has a partner in it");
    require(same->sign_change_count == 0 && same->tangents.max_deg < 0.001 && same->normals.max_deg < 0.001,
            "a model does not differ from itself");
    return 0;
}
