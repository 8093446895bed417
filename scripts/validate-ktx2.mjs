#!/usr/bin/env node
// Reads KTX2 files with ktx-parse, a reader that is not ours, and checks what Patina writes: sizes,
// levels, data format descriptor, orientation, finite texels. Ends with status 1 on any complaint.
// The reader is looked for in the current folder: npm install ktx-parse
//   node …/scripts/validate-ktx2.mjs FILE…
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const resolve = createRequire(path.join(process.cwd(), 'here.js')).resolve;
const { read } = await import(pathToFileURL(resolve('ktx-parse')));

const half = (bits) => {
  const exponent = (bits >> 10) & 31, mantissa = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (1024 + mantissa) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
};
const formats = {
  97: { name: 'RGBA16F', bytes: 8, typeSize: 2, samples: 4,
        red: (view, at) => half(view.getUint16(at, true)) },
  109: { name: 'RGBA32F', bytes: 16, typeSize: 4, samples: 4,
         red: (view, at) => view.getFloat32(at, true) },
  123: { name: 'RGB9E5', bytes: 4, typeSize: 4, samples: 6,
         red: (view, at) => {
           const texel = view.getUint32(at, true);
           return (texel & 511) * 2 ** ((texel >>> 27) - 24);
         } },
};

function complaints(file) {
  const found = [];
  const expect = (fact, text) => fact || found.push(text);
  const data = new Uint8Array(fs.readFileSync(file));
  const texture = read(data);
  const format = formats[texture.vkFormat];
  if (!format) return [`unknown vkFormat ${texture.vkFormat}`];
  const { pixelWidth: width, pixelHeight: height, faceCount: faces, levels } = texture;
  expect(texture.typeSize === format.typeSize, `typeSize ${texture.typeSize}`);
  expect(texture.supercompressionScheme === 0, 'is supercompressed');
  expect(texture.layerCount === 0 && texture.pixelDepth === 0, 'is an array or a volume');
  expect(faces === 1 || (faces === 6 && width === height), `${faces} faces of ${width} × ${height}`);
  expect(levels.length <= Math.log2(Math.max(width, height)) + 1, `${levels.length} levels`);
  const [dfd] = texture.dataFormatDescriptor;
  expect(dfd.colorModel === 1 && dfd.colorPrimaries === 1 && dfd.transferFunction === 1,
         'is not linear RGB of BT.709');
  expect(dfd.samples.length === format.samples, `${dfd.samples.length} samples`);
  expect(dfd.bytesPlane[0] === format.bytes, `bytesPlane ${dfd.bytesPlane[0]}`);
  const { KTXorientation: orientation, KTXwriter: writer } = texture.keyValue;
  expect(orientation === 'rd', `KTXorientation ${orientation}`);
  console.log(`${file}: ${format.name}, ${width} × ${height}, ${faces} faces, ` +
              `${levels.length} levels, by ${writer}`);
  levels.forEach(({ levelData }, i) => {
    const w = Math.max(1, width >> i), h = Math.max(1, height >> i);
    expect(levelData.byteLength === faces * w * h * format.bytes, `level ${i}: size`);
    const view = new DataView(levelData.buffer, levelData.byteOffset, levelData.byteLength);
    let sum = 0;
    for (let at = 0; at < levelData.byteLength; at += format.bytes) sum += format.red(view, at);
    expect(Number.isFinite(sum), `level ${i}: not finite`);
    console.log(`  level ${i}: ${w} × ${h}, mean of red ${(sum / (faces * w * h)).toPrecision(6)}`);
  });
  return found;
}

for (const file of process.argv.slice(2)) {
  let found;
  try {
    found = complaints(file);
  } catch (error) {
    found = [error.message];
  }
  for (const text of found) console.log(`  ${file}: ${text}`);
  if (found.length > 0) process.exitCode = 1;
}
