// Runs test/*.test.ts under node's test runner, each bundled first.
import {build} from "esbuild";
import {spawnSync} from "node:child_process";
import {mkdtempSync, readdirSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";
import {options} from "./build.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const out = mkdtempSync(join(tmpdir(), "tartan-page-"));
const tests = readdirSync(join(here, "test")).filter((name) => name.endsWith(".test.ts"));
await build({
  ...options,
  entryPoints: tests.map((name) => join(here, "test", name)),
  outdir: out,
  outExtension: {".js": ".mjs"},
  platform: "node",
});
const {status} = spawnSync(process.execPath, ["--test", out], {stdio: "inherit"});
rmSync(out, {recursive: true});
process.exit(status ?? 1);
