// What emscripten's library lacks for files that are Node's.
mergeInto(LibraryManager.library, {
  // Files and pipes of Node can be read and written at any time; a pipe that nobody reads says so when it is written to.
  __syscall_poll__sig: 'iiii',
  __syscall_poll: function (fds, count, timeout) {
    var ready = 0;
    for (var i = 0; i < count; i++) {
      var at = fds + 8 * i, stream = FS.getStream({{{ makeGetValue('at', 0, 'i32') }}});
      var events = stream ? {{{ makeGetValue('at', 4, 'i16') }}} & 5 : 32; // POLLIN and POLLOUT, or POLLNVAL
      {{{ makeSetValue('at', 6, 'events', 'i16') }}};
      ready += events !== 0;
    }
    return ready;
  },
  __syscall_poll__deps: ['$FS'],
});
