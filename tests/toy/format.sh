#!/usr/bin/env bash
# A format of files that is a row of the table: commands that do not write it refuse its ending, whatever they write, and say which they do; the
# choice among formats knows its word.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}
# refused SENTENCE HELP WORDS...
refused() {
    local sentence=$1 help=$2
    shift 2
    ! "$TARTAN" "$@" 2>said || fail "$* is not refused"
    grep -qF "$sentence" said || fail "$*: $(cat said)"
    grep -qF "$help" said || fail "$*: $(cat said)"
    [ ! -e box.toy ] || fail "$* writes it"
}
refused 'the output of `tartan draw` cannot be written as box.toy' 'end its name in .svg, .png or .pdf; of plans also in .dxf' draw terrace --sample 2 -o box.toy
refused 'the output of `tartan mesh` cannot be written as box.toy' 'end its name in .obj' mesh table -o box.toy
refused 'the output of `tartan report` cannot be written as box.TOY' 'end its name in .html' report terrace -o box.TOY
refused 'the output of `tartan sample` cannot be written as box.toy' 'text has another ending, or none' sample terrace 3 -o box.toy
