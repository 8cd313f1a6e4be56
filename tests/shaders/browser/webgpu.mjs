// SPDX-License-Identifier: MIT
// Runs cases with WebGPU: see ../cases.wgsl.
const RESULT_BYTES = 32;

async function compile(device, source) {
    const module = device.createShaderModule({ code: source });
    const errors = (await module.getCompilationInfo()).messages.filter(({ type }) => type === "error");
    if (errors.length === 0) return module;
    const { lineNum, message } = errors[0];
    const line = source.split("\n")[lineNum - 1];
    throw Object.assign(new Error(`WGSL does not compile: ${message}: ${line}`), { is_wrong_shader: true });
}

/// Opens a device. `source`: the shader that runs the cases; the other shaders only need to compile.
export async function openWebGpu(source, others) {
    if (!navigator.gpu) throw new Error("this Chromium has no WebGPU");
    const adapter = await navigator.gpu.requestAdapter();
    if (!adapter) throw new Error("WebGPU has no adapter");
    const device = await adapter.requestDevice();
    for (const other of others) await compile(device, other);
    const module = await compile(device, source);
    const pipeline = await device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint: "main" } });

    async function run(words) {
        const items = words[1], size = items * RESULT_BYTES;
        const make = (bytes, usage) => device.createBuffer({ size: bytes, usage });
        const input = make(words.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
        const output = make(size, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
        const copy = make(size, GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ);
        device.queue.writeBuffer(input, 0, words);
        const entries = [input, output].map((buffer, binding) => ({ binding, resource: { buffer } }));
        const commands = device.createCommandEncoder();
        const pass = commands.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
        pass.dispatchWorkgroups(Math.ceil(items / 64));
        pass.end();
        commands.copyBufferToBuffer(output, 0, copy, 0, size);
        device.queue.submit([commands.finish()]);
        await copy.mapAsync(GPUMapMode.READ);
        const results = copy.getMappedRange().slice(0);
        for (const buffer of [input, output, copy]) buffer.destroy();
        return results;
    }
    const { vendor, architecture, description } = adapter.info ?? {};
    return { run, name: `WebGPU (${[vendor, architecture, description].filter(Boolean).join(" ")})` };
}
