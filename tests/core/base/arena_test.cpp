// SPDX-License-Identifier: MIT
#include "tspace/execution.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>
#include <vector>

#ifdef __linux__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "tspace/normals.h"
#include "tspace/tangents.h"

namespace tspace {
namespace {

constexpr std::size_t kStep = std::size_t{2} << 20;

struct Block {
    std::uint8_t* memory;
    std::size_t bytes;
    std::uint8_t mark;
};

Block take(const Arena& arena, std::size_t bytes, std::uint8_t mark) {
    const Allocator& allocator = *arena.allocator();
    void* memory = allocator.allocate(allocator.user, bytes, 64);
    if (memory != nullptr) std::memset(memory, mark, bytes);
    return {static_cast<std::uint8_t*>(memory), bytes, mark};
}
void giveBack(const Arena& arena, const Block& block) {
    arena.allocator()->release(arena.allocator()->user, block.memory, block.bytes, 64);
}
bool isIntact(const Block& block) {
    return std::all_of(block.memory, block.memory + block.bytes, [&](std::uint8_t b) { return b == block.mark; });
}

RC_GTEST_PROP(Arena, NeverReturnsOverlappingBlocks, ()) {
    const Arena arena;
    std::vector<Block> live;
    std::size_t used = 0;
    const auto steps = *rc::gen::container<std::vector<std::pair<std::uint32_t, bool>>>(
        rc::gen::pair(rc::gen::inRange<std::uint32_t>(1, 300000), rc::gen::arbitrary<bool>()));
    std::uint8_t mark = 0;
    for (const auto& [number, gives_back] : steps) {
        if (gives_back && !live.empty()) {
            const std::size_t i = number % live.size();
            RC_ASSERT(isIntact(live[i]));
            giveBack(arena, live[i]);
            used -= (live[i].bytes + 63) / 64 * 64;
            live.erase(live.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            live.push_back(take(arena, number, ++mark));
            RC_ASSERT(live.back().memory != nullptr);
            RC_ASSERT(reinterpret_cast<std::uintptr_t>(live.back().memory) % 64 == 0);
            used += (live.back().bytes + 63) / 64 * 64;
        }
        RC_ASSERT(arena.usedBytes() == used);
        RC_ASSERT(arena.heldBytes() >= used);
    }
    for (const Block& block : live) {
        RC_ASSERT(isIntact(block));
        giveBack(arena, block);
    }
    RC_ASSERT(arena.usedBytes() == 0u);
}

RC_GTEST_PROP(Arena, AllocatesNothingForARepeatedCall, ()) {
    const Arena arena;
    const auto steps = *rc::gen::container<std::vector<std::pair<std::uint32_t, bool>>>(
        rc::gen::pair(rc::gen::inRange<std::uint32_t>(1, 3000000), rc::gen::arbitrary<bool>()));
    const auto run = [&] {
        std::vector<std::uint8_t*> places;
        std::vector<Block> live;
        for (const auto& [number, gives_back] : steps) {
            if (gives_back && !live.empty()) {
                giveBack(arena, live[number % live.size()]);
                live.erase(live.begin() + static_cast<std::ptrdiff_t>(number % live.size()));
            } else {
                live.push_back(take(arena, number, 1));
                places.push_back(live.back().memory);
            }
        }
        for (const Block& block : live) giveBack(arena, block);
        return places;
    };
    const std::vector<std::uint8_t*> places = run();
    const std::size_t held = arena.heldBytes();
    RC_ASSERT(run() == places);
    RC_ASSERT(arena.heldBytes() == held);
}

TEST(Arena, ReleasesMemoryWhenTrimmed) {
    Arena arena;
    const Block below = take(arena, 3 * kStep, 1), above = take(arena, 5 * kStep, 2);
    EXPECT_EQ(arena.heldBytes(), 8 * kStep);
    giveBack(arena, above);
    EXPECT_EQ(arena.heldBytes(), 8 * kStep);
    arena.trim();
    EXPECT_EQ(arena.heldBytes(), 3 * kStep);
    EXPECT_TRUE(isIntact(below));
    const Block again = take(arena, kStep, 3);
    EXPECT_TRUE(isIntact(again));
    giveBack(arena, again);
    giveBack(arena, below);
    arena.trim();
    EXPECT_EQ(arena.heldBytes(), 0u);
}

TEST(Arena, ReturnsNullForSizesThatNoSystemHas) {
    const Arena arena;
    const Allocator& allocator = *arena.allocator();
    for (const std::size_t bytes : {SIZE_MAX, SIZE_MAX - 4096, SIZE_MAX / 2}) {
        EXPECT_EQ(allocator.allocate(allocator.user, bytes, 64), nullptr);
    }
    EXPECT_EQ(arena.usedBytes(), 0u);
    giveBack(arena, take(arena, 100, 1));
}

#if defined(__linux__) && !defined(TSPACE_SANITIZED)
TEST(Arena, ReservesLittleIfAddressSpaceIsLimited) {
    const auto use = [] {
        const rlimit limit{std::size_t{1} << 30, std::size_t{1} << 30};
        if (setrlimit(RLIMIT_AS, &limit) != 0) return false;
        Arena arena;
        const std::vector<std::byte> others(std::size_t{256} << 20);
        std::vector<Block> blocks;
        for (std::uint8_t mark = 1; mark <= 10; ++mark) blocks.push_back(take(arena, std::size_t{30} << 20, mark));
        const bool is_sound =
            arena.heldBytes() >= std::size_t{300} << 20 && std::all_of(blocks.begin(), blocks.end(), isIntact);
        for (const Block& block : blocks) giveBack(arena, block);
        arena.trim();
        return is_sound && arena.heldBytes() == 0 && arena.usedBytes() == 0;
    };
    EXPECT_EXIT(std::exit(use() ? 0 : 1), testing::ExitedWithCode(0), "");
}

/// Returns the number of bytes of address space that this process has mapped.
std::size_t mappedBytes() {
    long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%ld", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return static_cast<std::size_t>(pages) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Uses an arena while `left` bytes of address space are free. Before that, memory is mapped at the place where an
/// arena that exceeds its reservation would write. Returns false if a byte of this memory changed, or if blocks
/// overlap.
bool stayInsideWith(std::size_t left) {
    constexpr std::size_t kNeighborBytes = std::size_t{16} << 20, kBlockBytes = std::size_t{1} << 19;
    void* const mapping = mmap(nullptr, kNeighborBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapping == MAP_FAILED) return false;
    const Block neighbor{static_cast<std::uint8_t*>(mapping), kNeighborBytes, 0x5a};
    std::memset(mapping, neighbor.mark, kNeighborBytes);
    const rlimit limit{mappedBytes() + left, mappedBytes() + left};
    if (setrlimit(RLIMIT_AS, &limit) != 0) return false;
    const Arena arena;
    std::vector<Block> blocks;
    for (std::uint8_t mark = 1; mark <= 8; ++mark) {
        const Block block = take(arena, kBlockBytes, mark);
        if (block.memory != nullptr) blocks.push_back(block);
    }
    const bool is_sound = isIntact(neighbor) && std::all_of(blocks.begin(), blocks.end(), isIntact);
    for (const Block& block : blocks) giveBack(arena, block);
    return is_sound && arena.usedBytes() == 0;
}

TEST(Arena, WritesOnlyToItsOwnMemoryIfAddressSpaceIsScarce) {
    for (std::size_t megabytes = 1; megabytes <= 72; ++megabytes) {
        EXPECT_EXIT(std::exit(stayInsideWith(megabytes << 20) ? 0 : 1), testing::ExitedWithCode(0), "")
            << megabytes << " MB left";
    }
}
#endif

/// A torus with two triangles per cell. The seams share their vertices.
struct Torus {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices;

    explicit Torus(std::uint32_t side) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const double a = 6.283185307 * x / side, b = 6.283185307 * y / side;
                const Vec3 n{static_cast<float>(std::cos(b) * std::cos(a)),
                             static_cast<float>(std::cos(b) * std::sin(a)), static_cast<float>(std::sin(b))};
                normals.push_back(n);
                positions.push_back(
                    {n.x + 3 * static_cast<float>(std::cos(a)), n.y + 3 * static_cast<float>(std::sin(a)), n.z});
                uvs.push_back({static_cast<float>(x), static_cast<float>(y)});
                const std::uint32_t right = (x + 1) % side, up = (y + 1) % side;
                for (const std::uint32_t v : {y * side + x, y * side + right, up * side + right, y * side + x,
                                              up * side + right, up * side + x}) {
                    indices.push_back(v);
                }
            }
        }
    }
    [[nodiscard]] MeshView view() const {
        MeshView mesh;
        mesh.positions = positions;
        mesh.normals = normals;
        mesh.uvs = uvs;
        mesh.indices = IndexView(std::span<const std::uint32_t>(indices));
        return mesh;
    }
};

/// Allocator that tracks the peak of live memory.
struct PeakAllocator {
    std::size_t live = 0, peak = 0;
    Allocator allocator{.allocate =
                            [](void* user, std::size_t bytes, std::size_t alignment) {
                                auto& self = *static_cast<PeakAllocator*>(user);
                                self.live += bytes;
                                self.peak = std::max(self.peak, self.live);
                                return ::operator new(bytes, std::align_val_t(alignment));
                            },
                        .release =
                            [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
                                static_cast<PeakAllocator*>(user)->live -= bytes;
                                ::operator delete(memory, std::align_val_t(alignment));
                            },
                        .user = this};
};

const std::vector<Method> kMethods{Method::mikktspace, Method::lengyel, Method::uniform, Method::angle, Method::area,
                                   Method::flat,       Method::basis,   Method::fast,    Method::best};

/// Calls all functions of the library that take an allocator.
void computeAll(const Torus& torus, Method method, const Allocator* allocator) {
    const Execution execution{.thread_count = 1, .allocator = allocator};
    std::vector<Vec3> normals(torus.indices.size());
    ASSERT_TRUE(generateNormals(torus.view(), {.crease_angle_deg = 30}, normals, execution));
    std::vector<Vec4> tangents(torus.indices.size());
    ASSERT_TRUE(generateTangents(torus.view(), {.method = method, .convention = conventions::opengl},
                                 {.tangents = tangents}, execution));
    tangents[5] = {};
    ASSERT_TRUE(sanitizeTangents(torus.view(), {}, tangents, execution));
}

#if defined(__GLIBC__) && !defined(TSPACE_SANITIZED)
TEST(Arena, KeepsMemoryInsteadOfThreads) {
    // Setting the threshold also stops glibc from adapting it, so that each large buffer gets fresh pages.
    mallopt(M_MMAP_THRESHOLD, 131072);
    const Torus torus(100);
    std::vector<Vec4> tangents(torus.indices.size());
    const auto faultsOfFourthCall = [&](const Allocator* allocator) {
        long faults = 0;
        std::thread([&] {
            for (int call = 0; call < 4; ++call) {
                rusage before{}, after{};
                getrusage(RUSAGE_THREAD, &before);
                EXPECT_TRUE(generateTangents(torus.view(), {.convention = conventions::opengl}, {.tangents = tangents},
                                             {.allocator = allocator}));
                getrusage(RUSAGE_THREAD, &after);
                faults = after.ru_minflt - before.ru_minflt;
            }
        }).join();
        return faults;
    };
    const Arena arena;
    EXPECT_LT(faultsOfFourthCall(arena.allocator()), 5);
    EXPECT_GT(faultsOfFourthCall(nullptr), 20);
}
#endif

TEST(Arena, ServesASecondCallFromItsMemory) {
    const Torus torus(150);
    for (const Method method : kMethods) {
        const Arena arena;
        computeAll(torus, method, arena.allocator());
        const std::size_t held = arena.heldBytes();
        EXPECT_GT(held, 0u);
        EXPECT_EQ(arena.usedBytes(), 0u);
        computeAll(torus, method, arena.allocator());
        EXPECT_EQ(arena.heldBytes(), held);
        computeAll(Torus(100), method, arena.allocator());
        EXPECT_EQ(arena.heldBytes(), held);
    }
}

TEST(Arena, ServesEvaluationsOfAPlanThatItHolds) {
    const Torus torus(150);
    const Arena arena;
    const Execution execution{.thread_count = 1, .allocator = arena.allocator()};
    {
        const Result<TangentPlan> plan = planTangents(torus.view(), {.convention = conventions::opengl}, execution);
        ASSERT_TRUE(plan);
        std::size_t held = 0;
        for (int frame = 0; frame < 3; ++frame) {
            std::vector<Vec4> tangents(torus.indices.size());
            const Pose pose{.positions = torus.positions, .normals = torus.normals};
            ASSERT_TRUE(evaluateTangents(*plan, pose, {.tangents = tangents}, execution));
            if (frame > 0) {
                EXPECT_EQ(arena.heldBytes(), held);
            }
            held = arena.heldBytes();
        }
        EXPECT_GT(arena.usedBytes(), 0u);
    }
    EXPECT_EQ(arena.usedBytes(), 0u);
}

TEST(Arena, UsesLittleMoreThanThePeakOfPlainAllocation) {
    const Torus torus(250);
    for (const Method method : kMethods) {
        PeakAllocator plain;
        computeAll(torus, method, &plain.allocator);
        const Arena arena;
        computeAll(torus, method, arena.allocator());
        EXPECT_LE(arena.heldBytes(), plain.peak + plain.peak / 5 + kStep) << static_cast<int>(method);
    }
}

}  // namespace
}  // namespace tspace
