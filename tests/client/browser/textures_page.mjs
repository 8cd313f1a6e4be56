// SPDX-License-Identifier: MIT
// The page that Chromium opens: three.js shows the first level of each texture of /list, one texel per pixel; its
// values are sent as bytes.
import * as THREE from "three";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";

const send = async (address, body) => {
    const answer = await fetch(address, { method: "POST", body });
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
};

try {
    const { names, width, height } = await (await fetch("/list")).json();
    const renderer = new THREE.WebGLRenderer({ antialias: false });
    const loader = new KTX2Loader().detectSupport(renderer);
    const target = new THREE.WebGLRenderTarget(width, height, { depthBuffer: false });
    const material = new THREE.ShaderMaterial({
        uniforms: { map: { value: null }, part: { value: 1 } },
        vertexShader: "void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
        fragmentShader: `uniform sampler2D map;
            uniform float part;
            void main() {
                vec4 texel = texelFetch(map, ivec2(gl_FragCoord.xy), 0);
                gl_FragColor = part * texel + (1.0 - part);
            }`,
    });
    const scene = new THREE.Scene(), camera = new THREE.OrthographicCamera();
    const screen = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    screen.frustumCulled = false;
    scene.add(screen);
    for (const { name, is_signed } of names) {
        const texture = await loader.loadAsync(`/textures/${name}`);
        Object.assign(texture, { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
        material.uniforms.map.value = texture;
        material.uniforms.part.value = is_signed ? 0.5 : 1;
        renderer.setRenderTarget(target);
        renderer.render(scene, camera);
        const pixels = new Uint8Array(4 * width * height);
        renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
        await send(`/pixels/${name}`, pixels);
    }
    await send("/done", `three.js ${THREE.REVISION}, ${navigator.userAgent.match(/Chrome\/[\d.]+/)}`);
} catch (error) {
    await send("/failed", String(error?.stack ?? error));
}
