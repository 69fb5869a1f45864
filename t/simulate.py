#!/usr/bin/env python3
"""simulate.py: let MuJoCo judge what grasps hold.

    python3 t/simulate.py [COUNT] [--refine] [--seed N] [--index exact|paper]... [--workers N]
                          [--verbose]

Random boxes are planned, until COUNT best grasps have a certified force radius above 1.05;
friction force and torque of a fingertip share its friction, as MuJoCo has it.  Each grasp is
simulated in the model that --mjcf writes: under gravity alone, then under the task at 90 % of the
certified radius, and at 90 % of u_w, in each direction along and about the axes that the task
needs, and in the worst one. The fingers press as statics says, and know nothing of what happens.
A grasp holds if the box stays: after load and forces have grown for 0.3 s and rested for 0.2 s,
it moves less than 1 mm and turns less than 0.02 rad in the next second.

With --refine, only grasps whose fingers refining moves count, and both are tried, as planned and
refined: at 90 % of the radius, and of the radius by default, by which the torque of a fingertip
does not share its friction. The refined one is also tried at 90 % of the radius as planned.

Needs MuJoCo and numpy: pip install mujoco.  The exit status is 1 if a grasp drops its box under
gravity, or if fewer than 97 % hold what is within the certified radius.
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
ENOUGH = 0.97                        # the part of the grasps that must hold what they can do


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
    """Return the case of LINE with how far the box moves under each load of each try."""
    case = json.loads(line)
    for trial in case["tries"]:
        model = mujoco.MjModel.from_xml_path(trial["model"])
        trial["moves"] = [(load["name"], *drift(model, load["press"], load["load"]))
                          for load in trial["loads"]]
    return case


def lost(trial):
    return [f"{name} ({way * 1000:.2f} mm, {turn:.4f} rad)"
            for name, way, turn in trial["moves"] if way > STAY or turn > TURN]


def cases_of(options, index):
    """Return the judged cases of INDEX, and print what boxes they come from."""
    with tempfile.TemporaryDirectory() as directory:
        done = subprocess.run(["sbcl", "--script", str(ROOT / "t/simulate.lisp"),
                               str(options.count), str(options.seed), index, directory]
                              + ["refine"] * options.refine, capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr[-2000:])
        print(f"--index {index}: {done.stderr.strip()}", flush=True)
        with ProcessPoolExecutor(options.workers) as pool:
            return list(pool.map(judge, done.stdout.splitlines()))


def print_try(cases, place, verbose):
    """Print what the tries at PLACE of CASES have come to. Return whether enough of them held, of
    those that were not asked more than their contacts can do."""
    tries = [case["tries"][place] for case in cases]
    held = [not lost(trial) for trial in tries]
    loads = sum(len(trial["moves"]) for trial in tries)
    print(f"  {tries[0]['what']}: {sum(held)} of {len(tries)} grasps held; "
          f"{loads - sum(len(lost(trial)) for trial in tries)} of {loads} loads")
    fair = [holds for holds, trial in zip(held, tries) if trial["asked"] <= trial["can"]]
    if len(fair) < len(tries):
        print(f"    asked more than the radius of the contacts: {len(tries) - len(fair)}, "
              f"of which {sum(held) - sum(fair)} held")
    for case, trial in zip(cases, tries):
        if lost(trial) and (verbose or trial["asked"] <= trial["can"]):
            print(f"    case {case['case']}, {case['grasp']}: asked {trial['asked']:.3f}, "
                  f"can {trial['can']:.3f}, u_w {case['u_w']:.3f}: {', '.join(lost(trial))}")
    if verbose:
        ways = sorted(way for trial in tries for _, way, _ in trial["moves"])
        print("    mm:", *(f"{1000 * ways[int(q * (len(ways) - 1))]:.5f}"
                           for q in (0, .25, .5, .75, .9, .95, .98, 1)))
    return sum(fair) >= (ENOUGH if tries[0]["asked"] else 1) * len(fair)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("count", type=int, nargs="?", default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--index", action="append", choices=["exact", "paper"])
    parser.add_argument("--refine", action="store_true")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    enough = True
    for index in options.index or (["paper"] if options.refine else ["exact", "paper"]):
        cases = cases_of(options, index)
        for place in range(len(cases[0]["tries"])):
            enough = print_try(cases, place, options.verbose) and enough
        if options.refine:
            ratios = sorted(case["refined"] / case["radius"] for case in cases)
            print(f"  radius refined / as planned: least {ratios[0]:.3f}, median "
                  f"{ratios[len(ratios) // 2]:.3f}, greatest {ratios[-1]:.3f}; "
                  f"below 1 in {sum(ratio < 1 for ratio in ratios)}")
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
