// SPDX-License-Identifier: MIT
// The cases of cases.cpp as a compute shader (see compute.glsl). It is appended to tspace.wgsl.
@group(0) @binding(0) var<storage, read> words: array<u32>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4f>;
fn wordAt(at: u32) -> u32 { return words[at]; }
fn numberAt(at: u32) -> f32 { return bitcast<f32>(wordAt(at)); }
fn pairAt(at: u32) -> vec2f { return vec2f(numberAt(at), numberAt(at + 1u)); }
fn vectorAt(at: u32) -> vec3f { return vec3f(pairAt(at), numberAt(at + 2u)); }
fn fourAt(at: u32) -> vec4f { return vec4f(vectorAt(at), numberAt(at + 3u)); }
fn twoWordsAt(at: u32) -> vec2u { return vec2u(wordAt(at), wordAt(at + 1u)); }
fn fourWordsAt(at: u32) -> vec4u { return vec4u(twoWordsAt(at), twoWordsAt(at + 2u)); }
fn matrixAt(at: u32) -> mat3x3f { return mat3x3f(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u)); }
fn frameAt(at: u32) -> tspace_Frame { return tspace_Frame(vectorAt(at), fourAt(at + 3u)); }

fn frameOfCase(which: u32, at: u32) -> tspace_Frame {
    switch (which) {
        case 0u: { return tspace_decodeFrame32(wordAt(at)); }
        case 1u: { return tspace_decodeFrame48(twoWordsAt(at)); }
        case 2u: { return tspace_decodeFrame64(twoWordsAt(at)); }
        case 3u: { return tspace_decodeOct32(wordAt(at)); }
        case 4u: { return tspace_decodeQtangent64(twoWordsAt(at)); }
        case 5u: { return tspace_decodeSnorm8Pair(twoWordsAt(at)); }
        case 6u: { return tspace_decodeSnorm16Pair(fourWordsAt(at)); }
        case 7u: { return tspace_decodeGltfSnorm8(twoWordsAt(at)); }
        case 8u: { return tspace_decodeGltfSnorm16(fourWordsAt(at)); }
        case 9u: { return tspace_frameOfQuaternion(fourAt(at)); }
        case 10u: { return tspace_frameOfVectors(vectorAt(at), vectorAt(at + 3u), numberAt(at + 6u)); }
        case 11u: { return tspace_transformFrame(frameAt(at), matrixAt(at + 7u)); }
        case 12u: { return tspace_skinFrame(frameAt(at), matrixAt(at + 7u), matrixAt(at + 16u), matrixAt(at + 25u),
                                          matrixAt(at + 34u), fourAt(at + 43u)); }
        case 13u: { return tspace_morphFrame(frameAt(at), vectorAt(at + 7u), vectorAt(at + 10u)); }
        case 14u: { return tspace_frameOfSteps(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u), pairAt(at + 9u),
                                             pairAt(at + 11u)); }
        case 15u: { return tspace_decodeFrame32(tspace_word(fourWordsAt(at))); }
        default: { return tspace_decodeFrame64(tspace_words(fourWordsAt(at))); }
    }
}

fn vectorOfCase(which: u32, at: u32) -> vec3f {
    switch (which) {
        case 17u: { return tspace_bitangent(vectorAt(at), fourAt(at + 3u)); }
        case 18u: { return tspace_texel(vectorAt(at)); }
        case 19u: { return tspace_texelOfTwo(pairAt(at)); }
        case 20u: { return tspace_applyMikktspace(vectorAt(at), vectorAt(at + 3u), fourAt(at + 6u)); }
        case 21u: { return tspace_applyMikktspacePerVertex(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u),
                                                         vectorAt(at + 9u)); }
        case 22u: { return tspace_applyThree(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u), vectorAt(at + 9u),
                                           numberAt(at + 12u)); }
        case 23u: { return tspace_applyUnreal(pairAt(at), vectorAt(at + 2u), fourAt(at + 5u)); }
        case 24u: { return tspace_applyUnity(fourAt(at), vectorAt(at + 4u), fourAt(at + 7u)); }
        default: { return tspace_applyGodot(pairAt(at), vectorAt(at + 2u), vectorAt(at + 5u), vectorAt(at + 8u),
                                          numberAt(at + 11u)); }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let item = id.x;
    if (item >= words[1]) { return; }
    let which = words[0];
    let at = 4u + item * words[2];
    if (which < 17u) {
        let frame = frameOfCase(which, at);
        results[2u * item] = vec4f(frame.normal, 0.0);
        results[2u * item + 1u] = frame.tangent;
    } else {
        results[2u * item] = vec4f(vectorOfCase(which, at), 0.0);
        results[2u * item + 1u] = vec4f(0.0);
    }
}
