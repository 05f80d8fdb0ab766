#!/usr/bin/env python3
# The same with ids, several lines at a time, and the answers of each lot in the opposite order.
import json, os, select, sys
held = b""
while True:
    got = os.read(0, 65536)
    if not got:
        break
    held += got
    *lines, held = held.split(b"\n")
    answers = []
    for line in lines:
        asked = json.loads(line)
        answers.append(json.dumps({"id": asked["id"], "score": len(line[line.index(b"sentence") + 8:])}))
    for answer in reversed(answers):
        print(answer, flush=True)
