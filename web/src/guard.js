// SPDX-License-Identifier: MIT
// Runs before all else: the page may ask no server, or, where its address names a model by `?model=`, the one that has it.
{
  let server = "";
  try {
    const named = new URLSearchParams(location.search).get("model");
    const url = named ? new URL(named, location.href) : null;
    if (url && /^https?:$/.test(url.protocol)) server = url.origin;
  } catch {
    // No address: nobody is asked.
  }
  const meta = document.createElement("meta");
  meta.httpEquiv = "Content-Security-Policy";
  meta.content = `connect-src data: blob: ${server}`;
  document.head.append(meta);
}
