// SPDX-License-Identifier: MIT
// The shader of all looks except the surface. N and T are unit at the vertices (frame.ts) but not between them: only
// the shading normal is normalized, as bakers expect. The frames of the file are to the left of the split line, those
// of the chosen method to its right.
import { GLSL3, RawShaderMaterial, type Texture, type Vector3 } from "three";
import { glsl, heat, heatDegrees, noData, signMinus, signPlus, wrong } from "../color.js";
import { frameGlsl } from "./frame.js";

export const looks = ["lit", "difference", "normals", "signs", "mirrored", "error", "islands"] as const;
export type Look = (typeof looks)[number];

const vertexShader = `
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
uniform bool uIsMap;
uniform vec4 uMapArea;
uniform int uFirst;
in vec3 position, normal;
in vec2 mapUv, colorUv, island, error;
in vec4 fileTangent, right;
out vec3 vPlace, vNormal, vTangent, vBitangent, vRightTangent, vRightBitangent, vEdge;
out vec2 vUv, vColorUv, vError;
flat out vec2 vIsland;
flat out vec3 vSigns;
flat out int vTriangle;
${frameGlsl}
void main() {
  vec4 place = modelMatrix * vec4(position, 1.0);
  vPlace = place.xyz;
  mat3 linear = linearOf(modelMatrix);
  vNormal = placedNormal(linear, normal);
  placeTangent(linear, vNormal, fileTangent, vTangent, vBitangent);
  placeTangent(linear, vNormal, right, vRightTangent, vRightBitangent);
  vUv = mapUv;
  vColorUv = colorUv;
  vIsland = island;
  vSigns = vec3(fileTangent.w, right.w, error.y);
  vError = error;
  vTriangle = uFirst + gl_VertexID / 3;
  int corner = gl_VertexID % 3;
  vEdge = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = uIsMap ? vec4((mapUv * uMapArea.xy + uMapArea.zw) * vec2(2.0, -2.0) + vec2(-1.0, 1.0), 0.0, 1.0)
                       : projectionMatrix * viewMatrix * place;
}`;

const fragmentShader = `
precision highp float;
precision highp int;
uniform int uLook, uMap;
uniform bool uHasTangents, uHasRight, uRightGreen, uHasNormalMap, uHasColorMap, uWire, uIsPick, uIsMap, uUseColors;
uniform float uSplit, uScale, uAlphaTest;
uniform vec3 uColor, uLight, uEye;
uniform sampler2D uNormalMap, uRightMap, uColorMap;
in vec3 vPlace, vNormal, vTangent, vBitangent, vRightTangent, vRightBitangent, vEdge;
in vec2 vUv, vColorUv, vError;
flat in vec2 vIsland;
flat in vec3 vSigns;
flat in int vTriangle;
out vec4 outColor;

// Straight between the stops of the scale.
vec3 scaleColor(float degrees) {
  const vec3 stops[${heat.length}] = vec3[](${heat.map(glsl).join(", ")});
  const float ends[${heat.length}] = float[](${heatDegrees.map((x) => x.toFixed(1)).join(", ")});
  int low = 0;
  while (low < ${heat.length - 2} && degrees > ends[low + 1]) ++low;
  return mix(stops[low], stops[low + 1], clamp((degrees - ends[low]) / (ends[low + 1] - ends[low]), 0.0, 1.0));
}

// T and B from the slopes of position and UV over pixels: what a renderer does where a file has no tangents.
void slopeFrame(vec3 n, out vec3 t, out vec3 b) {
  vec3 dx = dFdx(vPlace), dy = dFdy(vPlace);
  vec2 ux = dFdx(vUv), uy = dFdy(vUv);
  vec3 acrossY = cross(dy, n), acrossX = cross(n, dx);
  t = acrossY * ux.x + acrossX * uy.x;
  b = -(acrossY * ux.y + acrossX * uy.y);
  float longest = max(dot(t, t), dot(b, b));
  float k = longest > 0.0 ? inversesqrt(longest) : 0.0;
  t *= k;
  b *= k;
}

vec3 shadingNormal(bool isRight) {
  vec3 n = vNormal;
  if (!gl_FrontFacing) n = -n;
  if (!uHasNormalMap || uMap == 0) return normalize(n);
  vec3 texel = (isRight ? texture(uRightMap, vUv) : texture(uNormalMap, vUv)).xyz * 2.0 - 1.0;
  texel.xy *= uScale;
  if (uMap == 2 || (isRight && uRightGreen)) texel.y = -texel.y;
  vec3 t, b;
  if (isRight && uHasRight) { t = vRightTangent; b = vRightBitangent; }
  else if (!isRight && uHasTangents) { t = vTangent; b = vBitangent; }
  else slopeFrame(normalize(n), t, b);
  if (!gl_FrontFacing) { t = -t; b = -b; }
  return normalize(texel.x * t + texel.y * b + texel.z * n);
}

// Degrees between the directions that light falls on, by the file and by the correct frames.
float degreesApart() {
  vec3 a = shadingNormal(false), b = shadingNormal(true);
  return degrees(atan(length(cross(a, b)), dot(a, b)));
}

vec3 toScreen(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(max(c, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec3 lit(vec3 base, vec3 n) {
  vec3 l = normalize(uLight), eye = normalize(uEye - vPlace), middle = normalize(l + eye);
  float direct = max(dot(n, l), 0.0);
  float sky = 0.14 + 0.06 * n.y;
  float gloss = direct > 0.0 ? pow(max(dot(n, middle), 0.0), 48.0) : 0.0;
  return base * (sky + 0.95 * direct) + vec3(0.16 * gloss);
}

// Enough light to see the shape under flat colors.
vec3 shaped(vec3 screenColor) {
  if (uIsMap) return screenColor;
  vec3 n = normalize(gl_FrontFacing ? vNormal : -vNormal);
  return screenColor * (0.66 + 0.34 * abs(dot(n, normalize(uEye - vPlace))));
}

vec3 islandColor(float number) {
  float hue = fract(number * 0.618034 + 0.08);
  vec3 wheel = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
  return mix(vec3(0.78), wheel, 0.5) * (0.72 + 0.22 * fract(number * 0.381966));
}

float stripes() { return step(0.5, fract((gl_FragCoord.x + gl_FragCoord.y) / 9.0)); }

void main() {
  if (uIsPick) {
    int id = vTriangle + 1;
    outColor = vec4(id & 255, (id >> 8) & 255, (id >> 16) & 255, (id >> 24) & 255) / 255.0;
    return;
  }
  vec4 base = vec4(uUseColors ? uColor : vec3(0.52), 1.0);
  if (uHasColorMap) {
    vec4 texel = texture(uColorMap, vColorUv);
    if (uUseColors) base *= texel; else base.a *= texel.a;
  }
  if (uAlphaTest > 0.0 && base.a < uAlphaTest) discard;
  bool isRight = gl_FragCoord.x >= uSplit;
  vec3 color;
  if (uLook == 0) color = toScreen(lit(base.rgb, shadingNormal(isRight)));
  else if (uLook == 1) color = shaped(scaleColor(degreesApart()));
  else if (uLook == 2) color = 0.5 + 0.5 * shadingNormal(isRight);
  else if (uLook == 3) {
    bool has = isRight ? uHasRight : uHasTangents;
    float w = isRight ? vSigns.y : vSigns.x;
    color = !has ? ${glsl(noData)} : w > 0.0 ? ${glsl(signPlus)} : ${glsl(signMinus)};
    if (!isRight && uHasTangents && vSigns.z > 0.5 && stripes() > 0.5) color = ${glsl(wrong)};
    color = shaped(color);
  } else if (uLook == 4) color = shaped(vIsland.y == 0.5 ? ${glsl(noData)} : vIsland.y > 0.5 ? ${glsl(signMinus)} : ${glsl(signPlus)});
  else if (uLook == 5) {
    color = vError.x < 0.0 ? ${glsl(noData)} : scaleColor(vError.x);
    if (vSigns.z > 0.5 && stripes() > 0.5) color = ${glsl(wrong)};
    color = shaped(color);
  } else {
    color = islandColor(vIsland.x);
    if (vIsland.y > 0.5 && stripes() > 0.5) color *= 0.72;
    color = shaped(color);
  }
  if (uWire) {
    vec3 width = fwidth(vEdge), near = smoothstep(vec3(0.0), width * 1.3, vEdge);
    color = mix(dot(color, vec3(0.33)) > 0.45 ? vec3(0.05) : vec3(0.95), color, 0.45 + 0.55 * min(near.x, min(near.y, near.z)));
  }
  outColor = vec4(color, 1.0);
}`;

export interface PictureValues {
  look: Look;
  /** 0: off; 1: on; 2: on, with inverted green. */
  map: 0 | 1 | 2;
  isWire: boolean;
  usesColors: boolean;
  /** Position of the split line in pixels of the canvas, from the left. */
  split: number;
  light: Vector3;
  eye: Vector3;
}

export function makeMaterial(options: { normalMap: Texture | null; colorMap: Texture | null; scale: number; color: Vector3; alphaTest: number; hasTangents: boolean; side: 0 | 2 }, empty: Texture): RawShaderMaterial {
  const value = <T>(v: T) => ({ value: v });
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader,
    fragmentShader,
    side: options.side,
    uniforms: {
      uIsMap: value(false), uMapArea: value([1, 1, 0, 0]), uFirst: value(0),
      uLook: value(0), uMap: value(1), uHasTangents: value(options.hasTangents), uHasRight: value(false), uRightGreen: value(false),
      uHasNormalMap: value(options.normalMap !== null), uHasColorMap: value(options.colorMap !== null),
      uWire: value(false), uIsPick: value(false), uUseColors: value(true), uSplit: value(0), uScale: value(options.scale),
      uAlphaTest: value(options.alphaTest),
      uColor: value(options.color), uLight: value(null), uEye: value(null),
      uNormalMap: value(options.normalMap ?? empty), uRightMap: value(options.normalMap ?? empty), uColorMap: value(options.colorMap ?? empty),
    },
  });
}

export function setValues(material: RawShaderMaterial, values: PictureValues): void {
  const u = material.uniforms;
  u.uLook.value = looks.indexOf(values.look);
  u.uMap.value = values.map;
  u.uWire.value = values.isWire;
  u.uUseColors.value = values.usesColors;
  u.uSplit.value = values.split;
  u.uLight.value = values.light;
  u.uEye.value = values.eye;
}
