// SPDX-License-Identifier: MIT
// Golden meshes of the MikkTSpace reference (their layout is described next to the files), for node and browsers.

/** Returns a mesh and its expected tangents; null for an incomplete file. */
export function readGolden(buffer) {
  const words = new Uint32Array(buffer), numbers = new Float32Array(buffer);
  const [magic, faces, corners] = words;
  if (magic !== 0x31475354 || words.length !== 5 + faces + 18 * corners) return null;
  const faceSizes = words.slice(5, 5 + faces);
  const positions = new Float32Array(3 * corners), normals = new Float32Array(3 * corners);
  const uvs = new Float32Array(2 * corners), wanted = new Float32Array(4 * corners);
  for (let c = 0; c < corners; ++c) {
    const input = 5 + faces + 8 * c, result = 5 + faces + 8 * corners + 10 * c;
    positions.set(numbers.subarray(input, input + 3), 3 * c);
    normals.set(numbers.subarray(input + 3, input + 6), 3 * c);
    uvs.set(numbers.subarray(input + 6, input + 8), 2 * c);
    wanted.set(numbers.subarray(result, result + 3), 4 * c);
    wanted[4 * c + 3] = numbers[result + 9];
  }
  // docs/concepts/methods/mikktspace.md promises identical bits only for these values.
  const isPromised = [positions, normals, uvs].every((array) => array.every((x) => Math.abs(x) < 1.6e38));
  return { mesh: { positions, normals, uvs, faceSizes }, threshold: numbers[3], wanted, isPromised };
}

/** Returns how many numbers differ in their bits; all NaNs are considered equal. */
export function differences(a, b) {
  if (a.length !== b.length) return Math.max(a.length, b.length);
  const x = new Uint32Array(a.buffer, a.byteOffset, a.length), y = new Uint32Array(b.buffer, b.byteOffset, b.length);
  return x.reduce((sum, word, i) => sum + (word !== y[i] && !(Number.isNaN(a[i]) && Number.isNaN(b[i])) ? 1 : 0), 0);
}
