// The command under Node: its environment, its own file, the standard library beside that, and what is a terminal.
(function () {
  var fs = require("fs"), path = require("path"), tty = require("tty");
  Module["wasmBinary"] = fs.readFileSync(__filename.replace(/\.js$/, ".wasm"));
  Module["thisProgram"] = "tartan";
  Module["preRun"] = [function () {
    ENV["TARTAN_PATH"] = path.join(__dirname.replace(/\/wasm$/, ""), "stdlib");
    Object.keys(process.env).forEach(function (name) { ENV[name] = process.env[name]; });
  }];
  Module["onRuntimeInitialized"] = function () {
    // The first three are said to be terminals, whatever they are.
    FS.streams.slice(0, 3).forEach(function (stream, number) { stream.tty = tty.isatty(number); });
  };
})();
