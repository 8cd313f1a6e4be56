// SPDX-License-Identifier: MIT
// Runs one function of tspace.hlsl on one item: reads the item's words from index `at`, and returns two vectors. The
// file that includes this one defines wordAt. The numbers of cases are those of cases.cpp.
float numberAt(uint at) { return asfloat(wordAt(at)); }
float2 pairAt(uint at) { return float2(numberAt(at), numberAt(at + 1u)); }
float3 vectorAt(uint at) { return float3(pairAt(at), numberAt(at + 2u)); }
float4 fourAt(uint at) { return float4(vectorAt(at), numberAt(at + 3u)); }
uint2 twoWordsAt(uint at) { return uint2(wordAt(at), wordAt(at + 1u)); }
uint4 fourWordsAt(uint at) { return uint4(twoWordsAt(at), twoWordsAt(at + 2u)); }
float3x3 matrixAt(uint at) { return transpose(float3x3(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u))); }
tspace_Frame frameAt(uint at) { return tspace_makeFrame(vectorAt(at), fourAt(at + 3u)); }

tspace_Frame frameOfCase(uint which, uint at) {
    switch (which) {
        case 0u: return tspace_decodeFrame32(wordAt(at));
        case 1u: return tspace_decodeFrame48(twoWordsAt(at));
        case 2u: return tspace_decodeFrame64(twoWordsAt(at));
        case 3u: return tspace_decodeOct32(wordAt(at));
        case 4u: return tspace_decodeQtangent64(twoWordsAt(at));
        case 5u: return tspace_decodeSnorm8Pair(twoWordsAt(at));
        case 6u: return tspace_decodeSnorm16Pair(fourWordsAt(at));
        case 7u: return tspace_decodeGltfSnorm8(twoWordsAt(at));
        case 8u: return tspace_decodeGltfSnorm16(fourWordsAt(at));
        case 9u: return tspace_frameOfQuaternion(fourAt(at));
        case 10u: return tspace_frameOfVectors(vectorAt(at), vectorAt(at + 3u), numberAt(at + 6u));
        case 11u: return tspace_transformFrame(frameAt(at), matrixAt(at + 7u));
        case 12u: return tspace_skinFrame(frameAt(at), matrixAt(at + 7u), matrixAt(at + 16u), matrixAt(at + 25u),
                                          matrixAt(at + 34u), fourAt(at + 43u));
        case 13u: return tspace_morphFrame(frameAt(at), vectorAt(at + 7u), vectorAt(at + 10u));
        case 14u: return tspace_frameOfSteps(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u), pairAt(at + 9u),
                                             pairAt(at + 11u));
        case 15u: return tspace_decodeFrame32(tspace_word(fourWordsAt(at)));
        default: return tspace_decodeFrame64(tspace_words(fourWordsAt(at)));
    }
}

float3 vectorOfCase(uint which, uint at) {
    switch (which) {
        case 17u: return tspace_bitangent(vectorAt(at), fourAt(at + 3u));
        case 18u: return tspace_texel(vectorAt(at));
        case 19u: return tspace_texelOfTwo(pairAt(at));
        case 20u: return tspace_applyMikktspace(vectorAt(at), vectorAt(at + 3u), fourAt(at + 6u));
        case 21u: return tspace_applyMikktspacePerVertex(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u),
                                                         vectorAt(at + 9u));
        case 22u: return tspace_applyThree(vectorAt(at), vectorAt(at + 3u), vectorAt(at + 6u), vectorAt(at + 9u),
                                           numberAt(at + 12u));
        case 23u: return tspace_applyUnreal(pairAt(at), vectorAt(at + 2u), fourAt(at + 5u));
        case 24u: return tspace_applyUnity(fourAt(at), vectorAt(at + 4u), fourAt(at + 7u));
        default: return tspace_applyGodot(pairAt(at), vectorAt(at + 2u), vectorAt(at + 5u), vectorAt(at + 8u),
                                          numberAt(at + 11u));
    }
}

void runCase(uint which, uint at, out float4 a, out float4 b) {
    if (which < 17u) {
        tspace_Frame frame = frameOfCase(which, at);
        a = float4(frame.normal, 0.0);
        b = frame.tangent;
    } else {
        a = float4(vectorOfCase(which, at), 0.0);
        b = float4(0.0);
    }
}
