// SPDX-License-Identifier: MIT
// Runs cases with WebGL 2: words are stored in texels, each item is a pixel, and results are returned as the bits of
// floats.
const WORDS_WIDE = 4096, ITEMS_WIDE = 2048;

const VERTICES = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
`;

const itemsShader = ({ shader, cases }) => `#version 300 es
#define TSPACE_FRAGMENT
${shader}
precision highp usampler2D;
uniform usampler2D words;
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;
uint wordAt(uint at) { return texelFetch(words, ivec2(int(at % ${WORDS_WIDE}u), int(at / ${WORDS_WIDE}u)), 0).x; }
${cases}
void main() {
    uint item = uint(gl_FragCoord.y) * ${ITEMS_WIDE}u + uint(gl_FragCoord.x);
    vec4 a = vec4(0.0), b = vec4(0.0);
    if (item < wordAt(1u)) runCase(wordAt(0u), 4u + item * wordAt(2u), a, b);
    first = floatBitsToUint(a);
    second = floatBitsToUint(b);
}
`;

/// Returns a fragment shader in which position and UV change from pixel to pixel by the values of an item of
/// frameOfSteps.
const pixelShader = (shader) => `#version 300 es
#define TSPACE_FRAGMENT
${shader}
uniform vec3 normal, p_dx, p_dy;
uniform vec2 uv_dx, uv_dy;
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;
void main() {
    vec2 at = gl_FragCoord.xy;
    tspace_Frame frame = tspace_frameOfPixel(normal, at.x * p_dx + at.y * p_dy, at.x * uv_dx + at.y * uv_dy);
    first = floatBitsToUint(vec4(frame.normal, 0.0));
    second = floatBitsToUint(frame.tangent);
}
`;

function makeContext() {
    const gl = document.createElement("canvas").getContext("webgl2");
    if (!gl) throw new Error("this Chromium has no WebGL 2");
    return gl;
}

function makeProgram(gl, fragments) {
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, VERTICES], [gl.FRAGMENT_SHADER, fragments]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, source);
        gl.compileShader(shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    gl.useProgram(program);
    return program;
}

function makeTexture(gl, format, width, height, layout, data) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, layout, gl.UNSIGNED_INT, data);
    return texture;
}

/// Renders to two targets with four words per pixel. `draw` fills them. Returns the words of each pixel: first those of
/// the first target, then those of the second one.
function drawAndRead(gl, width, height, draw) {
    const targets = [0, 1].map(() => makeTexture(gl, gl.RGBA32UI, width, height, gl.RGBA_INTEGER, null));
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    targets.forEach((texture, i) =>
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0));
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
    gl.viewport(0, 0, width, height);
    draw();
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const halves = [0, 1].map((i) => {
        const words = new Uint32Array(4 * width * height);
        gl.readBuffer(gl.COLOR_ATTACHMENT0 + i);
        gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
        return words;
    });
    gl.deleteFramebuffer(frame);
    targets.forEach((texture) => gl.deleteTexture(texture));
    if (gl.getError() !== gl.NO_ERROR) throw new Error("WebGL 2 says that something went wrong");
    return halves;
}

function interleave([first, second], items) {
    const results = new Uint32Array(8 * items);
    for (let i = 0; i < items; ++i) {
        results.set(first.subarray(4 * i, 4 * i + 4), 8 * i);
        results.set(second.subarray(4 * i, 4 * i + 4), 8 * i + 4);
    }
    return results;
}

export function openWebGl(sources) {
    const gl = makeContext();
    makeProgram(gl, itemsShader(sources));
    async function run(words) {
        const rows = Math.ceil(words.length / WORDS_WIDE), items = words[1];
        const texels = new Uint32Array(rows * WORDS_WIDE);
        texels.set(words);
        let input;
        const halves = drawAndRead(gl, ITEMS_WIDE, Math.ceil(items / ITEMS_WIDE), () => {
            input = makeTexture(gl, gl.R32UI, WORDS_WIDE, rows, gl.RED_INTEGER, texels);
        });
        gl.deleteTexture(input);
        return interleave(halves, items);
    }
    return { run, name: `WebGL 2 (${gl.getParameter(gl.VERSION)})` };
}

/// Returns the frames of tspace_frameOfPixel for the first items of the case frameOfSteps.
export function pixelFrames(shader, words) {
    const gl = makeContext(), program = makeProgram(gl, pixelShader(shader)), items = 200;
    const floats = new Float32Array(words.buffer, 16), item_words = words[2];
    const results = new Uint32Array(8 * items);
    for (let i = 0; i < items; ++i) {
        let at = i * item_words;
        const halves = drawAndRead(gl, 2, 2, () => {
            for (const [name, size] of [["normal", 3], ["p_dx", 3], ["p_dy", 3], ["uv_dx", 2], ["uv_dy", 2]]) {
                gl[`uniform${size}fv`](gl.getUniformLocation(program, name), floats.subarray(at, at + size));
                at += size;
            }
        });
        results.set(interleave(halves, 1), 8 * i);
    }
    return results;
}
