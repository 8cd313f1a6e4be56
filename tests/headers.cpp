// SPDX-License-Identifier: MIT
// Empty: the headers of all tests are compiled once with it.
