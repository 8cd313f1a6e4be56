// SPDX-License-Identifier: MIT
/// <reference types="vite/client" />
declare module "*.glb?inline" {
  const url: string;
  export default url;
}
