#!/usr/bin/env python3
"""The table of docs/ycb.md: thirty household objects, three hands.

    python3 examples/ycb.py

Each object of examples/ycb.jsonl is planned with --index exact.  A cell says the grasp, from where
the palm comes, and the least force with which each finger must be able to press, in N.
"""

import argparse
import json
import os

from client import HERE, PROGRAM, Planner

HANDS = (("Robotiq 3-Finger", "--gripper", "robotiq-3-finger.lisp"),
         ("BarrettHand BH8-282", "--gripper", "barrett-bh8-282.lisp"),
         ("Robotiq 2F-85", "--hand", "robotiq-2f-85"))

SHORT = (("CANT GRASP TOO SMALL", "too thin"), ("CANT GRASP NO FREE PAIR", "too wide"),
         ("NO GRASP IS POSSIBLE, NEAREST MISS: ", ""), ("the narrowest free pair", "too wide"))


def came_from(approach):
    """Return from where the palm comes, by its direction of APPROACH in the object's frame."""
    return "above" if approach[2] < -0.5 else "below" if approach[2] > 0.5 else "the side"


def grasp_name(name):
    """Return NAME; the U- and the C-shape of these hands touch the same places, and count as one."""
    return "PINCH-3-U/C-SHAPE" if name in ("PINCH-3-U-SHAPE", "PINCH-3-C-SHAPE") else name


def cell(record):
    if record["status"] == "grasp":
        fits = {True: "", False: ", does not fit", None: ", may not fit"}[record["fits"]]
        return "%s, %s, %.2g N%s" % (grasp_name(record["grasp"]), came_from(record["approach"]),
                                     record["squeeze"], fits)
    reason = record["reason"]
    return "can't: " + next((short for long, short in SHORT if short and long in reason), reason)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", help="the executable to use instead of SBCL and the sources")
    given = parser.parse_args()
    program = [given.program] if given.program else PROGRAM
    with open(os.path.join(HERE, "ycb.jsonl"), encoding="utf-8") as lines:
        boxes = [json.loads(line) for line in lines]
    columns = []
    for _, option, name in HANDS:
        with Planner(["--index", "exact", option, os.path.join(HERE, "hands", name)],
                     program) as planner:
            columns.append([cell(planner.plan(box)) for box in boxes])
    print("| object | mm | kg | %s |" % " | ".join(name for name, *_ in HANDS))
    print("| --- " * (3 + len(HANDS)) + "|")
    for box, *cells in zip(boxes, *columns):
        print("| %s | %s | %g | %s |" % (box["name"], " x ".join("%g" % size for size in box["size"]),
                                         box["mass"], " | ".join(cells)))


if __name__ == "__main__":
    main()
