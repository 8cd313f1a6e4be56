// SPDX-License-Identifier: MIT
#include "maps/rays/rays.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

#ifdef TSPACE_HAS_EMBREE
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "images/loaded_library.h"
#endif

#include "core/base/border.h"
#include "tspace/maps.h"

namespace tspace {

PositionBox::PositionBox(const StridedSpan<const Vec3>& points) {
    for (std::size_t i = 0; i < points.count; ++i) {
        if (isFinite(points[i])) add(toDouble(points[i]));
    }
}

void PositionBox::add(const DVec3& point) {
    least = {std::fmin(least.x, point.x), std::fmin(least.y, point.y), std::fmin(least.z, point.z)};
    most = {std::fmax(most.x, point.x), std::fmax(most.y, point.y), std::fmax(most.z, point.z)};
}

double PositionBox::difference(const PositionBox& other) const {
    const DVec3 a = least - other.least, b = most - other.most;
    return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z), std::fabs(b.x), std::fabs(b.y), std::fabs(b.z)});
}

bool PositionBox::meets(const PositionBox& other, double margin) const {
    return least.x - margin <= other.most.x && other.least.x - margin <= most.x && least.y - margin <= other.most.y &&
           other.least.y - margin <= most.y && least.z - margin <= other.most.z && other.least.z - margin <= most.z;
}

#ifdef TSPACE_HAS_EMBREE

namespace {

/// Functions of Embree that are used. The library is installed separately, and loaded at run time.
struct Embree {
    /// Embree 3 and TBB take 47 MB after loading. Their constructors terminate the process if memory runs out, so this
    /// much must be available.
    static constexpr std::size_t kLoadedBytes = std::size_t{64} << 20;
    LoadedLibrary library = LoadedLibrary(TSPACE_EMBREE_LIBRARY, kLoadedBytes);
    decltype(&rtcNewDevice) newDevice = library.find("rtcNewDevice");
    decltype(&rtcReleaseDevice) releaseDevice = library.find("rtcReleaseDevice");
    decltype(&rtcGetDeviceError) getDeviceError = library.find("rtcGetDeviceError");
    decltype(&rtcNewScene) newScene = library.find("rtcNewScene");
    decltype(&rtcReleaseScene) releaseScene = library.find("rtcReleaseScene");
    decltype(&rtcSetSceneFlags) setSceneFlags = library.find("rtcSetSceneFlags");
    decltype(&rtcJoinCommitScene) joinCommitScene = library.find("rtcJoinCommitScene");
    decltype(&rtcNewGeometry) newGeometry = library.find("rtcNewGeometry");
    decltype(&rtcReleaseGeometry) releaseGeometry = library.find("rtcReleaseGeometry");
    decltype(&rtcSetSharedGeometryBuffer) setSharedGeometryBuffer = library.find("rtcSetSharedGeometryBuffer");
    decltype(&rtcSetGeometryIntersectFilterFunction) setGeometryIntersectFilterFunction =
        library.find("rtcSetGeometryIntersectFilterFunction");
    decltype(&rtcCommitGeometry) commitGeometry = library.find("rtcCommitGeometry");
    decltype(&rtcAttachGeometry) attachGeometry = library.find("rtcAttachGeometry");
    decltype(&rtcIntersect1) intersect1 = library.find("rtcIntersect1");
    decltype(&rtcIntersect16) intersect16 = library.find("rtcIntersect16");
    decltype(&rtcSetGeometryOccludedFilterFunction) setGeometryOccludedFilterFunction =
        library.find("rtcSetGeometryOccludedFilterFunction");
    decltype(&rtcOccluded1) occluded1 = library.find("rtcOccluded1");
    bool is_loaded = library.hasAll();
};

const Embree& embree() {
    static const Embree loaded;
    return loaded;
}

/// true: Embree ran out of memory in this process and must not be called again.
std::atomic<bool> has_embree_failed = false;

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

constexpr std::uint32_t kNothingSkipped = 0xffffffffu;

/// Intersection of a line with the plane of a triangle.
struct PlanePoint {
    double distance = 0;
    std::array<double, 3> weights = {};
};

}  // namespace

struct RaySurface::State {
    StridedSpan<const Vec3> positions;
    std::span<const std::uint32_t> corners, groups;
    // Coordinates for Embree: the surface is moved and scaled into the unit cube, because Embree drops very large
    // triangles and rounds bounding boxes.
    DVec3 center = {};
    double scale = 1, size = 1;     ///< size of the surface: 1 / scale
    std::vector<Vec4> placed = {};  // scaled positions, 16 bytes each, as Embree requires
    RTCDevice device = nullptr, second_device = nullptr;
    RTCScene scene = nullptr;

    /// Leaks all Embree objects, and returns an out-of-memory error. Embree devices share state whose locks stay locked
    /// after a failed call: releasing the objects, or creating another device, would wait forever.
    Error abandon() {
        has_embree_failed = true;
        scene = nullptr;
        device = second_device = nullptr;
        return makeError(ErrorCode::outOfMemory, kNoElement, "there is not enough memory for the ray tracing data");
    }

    ~State() {
        if (scene != nullptr) embree().releaseScene(scene);
        if (device != nullptr) embree().releaseDevice(device);
        if (second_device != nullptr) embree().releaseDevice(second_device);
    }

    /// Intersects the line along `direction` with a triangle. Returns false if the line misses the triangle or does not
    /// hit its front.
    bool meet(std::uint32_t triangle, const DVec3& from, const DVec3& direction, PlanePoint& point) const {
        std::array<DVec3, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) corner[i] = toDouble(positions[corners[3 * triangle + i]]) - from;
        const DVec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
        const double slope = dot(normal, direction);
        if (!(slope < 0)) return false;
        point.distance = dot(normal, corner[0]) / slope;
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double volume = dot(direction, cross(corner[(i + 1) % 3], corner[(i + 2) % 3]));
            point.weights[i] = std::max(0.0, -volume);
            sum += point.weights[i];
        }
        if (!(sum > 0)) return false;
        const double part = 1 / sum;
        for (double& weight : point.weights) weight *= part;
        return std::isfinite(point.distance);
    }
};

namespace {

/// Triangles that a query searches for along a line.
enum class Wanted : std::uint8_t {
    nearest,  ///< the triangle nearest to `from`, on either side
    first,    ///< the first front face along the direction
    last,     ///< the last front face along the direction
    any,      ///< the first triangle along the direction, facing either way
    all       ///< all triangles, whose front and back faces are counted
};

/// A line and its best hit so far.
struct Query {
    const RaySurface::State* surface = nullptr;
    RayLine line = {};  ///< `outward` is the direction of the search
    Wanted wanted = Wanted::nearest;
    std::uint32_t skipped = kNothingSkipped;  ///< triangle to ignore
    bool is_hit = false;
    RayHit best = {};
    RayCrossings crossings = {};

    /// Returns the rank of a hit at a distance: the hit with the lowest rank is the best.
    [[nodiscard]] double rank(double distance) const {
        return wanted == Wanted::nearest ? std::fabs(distance) : wanted == Wanted::last ? -distance : distance;
    }
    [[nodiscard]] bool reaches(double distance) const {
        if (wanted == Wanted::nearest)
            return std::fabs(distance) <= std::max(std::fabs(line.begin), std::fabs(line.end));
        return distance >= line.begin && distance <= line.end;
    }
};

/// Arguments of one Embree call for one or more lines. The context must be the first member, because filter functions
/// get a pointer to it.
struct Shot {
    QueryContext context;
    Query* queries;

    Shot(Query* of, bool is_coherent) : queries(of) {
#if RTC_VERSION_MAJOR >= 4
        rtcInitRayQueryContext(&context);
        static_cast<void>(is_coherent);
#else
        rtcInitIntersectContext(&context);
        if (is_coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
    }
};

/// Calls visit(query, triangle, valid) for each valid ray of an Embree filter call; setting `valid` to 0 rejects the
/// triangle.
template <class Visit>
void forLines(const RTCFilterFunctionNArguments* arguments, const Visit& visit) {
    const auto& shot = *reinterpret_cast<const Shot*>(arguments->context);
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        if (arguments->valid[i] == 0) continue;
        visit(shot.queries[RTCRayN_id(arguments->ray, count, i)], RTCHitN_primID(arguments->hit, count, i),
              arguments->valid[i]);
    }
}

/// Counts a triangle that is hit from the front or from behind.
void countCrossing(Query& query, std::uint32_t triangle) {
    for (const double sign : {1.0, -1.0}) {
        PlanePoint point;
        if (!query.surface->meet(triangle, query.line.from, sign * query.line.outward, point)) continue;
        if (query.reaches(sign * point.distance)) ++(sign > 0 ? query.crossings.fronts : query.crossings.backs);
    }
}

/// Intersects the line with the front or the back of a triangle. Returns false if the line misses the triangle.
bool meetEitherSide(const Query& query, std::uint32_t triangle, PlanePoint& point) {
    if (query.surface->meet(triangle, query.line.from, query.line.outward, point)) return true;
    if (!query.surface->meet(triangle, query.line.from, -1.0 * query.line.outward, point)) return false;
    point.distance = -point.distance;
    return true;
}

/// Embree filter: accepts triangles that block a line. Rejects all others, so that Embree continues its search.
void acceptBlocking(const RTCFilterFunctionNArguments* arguments) {
    forLines(arguments, [](const Query& query, std::uint32_t triangle, int& valid) {
        PlanePoint point;
        const bool is_met =
            triangle != query.skipped && meetEitherSide(query, triangle, point) && query.reaches(point.distance);
        if (!is_met) valid = 0;
    });
}

/// Updates the best hit of a line with a triangle that the line hits.
void takeHit(Query& query, std::uint32_t triangle) {
    if (!query.surface->groups.empty() && query.line.group != kEveryGroup) {
        const std::uint32_t group = query.surface->groups[triangle];
        if (group != query.line.group && group != kEveryGroup) return;
    }
    if (query.wanted == Wanted::all) {
        countCrossing(query, triangle);
        return;
    }
    PlanePoint point;
    const bool is_met = query.wanted == Wanted::any
                            ? triangle != query.skipped && meetEitherSide(query, triangle, point)
                            : query.surface->meet(triangle, query.line.from, query.line.outward, point);
    if (!is_met || !query.reaches(point.distance)) return;
    const double rank = query.rank(point.distance), best = query.is_hit ? query.rank(query.best.distance) : 0;
    if (query.is_hit && !(rank < best || (rank == best && triangle < query.best.triangle))) return;
    query.is_hit = true;
    query.best = {triangle, point.weights, point.distance};
}

/// Embree filter: records hits. Rejects every triangle, so that Embree visits all others.
void collectHits(const RTCFilterFunctionNArguments* arguments) {
    forLines(arguments, [](Query& query, std::uint32_t triangle, int& valid) {
        valid = 0;
        takeHit(query, triangle);
    });
}

/// Sets center and scale from the finite positions.
void findPlace(RaySurface::State& state) {
    const PositionBox box(state.positions);
    if (box.isEmpty()) return;
    state.center = 0.5 * (box.least + box.most);
    const DVec3 sides = box.most - box.least;
    const double size = std::max({sides.x, sides.y, sides.z});
    state.scale = size > 0 ? 1 / size : 1;
    state.size = 1 / state.scale;
}

/// Creates two devices. Scenes of the first one are built by the threads that call joinCommitScene, at most `threads`.
/// The thread count of a device limits TBB for the whole process, including a host that uses TBB, unless another device
/// has a higher limit. So the second device has no limit, which removes the restriction; the first one keeps its arena.
/// Returns false if a device cannot be created.
bool makeDevices(RaySurface::State& state, unsigned threads) {
    char settings[96];
    // Without this option, each device reserves 128 MB for subdivision surfaces.
    constexpr const char* kNoCache = "tessellation_cache_size=0";
    std::snprintf(settings, sizeof settings, "threads=%u,user_threads=%u,%s", threads, threads, kNoCache);
    state.device = embree().newDevice(settings);
    if (state.device == nullptr) return false;
    state.second_device = embree().newDevice(kNoCache);
    return state.device != nullptr && state.second_device != nullptr;
}

/// Builds the BVH on at most `threads` threads.
RTCError buildScene(const RaySurface::State& state, std::size_t threads, Parallel& parallel) {
    std::atomic<RTCError> failure = RTC_ERROR_NONE;
    parallel.forTasks(threads, [&](std::size_t) {
        embree().joinCommitScene(state.scene);
        // Embree stores error codes per thread.
        if (const RTCError error = embree().getDeviceError(state.device); error != RTC_ERROR_NONE) failure = error;
    });
    return failure;
}

}  // namespace

RaySurface::RaySurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
RaySurface::~RaySurface() = default;

Result<std::unique_ptr<const RaySurface>> RaySurface::make(StridedSpan<const Vec3> positions,
                                                           std::span<const std::uint32_t> corners,
                                                           std::span<const std::uint32_t> groups, Parallel& parallel) {
    const Embree& api = embree();
    if (!api.is_loaded)
        return makeError(ErrorCode::unsupportedFile, kNoElement, "ray tracing needs Embree, but %s cannot be loaded",
                         TSPACE_EMBREE_LIBRARY);
    auto state = std::make_unique<State>();
    state->positions = positions;
    state->corners = corners;
    state->groups = groups;
    findPlace(*state);
    state->placed.resize(positions.count);
    for (std::size_t i = 0; i < positions.count; ++i) {
        const Vec3 at = toFloat(state->scale * (toDouble(positions[i]) - state->center));
        state->placed[i] = {at.x, at.y, at.z, 0};
    }
    // Upper limit of the memory for devices, threads and the BVH. It must be available, because a failed allocation
    // inside Embree may terminate the process.
    constexpr std::size_t kDeviceBytes = std::size_t{16} << 20, kThreadBytes = std::size_t{1} << 20,
                          kTriangleBytes = 256;
    const std::size_t needed = kDeviceBytes + kThreadBytes * parallel.width() + kTriangleBytes * (corners.size() / 3);
    requireMemory(needed);
    // If an allocation fails while several threads build the BVH, Embree's threads may wait for each other forever.
    // malloc in glibc reserves twice 64 MB of addresses for each thread, which may leave too few for Embree. One thread
    // builds the BVH if there are not enough addresses for both.
    constexpr std::size_t kHeapBytes = std::size_t{128} << 20;
    const std::size_t builders = canMap(needed + kHeapBytes * parallel.width()) ? parallel.width() : 1;
    if (has_embree_failed)
        return makeError(ErrorCode::outOfMemory, kNoElement, "Embree ran out of memory earlier in this process");
    if (!makeDevices(*state, parallel.width())) {
        if (state->device == nullptr && api.getDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU)
            return makeError(ErrorCode::unsupportedFile, kNoElement, "Embree does not support this CPU");
        // The settings are valid, so memory ran out, for which Embree has several codes.
        return state->abandon();
    }
    state->scene = api.newScene(state->device);
    const RTCGeometry geometry = api.newGeometry(state->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (state->scene == nullptr || geometry == nullptr) return state->abandon();
    api.setSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
    api.setSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, state->placed.data(), 0,
                                sizeof(Vec4), state->placed.size());
    api.setSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, corners.data(), 0,
                                3 * sizeof(std::uint32_t), corners.size() / 3);
    api.setGeometryIntersectFilterFunction(geometry, collectHits);
    api.setGeometryOccludedFilterFunction(geometry, acceptBlocking);
    api.commitGeometry(geometry);
    api.attachGeometry(state->scene, geometry);
    api.releaseGeometry(geometry);
    RTCError error = api.getDeviceError(state->device);  // error of the calls above
    if (error == RTC_ERROR_NONE) error = buildScene(*state, builders, parallel);
    if (error == RTC_ERROR_INVALID_ARGUMENT || error == RTC_ERROR_INVALID_OPERATION)
        return makeError(ErrorCode::internal, kNoElement, "Embree failed with error code %u",
                         static_cast<unsigned>(error));
    if (error != RTC_ERROR_NONE) return state->abandon();
    return std::unique_ptr<const RaySurface>(new RaySurface(std::move(state)));
}

namespace {

/// Converts the part of a line near the surface to Embree's coordinates. Returns false if there is none.
bool placeRay(const Query& query, RTCRay& ray) {
    // Embree terminates the process if a ray starts or ends beyond 1.8e18, so it gets only the part near the surface,
    // whose bounding box has sides of at most 1 about the center.
    constexpr double kBeyond = 2;
    const RaySurface::State& state = *query.surface;
    const RayLine& line = query.line;
    const double middle = dot(state.center - line.from, line.outward);
    const double begin = std::max(line.begin, middle - kBeyond * state.size);
    const double end = std::min(line.end, middle + kBeyond * state.size);
    const DVec3 place = state.scale * (line.from + begin * line.outward - state.center);
    if (!(begin <= end) || !(dot(place, place) <= 4 * kBeyond * kBeyond)) return false;
    const Vec3 origin = toFloat(place);
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    const Vec3 along = toFloat(line.outward);
    ray.dir_x = along.x;
    ray.dir_y = along.y;
    ray.dir_z = along.z;
    ray.tfar = static_cast<float>(state.scale * (end - begin));
    ray.mask = ~0u;
    return true;
}

/// Finds the requested hit on the line, or counts hits.
void shoot(Query& query) {
    RTCRayHit ray{};
    if (!placeRay(query, ray.ray)) return;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Shot shot(&query, false);
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &shot.context;
    embree().intersect1(query.surface->scene, &ray, &arguments);
#else
    embree().intersect1(query.surface->scene, &shot.context, &ray);
#endif
}

/// Traces up to kLinesAtOnce lines of one surface in a single Embree call.
void shootAll(std::span<Query> queries) {
    RTCRayHit16 rays{};
    alignas(64) std::array<int, kLinesAtOnce> valid{};
    for (std::size_t i = 0; i < queries.size(); ++i) {
        RTCRay ray{};
        if (!placeRay(queries[i], ray)) continue;
        valid[i] = -1;
        rays.ray.org_x[i] = ray.org_x;
        rays.ray.org_y[i] = ray.org_y;
        rays.ray.org_z[i] = ray.org_z;
        rays.ray.dir_x[i] = ray.dir_x;
        rays.ray.dir_y[i] = ray.dir_y;
        rays.ray.dir_z[i] = ray.dir_z;
        rays.ray.tfar[i] = ray.tfar;
        rays.ray.mask[i] = ray.mask;
        rays.ray.id[i] = static_cast<unsigned>(i);
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    Shot shot(queries.data(), true);
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    arguments.context = &shot.context;
    embree().intersect16(valid.data(), queries[0].surface->scene, &rays, &arguments);
#else
    embree().intersect16(valid.data(), queries[0].surface->scene, &shot.context, &rays);
#endif
}

Query shoot(const RaySurface::State& state, const RayLine& line, Wanted wanted) {
    Query query{.surface = &state, .line = line, .wanted = wanted};
    shoot(query);
    return query;
}

/// Returns the line in the opposite direction.
RayLine reversed(const RayLine& line) { return {line.from, -1.0 * line.outward, -line.end, -line.begin, line.group}; }

/// Returns a query for any triangle but one.
Query anyBut(std::uint32_t skipped, const RaySurface::State& state, RayLine line) {
    line.group = kEveryGroup;
    return {.surface = &state, .line = line, .wanted = Wanted::any, .skipped = skipped};
}

/// Returns whether acceptBlocking accepts a triangle on the line.
bool isHidden(Query& query) {
    RTCRay ray{};
    if (!placeRay(query, ray)) return false;
    Shot shot(&query, false);
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &shot.context;
    embree().occluded1(query.surface->scene, &ray, &arguments);
#else
    embree().occluded1(query.surface->scene, &shot.context, &ray);
#endif
    return ray.tfar < 0;
}

/// Copies the best hit to `hit` with its distance negated (measured along the opposite direction). Returns false if
/// there was no hit.
bool copyReversed(const Query& query, RayHit& hit) {
    if (!query.is_hit) return false;
    hit = query.best;
    hit.distance = -hit.distance;
    return true;
}

}  // namespace

bool RaySurface::nearest(const DVec3& from, const DVec3& outward, double reach, std::uint32_t group, double& guess,
                         RayHit& hit) const {
    const DVec3 inward = -1.0 * outward;
    // A fraction of a very small reach may underflow to zero.
    const double least = std::max(reach / 1024, std::min(reach, std::numeric_limits<double>::min()));
    for (double half = std::clamp(guess, least, reach);; half = std::min(4 * half, reach)) {
        if (copyReversed(shoot(*state_, {from, inward, -half, half, group}, Wanted::nearest), hit)) {
            guess = 2 * std::fabs(hit.distance);
            return true;
        }
        if (half == reach) return false;
    }
}

bool RaySurface::first(const DVec3& from, const DVec3& inward, double most, std::uint32_t group, RayHit& hit) const {
    const Query query = shoot(*state_, {from, inward, 0, most, group}, Wanted::nearest);
    if (query.is_hit) hit = query.best;
    return query.is_hit;
}

bool RaySurface::outermost(const RayLine& line, RayHit& hit) const {
    return copyReversed(shoot(*state_, reversed(line), Wanted::first), hit);
}

bool RaySurface::innermost(const RayLine& line, RayHit& hit) const {
    return copyReversed(shoot(*state_, reversed(line), Wanted::last), hit);
}

std::uint32_t RaySurface::outermost(std::span<const RayLine> lines, std::span<RayHit> hits) const {
    std::array<Query, kLinesAtOnce> queries;
    for (std::size_t i = 0; i < lines.size(); ++i)
        queries[i] = {.surface = state_.get(), .line = reversed(lines[i]), .wanted = Wanted::first};
    if (!lines.empty()) shootAll({queries.data(), lines.size()});
    std::uint32_t met = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) met |= copyReversed(queries[i], hits[i]) ? 1U << i : 0U;
    return met;
}

bool RaySurface::isBlocked(const RayLine& line, std::uint32_t skipped) const {
    Query query = anyBut(skipped, *state_, line);
    return isHidden(query);
}

bool RaySurface::firstOfAny(const RayLine& line, std::uint32_t skipped, RayHit& hit) const {
    Query query = anyBut(skipped, *state_, line);
    shoot(query);
    if (query.is_hit) hit = query.best;
    return query.is_hit;
}

double RaySurface::size() const { return state_->size; }

RayCrossings RaySurface::crossings(const RayLine& line) const {
    return shoot(*state_, reversed(line), Wanted::all).crossings;
}

#else

struct RaySurface::State {};
RaySurface::RaySurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
RaySurface::~RaySurface() = default;

Result<std::unique_ptr<const RaySurface>> RaySurface::make(StridedSpan<const Vec3>, std::span<const std::uint32_t>,
                                                           std::span<const std::uint32_t>, Parallel&) {
    return makeError(ErrorCode::unsupportedFile, kNoElement,
                     "ray tracing needs Embree, but this build does not include it");
}
bool RaySurface::nearest(const DVec3&, const DVec3&, double, std::uint32_t, double&, RayHit&) const { return false; }
bool RaySurface::first(const DVec3&, const DVec3&, double, std::uint32_t, RayHit&) const { return false; }
bool RaySurface::outermost(const RayLine&, RayHit&) const { return false; }
bool RaySurface::innermost(const RayLine&, RayHit&) const { return false; }
std::uint32_t RaySurface::outermost(std::span<const RayLine>, std::span<RayHit>) const { return 0; }
RayCrossings RaySurface::crossings(const RayLine&) const { return {}; }
bool RaySurface::isBlocked(const RayLine&, std::uint32_t) const { return false; }
bool RaySurface::firstOfAny(const RayLine&, std::uint32_t, RayHit&) const { return false; }
double RaySurface::size() const { return 1; }

#endif

}  // namespace tspace
