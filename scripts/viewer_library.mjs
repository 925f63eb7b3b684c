// Called by viewer.sh, beside the packages three and esbuild: library.mjs VERSION OUT
//
// Bundles what the viewer takes of three.js. The viewer has shaders of its own (RawShaderMaterial), no shadows,
// no environment maps and no headset, so that the modules of these are left out: whatever still names them gets
// what stands in `replaced`.

import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const [version, out] = process.argv.slice(2);
const taken = `
export { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry,
  Mesh, OrthographicCamera, PerspectiveCamera, RawShaderMaterial, Scene, Vector3, WebGLRenderer } from "three";
export { OrbitControls } from "three/addons/controls/OrbitControls.js";
`;
const replaced = {
  "renderers/shaders/ShaderChunk.js": "export const ShaderChunk = {};",
  "renderers/shaders/ShaderLib.js": "export const ShaderLib = {};",
  "extras/PMREMGenerator.js": "export class PMREMGenerator {}",
  "renderers/webgl/WebGLShadowMap.js": "export function WebGLShadowMap() { this.render = () => {}; }",
  "renderers/webxr/WebXRManager.js": `export class WebXRManager {
    enabled = false;
    isPresenting = false;
    addEventListener() {}
    removeEventListener() {}
    setAnimationLoop() {}
    getEnvironmentBlendMode() {}
    dispose() {}
  }`,
};

const unused = new Set(Object.keys(replaced));
const plugin = {
  name: "viewer",
  setup(build) {
    const three = `${process.cwd()}/node_modules/three/src/`;
    build.onResolve({ filter: /^three$/ }, () => ({ path: `${three}Three.js` }));
    build.onLoad({ filter: /three\/src\/.*\.js$/ }, ({ path }) => {
      const name = path.slice(three.length);
      unused.delete(name);
      return name in replaced ? { contents: replaced[name] } : undefined;
    });
  },
};

const { outputFiles } = await build({
  stdin: { contents: taken, resolveDir: process.cwd() },
  bundle: true,
  minify: true,
  format: "iife",
  globalName: "THREE",
  target: "es2020",
  charset: "ascii",
  legalComments: "none",
  plugins: [plugin],
  write: false,
});
if (unused.size > 0) throw new Error(`three.js ${version} has no ${[...unused].join(", ")}`);
const licence = readFileSync("node_modules/three/LICENSE", "utf8").trim();
const head = `/*\nPart of three.js ${version}, bundled by scripts/viewer.sh of netmesh.\n\n${licence}\n*/\n`;
writeFileSync(out, head + outputFiles[0].text);
