// SPDX-License-Identifier: MIT
// Memory of this program that ends when a test says so.
#pragma once

namespace tspace::test {

/// From now on operator new fails at its Kth call, and where `all_after` at all further ones.
void failAllocation(long k, bool all_after);
/// No more. Whether one failed.
bool stopFailing();

}  // namespace tspace::test
