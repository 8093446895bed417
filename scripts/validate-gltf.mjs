#!/usr/bin/env node
// Checks glTF and GLB files with Khronos' validator; ends with status 1 on any error or warning.
// The validator is looked for in the current folder: npm install gltf-validator
//   node …/scripts/validate-gltf.mjs FILE…
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const validator = createRequire(path.join(process.cwd(), 'here.js'))('gltf-validator');

let failed = false;
for (const file of process.argv.slice(2)) {
  const folder = path.dirname(file);
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    externalResourceFunction: async (uri) =>
      new Uint8Array(await fs.promises.readFile(path.join(folder, decodeURIComponent(uri)))),
  });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const { severity, code, message, pointer } of messages)
    if (severity < 2) console.log(`  ${code} ${pointer}: ${message}`);
  failed ||= numErrors + numWarnings > 0;
}
process.exitCode = failed ? 1 : 0;
