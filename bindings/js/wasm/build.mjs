// SPDX-License-Identifier: MIT
// Compiles the core, and the file layer for models in memory, to WebAssembly modules: node build.mjs OUT. emscripten
// provides the compiler and the C++ library; its JavaScript is not used, because the modules need no files, threads or
// exceptions, and only one import, or the few of the file layer.
import { execFile } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, statSync, symlinkSync, writeFileSync } from "node:fs";
import { availableParallelism, cpus } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { gzipSync } from "node:zlib";

const run = promisify(execFile);
const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../../..");
const out = resolve(process.argv[2] ?? join(root, "build/js/wasm"));

/// Folders of src/ to compile; and files with mesh loops for which larger code than that of -Oz is worthwhile.
const rooms = ["base", "frames", "normals", "estimate", "tangents", "tangents/mikktspace", "tangents/estimators", "indexed"].map((room) => `core/${room}`);
/// Files that plain_normals.cpp replaces.
const notPlain = ["crease_auto", "denoise", "noise_screen", "normal_groups"].map((name) => `core/estimate/${name}.cpp`);
const fileRooms = [
  ...["surface", "quads", "pools"].map((room) => `core/mesh/${room}`), "images", "images/libraries",
  ...["texels", "layout", "rays", "solve", "convert", "error", "bake"].map((room) => `maps/${room}`),
  ...["io", "json", "gltf", "gltf/codecs", "obj", "read"].map((room) => `model/${room}`),
  ...["shared", "bake", "check", "convert_map", "diff", "flip_green", "generate", "height_to_normal", "identify", "inspect", "render"]
    .map((room) => `commands/${room}`), "api",
];
/// Files that need threads, system memory, the disk, or readers of other formats; only_memory.cpp replaces some of
/// them.
const notHere = new Set([
  "core/tangents/mikktspace/plain.cpp", // a readable version, for tests
  "core/base/parallel.cpp", "core/base/arena.cpp", "core/tangents/many_meshes.cpp",
  "model/obj/tiny_obj_loader.cpp",
  ...["exr", "jpeg", "png", "webp"].map((name) => `images/libraries/${name}.cpp`),
  ...["float_image", "float_range", "map_coverage", "read_tga", "texture_vectors"].map((name) => `images/${name}.cpp`), "maps/rays/rays.cpp",
  "commands/generate/convert_maps.cpp", "commands/generate/mend_maps.cpp", "commands/diff/diff_words.cpp",
  "commands/shared/map_image_file.cpp", "commands/flip_green/texture_png.cpp",
  ...["bake/all_maps", "bake/bake_file", "bake/high_maps", "bake/match_meshes", "bake/model_maps", "bake/model_surfaces", "convert_map/convert_map_file",
    "height_to_normal/height_to_normal_file", "render/model_picture", "render/render_file"]
    .map((name) => `commands/${name}.cpp`),
]);
/// Reports as text and SARIF, which only the tool prints.
const isForPeople = (file) => /^commands\/(.*_text|shared\/text)\.cpp$/.test(file);
/// Functions with a single call are not inlined: large functions with hundreds of locals take more bytes and compress
/// worse. Functions smaller than their call are inlined. Loops are compiled without that limit, and the hottest ones
/// for speed, with inlining in the compiler: the linker inlines almost nothing.
const inlined = (threshold) => ["-mllvm", `-inline-threshold=${threshold}`];
const copiesLess = ["-mllvm", "-enable-pre=false", "-mllvm", "-jump-threading-threshold=0"];
const smallFlags = ["-fno-slp-vectorize", ...copiesLess, ...inlined(-15)];
const fastFlags = ["-O2", "-DTSPACE_FAST_KERNELS", ...inlined(600)];
const loops = /mikktspace\/(grid_order|weld|welded_mesh)\.cpp|core\/base\/(weld|range_lists)\.cpp|frames\/(split|sanitize)\.cpp/;
const hot = /mikktspace\/(corner_terms_kernel|one_pass\.cpp|node_sums\.cpp)|core\/pack\/\w+_kernel/;

const modules = {
  core: { sources: ["memory.cpp", "common.cpp", "core.cpp", "generate_normals.cpp", "plain_normals.cpp", "triangulate.cpp"], isFast: true, defines: [], rooms, kernels: ["normals", "tangents"], without: notPlain },
  normals: {
    sources: ["memory.cpp", "common.cpp", "generate_normals.cpp", "normals.cpp"], isFast: true, defines: [], rooms: [...rooms, "core/winding"], kernels: ["normals", "tangents"],
  },
  mikktspace: {
    sources: ["memory.cpp", "common.cpp", "mikktspace.cpp"], isFast: true, defines: ["TSPACE_MIKKTSPACE_ONLY"], rooms, kernels: ["tangents"], without: notPlain,
  },
  pack: { sources: ["memory.cpp", "pack.cpp"], isFast: true, defines: [], rooms: ["core/base", "core/pack"], kernels: ["pack"] },
  textures: {
    sources: ["memory.cpp", "textures.cpp"], isFast: true, hot: /fit_blocks|filtered_error/, defines: [], rooms: [], kernels: [], imports: ["canUnpack", "endCall", "unpack"],
    files: [
      ...["float_range", "image", "map_coverage", "map_layout", "texture_vectors"].map((name) => `images/${name}.cpp`),
      ...["astc", "basis_lz", "bc7", "dds", "ktx2", "texel_format", "texture", "uastc"].map((name) => `images/textures/${name}.cpp`),
      ...["blocks/filtered_error", "blocks/fit_blocks", "blocks/normal_levels", "blocks/roughness_levels", "texture_levels", "write_astc", "write_texture"].map((name) => `textures/${name}.cpp`),
      "maps/texels/shading.cpp",
    ],
  },
  gltf: {
    sources: ["heap.cpp", "c_library.cpp", "throw.cpp", "only_memory.cpp", "codecs.cpp", "images.cpp", "obj_parser.cpp", "gltf.cpp"], isFast: false,
    defines: ["TSPACE_THROWS_END_CALL", "TSPACE_HAS_IMAGES", "TSPACE_HAS_WEBP"],
    rooms: [...rooms, "core/winding", "core/pack", ...fileRooms], more: ["core/c_api/c_convert.cpp"], kernels: ["normals", "tangents", "pack"], throws: true,
    imports: [
      "attempt", "decodeDraco", "decodeImage", "decodeMeshopt", "encodeDraco", "encodeImage", "encodeMeshopt", "endCall", "findFile",
      "goOn", "hasCodec", "now", "parseNumber", "takeImage", "tell",
    ],
  },
};

// -finline-functions: emscripten disables inlining with -Oz, which increases the code size.
const flags = [
  "-std=c++20", "-Oz", "-flto", "-finline-functions", "-msimd128", "-mbulk-memory", "-msign-ext", "-mnontrapping-fptoint",
  "-ffp-contract=off", "-fno-fast-math", "-fno-math-errno", "-fno-trapping-math",
  "-fno-c++-static-destructors", "-DNDEBUG", "-DTSPACE_SERIAL", "-DTSPACE_SMALL", "-DTSPACE_SIMD_WASM", "-Wall", "-Wextra", "-Werror",
  `-I${root}/src`, `-I${root}/include`, `-I${here}`, "-include", join(here, "bit_cast.h"),
];

function write(path, text) {
  mkdirSync(dirname(path), { recursive: true });
  if (!existsSync(path) || readFileSync(path, "utf8") !== text) writeFileSync(path, text);
  return path;
}

/// Returns the kernels of a folder for the only CPU variant, like CMake; the hot kernel is compiled separately, with
/// other flags.
function kernelSources(room, isFast) {
  const text = readFileSync(join(root, "src/core/CMakeLists.txt"), "utf8");
  const kernels = [...text.matchAll(/tspace_simd_kernel\((\S+?)[ )]/g)].map(([, name]) => name)
    .filter((name) => name.startsWith(`${room}/`)).map((name) => `core/${name}_kernel.h`);
  const head = '// SPDX-License-Identifier: MIT\n#include "core/simd/lanes_wasm.h"\n#define TSPACE_LANES wasm\n';
  const source = (name, list) =>
    write(join(out, `${name}.cpp`), head + list.map((kernel) => `#include "${kernel}"\n`).join(""));
  const [fast, small] = [kernels.filter((k) => hot.test(k)), kernels.filter((k) => !hot.test(k))];
  const sources = [{ path: source(`kernels_${room}`, small), flags: [] }];
  if (fast.length !== 0) sources.push({ path: source(`kernels_${room}_hot`, fast), flags: isFast ? fastFlags : [] });
  return sources;
}

/// Compiles twelve files of a library as one, which takes a third of the time; hot files are compiled separately. Names
/// are unique within a library: the core, the file layer, and the C API on top of it.
function inBatches(name, rooms, isFast, more = [], without = []) {
  const all = rooms.flatMap((room) => readdirSync(join(root, "src", room)).sort().map((file) => `${room}/${file}`))
    .filter((file) => file.endsWith(".cpp") && !notHere.has(file) && !without.includes(file) && !isForPeople(file)).concat(more);
  const isAlone = (file) => hot.test(file) || loops.test(file);
  const files = all.filter((file) => !isAlone(file));
  const batches = all.filter(isAlone).map((file) => ({ path: join(root, "src", file), flags: isFast && hot.test(file) ? fastFlags : [] }));
  for (let i = 0; i < files.length; i += 12)
    batches.push({ path: write(join(out, `${name}_${i / 12}.cpp`), files.slice(i, i + 12).map((file) => `#include "${file}"\n`).join("")) });
  return batches;
}

function sourcesOf(name, module) {
  const isOf = (list) => (room) => list.includes(room);
  const libraries = {
    core: module.rooms.filter((room) => !isOf(fileRooms)(room)),
    files: module.rooms.filter((room) => isOf(fileRooms)(room) && room !== "api"),
    api: module.rooms.filter(isOf(["api"])),
  };
  const sources = Object.entries(libraries).flatMap(([library, list]) =>
    inBatches(`${name}_${library}`, list, module.isFast, library === "api" ? module.more : [], module.without));
  for (const room of module.kernels) sources.push(...kernelSources(room, module.isFast));
  for (const file of module.files ?? []) sources.push({ path: join(root, "src", file), flags: module.hot?.test(file) ? fastFlags : undefined });
  // The OBJ parser relies on wrapping overflow of exponents.
  for (const file of ["new.cpp", "state.cpp", ...module.sources])
    sources.push({ path: join(here, file), flags: file === "obj_parser.cpp" ? ["-fwrapv", ...smallFlags] : undefined });
  return sources;
}

function isCurrent(object, depfile) {
  if (!existsSync(object) || !existsSync(depfile)) return false;
  const made = statSync(object).mtimeMs;
  const needs = readFileSync(depfile, "utf8").replace(/\\\n/g, " ").split(":").slice(1).join(":").trim().split(/\s+/);
  return [...needs, fileURLToPath(import.meta.url)].every((path) => existsSync(path) && statSync(path).mtimeMs <= made);
}

async function compile(source, folder, module) {
  const stem = source.path.replace(`${root}/`, "").replaceAll("/", "_");
  const object = join(folder, `${stem}.o`);
  if (isCurrent(object, `${object}.d`)) return object;
  // Without -fexceptions, emscripten allows throwing, but nothing is caught. Only throw.cpp needs type information of
  // exceptions.
  const asksForTypes = source.path.endsWith("throw.cpp");
  const throwing = [...(module.throws ? [] : ["-fno-exceptions"]), ...(asksForTypes ? [] : ["-fno-rtti"])];
  await run("em++", [...flags, ...throwing, ...module.defines.map((d) => `-D${d}`), ...(source.flags ?? smallFlags), "-MMD", "-MF", `${object}.d`,
    "-c", source.path, "-o", object]).catch((error) => {
    console.error(error.stderr);
    process.exit(1);
  });
  return object;
}

/// Runs jobs in parallel, at most one per core.
async function inParallel(jobs) {
  const results = [];
  let next = 0;
  const work = async () => {
    for (let i; (i = next++) < jobs.length; ) results[i] = await jobs[i]();
  };
  await Promise.all(Array.from({ length: availableParallelism?.() ?? cpus().length }, work));
  return results;
}

/// Returns whether the linked module is up to date: no object is newer, and the list of objects is unchanged.
function isLinked(wasm, list, objects) {
  if (!existsSync(wasm) || !existsSync(list) || readFileSync(list, "utf8") !== objects.join("\n")) return false;
  const made = statSync(wasm).mtimeMs;
  return [...objects, fileURLToPath(import.meta.url)].every((path) => statSync(path).mtimeMs <= made);
}

async function link(name, module, objects) {
  const wasm = join(out, `${name}.wasm`), list = join(out, name, "linked.txt");
  if (isLinked(wasm, list, objects)) return;
  const libraries = (await run("em-config", ["CACHE"]).catch(() => ({ stdout: "" }))).stdout.trim() || "/usr/share/emscripten/cache";
  const folder = join(libraries, "sysroot/lib/wasm32-emscripten");
  const raw = join(out, `${name}_raw.wasm`);
  await run("wasm-ld-14", ["--no-entry", "--gc-sections", "--strip-all", "--stack-first", "-z", `stack-size=${module.throws ? 1048576 : 262144}`,
    `--initial-memory=${module.throws ? 2097152 : 1048576}`, "--max-memory=4294967296", "--lto-O2", "-mllvm", "-disable-lsr", ...copiesLess, ...inlined(-14000), ...objects,
    `-L${folder}/lto`, `-L${folder}`, ...(module.throws ? ["-ldlmalloc", "--export=stackSave", "--export=stackRestore", "--export-table"] : []),
    "-lc-optz", "-lc++-noexcept", "-lc++abi-noexcept", "-lcompiler_rt", "--export=__wasm_call_ctors", "--allow-undefined", "-o", raw]);
  // Low memory is unused: the first KB is the end of the stack, which no offset below 1024 can reach by wrapping around
  // 2^32.
  await run("wasm-opt", ["--enable-simd", "--enable-bulk-memory", "--enable-sign-ext", "--enable-mutable-globals",
    "--enable-nontrapping-float-to-int", module.isFast ? "-Os" : "-Oz", "--converge", "--low-memory-unused", "-ocimfs=12", "-aimfs=5", raw, "-o", wasm]);
  const bytes = readFileSync(wasm);
  const imports = WebAssembly.Module.imports(new WebAssembly.Module(bytes)).map((i) => i.name);
  const unknown = imports.filter((i) => !(module.imports ?? ["endCall"]).includes(i));
  if (unknown.length !== 0) throw new Error(`${name}.wasm imports ${unknown.join(", ")}`);
  writeFileSync(list, objects.join("\n"));
  console.log(`${name}.wasm: ${bytes.length} bytes, ${gzipSync(bytes, { level: 9 }).length} gzipped`);
}

// The system's header folder would hide the headers of emscripten.
mkdirSync(join(out, "include"), { recursive: true });
for (const name of ["nlohmann", "tiny_obj_loader.h"])
  if (!existsSync(join(out, "include", name))) symlinkSync(join("/usr/include", name), join(out, "include", name));
flags.push(`-I${join(out, "include")}`);
const chosen = process.argv.length > 3 ? process.argv.slice(3) : Object.keys(modules);
for (const name of chosen) {
  const module = modules[name];
  const folder = join(out, name);
  mkdirSync(folder, { recursive: true });
  const jobs = sourcesOf(name, module).map((source) => () => compile(source, folder, module));
  await link(name, module, await inParallel(jobs));
}
