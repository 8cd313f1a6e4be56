// SPDX-License-Identifier: MIT
// Empty file with which the headers of all tests are compiled once.
