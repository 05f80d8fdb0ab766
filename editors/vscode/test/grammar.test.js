// The colours: VS Code's own tokenizer reads the grammar.
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const {test} = require('node:test');
const oniguruma = require('vscode-oniguruma');
const textmate = require('vscode-textmate');

const root = path.join(__dirname, '..');

async function loadGrammar() {
    const wasm = fs.readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm'));
    await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
    const registry = new textmate.Registry({
        onigLib: Promise.resolve({
            createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
            createOnigString: (s) => new oniguruma.OnigString(s),
        }),
        loadGrammar: async () => textmate.parseRawGrammar(
            fs.readFileSync(path.join(root, 'syntaxes', 'plan.tmLanguage.json'), 'utf8'), 'plan.tmLanguage.json'),
    });
    return registry.loadGrammar('source.plan');
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
    const lexer = fs.readFileSync(path.join(root, '..', '..', 'grammar', 'plan.l'), 'utf8');
    const words = [...lexer.matchAll(/\{"([a-z]+)", TN_PLAN_/g)].map((match) => match[1]);
    assert.ok(words.length > 40);
    for (const word of words) {
        const [token] = tokens(grammar, ['use', 'schema', 'rule', 'library', 'test'].includes(word) ? `${word} x` : ` x = ${word} `)
            .filter(([text]) => text === word);
        assert.ok(token && !token[1].startsWith('variable'), word);
    }
});
