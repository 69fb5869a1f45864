"""Exact radii, computed once more: by many motions, and by second-order cone programming.

    pip install clarabel scipy
    sbcl --script t/study.lisp radii | python3 t/radii.py

A line is a case: how many contacts, each (position, inward normal), u, v, 1 if coupled, need,
gravity, and what EXACT-RADIUS says: upper, lower (nan if not certified), worst motion.
"""
import sys
import clarabel
import numpy as np
from scipy import sparse


def power(places, u, v, coupled, motions):
    """The greatest power of the fingers in each of MOTIONS."""
    total = np.zeros(len(motions))
    for position, normal in places:
        velocity = motions[:, :3] + np.cross(motions[:, 3:], position)
        along = velocity @ normal
        slip = u * np.linalg.norm(velocity - np.outer(along, normal), axis=1)
        twist = v * np.abs(motions[:, 3:] @ normal)
        total += np.maximum(0, along + (np.hypot(slip, twist) if coupled else slip + twist))
    return total


def least_ratio(places, u, v, coupled, need, gravity, worst):
    """The least (power + gravity's) / |need * motion| of many motions, and of walks from the
    best."""
    random = np.random.default_rng(1)
    reach = np.maximum(1e-6, power(places, u, v, coupled, np.eye(6)))

    def ratios(motions):
        size = np.linalg.norm(need * motions, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = (power(places, u, v, coupled, motions) + motions @ gravity) / size
        return np.where(size > 1e-12 * np.linalg.norm(motions * reach, axis=1), ratio, np.inf)

    motions = np.vstack([random.normal(size=(20000, 6)) / reach, worst])
    best = motions[np.argsort(ratios(motions))[:64]]
    values, step = ratios(best), 0.5
    for _ in range(400):
        scale = np.linalg.norm(best * reach, axis=1, keepdims=True) / reach
        tries = best + step * scale * random.normal(size=best.shape)
        new = ratios(tries)
        better = new < values
        best[better], values[better] = tries[better], new[better]
        step *= 0.97
    return values.min()


def greatest(places, u, v, coupled, gravity, wrench):
    """The greatest r for which the fingers exert r * WRENCH - GRAVITY.  Of each finger the unknowns
    are its normal force, and the shares of it that two forces across and the torque take."""
    count, columns = len(places), []
    for position, normal in places:
        tangents = np.linalg.svd(normal[None])[2][1:]
        for factor, force in zip((1, u, u), (normal, *tangents)):
            columns.append(factor * np.r_[force, np.cross(position, force)])
        columns.append(v * np.r_[0, 0, 0, normal])
    size = 4 * count + 1
    rows, right, cones = [np.c_[np.array(columns).T, -wrench]], [-gravity], [clarabel.ZeroConeT(6)]

    def add(cone, finger, lines, bounds):
        block = np.zeros((len(lines), size))
        block[:, 4 * finger:4 * finger + 4] = lines
        rows.append(block), right.append(bounds), cones.append(cone)

    one = np.eye(4)
    for i in range(count):
        add(clarabel.NonnegativeConeT(1), i, one[:1], [1])
        if coupled:
            add(clarabel.SecondOrderConeT(4), i, -one, [0] * 4)
        else:
            add(clarabel.SecondOrderConeT(3), i, -one[:3], [0] * 3)
            add(clarabel.SecondOrderConeT(2), i, -one[[0, 3]], [0] * 2)
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solution = clarabel.DefaultSolver(
        sparse.csc_matrix((size, size)), -np.eye(size)[-1], sparse.csc_matrix(np.vstack(rows)),
        np.concatenate(right).astype(float), cones, settings).solve()
    # What can't be solved holds nothing; a dual value is above the truth, if it is not exact.
    return -solution.obj_val if "Infeasible" not in str(solution.status) else -np.inf


def check(numbers):
    count = int(numbers[0])
    places = numbers[1:1 + 6 * count].reshape(count, 2, 3)
    u, v, coupled = numbers[1 + 6 * count:4 + 6 * count]
    need, gravity = numbers[4 + 6 * count:16 + 6 * count].reshape(2, 6)
    upper, lower = numbers[16 + 6 * count:18 + 6 * count]
    worst = numbers[18 + 6 * count:]
    at_worst = (power(places, u, v, coupled, worst[None]) + worst @ gravity)[0]
    assert abs(at_worst - upper) < 1e-7 * (1 + abs(upper)), \
        "the upper value is not the worst motion's"
    if upper <= 0:
        held = greatest(places, u, v, coupled, np.zeros(6), -gravity) if gravity.any() else np.inf
        assert held < 1 + 1e-6 or upper == 0, f"held: {held}"
        return "can't hold" if held < 1 else "no radius", 0
    least = least_ratio(places, u, v, coupled, need, gravity, worst)
    assert not lower > least * (1 + 1e-9), f"lower {lower} is above {least}"
    if lower == lower:
        assert upper <= max(1.015 * least, least + 0.003), f"upper {upper} is far above {least}"
    random = np.random.default_rng(2)
    toward = need ** 2 * worst
    for wrench in [toward] + [toward + need ** 2 * random.normal(size=6) * np.linalg.norm(worst) / 3
                              for _ in range(6)]:
        support = np.linalg.norm(wrench[need > 0] / need[need > 0])
        reached = upper * greatest(places, u, v, coupled, gravity, upper * wrench / support)
        assert not lower > reached + 1e-5, f"lower {lower} is above {reached} along one wrench"
    return ("certified" if lower == lower else "not certified"), max(0, upper / least - 1)


results = [check(np.array(line.split(), float)) for line in sys.stdin]
for kind in sorted({kind for kind, _ in results}):
    print(kind, sum(1 for result in results if result[0] == kind))
print("certified: greatest upper value / least of many motions - 1:",
      f"{max(excess for kind, excess in results if kind == 'certified'):.5f}")
