// SPDX-License-Identifier: MIT
// JavaScript functions that the caller may pass in with the model: codecs from npm.
#pragma once

#define TSPACE_JS_IMPORT(name) __attribute__((import_module("env"), import_name(#name)))

namespace tspace::js {

/// The numbers must match src/codecs.js.
enum class Codec { meshoptDecoder, meshoptEncoder, dracoDecoder, dracoEncoder, imageDecoder, imageEncoder };

}  // namespace tspace::js

extern "C" {

/// true: the caller may stop the call.
extern bool tspace_js_can_stop;

/// Returns whether the caller passed this codec in.
TSPACE_JS_IMPORT(hasCodec) int tspace_js_hasCodec(tspace::js::Codec codec);

}  // extern "C"
