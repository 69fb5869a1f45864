#!/usr/bin/env python3
"""soak.py: drive the batch program with hostile input, and check what it promises.

    python3 t/soak.py [--seed N] [--records N] [--program PATH] [--case N] [--keep DIR]

It shares no code and no model with the program or with its other tests.  A run is a row of cases;
each makes boxes, spoils some, sends them in some way, and compares what comes out with what the
README promises: one record for each box, in order, with its name, line and status; whole boxes get
the answer that they get alone; what is wrong is told with line and column; nothing else is written.
A case depends on the seed and its own number only.  PATH is the executable that src/build.lisp
makes, or examples/batch.lisp; without it an executable is built.
"""

import argparse
import json
import os
import random
import re
import resource
import select
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from fractions import Fraction
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEYS = ("name line status grasp matching quality u_w u_t limiting offset approach contacts tried "
        "possible reason").split()
FACES = ["X1", "X2", "Y1", "Y2", "Z1", "Z2"]
LIMITS = {"depth": 32, "record": 65536, "number": 40, "name": 64}
RAW = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f]")
CRASH = re.compile(r"our fault|debugger|unhandled|backtrace|fatal error|exhausted|corrupt", re.I)


class Failure(Exception):
    """The program broke its promise."""


# ---------------------------------------------------------------- boxes

def value(text):
    """The double that the text of a number stands for, correctly rounded."""
    return float(Fraction(text.replace("d", "e")))


def number(rng, json_only, low, high):
    """The text of a number from LOW to HIGH, in any of the spellings that are read."""
    x = rng.choice([rng.uniform(low, high), round(rng.uniform(low, high), 1), low, high,
                    rng.randint(int(low), int(high))])
    text = repr(x)
    if "e" not in text:
        text = rng.choice([text, text, f"{x:.17f}", f"{x * 1000:.3f}e-3", f"{x / 100:.9f}E+2",
                           (text if "." in text else text + ".").ljust(40, "0")])
    if not json_only:
        text = rng.choice([text, text, "+" + text[:39], text.rjust(40, "0"), text.replace("e", "d"),
                           re.sub(r"^0(?=\.)", "", text), re.sub(r"\.0$", ".", text),
                           f"{rng.randint(int(low) * 97 + 1, int(high) * 97)}/97"])
    return text if low <= value(text) <= high else repr(low)


def size(rng, json_only):
    extreme = ["1e300", "1e-300", "1e+300", "0.0001", "1e-9",
               "123456789012345678901234567890123456789",
               "1000000", "12", "2", "4.7", "9.65", "10", "11.999999999999999"]
    if rng.random() < 0.15:
        return rng.choice(extreme)
    return number(rng, json_only, 1, rng.choice([3, 15, 40]))


def needs(rng, json_only):
    if rng.random() < 0.1:
        return ["0"] * 6
    return [number(rng, json_only, 0, 1) for _ in range(6)]


def make_box(rng, json_only):
    """The texts of a box, by key."""
    other = [lambda: number(rng, json_only, 0, 2)] * 6 + [lambda: rng.choice(
        ["0", "-0.0", "-0", "0e99", "1e-300", "1e300", "0.1", "0.70710678118654757", "1e-17"])]
    box = {"size": [size(rng, json_only) for _ in range(3)],
           "weight": rng.choice(other)(), "u": rng.choice(other)(), "v": rng.choice(other)(),
           "constrained": rng.sample(FACES, rng.choice([0, 0, 1, 2, 2, 3, 4, 6])),
           "force_needed": needs(rng, json_only), "velocity_needed": needs(rng, json_only)}
    if not any(map(value, box["force_needed"] + box["velocity_needed"])):
        box["force_needed"][rng.randrange(6)] = "1"
    return box


def clean(box):
    """The box as one plain line of Lisp, each number in its shortest spelling."""
    def numbers(texts):
        return " ".join(repr(value(text)) for text in texts)
    return (f"((SIZE {numbers(box['size'])}) (WEIGHT {numbers([box['weight']])}) "
            f"(U {numbers([box['u']])}) (V {numbers([box['v']])}) "
            f"(CONSTRAINED {' '.join(box['constrained'])}) "
            f"(FORCE-NEEDED ({numbers(box['force_needed'])})) "
            f"(VELOCITY-NEEDED ({numbers(box['velocity_needed'])})))\n")


def make_name(rng, count):
    """A name, or None.  Octets that are not UTF-8 are written as surrogates of surrogateescape."""
    plain = f"box {count}"
    return rng.choice([
        plain, plain, plain, None, "", f'{plain} "quoted" \\ back', f"{plain} é 軸 𝔊 🤖", "NIL",
                       "null",
        plain + rng.choice("\x00\x01\x07\x08\x0b\x1b\x1e\x1f\x7f\x80\x85\x9b\x9f") + "[31m",
        plain + rng.choice("\u00a0\u200b\u2028\u202e\ufeff\uffff\ufffd\u0301"),
        plain + "\udcff", plain + "\udcc3", plain + "\udce2\udc82", plain + "\udcf0\udc9f\udca4 x",
        plain + "\udced\udca0\udc80", plain + "\udcc0\udcaf", plain + "\udcf4\udc90\udc80\udc80",
        plain + "\nnext line", plain + "\ttab", plain + " {[(';", "x" * rng.choice([63, 64, 65,
                                                                                    3000]),
        plain + "~a~%~d", plain + "</script>&amp;"])


def octets(text):
    return text.encode("utf-8", "surrogateescape")


def seen(text):
    """TEXT as a decoder sees it that turns what is not UTF-8 into U+FFFD."""
    return octets(text).decode("utf-8", "replace")


# ---------------------------------------------------------------- how boxes are written

def lisp_string(name):
    return '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'


def json_string(rng, name):
    text = json.dumps(name, ensure_ascii=False)
    text = re.sub("[\x7f-\U0010ffff]", lambda match: match[0] if rng.random() < 0.5 or
                  "\udc80" <= match[0] <= "\udcff" else json.dumps(match[0])[1:-1], text)
    return text.replace("/", "\\/") if rng.random() < 0.3 else text


def clauses(rng, box, name, notation):
    """The parts of the box as texts, in any order."""
    if notation == "json":
        parts = [f'"{key}":{rng.choice(["", " "])}{json_part(rng, key, box[key])}' for key in box]
        if name is not None or rng.random() < 0.3:
            parts.append('"name": ' + ("null" if name is None else json_string(rng, name)))
    else:
        parts = []
        for key, part in box.items():
            text = part if isinstance(part, str) else " ".join(part)
            if key == "constrained":
                text = rng.choice([text, text.lower()])
            word = rng.choice([str.upper, str.lower, str.title])(key.replace("_", "-"))
            parts.append(f"({word} ({text}))" if key.endswith("needed") else f"({word} {text})")
        if name is not None:
            parts.append(f"(NAME {lisp_string(name)})")
    if rng.random() < 0.1:  # facts of one's own: the shipped rules declare none
        parts.append('"facts": []' if notation == "json" else "(facts)")
    if rng.random() < 0.1:  # the units of every box that names none
        parts.append('"units": ["cm", "Finger"]' if notation == "json" else "(units Cm FINGER)")
    rng.shuffle(parts)
    return parts


def json_part(rng, key, part):
    if isinstance(part, str):
        return part
    if key == "constrained":
        part = [f'"{face}"' for face in part]
    return "[" + rng.choice([",", ", ", " , "]).join(part) + "]"


def blanks(rng, notation, eol, loose=True):
    """White space between parts; no line of it begins with what begins a record."""
    if rng.random() < 0.8 or not loose:
        return " "
    if notation == "json":
        return rng.choice(["", "  ", "\t", eol, eol + "  ", " " + eol * 3])
    return rng.choice(["", "\t", "\f", eol, eol + "  ", f" ; a comment )(\"'{{[ é{eol} ",
                       f";{eol}"])


class Item:
    """A piece of input and what must come of it: the answer to BOX, an index, or from LEAST to MOST
    error records.  EITHER: the answer, then an error; or an error alone.  WILD: anything on its
    lines.  OPEN: only what starts a record ends it.
    MARK (start, end) in TEXT is where the mistake is; MENTIONS are in the reason."""

    def __init__(self, text, box=None, name=None, least=1, most=1, either=False, wild=False,
                 open=False, mark=None, mentions=(), alone=False):
        self.text, self.box, self.name, self.least, self.most = text, box, name, least, most
        self.either, self.wild, self.mark, self.mentions = either, wild, mark, mentions
        self.open = open or wild
        self.alone = alone or box is None or either
        self.line = self.last = self.column = 0

    def place(self, offset):
        """The line and column of the character at OFFSET."""
        before = seen(self.text[:offset])
        line = before.count("\n")
        return (self.line + line,
                len(before) - before.rfind("\n") if line else self.column + len(before))


class Case:
    """The choices that hold for one case, and its boxes."""

    def __init__(self, rng, soak):
        self.rng, self.soak = rng, soak
        self.eol = rng.choice(["\n", "\n", "\r\n"])
        self.options, self.limits = [], dict(LIMITS)
        self.boxes, self.count = [], 0

    def choose_limits(self):
        if self.rng.random() < 0.3:
            for key, low, high in (("depth", 5, 60), ("record", 6000, 9000), ("number", 40, 60),
                                   ("name", 64, 90)):
                if self.rng.random() < 0.5:
                    self.limits[key] = self.rng.randint(low, high)
                    self.options += [f"--{key}-limit", str(self.limits[key])]

    def fresh(self, notation):
        """A new box, its name and its parts."""
        self.count += 1
        box = make_box(self.rng, notation == "json")
        name = make_name(self.rng, self.count)
        return box, name, clauses(self.rng, box, name, notation)

    def join(self, parts, notation, loose=True):
        """The text of a record of PARTS, and where each of them begins."""
        space = lambda: blanks(self.rng, notation, self.eol, loose)
        text, places = ("{" if notation == "json" else "("), []
        for count, part in enumerate(parts):
            comma = "," if notation == "json" and count else ""
            text += (space() if count or self.rng.random() < 0.1 and loose else "") + comma
            if comma:
                text += space()
            places.append(len(text))
            text += part
        return text + ("}" if notation == "json" else ")"), places

    def good(self, notation, loose=True):
        box, name, parts = self.fresh(notation)
        text, _ = self.join(parts, notation, loose)
        if notation == "lisp" and self.rng.random() < 0.2:
            text = self.rng.choice(["(SETQ BOX '%s)", "(setq box '%s)", "'%s",
                                    "(SETQ Box\n  '%s)"]) % text
            if text[0] == "'":
                return self.answered(box, name, text, alone=True)
        return self.answered(box, name, text)

    def answered(self, box, name, text, **more):
        self.boxes.append(box)
        return Item(text, box=len(self.boxes) - 1, name=name, **more)


# ---------------------------------------------------------------- spoiled boxes
#
# Each takes a case and a notation, and returns an Item.  Those of CLOSED end with their last
# parenthesis or brace, so that another record may follow in an array.

def replaced(case, notation, part, mentions=(), index=None, at=None):
    """A box in which PART is added, or stands in the place of the one at INDEX."""
    _, name, parts = case.fresh(notation)
    if index is None:
        index = case.rng.randrange(len(parts) + 1)
        parts.insert(index, part)
    else:
        parts[index] = part
    text, places = case.join(parts, notation)
    start, end = at or (0, len(part))
    return Item(text, name=name, mentions=mentions, mark=(places[index] + start,
                                                          places[index] + end))


def unknown_key(case, notation):
    word = case.rng.choice(["COLOUR", "SIZ", "FRICTION", "X", "FORCE_NEED", "NIL", "A" * 60])
    part = f'"{word}": 1' if notation == "json" else f"({word} 1)"
    return replaced(case, notation, part, mentions=(word,))


def many_keys(case, notation):
    """Keys by the thousand, as many as the limit of a record allows."""
    room = case.limits["record"] - 8000
    if room < 0 or case.rng.random() < 0.7:
        room = case.limits["record"] // 3
    form = case.rng.choice(['"k%d":1' if notation == "json" else "(K%d 1)",
                            '"size":%d' if notation == "json" else "(SIZE %d)",
                            '"name":"%d"' if notation == "json" else '(NAME "%d")'])
    parts, length = [], 0
    while length < room:
        parts.append(form % len(parts))
        length += len(parts[-1]) + 3
    text, _ = case.join(parts, notation, loose=False)
    return Item(text, name=any)


def duplicate(case, notation):
    _, name, parts = case.fresh(notation)
    twin = case.rng.choice([part for part in parts if "name" not in part.lower()])
    parts.append(twin)
    text, places = case.join(parts, notation)
    return Item(text, name=name, mark=(places[-1], places[-1] + len(twin)), mentions=("twice",))


def missing(case, notation):
    _, name, parts = case.fresh(notation)
    left = case.rng.choice([part for part in parts
                            if not re.search("name|facts", part.lower())])
    parts.remove(left)
    text, _ = case.join(parts, notation)
    word = re.search(r"[A-Za-z_-]+", left)[0]
    return Item(text, name=name, mentions=(word.upper() if notation == "lisp" else word,))


BAD_VALUES = {
    "lisp": ["(SIZE 12 2)", "(SIZE 1 2 3 4)", "(SIZE 0 1 1)", "(SIZE -1 1 1)", '(SIZE "12" 2 2)',
             "(SIZE (12 2 2))", "(WEIGHT -1)", "(WEIGHT)", "(U 1 2)", "(V X)",
             "(FORCE-NEEDED 1 1 1 1 1 1)",
             "(FORCE-NEEDED (1 1 1 1 1 1.0001))", "(VELOCITY-NEEDED (0 0 0 0 0))",
             "(CONSTRAINED X3)",
             "(CONSTRAINED (X1 X2))", "(CONSTRAINED X1 X1)", "(CONSTRAINED 1)", "(U -1e-300)",
             "(FACTS (WET))", "(FACTS WET)", "(FACTS (WET (X1 X1)))", "(FACTS (NOT WET))",
             "(UNITS MM)", "(UNITS MM KG)", "(UNITS N MM)"],
    "json": ['"size": [12, 2]', '"size": 12', '"size": [0,1,1]', '"size": ["1",1,1]',
             '"size": null',
             '"weight": -1', '"weight": "1"', '"u": [1]', '"v": true', '"v": {"a": 1}', '"u": null',
             '"force_needed": [1,1,1,1,1,2]', '"velocity_needed": [0,0,0]', '"constrained": "X1"',
             '"constrained": ["X3"]', '"constrained": [["X1"]]', '"constrained": ["X1","X1"]',
             '"facts": [["WET"]]', '"facts": ["WET"]', '"facts": [["WET",["X9"]]]',
             '"facts": [[["X1"]]]', '"facts": null', '"units": ["mm"]', '"units": ["mm", "kg"]',
             '"units": "mm"', '"units": null']}


def bad_value(case, notation):
    part = case.rng.choice(BAD_VALUES[notation])
    key = re.search(r"[A-Za-z_-]+", part)[0].lower()
    _, _, parts = case.fresh(notation)
    keys = [re.search(r"[A-Za-z_-]+", old)[0].lower() for old in parts]
    index = keys.index(key) if key in keys else len(parts)
    parts[index:index + 1] = [part]
    text, places = case.join(parts, notation)
    return Item(text, name=any, mark=(places[index], places[index] + len(part)))


def bad_faces(case, notation):
    """All faces that are none are told."""
    words = case.rng.sample(["Q", "X9", "W1", "TOP"], 2)
    part = (f'"constrained": ["Z2","{words[0]}","{words[1]}"]' if notation == "json"
            else f"(CONSTRAINED Z2 {words[0]} {words[1]})")
    _, name, parts = case.fresh(notation)
    parts = [old for old in parts if "constrained" not in old.lower()] + [part]
    text, places = case.join(parts, notation)
    return Item(text, name=name, mentions=tuple(words), mark=(places[-1], places[-1] + len(part)))


def bad_token(case, notation):
    """A number or word that is none, or that is too long, by one character."""
    limit = case.limits["number"]
    token = case.rng.choice(["1e999", "1e-301", "-1e301", "1.5." + "5", "1e", "1e+", "12x",
                             "0." + "1" * (limit - 1), "1" * (limit + 1)]
                            + (["NaN", "Infinity", "-Infinity", "01", ".5", "1.", "+1", "1/2",
                                "tru", "True",
                                "nil", "1d3", "0x10", "--1", "'1'"] if notation == "json"
                               else ["1/0", "1/", "#(1)", "#.(QUIT)", "|x|", ",x", "`x", "\\x",
                                     "1/2/3", "x:y",
                                     "W" * (case.limits["name"] + 1), "( . 1)"]))
    part = f'"u": {token}' if notation == "json" else f"(U {token})"
    skip = part.index(token)
    return replaced(case, notation, part, at=(skip, len(part)))


INVISIBLE = "\u00a0\u200b\u2028\ufeff\u2060\u00ad\u3000"


def bad_character(case, notation):
    """A character that can't stand between parts, and that may be invisible."""
    character = case.rng.choice("\x00\x01\x0b\x1b\x7f\x80\x9b\x85é§軸\udcff\udcc3" + INVISIBLE)
    part = f'{character}"u": 1' if notation == "json" else f"({character} 1)"
    mentions = (f"U+{ord(character):04X}",) if character in INVISIBLE else ()
    start = part.index(character)
    return replaced(case, notation, part, mentions=mentions, at=(start, start + 1))


def bad_string(case, notation):
    texts = ([r'"\x41"', r'"\u12"', r'"\u12g4"', '"a\tb"', '"a\x01b"',
              r'"\U0041"'] if notation == "json"
             else [r'"\n"', r'"a\bc"'])
    text = case.rng.choice(texts)
    part = f'"note": {text}' if notation == "json" else f"(NOTE {text})"
    return replaced(case, notation, part)


def bad_syntax(case, notation):
    """JSON with what belongs to other languages."""
    if notation == "lisp":
        return bad_token(case, notation)
    item = case.good(notation, loose=False)
    case.boxes.pop()
    text = case.rng.choice([item.text[:-1] + ",}", item.text.replace('"u":', "u:", 1),
                            item.text.replace('"u":', "'u':", 1), item.text.replace('"u":', '"u"',
                                                                                    1),
                            item.text[:-1] + " // comment" + case.eol + "}",
                            item.text[0] + "," + item.text[1:], item.text.replace('"v":', '"v"=',
                                                                                  1)])
    return Item(text, name=any)


def too_deep(case, notation):
    """Nested as deep as allowed, or deeper by one, or by thousands."""
    limit, rng = case.limits["depth"], case.rng
    over = rng.choice([0, 1, 2000])
    if notation == "json":
        opening, closing = rng.choice([("[", "]"), ('{"a":', "}")])
        room = limit - 1 + over
        return replaced(case, notation, f'"note": {opening * room}1{closing * room}',
                        mentions=("deep" if over else "note",))
    box, name, parts = case.fresh(notation)
    text, _ = case.join(parts, notation)
    text = f"(SETQ BOX {chr(39) * (limit - 4 + over)}{text})"
    if over:
        return Item(text, name=any, mentions=("deep",))
    return case.answered(box, name, text)


def long_record(case, notation):
    """A record that is just as long as allowed, or longer by one character or by many."""
    limit, rng = case.limits["record"], case.rng
    box, _, parts = case.fresh(notation)
    parts = [part for part in parts if "name" not in part.lower()]
    text, _ = case.join(parts, notation, loose=False)
    over = rng.choice([0, 0, 1, 1, 2, limit // 2])
    room = limit + over - len(text)
    name = None
    if rng.random() < 0.4:
        before, after = (', "name": "', '"') if notation == "json" else (' (NAME "', '")')
        name = "é" * (room - len(before + after))
        text = text[:-1] + before + name + after + text[-1]
    else:
        filler = rng.choice([" ", "\t", "\n", "\r"] + (["\f", ";"] if notation == "lisp" else []))
        fill = filler * room if filler != ";" else ";" * (room - 1) + "\n"
        text = text[:-1] + (fill if room else "") + text[-1]
    if over:
        return Item(text, name=any, mentions=(str(limit),))
    return case.answered(box, name, text, alone=True)


def unclosed(case, notation):
    """No end: the next line that starts a record ends it."""
    item = case.good(notation, loose=False)
    case.boxes.pop()
    cut = case.rng.choice([item.text[:-1], item.text[:-1] + case.rng.choice(['"', '"never', "'",
                                                                             '{"a', "[["]),
                           item.text[:len(item.text) // 2]])
    if "\n" in cut or cut[0] == "'":
        cut = cut.replace("\n", " ").lstrip("'")
    return Item(cut, name=any, open=True)


def too_many_closed(case, notation):
    """One parenthesis or brace too many."""
    _, _, parts = case.fresh(notation)
    close = "}" if notation == "json" else ")"
    if case.rng.random() < 0.5:
        item = case.good(notation, loose=False)
        return Item(item.text + close * case.rng.choice([1, 1, 2, 1000]), box=item.box,
                    name=item.name, least=0, most=1, either=True)
    parts = [part for part in parts if "name" not in part.lower()]
    parts[case.rng.randrange(len(parts) - 1)] += close
    text, _ = case.join(parts, notation, loose=False)
    return Item(text, name=any)


def thousands(case, notation):
    """Delimiters by the thousand in one place of a box."""
    delimiter = case.rng.choice(["(", ")", "'", '"', "()", "'()", "[", "]", "{", "}", "[]", "{}",
                                 ",", ":", ";",
                                 "\\", "1 ", "x ", '"" ', "''", "#", "((", "))"])
    count = case.rng.choice([1000, 5000, case.limits["record"] // len(delimiter) + 1])
    _, _, parts = case.fresh(notation)
    parts = [part for part in parts if "\n" not in part]
    parts.insert(case.rng.randrange(len(parts)),
                 ('"a": ' if notation == "json" else "") + delimiter * count)
    text, _ = case.join(parts, notation, loose=False)
    return Item(text, wild=True, least=1, most=6 if notation == "lisp" else 10 ** 6)


def loose_text(case, notation):
    """A line that is no box."""
    rng = case.rng
    text = rng.choice(["word and another", "12", '"a string"', "2026-11-25 INFO started",
                       "\x00\x01", "\udcff\udcfe",
                       "é", "NaN", "\x1b[2J", "null", "\u00a0"]
                      + ([")", ")" * 5000, "x " * 5000,
                          "'"] if notation == "lisp" else ["}", "}" * 5000, "]", ","]))
    closers = text.strip(")}") == ""    # they may be the end of what stands before
    return Item(text, name=any, least=0 if closers else 1, open=text == "'")


def mutated(case, notation):
    """A box with octets changed, lost and added at random."""
    rng = case.rng
    data = bytearray(octets(case.good(notation).text))
    case.boxes.pop()
    for _ in range(rng.choice([1, 1, 2, 5, 30])):
        place = rng.randrange(len(data) + 1)
        change = rng.choice([b"(", b")", b"'", b'"', b"\\", b";", b"{", b"}", b"[", b"]", b",",
                             b":", b"\n", b"\x00",
                             b"\xff", b"\xe2\x82", b"\xc2\x9b", b"#|", b"\r", b" ", b"-", b"e9",
                             bytes([rng.randrange(256)])])
        chosen = rng.randrange(4)
        if chosen == 0:
            data[place:place] = change
        elif chosen == 1:
            data[place:place + len(change)] = change
        elif chosen == 2:
            del data[place:place + rng.choice([1, 1, 2, 10])]
        else:
            end = rng.randrange(len(data) + 1)
            data[place:place] = data[min(place, end):max(place, end)][:300]
    return Item(bytes(data).decode("utf-8", "surrogateescape"), wild=True, least=0, most=10 ** 6)


CLOSED = [unknown_key, duplicate, missing, bad_value, bad_faces, bad_token, bad_character,
          bad_string, too_deep]
SPOILS = CLOSED * 2 + [bad_syntax, unclosed, unclosed, too_many_closed, loose_text, loose_text,
                       mutated, mutated,
                       mutated, mutated]
LARGE = [many_keys, long_record, long_record, thousands]


# ---------------------------------------------------------------- input

class Stream:
    """The text of one file, or of standard input, and its items in order."""

    def __init__(self, case, notation):
        self.case, self.notation = case, notation
        self.parts, self.items, self.line, self.column = [], [], 1, 1

    def text(self, text):
        self.parts.append(text)
        lines = text.count("\n")
        self.line += lines
        self.column = (len(seen(text)) - seen(text).rfind("\n") if lines
                       else self.column + len(seen(text)))

    def add(self, item):
        item.line, item.column = self.line, self.column
        self.text(item.text)
        item.last = self.line
        self.items.append(item)

    def data(self):
        return octets("".join(self.parts))

    def new_line(self):
        """Go to the beginning of a line, perhaps with what is passed over there."""
        rng, eol = self.case.rng, self.case.eol
        self.text(eol)
        if rng.random() < 0.1:
            self.text(rng.choice([eol, " \t" + eol] + (["; comment ((" + eol, ";" + eol, "\f" + eol]
                                                       if self.notation == "lisp" else [])))
        if rng.random() < 0.03:
            self.text("\ufeff")
            self.column = 1

    def fill(self, count, spoiled, large):
        """Add COUNT items, SPOILED (0 to 1) of them spoiled, at most LARGE large ones."""
        rng, case = self.case.rng, self.case
        wild = spoiled > 0
        for i in range(count):
            before = self.items[-1] if self.items else None
            if before and large and rng.random() < 0.1:
                large -= 1
                item = rng.choice(LARGE)(case, self.notation)
            elif before and rng.random() < spoiled:
                item = rng.choice(SPOILS)(case, self.notation)
            else:
                item = case.good(self.notation)
            if before is None:
                self.text(rng.choice(["", "", "\ufeff", case.eol * 2]))
                self.column = 1
            elif item.alone or before.alone or wild or rng.random() < 0.7:
                self.new_line()
            else:
                self.text(" ")
            if before and self.notation == "json" and self.column == 1 and rng.random() < 0.05:
                self.text("\x1e")
                self.column = 1
            self.add(guarded(item, before, self.notation))
        if rng.random() < 0.8 or self.items[-1].wild:
            self.text(case.eol)


def guarded(item, before, notation):
    """ITEM.  After what may be open still, a record must begin so that it ends what is open."""
    starts = item.text.startswith("{") if notation == "json" else re.match(r"\(\(|\(SETQ",
                                                                           item.text, re.I)
    if before is not None and before.open and not starts:
        for one in (before, item):
            one.wild, one.open, one.alone, one.least, one.most = True, True, True, 0, 10 ** 6
    return item


# ---------------------------------------------------------------- processes

class Result:
    def __init__(self, status, out, err, cpu):
        self.status, self.out, self.err, self.cpu = status, out, err, cpu


def channel(kind):
    """Two descriptors: to read from and to write to."""
    if kind == "socket":
        one, other = socket.socketpair()
        return one.detach(), other.detach()
    return os.pipe()


def feed(descriptor, pieces, hold):
    """Write PIECES, pairs of octets and a pause after them; then wait for HOLD, if any."""
    try:
        for data, pause in pieces:
            view = memoryview(data)
            while view:
                view = view[os.write(descriptor, view):]
            if pause:
                time.sleep(pause)
        if hold is not None:
            hold.wait(120)
    except OSError:
        pass                            # the program has ended
    finally:
        os.close(descriptor)


def read_all(descriptor, process, take, slow, deadline):
    """What comes from DESCRIPTOR to its end, at most some TAKE octets; None after the deadline."""
    out = []
    while take is None or sum(map(len, out)) < take:
        if not select.select([descriptor], [], [], max(0, deadline - time.monotonic()))[0]:
            process.kill()
            return None
        if slow and len(out) < 30:
            time.sleep(slow)
        data = os.read(descriptor, 3000 if slow else 65536)
        if not data:
            break
        out.append(data)
    return b"".join(out)


def run(command, pieces=None, kind="pipe", hold=False, take=None, slow=0, signals=(), output=None,
        limit=90):
    """Run COMMAND with PIECES as its standard input, and return its Result.  SIGNALS are pairs of
    seconds and a number.  KIND: pipe, nonblocking or socket.  OUTPUT: a file to write to."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    their_in, our_out = channel(kind) if pieces is not None else (os.open(os.devnull, os.O_RDONLY),
                                                                  None)
    our_in, their_out = channel(kind)
    if kind != "pipe":
        os.set_blocking(their_in, False)
        os.set_blocking(their_out, False)
    done = threading.Event() if hold else None
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdin=their_in, stdout=output or their_out,
                                   stderr=errors)
        os.close(their_in)
        os.close(their_out)
        threads = [threading.Thread(target=send, args=(process, signals))] if signals else []
        if our_out is not None:
            threads.append(threading.Thread(target=feed, args=(our_out, pieces, done)))
        for thread in threads:
            thread.start()
        out = read_all(our_in, process, take, slow, time.monotonic() + limit)
        os.close(our_in)
        try:
            status = process.wait(None if out is None else limit)
        except subprocess.TimeoutExpired:
            out = None
            process.kill()
            process.wait()
        if done:
            done.set()
        for thread in threads:
            thread.join()
        errors.seek(0)
        err = errors.read()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Result("hangs" if out is None else status, out or b"", err, cpu)


def send(process, signals):
    for delay, number in signals:
        time.sleep(delay)
        process.send_signal(number)


def in_pieces(rng, data):
    """DATA cut at random, with pauses; in the middle of characters, too."""
    pieces, place, pauses = [], 0, 15
    while place < len(data):
        count = rng.choice([1, 2, 3, 7, 100, 4096, 65535, 65536, 65537])
        pause = rng.choice([0, 0, 0, 0.001, 0.003]) if pauses and count > 2 else 0
        pauses -= pause > 0
        pieces.append((data[place:place + count], pause))
        place += count
        if len(pieces) > 300:
            pieces.append((data[place:], 0))
            break
    return pieces


# ---------------------------------------------------------------- output

def pairs(members):
    keys = [key for key, _ in members]
    if len(set(keys)) < len(keys):
        raise ValueError("a key twice")
    return dict(members)


def no_constant(text):
    raise ValueError(text)


def json_record(line):
    return json.loads(line, object_pairs_hook=pairs, parse_constant=no_constant)


LISP_TOKEN = re.compile(r'\s*(?:(\()|(\))|"((?:[^"\\]|\\.)*)"|([^\s()"]+))', re.S)


def lisp_record(line):
    """The record in LINE, a plist, as JSON would have it."""
    stack, place = [[]], 0
    line = line.rstrip()
    while place < len(line):
        match = LISP_TOKEN.match(line, place)
        if not match:
            raise ValueError("not Lisp: " + line[place:place + 40])
        place = match.end()
        if match[1]:
            stack.append([])
        elif match[2]:
            done = stack.pop()
            stack[-1].append(plist(done) if done and isinstance(done[0], Key) else done)
        elif match[3] is not None:
            stack[-1].append(re.sub(r"\\(.)", r"\1", match[3], flags=re.S))
        elif match[4] == "NIL":
            stack[-1].append(None)
        elif match[4][0] == ":":
            stack[-1].append(Key(match[4][1:].lower().replace("-", "_")))
        else:
            stack[-1].append(float(match[4].replace("d", "e")) if re.search("[.d]", match[4]) else
                             int(match[4]))
    if len(stack) != 1 or len(stack[0]) != 1 or not isinstance(stack[0][0], dict):
        raise ValueError("not one record")
    return stack[0][0]


class Key(str):
    pass


def plist(items):
    return pairs(list(zip(items[0::2], items[1::2])))


def traces(text):
    """The records that the paper's lines in TEXT tell of."""
    blocks = text.split("--END--\n")
    if blocks.pop():
        raise Failure("the trace does not end with --END--")
    for block in blocks:
        best = re.search(r"^\(BEST GRASP IS (\S+) WITH MATCHING \(([^()]*)\)\)$", block, re.M)
        bad = re.search(r"^\(BAD BOX: (?:.*?\bline (\d+))?", block, re.M)
        yield {"status": "error" if bad else "grasp" if best else "cant",
               "line": int(bad[1]) if bad and bad[1] else None,
               "grasp": best and best[1], "matching": best and best[2].split()}


def records_of(out, form):
    """The records in OUT, which must hold nothing else."""
    try:
        text = out.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Failure(f"standard output is not UTF-8: {error}")
    raw = RAW.search(text)
    if raw:
        raise Failure(f"a raw control character {ord(raw[0]):#x} on standard output")
    if form == "trace":
        return list(traces(text))
    lines = text.split("\n")
    if lines.pop():
        raise Failure("standard output ends within a line")
    records = []
    for line in lines:
        try:
            records.append((json_record if form == "json" else lisp_record)(line))
        except (ValueError, IndexError) as error:
            raise Failure(f"not a record: {line[:100]!r}: {error}")
        check_record(records[-1])
    return records


def check_record(record):
    """What holds for every record."""
    if list(record)[:len(KEYS)] != KEYS:
        raise Failure(f"keys {list(record)}")
    status, problems = record["status"], record.get("problems")
    if status == "grasp":
        good = (sorted(record["matching"]) == FACES and record["contacts"] and record["quality"] >=
                0
                and 1 <= record["possible"] <= record["tried"] and record["reason"] is None)
    else:
        good = record["grasp"] is None and record["reason"] and len(record["reason"]) < 30000
    if status == "error":
        good = good and 1 <= len(problems) <= 25 and all(
            problem["line"] >= 1 and problem["column"] >= 1 and problem["text"] for problem in
                                                         problems)
    if not good or status not in ("grasp", "cant", "error"):
        raise Failure(f"a record that contradicts itself: {str(record)[:300]}")


def comparable(record):
    return {key: part for key, part in record.items() if key not in ("name", "line")}


class Match:
    """Compares RECORDS, which came in FORM, with the items of streams, in order."""

    def __init__(self, records, form, answers):
        self.records, self.form, self.answers, self.place, self.late = records, form, answers, 0, []
        self.checked = 0

    def peek(self):
        return self.records[self.place] if self.place < len(self.records) else None

    def stream(self, items):
        self.late = []
        for item in items:
            self.skip_late()
            if item.wild:
                self.late.append(item)
                self.errors(item)
            elif item.box is None:
                self.errors(item)
            elif item.either and not self.is_answer(item):
                self.errors(item, least=1)
            else:
                self.answer(item)
                if item.either:
                    self.errors(item)
        self.skip_late()

    def end(self):
        if self.peek() is not None:
            raise Failure(f"a record too many: {str(self.peek())[:200]}")

    def skip_late(self):
        """Pass over errors of what an item left open, which come with its end."""
        while self.late and self.peek() and self.peek()["status"] == "error" and any(
                item.line <= self.peek()["line"] <= item.last for item in self.late):
            self.place += 1

    def is_answer(self, item):
        record = self.peek()
        return record is not None and record["status"] != "error"

    def answer(self, item):
        record = self.peek()
        if record is None:
            raise Failure(f"no record for the box of line {item.line}")
        expected = self.answers[item.box]
        if self.form == "trace":
            good = all(record[key] == expected[key] for key in ("status", "grasp", "matching"))
        else:
            good = (comparable(record) == comparable(expected) and record["line"] == item.line
                    and self.same_name(record["name"], item.name))
        if not good:
            raise Failure(f"the box of line {item.line}, {item.name!r:.60}, is answered by "
                          f"{str(record)[:300]}, not {str(expected)[:200]}")
        self.place += 1
        self.checked += 1

    def same_name(self, name, expected):
        """As Lisp, something may stand for what shows nothing: there are no escapes."""
        expected = expected and seen(expected)
        return name == expected or bool(self.form == "sexp" and expected and name
                                        and not expected.isprintable())

    def errors(self, item, least=None):
        count = 0
        while count < item.most:
            record = self.peek()
            if record is None or not (record["status"] == "error" or item.wild):
                break
            if record["line"] is not None and not item.line <= record["line"] <= item.last:
                break
            count += 1
            self.place += 1
            if record["status"] == "error" and self.form != "trace" and not item.wild:
                self.error(item, record)
        if count < (item.least if least is None else least):
            raise Failure(f"line {item.line} to {item.last}: {count} error records, not "
                          f"{item.least}; then {str(self.peek())[:200]}; it is {item.text[:200]!r}")
        self.checked += 1

    def error(self, item, record):
        reason = record["reason"]
        for word in item.mentions:
            if word.lower() not in reason.lower():
                raise Failure(f"line {item.line}: the reason lacks {word!r}: {reason[:200]}")
        if item.name is not any and record["name"] not in (None, item.name and
                                                           seen(item.name)) and \
                self.form == "json":
            raise Failure(f"line {item.line}: an error record is named {record['name']!r:.80}")
        places = [(problem["line"], problem["column"]) for problem in record["problems"]]
        if any(not item.line <= line <= item.last for line, _ in places):
            raise Failure(f"line {item.line} to {item.last}: a problem elsewhere: {reason[:200]}")
        if item.mark:
            start, end = map(item.place, item.mark)
            if not any(start <= place < end for place in places):
                raise Failure(f"line {item.line}: the mistake is from {start} to {end}, not "
                              f"{places[:3]}: {reason[:300]}")


# ---------------------------------------------------------------- cases

class Soak:
    def __init__(self, options, directory):
        self.program, self.seed, self.kind, self.keep = (options.program, options.seed,
                                                         options.kind,
                                                         options.keep)
        self.directory = Path(directory)
        self.start = 0.0

    def replay(self, number):
        """The command that runs the case of NUMBER again."""
        kind = f" --kind {self.kind}" if self.kind else ""
        kept = f"  # {shlex.join(self.last)}" if self.keep else ""
        return (f"python3 t/soak.py --seed {self.seed} --case {number}{kind} "
                f"--program {shlex.quote(self.program)}{kept}")

    def command(self, arguments, heap=None):
        program = ["sbcl"] if self.program.endswith(".lisp") else [self.program]
        if heap:
            program += ["--dynamic-space-size", heap]
        if self.program.endswith(".lisp"):
            program += ["--script", self.program]
        self.last = program + [str(argument) for argument in arguments]
        return self.last

    def write(self, name, data):
        path = self.directory / name
        path.write_bytes(data)
        return path

    def answers(self, case, options=()):
        """The records of the boxes of CASE, each alone on a line, in a run of their own."""
        if not case.boxes:
            return []
        path = self.write("clean", "".join(map(clean, case.boxes)).encode())
        result = run(self.command([*options, "--input", "sexp", "--format", "json", path]))
        records = records_of(result.out, "json")
        if result.status != 0 or len(records) != len(case.boxes) or result.err:
            raise Failure(f"the clean boxes: status {result.status}, {len(records)} of "
                          f"{len(case.boxes)} records, {result.err[:200]}")
        return records

    def check_end(self, result, statuses, silent=False, cost=None):
        if result.status not in statuses:
            raise Failure(f"status {result.status}, not {' or '.join(map(str, statuses))}: "
                          f"{result.err[-300:]!r}")
        text = result.err.decode("utf-8", "replace")
        if CRASH.search(text) or RAW.search(text):
            raise Failure(f"on standard error: {text[:300]!r}")
        if silent and text:
            raise Failure(f"standard error should be empty: {text[:300]!r}")
        if cost is not None and result.cpu > self.start + cost:
            raise Failure(f"{result.cpu:.1f} s of the processor; {self.start + cost:.1f} would do")


ODD_NAMES = ["a[1]", "b*", "c?.x", "d\\e", "f g", "--h", "i'j\"", "é軸", "k;l", "~", "#m#",
             "n.fasl", "-", ".hid", "%a~a", "p{q}", "r:s", "{", "*.*", "e\u0301"]


def odd_path(soak, rng, name, data):
    """A file of an odd name that holds DATA, in a directory of an odd name."""
    directory = soak.directory / rng.choice([name for name in ODD_NAMES if name != "-"])
    directory.mkdir(exist_ok=True)
    path = directory / (rng.choice(ODD_NAMES) + name)
    path.write_bytes(data)
    return path


def mixed(soak, rng):
    """Whole and spoiled boxes, in all notations, formats and ways."""
    case = Case(rng, soak)
    case.choose_limits()
    if rng.random() < 0.2:
        case.options += ["--gamma", rng.choice(["0", "1", "0.25", "1/3"])]
    count = rng.choice([1, 3, 10, 30, 100, 100, 300, 1000])
    spoiled, large = rng.choice([0, 0.1, 0.3, 0.6]), rng.choice([0, 0, 1, 3])
    form, way = rng.choice(["json", "json", "sexp", "trace"]), rng.choice(WAYS)
    files = rng.choice([1, 2, 3]) if way == "file" else 1
    forced = rng.choice([None, None, "lisp", "json"])
    streams = [Stream(case, forced or rng.choice(["lisp", "json"])) for _ in range(files)]
    for stream in streams:
        stream.fill(max(1, count // files),
                    0 if form == "trace" and rng.random() < 0.5 else spoiled, large)
    if any(item.wild or item.either for stream in streams for item in
           stream.items) and form == "trace":
        form = "json"
    options = case.options + (["--input", "json" if forced == "json" else "sexp"] if forced else [])
    if form != ("json" if streams[0].notation == "json" else "sexp") or rng.random() < 0.5:
        options += ["--format", form]
    send_and_compare(soak, rng, case, streams, options, form, way)
    return case.count


WAYS = ["file", "file", "pipe", "pieces", "nonblocking", "socket"]


def send_and_compare(soak, rng, case, streams, options, form, way, heap=None):
    if heap is None and rng.random() < 0.2:
        heap = rng.choice(["64MB", "128MB"])
    data = [stream.data() for stream in streams]
    total = sum(map(len, data))
    if way == "file":
        paths = [odd_path(soak, rng, str(count), one) for count, one in enumerate(data)]
        result = run(soak.command([*options, "--", *paths], heap))
    else:
        soak.write("input", data[0])
        pieces = [(data[0], 0)] if way == "pipe" else in_pieces(rng, data[0])
        slow = 0.0005 if way in ("nonblocking", "socket") else 0
        result = run(soak.command([*options, *rng.choice([[], ["-"]])], heap), pieces,
                     kind=way if slow else "pipe", slow=slow)
    sent = soak.last
    soak.check_end(result, [0, 65])
    answers = soak.answers(case, case.options)
    soak.last = sent
    records = records_of(result.out, form)
    match = Match(records, form, answers)
    for stream in streams:
        match.stream(stream.items)
    match.end()
    bad = any(record["status"] == "error" for record in records)
    soak.check_end(result, [65 if bad else 0], silent=not bad,
                   cost=1 + total * 6e-6 + len(records) * 1e-3)


def boundary(soak, rng):
    """Sequences of UTF-8, whole and broken, across the ends of the program's buffers."""
    case = Case(rng, soak)
    notation = rng.choice(["lisp", "json"])
    stream = Stream(case, notation)
    stream.add(case.good(notation, loose=False))
    for buffers in range(1, rng.choice([2, 3, 5])):
        special = rng.choice(["é", "軸", "𝔊", "\ufeff", "\udcc3", "\udce2\udc82",
                              "\udcf0\udc9f\udca4", "\udcff",
                              "\udce2(", "\udced\udca0\udc80", "\r\n", '\\"', "\\\\"])
        box, _, parts = case.fresh(notation)
        parts = [part for part in parts if "name" not in part.lower()]
        if notation == "json" and special == "\r\n":
            special = "é"
        quoted = special if special[0] == "\\" else None
        name = (f'"name": "{special * 3}"' if notation == "json" else f'(NAME "{special * 3}")')
        text, places = case.join([name] + parts, notation, loose=False)
        stream.new_line()
        place = buffers * 65536 + rng.randint(-6, 3)
        room = place - len(stream.data()) - places[0] - name.index(special)
        filler = rng.choice([" ", case.eol, ";" if notation == "lisp" else "\t"])
        stream.text(filler * ((room - 2) // len(filler)) + "\n" * ((room - 2) % len(filler)) +
                    "\r\n")
        stream.column = 1
        stream.add(case.answered(box, (quoted[1] if quoted else special) * 3, text))
    stream.text(case.eol)
    send_and_compare(soak, rng, case, [stream], ["--format", "json"], "json", rng.choice(WAYS))
    return case.count


def array(soak, rng):
    """One JSON array of objects."""
    case = Case(rng, soak)
    stream = Stream(case, "json")
    stream.text(rng.choice(["", "\ufeff"]) + "[")
    stream.column = 2
    for count in range(rng.choice([0, 1, 20, 200])):
        if count:
            stream.text(rng.choice([",", ", ", "," + case.eol, case.eol + ", "]))
        item = case.good("json") if rng.random() < 0.7 else rng.choice(CLOSED)(case, "json")
        stream.add(item)
    stream.text(rng.choice(["]", case.eol + "]"]) + case.eol)
    send_and_compare(soak, rng, case, [stream], ["--format", "json"], "json", rng.choice(WAYS))
    return case.count


FLOODS = ["()", "'()", "(", ")", "'", "((", "[", "[]", "{", "{}", "]", "}", ",", ":", '"', '""',
          ";", "1", "x",
          "1 ", "x ", "\\", " ", "\t", "\x00", "\udcff", "\u00a0", "é", "(A)", '{"a":1},', '"a",',
          "'() "]


def flood(soak, rng):
    """Megabytes of one delimiter in one record, in a small heap, cost that record only."""
    case = Case(rng, soak)
    notation = rng.choice(["lisp", "json"])
    starts = ['{"a": [', '{"a": "', '{"a": ', ""] if notation == "json" else [
        "((NAME ", "((NAME '", "((SIZE 1 2 3)", "((", '((NAME "', ""]
    stream = Stream(case, notation)
    stream.add(case.good(notation, loose=False))
    for _ in range(4):
        start, delimiter = rng.choice(starts), rng.choice(FLOODS)
        count = rng.choice([70000, 300000, 2500000]) // len(delimiter)
        stream.text(case.eol)
        stream.add(Item(start + delimiter * count, wild=True, least=1 if start else 0, most=12))
        for _ in range(3):
            good = case.good(notation, loose=False)
            if good.text[0] != "'":
                stream.text(case.eol)
                stream.add(good)
    stream.text(case.eol)
    send_and_compare(soak, rng, case, [stream], ["--format", "json", "--input",
                                                 "sexp" if notation == "lisp"
                                                 else "json"], "json", rng.choice(["file", "pipe"]),
                     heap="64MB")
    return case.count


def first_line(soak, rng):
    """A line of a log, or a comment, before the boxes costs itself only."""
    case = Case(rng, soak)
    notation = rng.choice(["lisp", "json"])
    stream = Stream(case, notation)
    line = rng.choice(["2026-11-25 12:00:00 INFO started", "# boxes", "// boxes", "INFO: ready",
                       "warning: x",
                       "boxes", "\x1b[32mok\x1b[0m", "; boxes", "-- boxes --"])
    stream.add(Item(line, name=any, least=0, most=1, wild=False))
    for _ in range(rng.choice([1, 5, 50])):
        stream.text(case.eol)
        item = case.good(notation, loose=False)
        stream.add(item)
    stream.text(case.eol)
    send_and_compare(soak, rng, case, [stream], ["--format", "json"], "json", rng.choice(WAYS))
    return case.count


def plain(soak, rng, count):
    """COUNT whole boxes, one a line, and their input."""
    case = Case(rng, soak)
    stream = Stream(case, "lisp")
    for _ in range(count):
        stream.add(case.answered(make_box(rng, False), None, ""))
        stream.items[-1].text = clean(case.boxes[-1])
        stream.text(stream.items[-1].text)
    return case, stream


def compare_prefix(case, stream, records, answers):
    """RECORDS are those of the first boxes of STREAM."""
    if len(records) > len(stream.items):
        raise Failure(f"{len(records)} records of {len(stream.items)} boxes")
    match = Match(records, "json", answers)
    match.stream(stream.items[:len(records)])
    match.end()


def signals(soak, rng):
    """SIGTERM and SIGINT at any moment: 143 and 130, and whole records of the first boxes."""
    case, stream = plain(soak, rng, rng.choice([0, 1, 50, 1500]))
    number = rng.choice([signal.SIGTERM, signal.SIGINT])
    moment = rng.choice([0, rng.uniform(0, 0.004), rng.uniform(0, 0.03), rng.uniform(0, 0.3)])
    if soak.program.endswith(".lisp"):
        moment += soak.start / 2        # until then it is SBCL's own
    arguments, pieces, hold = ["--format", "json"], None, False
    way = rng.choice(["idle", "idle", "pieces", "fifo", "rules", "rules and boxes"])
    if way in ("fifo", "rules"):
        fifo = soak.directory / "fifo"
        if not fifo.exists():
            os.mkfifo(fifo)
        arguments += [fifo] if way == "fifo" else ["--rules", fifo]
    elif way == "rules and boxes":
        path = soak.write("rules", (ROOT / "rules.lisp").read_bytes())
        arguments += ["--rules", path]
    if way not in ("fifo", "rules"):
        pieces = in_pieces(rng, stream.data()) if way == "pieces" else [(stream.data(), 0)]
        hold = True
    result = run(soak.command(arguments), pieces, hold=hold, signals=[(moment, number)], limit=20)
    sent = soak.last
    text = result.err.decode("utf-8", "replace")
    compare_prefix(case, stream, records_of(result.out, "json"), soak.answers(case))
    soak.last = sent
    soak.check_end(result, [-number, 128 + number])
    said = re.search(r"after (\d+) box(?:es)?", text)
    if said and int(said[1]) != result.out.count(b"\n"):
        raise Failure(f"it says {text!r}, and wrote {result.out.count(10)} records")
    return len(case.boxes)


def two_signals(soak, rng):
    """A second signal does not wait, even if nobody reads what is written."""
    case, stream = plain(soak, rng, 1500)
    number = rng.choice([signal.SIGTERM, signal.SIGINT])
    read, write = os.pipe()
    try:
        with os.fdopen(write, "wb") as output:
            result = run(soak.command(["--format", "json"]), [(stream.data(), 0)], hold=True,
                         output=output,
                         signals=[(soak.start + 0.5, number), (0.2, number)], limit=20)
    finally:
        os.close(read)
    soak.check_end(result, [-number, 128 + number])
    return len(case.boxes)


def closed_output(soak, rng):
    """A reader that closes its end ends the run quietly; a full disk is told."""
    case, stream = plain(soak, rng, rng.choice([1, 300, 1500]))
    if rng.random() < 0.3 and os.path.exists("/dev/full"):
        with open("/dev/full", "wb") as output:
            result = run(soak.command([]), [(stream.data(), 0)], output=output)
        soak.check_end(result, [74])
    else:
        result = run(soak.command(["--format", rng.choice(["trace", "json", "sexp"])]),
                     [(stream.data(), 0)],
                     take=rng.choice([0, 1, 1000, 70000, 200000]),
                     kind=rng.choice(["pipe", "nonblocking", "socket"]))
        soak.check_end(result, [0], silent=True)
    return len(case.boxes)


def reports(soak, rng):
    """A report has a page for each box, or says how many it lacks; a signal ends it."""
    case, stream = plain(soak, rng, rng.choice([1, 5, 20]))
    directory = soak.directory / rng.choice([name for name in ODD_NAMES if name not in "-~"])
    boxes = soak.write("boxes", stream.data())
    number = rng.choice([signal.SIGTERM, signal.SIGINT])
    moment = soak.start + rng.uniform(0.02, 0.3)
    stopped = rng.random() < 0.5
    result = run(soak.command(["--format", "json", f"--report={directory}", boxes]),
                 signals=[(moment, number)] if stopped else ())
    if b"cl-who" in result.err:
        return 0                        # built without the pictures
    said = re.search(rb"(\d+) pages? can't be drawn", result.err)
    soak.check_end(result, [74 if said else 0] + ([128 + number] if stopped else []))
    sent = soak.last
    compare_prefix(case, stream, records_of(result.out, "json"), soak.answers(case))
    soak.last = sent
    pages = len(list(directory.glob("*.html"))) if directory.is_dir() else 0
    if result.status in (0, 74) and pages + int(said[1] if said else 0) != len(case.boxes) + 1:
        raise Failure(f"{pages} pages of {len(case.boxes)} boxes and an index in {directory}: "
                      f"{result.err[:200]}")
    return len(case.boxes)


def absent(soak, rng):
    """Files that can't be read: 66, and all others are answered."""
    case, stream = plain(soak, rng, rng.choice([1, 30]))
    good = odd_path(soak, rng, "good", stream.data())
    bad = rng.sample([soak.directory / "none", soak.directory, soak.directory / "good" / "x",
                      "/dev/null/x", soak.directory / "a[1]" / "none*",
                      soak.directory / "none\x9b31m"], rng.choice([1, 2, 3]))
    paths = bad + [good]
    rng.shuffle(paths)
    result = run(soak.command(["--format", "json", "--", *paths]))
    sent = soak.last
    compare_prefix(case, stream, records_of(result.out, "json"), soak.answers(case))
    soak.last = sent
    soak.check_end(result, [66])
    text = result.err.decode("utf-8", "replace")
    if result.out.count(b"\n") != len(case.boxes) or any(
            str(path) not in text for path in bad if str(path).isprintable()):
        raise Failure(f"files that can't be read: {result.out.count(10)} records; it says {text!r}")
    return len(case.boxes)


def usage(soak, rng):
    """A wrong command line: 64, a message, no record."""
    arguments = rng.choice([["--input", "xml"], ["--format"], ["--gamma", "2"], ["--gamma", "x"],
                            ["--gamm", "1"], ["--rules"],
                            ["--record-limit", "0"], ["--depth-limit=1e9"], ["--check=1"],
                            ["--check", "file"], ["-x"],
                            ["--number-limit", "-1"], ["--name-limit", "1.5"], ["--gamma",
                                                                                "((((" * 9999],
                            ["--" + "x" * 9999], ["--\u0085\x1b[2J"], ["--gamma", "\u009b31m"]])
    result = run(soak.command(arguments), [(b"", 0)])
    soak.check_end(result, [64])
    if result.out or not result.err:
        raise Failure(f"a wrong command line: {result.out[:100]} {result.err[:100]}")
    return 0


def utf16(soak, rng):
    """UTF-16 is called so, and costs its own file only."""
    case, stream = plain(soak, rng, rng.choice([1, 30]))
    text = rng.choice(["", "\ufeff", "\ufeff"]) + stream.data().decode()
    mark = text.startswith("\ufeff")
    wide = soak.write("wide", text.encode(rng.choice(["utf-16-le", "utf-16-be"])))
    good = odd_path(soak, rng, "good", stream.data())
    result = run(soak.command(["--format", "json", "--", wide, good]))
    sent = soak.last
    records = records_of(result.out, "json")
    lines = len(case.boxes)
    if len(records) < lines or any(record["status"] != "error" for record in records[:-lines]):
        raise Failure(f"UTF-16: {len(records)} records of twice {lines} boxes")
    compare_prefix(case, stream, records[-lines:], soak.answers(case))
    soak.last = sent
    soak.check_end(result, [65, 66])
    if mark and b"UTF-16" not in result.out + result.err:
        raise Failure("UTF-16 is not called UTF-16")
    return len(case.boxes)


def other_notation(soak, rng):
    """Boxes in the notation that was not asked for are errors."""
    case = Case(rng, soak)
    notation = rng.choice(["lisp", "json"])
    texts = [case.good(notation,
                       loose=False).text.replace("\n", " ").replace("\r", " ") for _ in range(30)]
    data = octets("\n".join(texts) + "\n")
    soak.write("input", data)
    result = run(soak.command(["--format", "json", "--input",
                               "sexp" if notation == "json" else "json"]), [(data, 0)])
    records = records_of(result.out, "json")
    if not records or any(record["status"] != "error" for record in records):
        raise Failure(f"the wrong notation: {len(records)} records")
    soak.check_end(result, [65])
    return case.count


# ---------------------------------------------------------------- rules and grasps

PROBLEM = re.compile(r"(.*?):(\d+)(?::(\d+))?: ")


def check_knowledge(soak, rng, which, data, line=None, statuses=(0, 65), cost=1.0, heap=None):
    """--check with DATA as the file of WHICH, rules or grasps: each problem has file and line."""
    path = odd_path(soak, rng, which, data)
    result = run(soak.command(["--check", f"--{which}", path], heap))
    soak.check_end(result, statuses, cost=cost + len(data) * 1e-5)
    if result.out:
        raise Failure(f"--check writes to standard output: {result.out[:100]}")
    text = result.err.decode("utf-8", "replace")
    if len(text) > 200000 + 5 * len(data):
        raise Failure(f"--check says {len(text)} characters of {len(data)}")
    if result.status != 65:
        return result
    lines = []
    for told in text.splitlines():
        if told.startswith(f"{path}:"):
            match = PROBLEM.match(told[len(str(path)):])
            if not match and "there is no" in told: # what is missing has no line
                continue
            if not match or not 1 <= int(match[2]) <= data.count(b"\n") + 1:
                raise Failure(f"a problem without its line: {told[:200]}")
            lines.append(int(match[2]))
    if not lines and f"{path}: " not in text and "names" not in text: # or the other file names it
        raise Failure(f"no problem begins with {path}:LINE: {text[:300]}")
    if line is not None and line not in lines:
        raise Failure(f"the mistake of line {line} is told of lines {lines[:5]}: {text[:300]}")
    return result


TOKENS = ["#", "1e999", "\x00", "é", "9" * 41, "1/0", "(" * 40, "'" * 40, "\udcff", "\x9b",
          "|a|", ",", "\u00a0", "x" * 65, '"\\n"']
CHANGES = [b"(", b")", b"'", b'"', b";", b"#", b"\x00", b"\xff", b"9", b"S1", b"?", b" ", b""]


def knowledge(soak, rng):
    """Shipped rules and grasps, spoiled in one place or at random."""
    which = rng.choice(["rules", "grasps"])
    lines = (ROOT / f"{which}.lisp").read_text(encoding="utf-8").split("\n")
    kind = rng.choice(["whole", "token", "token", "word", "unclosed", "closed", "cut", "mutated",
                       "mutated"])
    place = spoil_line(rng, lines, which, kind)
    data = octets("\n".join(lines))
    if kind == "cut":
        data = data[:rng.randrange(len(data))]
    elif kind == "mutated":
        data = bytearray(data)
        for _ in range(rng.choice([1, 3, 20, 200])):
            spot = rng.randrange(len(data))
            data[spot:spot + rng.choice([0, 1, 1, 5])] = rng.choice(
                CHANGES + [bytes([rng.randrange(256)])])
    statuses = (0,) if kind == "whole" else (0, 65) if kind in ("cut", "mutated") else (65,)
    check_knowledge(soak, rng, which, bytes(data),
                    place + 1 if kind in ("token", "word") else None, statuses)
    return 0


def spoil_line(rng, lines, which, kind):
    """Spoil one of LINES as KIND says, and return its place."""
    old = {"word": r"\(TRY PINCH" if which == "rules" else r"\((POSIT|SQRT|MIN|MAX)\b",
           "unclosed": r"\)\)$", "closed": r"\)$"}.get(kind, "")
    place = rng.choice([place for place, line in enumerate(lines)
                        if re.match(" +[^ ;]", line) and re.search(old, line)])
    if kind == "whole":
        lines[place] += rng.choice(["", "\r", " ;\x1b"])
    elif kind == "token":
        lines[place] = rng.choice(TOKENS) + " " + lines[place]
    elif kind == "word":
        lines[place] = re.sub(old, "(TRY PUNCH" if which == "rules" else "(FROB", lines[place], 1)
    elif kind == "unclosed":
        lines[place] = lines[place][:-1]
    elif kind == "closed":
        lines[place] += ")" * rng.choice([1, 2, 70000])
    return place


GROWING = {
    "rules": [lambda n: "".join(f"(RULE R{i} (IF (A{i})) (THEN (REMEMBER B{i})))" for i in
                                range(n)),
              lambda n: "".join(f"(RULE R{i} (IFF (A{i})) (THENN))" for i in range(n)),
              lambda n: "".join(f"(RULE R (IF (A (s1 s{i}))) (THEN (TRY G{i})))" for i in range(n)),
              lambda n: "(RULE R (IF " + "(A)" * n + ") (THEN (KEEP BEST)))",
              lambda n: "(RULE R (IF " + "".join(f"(A{i} (s1))" for i in range(n)) +
              ") (THEN (KEEP BEST)))",
              lambda n: "(RULE R (IF " + "".join(f"(CORNER (s{i} X1))" for i in range(n // 2)) +
              ") (THEN (KEEP BEST)))",
              lambda n: "(RULE R (IF (A)) (THEN " + "".join(f"(REMEMBER B{i})" for i in
                                                            range(n // 2)) + "))",
              lambda n: "(RULE R (IF (" + "WORD " * n + ")) (THEN (KEEP BEST)))",
              lambda n: "x " * n, lambda n: "x\n" * n, lambda n: ")" * n, lambda n: "(" * n,
              lambda n: "()" * n, lambda n: "'" * n,
              lambda n: '"" ' * n, lambda n: ";" * n, lambda n: "#" * n, lambda n: "((A) " * n,
              lambda n: "(RULE\n" * n],
    "grasps": [lambda n: "".join(f"(DEFUN F{i} (x) (+ x {i}))" for i in range(n)),
               lambda n: "".join(f"(DEFUN F{i} (x) (F{i + 1} x))" for i in range(n)),
               lambda n: "(SETQ GRIPPER '(" + "".join(f"D{i} {i + 1} " for i in range(n)) + "))",
               lambda n: "".join(f"(SETQ G{i} '(USED-SURFACES (N1)))" for i in range(n)),
               lambda n: "(DEFUN F (x) (+ " + "x " * n + "))",
               lambda n: "(DEFUN F (x) (+ " + "".join(f"(FROB{i} y{i})" for i in range(n // 2)) +
               "))",
               lambda n: "(SETQ G '(USED-SURFACES (" + "N1 " * n + ")))",
               lambda n: "(SETQ G '(" + "".join(f"KEY{i} {i} " for i in range(n // 2)) + "))",
               lambda n: "(SETQ G '(USED-SURFACES (N1 N2 A2) CONDITIONS (" + "(u > 1) AND " *
               (n // 2) + "(u > 1))))"]}


def growth(soak, rng):
    """Knowledge four times as large takes about four times as long, in a small heap."""
    which = rng.choice(["rules", "grasps"])
    number = rng.randrange(len(GROWING[which]))
    small = rng.choice([500, 1000, 1500])
    cpu = []
    for count in (small, 4 * small):
        data = GROWING[which][number](count)
        result = check_knowledge(soak, rng, which, data.encode(), statuses=(0, 65),
                                 cost=2 + count * 5e-4,
                                 heap=rng.choice([None, "64MB", "256MB"]))
        cpu.append(max(0, result.cpu - soak.start))
    if cpu[1] > 8 * cpu[0] + 0.4:
        raise Failure(f"{which} {number}: {small} take {cpu[0]:.2f} s, "
                      f"four times as many {cpu[1]:.2f}")
    return 0


KINDS = [(mixed, 30), (boundary, 3), (array, 3), (flood, 3), (first_line, 2), (signals, 6),
         (two_signals, 1), (closed_output, 2), (reports, 1), (absent, 2), (usage, 1), (utf16, 1),
         (other_notation, 1), (knowledge, 5), (growth, 3)]


def kind_of(number, rng):
    """Each kind comes once at first, then as often as its weight says."""
    if number < len(KINDS):
        return KINDS[number][0]
    return rng.choices([kind for kind, _ in KINDS], [weight for _, weight in KINDS])[0]


# ---------------------------------------------------------------- the run

def one_case(soak, number):
    """Run the case of NUMBER; return how many records it sent, and None or what failed."""
    rng = random.Random(f"{soak.seed}:{number}")
    kind = kind_of(number, rng)
    if soak.kind:
        kind = globals()[soak.kind]
    with tempfile.TemporaryDirectory(dir=soak.keep and Path(soak.keep),
                                     prefix=f"case-{number}-") as directory:
        soak.directory, soak.last = Path(directory), []
        try:
            return kind.__name__, kind(soak, rng), None
        except Failure as failure:
            return kind.__name__, 0, failure
        finally:
            if soak.keep:
                os.rename(directory, directory + "-kept")
                os.mkdir(directory)


def build(directory):
    program = os.path.join(directory, "supergrip")
    subprocess.run(["sbcl", "--script", str(ROOT / "src" / "build.lisp"), program], check=True,
                   stdout=subprocess.DEVNULL)
    return program


def show_progress(text):
    print(f"\r{text}\033[K", end="", file=sys.stderr, flush=True)


def soak_all(soak, options):
    """Run cases until they sent as many records as asked for; return how many checks passed and
    failed.  Where only one kind is wanted, which may send none, a case counts as 20 at least."""
    passed = failed = records = count = effort = 0
    start = shown = time.monotonic()
    terminal = sys.stderr.isatty()
    while effort < options.records or count < len(KINDS):
        number = count if options.case is None else options.case
        kind, sent, failure = one_case(soak, number)
        records, count = records + sent, count + 1
        effort += max(sent, 20) if soak.kind else sent
        passed += sent + (failure is None)
        if failure:
            failed += 1
            text = f"FAILED case {number}, {kind}: {str(failure):.1000}; {soak.replay(number)}"
            print(text.replace("\n", "\\n"), flush=True)
        if options.case is not None:
            break
        if terminal and time.monotonic() - start > 2 and time.monotonic() - shown > 0.5:
            shown = time.monotonic()
            show_progress(f"{count} cases, {records} records, {failed} failed")
    if terminal:
        show_progress("")
    return passed, failed


def main():
    parser = argparse.ArgumentParser(description="Drive the batch program with hostile input.")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--records", type=int, default=3000)
    parser.add_argument("--program", help="the executable, or examples/batch.lisp")
    parser.add_argument("--case", type=int, help="this case only")
    parser.add_argument("--kind", choices=[kind.__name__ for kind, _ in KINDS],
                        help="cases of this kind only")
    parser.add_argument("--keep", help="a directory for the input of each case")
    options = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler) # what a child gets is not "ignored"
    with tempfile.TemporaryDirectory() as directory:
        options.program = (str(Path(options.program).resolve()) if options.program
                           else build(directory))
        soak = Soak(options, directory)
        soak.start = max(run(soak.command(["--version"])).cpu for _ in range(2))
        passed, failed = soak_all(soak, options)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
