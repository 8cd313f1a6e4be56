// SPDX-License-Identifier: MIT
// Makes allocations of this program fail on request.
#pragma once

namespace tspace::test {

/// Makes the Kth call of operator new from now on fail, and with `all_after` also all further calls.
void failAllocation(long k, bool all_after);
/// Stops the failures. Returns whether an allocation has failed.
bool stopFailing();

}  // namespace tspace::test
