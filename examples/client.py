#!/usr/bin/env python3
"""From a CSV of parts to poses of the hand, with Python's standard library alone.

    python3 examples/client.py examples/parts.csv --gripper examples/hands/robotiq-3-finger.lisp

Each part is one line of JSON on standard output, in the order of the file: where the hand goes, in
mm in the frame of the part (z up, origin in its middle), or the reason why it can't be grasped.
"position" is the point between the fingertips; "palm", there if the gripper names PALM-DEPTH, is
where the palm is.  The first run compiles SUPER-GRIP, which takes up to half a minute.

These columns must be there:
  x_mm, y_mm, z_mm  the size; z is the height
  mass_kg           the mass

These may be left out, or be empty in a row:
  name              what the part is called; "row 3" if it has no name
  u                 friction of fingertip on part; 0.6, rubber on cardboard
  pad_mm            radius of a fingertip's round pad; 8
  accel             in m/s2, what the part is accelerated with in every direction while it is
                    carried; 2
  on                the faces that touch something, as "Z2" or "Z2 X1"; Z2, the bottom; none if it
                    touches nothing
  at_x_mm, at_y_mm  where the middle of the part stands on the table, for an answer in the frame of
                    the table, too: "world"
  yaw_deg           how it is turned there, about z; 0

Numbers have a decimal point.  The planner does not know where the rest of the hand is: where the
hand comes from the side, look whether it has room above the table.

For --format isaac, moveit and graspgen, give the program the boxes:
    python3 examples/client.py parts.csv --boxes |
    sbcl --script examples/batch.lisp --input json --format moveit --gripper FILE
"""

import argparse
import csv
import difflib
import json
import math
import os
import re
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


class BadFile(Exception):
    """The CSV as a whole can't be used."""


POSITIVE = ("more than 0", lambda x: x > 0)
NOT_NEGATIVE = ("0 or more", lambda x: x >= 0)
FRICTION = ("from 0 to 5 (rubber has 0.3 to 1)", lambda x: 0 <= x <= 5)
ANY = ("", lambda x: True)

# What each column of numbers is if it is left out, None if it may not be, and what it must be.
NUMBERS = {"x_mm": (None, POSITIVE), "y_mm": (None, POSITIVE), "z_mm": (None, POSITIVE),
           "mass_kg": (None, POSITIVE), "u": (0.6, FRICTION), "pad_mm": (8.0, NOT_NEGATIVE),
           "accel": (2.0, POSITIVE), "at_x_mm": (0.0, ANY), "at_y_mm": (0.0, ANY),
           "yaw_deg": (0.0, ANY)}
COLUMNS = ("name", *NUMBERS, "on")
FACES = ("X1", "X2", "Y1", "Y2", "Z1", "Z2")
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def check_columns(columns):
    """Raise BadFile if COLUMNS, the first row, are not what a row of parts needs."""
    found = "its columns are " + ", ".join(repr(column) for column in columns)
    if len(columns) == 1 and ";" in columns[0]:
        raise BadFile("its columns have ; between them; commas are needed: %s"
                      % columns[0].replace(";", ","))
    for column in columns:
        if column not in COLUMNS:
            near = (difflib.get_close_matches(column.lower(), COLUMNS, n=1)
                    if column.isidentifier() else [])
            raise BadFile("there is no column %r%s; %s; those there may be, "
                          "with commas between, are %s"
                          % (column, " (did you mean %s?)" % near[0] if near else "", found,
                             ", ".join(COLUMNS)))
        if columns.count(column) > 1:
            raise BadFile("the column %s is there twice; %s" % (column, found))
    missing = [column for column, (default, _) in NUMBERS.items()
               if default is None and column not in columns]
    if missing:
        raise BadFile("without %s: these columns are needed; %s" % (", ".join(missing), found))


def parts_of(source):
    """Yield the number of each row of SOURCE, a CSV, and its fields; blank rows only count."""
    rows = ((row, [field.strip() for field in fields])
            for row, fields in enumerate(csv.reader(source), start=1))
    filled = ((row, fields) for row, fields in rows if any(fields))
    _, columns = next(filled, (1, None))
    while columns and not columns[-1]:
        columns.pop()
    if columns is None:
        raise BadFile("the file is empty; its first row must name columns: %s" % ", ".join(COLUMNS))
    check_columns(columns)
    row = None
    for row, fields in filled:
        yield row, columns, fields
    if row is None:
        raise BadFile("there are no parts below the columns' names")


def part_of(columns, fields):
    """Return the dict of FIELDS by COLUMNS.  Raises ValueError."""
    if len(fields) > len(columns) and any(fields[len(columns):]):
        raise ValueError("there are %d fields, but %d columns: write decimals with a point, and "
                         "put a text with a comma between double quotes" % (len(fields), len(columns)))
    return {column: field for column, field in zip(columns, fields) if field}


def number_of(column, text):
    """Return the number that TEXT, None for nothing, is in COLUMN.  Raises ValueError."""
    default, (rule, good) = NUMBERS[column]
    if text is None:
        if default is None:
            raise ValueError("there is no %s" % column)
        return default
    if not NUMBER.fullmatch(text) or not math.isfinite(float(text)):
        hint = ": write decimals with a point" if "," in text else ""
        raise ValueError("%s is %r, not a number%s" % (column, text, hint))
    if not good(float(text)):
        raise ValueError("%s is %s, but must be %s" % (column, text, rule))
    return float(text)


def faces_of(part):
    """Return the faces of PART that touch something.  Raises ValueError."""
    text = part.get("on", "Z2").upper()
    faces = [] if text == "NONE" else text.split()
    for face in faces:
        if face not in FACES:
            raise ValueError("on is %r, but must be faces, as %s with blanks between, or none"
                             % (part["on"], " ".join(FACES)))
    return sorted(set(faces))


def pose_of(part, values):
    """Return the pose of PART on the table; None if the CSV gives none.  Raises ValueError."""
    given = [column for column in ("at_x_mm", "at_y_mm", "yaw_deg") if column in part]
    if not given:
        return None
    for column in ("at_x_mm", "at_y_mm"):
        if column not in part:
            raise ValueError("%s is given, but %s is not: give both, or neither"
                             % (given[0], column))
    half = math.radians(values["yaw_deg"]) / 2
    return {"position": [values["at_x_mm"], values["at_y_mm"], values["z_mm"] / 2],
            "orientation": [0, 0, math.sin(half), math.cos(half)]}


def box_of(part, row):
    """Return the box that PART, in ROW, is.  Raises ValueError with all that is wrong with it."""
    values, faults = {}, []

    def look(read, *arguments):
        try:
            return read(*arguments)
        except ValueError as error:
            faults.append(str(error))

    for column in NUMBERS:
        values[column] = look(number_of, column, part.get(column))
    faces = look(faces_of, part)
    pose = None if faults else look(pose_of, part, values)
    if faults:
        raise ValueError("; ".join(faults))
    force = values["mass_kg"] * values["accel"]
    box = {
        "name": part.get("name", "row %d" % row),
        "units": ["mm", "N"],
        "size": [values[axis + "_mm"] for axis in "xyz"],
        "mass": values["mass_kg"],
        "u": values["u"],
        # A round pad that presses evenly.
        "v": round(2 / 3 * values["u"] * values["pad_mm"], 9),
        "constrained": faces,
        "force_needed": [force, force, force, 0, 0, 0],
        "velocity_needed": [0, 0, 1, 0, 0, 0],                     # up; see docs/batch.md
    }
    return {**box, "pose": pose} if pose else box


def boxes_of(source, complain):
    """Yield (ROW, NAME, BOX, FAULT) of each part of SOURCE; BOX or FAULT is None."""
    seen = {}
    for row, columns, fields in parts_of(source):
        name = dict(zip(columns, fields)).get("name") or "row %d" % row
        if name in seen:
            complain("row %d: the name %r is that of row %d, too" % (row, name, seen[name]))
        seen.setdefault(name, row)
        try:
            yield row, name, box_of(part_of(columns, fields), row), None
        except ValueError as error:
            yield row, name, None, "row %d: %s" % (row, error)


def palm_depth(options):
    """Return the PALM-DEPTH, in mm, of the gripper that OPTIONS name; None if it names none."""
    file = options.get("gripper") or (os.path.join(options["hand"], "gripper.lisp")
                                      if options.get("hand") else options.get("grasps"))
    try:
        with open(file, encoding="utf-8") as lines:
            code = " ".join(line.split(";")[0] for line in lines)
        found = re.search(r"\sPALM-DEPTH\s+([0-9.]+)[\s)]", code, re.IGNORECASE)
        return 10 * float(found.group(1)) if found else None
    except (OSError, ValueError):                                   # the program says what is wrong
        return None


def place_of(hand, depth):
    """Return where HAND is: between its fingertips and, DEPTH behind that along its z, its palm."""
    place = {key: hand[key] for key in ("position", "orientation")}
    if depth is not None:
        x, y, z, w = hand["orientation"]
        axis = (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))
        place["palm"] = [round(p - depth * a, 9) for p, a in zip(hand["position"], axis)]
    return place


def grasp_of(record, depth):
    """Return what a robot wants to know of the grasp of RECORD, the box's or one of its others."""
    grasp = {"grasp": record["grasp"], **place_of(record["hand"], depth),
             "opening": record["hand"]["opening"], "fits": record.get("fits")}
    if "squeeze" in record:
        grasp["squeeze"] = record["squeeze"]
    if record.get("world"):
        grasp["world"] = place_of(record["world"], depth)
    return grasp


def answer_of(record, row, depth):
    """Return the answer that RECORD is to the part in ROW."""
    answer = {"name": record["name"], "status": record["status"]}
    if record["status"] == "error":
        problems = "; ".join(problem["text"] for problem in record["problems"])
        return {**answer, "reason": "row %d: %s" % (row, problems)}
    if record["status"] != "grasp":
        return {**answer, "reason": record["reason"]}
    answer.update(grasp_of(record, depth))
    if record.get("alternatives"):
        answer["alternatives"] = [grasp_of(other, depth) for other in record["alternatives"]]
    return answer


def answers(boxes, planner, depth=None):
    """Yield the answer for each of BOXES; what is wrong with one is its own affair."""
    for row, name, box, fault in boxes:
        if box:
            try:
                yield answer_of(planner.plan(box), row, depth)
                continue
            except PlannerUseless:
                raise
            except PlannerDied as error:
                fault = "row %d: %s" % (row, error)
        yield {"name": name, "status": "error", "reason": fault}


def arguments():
    """Return what the command line says: PARTS, PROGRAM, BOXES, and the options to pass on."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", help="a CSV file, or - for standard input")
    parser.add_argument("--program", help="the executable to use instead of SBCL and the sources")
    parser.add_argument("--boxes", action="store_true", help="print the boxes, and plan nothing")
    parser.add_argument("--gripper", metavar="FILE", help="the hand")
    parser.add_argument("--hand", metavar="DIR", help="the hand with its rules and grasps")
    parser.add_argument("--index", choices=("paper", "exact"),
                        help="what grasps are rated by: the paper's index, by default, or what "
                        "their contacts can really do; exact adds squeeze, and sees no table")
    parser.add_argument("--all", metavar="N", help="also the N best grasps, as alternatives")
    parser.add_argument("--margin", metavar="X", help="multiplies mass and forces by X; 1")
    for option in ("--rules", "--grasps"):
        parser.add_argument(option, metavar="FILE", help="see docs/batch.md")
    given = vars(parser.parse_args())
    parts, program, boxes = (given.pop(key) for key in ("parts", "program", "boxes"))
    if not (boxes or given["gripper"] or given["hand"] or given["grasps"]):
        parser.error("pass --gripper FILE: forces in N need the hand's FINGER-FORCE; "
                     "examples/hands/ has some")
    return parts, [program] if program else PROGRAM, boxes, given


def complain(text):
    print("client.py: %s" % text, file=sys.stderr)


def run(boxes, program, options):
    """Print the answer for each of BOXES; return true if none is an error."""
    texts = [text for key, value in options.items() if value for text in ("--" + key, value)]
    good = True
    with Planner(texts, program) as planner:
        for answer in answers(boxes, planner, palm_depth(options)):
            good = good and answer["status"] != "error"
            print(json.dumps(answer), flush=True)
    return good


def write_boxes(boxes):
    """Print each of BOXES, and say what is wrong with the others; return true if nothing is."""
    good = True
    for _, _, box, fault in boxes:
        if box:
            print(json.dumps(box))
        else:
            good = False
            complain(fault)
    return good


def main():
    name, program, only_boxes, options = arguments()
    source = open(0 if name == "-" else name, newline="", encoding="utf-8-sig")
    with source:
        boxes = boxes_of(source, complain)
        try:
            good = write_boxes(boxes) if only_boxes else run(boxes, program, options)
        except BadFile as error:
            complain("%s: %s" % ("standard input" if name == "-" else name, error))
            return 65
    return 0 if good else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BrokenPipeError:                                         # who reads the answers has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (OSError, PlannerUseless, UnicodeDecodeError, csv.Error) as error:
        sys.exit("client.py: %s" % error)
