// Holds .glb files against the Khronos validator: an error or a warning in one of them ends this with 1.
import { readFileSync } from 'node:fs'
import validator from 'gltf-validator'

let failed = false
for (const path of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(path)), { maxIssues: 5, severityOverrides: {} })
  if (issues.numErrors + issues.numWarnings === 0) continue
  failed = true
  console.error(`${path}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`)
  for (const { code, message, pointer } of issues.messages) console.error(`  ${code} at ${pointer}: ${message}`)
}
process.exit(failed ? 1 : 0)
