-- Opens each file that is named, and says what Neovim makes of it: its filetype, whether the language server is there, how many messages it has, and
-- what it makes of the text as a whole.
local function wait(what)
  return vim.wait(20000, what, 20)
end

for _, path in ipairs(vim.v.argv) do
  if path:match('^%./') then
    vim.cmd('edit ' .. path)
    local buffer = vim.api.nvim_get_current_buf()
    local attached = vim.fn.executable(vim.g.tartan_command) == 1 and wait(function() return #vim.tbl_values(vim.lsp.buf_get_clients(buffer)) == 1 end)
    local answers = attached and vim.lsp.buf_request_sync(buffer, 'textDocument/formatting',
      {textDocument = vim.lsp.util.make_text_document_params(buffer), options = {tabSize = 2, insertSpaces = true}}, 20000) or {}
    local formatted = 'no answer'
    for _, answer in pairs(answers) do
      formatted = answer.error and 'error' or 'answered'
    end
    if attached and path:match('wrong') then -- an error is said soon, warnings are not
      wait(function() return #vim.diagnostic.get(buffer) > 0 end)
    end
    print(table.concat({path, vim.bo.filetype, vim.bo.commentstring, attached and 'attached' or 'alone', formatted, #vim.diagnostic.get(buffer, {severity = vim.diagnostic.severity.ERROR})}, ' '))
  end
end
local ids = {}
for _, client in pairs(vim.lsp.get_active_clients()) do
  ids[#ids + 1] = client.name
end
print('servers: ' .. table.concat(ids, ' '))
vim.cmd('qall!')
