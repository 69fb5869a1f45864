#!/usr/bin/env python3
"""formats.py: read what the program writes for other programs by what is not ours, and compare.

    python3 t/formats.py [--boxes N] [--seed N] [--program PATH]

Random boxes go through the program in each format.  PyYAML reads isaac and moveit, json and numpy
read graspgen, and MuJoCo's loader reads the models of --mjcf; every field and its type is checked.
Then the poses are compared with each other and with those of the records, and the pose of each
grasp is used as a robot would: it must carry the contacts from the hand's frame to where the record
has them.  Some boxes go through it again with a gripper that has PALM-DEPTH and FINGER-FORCE, in cm
and in mm and N.
What is not there (pip install numpy pyyaml mujoco) is left out, and said.  PATH is the executable
that src/build.lisp makes; without it examples/batch.lisp is run.
"""

import argparse
import json
import math
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
try:
    import numpy as np
except ImportError:
    print("skipped: no numpy")
    sys.exit(0)
try:
    import yaml
    LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)  # the one in C is ten times as fast
except ImportError:
    yaml = None
try:
    import mujoco
except ImportError:
    mujoco = None

NEAR = 1e-9
DEPTH, FORCE = 7.5, 15.0    # cm and N, of the gripper with which all is done again
NAMES = [None, "pencil", 'a "quoted" one', "colon: comma, #hash", "two\nlines", "- dash", "~", "no",
         "café 箱 😀", "..", "../../etc/passwd", "a/b\\c", "{x: 1}", "12", "PENCIL", "", " ",
         "&amp;<b>--", "tab\tbell\x07del\x7fnel\x85ls\u2028bom\ufeff", "%TAG", "'", "x" * 60,
         "null", "---", "@`|>*!"]
# Closing and approach of each grasp along N O A; None where the sizes of the box decide.
CLOSING = {"PINCH-2-PARALLEL": (1, 0, 0), "PINCH-3-PARALLEL": (1, 0, 0),
           "PINCH-3-C-SHAPE": (1, 0, 0), "PINCH-3-U-SHAPE": (0, 1, 0),
           "PINCH-2-ADJACENT": (-1, 0, 0),
           "PINCH-3-ADJACENT": (-1, 0, 0), "PINCH-3-CORNER": None}
APPROACH = {"PINCH-2-ADJACENT": (0, -1, 0), "PINCH-3-ADJACENT": (0, -1, 0),
            "PINCH-3-CORNER": (0, 0, -1)}


def check(true, *words):
    if not true:
        raise AssertionError(" ".join(str(word) for word in words))


def near(a, b, *words):
    check(np.allclose(np.asarray(a, float), np.asarray(b, float), rtol=0, atol=NEAR),
          *words, a, "is not", b)


# ---------------------------------------------------------------- boxes

def random_box(rng, number):
    """A box as the program reads it in JSON; each twelfth is not valid, each ninth too heavy."""
    box = {"size": [round(10 ** rng.uniform(-0.3, 1.3), 3) for _ in range(3)],
           "weight": 99 if number % 9 == 8 else rng.choice([0, rng.uniform(0, 0.6)]),
           "u": rng.uniform(0.2, 1.6), "v": rng.uniform(0, 0.6),
           "constrained": [f for f in ("X1", "Y2", "Z2") if rng.random() < 0.2],
           "force_needed": [rng.choice([0, rng.random()]) for _ in range(6)],
           "velocity_needed": [rng.choice([0, rng.random()]) for _ in range(6)]}
    if rng.random() < 0.4:
        turn = np.array([rng.gauss(0, 1) for _ in range(4)])
        box["pose"] = {"position": [rng.uniform(-50, 50) for _ in range(3)],
                       "orientation": list(turn / np.linalg.norm(turn))}
    if rng.random() < 0.3:
        box["centre"] = [rng.uniform(-0.4, 0.4) * size for size in box["size"]]
    name = NAMES[number % len(NAMES)]
    if name is not None:
        box["name"] = name
    if number % 12 == 11:
        del box["weight"]
    return box


def in_mm_and_n(box):
    """The same box in millimetres and newtons, a finger being able to press with FORCE."""
    box = dict(box, units=["mm", "N"], size=[10 * size for size in box["size"]], v=10 * box["v"],
               force_needed=[n * FORCE * (1 if i < 3 else 10)
                             for i, n in enumerate(box["force_needed"])])
    if "weight" in box:
        box["weight"] *= FORCE
    if "pose" in box:
        box["pose"] = dict(box["pose"], position=[10 * x for x in box["pose"]["position"]])
    if "centre" in box:
        box["centre"] = [10 * x for x in box["centre"]]
    return box


def metre(box):
    """How many metres the unit of lengths of a box is."""
    return 0.001 if "units" in box else 0.01


def run(program, boxes, *options):
    done = subprocess.run([*program, *options], input="".join(json.dumps(b) + "\n" for b in boxes),
                          capture_output=True, text=True, encoding="utf-8", timeout=600)
    check(done.returncode == 65, "status", done.returncode, done.stderr[-500:])
    return done.stdout, done.stderr


# ---------------------------------------------------------------- frames

def rotation(q):
    """The matrix of a quaternion x y z w."""
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def axis(face):
    """The outward normal of a face of the box."""
    normal = np.zeros(3)
    normal["XYZ".index(face[0])] = 1 if face[1] == "1" else -1
    return normal


def down(box):
    """The direction of gravity in the frame of a box."""
    turn = rotation(box["pose"]["orientation"]) if "pose" in box else np.eye(3)
    return -turn[2]


def check_hand(grasp, size):
    """Check the hand of a grasp of a record against its contacts; return its pose, in cm."""
    hand, name = grasp["hand"], grasp["grasp"]
    turn, place = rotation(hand["orientation"]), np.array(hand["position"])
    near(np.linalg.norm(hand["orientation"]), 1)
    check(hand["orientation"][3] >= 0, "w below 0")
    near(turn.T @ turn, np.eye(3), "not orthonormal")
    near(np.linalg.det(turn), 1, "not right-handed")
    near(place, grasp["offset"])
    near(turn[:, 0], hand["closing"])
    near(turn[:, 2], grasp["approach"])
    noa = np.array([axis(grasp["matching"][i]) for i in (0, 2, 4)]).T   # N O A as columns
    near(turn[:, 2], noa @ APPROACH.get(name, (0, 0, 1)), name, "approach")
    contacts = np.array([c["position"] for c in grasp["contacts"]])
    if CLOSING[name]:
        near(turn[:, 0], noa @ CLOSING[name], name, "closing")
    else:
        across = contacts[1] - contacts[0]
        across -= turn[:, 2] * (across @ turn[:, 2])
        near(turn[:, 0], across / np.linalg.norm(across), name, "closing")
    # From the grasp's frame to the hand's, by what docs/batch.md says; then by the pose.
    x, z = noa.T @ turn[:, 0], np.array(APPROACH.get(name, (0, 0, 1)))
    x = np.array(CLOSING[name]) if CLOSING[name] else x
    in_hand = ((contacts - place) @ noa) @ np.array([x, np.cross(z, x), z]).T
    near(place + in_hand @ turn.T, contacts, name, "contacts by the pose")
    opposed = [(a, b) for a in grasp["contacts"] for b in grasp["contacts"]
               if a["surface"][0] == b["surface"][0] and a["surface"] != b["surface"]]
    check((hand["opening"] is not None) == bool(opposed), "opening", hand["opening"])
    if opposed:
        one, other = (np.mean([c["position"] for c in grasp["contacts"] if c["surface"] == face],
                              axis=0) for face in (side["surface"] for side in opposed[0]))
        near(np.abs((one - other) @ turn[:, 0]), hand["opening"], "opening")
        near(np.linalg.norm(one - other), hand["opening"], "not on the closing line")
        near(hand["opening"], size["XYZ".index(opposed[0][0]["surface"][0])])
    check([c["finger"] for c in grasp["contacts"]]
          == [f"F{i + 1}" for i in range(len(contacts))], "fingers")
    return place, turn


# ---------------------------------------------------------------- formats

def typed(value, kind, where):
    """Check VALUE against KIND: a type, a list of one kind, or a dict of all fields."""
    if isinstance(kind, dict):
        check(isinstance(value, dict) and list(value) == list(kind), where, "has", value)
        for key in kind:
            typed(value[key], kind[key], f"{where}.{key}")
    elif isinstance(kind, list):
        check(isinstance(value, list), where, value)
        for item in value:
            typed(item, kind[0], where)
    else:
        check(type(value) is kind, where, "is", repr(value), "not a", kind.__name__)
        check(kind is not float or math.isfinite(value), where, value)


XYZ = {"x": float, "y": float, "z": float}
POSTURE = {"header": {"frame_id": str}, "joint_names": [str], "points": [dict]}
MOTION = {"direction": {"header": {"frame_id": str}, "vector": XYZ},
          "desired_distance": float, "min_distance": float}
MOVEIT = {"id": str, "pre_grasp_posture": POSTURE, "grasp_posture": POSTURE,
          "grasp_pose": {"header": {"frame_id": str},
                         "pose": {"position": XYZ, "orientation": {**XYZ, "w": float}}},
          "grasp_quality": float, "pre_grasp_approach": MOTION, "post_grasp_retreat": MOTION,
          "post_place_retreat": MOTION, "max_contact_force": float, "allowed_touch_objects": [str]}


def isaac_poses(text, boxes):
    """Return, for each box, the poses (metres, matrix) of an isaac_grasp stream."""
    documents = list(yaml.load_all(text, Loader=LOADER))
    check(len(documents) == len(boxes), len(documents), "documents")
    for document, box in zip(documents, boxes):
        check(list(document) == ["format", "format_version", "object_frame", "gripper_frame",
                                 "grasps"])
        check(document["format"] == "isaac_grasp" and document["format_version"] == 1.0)
        typed(document["gripper_frame"], str, "gripper_frame")
        check(document["object_frame"] == box.get("name", "box"), document["object_frame"])
        check(list(document["grasps"]) == [f"grasp_{i}" for i in range(len(document["grasps"]))])
        for name, grasp in document["grasps"].items():
            typed(grasp, {"confidence": float, "position": [float],
                          "orientation": {"w": float, "xyz": [float]}}, name)
            check(0 <= grasp["confidence"] <= 1 and len(grasp["position"]) == 3)
        yield [(g["position"], rotation([*g["orientation"]["xyz"], g["orientation"]["w"]]),
                g["confidence"]) for g in document["grasps"].values()]


def moveit_poses(text, boxes, answers, force):
    """As isaac_poses, of a moveit stream: one document a grasp, an empty one for a box without."""
    documents = list(yaml.load_all(text, Loader=LOADER))
    for box, answer in zip(boxes, answers):
        poses = []
        for grasp in answer["alternatives"] or [None]:
            document = documents.pop(0)
            if grasp is None:
                check(document is None, document)
                continue
            typed(document, MOVEIT, "moveit")
            name = box.get("name")
            check(document["id"].endswith(" ".join([grasp["grasp"], *grasp["matching"]])))
            check(name is None or document["id"].startswith(name + ": "), document["id"])
            check(document["pre_grasp_approach"]["direction"]["header"]["frame_id"] == (name or ""))
            check(document["max_contact_force"] == force)
            for field, way in (("pre_grasp_approach", grasp["approach"]),
                               ("post_grasp_retreat", -down(box))):
                near(list(document[field]["direction"]["vector"].values()), way, field)
            pose = document["grasp_pose"]["pose"]
            poses.append((list(pose["position"].values()),
                          rotation(list(pose["orientation"].values())), document["grasp_quality"]))
        yield poses
    check(not documents, len(documents), "documents too many")


def graspgen_poses(text, boxes):
    lines = text.splitlines()
    check(len(lines) == len(boxes))
    for line in lines:
        data = json.loads(line)
        check(list(data) == ["object", "grasps"] and list(data["object"]) == ["file", "scale"])
        check(re.fullmatch(r"[a-z0-9-]+\.obj", data["object"]["file"]))
        check(data["object"]["scale"] == 1)
        check(list(data["grasps"]) == ["transforms", "object_in_gripper"])
        matrices = np.array(data["grasps"]["transforms"]).reshape(-1, 4, 4)
        check(data["grasps"]["object_in_gripper"] == [True] * len(matrices))
        for matrix in matrices:
            near(matrix[3], [0, 0, 0, 1])
            near(matrix[:3, :3].T @ matrix[:3, :3], np.eye(3))
            near(np.linalg.det(matrix[:3, :3]), 1)
        yield [(matrix[:3, 3], matrix[:3, :3], None) for matrix in matrices]


def check_model(path, answer, box, force):
    """Load a model by MuJoCo, and compare it with the record and the box."""
    model = mujoco.MjModel.from_xml_path(str(path))
    unit = metre(box)
    near(model.geom("box").size, np.array(box["size"]) * unit / 2)
    check(model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC)
    weight = model.body("box").mass[0] * np.linalg.norm(model.opt.gravity)
    near(weight, box["weight"] * (1 if "units" in box else force))
    if box["weight"]:
        near(model.opt.gravity / np.linalg.norm(model.opt.gravity), down(box))
    near(model.body("box").ipos, np.array(box.get("centre", [0, 0, 0])) * unit)
    check(model.nu == len(answer["contacts"]))
    for contact in answer["contacts"]:
        finger, slider = model.geom(contact["finger"]), model.joint(contact["finger"])
        check(model.geom_condim[finger.id] == 4)
        near(finger.friction[:2], [max(box["u"], 1e-5), box["v"] * unit])
        near(slider.axis, contact["normal"])
        near(model.body(contact["finger"]).pos + finger.size[0] * slider.axis,
             np.array(contact["position"]) * unit)
        near(model.actuator(contact["finger"]).ctrlrange, [0, force])
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("hold").id)
    mujoco.mj_forward(model, data)
    check(np.all(data.ctrl >= 0) and np.all(data.ctrl <= force))


def check_models(directory, answers, boxes, force):
    used = sorted(p.name for p in directory.iterdir())
    check(all(re.fullmatch(r"[a-z0-9-]+\.xml", name) for name in used), used)
    counts = {}
    for answer, box in zip(answers, boxes):
        if answer["status"] != "grasp":
            continue
        stem = re.sub("[^a-zA-Z0-9]", "-", box.get("name", "")[:40]).strip("-").lower() or "box"
        counts[stem] = number = counts.get(stem, 0) + 1
        check_model(directory / (f"{stem}-{number}.xml" if number > 1 else f"{stem}.xml"),
                    answer, box, force)
    check(sum(counts.values()) == len(used), "files", len(used))
    return len(used)


# ---------------------------------------------------------------- all

def compare(program, boxes, depth, force):
    """Check every format of BOXES; return how many grasps were compared, and how many models."""
    records, _ = run(program, boxes, "--format", "json", "--all", "1000")
    answers = [json.loads(line) for line in records.splitlines()]
    check(len(answers) == len(boxes))
    expected = []
    for answer, box in zip(answers, boxes):
        check(answer["status"] == "grasp" or answer["hand"] is answer["alternatives"] is None)
        poses = []
        for grasp in answer["alternatives"] or []:
            place, turn = check_hand(grasp, box["size"])
            poses.append((place * metre(box) - depth / 100 * turn[:, 2], turn, grasp["quality"]))
        expected.append(poses)
        if poses:
            check(answer["hand"] == answer["alternatives"][0]["hand"])
    streams = {"graspgen": lambda text: graspgen_poses(text, boxes)}
    if yaml:
        streams["isaac"] = lambda text: isaac_poses(text, boxes)
        streams["moveit"] = lambda text: moveit_poses(text, boxes, answers, force or 0)
    nothing = sum(not poses for poses in expected)
    for name, read in streams.items():
        text, errors = run(program, boxes, "--format", name)
        check(errors.count("no grasp for") == nothing, name, errors)
        for poses, others, box in zip(expected, read(text), boxes, strict=True):
            check(len(poses) == len(others), name, len(poses), len(others))
            for (place, turn, quality), (there, turned, worth) in zip(poses, others):
                near(place, there, name)
                near(turn, turned, name)
                if name == "isaac" and "units" not in box:
                    near(worth, quality / (1 + quality))
                if name == "moveit":
                    near(worth, quality)
    models = 0
    with tempfile.TemporaryDirectory() as directory:
        run(program, boxes, "--mjcf", directory + "/models")
        if mujoco:
            models = check_models(Path(directory, "models"), answers, boxes, force or 1)
    return sum(map(len, expected)), models


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--boxes", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program")
    options = parser.parse_args()
    program = [options.program] if options.program else ["sbcl", "--script",
                                                         str(ROOT / "examples/batch.lisp")]
    rng = random.Random(options.seed)
    boxes = [random_box(rng, number) for number in range(options.boxes)]
    for what, there in (("PyYAML: isaac and moveit", yaml), ("MuJoCo: models", mujoco)):
        if not there:
            print(f"not checked, no {what}")
    grasps, models = compare(program, boxes, 0, None)
    text = (ROOT / "grasps.lisp").read_text(encoding="utf-8")
    with tempfile.NamedTemporaryFile("w", suffix=".lisp", encoding="utf-8") as file:
        file.write(text.replace("'(FINGER-LENGTH", f"'(PALM-DEPTH {DEPTH} FINGER-FORCE {FORCE} "
                                                   "FINGER-LENGTH", 1))
        file.flush()
        program += ["--grasps", file.name]
        compare(program, boxes[:max(24, options.boxes // 10)], DEPTH, FORCE)
        compare(program, [in_mm_and_n(box) for box in boxes[:max(24, options.boxes // 20)]], DEPTH,
                FORCE)
    print(f"{options.boxes} boxes, seed {options.seed}: {grasps} grasps and {models} models agree")


if __name__ == "__main__":
    main()
