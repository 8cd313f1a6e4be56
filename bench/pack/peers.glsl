// SPDX-License-Identifier: MIT
// Decoders of engines and public code, reimplemented from their published formulas, for comparison with tspace's
// formats. GLSL, and C++ by way of tests/shaders/metal_shim, so that the counted code is the measured code.
// Based on: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014
// (oct); Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017; Frey and Herzeg, "Spherical Skinning
// with Dual Quaternions and QTangents", SIGGRAPH 2011 talks.

struct peer_Frame {
    vec3 normal;
    vec4 tangent;
};
peer_Frame peer_frame(vec3 normal, vec3 tangent, float mirrored) {
    peer_Frame frame;
    frame.normal = normal;
    frame.tangent = vec4(tangent, mirrored < 0.0 ? -1.0 : 1.0);
    return frame;
}

// Returns the direction of a point of the unfolded octahedron. x, y: from -1 to 1.
vec3 peer_octahedron(float x, float y) {
    float z = 1.0 - abs(x) - abs(y);
    float fold = max(-z, 0.0);
    return normalize(vec3(x >= 0.0 ? x - fold : x + fold, y >= 0.0 ? y - fold : y + fold, z));
}

// Returns T at this angle in the basis of Duff et al. The basis depends on the sign of N.z, so N must be the rounded
// one.
vec3 peer_atAngle(vec3 n, float angle) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float h = -1.0 / (s + n.z);
    float d = n.x * n.y * h;
    vec3 p = vec3(1.0 + s * n.x * n.x * h, s * d, -s * n.x);
    vec3 q = vec3(d, s + n.y * n.y * h, -n.y);
    return p * cos(angle) + q * sin(angle);
}

// Decodes N from an octahedron with 10 + 10 bits, the angle of T from 11 bits, and the sign from 1 bit.
peer_Frame peer_oct10_10_11(uvec2 words) {
    uint word = words.x;
    vec3 n = peer_octahedron(float(word >> 22u) * (1.0 / 511.0) - 1.0, float(word >> 12u & 1023u) * (1.0 / 511.0) - 1.0);
    vec3 t = peer_atAngle(n, float(word >> 1u & 2047u) * 0.0030679616);
    return peer_frame(n, t, (word & 1u) != 0u ? -1.0 : 1.0);
}

// Decodes N from an octahedron with 11 + 11 bits, the angle of T from 9 bits, and the sign from 1 bit.
peer_Frame peer_oct11_11_9(uvec2 words) {
    uint word = words.x;
    vec3 n = peer_octahedron(float(word >> 21u) * (1.0 / 1023.0) - 1.0, float(word >> 10u & 2047u) * (1.0 / 1023.0) - 1.0);
    vec3 t = peer_atAngle(n, float(word >> 1u & 511u) * 0.012271846);
    return peer_frame(n, t, (word & 1u) != 0u ? -1.0 : 1.0);
}

// Returns N and T, columns z and x of the rotation matrix of a unit quaternion.
peer_Frame peer_unitQuaternion(float x, float y, float z, float w, float mirrored) {
    vec3 n = vec3(2.0 * (z * x + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y));
    vec3 t = vec3(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (z * x - w * y));
    return peer_frame(n, t, mirrored);
}

// Decodes the three smaller components of a quaternion from 10 + 10 + 9 bits, the index of the omitted one from 2 bits,
// and the sign from 1 bit.
peer_Frame peer_smallestThree(uvec2 words) {
    uint word = words.x;
    float a = (float(word >> 22u) * (1.0 / 1023.0) * 2.0 - 1.0) * 0.70710678;
    float b = (float(word >> 12u & 1023u) * (1.0 / 1023.0) * 2.0 - 1.0) * 0.70710678;
    float c = (float(word >> 3u & 511u) * (1.0 / 511.0) * 2.0 - 1.0) * 0.70710678;
    float d = sqrt(max(0.0, 1.0 - a * a - b * b - c * c));
    uint largest = word >> 1u & 3u;
    float x = largest == 0u ? d : a;
    float y = largest == 0u ? a : (largest == 1u ? d : b);
    float z = largest < 2u ? b : (largest == 2u ? d : c);
    float w = largest == 3u ? d : c;
    return peer_unitQuaternion(x, y, z, w, (word & 1u) != 0u ? -1.0 : 1.0);
}

float peer_short(uint bits) { return max(float(int(bits << 16u) >> 16u) * (1.0 / 32767.0), -1.0); }

// Decodes a quaternion from four 16-bit integers, without normalizing it. The sign of w is the sign of the frame.
peer_Frame peer_qtangent16(uvec2 words) {
    float w = peer_short(words.y >> 16u);
    return peer_unitQuaternion(peer_short(words.x), peer_short(words.x >> 16u), peer_short(words.y), w, w);
}

// Decodes N and T from octahedra with 16 + 16 bits each. The sign of the frame is that of T's second number; its
// magnitude is the coordinate.
peer_Frame peer_twoOct16(uvec2 words) {
    vec3 n = peer_octahedron(float(words.x & 65535u) * (1.0 / 65535.0) * 2.0 - 1.0, float(words.x >> 16u) * (1.0 / 65535.0) * 2.0 - 1.0);
    float half_y = float(words.y >> 16u) * (1.0 / 65535.0) * 2.0 - 1.0;
    vec3 t = peer_octahedron(float(words.y & 65535u) * (1.0 / 65535.0) * 2.0 - 1.0, abs(half_y) * 2.0 - 1.0);
    return peer_frame(n, t, half_y);
}
