// SPDX-License-Identifier: MIT
// All expensive work: reports on files, and frames of the parts that the page shows.
import { release as releaseCore } from "tspace";
import { release as releaseFiles } from "tspace/gltf";
import { decodeDraco, decodeMeshopt, forgetCodecs } from "./codecs.js";
import { computeFrames, cornersOf, mapCorners, otherFrames } from "./corners.js";
import { convertMapFile, decodeTexture } from "./texture_files.js";
import { generateModel, judgeImage, reportOn } from "./model_calls.js";
import type { Answer, Arrays, Question } from "./protocol.js";

const parts = new Map<number, Arrays>();
let turn = Promise.resolve();

function known(part: number): Arrays {
  const arrays = parts.get(part);
  if (!arrays) throw Object.assign(new Error("the part no longer exists"), { code: "unknownPart" });
  return arrays;
}

async function answerTo(question: Question): Promise<{ answer: unknown; transfer?: Transferable[] }> {
  switch (question.call) {
    case "report":
      return { answer: await reportOn(question.ask.verb, question.ask.model) };
    case "image":
      return { answer: await judgeImage(question.ask.model) };
    case "convertMap": {
      const answer = await convertMapFile(question.ask);
      return { answer, transfer: [answer.bytes.buffer] };
    }
    case "generate":
      return { answer: await generateModel(question.ask.model, question.ask.options) };
    case "corners": {
      if (question.ask.part !== null) parts.set(question.ask.part, question.ask.arrays);
      const answer = await cornersOf(question.ask.arrays);
      const buffers = [answer.positions, answer.normals, answer.islands, answer.uvs, answer.tangents].map((array) => array?.buffer);
      return { answer, transfer: [...new Set(buffers)].filter((buffer) => buffer !== undefined) };
    }
    case "map": {
      const answer = mapCorners(question.ask.arrays);
      return { answer, transfer: [answer.uvs.buffer, answer.islands.buffer] };
    }
    case "frames": {
      const answer = await computeFrames(known(question.ask.part), question.ask.method);
      return { answer, transfer: [answer.tangents.buffer, answer.errors.buffer] };
    }
    case "otherFrames": {
      const answer = otherFrames(known(question.ask.part), question.ask.arrays);
      return { answer, transfer: answer ? [answer.tangents.buffer, answer.errors.buffer] : [] };
    }
    case "meshopt": {
      const answer = await decodeMeshopt(question.ask);
      return { answer, transfer: [answer.buffer] };
    }
    case "draco": {
      const answer = await decodeDraco(question.ask);
      return { answer, transfer: [answer.indices.buffer, ...answer.attributes.map(({ values }) => values.buffer)] };
    }
    case "texture": {
      const answer = await decodeTexture(question.ask.file);
      return { answer, transfer: [answer.rgba.buffer] };
    }
    case "forget":
      parts.clear();
      forgetCodecs();
      // WebAssembly memory never shrinks, so the instances are discarded with the model.
      releaseCore();
      releaseFiles();
      return { answer: null };
  }
}

/** Calls whose errors are about the file, unless they have another code. */
const readers = new Set<string>(["meshopt", "draco", "texture", "image", "convertMap"]);

async function serve(question: Question): Promise<void> {
  try {
    const { answer, transfer = [] } = await answerTo(question);
    self.postMessage({ id: question.id, answer } satisfies Answer, { transfer });
  } catch (error) {
    const isFault = error instanceof TypeError || error instanceof ReferenceError || !readers.has(question.call);
    const code = String((error as { code?: unknown }).code ?? (isFault ? "internal" : "unreadable"));
    const message = error instanceof Error ? error.message : String(error);
    self.postMessage({ id: question.id, code, message } satisfies Answer);
  }
}

self.onmessage = ({ data }: MessageEvent<Question>) => {
  turn = turn.then(() => serve(data));
};
