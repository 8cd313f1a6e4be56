// SPDX-License-Identifier: MIT
// Rows over many meshes: models as stored in their files, tori of all sizes at which the reference's last-bucket rule
// may matter, triangles in other orders, and sizes at which threads may not be worthwhile.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "job.h"
#include "plain_loop.h"
#include "race.h"
#include "rows.h"

namespace tspace::bench {

namespace {

/// Measurement of two alternating calls on one mesh.
struct Pair {
    double seconds = 0, base_seconds = 0;  ///< seconds per call in the best round
    double ratio = 0;                      ///< median over rounds
    std::size_t triangles = 0;
};

template <class Call, class Base>
Pair race(const Mesh& mesh, int rounds, Clock clock, Call&& call, Base&& base) {
    Race race;
    const std::size_t b = race.add(base), c = race.add(call);
    race.run(rounds);
    return {race.best(c, clock), race.best(b, clock), race.ratio(c, b, clock).median, mesh.triangleCount()};
}

std::string inWords(double value) {
    const std::string text = std::to_string(value);
    return text.substr(0, text.find('.') + 3);
}

/// Sets the row's value to the ratio of the worst mesh.
void summarize(const std::vector<Pair>& pairs, double asked, RowResult& row) {
    if (pairs.empty()) return void(row.note = "no meshes");
    const auto worst = std::ranges::max_element(pairs, {}, &Pair::ratio);
    row.one_thread.value = worst->ratio;
    row.one_thread.asked = asked;
    row.note = std::to_string(pairs.size()) + (pairs.size() == 1 ? " mesh" : " meshes") + "; worst at " +
               std::to_string(worst->triangles) + " triangles";
}

/// Sets the row's value to the ratio of the total times.
void summarizeTotal(std::vector<Pair> pairs, RowResult& row) {
    if (pairs.empty()) return void(row.note = "no meshes");
    double seconds = 0, base_seconds = 0;
    std::size_t triangles = 0;
    for (const Pair& pair : pairs) {
        seconds += pair.seconds;
        base_seconds += pair.base_seconds;
        triangles += pair.triangles;
    }
    std::ranges::sort(pairs, {}, &Pair::ratio);
    row.one_thread.value = seconds / base_seconds;
    row.one_thread.ns = 1e9 * seconds / static_cast<double>(triangles);
    row.note = std::to_string(pairs.size()) + " primitives, " + std::to_string(triangles) + " triangles; median " +
               inWords(pairs[pairs.size() / 2].ratio) + ", worst " + inWords(pairs.back().ratio);
}

Row models(const std::string& title, std::size_t least, std::size_t most) {
    return {
        title, [=](Lab& lab) {
            RowResult row{.title = title};
            std::vector<Pair> pairs;
            for (const Mesh& mesh : lab.primitives()) {
                if (mesh.triangleCount() < least || mesh.triangleCount() > most) continue;
                const Job job = makeJob("mikktspace", mesh);
                std::vector<Vec4> tangents(mesh.positions.size());
                const Execution one{.thread_count = 1};
                pairs.push_back(race(
                    mesh, lab.rounds(), Clock::processor, [&] { job.call(one); }, [&] { plainLoop(mesh, tangents); }));
            }
            return summarizeTotal(std::move(pairs), row), row;
        }};
}

/// Compares Pairing::reference with Pairing::corrected. The former also determines whether the reference's last bucket
/// affects the result.
Pair racePairings(const Mesh& mesh, int rounds) {
    const Job reference = makeJob("mikktspace", mesh), corrected = makeJob("mikktspace_corrected", mesh);
    const Execution one{.thread_count = 1};
    return race(
        mesh, rounds, Clock::processor, [&] { reference.call(one); }, [&] { corrected.call(one); });
}

std::vector<Row> lastBucketRows() {
    const std::string tori = "`reference` against `corrected` pairing, tori";
    const std::string primitives = "`reference` against `corrected` pairing, models of 500 triangles and more";
    return {{tori,
             [=](Lab& lab) {
                 RowResult row{.title = tori};
                 std::vector<Pair> pairs;
                 for (std::uint32_t rows = 5; rows <= 95; ++rows)
                     pairs.push_back(racePairings(torus(2 * rows, rows, std::max(1u, rows / 5)), lab.rounds()));
                 return summarize(pairs, 1.3, row), row;
             }},
            {primitives, [=](Lab& lab) {
                 RowResult row{.title = primitives};
                 std::vector<Pair> pairs;
                 for (const Mesh& mesh : lab.primitives())
                     if (mesh.triangleCount() >= 500) pairs.push_back(racePairings(mesh, lab.rounds()));
                 return summarize(pairs, 1.3, row), row;
             }}};
}

const std::vector<std::string> kOrderSizes = {"2k", "5k", "10k", "20k", "100k", "300k"};

std::string torusName(const std::string& size, const std::string& order) {
    return "torus_" + size + (order == "natural" ? "" : "_" + order);
}

/// Compares tori with their triangles in the order `name` with tori in natural order. `sizes`: empty for the size of
/// the run.
Row order(const std::string& title, const std::string& name, std::vector<std::string> sizes, double asked) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title};
                std::vector<Pair> pairs;
                for (const std::string& size : sizes.empty() ? std::vector{lab.size()} : sizes) {
                    row.note = lab.error("mikktspace", torusName(size, name));
                    if (!row.note.empty()) return row.wrong = true, row;
                    const Mesh& mesh = lab.mesh(torusName(size, name));
                    const Job other = makeJob("mikktspace", mesh);
                    const Job natural = makeJob("mikktspace", lab.mesh(torusName(size, "natural")));
                    const Execution one{.thread_count = 1};
                    pairs.push_back(race(
                        mesh, lab.rounds(), Clock::processor, [&] { other.call(one); }, [&] { natural.call(one); }));
                }
                return summarize(pairs, asked, row), row;
            }};
}

std::vector<Row> orderRows() {
    std::vector<Row> rows;
    for (const std::string& name : triangleOrders()) {
        const std::string words = "triangles in the order `" + name + "` against natural order, tori of ";
        const bool is_random = name == "shuffled";
        rows.push_back(order(words + "2k to 300k", name, kOrderSizes, is_random ? 2.2 : 1.6));
        rows.push_back(order(words + "1M", name, {}, is_random ? 2.7 : 2.0));
    }
    const std::string pairings = "`reference` against `corrected` pairing, tori of 2k to 1M in all orders";
    rows.push_back({pairings, [=](Lab& lab) {
                        RowResult row{.title = pairings};
                        std::vector<Pair> pairs;
                        std::vector<std::string> sizes = kOrderSizes, names = triangleOrders();
                        sizes.push_back(lab.size());
                        names.push_back("natural");
                        for (const std::string& size : sizes) {
                            for (const std::string& name : names)
                                pairs.push_back(racePairings(lab.mesh(torusName(size, name)), lab.rounds()));
                        }
                        return summarize(pairs, 1.3, row), row;
                    }});
    return rows;
}

/// Compares `thread_count` threads (kAllThreads: one per core) with one thread, for tori of these sizes.
Row threads(const std::string& title, unsigned thread_count, std::vector<std::size_t> sizes) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title};
                std::vector<Pair> pairs;
                for (const std::size_t size : sizes) {
                    const Mesh mesh = torusOf(size);
                    const Job job = makeJob("mikktspace", mesh);
                    pairs.push_back(race(
                        mesh, lab.rounds(), Clock::wall, [&] { job.call({.thread_count = thread_count}); },
                        [&] { job.call({.thread_count = 1}); }));
                }
                return summarize(pairs, 1.05, row), row;
            }};
}

/// Compares two threads with one thread, for a single call that processes `box_count` boxes.
Row meshJobs(const std::string& title, std::size_t box_count) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title};
                const Mesh box = boxMesh();
                const std::size_t corners = box.cornerCount();
                std::vector<Vec4> tangents(box_count * corners);
                std::vector<MeshJob> jobs(box_count);
                for (std::size_t i = 0; i < box_count; ++i) {
                    const std::span<Vec4> own(tangents.data() + i * corners, corners);
                    jobs[i] = {box.view(), {.convention = conventions::opengl}, {.tangents = own}};
                }
                const auto generate = [&](unsigned threads) {
                    return [&jobs, threads] {
                        if (!generateTangents(jobs, {.thread_count = threads})) std::abort();
                    };
                };
                const Pair pair = race(box, lab.rounds(), Clock::wall, generate(2), generate(1));
                return summarize({pair}, 0.59, row), row;
            }};
}

/// Compares plans of 100 characters, evaluated one after the other, with plain loops over the same characters. Each
/// character has its own arrays, as in a frame of a game.
Row characters(const std::string& title, const std::string& job_name) {
    return {title, [=](Lab& lab) {
                RowResult row{.title = title};
                std::vector<Pair> pairs;
                for (const std::size_t size : {2000, 5000, 10000, 20000}) {
                    const std::vector<Mesh> meshes(100, torusOf(size));
                    std::vector<Job> jobs;
                    for (const Mesh& mesh : meshes) jobs.push_back(makeJob(job_name, mesh));
                    std::vector<std::vector<Vec4>> tangents(meshes.size(),
                                                            std::vector<Vec4>(meshes[0].positions.size()));
                    const Arena arena;
                    const Execution one{.thread_count = 1, .allocator = arena.allocator()};
                    const auto evaluate = [&] {
                        for (const Job& job : jobs) job.call(one);
                    };
                    const auto loop = [&] {
                        for (std::size_t i = 0; i < meshes.size(); ++i) plainLoop(meshes[i], tangents[i]);
                    };
                    pairs.push_back(race(meshes[0], lab.rounds(), Clock::processor, evaluate, loop));
                    row.note += (row.note.empty() ? "" : ", ") + inWords(pairs.back().ratio);
                }
                const std::string ratios = row.note;
                summarize(pairs, 1.5, row);
                row.note = "2k, 5k, 10k and 20k triangles: " + ratios;
                return row;
            }};
}

Row smallCall(const std::string& title) {
    return {title, [=](Lab& lab) {
                constexpr int kCalls = 1000;  // one call is too short for the clock, and depends on the caches
                RowResult row{.title = title, .unit = " us"};
                const Mesh mesh = boxMesh();
                const Job job = makeJob("mikktspace", mesh);
                Race race;
                const std::size_t calls = race.add([&] {
                    for (int call = 0; call < kCalls; ++call) job.call({.thread_count = 1});
                });
                race.run(lab.rounds());
                row.one_thread.value = 1e6 * race.best(calls) / kCalls;
                row.one_thread.asked = 1.2;
                row.note = std::to_string(mesh.triangleCount()) + " triangles";
                return row;
            }};
}

}  // namespace

std::vector<Row> manyMeshRows() {
    constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
    std::vector<Row> rows = {
        models("models, up to 50 triangles", 1, 50),
        models("models, 51 to 500 triangles", 51, 500),
        models("models, 501 to 5000 triangles", 501, 5000),
        models("models, above 5000 triangles", 5001, kAny),
        models("models, all", 1, kAny),
        threads("two threads against one, 7k to 25k triangles", 2, {7000, 10000, 14000, 18000, 25000}),
        threads("all threads against one, 100 to 500 triangles", kAllThreads, {100, 200, 300, 400, 500}),
        meshJobs("10,000 boxes in one call, two threads against one", 10000),
        characters("a frame of 100 characters, `evaluate` with `mikktspace`, a result per corner", "evaluate"),
        characters("a frame of 100 characters, `evaluate` with `lengyel`, a result per vertex", "evaluate_lengyel"),
        smallCall("a call for a box of 12 triangles")};
    std::ranges::move(lastBucketRows(), std::back_inserter(rows));
    std::ranges::move(orderRows(), std::back_inserter(rows));
    return rows;
}

}  // namespace tspace::bench
