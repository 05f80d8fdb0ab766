-- What Neovim finds in its buffer with the parser and the queries of .plan.
local parser = vim.treesitter.get_parser(0, 'plan')
local root = parser:parse()[1]:root()
vim.treesitter.highlighter.new(parser)
local said = {}
for _, kind in ipairs({'highlights', 'folds'}) do
  local query = (vim.treesitter.query.get or vim.treesitter.get_query)('plan', kind)
  local count = 0
  for _ in query:iter_captures(root, 0, 0, -1) do
    count = count + 1
  end
  said[#said + 1] = kind .. ' ' .. count
end
print(table.concat(said, ', '))
vim.cmd('qall!')
