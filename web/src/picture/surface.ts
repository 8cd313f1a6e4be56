// SPDX-License-Identifier: MIT
// A three.js material whose normal map uses our frames: those of the file to the left of the split line, correct ones
// to its right. Everything else (metalness, roughness, alpha, emission, clearcoat, transmission) is unchanged.
import type { Material, Texture } from "three";
import { frameGlsl } from "./frame.js";

export interface SurfaceUniforms {
  uSplit: { value: number };
  uMap: { value: number };
  uHasTangents: { value: boolean };
  uHasRight: { value: boolean };
  uRightGreen: { value: boolean };
  uRightMap: { value: Texture };
}

const vertexHead = `#include <common>
in vec4 fileTangent, right;
out vec3 vOwnNormal, vFileTangent, vFileBitangent, vRightTangent, vRightBitangent;
${frameGlsl}`;

// N and T are unit at the vertices but not between them: only the shading normal is normalized, as bakers expect.
const vertexBody = `#include <normal_vertex>
mat3 toEye = linearOf(modelViewMatrix);
vOwnNormal = placedNormal(toEye, normal);
placeTangent(toEye, vOwnNormal, fileTangent, vFileTangent, vFileBitangent);
placeTangent(toEye, vOwnNormal, right, vRightTangent, vRightBitangent);`;

const fragmentHead = `#include <common>
uniform float uSplit;
uniform int uMap;
uniform bool uHasTangents, uHasRight, uRightGreen;
uniform sampler2D uRightMap;
in vec3 vOwnNormal, vFileTangent, vFileBitangent, vRightTangent, vRightBitangent;`;

// Without tangents, three.js computes a frame whose B points against v.
const fragmentBody = `#ifdef USE_NORMALMAP_TANGENTSPACE
if (uMap != 0) {
  bool isRight = gl_FragCoord.x >= uSplit;
  vec3 texel = (isRight ? texture2D(uRightMap, vNormalMapUv) : texture2D(normalMap, vNormalMapUv)).xyz * 2.0 - 1.0;
  texel.xy *= normalScale.x;
  if (uMap == 2 || (isRight && uRightGreen)) texel.y = -texel.y;
  bool hasFrame = isRight ? uHasRight : uHasTangents;
  vec3 t = isRight ? vRightTangent : vFileTangent, b = isRight ? vRightBitangent : vFileBitangent;
  float side = 1.0;
  #ifdef DOUBLE_SIDED
    side = faceDirection;
  #endif
  normal = hasFrame ? normalize(side * (texel.x * t + texel.y * b + texel.z * vOwnNormal)) : normalize(tbn * vec3(texel.x, -texel.y, texel.z));
}
#elif defined(USE_BUMPMAP)
#include <normal_fragment_maps>
#endif`;

function replaced(text: string, part: string, by: string): string {
  if (!text.includes(part)) throw new Error(`this version of three.js does not have the shader part ${part}`);
  return text.replace(part, by);
}

/** Returns the material as the page draws it. It shares the textures of `source`. */
export function surfaceFor(source: Material, uniforms: SurfaceUniforms): Material {
  const surface = source.clone();
  // Flat normals are part of the geometry.
  if ("flatShading" in surface) surface.flatShading = false;
  surface.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    if (!shader.fragmentShader.includes("#include <normal_fragment_maps>")) return; // unlit
    shader.vertexShader = replaced(replaced(shader.vertexShader, "#include <common>", vertexHead), "#include <normal_vertex>", vertexBody);
    shader.fragmentShader = replaced(replaced(shader.fragmentShader, "#include <common>", fragmentHead), "#include <normal_fragment_maps>", fragmentBody);
  };
  surface.customProgramCacheKey = () => "frames";
  return surface;
}
