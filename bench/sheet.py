#!/usr/bin/env python3
"""Measures what a sheet of bred forms takes until a person can look at it.

usage: sheet.py TARTAN STUDY FOLDER

Prints the median processor time of seven runs with one thread, in milliseconds, from the start of `tartan breed` until
the first sheet stands. What is made after the last choice (the files in best/ and their pictures) is not in it.
"""
import os, shutil, statistics, subprocess, sys, time

tartan, study, folder = sys.argv[1:]


def processor_time(process):
    """Of all its threads, those that have ended too: user and system time in ticks (proc(5))."""
    fields = open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) * 1000 / os.sysconf("SC_CLK_TCK")


def once():
    shutil.rmtree(folder, ignore_errors=True)
    breed = subprocess.Popen([tartan, "breed", study, "-o", folder, "--threads", "1"], stdin=subprocess.PIPE,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while not os.path.exists(os.path.join(folder, "sheet-0000.png")) and breed.poll() is None:
        time.sleep(0.001)
    if breed.poll() is not None:
        sys.exit("sheet.py: tartan breed ended without a sheet")
    took = processor_time(breed.pid)
    breed.communicate()
    return took


print(f"{statistics.median(once() for _ in range(7)):.0f}")
