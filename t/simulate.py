#!/usr/bin/env python3
"""simulate.py: let MuJoCo judge what grasps hold.

    python3 t/simulate.py [COUNT] [--seed N] [--index exact|paper]... [--workers N] [--verbose]

Random boxes are planned, until COUNT best grasps have a certified force radius above 1.05;
friction force and torque of a fingertip share its friction, as MuJoCo has it.  Each grasp is
simulated in the model that --mjcf writes: under gravity alone, then under the task at 90 % of the
certified radius, and at 90 % of u_w, in each direction along and about the axes that the task
needs, and in the worst one. The fingers press as statics says, and know nothing of what happens.
A grasp holds if the box stays: after load and forces have grown for 0.3 s and rested for 0.2 s,
it moves less than 1 mm and turns less than 0.02 rad in the next second. Needs MuJoCo and numpy:
pip install mujoco.  The exit status is 1 if a grasp drops its box, or if fewer than 97 % hold at
90 % of the radius.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

try:
    import mujoco
    import numpy as np
except ImportError:
    print("skipped: no MuJoCo")
    sys.exit(0)

ROOT = Path(__file__).resolve().parent.parent
RAMP, SETTLE, TEST = 0.3, 0.2, 1.0          # seconds: load and forces grow, rest, and are watched
STAY, TURN = 1e-3, 0.02              # metres and radians by which a box that is held may move


def drift(model, press, load):
    """Return how far the box moves, in metres and radians, while it is watched under LOAD."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("hold").id)
    hold, press, load = data.ctrl.copy(), np.array(press), np.array(load)
    box = model.body("box").id
    step = model.opt.timestep
    started = None
    for tick in range(round((RAMP + SETTLE + TEST) / step)):
        part = min(1, tick * step / RAMP)
        data.ctrl[:] = (1 - part) * hold + part * press
        data.xfrc_applied[box] = part * load
        mujoco.mj_step(model, data)
        if started is None and tick * step >= RAMP + SETTLE:
            started = data.qpos[:7].copy()
        if np.linalg.norm(data.qpos[:3]) > 0.05:
            break
    if started is None:
        return 1.0, 1.0
    turn = 2 * np.arccos(min(1, abs(data.qpos[3:7] @ started[3:7])))
    return float(np.linalg.norm(data.qpos[:3] - started[:3])), float(turn)


def judge(line):
    """Return the case of LINE with how far the box moves under each load in place of the loads."""
    case = json.loads(line)
    model = mujoco.MjModel.from_xml_path(case["model"])
    hold = model.key("hold").ctrl
    case["gravity"] = [("gravity", *drift(model, hold, [0] * 6))]
    for key in ("task", "index"):
        case[key] = [(load["name"], *drift(model, load["press"], load["load"]))
                     for load in case[key]]
    return case


def lost(moves):
    return [f"{name} ({way * 1000:.2f} mm, {turn:.4f} rad)"
            for name, way, turn in moves if way > STAY or turn > TURN]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int, nargs="?", default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--index", action="append", choices=["exact", "paper"])
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    status = 0
    for index in options.index or ["exact", "paper"]:
        with tempfile.TemporaryDirectory() as directory:
            done = subprocess.run(["sbcl", "--script", str(ROOT / "t/simulate.lisp"),
                                   str(options.count), str(options.seed), index, directory],
                                  capture_output=True, text=True)
            if done.returncode:
                sys.exit(done.stderr[-2000:])
            print(f"--index {index}: {done.stderr.strip()}")
            with ProcessPoolExecutor(options.workers) as pool:
                cases = list(pool.map(judge, done.stdout.splitlines()))
        for key, what in (("gravity", "gravity"), ("task", "the task at 90 % of the radius"),
                          ("index", "the task at 90 % of u_w")):
            failed = [case for case in cases if lost(case[key])]
            tried = sum(len(case[key]) for case in cases)
            print(f"  {what}: {len(cases) - len(failed)} of {len(cases)} grasps held; "
                  f"{tried - sum(len(lost(case[key])) for case in cases)} of {tried} loads")
            if key != "index" or options.verbose:
                for case in failed:
                    print(f"    case {case['case']}, {case['grasp']}, radius {case['radius']:.3f}, "
                          f"u_w {case['u_w']:.3f}: {', '.join(lost(case[key]))}")
            if options.verbose:
                ways = sorted(way for case in cases for _, way, _ in case[key])
                print("    mm:", *(f"{1000 * ways[int(q * (len(ways) - 1))]:.5f}"
                                   for q in (0, .25, .5, .75, .9, .95, .98, 1)))
        held = [[case for case in cases if not lost(case[key])] for key in ("gravity", "task")]
        if len(held[0]) < len(cases) or len(held[1]) < 0.97 * len(cases):
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
