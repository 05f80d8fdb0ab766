// The colours: VS Code's own tokenizer reads the grammar.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const {test} = require('node:test');
const oniguruma = require('vscode-oniguruma');
const textmate = require('vscode-textmate');

const root = path.join(__dirname, '..');

let loaded;

async function loadGrammar(name = 'plan') {
    loaded = loaded || oniguruma.loadWASM(new Uint8Array(fs.readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm'))).buffer);
    await loaded;
    const registry = new textmate.Registry({
        onigLib: Promise.resolve({
            createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
            createOnigString: (s) => new oniguruma.OnigString(s),
        }),
        loadGrammar: async () => textmate.parseRawGrammar(
            fs.readFileSync(path.join(root, 'syntaxes', `${name}.tmLanguage.json`), 'utf8'), `${name}.tmLanguage.json`),
    });
    return registry.loadGrammar(`source.${name}`);
}

// [text, scope] of each token of the lines that has a scope of its own.
function tokens(grammar, text) {
    let stack = textmate.INITIAL;
    return text.split('\n').flatMap((line) => {
        const result = grammar.tokenizeLine(line, stack);
        stack = result.ruleStack;
        return result.tokens.filter((token) => token.scopes.length > 1)
            .map((token) => [line.slice(token.startIndex, token.endIndex), token.scopes[1]]);
    });
}

test('words, lengths, texts and comments have their colours', async () => {
    const grammar = await loadGrammar();
    const found = new Map(tokens(grammar, `# why
schema s "text" {
  width = 4' | 2'-6 1/2" | 900mm
  zone bay = open(3') role void
}
rule great-hall "doc" = symmetric neighbour(beginning, tray(not 4')) and quantity(any, n >= 2)
library l { prune great-hall }
`));
    assert.strictEqual(found.get('# why'), 'comment.line.number-sign.plan');
    assert.strictEqual(found.get('great-hall'), 'variable.other.plan');
    assert.strictEqual(found.get('width'), 'variable.other.member.plan');
    assert.strictEqual(found.get('bay'), 'variable.other.member.plan');
    for (const length of ['4\'', '2\'-6 1/2"', '900mm', '3\'']) {
        assert.strictEqual(found.get(length), 'constant.numeric.length.plan', length);
    }
    assert.strictEqual(found.get('text'), 'string.quoted.double.plan');
    assert.strictEqual(found.get('neighbour'), 'support.function.plan');
    assert.strictEqual(found.get('prune'), 'keyword.control.plan');
    assert.strictEqual(found.get('and'), 'keyword.operator.logical.plan');
    assert.strictEqual(found.get('rule'), 'keyword.declaration.plan');
    assert.strictEqual(tokens(grammar, 'rule great-hall =')[1][1], 'entity.name.function.plan');
});

test('every word of the language that the lexer knows has a colour', async () => {
    const grammar = await loadGrammar();
    const table = fs.readFileSync(path.join(root, '..', '..', 'compiler', 'plan', 'syntax', 'words.def'), 'utf8');
    const rows = [...table.matchAll(/^WORD\("([a-z]+)", (\w+), .*?TN_AT\((\w+)\)/gm)].filter((row) => row[2] !== 'NAME');
    assert.ok(rows.length > 100);
    for (const [, word, , place] of rows) {
        const [token] = tokens(grammar, place === 'ITEM' ? `${word} x` : ` x = ${word} `).filter(([text]) => text === word);
        assert.ok(token && !token[1].startsWith('variable'), word);
    }
});

test('words of forms and of rooms that the lexer takes for names have a colour', async () => {
    const found = new Map(tokens(await loadGrammar(), `form f of s {
  option hall storeys = 1 | 2
  option hall roof = gable(9:12, eaves 2') | shed(back, 4:12) | vault(4')
  flight steep wide 3' rise 6"..8" going 10" turn half
  flight corner wide 3' rise 6"..8" going 10" turn quarter
}
rule half-stair = room(bedroom, glazing < 1:12)
`));
    for (const word of ['storeys', 'gable', 'eaves', 'shed', 'vault', 'half', 'quarter', 'glazing']) {
        assert.strictEqual(found.get(word), 'keyword.control.plan', word);
    }
    assert.strictEqual(found.get('half-stair'), 'entity.name.function.plan');
});

// The scopes of a text's tokens, by the token.
async function scopes(name, text) {
    return new Map(tokens(await loadGrammar(name), text));
}

test('.hemls: edges, turns, words and comments', async () => {
    const found = await scopes('hemls', `// why
A + ~Edge1_i+1 + A
A -> A [ + B ] A Weight 3
Edge2 < B \u2192 \\ B / B If i < 2
BranchAngle 12.5; Sync
`);
    assert.strictEqual(found.get('// why'), 'comment.line.double-slash.hemls');
    assert.strictEqual(found.get('Edge1_i+1'), 'variable.other.edge.hemls');
    assert.strictEqual(found.get('\u2192'), 'keyword.operator.arrow.hemls');
    for (const word of ['Weight', 'If', 'BranchAngle', 'Sync']) {
        assert.strictEqual(found.get(word), 'keyword.control.hemls', word);
    }
    for (const sign of ['+', '~', '\\', '/']) {
        assert.strictEqual(found.get(sign), 'keyword.operator.turtle.hemls', sign);
    }
    assert.strictEqual(found.get('12.5'), 'constant.numeric.hemls');
    assert.strictEqual(tokens(await loadGrammar('hemls'), 'A -> B')[0][1], 'entity.name.function.hemls');
});

test('.study: every word that the lexer knows has a colour', async () => {
    const grammar = await loadGrammar('study');
    const table = fs.readFileSync(path.join(root, '..', '..', 'compiler', 'study', 'words.def'), 'utf8');
    const rows = [...table.matchAll(/^WORD\("([a-z-]+)", (\w+), .*?TN_STUDY_AT\((\w+)\)/gm)].filter((row) => row[2] !== 'NAME');
    assert.ok(rows.length > 40);
    for (const [, word, , place] of rows) {
        const [token] = tokens(grammar, place === 'TERM' ? `require size ${word} 2` : ` ${word} `).filter(([text]) => text === word);
        assert.deepStrictEqual([token[0], /^(keyword|support)/.test(token[1])], [word, true], word);
    }
});

test('.study: numbers, texts, and the block of evolution', async () => {
    const found = await scopes('study', `title "a \\" b" # why
attractor at -5.6 1e-3 2
evolution {
  grammar "words"; depth 2..8
  selection tournament 3
}
steps 3
fitness slope = undulation / 7
`);
    assert.strictEqual(found.get('# why'), 'comment.line.number-sign.study');
    assert.strictEqual(found.get('/'), 'keyword.operator.study');
    assert.strictEqual(found.get('undulation'), 'variable.other.study');
    for (const number of ['-5.6', '1e-3', '2..8', '3']) {
        assert.strictEqual(found.get(number), 'constant.numeric.study', number);
    }
    for (const setting of ['grammar', 'depth', 'selection']) {
        assert.match(found.get(setting), /^meta|variable.other.member.study/, setting);
    }
    assert.strictEqual(found.get('tournament'), 'constant.other.study');
    assert.strictEqual(found.get('steps'), 'keyword.control.study');
});

test('.bnf: sentences in the one dialect, tokens in the other', async () => {
    const sentences = await scopes('bnf', `%wraps 2
<a> ::= x{ <b>'|' | "#" | \\x41 # why
<b> ::= GE_RANGE:3
`);
    assert.strictEqual(sentences.get('%wraps'), 'keyword.control.directive.bnf');
    assert.strictEqual(sentences.get('<a>'), 'entity.name.function.bnf');
    assert.strictEqual(sentences.get('|'), 'keyword.operator.alternative.bnf');
    assert.strictEqual(sentences.get("'|'"), 'string.quoted.single.bnf');
    assert.strictEqual(sentences.get('"#"'), 'string.quoted.double.bnf');
    assert.strictEqual(sentences.get('\\x41'), 'constant.character.escape.bnf');
    assert.strictEqual(sentences.get('# why'), 'comment.line.number-sign.bnf');
    assert.strictEqual(sentences.get('GE_RANGE:3'), 'support.function.range.bnf');
    const words = await scopes('bnf', `%dialect genr8
<a> ::= { Edge [ EdgeX ] } '[' x#y <b> -> # why
<b> ::= <a>
`);
    assert.strictEqual(words.get('genr8'), 'constant.language.bnf');
    assert.strictEqual(words.get('{'), 'keyword.operator.group.bnf');
    assert.strictEqual(words.get('EdgeX'), 'support.type.edge.bnf');
    assert.strictEqual(words.get("'['"), 'string.quoted.bnf');
    assert.strictEqual(words.get('x#y'), 'string.unquoted.bnf');
    assert.strictEqual(words.get('# why'), 'comment.line.number-sign.bnf');
    assert.strictEqual(words.get('->'), 'string.unquoted.bnf');
});

test('the standard library is coloured throughout', async () => {
    const stdlib = path.join(root, '..', '..', 'stdlib');
    for (const file of fs.readdirSync(stdlib)) {
        const name = path.extname(file).slice(1);
        const grammar = await loadGrammar(name);
        let stack = textmate.INITIAL;
        for (const line of fs.readFileSync(path.join(stdlib, file), 'utf8').split('\n')) {
            const result = grammar.tokenizeLine(line, stack);
            stack = result.ruleStack;
            for (const token of result.tokens) {
                const text = line.slice(token.startIndex, token.endIndex);
                const plain = name === 'bnf' || !/[\p{L}\p{N}"#~+]/u.test(text) || token.scopes.length > 1;
                assert.ok(plain, `${file}: \`${text}\` in \`${line}\``);
            }
        }
    }
});
