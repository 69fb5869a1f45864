#!/usr/bin/env python3
"""The hand's frames, checked by numpy: how boxes lie, and where the hand is.

    pip install numpy
    python3 t/frames.py [COUNT [SEED [COMMAND...]]]

COUNT random boxes, 1,000 unless said otherwise, with a pose each and a centre of mass in most, are
given to COMMAND, by default sbcl --script examples/batch.lisp, in exact mode.  Every record must
say:
- world = pose o hand: position, orientation, closing direction; and the opening is the same;
- the hand's axes are right-handed, and its quaternion is a unit one with w >= 0;
- z is minus the normal of the face that the palm of this grasp is over;
- where fingers oppose, the middles of the contacts on both faces lie on the closing line, as far
  apart as the opening, and the contacts are as far from the hand's frame in the world as in the
  box;
- in no motion tried do the contacts and gravity, which follows from the pose, do less than the
  certified radius says.  The least ratio found, to the upper value, is printed.
"""
import json
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PALM = {"PINCH-2-PARALLEL": 5, "PINCH-3-PARALLEL": 5, "PINCH-3-U-SHAPE": 5, "PINCH-3-C-SHAPE": 5,
        "PINCH-2-ADJACENT": 2, "PINCH-3-ADJACENT": 2, "PINCH-3-CORNER": 4}
NEAR = 1e-9


def normal(face):
    """The outward normal of FACE."""
    return np.eye(3)["XYZ".index(face[0])] * (1 if face[1] == "1" else -1)


def matrix(quaternion):
    """The rotation of QUATERNION, x y z w: R v = v + 2 w (a x v) + 2 a x (a x v)."""
    x, y, z, w = quaternion
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * cross + 2 * cross @ cross


def random_box(random, number):
    """A box that a hand may hold, with a random pose."""
    size = random.uniform(1, 9, 3) if random.random() < .7 else random.uniform(.5, 25, 3)
    orientation = random.normal(size=4)
    needs = random.uniform(0, 1, 6) * (random.random(6) < .7)
    box = {"name": str(number), "size": size.tolist(), "weight": random.uniform(0, .4),
           "u": random.uniform(.3, 1.4), "v": random.uniform(0, .4),
           "constrained": [face for face in ("X1", "X2", "Y1", "Y2", "Z1", "Z2")
                            if random.random() < .2],
           "force_needed": needs.tolist(), "velocity_needed": [0.5, 0.5, 0.5, 0.2, 0.2, 0.2],
           "pose": {"orientation": (orientation / np.linalg.norm(orientation)).tolist(),
                    "position": random.uniform(-99, 99, 3).tolist()}}
    if random.random() < .8:
        box["centre"] = (size * random.uniform(-.2, .2, 3)).tolist()
    return box


def least_ratio(box, contacts, random):
    """The least (contacts' power + gravity's) / |needs * motion| of many motions, walks
    included."""
    force = box["weight"] * matrix(box["pose"]["orientation"]).T @ np.array([0, 0, -1])
    gravity = np.append(force, np.cross(box.get("centre", [0, 0, 0]), force))
    need = np.array(box["force_needed"])

    def ratio(motions):
        total = motions @ gravity
        for place, inward in contacts:
            velocity = motions[:, :3] + np.cross(motions[:, 3:], place)
            along = velocity @ inward
            slip = np.linalg.norm(velocity - np.outer(along, inward), axis=1)
            turning = np.abs(motions[:, 3:] @ inward)
            total += np.maximum(0, along + box["u"] * slip + box["v"] * turning)
        return total / np.maximum(1e-12, np.linalg.norm(need * motions, axis=1))

    motions = random.normal(size=(4000, 6)) / np.array([1, 1, 1, 3, 3, 3])
    for step in np.geomspace(.3, .003, 40):
        best = motions[np.argsort(ratio(motions))[:20]]
        lengths = np.linalg.norm(best, axis=1)[:, None]
        motions = np.concatenate([best] + [best + step * lengths * random.normal(size=best.shape)
                                           for _ in range(20)])
    return ratio(motions).min()


def check(box, record, random):
    """Raise an AssertionError unless RECORD is right for BOX; return the least ratio to the upper
    value."""
    hand, world, pose = record["hand"], record["world"], box["pose"]
    turn, h = matrix(pose["orientation"]), matrix(hand["orientation"])
    place = pose["position"] + turn @ hand["position"]
    assert np.allclose(world["position"], place, 0, 1e-7), "position"
    assert np.allclose(matrix(world["orientation"]), turn @ h, 0, NEAR), "orientation"
    assert np.allclose(world["closing"], turn @ hand["closing"], 0, NEAR), "closing"
    assert world["opening"] == hand["opening"], "opening"
    for frame in (hand, world):
        axes = matrix(frame["orientation"])
        assert abs(np.linalg.norm(frame["orientation"]) - 1) < NEAR, "unit quaternion"
        assert frame["orientation"][3] >= 0, "w"
        assert np.allclose(np.cross(axes[:, 0], axes[:, 1]), axes[:, 2], 0, NEAR), "right-handed"
        assert np.allclose(axes[:, 0], frame["closing"], 0, NEAR), "x"
    palm = record["matching"][PALM[record["grasp"]]]
    assert np.allclose(h[:, 2], -normal(palm), 0, NEAR), "z"
    assert np.allclose(hand["position"], record["offset"], 0, NEAR), "grasp centre"
    contacts = [(np.array(c["position"]), np.array(c["normal"])) for c in record["contacts"]]
    for (place, inward), contact in zip(contacts, record["contacts"]):
        assert np.allclose(inward, -normal(contact["surface"]), 0, NEAR), "normal"
        inside = turn @ h @ (h.T @ (place - hand["position"])) + world["position"]
        assert np.allclose(inside, pose["position"] + turn @ place, 0, 1e-7), "contact in the world"
    if hand["opening"] is not None:
        for sign in (1, -1):
            local = [h.T @ (place - hand["position"]) for place, inward in contacts
                     if inward @ h[:, 0] * sign < -.5]
            middle = np.mean(local, axis=0)
            assert np.allclose(middle, [sign * hand["opening"] / 2, 0, 0], 0, 1e-9), "closing line"
    if record["beta"] is None or record["beta"][0] is None:
        return None
    least = least_ratio(box, contacts, random)
    assert least >= record["beta"][0] - 1e-9, f"radius {record['beta']}, but {least} in a motion"
    return least / record["beta"][1]


def main(count="1000", seed="1", *command):
    random = np.random.default_rng(int(seed))
    boxes = [random_box(random, number) for number in range(int(count))]
    command = list(command) or ["sbcl", "--script", str(ROOT / "examples/batch.lisp")]
    output = subprocess.run(command + ["--input", "json", "--format", "json", "--index", "exact"],
                            input="\n".join(map(json.dumps, boxes)), capture_output=True, text=True,
                            check=True).stdout
    records = [json.loads(line) for line in output.splitlines()]
    assert len(records) == len(boxes), "one record a box"
    ratios, grasps, faults = [], 0, 0
    for box, record in zip(boxes, records):
        assert record["status"] != "error" and "world" in record, record
        if record["status"] == "cant":
            assert record["world"] is None and record["hand"] is None, record
            continue
        grasps += 1
        try:
            ratio = check(box, record, random)
            if ratio is not None:
                ratios.append(ratio)
        except AssertionError as fault:
            faults += 1
            print(f"{fault}: {json.dumps(box)} {json.dumps(record)}")
    print(f"{len(boxes)} boxes, {grasps} grasps, {faults} wrong; least ratio found / exact radius: "
          f"median {np.median(ratios):.3f}, greatest {np.max(ratios):.3f} of {len(ratios)}")
    return 1 if faults or not grasps else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
