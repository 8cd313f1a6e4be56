// SPDX-License-Identifier: MIT
// Time relative to the plain loop; both alternate in one process.
#include <algorithm>
#include <thread>

#include "job.h"
#include "plain_loop.h"
#include "race.h"
#include "rows.h"
#include "thread_count.h"
#include "tspace/execution.h"

namespace tspace::bench {

namespace {

struct Contest {
    std::string job;
    std::string mesh;  ///< "SIZE" is replaced by the size of the run
    std::optional<double> asked_one, asked_two;
    std::string simd = {};     ///< name of the SIMD target to use; empty: the best one
    bool any_threads = false;  ///< measures only the default number of threads, instead of one thread
};

/// If two concurrent plain loops take this many times as long as one, they did not each have a core.
constexpr double kBusy = 1.25;

std::string withSize(std::string mesh, const Lab& lab) {
    const std::size_t at = mesh.find("SIZE");
    return at == std::string::npos ? mesh : mesh.replace(at, 4, lab.size());
}

Cell cell(const Race& race, std::size_t runner, std::size_t base, std::size_t triangles, std::optional<double> asked,
          Clock clock) {
    const Race::Ratio ratio = race.ratio(runner, base, clock);
    return {ratio.median, ratio.low, ratio.high, asked,
            1e9 * race.best(runner, clock) / static_cast<double>(triangles)};
}

std::string inWords(double ns) {
    const std::string text = std::to_string(ns);
    return text.substr(0, text.find('.') + 2);
}

/// Runs the plain loop twice concurrently, to measure how much of a second core is available.
void plainLoopTwice(const Mesh& mesh, std::vector<Vec4>& tangents, std::vector<Vec4>& other_tangents) {
    std::thread other([&] { plainLoop(mesh, other_tangents); });
    plainLoop(mesh, tangents);
    other.join();
}

/// Returns whether the row can be measured and its results are correct; if not, the row states why.
bool isReady(RowResult& row, const Contest& contest, const std::string& mesh_name, Lab& lab) {
    const Mesh& mesh = lab.mesh(mesh_name);
    Execution probe;
    if (mesh.triangleCount() == 0) {
        row.note = "not there: " + mesh_name;
    } else if (!contest.simd.empty() && !forceSimd(probe, contest.simd)) {
        row.note = "not there yet: no choice of target";
    } else if (!makeJob(contest.job, mesh).outputs) {
        row.note = "not there yet";
    } else {
        row.note = lab.error(contest.job, mesh_name);
        row.wrong = !row.note.empty();
    }
    return row.note.empty();
}

/// Returns remarks about what influenced the times.
std::string remarks(const Contest& contest, const Mesh& mesh, const Job& job, std::size_t started_threads) {
    std::string text;
    if (contest.any_threads) text += "; threads started: " + std::to_string(started_threads);
    if (contest.job == "split") {
        const auto before = static_cast<double>(mesh.positions.size());
        const auto after = static_cast<double>(job.outputs->split.vertexCount());
        text += "; " + inWords(100 * (after / before - 1)) + " % split";
    }
    return text;
}

RowResult runContest(const std::string& title, const Contest& contest, Lab& lab) {
    RowResult row{.title = title};
    row.one_thread.asked = contest.asked_one;
    row.two_threads.asked = contest.asked_two;
    const std::string name = withSize(contest.mesh, lab);
    if (!isReady(row, contest, name, lab)) return row;

    const Mesh &mesh = lab.mesh(name), &plain_mesh = lab.plainMesh(name);
    const Job job = makeJob(contest.job, mesh);
    Execution one{.thread_count = contest.any_threads ? kAllThreads : 1u}, two{.thread_count = 2};
    forceSimd(one, contest.simd);
    forceSimd(two, contest.simd);
    std::vector<Vec4> plain_tangents(plain_mesh.positions.size()), other_tangents(plain_tangents.size());
    const std::size_t threads_before = startedThreads(), triangles = plain_mesh.triangleCount();
    const bool has_two = contest.asked_two.has_value();
    Race race;
    const std::size_t plain = race.add([&] { plainLoop(plain_mesh, plain_tangents); });
    const std::size_t single = race.add([&] { job.call(one); });
    const std::size_t both = has_two ? race.add([&] { job.call(two); }) : single;
    const std::size_t twice =
        has_two ? race.add([&] { plainLoopTwice(plain_mesh, plain_tangents, other_tangents); }) : plain;
    race.run(lab.rounds());
    row.one_thread = cell(race, single, plain, triangles, contest.asked_one, Clock::processor);
    row.note = "plain loop " + inWords(1e9 * race.best(plain) / static_cast<double>(triangles)) + " ns";
    if (has_two) {
        row.two_threads = cell(race, both, plain, triangles, contest.asked_two, Clock::wall);
        const double at_once = race.ratio(twice, plain, Clock::wall).median;
        row.two_threads.busy = at_once > kBusy;
        row.note += "; two loops at once " + inWords(at_once) + "x";
    }
    row.note += remarks(contest, mesh, job, startedThreads() - threads_before);
    return row;
}

Row contest(const std::string& title, const Contest& contest) {
    return {title, [=](Lab& lab) { return runContest(title, contest, lab); }};
}

/// Measures a mesh eight times as large. The value is its time per triangle, relative to the smaller mesh.
RowResult runGrowth(const std::string& title, Lab& lab) {
    RowResult row{.title = title};
    const std::string large_name = lab.quick() ? "torus_1M" : "torus_8M", small_name = "torus_" + lab.size();
    row.note = lab.error("mikktspace", large_name);
    if (!row.note.empty()) return row.wrong = true, row;
    const Mesh &small = lab.mesh(small_name), &large = lab.mesh(large_name);
    const Job small_job = makeJob("mikktspace", small), large_job = makeJob("mikktspace", large);
    const auto triangles = static_cast<double>(large.triangleCount());
    const double times_larger = triangles / static_cast<double>(small.triangleCount());
    const auto measure = [&](unsigned threads) {
        Race race;
        const Execution execution{.thread_count = threads};
        const std::size_t base = race.add([&] { small_job.call(execution); });
        const std::size_t grown = race.add([&] { large_job.call(execution); });
        race.run(std::max(3, lab.rounds() / 2));
        Cell result =
            cell(race, grown, base, large.triangleCount(), 1.35, threads == 1 ? Clock::processor : Clock::wall);
        for (double* value : {&*result.value, &result.low, &result.high}) *value /= times_larger;
        return result;
    };
    row.one_thread = measure(1);
    row.two_threads = measure(2);
    row.note = large_name + " against " + small_name;
    return row;
}

/// Measures the largest mesh with memory from the system, relative to memory that an arena keeps between calls.
RowResult runWithoutArena(const std::string& title, Lab& lab) {
    RowResult row{.title = title};
    row.note = lab.quick() ? "torus_1M" : "torus_8M";
    const Mesh& mesh = lab.mesh(row.note);
    const Job job = makeJob("mikktspace", mesh);
    Arena arena;
    Race race;
    const std::size_t kept = race.add([&] { job.call({.thread_count = 1, .allocator = arena.allocator()}); });
    const std::size_t fresh = race.add([&] { job.call({.thread_count = 1}); });
    race.run(std::max(3, lab.rounds() / 2));
    row.one_thread = cell(race, fresh, kept, mesh.triangleCount(), 1.15, Clock::processor);
    return row;
}

}  // namespace

std::vector<Row> speedRows() {
    std::vector<Row> rows = {
        contest("`mikktspace`, tangent + sign, indexed, natural order, best SIMD",
                {"mikktspace", "torus_SIZE", 5.0, 3.0}),
        contest("the same forced to SSE2", {"mikktspace", "torus_SIZE", 8.0, 4.8, "sse2"}),
        contest("the same, triangles in random order", {"mikktspace", "torus_SIZE_shuffled", 1.8, 1.1}),
        contest("`mikktspace`, unindexed corners", {"mikktspace", "soup_SIZE", 14.0, 8.0}),
        contest("all fields (bitangent, magnitudes)", {"mikktspace_all", "torus_SIZE", 6.0, 3.6}),
        contest("`evaluate` on a ready plan", {"evaluate", "torus_SIZE", 3.0, 1.8}),
        contest("`angle` with grouping", {"angle", "torus_SIZE", 4.5, 2.7}),
        contest("`area` with grouping", {"area", "torus_SIZE", 4.5, 2.7}),
        contest("`uniform` with grouping", {"uniform", "torus_SIZE", 4.5, 2.7}),
        contest("`fast`", {"fast", "torus_SIZE", 6.0, {}}),
        contest("`best`", {"best", "torus_SIZE", 12.0, {}}),
        contest("`lengyel`, a result per vertex as in the plain loop", {"lengyel_vertex", "torus_SIZE", 0.8, 0.5}),
        contest("`lengyel`, a result per corner", {"lengyel", "torus_SIZE", 0.8, 0.5}),
        contest("normals, angle-weighted", {"normals", "torus_SIZE", 2.0, 1.2}),
        contest("normals with a crease angle of 30 degrees", {"normals_crease", "torus_SIZE", 6.0, {}}),
    };
    const std::string growth = "8M triangles: `mikktspace` per triangle against its own 1M figure";
    rows.push_back({growth, [=](Lab& lab) { return runGrowth(growth, lab); }});
    const std::string arena = "8M triangles: without an arena against with one";
    rows.push_back({arena, [=](Lab& lab) { return runWithoutArena(arena, lab); }});
    rows.push_back(contest("small meshes: 200 triangles, per call", {"mikktspace", "small", 12.0, {}, {}, true}));
    for (const char* name :
         {"cube", "doomcone", "doomcone_smooth", "crangeract", "obliterated", "rancid_geometry", "tangeract"}) {
        const std::string title = std::string("torture: ") + name, file = std::string("models/obj/mikktspace/") + name;
        rows.push_back({title, [=](Lab& lab) {
                            return runContest(title, {"mikktspace", lab.shared(file + ".obj"), 15.0, {}}, lab);
                        }});
    }
    rows.push_back(contest("split (10 % of vertices split)", {"split", "folds_SIZE", 2.0, {}}));
    return rows;
}

}  // namespace tspace::bench
