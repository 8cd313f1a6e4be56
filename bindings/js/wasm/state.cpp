// SPDX-License-Identifier: MIT
// Exports of every module: error and report of the last call.
#include <new>

#include "exports.h"

namespace tspace::js {

namespace {
// Never destroyed: the memory of an instance is dropped as a whole.
alignas(Error) unsigned char error_room[sizeof(Error)];
}  // namespace

Error& error = *new (error_room) Error;
double report[kReportNumbers];

}  // namespace tspace::js

using namespace tspace;
using namespace tspace::js;

extern "C" {

TSPACE_JS_EXPORT(errorText) const char* errorText() { return error.message.c_str(); }
TSPACE_JS_EXPORT(errorElement) double errorElement() {
    return error.element == kNoElement ? -1.0 : static_cast<double>(error.element);
}
TSPACE_JS_EXPORT(report) const double* reportNumbers() { return report; }

}  // extern "C"
