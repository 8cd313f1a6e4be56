// SPDX-License-Identifier: MIT
// The page that Chromium opens: renders the normals that three.js shades for each model of /list, from the front
// without perspective, as floats.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const send = async (address, body) => {
    const answer = await fetch(address, { method: "POST", body });
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
};

/// Shows normals in the colors of MeshNormalMaterial, with the model's normal maps, bilinearly filtered.
function showNormals(root) {
    root.traverse((mesh) => {
        if (!mesh.isMesh) return;
        const { normalMap, normalScale, side } = mesh.material;
        if (normalMap) {
            Object.assign(normalMap, { minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, generateMipmaps: false });
            normalMap.needsUpdate = true;
        }
        // three.js uses face normals for geometry without normals.
        const flatShading = mesh.geometry.attributes.normal === undefined;
        mesh.material = new THREE.MeshNormalMaterial({ normalMap, normalScale, side, flatShading });
        if (mesh.morphTargetInfluences) mesh.morphTargetInfluences.fill(0);
    });
}

/// Returns a camera that frames the model like Camera::around in src/commands/shared/picture: the model fills 94 % of
/// the picture.
function cameraFor(model, size) {
    model.updateMatrixWorld(true);
    const box = new THREE.Box3().setFromObject(model, true);
    const center = box.getCenter(new THREE.Vector3()), extent = box.getSize(new THREE.Vector3());
    const half = Math.max(extent.x, extent.y) / 2 / 0.94;
    const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0, extent.z * 2 + half);
    camera.position.set(center.x, center.y, center.z + extent.z / 2 + half / 2);
    return camera;
}

try {
    const { models, size } = await (await fetch("/list")).json();
    const renderer = new THREE.WebGLRenderer({ antialias: false });
    const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });
    const loader = new GLTFLoader();
    for (const name of models) {
        const { scene: model } = await loader.loadAsync(`/models/${name}`);
        showNormals(model);
        const scene = new THREE.Scene();
        scene.add(model);
        renderer.setRenderTarget(target);
        renderer.setClearColor(0, 0);
        renderer.clear();
        renderer.render(scene, cameraFor(model, size));
        const pixels = new Float32Array(4 * size * size);
        renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
        await send(`/normals/${name}`, pixels);
    }
    const gl = renderer.getContext();
    const parts = 2 ** gl.getParameter(gl.SUBPIXEL_BITS);
    await send("/done", `three.js ${THREE.REVISION}, ${navigator.userAgent.match(/Chrome\/[\d.]+/)}, corners in 1/${parts} pixel`);
} catch (error) {
    await send("/failed", String(error?.stack ?? error));
}
