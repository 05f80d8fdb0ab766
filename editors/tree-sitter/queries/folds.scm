; What is folded: items, tiles, the layers of what is built, and lines of symbols.
[
  (schema)
  (rule)
  (measure)
  (library)
  (form)
  (test)
  (tile)
  (layers)
  (symbol_body)
] @fold
