#!/usr/bin/env node
// Draws an exported scene in three.js under an environment, three times: by image-based light alone,
// with the occlusion textures, and with the light map by the shader that was exported along with it.
// The pictures are Radiance files, to be compared with Patina's own:
//   patina bake light SCENE --environment HDR -o map.exr
//   patina export SCENE --environment HDR --bakes map.exr -o scene.glb
//   patina render SCENE --environment HDR --renderer path --samples 128 --size 480x360 --json -o truth.exr
//   node …/scripts/check-three-light-map.mjs scene.glb HDR YAW,PITCH,DISTANCE,X,Y,Z,FOV OUT
//   for way in none occlusion map; do patina compare OUT-$way.hdr truth.exr; done
// The camera's numbers are those that the --json of the render has. Packages are looked for in the
// current folder: npm install three puppeteer-core; the browser is Debian's chromium.
import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';

const here = createRequire(path.join(process.cwd(), 'here.js'));
const puppeteer = here('puppeteer-core');
const modules = path.join(process.cwd(), 'node_modules');
const [glb, environment, camera, out] = process.argv.slice(2);
const width = 480;
const height = 360;

const page = `<!doctype html>
<script type="importmap">{"imports": {"three": "/three/build/three.module.js",
  "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { HDRLoader } from 'three/addons/loaders/HDRLoader.js';

const [yaw, pitch, distance, x, y, z, fov] = [${camera}];
async function texture(name) {
  const result = await new EXRLoader().loadAsync('/scene/' + name);
  result.flipY = true; // the loader puts the last row first, glTF's v = 0 is the first
  result.wrapS = result.wrapT = THREE.RepeatWrapping;
  result.needsUpdate = true;
  return result;
}
window.draw = async (way) => {
  const renderer = new THREE.WebGLRenderer();
  renderer.setSize(${width}, ${height});
  const scene = new THREE.Scene();
  const sky = await new HDRLoader().setDataType(THREE.FloatType).loadAsync('/environment');
  sky.mapping = THREE.EquirectangularReflectionMapping;
  scene.environment = scene.background = sky;
  scene.environmentRotation.y = scene.backgroundRotation.y = Math.PI / 2; // as Patina looks it up
  const gltf = await new GLTFLoader().loadAsync('/scene/${path.basename(glb)}');
  scene.add(gltf.scene);
  const materials = new Set();
  gltf.scene.traverse((object) => {
    if (object.isMesh) materials.add(object.material);
    if (object.isLight) object.visible = false;
  });
  const shader = gltf.userData.patinaBakedLight?.shader ?? gltf.parser.json.extras?.patinaBakedLight?.shader;
  const text = way === 'map' ? await (await fetch('/scene/' + shader)).text() : '';
  for (const material of materials) {
    if (way !== 'occlusion') material.aoMap = null;
    const names = material.userData.patinaBakedLight;
    if (way === 'map' && names) {
      const irradiance = await texture(names.irradiance);
      const reflections = await texture(names.reflections);
      material.lightMap = irradiance; // for its texture coordinates alone
      material.lightMapIntensity = 0;
      material.onBeforeCompile = (program) => {
        program.uniforms.lightMapIrradiance = { value: irradiance };
        program.uniforms.lightMapReflections = { value: reflections };
        program.fragmentShader = program.fragmentShader
          .replace('void main() {', text + '\\nvoid main() {')
          .replace('#include <lights_fragment_maps>', \`#include <lights_fragment_maps>
            iblIrradiance = lightMapDiffuse(vLightMapUv, iblIrradiance);
            radiance = lightMapReflected(vLightMapUv, inverseTransformDirection(
              reflect(-geometryViewDir, geometryNormal), viewMatrix), radiance);\`);
      };
      material.customProgramCacheKey = () => material.name;
    }
    material.needsUpdate = true;
  }
  const view = new THREE.PerspectiveCamera(fov, ${width / height}, 0.01, 1000);
  const radians = Math.PI / 180;
  view.position.set(
    x + distance * Math.sin(yaw * radians) * Math.cos(pitch * radians),
    y + distance * Math.sin(pitch * radians),
    z + distance * Math.cos(yaw * radians) * Math.cos(pitch * radians));
  view.lookAt(x, y, z);
  const target = new THREE.WebGLRenderTarget(${width}, ${height}, { type: THREE.FloatType, samples: 4 });
  renderer.setRenderTarget(target);
  renderer.render(scene, view);
  const pixels = new Float32Array(${4 * width * height});
  renderer.readRenderTargetPixels(target, 0, 0, ${width}, ${height}, pixels);
  return Array.from(pixels);
};
document.title = 'ready';
</script>`;

// A Radiance file of RGBA floats whose last row comes first.
function radiance(pixels) {
  const bytes = Buffer.alloc(4 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const from = 4 * ((height - 1 - y) * width + x);
      const rgb = pixels.slice(from, from + 3).map((value) => Math.max(value, 0));
      const largest = Math.max(...rgb);
      if (largest < 1e-32) continue;
      const exponent = Math.floor(Math.log2(largest)) + 1;
      const scale = 256 / 2 ** exponent;
      const at = 4 * (y * width + x);
      rgb.forEach((value, c) => (bytes[at + c] = Math.min(Math.floor(value * scale), 255)));
      bytes[at + 3] = exponent + 128;
    }
  const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
  return Buffer.concat([Buffer.from(header, 'latin1'), bytes]);
}

const types = { '.js': 'text/javascript' };
const server = http.createServer((request, answer) => {
  const name = decodeURIComponent(request.url);
  const file =
    name === '/environment' ? environment
    : name.startsWith('/scene/') ? path.join(path.dirname(glb), path.basename(name))
    : path.join(modules, path.normalize(name));
  if (name === '/') {
    answer.writeHead(200, { 'content-type': 'text/html' });
    answer.end(page);
  } else if (!fs.existsSync(file)) {
    answer.writeHead(404);
    answer.end();
  } else {
    answer.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' });
    answer.end(fs.readFileSync(file));
  }
});
await new Promise((ready) => server.listen(0, 'localhost', ready));
const browser = await puppeteer.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  for (const way of ['none', 'occlusion', 'map']) {
    const tab = await browser.newPage();
    await tab.goto(`http://localhost:${server.address().port}/`);
    await tab.waitForFunction(() => document.title === 'ready');
    fs.writeFileSync(`${out}-${way}.hdr`, radiance(await tab.evaluate((which) => window.draw(which), way)));
    console.log(`${out}-${way}.hdr`);
    await tab.close();
  }
} finally {
  await browser.close();
  server.close();
}
