// SPDX-License-Identifier: MIT
// mikktspace_hashes [GOLDEN]: prints hashes of all outputs of tspace_generateTangents and tspace_genTangSpace, for the
// golden meshes in the folder GOLDEN and for generated meshes; then the error for another method. The core as a whole
// and with TSPACE_MIKKTSPACE_ONLY must print the same lines except the last.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "support/golden_file.h"
#include "tspace/compat/mikktspace.h"
#include "tspace/tspace.h"

namespace {

struct Mesh {
    std::string name;
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices, normal_indices, face_sizes;

    [[nodiscard]] std::size_t cornerCount() const { return indices.empty() ? positions.size() / 3 : indices.size(); }
    [[nodiscard]] tspace_Mesh view() const {
        const auto listOf = [](const std::vector<std::uint32_t>& list) {
            return tspace_Indices{list.data(), list.size(), list.empty() ? TSPACE_INDEX_NONE : TSPACE_INDEX_U32};
        };
        tspace_Mesh mesh;
        TSPACE_INIT(mesh);
        mesh.positions = {positions.data(), positions.size() / 3, 0};
        mesh.normals = {normals.data(), normals.size() / 3, 0};
        mesh.uvs = {uvs.data(), uvs.size() / 2, 0};
        mesh.indices = listOf(indices);
        mesh.normal_indices = listOf(normal_indices);
        mesh.face_sizes = face_sizes.data();
        mesh.face_count = face_sizes.size();
        return mesh;
    }
};

/// Hash of floats. All NaNs are equal.
struct Hash {
    std::uint64_t value = 0xcbf29ce484222325u;
    void add(std::uint32_t word) { value = (value ^ word) * 0x100000001b3u; }
    void add(const std::vector<float>& list) {
        for (const float x : list) add(x == x ? std::bit_cast<std::uint32_t>(x) : 0x7fc00000u);
    }
};

Mesh readGolden(const std::filesystem::path& path) {
    const tspace::test::GoldenFile file(path);
    Mesh mesh;
    mesh.name = path.filename().string();
    mesh.face_sizes = file.face_sizes;
    for (std::size_t corner = 0; corner < file.inputs.size() / tspace::test::GoldenFile::kInputWords; ++corner) {
        const auto add = [&](std::vector<float>& to, std::size_t first, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) to.push_back(std::bit_cast<float>(file.input(corner)[first + i]));
        };
        add(mesh.positions, 0, 3);
        add(mesh.normals, 3, 3);
        add(mesh.uvs, 6, 2);
    }
    return mesh;
}

/// Returns a rough sheet, mirrored in bands, of faces with 3 to `most` corners, and, with `flat`, a normal per face.
/// Uses only integers, whose results the standard defines.
Mesh makeSheet(std::uint32_t side, std::uint32_t most, bool flat) {
    std::mt19937 random(side);
    const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random()) % limit; };
    const auto noise = [&] { return static_cast<float>(below(1u << 20)) / (1u << 21) - 0.25f; };
    Mesh mesh;
    mesh.name = "sheet " + std::to_string(side) + ' ' + std::to_string(most) + (flat ? " flat" : "");
    for (std::uint32_t v = 0; v < side * side; ++v) {
        const auto x = static_cast<float>(v % side), y = static_cast<float>(v / side);
        const float along = v % side < side / 2 ? x : static_cast<float>(side) - x;
        mesh.positions.insert(mesh.positions.end(), {x + noise(), y + noise(), noise()});
        mesh.normals.insert(mesh.normals.end(), {noise(), noise(), 1 + noise()});
        mesh.uvs.insert(mesh.uvs.end(), {0.1f * along, 0.1f * y + 0.1f * noise()});
    }
    for (std::uint32_t v = 0; v + side + 2 < side * side; ++v) {
        if (v % side + 3 > side) continue;
        const std::uint32_t ring[] = {v, v + 1, v + 2, v + 2 + side, v + 1 + side, v + side};
        const std::uint32_t size = 3 + below(most - 2);
        mesh.face_sizes.push_back(size);
        mesh.indices.insert(mesh.indices.end(), ring + (size < 4 ? 3 : 0), ring + (size < 4 ? 3 : 0) + size);
        if (flat) mesh.normal_indices.insert(mesh.normal_indices.end(), size, v);
    }
    return mesh;
}

void printArrays(const Mesh& mesh) {
    const std::size_t count = mesh.cornerCount();
    std::vector<float> tangents(4 * count), bitangents(3 * count), magnitudes(2 * count);
    std::vector<std::uint8_t> has_tangent(count);
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    Hash hash;
    unsigned failed = 0;
    const auto generate = [&](const tspace_TangentOptions& options, const tspace_Execution& execution) {
        tspace_TangentReport report;
        TSPACE_INIT(report);
        tspace_Error error;
        const tspace_Mesh view = mesh.view();
        failed += tspace_generateTangents(&view, &options, &out, &execution, &report, &error) == TSPACE_OK ? 0 : 1;
        for (const std::uint64_t number : {report.triangle_count, report.group_count, report.default_corner_count,
                                           report.mirrored_count, report.degenerate_uv_count, report.not_finite_count})
            hash.add(static_cast<std::uint32_t>(number));
        hash.add(tangents);
        hash.add(bitangents);
        hash.add(magnitudes);
        for (const std::uint8_t has : has_tangent) hash.add(has);
    };
    for (const bool full : {false, true}) {
        out.tangents = {tangents.data(), count, 0};
        if (full) {
            out.bitangents = {bitangents.data(), count, 0};
            out.magnitudes_s = {magnitudes.data(), count, 0};
            out.magnitudes_t = {magnitudes.data() + count, count, 0};
            out.has_tangent = {has_tangent.data(), count, 0};
        }
        for (const tspace_SimdTarget simd : {TSPACE_SIMD_BEST, TSPACE_SIMD_SSE2}) {
            for (std::uint32_t i = 0; i < 16; ++i) {
                tspace_TangentOptions options;
                TSPACE_INIT(options);
                tspace_Execution execution;
                TSPACE_INIT(execution);
                execution.simd = simd;
                execution.thread_count = 1 + (i & 1);
                options.convention.v_axis = TSPACE_V_DOWN;
                options.pairing = (i & 2) != 0 ? TSPACE_PAIRING_CORRECTED : TSPACE_PAIRING_REFERENCE;
                options.angular_threshold_deg = (i & 4) != 0 ? 40.0f : 180.0f;
                options.ngons = (i & 8) != 0 ? TSPACE_NGONS_SKIP : TSPACE_NGONS_TRIANGULATE;
                options.normalize_normals = full ? 1 : 0;
                generate(options, execution);
            }
        }
    }
    std::printf("%-24s %016llx, %u failed\n", mesh.name.c_str(), static_cast<unsigned long long>(hash.value), failed);
}

/// A mesh without indices, and the hash of the drop-in's results.
struct DropIn {
    const Mesh& mesh;
    std::vector<std::size_t> first_corners;
    Hash hash;

    static DropIn& of(const SMikkTSpaceContext* context) { return *static_cast<DropIn*>(context->m_pUserData); }
    static int faceCount(const SMikkTSpaceContext* context) {
        return static_cast<int>(of(context).mesh.face_sizes.size());
    }
    static int faceSize(const SMikkTSpaceContext* context, const int face) {
        return static_cast<int>(of(context).mesh.face_sizes[static_cast<std::size_t>(face)]);
    }
    template <std::vector<float> Mesh::*attribute, std::size_t count>
    static void get(const SMikkTSpaceContext* context, float out[], const int face, const int vertex) {
        const DropIn& self = of(context);
        const std::size_t corner =
            self.first_corners[static_cast<std::size_t>(face)] + static_cast<std::size_t>(vertex);
        for (std::size_t i = 0; i < count; ++i) out[i] = (self.mesh.*attribute)[count * corner + i];
    }
    static void set(const SMikkTSpaceContext* context, const float tangent[], const float bitangent[],
                    const float mag_s, const float mag_t, const tbool preserving, const int face, const int vertex) {
        Hash& hash = of(context).hash;
        hash.add({tangent[0], tangent[1], tangent[2], bitangent[0], bitangent[1], bitangent[2], mag_s, mag_t});
        for (const int number : {preserving, face, vertex}) hash.add(static_cast<std::uint32_t>(number));
    }
};

void printDropIn(const Mesh& mesh) {
    DropIn drop_in{mesh, {}, {}};
    std::size_t corner = 0;
    for (const std::uint32_t size : mesh.face_sizes) {
        drop_in.first_corners.push_back(corner);
        corner += size;
    }
    SMikkTSpaceInterface calls = {DropIn::faceCount,
                                  DropIn::faceSize,
                                  DropIn::get<&Mesh::positions, 3>,
                                  DropIn::get<&Mesh::normals, 3>,
                                  DropIn::get<&Mesh::uvs, 2>,
                                  nullptr,
                                  DropIn::set};
    const SMikkTSpaceContext context = {&calls, &drop_in};
    drop_in.hash.add(static_cast<std::uint32_t>(genTangSpaceDefault(&context)));
    drop_in.hash.add(static_cast<std::uint32_t>(tspace_genTangSpace(&context, 60, nullptr)));
    std::printf("%-24s %016llx\n", "  drop-in", static_cast<unsigned long long>(drop_in.hash.value));
}

void printOtherMethod(const Mesh& mesh) {
    const tspace_Mesh view = mesh.view();
    std::vector<float> tangents(4 * mesh.cornerCount());
    tspace_TangentOptions options;
    TSPACE_INIT(options);
    options.convention.v_axis = TSPACE_V_UP;
    options.method = TSPACE_METHOD_BEST;
    tspace_TangentOutput out;
    TSPACE_INIT(out);
    out.tangents = {tangents.data(), mesh.cornerCount(), 0};
    tspace_Error error;
    const tspace_ErrorCode code = tspace_generateTangents(&view, &options, &out, nullptr, nullptr, &error);
    std::printf("best: %u %s\n", static_cast<unsigned>(code), error.message);
}

}  // namespace

int main(int argument_count, char** arguments) {
    std::vector<std::filesystem::path> golden;
    if (argument_count > 1) {
        for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) {
            if (entry.path().extension() == ".tsg") golden.push_back(entry.path());
        }
    }
    std::sort(golden.begin(), golden.end());
    for (const std::filesystem::path& path : golden) {
        const Mesh mesh = readGolden(path);
        printArrays(mesh);
        printDropIn(mesh);
    }
    // The largest sheet has enough corners for two threads.
    for (const std::uint32_t side : {4u, 12u, 40u, 200u}) {
        for (const std::uint32_t most : {3u, 4u, 6u}) {
            printArrays(makeSheet(side, most, false));
            printArrays(makeSheet(side, most, true));
        }
    }
    printOtherMethod(makeSheet(4, 3, false));
    return 0;
}
