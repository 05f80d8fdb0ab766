// The extension's client: starts `tartan lsp` and leaves everything else to it.
'use strict';

const vscode = require('vscode');
const {LanguageClient} = require('vscode-languageclient/node');

const languages = require('./package.json').contributes.languages.map((language) => language.id);
let client;

function newClient() {
    const command = vscode.workspace.getConfiguration('tartan').get('path') || 'tartan';
    const server = {command, args: ['lsp']};
    const options = {
        documentSelector: languages.flatMap((language) => ['file', 'untitled'].map((scheme) => ({language, scheme}))),
        initializationOptions: {documentation: vscode.workspace.getConfiguration('tartan').get('documentation') || ''},
    };
    return new LanguageClient('tartan', 'Tartan', server, options);
}

async function start() {
    client = newClient();
    try {
        await client.start();
    } catch (error) {
        const answer = await vscode.window.showErrorMessage(
            `Tartan's language server does not start: ${error.message}. Is \`tartan\` installed?`, 'Open settings');
        if (answer) {
            vscode.commands.executeCommand('workbench.action.openSettings', 'tartan.path');
        }
    }
}

async function stop() {
    const stopped = client;
    client = undefined;
    if (stopped && stopped.isRunning()) {
        await stopped.stop();
    }
}

async function restart() {
    await stop();
    await start();
}

async function activate(context) {
    context.subscriptions.push(vscode.commands.registerCommand('tartan.restart', restart));
    context.subscriptions.push(vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration('tartan.path') || event.affectsConfiguration('tartan.documentation')) {
            restart();
        }
    }));
    await start();
}

module.exports = {activate, deactivate: stop};
