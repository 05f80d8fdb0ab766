// A language client: Microsoft's protocol library, talking to `tartan lsp`.
'use strict';

const {spawn} = require('node:child_process');
const path = require('node:path');
const rpc = require('vscode-languageserver-protocol/node');

const tartan = process.env.TARTAN || path.join(__dirname, '..', '..', '..', 'build', 'tartan');

class Client {
    constructor() {
        this.process = spawn(tartan, ['lsp'], {stdio: ['pipe', 'pipe', 'inherit']});
        this.exited = new Promise((resolve) => this.process.on('exit', resolve));
        this.connection = rpc.createProtocolConnection(
            new rpc.StreamMessageReader(this.process.stdout), new rpc.StreamMessageWriter(this.process.stdin));
        this.published = new Map();
        this.waiting = [];
        this.connection.onNotification(rpc.PublishDiagnosticsNotification.type, (params) => {
            this.published.set(params.uri, params);
            this.waiting = this.waiting.filter((waits) => !waits(params));
        });
        this.connection.listen();
    }

    async start() {
        const result = await this.connection.sendRequest(
            rpc.InitializeRequest.type, {processId: process.pid, rootUri: null, capabilities: {}});
        await this.connection.sendNotification(rpc.InitializedNotification.type, {});
        return result;
    }

    open(uri, text, languageId = 'plan') {
        const document = {uri, languageId, version: 1, text};
        return this.connection.sendNotification(rpc.DidOpenTextDocumentNotification.type, {textDocument: document});
    }

    change(uri, version, changes) {
        return this.connection.sendNotification(
            rpc.DidChangeTextDocumentNotification.type, {textDocument: {uri, version}, contentChanges: changes});
    }

    // The diagnostics of a version of a document.
    diagnostics(uri, version) {
        const have = this.published.get(uri);
        if (have && have.version === version) {
            return Promise.resolve(have.diagnostics);
        }
        return new Promise((resolve) => this.waiting.push((params) => {
            const awaited = params.uri === uri && params.version === version;
            if (awaited) {
                resolve(params.diagnostics);
            }
            return awaited;
        }));
    }

    // The diagnostics of a version, as soon as one has this code: what rules mean is said later than what is wrong.
    async diagnostic(uri, version, code) {
        const found = (list) => list.find((item) => item.code === code);
        const have = this.published.get(uri);
        if (have && have.version === version && found(have.diagnostics)) {
            return found(have.diagnostics);
        }
        return new Promise((resolve) => this.waiting.push((params) => {
            const awaited = params.uri === uri && params.version === version && found(params.diagnostics);
            if (awaited) {
                resolve(awaited);
            }
            return Boolean(awaited);
        }));
    }

    ask(type, uri, more = {}) {
        return this.connection.sendRequest(type, {textDocument: {uri}, ...more});
    }

    async stop() {
        await this.connection.sendRequest(rpc.ShutdownRequest.type);
        await this.connection.sendNotification(rpc.ExitNotification.type);
        const code = await this.exited;
        this.connection.dispose();
        return code;
    }
}

// The place of a piece of text, `after` characters into it.
function at(text, piece, after = 0) {
    const offset = text.indexOf(piece);
    if (offset < 0) {
        throw new Error(`no ${piece} in the text`);
    }
    const before = text.slice(0, offset + after);
    return {line: before.split('\n').length - 1, character: before.length - (before.lastIndexOf('\n') + 1)};
}

module.exports = {Client, at, rpc};
