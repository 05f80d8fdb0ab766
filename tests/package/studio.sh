#!/usr/bin/env bash
# Tries the installed server of the studio, on a system that has nothing but it: studio.sh VERSION
set -euo pipefail
fail() {
    echo "studio: $1" >&2
    exit 1
}
[ "$(tartan-studio --version)" = "tartan-studio $1" ] || fail 'tartan-studio --version'
set -m # so that the server has the signals of a program in front
tartan studio --no-open /trial >/trial/address 2>/trial/said &
server=$!
for _ in {1..100}; do
    [ ! -s /trial/address ] || break
    sleep 0.1
done
address=$(</trial/address)
[[ $address =~ ^http://127\.0\.0\.1:([0-9]+)/#[0-9a-f]{32}$ ]] || fail "no address: $address $(</trial/said)"
exec 3<>"/dev/tcp/127.0.0.1/${BASH_REMATCH[1]}"
printf 'GET / HTTP/1.1\r\nHost: 127.0.0.1:%s\r\n\r\n' "${BASH_REMATCH[1]}" >&3
read -r status <&3
[[ $status == 'HTTP/1.1 200'* ]] || fail "the page: $status"
exec 3<&-
kill -INT "$server"
code=0
wait "$server" || code=$?
[ "$code" = 0 ] || fail "Ctrl-C ends it with $code"
