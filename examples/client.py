#!/usr/bin/env python3
"""From a CSV of parts to poses of the hand, with Python's standard library alone.

    python3 examples/client.py examples/parts.csv --gripper examples/hands/robotiq-3-finger.lisp

Each part is one line of JSON on standard output, in the order of the file: where the hand goes, in
mm in the frame of the part (z up, origin in its middle), or the reason why it can't be grasped.

The columns of the CSV are name, x_mm, y_mm, z_mm (the size; z is the height) and mass_kg.  These
may be left out: u, the friction of fingertip on part; pad_mm, the radius of a fingertip's pad;
on, the faces that touch something, as "Z2" or "Z2 X1"; accel, in m/s2, what the part is accelerated
with in every direction while it is carried; at_x_mm, at_y_mm, yaw_deg, where the middle of the part
stands on the table and how it is turned there, for an answer in the frame of the table, too.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = ["sbcl", "--script", os.path.join(HERE, "batch.lisp")]


class PlannerDied(Exception):
    """The program ended before it answered."""


class PlannerUseless(PlannerDied):
    """The program ended before it answered anything, so another try would end in the same way."""


class Planner:
    """One process of the program, which answers box by box; if it dies, the next box starts another."""

    def __init__(self, options=(), program=PROGRAM):
        self.command = [*program, "--input", "json", "--format", "json", *options]
        self.process = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def start(self):
        self.answered = 0
        self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        encoding="utf-8", bufsize=1)

    def close(self):
        """End the process; return its exit status, or None if there is none."""
        if self.process is None:
            return None
        process, self.process = self.process, None
        try:
            process.stdin.close()
        except OSError:
            pass
        process.stdout.close()
        return process.wait()

    def plan(self, box):
        """Return the record of BOX, a dict.  Raises PlannerDied."""
        if self.process is None:
            self.start()
        try:
            # One line a box, and out with it: the program answers a box as soon as it is complete.
            self.process.stdin.write(json.dumps(box, allow_nan=False) + "\n")
            self.process.stdin.flush()
            line = self.process.stdout.readline()
        except OSError:
            line = ""
        if not line.endswith("\n"):
            kind = PlannerDied if self.answered else PlannerUseless
            raise kind("the program ended with status %s before it answered" % self.close())
        self.answered += 1
        return json.loads(line)


def number(part, column, default=None):
    """Return the number in COLUMN of PART, DEFAULT if it is empty.  Raises ValueError."""
    text = (part.get(column) or "").strip()
    if text:
        try:
            return float(text)
        except ValueError:
            raise ValueError("%s is %r, not a number" % (column, text)) from None
    if default is None:
        raise ValueError("there is no %s" % column)
    return default


def pose_of(part, height):
    """Return the pose of PART, HEIGHT mm high, on the table; None if the CSV gives none."""
    columns = ("at_x_mm", "at_y_mm", "yaw_deg")
    if not any((part.get(column) or "").strip() for column in columns):
        return None
    x, y, yaw = (number(part, column, 0.0) for column in columns)
    half = math.radians(yaw) / 2
    return {"position": [x, y, height / 2], "orientation": [0, 0, math.sin(half), math.cos(half)]}


def box_of(part):
    """Return the box that PART, a row of the CSV, is.  Raises ValueError."""
    mass = number(part, "mass_kg")
    u = number(part, "u", 0.6)                                     # rubber on cardboard
    force = mass * number(part, "accel", 2.0)
    size = [number(part, axis + "_mm") for axis in "xyz"]
    box = {
        "name": (part.get("name") or "").strip() or "part",
        "units": ["mm", "N"],
        "size": size,
        "mass": mass,
        "u": u,
        "v": round(2 / 3 * u * number(part, "pad_mm", 8.0), 9),     # a round pad that presses evenly
        "constrained": (part.get("on") or "Z2").split(),
        "force_needed": [force, force, force, 0, 0, 0],
        "velocity_needed": [0, 0, 0, 0, 0, 0],
    }
    pose = pose_of(part, size[2])
    return {**box, "pose": pose} if pose else box


def answer_of(record):
    """Return what a robot wants to know of RECORD."""
    if record["status"] != "grasp":
        return {"name": record["name"], "status": record["status"], "reason": record["reason"]}
    hand = record["hand"]
    answer = {"name": record["name"], "status": "grasp", "grasp": record["grasp"],
              "position": hand["position"], "orientation": hand["orientation"],
              "opening": hand["opening"], "fits": record.get("fits")}
    if "squeeze" in record:
        answer["squeeze"] = record["squeeze"]
    if record.get("world"):
        answer["world"] = {key: record["world"][key] for key in ("position", "orientation")}
    return answer


def answers(parts, planner):
    """Yield the answer for each of PARTS; what is wrong with one is its own affair."""
    for row, part in enumerate(parts, start=2):                     # row 1 has the columns' names
        try:
            yield answer_of(planner.plan(box_of(part)))
        except PlannerUseless:
            raise
        except (ValueError, PlannerDied) as error:
            yield {"name": part.get("name"), "status": "error", "reason": "row %d: %s" % (row, error)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("parts", help="a CSV file, or - for standard input")
    parser.add_argument("--program", help="the executable to use instead of SBCL and the sources")
    for option in ("--gripper", "--hand", "--rules", "--grasps", "--index"):
        parser.add_argument(option, help="see docs/batch.md")
    given = vars(parser.parse_args())
    program = given.pop("program")
    name = given.pop("parts")
    options = [text for key, value in given.items() if value for text in ("--" + key, value)]
    source = sys.stdin if name == "-" else open(name, newline="", encoding="utf-8-sig")
    good = True
    with source, Planner(options, [program] if program else PROGRAM) as planner:
        for answer in answers(csv.DictReader(source), planner):
            good = good and answer["status"] != "error"
            print(json.dumps(answer), flush=True)
    return 0 if good else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:                                         # who reads the answers has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, PlannerUseless, UnicodeDecodeError, csv.Error) as error:
        sys.exit("client.py: %s" % error)
