// SPDX-License-Identifier: MIT
// Runs before all other scripts: the page must not contact any server except the one of a model in its address
// (`?model=`).
{
  let server = "";
  try {
    const named = new URLSearchParams(location.search).get("model");
    const url = named ? new URL(named, location.href) : null;
    if (url && /^https?:$/.test(url.protocol)) server = url.origin;
  } catch {
    // No valid address: no server may be contacted.
  }
  const meta = document.createElement("meta");
  meta.httpEquiv = "Content-Security-Policy";
  meta.content = `connect-src data: blob: ${server}`;
  document.head.append(meta);
}
