// SPDX-License-Identifier: MIT
// C API: arenas.
#include <memory>

#include "core/c_api/c_convert.h"
#include "tspace/arena.h"

using namespace tspace;         // NOLINT: this file only forwards
using namespace tspace::c_api;  // NOLINT

struct tspace_Arena {
    Arena arena;
    tspace_Allocator allocator{arena.allocator()->allocate, arena.allocator()->release, arena.allocator()->user};
};

tspace_ErrorCode tspace_createArena(tspace_Arena** arena, tspace_Error* error) noexcept {
    return atCBorder(error, [&]() -> Result<Done> {
        if (arena == nullptr) return Error{ErrorCode::nullData, "arena is null"};
        *arena = nullptr;
        *arena = std::make_unique<tspace_Arena>().release();
        return Done{};
    });
}

const tspace_Allocator* tspace_arenaAllocator(const tspace_Arena* arena) noexcept { return &arena->allocator; }

size_t tspace_arenaHeldBytes(const tspace_Arena* arena) noexcept { return arena->arena.heldBytes(); }

size_t tspace_arenaUsedBytes(const tspace_Arena* arena) noexcept { return arena->arena.usedBytes(); }

void tspace_trimArena(tspace_Arena* arena) noexcept { arena->arena.trim(); }

void tspace_destroyArena(tspace_Arena* arena) noexcept { delete arena; }
