// SPDX-License-Identifier: MIT

/** The bytes of a file of this package. */
export async function load(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`tspace: cannot load ${url} (${answer.status})`);
  return answer.arrayBuffer();
}
