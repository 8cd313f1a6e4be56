// SPDX-License-Identifier: MIT
// The page that Chromium opens: runs the shaders on each case and posts the results to /results/LANGUAGE/CASE. If
// WebGPU does not start, it posts the reason to /without/wgsl.
import { openWebGl, pixelFrames } from "./webgl.mjs";
import { openWebGpu } from "./webgpu.mjs";

const send = async (address, body) => {
    const answer = await fetch(address, { method: "POST", body });
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
};
const text = async (address) => (await fetch(address)).text();
const STEPS_CASE = 14;

try {
    const cases = await (await fetch("/list")).json();
    const bufferOf = async (number) => new Uint32Array(await (await fetch(`/cases/${number}`)).arrayBuffer());

    const tspace = await text("/shaders/tspace.wgsl"), wgsl_cases = await text("/tests/cases.wgsl");
    const snippets = await (await fetch("/snippets")).json();
    const glsl = { shader: await text("/shaders/tspace.glsl"), cases: await text("/tests/cases.glsl") };
    const runners = {};
    try {
        runners.wgsl = await openWebGpu(tspace + wgsl_cases, [await text("/shaders/tspace_evaluate.wgsl"), ...snippets.map((code) => tspace + code)]);
    } catch (error) {
        if (error.is_wrong_shader) throw error;
        await send("/without/wgsl", String(error));
    }
    runners.gles = openWebGl(glsl);
    for (const [language, runner] of Object.entries(runners)) {
        for (const number of cases) await send(`/results/${language}/${number}`, await runner.run(await bufferOf(number)));
    }
    await send(`/results/pixel/${STEPS_CASE}`, pixelFrames(glsl.shader, await bufferOf(STEPS_CASE)));
    const names = Object.values(runners).map(({ name }) => name).join("; ");
    await send("/done", `${names}; ${navigator.userAgent.match(/Chrome\/[\d.]+/)}`);
} catch (error) {
    await send("/failed", String(error?.stack ?? error));
}
