#!/usr/bin/env bash
# Needs the parts: studio
# What the command of the studio says, apart from its server (tests/studio/server.py has that): its help, and what is wrong with how it is called.
name=studio
. "$(dirname "$0")/golden.bash"

golden help 'tartan help studio'
golden no_folder 'tartan studio nowhere --no-open'
golden no_rule_file "tartan studio ../studio.sh --no-open"
golden no_port 'tartan studio --port 65536'

# The server is a program of another package.
cp "$TARTAN" "$scratch/tartan"
alone() { "$scratch/tartan" "$@"; }
golden no_server 'alone studio'

# A port that another program has.
python3 - "$scratch/port" <<'PYTHON' &
import os, socket, sys, time
taken = socket.socket()
taken.bind(("127.0.0.1", 0))
taken.listen()
with open(sys.argv[1] + ".part", "w") as file:
    file.write(str(taken.getsockname()[1]))
os.rename(sys.argv[1] + ".part", sys.argv[1])
time.sleep(60)
PYTHON
holder=$!
trap 'kill $holder 2>/dev/null; rm -rf "$scratch"' EXIT
for _ in {1..200}; do
    [ ! -e "$scratch/port" ] || break
    sleep 0.05
done
port=$(<"$scratch/port")
taken() { "$TARTAN" studio "$scratch" --no-open --port "$port" 2>&1 | sed "s/$port/PORT/"; }
golden port_taken taken
finish
