// SPDX-License-Identifier: MIT
// Parts of the core that this build contains.
#pragma once

namespace tspace {

/// false (TSPACE_MIKKTSPACE_ONLY): the only method is mikktspace, and there are no plans that the caller keeps.
#ifdef TSPACE_MIKKTSPACE_ONLY
inline constexpr bool kHasAllMethods = false;
#else
inline constexpr bool kHasAllMethods = true;
#endif

/// true: the WebAssembly module of `tspace/mikktspace`, whose size matters more than its speed. It writes no
/// bitangents, its caller rejects n-gons and separate index lists, and it plans each mesh, which takes half of the code
/// and twice the time of one pass.
#if defined(TSPACE_MIKKTSPACE_ONLY) && defined(TSPACE_SMALL)
inline constexpr bool kIsMinimal = true;
#else
inline constexpr bool kIsMinimal = false;
#endif

}  // namespace tspace
