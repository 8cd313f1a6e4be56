// SPDX-License-Identifier: MIT
// invert_signs.mjs IN.glb OUT.glb: negates w of every tangent, like a program that passes glTF's UVs to MikkTSpace
// unchanged. Supports only float tangents in the GLB's own buffer.
import { readFileSync, writeFileSync } from "node:fs";

const FLOAT = 5126;
const [input, output] = process.argv.slice(2);
const bytes = readFileSync(input);
const json_length = bytes.readUInt32LE(12);
const gltf = JSON.parse(bytes.subarray(20, 20 + json_length));
const buffer_start = 20 + json_length + 8;

const used = gltf.meshes.flatMap((mesh) => mesh.primitives.map((primitive) => primitive.attributes.TANGENT));
for (const accessor of new Set(used)) {
    const { bufferView, byteOffset = 0, componentType, count } = gltf.accessors[accessor];
    if (componentType !== FLOAT) throw new Error(`accessor ${accessor} is not of floats`);
    const view = gltf.bufferViews[bufferView];
    for (let i = 0; i < count; ++i) {
        const w = buffer_start + (view.byteOffset ?? 0) + byteOffset + i * (view.byteStride ?? 16) + 12;
        bytes.writeFloatLE(-bytes.readFloatLE(w), w);
    }
}
writeFileSync(output, bytes);
