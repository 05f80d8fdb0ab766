'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const {pathToFileURL} = require('node:url');
const {test} = require('node:test');
const {Client, at, rpc} = require('./client');

const stdlib = path.join(__dirname, '..', '..', '..', 'stdlib');
const text = `use "lahave"
# 🏠 a comment with a character of two units
rule corridor-end "a tartan at an end 🏠" = symmetric neighbour(beginning, tray(4'))
library cabins "cabins" using lahave {
  trays 2..4
  prune corridor-end, narrow-pair
}
test cabins { drop [4' | 8'] by corridor-end }
`;

async function session(uri, content, run, language = 'plan') {
    const client = new Client();
    try {
        await client.start();
        await client.open(uri, content, language);
        await run(client);
        assert.strictEqual(await client.stop(), 0);
    } finally {
        client.process.kill();
    }
}

function apply(content, edits) {
    const lines = content.split('\n');
    const offset = (p) => lines.slice(0, p.line).reduce((sum, line) => sum + line.length + 1, 0) + p.character;
    const sorted = [...edits].sort((a, b) => offset(b.range.start) - offset(a.range.start));
    return sorted.reduce((result, edit) =>
        result.slice(0, offset(edit.range.start)) + edit.newText + result.slice(offset(edit.range.end)), content);
}

test('says what it can do', async () => {
    const client = new Client();
    const {capabilities, serverInfo} = await client.start();
    assert.strictEqual(serverInfo.name, 'tartan');
    for (const provider of ['hover', 'definition', 'references', 'documentSymbol', 'documentFormatting', 'documentHighlight']) {
        assert.ok(capabilities[`${provider}Provider`], provider);
    }
    assert.strictEqual(await client.stop(), 0);
});

test('diagnostics as you type, with fixes', async () => {
    const uri = 'file:///nowhere/a.plan';
    await session(uri, text, async (client) => {
        assert.deepStrictEqual(await client.diagnostics(uri, 1), []);
        const start = at(text, 'narrow-pair');
        const range = {start, end: {line: start.line, character: start.character + 11}};
        await client.change(uri, 2, [{range, text: 'narow-pair'}]);
        const [found] = await client.diagnostics(uri, 2);
        assert.strictEqual(found.code, 'E0104');
        assert.strictEqual(found.range.start.line, start.line);
        assert.match(found.message, /did you mean `narrow-pair`/);
        const broken = text.replace('narrow-pair', 'narow-pair');
        const [action] = await client.ask(rpc.CodeActionRequest.type, uri, {range: found.range, context: {diagnostics: [found]}});
        assert.strictEqual(apply(broken, action.edit.changes[uri]), text);
        await client.change(uri, 3, [{text}]);
        assert.deepStrictEqual(await client.diagnostics(uri, 3), []);
    });
});

test('hover says what a rule prunes', async () => {
    const uri = 'untitled:houses';
    await session(uri, text, async (client) => {
        await client.diagnostics(uri, 1);
        const position = at(text, 'corridor-end,', 2);
        let value = '';
        for (let i = 0; i < 200 && !value.includes('prunes'); i++) {
            value = (await client.ask(rpc.HoverRequest.type, uri, {position})).contents.value;
            await new Promise((resolve) => setTimeout(resolve, 50));
        }
        assert.match(value, /a tartan at an end 🏠/);
        assert.match(value, /prunes [0-9,]+ plans of `cabins`/);
    });
});

test('definition, references, highlights and renaming', async () => {
    const uri = 'file:///nowhere/a.plan';
    await session(uri, text, async (client) => {
        const position = at(text, 'corridor-end,', 1);
        const definition = await client.ask(rpc.DefinitionRequest.type, uri, {position});
        assert.deepStrictEqual(definition, {uri, range: {start: at(text, 'corridor-end'), end: at(text, 'corridor-end', 12)}});
        const imported = await client.ask(rpc.DefinitionRequest.type, uri, {position: at(text, 'narrow-pair')});
        assert.match(imported.uri, /^file:\/\/.*\/stdlib\/lahave\.plan$/);
        const references = await client.ask(rpc.ReferencesRequest.type, uri, {position, context: {includeDeclaration: false}});
        assert.strictEqual(references.length, 2);
        const highlights = await client.ask(rpc.DocumentHighlightRequest.type, uri, {position});
        assert.strictEqual(highlights.length, 3);
        const {changes} = await client.ask(rpc.RenameRequest.type, uri, {position, newName: 'dead-end'});
        assert.strictEqual(apply(text, changes[uri]), text.replaceAll('corridor-end', 'dead-end'));
        await assert.rejects(client.ask(rpc.RenameRequest.type, uri, {position, newName: 'two words'}), /a name is letters/);
        await assert.rejects(client.ask(rpc.RenameRequest.type, uri, {position: at(text, 'narrow-pair'), newName: 'x'}), /standard library/);
    });
});

test('completion knows where it is', async () => {
    const uri = 'file:///nowhere/a.plan';
    const half = `${text}rule next = tray(body )\nrule more = \nuse ""\n`;
    await session(uri, half, async (client) => {
        const labels = async (position) =>
            (await client.ask(rpc.CompletionRequest.type, uri, {position})).map((item) => item.label);
        const inTray = await labels(at(half, 'tray(body ', 10));
        assert.ok(inTray.includes('dense') && inTray.includes('great') && !inTray.includes('corridor-end'));
        const inRule = await labels(at(half, 'more = ', 7));
        assert.ok(inRule.includes('corridor-end') && inRule.includes('neighbour') && !inRule.includes('dense'));
        const inUse = await labels(at(half, 'use ""', 5));
        assert.ok(inUse.includes('lahave') && inUse.includes('terrace'));
        const inPlan = await labels(at(half, '[4\' | 8\'', 5));
        assert.ok(inPlan.includes('machine') && !inPlan.includes('neighbour'));
        const inLibrary = await labels(at(half, '  prune', 2));
        assert.ok(inLibrary.includes('require'));
        assert.deepStrictEqual(await labels(at(half, '# 🏠 a', 5)), []);
    });
});

test('outline and formatting', async () => {
    const uri = 'file:///nowhere/a.plan';
    await session(uri, text, async (client) => {
        const outline = await client.ask(rpc.DocumentSymbolRequest.type, uri);
        assert.deepStrictEqual(outline.map((item) => item.name), ['corridor-end', 'cabins']);
        const edits = await client.ask(rpc.DocumentFormattingRequest.type, uri, {options: {tabSize: 2, insertSpaces: true}});
        assert.match(apply(text, edits), /\nrule corridor-end "a tartan at an end 🏠" =\n {2}symmetric /);
    });
});

test('files that are not saved count where another uses them', async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'tartan-editor-'));
    fs.writeFileSync(path.join(folder, 'base.plan'), 'use "lahave"\nrule old = any\n');
    const base = pathToFileURL(path.join(folder, 'base.plan')).href;
    const user = pathToFileURL(path.join(folder, 'user.plan')).href;
    await session(user, 'use "base.plan"\nrule both = new-one and tray(4\')\n', async (client) => {
        assert.strictEqual((await client.diagnostics(user, 1))[0].code, 'E0104');
        client.published.delete(user);
        await client.open(base, 'use "lahave"\nrule new-one = tray(8\')\n');
        assert.ok(!(await client.diagnostics(user, 1)).some((item) => item.severity === 1));
    });
    fs.rmSync(folder, {recursive: true});
});

// Of each notation: a text, what is said of it, its outline, its layout, what its first word says.
const notations = {
    hemls: {
        text: 'A+B+A\nA->A[+B A\n// why\nANGLE 90;',
        code: 'E1005',
        outline: ['A+B+A', 'A', 'ANGLE'],
        layout: 'A + B + A\nA -> A [ + B A\n// why\nAngle 90\n',
    },
    study: {
        text: 'rules "sqare" # why\nattractor at 1 2 3 attractor at 10 2.5 3\nfitness size target 8',
        code: 'E0101',
        outline: ['rules', 'attractor', 'attractor', 'fitness size'],
        layout: 'rules "sqare"  # why\nattractor at  1 2   3\nattractor at 10 2.5 3\nfitness size target 8\n',
        hover: '`rules`: what grows: `rules "square"`',
    },
    bnf: {
        text: '%dialect   ge\n<a> ::= x<c>|\n y',
        code: 'E1204',
        outline: ['%dialect   ge', '<a>'],
        layout: '%dialect ge\n\n<a> ::= x<c> | y\n',
    },
};

for (const [name, {text: content, code, outline, layout, hover}] of Object.entries(notations)) {
    for (const uri of [`file:///nowhere/a.${name}`, 'untitled:a']) {
        test(`.${name}: diagnostics, outline and formatting (${uri.split(':')[0]})`, async () => {
            await session(uri, content, async (client) => {
                assert.ok((await client.diagnostics(uri, 1)).some((item) => item.code === code), code);
                const symbols = await client.ask(rpc.DocumentSymbolRequest.type, uri);
                assert.deepStrictEqual(symbols.map((item) => item.name), outline);
                const edits = await client.ask(rpc.DocumentFormattingRequest.type, uri, {options: {tabSize: 2, insertSpaces: true}});
                assert.strictEqual(apply(content, edits), layout);
                const first = await client.ask(rpc.HoverRequest.type, uri, {position: {line: 0, character: 0}});
                assert.strictEqual(first?.contents.value, hover);
            }, name);
        });
    }
}

test('a study with a block of evolution has its settings in the outline', async () => {
    const uri = 'file:///nowhere/a.study';
    await session(uri, 'evolution {\n  grammar "words"\n  match "x"\n}\n', async (client) => {
        assert.deepStrictEqual(await client.diagnostics(uri, 1), []);
        const [block] = await client.ask(rpc.DocumentSymbolRequest.type, uri);
        assert.deepStrictEqual([block.name, block.children.map((item) => item.name)], ['evolution', ['grammar', 'match']]);
        assert.deepStrictEqual(await client.ask(rpc.DocumentFormattingRequest.type, uri, {options: {tabSize: 2, insertSpaces: true}}), []);
    }, 'study');
});

test('what rules mean is said when typing pauses, with a fix that allows it', async () => {
    const uri = 'file:///nowhere/meaning.plan';
    const content = 'use "lahave"\nrule wide = tray(12\') or tray(8\')\nrule never = tray(8\') and not tray(8\')\nrule one = tray(8\')\n';
    await session(uri, content, async (client) => {
        const found = await client.diagnostic(uri, 1, 'W001');
        assert.strictEqual(found.severity, 2);
        assert.strictEqual(found.range.start.line, 2);
        const actions = await client.ask(rpc.CodeActionRequest.type, uri, {range: found.range, context: {diagnostics: [found]}});
        const allow = actions.find((action) => action.title === 'Allow W001 in never');
        const allowed = apply(content, allow.edit.changes[uri]);
        assert.match(allowed, /rule never allow W001 = /);
        const subsumed = await client.diagnostic(uri, 1, 'W003');
        assert.match(subsumed.message, /note: only `wide` matches: /);
        assert.match(subsumed.relatedInformation[0].message, /`wide` is here/);
        const hover = await client.ask(rpc.HoverRequest.type, uri, {position: at(content, 'wide')});
        assert.match(hover.contents.value, /subsumes \(matches all that they match\): `one`/);
        await client.change(uri, 2, [{text: allowed}]);
        await client.diagnostic(uri, 2, 'W003');
        assert.ok(!client.published.get(uri).diagnostics.some((item) => item.code === 'W001'));
    });
});

test('the standard library has nothing to complain about', async () => {
    const client = new Client();
    await client.start();
    for (const name of fs.readdirSync(stdlib)) {
        const uri = pathToFileURL(path.join(stdlib, name)).href;
        await client.open(uri, fs.readFileSync(path.join(stdlib, name), 'utf8'), path.extname(name).slice(1));
        assert.deepStrictEqual(await client.diagnostics(uri, 1), [], name);
        assert.deepStrictEqual(await client.ask(rpc.DocumentFormattingRequest.type, uri, {options: {tabSize: 2, insertSpaces: true}}), [], name);
    }
    assert.strictEqual(await client.stop(), 0);
});
