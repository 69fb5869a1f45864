"""draw-check.py DIRECTORY: parse all pictures and pages in it, strictly.

Complains of what is not well-formed, of a number that is none, of anything outside the viewBox, of
repeated ids and of links to nowhere.  Prints one list a file that Lisp can read: its name, the list
of complaints, and for each view (azimuth elevation scale x y ((finger x y) ...)).
"""

import re
import sys
import xml.etree.ElementTree as tree
from pathlib import Path

NUMBER = re.compile(r"-?\d+(?:\.\d+)?$")
VIEW = re.compile(r"azimuth (-?\d+)°, elevation (-?\d+)°, (..) above; ([\d.]+) units a cm; "
                  r"box centre at \((-?[\d.]+), (-?[\d.]+)\)")
COORDINATES = {"line": (("x1", "y1"), ("x2", "y2")), "circle": (("cx", "cy"),),
               "rect": (("x", "y"),), "text": (("x", "y"),)}


def local(element):
    return element.tag.split("}")[-1]


def points(element):
    """The coordinates of an element, as texts."""
    name = local(element)
    if name in ("polygon", "polyline"):
        return [tuple(pair.split(",")) for pair in element.get("points").split()]
    return [(element.get(x, "0"), element.get(y, "0")) for x, y in COORDINATES.get(name, ())]


def check_picture(svg, complaints):
    """Return the views of a picture."""
    if svg.get("viewBox") is None:
        return []
    _, _, width, height = map(float, svg.get("viewBox").split())
    children = [local(child) for child in svg[:2]]
    if children != ["title", "desc"]:
        complaints.append("no title and desc first")
    views = []
    for element in svg.iter():
        if local(element) == "pattern":
            continue
        for x, y in points(element):
            if not NUMBER.match(x) or not NUMBER.match(y):
                complaints.append(f"{local(element)} at {x},{y}")
            elif not (-0.5 <= float(x) <= width + 0.5 and -0.5 <= float(y) <= height + 0.5):
                complaints.append(f"{local(element)} at {x},{y} is outside")
        if element.get("class") == "view":
            views.append(view(element, complaints))
    return views


def view(group, complaints):
    match = VIEW.search(group[0].text)
    if match is None:
        complaints.append("a view without its place")
        return "()"
    azimuth, elevation, top, scale, x, y = match.groups()
    contacts = []
    for circle in group.iter():
        if local(circle) == "circle" and len(circle) and circle[0].text.startswith("Finger"):
            finger = circle[0].text.split()[1].removeprefix("F")
            contacts.append(f"({finger} {circle.get('cx')}d0 {circle.get('cy')}d0)")
    return (f'({azimuth} {elevation} "{top}" {scale}d0 {x}d0 {y}d0 ({" ".join(contacts)}))')


def check_ids(root, complaints):
    ids = [element.get("id") for element in root.iter() if element.get("id")]
    if len(ids) != len(set(ids)):
        complaints.append("an id is used twice")
    for element in root.iter():
        link = element.get("href") or ""
        if link.startswith("#") and link[1:] not in ids:
            complaints.append(f"a link to {link}")


def check(path):
    complaints, views = [], []
    text = path.read_text(encoding="utf-8").replace("<!DOCTYPE html>", "")
    try:
        root = tree.fromstring(text.encode("utf-8"))
    except tree.ParseError as error:
        return [str(error)], []
    check_ids(root, complaints)
    for element in root.iter():
        if local(element) == "svg":
            views += check_picture(element, complaints)
        if local(element) == "script":
            complaints.append("a script")
    return complaints, views


def lisp(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


for file in sorted(Path(sys.argv[1]).iterdir()):
    found, seen = check(file)
    print(f"({lisp(file.name)} ({' '.join(map(lisp, found[:5]))}) ({' '.join(seen)}))")
