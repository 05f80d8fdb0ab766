#!/usr/bin/env python3
"""Times the slow reference of houses, the house.py of a folder, in seconds of the process.

house_peer.py FOLDER count FILE...       seconds of generating and testing all houses of the files, then a line for each
house_peer.py FOLDER rate SECONDS FILE   seconds a house, over a stretch of about so many seconds from the first house on"""
import sys
import time

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import house


def number_with_tiles(variants):
    number = 1
    for fitting in variants:
        number *= 1 if fitting is None else len(fitting)
    return number


def count(paths):
    opened = [(file, house.pick(file)) for file in map(house.parse, paths)]
    begun = time.process_time()
    counts = [house.count(file, library)["houses"] for file, library in opened]
    print(f"{time.process_time() - begun:.9f}", *counts, sep="\n")


def rate(most, path):
    file = house.parse(path)
    begun, found = time.process_time(), 0
    for _, _, variants in house.houses(file, house.pick(file)):
        found += number_with_tiles(variants)
        if time.process_time() - begun > most:
            break
    print(f"{(time.process_time() - begun) / found:.9f}")


if sys.argv[2] == "count":
    count(sys.argv[3:])
else:
    rate(float(sys.argv[3]), sys.argv[4])
