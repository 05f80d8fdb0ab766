// The package: vsce makes it, everything that the manifest names is in it, and what is in it is all that the extension needs: unpacked
// elsewhere, it starts, with a stand-in for VS Code that remembers what it was asked.
'use strict';

const assert = require('node:assert');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const {test} = require('node:test');
const yauzl = require('yauzl');

const root = path.join(__dirname, '..');
const languages = require('../package.json').contributes.languages.map((language) => language.id);

function unpack(file, folder) {
    return new Promise((resolve, reject) => yauzl.open(file, {lazyEntries: true}, (error, zip) => {
        if (error) {
            reject(error);
            return;
        }
        zip.on('error', reject);
        zip.on('end', resolve);
        zip.on('entry', (entry) => zip.openReadStream(entry, (failure, stream) => {
            const target = path.join(folder, entry.fileName);
            if (failure) {
                reject(failure);
                return;
            }
            fs.mkdirSync(path.dirname(target), {recursive: true});
            stream.pipe(fs.createWriteStream(target)).on('finish', () => zip.readEntry());
        }));
        zip.readEntry();
    }));
}

// What `require('vscode')` gives to the unpacked extension: anything that is asked for is a class, a function and an object at once.
const standIn = `
const anything = () => new Proxy(class {}, {
    get: (target, name) => name in target || typeof name === 'symbol' ? target[name] : (target[name] = anything()),
    apply: () => anything(),
});
module.exports = anything();
module.exports.version = '1.90.0';
`;

// Loads the extension as VS Code would, and says for which documents its client is.
const load = `
const {LanguageClient} = require('vscode-languageclient/node');
const client = require('vscode-languageclient/node');
let options;
client.LanguageClient = class { constructor(id, name, server, given) { options = {server, given}; } start() {} isRunning() { return false; } };
require('vscode').workspace.getConfiguration = () => ({get: () => '/somewhere/tartan'});
require('./extension.js').activate({subscriptions: []}).then(() => console.log(JSON.stringify({real: typeof LanguageClient, ...options})));
`;

test('the package holds what the extension needs', async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'tartan-vsix-'));
    const file = path.join(folder, 'tartan.vsix');
    execFileSync(path.join(root, 'node_modules', '.bin', 'vsce'), ['package', '--allow-missing-repository', '--out', file],
        {cwd: root, stdio: ['ignore', 'ignore', 'pipe']});
    await unpack(file, folder);
    assert.match(fs.readFileSync(path.join(folder, 'extension.vsixmanifest'), 'utf8'), /<Identity [^>]*Id="tartan"/);
    const extension = path.join(folder, 'extension');
    const {contributes, main} = JSON.parse(fs.readFileSync(path.join(extension, 'package.json'), 'utf8'));
    assert.deepStrictEqual(contributes.languages.map((language) => language.id), languages); // tests/notations.py holds them to the table
    assert.deepStrictEqual(contributes.languages.flatMap((language) => language.extensions), languages.map((name) => `.${name}`));
    assert.deepStrictEqual(contributes.grammars.map((grammar) => grammar.language), languages);
    for (const name of [main, ...contributes.grammars.map((grammar) => grammar.path),
        ...contributes.languages.map((language) => language.configuration)]) {
        assert.ok(fs.existsSync(path.join(extension, name)), name);
    }
    assert.ok(!fs.existsSync(path.join(extension, 'test')));
    fs.mkdirSync(path.join(extension, 'node_modules', 'vscode'));
    fs.writeFileSync(path.join(extension, 'node_modules', 'vscode', 'index.js'), standIn);
    const said = JSON.parse(execFileSync(process.execPath, ['-e', load], {cwd: extension, encoding: 'utf8'}));
    assert.strictEqual(said.real, 'function');
    assert.deepStrictEqual(said.server, {command: '/somewhere/tartan', args: ['lsp']});
    for (const language of languages) {
        for (const scheme of ['file', 'untitled']) {
            assert.ok(said.given.documentSelector.some((one) => one.language === language && one.scheme === scheme), language);
        }
    }
    fs.rmSync(folder, {recursive: true});
});
