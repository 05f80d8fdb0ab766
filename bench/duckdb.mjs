// Seconds that DuckDB takes for each question, the best of three: duckdb.mjs QUESTION...
import { DuckDBInstance } from '@duckdb/node-api'

const connection = await (await DuckDBInstance.create(':memory:')).connect()
for (const question of process.argv.slice(2)) {
  let best = Infinity
  for (let i = 0; i < 3; i++) {
    const begun = performance.now()
    await (await connection.runAndReadAll(question)).getRows()
    best = Math.min(best, (performance.now() - begun) / 1000)
  }
  console.log(best.toFixed(6))
}
