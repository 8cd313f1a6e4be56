// SPDX-License-Identifier: MIT
// Makes allocations of this program fail on request.
#pragma once

namespace tspace::test {

/// From now on the Kth call of operator new fails, and with `all_after` all further ones.
void failAllocation(long k, bool all_after);
/// Stops failing. Returns whether an allocation failed.
bool stopFailing();

}  // namespace tspace::test
