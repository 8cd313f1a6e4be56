// SPDX-License-Identifier: MIT
// A cloth and a morphing model whose normals and tangents are computed on the GPU in each frame, by tspace/webgpu and three.js'
// WebGPURenderer, next to frames that a fragment shader computes from derivatives of position and UV; a heat map shows the
// angle between the two normals. Runs with Vite: `npm install three tspace vite && npx vite`.
import * as THREE from "three/webgpu";
import {
  Fn, abs, acos, attribute, bitangentWorld, cameraPosition, clamp, cross, dFdx, dFdy, dot, float, mix, normalWorldGeometry, normalize, positionLocal,
  positionWorld, sign, sin, smoothstep, tangentWorld, uniform, uv, vec3,
} from "three/tsl";
import { makeIndexedFrames, Plan, planBuffers, ready } from "tspace";
import { GpuFrames } from "tspace/webgpu";

const SIZE = 384, HEAT_DEGREES = 20;

/** Returns a sheet of n * n quads in the plane z = 0, on which the texture repeats three times in each direction. */
function clothMesh(n) {
  const positions = new Float32Array(3 * (n + 1) ** 2), uvs = new Float32Array(2 * (n + 1) ** 2), indices = [];
  for (let j = 0, v = 0; j <= n; ++j) {
    for (let i = 0; i <= n; ++i, ++v) {
      positions.set([(2 * i) / n - 1, (2 * j) / n - 1, 0], 3 * v);
      uvs.set([(3 * i) / n, (3 * j) / n], 2 * v);
      if (i < n && j < n) indices.push(v, v + 1, v + n + 2, v, v + n + 2, v + n + 1);
    }
  }
  return { positions, uvs, indices: Uint32Array.from(indices) };
}

/** Writes the pose of the cloth at a time, four numbers per vertex. In a game, a simulation would write this buffer. */
function waveCloth(rest, time, to) {
  for (let i = 0, k = 0; i < rest.length; i += 3, k += 4) {
    const [x, y] = [rest[i], rest[i + 1]], lift = 0.5 * (1 - y);
    to[k] = 0.9 * x;
    to[k + 1] = 0.9 * y;
    to[k + 2] = lift * (0.22 * Math.sin(5 * x + 2 * time) + 0.12 * Math.sin(7 * y - 3 * time + 2 * x));
  }
}

/** Returns a sphere of few triangles with a morph target that gives it five lobes. */
function morphingMesh() {
  const sphere = new THREE.SphereGeometry(0.8, 36, 24), { position, uv: uvs } = sphere.attributes;
  const positions = Float32Array.from(position.array), target = positions.slice();
  for (let i = 0; i < positions.length; i += 3) {
    // At the poles `height` is exactly 1, so that their vertices, which have arbitrary angles, stay equal.
    const [x, y, z] = positions.subarray(i, i + 3), angle = Math.atan2(z, x), height = Math.min(1, (y / 0.8) ** 2);
    const change = 0.28 * Math.cos(5 * angle) * (1 - height) - 0.1 * height;
    target.set([change * x, change * y, change * z], i);
  }
  return { positions, target, uvs: Float32Array.from(uvs.array, (x, i) => (i % 2 ? 2 * x : 4 * x)), indices: Uint32Array.from(sphere.index.array) };
}

const gather = (array, size, sources) => Float32Array.from({ length: size * sources.length }, (_, i) => array[size * sources[Math.floor(i / size)] + (i % size)]);

/** Returns a geometry with a vertex for each result, and the words of its plan. */
function planned(mesh) {
  const { positions, uvs, indices } = mesh;
  const made = makeIndexedFrames({ positions, uvs, indices }, { convention: "opengl" });
  const take = (array, size) => gather(array, size, made.sourceVertices);
  const vertices = { positions: take(positions, 3), uvs: take(uvs, 2), normals: made.normals, indices: made.indices };
  const plan = new Plan(vertices, { convention: "opengl" });
  const buffers = planBuffers(plan, { sourceCorners: made.sourceCorners, mesh: vertices });
  plan.destroy();
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(new THREE.BufferAttribute(made.indices, 1));
  geometry.setAttribute("uv", new THREE.BufferAttribute(vertices.uvs, 2));
  // Four floats per vertex: WebGPU has no storage arrays of three, and three.js would pad them.
  const count = made.sourceVertices.length, padded = new Float32Array(4 * count);
  for (let v = 0; v < count; ++v) padded.set(vertices.positions.subarray(3 * v, 3 * v + 3), 4 * v);
  geometry.setAttribute("position", new THREE.StorageBufferAttribute(padded, 4));
  geometry.setAttribute("normal", new THREE.StorageBufferAttribute(new Float32Array(4 * count), 4));
  geometry.setAttribute("tangent", new THREE.StorageBufferAttribute(made.tangents.slice(), 4));
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), 2);
  return { geometry, buffers, rest: vertices.positions, target: mesh.target && take(mesh.target, 3), count };
}

/** Tangent-space normal of a pattern of round bumps, computed without a texture. */
const bumps = Fn(() => {
  const p = uv().mul(2 * Math.PI * 3);
  return normalize(vec3(sin(p.x).mul(0.55), sin(p.y).mul(0.55), 1));
});

/** Normal of a pixel from derivatives (Mikkelsen, "Bump Mapping Unparametrized Surfaces on the GPU", 2010). */
const derivativeNormal = Fn(() => {
  const dx = dFdx(positionWorld), dy = dFdy(positionWorld);
  const n = normalize(cross(dx, dy));
  return n.mul(sign(dot(n, cameraPosition.sub(positionWorld))));
});
const derivativeFrame = Fn(([n, bump]) => {
  const dx = dFdx(positionWorld), dy = dFdy(positionWorld), du = dFdx(uv()), dv = dFdy(uv());
  const a = cross(dy, n), b = cross(n, dx);
  const t = a.mul(du.x).add(b.mul(dv.x)), s = a.mul(du.y).add(b.mul(dv.y));
  const scale = float(1).div(dot(t, t).max(dot(s, s)).max(1e-20).sqrt());
  return normalize(t.mul(scale).mul(bump.x).add(s.mul(scale).mul(bump.y)).add(n.mul(bump.z)));
});
/** Decodes as MikkTSpace prescribes: with interpolated vectors; only the result is normalized. */
const attributeFrame = Fn(([bump]) => {
  const n = normalWorldGeometry, facing = sign(dot(n, cameraPosition.sub(positionWorld)));
  return normalize(tangentWorld.mul(bump.x).add(bitangentWorld.mul(bump.y)).add(n.mul(bump.z))).mul(facing);
});
const lit = Fn(([n]) => {
  const light = normalize(vec3(0.5, 0.7, 0.8)), eye = normalize(cameraPosition.sub(positionWorld)), half = normalize(light.add(eye));
  return vec3(0.75, 0.32, 0.22).mul(dot(n, light).max(0).mul(0.85).add(0.12)).add(dot(n, half).max(0).pow(40).mul(0.6));
});
const heat = Fn(([a, b]) => {
  const degrees = acos(clamp(abs(dot(a, b)), 0, 1)).mul(180 / Math.PI), x = degrees.div(HEAT_DEGREES);
  const step = (color, from, to, next) => mix(color, next, smoothstep(from, to, x));
  return step(step(step(step(vec3(0.06, 0.07, 0.1), 0, 0.25, vec3(0.23, 0.23, 1)), 0.25, 0.5, vec3(0, 0.78, 0.63)), 0.5, 0.75, vec3(1, 0.88, 0)), 0.75, 1, vec3(1, 0.19, 0.13));
});

function materialOf(colorNode, positionNode) {
  const material = new THREE.MeshBasicNodeMaterial({ side: THREE.DoubleSide });
  return Object.assign(material, { colorNode, ...(positionNode && { positionNode }) });
}

const columns = [
  ["frames by tspace/webgpu", () => lit(attributeFrame(bumps()))],
  ["frames from derivatives", () => lit(derivativeFrame(derivativeNormal(), bumps()))],
  ['difference: 0 <span id="scale"></span> 20° and more', () => heat(attributeFrame(bumps()), derivativeFrame(derivativeNormal(), bumps()))],
];

/** Creates the model on the GPU. Its update(time) computes the frames of a pose there; no result is read back. */
async function makeModel(renderer, mesh, name) {
  const model = planned(mesh), { geometry, rest, target, count } = model, { device } = renderer.backend;
  const arrayOf = (attribute) => {
    renderer.backend.createStorageAttribute(attribute);
    return { buffer: renderer.backend.get(attribute).buffer, stride: 16 };
  };
  const [positions, normals, tangents] = ["position", "normal", "tangent"].map((key) => arrayOf(geometry.attributes[key]));
  const frames = await GpuFrames.create(device, model.buffers);
  const encode = (deform) => {
    const encoder = device.createCommandEncoder();
    frames.encode(encoder, { positions, normals, tangents, deform });
    device.queue.submit([encoder.finish()]);
  };
  if (!target) {
    const pose = new Float32Array(4 * count);
    const update = (time) => {
      waveCloth(rest, time, pose);
      device.queue.writeBuffer(positions.buffer, 0, pose);
      encode();
    };
    return { geometry, name, mesh, update };
  }
  // Vertex shader and tspace morph the same positions by the same weight.
  geometry.setAttribute("delta", new THREE.BufferAttribute(target, 3));
  const weight = uniform(0), word = new Float32Array(1);
  const buffer = device.createBuffer({ size: 16 + target.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
  device.queue.writeBuffer(buffer, 16, target);
  const update = (time) => {
    weight.value = word[0] = 0.5 - 0.5 * Math.cos(2 * time);
    device.queue.writeBuffer(buffer, 0, word);
    encode({ buffer, morph: { count: 1, weights: 0, deltas: 16 } });
  };
  return { geometry, name, mesh, update, positionNode: positionLocal.add(attribute("delta", "vec3").mul(weight)) };
}

async function main() {
  if (!(await navigator.gpu?.requestAdapter())) {
    document.querySelector("main").textContent = "This browser has no WebGPU.";
    return undefined;
  }
  await ready;
  const renderer = new THREE.WebGPURenderer({ antialias: true });
  await renderer.init();
  renderer.setSize(SIZE, SIZE, false);
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 20);
  camera.position.set(0.9, 0.5, 2.9);
  camera.lookAt(0, 0, 0);
  const models = [await makeModel(renderer, clothMesh(40), "cloth"), await makeModel(renderer, morphingMesh(), "morphing model")];
  const views = models.flatMap((model) => columns.map(([text, node]) => {
    const figure = document.createElement("figure"), canvas = document.createElement("canvas");
    canvas.width = canvas.height = SIZE;
    const caption = document.createElement("figcaption");
    caption.innerHTML = `${model.name}: ${text}`;
    figure.append(canvas, caption);
    document.querySelector("main").append(figure);
    const scene = new THREE.Scene();
    const mesh = new THREE.Mesh(model.geometry, materialOf(node(), model.positionNode));
    mesh.frustumCulled = false;
    scene.add(mesh);
    return { scene, context: canvas.getContext("2d") };
  }));
  const target = new THREE.RenderTarget(SIZE, SIZE);
  return {
    draw(time) {
      for (const model of models) model.update(time);
      for (const { scene, context } of views) {
        renderer.render(scene, camera);
        context.drawImage(renderer.domElement, 0, 0);
      }
    },
    /** Draws one picture of each view into its canvas, for browsers that cannot present WebGPU, such as headless ones. */
    async drawStill(time) {
      for (const model of models) model.update(time);
      for (const { scene, context } of views) {
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, SIZE, SIZE);
        context.putImageData(new ImageData(Uint8ClampedArray.from(pixels), SIZE, SIZE), 0, 0);
      }
    },
    /** Reads the current pose of each model back, four floats per vertex and array, so that a test can compare it with the CPU. */
    read: () => Promise.all(models.map(async ({ name, mesh, geometry: { attributes } }) => {
      const arrays = ["position", "normal", "tangent"].map(async (key) => Array.from(new Float32Array(await renderer.getArrayBufferAsync(attributes[key]))));
      const [positions, normals, tangents] = await Promise.all(arrays);
      const source = Object.fromEntries(Object.entries(mesh).map(([key, array]) => [key, Array.from(array)]));
      return { name, mesh: source, positions, normals, tangents };
    })),
  };
}

try {
  const page = (window.page = await main());
  const still = new URLSearchParams(location.search).get("time"); // in seconds: one picture instead of an animation
  if (page && still !== null) await page.drawStill(Number(still));
  else if (page) requestAnimationFrame(function step(milliseconds) {
    page.draw(milliseconds / 1000);
    requestAnimationFrame(step);
  });
  window.result = { hasAdapter: page !== undefined };
} catch (error) {
  window.result = { error: String(error.stack) };
  throw error;
}
