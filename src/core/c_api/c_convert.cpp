// SPDX-License-Identifier: MIT
// Conversions between the structs of the C API and those of the C++ API, and checks that only C callers need.
#include "core/c_api/c_convert.h"

#include <algorithm>
#include <cstring>

#include "core/base/border.h"

namespace tspace::c_api {

void appendMessage(std::string_view text, tspace_Error& to) noexcept {
    const std::size_t used = std::strlen(to.message), room = sizeof(to.message) - 1 - used;
    std::size_t length = std::min(text.size(), room);
    if (length < text.size()) {
        // Bytes 10xxxxxx continue a UTF-8 character, which must not be split.
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0u) == 0x80u) --length;
    }
    std::memcpy(to.message + used, text.data(), length);
    to.message[used + length] = '\0';
}

tspace_ErrorCode finish(const Error& error, tspace_Error* out) noexcept {
    const auto code = static_cast<tspace_ErrorCode>(error.code);
    if (out == nullptr) return code;
    *out = tspace_Error{};
    out->code = code;
    out->element = error.element;
    appendMessage(error.message, *out);
    return code;
}

// tspace_Convention is embedded in other structs, so fields can never be added to it.
static_assert(sizeof(tspace_Convention) == 5 * sizeof(std::uint32_t));

Error checkStructSize(std::uint32_t size, std::span<const std::size_t> known, const char* name) {
    if (std::find(known.begin(), known.end(), size) != known.end()) return {ErrorCode::ok};
    return makeError(ErrorCode::invalidOption, kNoElement,
                     "%s.struct_size is %u, but the size in this version is %zu: the struct was not initialized, or "
                     "the caller was built for another version of the library",
                     name, size, known.back());
}

Error checkInitialized(bool has_defaults, const char* name, const char* fields) {
    if (has_defaults) return {ErrorCode::ok};
    return makeError(ErrorCode::invalidOption, kNoElement,
                     "%s of %s are all 0: the struct was not initialized with its default values", fields, name);
}

Error checkChoice(std::uint32_t value, std::uint32_t largest, const char* name) {
    if (value <= largest) return {ErrorCode::ok};
    return makeError(ErrorCode::invalidOption, kNoElement, "%s is %u, but its largest value is %u", name, value,
                     largest);
}

IndexView toIndices(const tspace_Indices& indices) {
    return {indices.data, indices.count, static_cast<IndexType>(indices.type)};
}

MeshView toMesh(const tspace_Mesh& given) {
    const tspace_Mesh mesh = givenOrDefault(&given);
    MeshView view;
    view.positions = toSpan<Vec3>(mesh.positions);
    view.normals = toSpan<Vec3>(mesh.normals);
    view.uvs = toSpan<Vec2>(mesh.uvs);
    view.indices = toIndices(mesh.indices);
    if (mesh.face_sizes != nullptr) view.face_sizes = {mesh.face_sizes, mesh.face_count};
    view.face_size = mesh.face_size == 0 ? 3 : mesh.face_size;
    view.normal_indices = toIndices(mesh.normal_indices);
    view.uv_indices = toIndices(mesh.uv_indices);
    return view;
}

Error checkMesh(const tspace_Mesh* mesh) {
    if (Error error = checkRequired(mesh, "mesh"); error.code != ErrorCode::ok) return error;
    if (mesh->face_sizes == nullptr && mesh->face_count != 0)
        return {ErrorCode::nullData, "mesh.face_sizes is null, but mesh.face_count is not 0"};
    return {ErrorCode::ok};
}

Error checkConvention(const tspace_Convention& convention) {
    return firstError(
        [&] { return checkChoice(convention.v_axis, TSPACE_V_DOWN, "convention.v_axis"); },
        [&] { return checkChoice(convention.green, TSPACE_GREEN_DOWN, "convention.green"); },
        [&] { return checkChoice(convention.stored_sign, TSPACE_SIGN_NEGATED, "convention.stored_sign"); },
        [&] { return checkChoice(convention.handedness, TSPACE_HANDEDNESS_LEFT, "convention.handedness"); },
        [&] { return checkChoice(convention.winding, TSPACE_WINDING_CLOCKWISE, "convention.winding"); });
}

Convention toConvention(const tspace_Convention& convention) { return std::bit_cast<Convention>(convention); }

Error checkExecution(const tspace_Execution* given) {
    if (Error error = checkSized(given, "execution"); error.code != ErrorCode::ok) return error;
    const tspace_Execution execution = givenOrDefault(given);
    if (execution.executor != nullptr && execution.executor->run == nullptr)
        return {ErrorCode::nullData, "the function execution.executor.run is null"};
    const tspace_Allocator* allocator = execution.allocator;
    if (allocator != nullptr && (allocator->allocate == nullptr || allocator->release == nullptr))
        return {ErrorCode::nullData, "execution.allocator requires both functions, allocate and release"};
    return {ErrorCode::ok};
}

Hooks::Hooks(const tspace_Execution* given) {
    const tspace_Execution execution = givenOrDefault(given);
    thread_count_ = execution.thread_count;
    simd_ = static_cast<SimdTarget>(execution.simd);
    if (const tspace_Executor* executor = execution.executor; executor != nullptr)
        executor_ = {executor->run, executor->user, std::max(executor->concurrency, 1u)};
    if (const tspace_Allocator* allocator = execution.allocator; allocator != nullptr)
        allocator_ = {allocator->allocate, allocator->release, allocator->user};
}

Execution Hooks::execution() const {
    return {thread_count_, executor_.run != nullptr ? &executor_ : nullptr,
            allocator_.allocate != nullptr ? &allocator_ : nullptr, simd_};
}

}  // namespace tspace::c_api

using namespace tspace::c_api;  // NOLINT: for the functions of the C API

tspace_ErrorCode tspace_initExecution(tspace_Execution* execution, uint32_t struct_size, tspace_Error* error) noexcept {
    return init(execution, struct_size, "execution", error);
}
