// SPDX-License-Identifier: MIT
// The picture at the top: a ring in 3D, lit by its normals left of a line, and by a normal map in the frame T, B, N right of
// it. The frame is drawn at the pointer.

import { grayOf, texelAt } from "./plate";
import { add, dot, scale, text, unit, type Vec2, type Vec3 } from "./vector";

const kWidth = 640, kHeight = 340, kScale = 150;  // picture size in pixels, and pixels per unit
const kMajor = 1, kMinor = 0.44;
/** Repetitions of the map along and around the ring, such that its plates are square. */
const kAlong = 10, kAround = 3;
const kLight = unit([-0.5, 0.65, 0.6]);
const kStart = { yaw: -0.35, pitch: 0.62 };

/** Hit of a ray: position, frame and UV of the surface, in the ring's object space. */
interface Hit {
  normal: Vec3;
  tangent: Vec3;
  bitangent: Vec3;
  uv: Vec2;
}

const distance = (p: Vec3): number => Math.hypot(Math.hypot(p[0], p[2]) - kMajor, p[1]) - kMinor;

/** Intersects a ray with the ring; returns its smallest distance from the surface if there is no hit. */
function march(from: Vec3, along: Vec3): Hit | number {
  let nearest = Infinity, p = from;
  for (let i = 0, gone = 0; i < 60 && gone < 6; ++i) {
    const d = distance(p);
    if (d < 0.0015) return frameAt(p);
    nearest = Math.min(nearest, d);
    gone += d;
    p = add(from, scale(gone, along));
  }
  return nearest;
}

function frameAt([x, y, z]: Vec3): Hit {
  const a = Math.atan2(z, x), b = Math.atan2(y, Math.hypot(x, z) - kMajor);
  const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
  // u runs against the angle a, so that B = cross(N, T) grows with v.
  return { normal: [cb * ca, sb, cb * sa], tangent: [sa, 0, -ca], bitangent: [-sb * ca, cb, -sb * sa], uv: [(-a / (2 * Math.PI)) * kAlong, (b / (2 * Math.PI)) * kAround] };
}

export function showHero(canvas: HTMLCanvasElement, line: HTMLInputElement, said: HTMLElement) {
  canvas.width = kWidth;
  canvas.height = kHeight;
  const pixels = canvas.getContext("2d");
  let { yaw, pitch } = kStart, probe: Vec2 = [0.42, -0.62], isAsked = false;

  /** Returns the rotations from camera space to the ring's object space (`inside`) and back (`seen`). */
  const turns = () => {
    const [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    const right: Vec3 = [cy, 0, -sy], up: Vec3 = [-sy * sp, cp, -cy * sp], back: Vec3 = [sy * cp, sp, cy * cp];
    return {
      inside: (v: Vec3): Vec3 => add(add(scale(v[0], right), scale(v[1], up)), scale(v[2], back)),
      seen: (v: Vec3): Vec3 => [dot(v, right), dot(v, up), dot(v, back)],
    };
  };
  const placeOf = (x: number, y: number): Vec2 => [(x - kWidth / 2) / kScale, (kHeight / 2 - y) / kScale];

  const draw = () => {
    isAsked = false;
    if (!pixels) return;
    const { inside, seen } = turns(), along = inside([0, 0, -1]), light = inside(kLight), border = (Number(line.value) / 100) * kWidth;
    const image = pixels.createImageData(kWidth, kHeight);
    for (let i = 0; i < kWidth * kHeight; ++i) {
      const x = (i % kWidth) + 0.5, y = Math.floor(i / kWidth) + 0.5, [a, b] = placeOf(x, y);
      if (Math.hypot(a, b) > kMajor + kMinor + 0.02) continue;
      const hit = march(inside([a, b, 3]), along);
      if (typeof hit === "number") continue;
      const n = texelAt(...hit.uv);
      const shaded = x < border ? hit.normal : unit(add(add(scale(n[0], hit.tangent), scale(n[1], hit.bitangent)), scale(n[2], hit.normal)));
      const gray = grayOf(dot(shaded, light)), rim = 1 - Math.max(0, -dot(hit.normal, along));
      image.data.set([0.98 * gray, 0.92 * gray + 6 * rim, 0.84 * gray + 26 * rim, 255], 4 * i);
    }
    pixels.putImageData(image, 0, 0);
    drawLine(border);
    drawFrame(inside, seen);
  };

  const drawLine = (border: number) => {
    pixels!.fillStyle = "#0008";
    pixels!.fillRect(border - 2, 0, 4, kHeight);
    pixels!.fillStyle = "#fff";
    pixels!.fillRect(border - 1, 0, 2, kHeight);
  };

  const drawFrame = (inside: (v: Vec3) => Vec3, seen: (v: Vec3) => Vec3) => {
    const hit = march(inside([probe[0], probe[1], 3]), inside([0, 0, -1]));
    if (typeof hit === "number") return;
    const style = getComputedStyle(document.documentElement), from: Vec2 = [kWidth / 2 + probe[0] * kScale, kHeight / 2 - probe[1] * kScale];
    const names = [["T", hit.tangent, "--tangent"], ["B", hit.bitangent, "--bitangent"], ["N", hit.normal, "--normal"]] as const;
    // Draw arrows that point away from the eye first.
    for (const [name, v, color] of [...names].sort((a, b) => seen(a[1])[2] - seen(b[1])[2])) {
      const s = seen(v);
      arrow(from, [from[0] + 62 * s[0], from[1] - 62 * s[1]], name, style.getPropertyValue(color));
    }
    const n = texelAt(...hit.uv);
    said.textContent = `At the pointer: texel (${n.map((c) => text(c)).join(", ")}), so the shaded normal is ${text(n[0])} T + ${text(n[1])} B + ${text(n[2])} N.`;
  };

  const arrow = (from: Vec2, to: Vec2, name: string, color: string) => {
    const size = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1, x = (to[0] - from[0]) / size, y = (to[1] - from[1]) / size, head = Math.min(13, size);
    for (const [width, paint] of [[7, "#ffffffd0"], [3.5, color]] as const) {
      pixels!.strokeStyle = pixels!.fillStyle = paint;
      pixels!.lineWidth = width;
      pixels!.lineJoin = "round";
      pixels!.beginPath();
      pixels!.moveTo(...from);
      pixels!.lineTo(to[0] - head * x, to[1] - head * y);
      pixels!.stroke();
      pixels!.beginPath();
      pixels!.moveTo(to[0] - head * x - 6 * y, to[1] - head * y + 6 * x);
      pixels!.lineTo(...to);
      pixels!.lineTo(to[0] - head * x + 6 * y, to[1] - head * y - 6 * x);
      pixels!.closePath();
      pixels!.fill();
      if (width > 4) pixels!.stroke();
    }
    pixels!.font = "bold 20px system-ui, sans-serif";
    pixels!.textAlign = "center";
    pixels!.textBaseline = "middle";
    pixels!.lineWidth = 4;
    pixels!.strokeStyle = "#ffffffd0";
    pixels!.strokeText(name, to[0] + 14 * x, to[1] + 14 * y);
    pixels!.fillText(name, to[0] + 14 * x, to[1] + 14 * y);
  };

  const ask = () => {
    canvas.setAttribute("aria-valuenow", String(Math.round((yaw * 180) / Math.PI)));
    canvas.setAttribute("aria-valuetext", `rotated by ${Math.round((yaw * 180) / Math.PI)} degrees, tilted by ${Math.round((pitch * 180) / Math.PI)}`);
    if (!isAsked) requestAnimationFrame(draw);
    isAsked = true;
  };
  const turn = (x: number, y: number) => {
    yaw -= x;
    pitch = Math.min(1.5, Math.max(-1.5, pitch + y));
    ask();
  };
  const pointed = (event: PointerEvent): Vec2 => {
    const box = canvas.getBoundingClientRect();
    return placeOf(((event.clientX - box.left) / box.width) * kWidth, ((event.clientY - box.top) / box.height) * kHeight);
  };
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) return turn(event.movementX / 140, event.movementY / 140);
    probe = pointed(event);
    ask();
  });
  canvas.addEventListener("keydown", (event) => {
    const moves: Record<string, Vec2> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    turn(...move);
  });
  line.addEventListener("input", ask);
  ask();
  draw();
}
