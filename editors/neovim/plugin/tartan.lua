-- Rule files of Tartan in Neovim, 0.7 and later: knows them by their names and starts the language server for them.
--
-- Copy this to ~/.config/nvim/plugin/, or let 'runtimepath' have the folder above. vim.g.tartan_command is the command where that is not `tartan`.

local comments = {plan = '# %s', hemls = '// %s', study = '# %s', bnf = '# %s', field = '# %s', pcfg = '# %s', kit = '# %s', solid = '# %s'}
local notations = vim.tbl_keys(comments) -- .study is for growing surfaces and for evolution

local clients = {} -- of 0.7, by folder

-- vim.lsp.start() came with 0.8.
local function start(buffer)
  local command, folder = vim.g.tartan_command or 'tartan', vim.fn.getcwd()
  if vim.fn.executable(command) == 0 then
    return
  end
  local config = {name = 'tartan', cmd = {command, 'lsp'}, root_dir = folder}
  if vim.lsp.start then
    vim.lsp.start(config, {bufnr = buffer})
    return
  end
  if not (clients[folder] and vim.lsp.get_client_by_id(clients[folder])) then
    clients[folder] = vim.lsp.start_client(config)
  end
  if clients[folder] then
    vim.lsp.buf_attach_client(buffer, clients[folder])
  end
end

local group = vim.api.nvim_create_augroup('tartan', {})

-- Whatever Neovim takes them for; vim.filetype.add() is not asked in 0.7.
vim.api.nvim_create_autocmd({'BufRead', 'BufNewFile'}, {
  group = group,
  pattern = vim.tbl_map(function(notation) return '*.' .. notation end, notations),
  callback = function(event)
    vim.bo[event.buf].filetype = vim.fn.fnamemodify(event.match, ':e')
  end,
})

vim.api.nvim_create_autocmd('FileType', {
  group = group,
  pattern = notations,
  callback = function(event)
    vim.bo[event.buf].commentstring = comments[vim.bo[event.buf].filetype]
    start(event.buf)
  end,
})
