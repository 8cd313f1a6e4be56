// SPDX-License-Identifier: MIT
// The page that Chromium opens: renders each model of /list with three.js, once per light, and sends the pixels and a
// picture to the server. See render.mjs for the addresses.
import * as THREE from "three";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { LIGHTS, VIEW } from "/page/cells.mjs";

const send = async (address, body) => {
    const answer = await fetch(address, { method: "POST", body });
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
};

/// Removes gloss and environment, so that only the side that is lit matters. The normal map and the tangents are
/// unchanged.
function makeMatte(root) {
    root.traverse(({ material }) => {
        if (!material) return;
        Object.assign(material, { metalness: 0, metalnessMap: null, roughness: 1, roughnessMap: null, aoMap: null });
        material.needsUpdate = true;
    });
}

async function renderModel(renderer, loader, name) {
    const { scene: model } = await loader.loadAsync(`/models/${name}`);
    makeMatte(model);
    const scene = new THREE.Scene();
    scene.background = new THREE.Color(0x202020);
    scene.add(model, new THREE.AmbientLight(0xffffff, 0.2));
    const light = new THREE.DirectionalLight(0xffffff, 3);
    scene.add(light);
    const camera = new THREE.OrthographicCamera(-VIEW.half, VIEW.half, VIEW.half, -VIEW.half, 0.1, 10);
    camera.position.z = 5;

    for (const [side, [x, y]] of Object.entries(LIGHTS)) {
        light.position.set(x, y, 1);
        renderer.render(scene, camera);
        const gl = renderer.getContext();
        const pixels = new Uint8Array(4 * VIEW.size * VIEW.size);
        gl.readPixels(0, 0, VIEW.size, VIEW.size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        await send(`/pixels/${name}/${side}`, pixels);
        await send(`/picture/${name}/${side}`, await new Promise((done) => renderer.domElement.toBlob(done)));
    }
}

try {
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setSize(VIEW.size, VIEW.size, false);
    const draco = new DRACOLoader().setDecoderPath("/three/examples/jsm/libs/draco/gltf/");
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).setDRACOLoader(draco);
    for (const name of await (await fetch("/list")).json()) await renderModel(renderer, loader, name);
    await send("/done", `three.js ${THREE.REVISION}, ${navigator.userAgent.match(/Chrome\/[\d.]+/)}`);
} catch (error) {
    await send("/failed", String(error?.stack ?? error));
}
