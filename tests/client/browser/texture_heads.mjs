// SPDX-License-Identifier: MIT
// texture_heads.mjs THREE KTX2...: checks with ktx-parse (shipped with three.js) that these files have the format,
// levels, orientation and data format descriptor that their names imply.
import { readFileSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [three_folder, ...files] = process.argv.slice(2);
const { read } = await import(pathToFileURL(path.join(three_folder, "examples/jsm/libs/ktx-parse.module.js")));
const WIDTH = 64, HEIGHT = 48, LEVELS = 7;
const ASTC = { vkFormat: 157, model: 162, samples: 1, block: 16, swizzle: "ra01" };
const BC5 = { vkFormat: 141, model: 132, samples: 2, block: 16 };
const FORMATS = {
    bc5: BC5, packed: { ...BC5, scheme: 2 }, bc5s: { ...BC5, vkFormat: 142, signed: true },
    eac: { vkFormat: 155, model: 161, samples: 2, block: 16 },
    rg8: { vkFormat: 16, model: 1, samples: 2, block: 2, texels: 1 }, astc: ASTC,
};

let failures = 0;
for (const file of files) {
    const name = path.basename(file, ".ktx2"), wanted = FORMATS[name], side = wanted.texels ?? 4;
    const is = (what, found, right) => {
        if (String(found) === String(right)) return;
        ++failures;
        console.log(`FAILED ${name}: ${what} is ${found}, and not ${right}`);
    };
    const found = read(new Uint8Array(readFileSync(file)));
    is("vkFormat", found.vkFormat, wanted.vkFormat);
    is("the size", [found.pixelWidth, found.pixelHeight, found.pixelDepth, found.layerCount, found.faceCount], [WIDTH, HEIGHT, 0, 0, 1]);
    is("supercompression", found.supercompressionScheme, wanted.scheme ?? 0);
    is("the number of levels", found.levels.length, LEVELS);
    for (const [i, level] of found.levels.entries()) {
        const blocks = (texels) => Math.ceil(Math.max(1, texels >> i) / side);
        const bytes = blocks(WIDTH) * blocks(HEIGHT) * wanted.block;
        is(`level ${i}, unpacked`, level.uncompressedByteLength, bytes);
        if (!wanted.scheme) is(`level ${i}`, level.levelData.byteLength, bytes);
    }
    const [description] = found.dataFormatDescriptor;
    is("the color model", description.colorModel, wanted.model);
    is("the transfer function", description.transferFunction, 1);
    is("the primaries", description.colorPrimaries, 0);
    is("the block", description.texelBlockDimension.slice(0, 2), [side - 1, side - 1]);
    is("samples", description.samples.length, wanted.samples);
    is("signs", description.samples.every(({ channelType }) => (channelType & 0x40) !== 0), wanted.signed ?? false);
    const text = (value) => (typeof value === "string" ? value : new TextDecoder().decode(value)).replace(/\0+$/, "");
    is("the orientation", text(found.keyValue.KTXorientation), "rd");
    is("the swizzle", text(found.keyValue.KTXswizzle), wanted.swizzle ?? "rg01");
}
console.log(`ktx-parse read ${files.length} files`);
process.exitCode = failures === 0 ? 0 : 1;
