// SPDX-License-Identifier: MIT
// node run_wasi.mjs MODULE ARGUMENT...: runs a WASI program that may read the whole file system.
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';
const [module, ...args] = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args: [module, ...args], preopens: { '/': '/' } });
const { instance } = await WebAssembly.instantiate(await readFile(module), { wasi_snapshot_preview1: wasi.wasiImport });
process.exitCode = wasi.start(instance);
