// SPDX-License-Identifier: MIT

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Uses a data URL, which the browser creates in one step. */
export const toBase64 = (bytes: Uint8Array<ArrayBuffer>): Promise<string> => new Promise((done, failed) => {
  const reader = new FileReader();
  reader.onload = () => done((reader.result as string).slice((reader.result as string).indexOf(",") + 1));
  reader.onerror = () => failed(reader.error);
  reader.readAsDataURL(new Blob([bytes]));
});
