// Reads NAME.parquet by DuckDB and by hyparquet, and holds both against NAME.tsv: rank, length, total and plan line of each plan.
// Then DuckDB writes the plans to NAME.again.parquet.
// With --page PAGE instead, asks what stands in blocks of SQL there, and holds the answers against the blocks of text behind them.
import { readFileSync } from 'node:fs'
import assert from 'node:assert/strict'
import { DuckDBInstance } from '@duckdb/node-api'
import { asyncBufferFromFile, parquetReadObjects } from 'hyparquet'
import { compressors } from 'hyparquet-compressors'

const db = await (await DuckDBInstance.create(':memory:')).connect()
const ask = async sql => (await db.runAndReadAll(sql)).getRowObjectsJson()
if (process.argv[2] === '--page') {
  const asked = [...readFileSync(process.argv[3], 'utf8').matchAll(/```sql\n([^]*?)```\n\n```text\n([^]*?)```/g)]
  assert.ok(asked.length >= 3)
  for (const [, sql, answer] of asked)
    assert.equal((await ask(sql)).map(row => Object.values(row).join(' | ') + '\n').join(''), answer)
  process.exit(0)
}

const name = process.argv[2]
const own = new Set(['rank', 'length', 'total', 'plan'])
const wanted = readFileSync(name + '.tsv', 'utf8').split('\n').slice(0, -1).map(line => line.split('\t'))

const line = row => {
  const lists = Object.keys(row).filter(key => !own.has(key)).map(key => row[key])
  for (const list of lists) assert.equal(list.length, Number(row.length))
  return Array.from({ length: Number(row.length) }, (_, tray) => lists.map(list => list[tray]).join(' ')).join(' | ')
}
const compare = (reader, rows, exact) => {
  assert.equal(rows.length, wanted.length, reader)
  rows.forEach((row, i) => {
    const [rank, length, total, plan] = wanted[i]
    if (exact || rank.length < 16) assert.equal(String(row.rank), rank, reader)
    else assert.ok(Math.abs(Number(row.rank) / Number(rank) - 1) < 1e-12, reader)
    assert.equal(String(row.length), length, reader)
    assert.equal(String(row.total ?? 0), total, reader)
    assert.equal(row.plan, plan, reader)
    assert.equal(line(row), plan, reader)
  })
}

const file = await asyncBufferFromFile(name + '.parquet')
compare('hyparquet', await parquetReadObjects({ file, compressors }), false) // decimal numbers become doubles there

const plans = `'${name}.parquet'`
compare('DuckDB', await ask(`SELECT * FROM ${plans} ORDER BY rank`), wanted.every(([rank]) => rank.length < 38))
const middle = wanted[wanted.length >> 1] ?? ['0', '0', '0']
const count = async where => Number((await ask(`SELECT count(*) AS n FROM ${plans} WHERE ${where}`))[0].n)
if (middle[0].length < 38) {
  assert.equal(await count(`rank < ${middle[0]}`), wanted.filter(([rank]) => BigInt(rank) < BigInt(middle[0])).length)
  assert.equal(await count(`rank = ${middle[0]}`), wanted.length ? 1 : 0)
}
assert.equal(await count(`length >= ${middle[1]}`), wanted.filter(([, length]) => Number(length) >= Number(middle[1])).length)
const fields = (await ask(`DESCRIBE SELECT * FROM ${plans}`)).map(column => column.column_name).filter(column => !own.has(column))
if (fields.length && wanted.length) {
  const seen = await ask(`SELECT v, count(*) AS n FROM (SELECT unnest("${fields[0]}") AS v FROM ${plans}) GROUP BY v`)
  const counted = {}
  for (const [, , , plan] of wanted) for (const tray of plan ? plan.split(' | ') : []) counted[tray.split(' ')[0]] = (counted[tray.split(' ')[0]] ?? 0) + 1
  assert.deepEqual(Object.fromEntries(seen.map(({ v, n }) => [v, Number(n)]).sort()), Object.fromEntries(Object.entries(counted).sort()))
}
await db.run(`COPY (SELECT * EXCLUDE (plan) FROM ${plans} ORDER BY rank) TO '${name}.again.parquet' (FORMAT parquet, COMPRESSION zstd)`)
