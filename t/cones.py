"""What contacts can truly exert, by second-order cone programming, beside the WRENCH entries.

    pip install clarabel scipy
    sbcl --script t/study.lisp cases | python3 t/cones.py    how tight the entries are
    python3 t/cones.py pencil                                the pencil's true force radius
"""
import sys
import clarabel
import numpy as np
from scipy import optimize, sparse


def contacts(grasp, size, spread):
    """The contacts of a grasp: a list of (position, inward normal)."""
    a, b, c = (x / 2 for x in size)
    h = spread / 2
    n1, n2 = ((a, 0, 0), (-1, 0, 0)), ((-a, 0, 0), (1, 0, 0))
    o1, o2 = ((0, b, 0), (0, -1, 0)), ((0, -b, 0), (0, 1, 0))
    a1 = ((0, 0, c), (0, 0, -1))
    return {
        "PINCH-2-PARALLEL": [n1, n2],
        "PINCH-3-PARALLEL": [((a, h, 0), n1[1]), ((a, -h, 0), n1[1]), n2],
        "PINCH-3-U-SHAPE": [o1, o2, n2],
        "PINCH-3-C-SHAPE": [n1, n2, o2],
        "PINCH-2-ADJACENT": [n1, o1],
        "PINCH-3-ADJACENT": [((a, 0, h), n1[1]), ((a, 0, -h), n1[1]), o1],
        "PINCH-3-CORNER": [n1, o1, a1],
    }[grasp]


def grasp_map(places):
    """The matrix from (normal, two friction forces, torque) of each contact to the wrench."""
    columns = []
    for position, normal in np.array(places, float):
        tangents = [e for e in np.eye(3) if abs(e @ normal) < 0.5]
        columns += [np.r_[f, np.cross(position, f)] for f in (normal, *tangents)]
        columns.append(np.r_[0, 0, 0, normal])
    return np.array(columns).T


def greatest(places, u, v, wrench):
    """The greatest multiple of WRENCH that the contacts can exert."""
    count = len(places)
    size = 4 * count + 1
    rows, right, cones = [], [], [clarabel.ZeroConeT(6), clarabel.NonnegativeConeT(4 * count)]
    for i in range(count):
        for terms, bound in (({0: 1}, 1), ({0: -1}, 0), ({3: 1, 0: -v}, 0), ({3: -1, 0: -v}, 0)):
            rows.append(np.zeros(size))
            right.append(bound)
            for place, factor in terms.items():
                rows[-1][4 * i + place] = factor
    for i in range(count):
        cone = np.zeros((3, size))
        cone[0, 4 * i], cone[1, 4 * i + 1], cone[2, 4 * i + 2] = -u, -1, -1
        rows += list(cone)
        cones.append(clarabel.SecondOrderConeT(3))
    matrix = np.vstack([np.c_[grasp_map(places), -wrench], rows])
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solution = clarabel.DefaultSolver(
        sparse.csc_matrix((size, size)), -np.eye(size)[-1], sparse.csc_matrix(matrix),
        np.r_[np.zeros(6), right, np.zeros(3 * count)], cones, settings).solve()
    return -solution.obj_val


def maxima(places, u, v):
    """The true entries: for each axis the lesser of the two directions."""
    return np.array([min(greatest(places, u, v, sign * axis) for sign in (1, -1))
                     for axis in np.eye(6)])


def print_tightness(lines):
    cases = {}
    for line in lines:
        grasp, *numbers = line.split()
        numbers = list(map(float, numbers))
        size, (u, v, spread), entries = numbers[:3], numbers[3:6], np.array(numbers[6:])
        true = maxima(contacts(grasp, size, spread), u, v)
        cases.setdefault(grasp, []).append((entries, true, max(size) <= 2 * min(size)))
    for grasp, results in cases.items():
        closed = [case for case in results if case[1].min() > 1e-6]
        called = [case for case in closed if case[0].min() > 0]
        cubes = [case for case in closed if case[2]]
        wrong = [case for case in results if case[0].min() > 0 and case[1].min() <= 1e-6]
        ratios = np.array([entries / true for entries, true, _ in called])
        print(grasp, len(closed), "closed,", len(closed) - len(called), "of them called open;",
              len(wrong), "open and called closed")
        print("  of", len(cubes), "closed ones nearly cubes,",
              sum(case[0].min() <= 0 for case in cubes), "called open")
        for name, values in (("median", np.median(ratios, 0)),
                             ("10 %", np.quantile(ratios, 0.1, 0)),
                             ("greatest", ratios.max(0))):
            print(f"  entry / true value, {name}:", *(f"{value:.2f}" for value in values))


def pencil_radius(weight, size=(2, 12, 2), u=0.8, v=0.2, spread=1.7375):
    """The radius of the largest task ellipsoid that the pencil's best grasp can serve: the least,
    over all motions, of the power of the contacts and the weight for the size of the task.
    N O A are -Y -X -Z here, which changes no length."""
    needs = np.array([0.8, 1, 0.8, 1, 0.3, 1])
    places = np.array(contacts("PINCH-3-PARALLEL", size, spread), float)

    def ratio(motion):
        power = weight * motion[2]
        for position, normal in places:
            velocity = motion[:3] + np.cross(motion[3:], position)
            along = velocity @ normal
            power += max(0, along + u * np.linalg.norm(velocity - along * normal)
                         + v * abs(motion[3:] @ normal))
        return power / np.linalg.norm(needs * motion)

    random = np.random.default_rng(1)
    return min(optimize.minimize(ratio, random.normal(size=6) / needs, method="Nelder-Mead",
                                 options={"maxiter": 4000, "maxfev": 4000, "xatol": 1e-7,
                                          "fatol": 1e-9}).fun for _ in range(200))


if sys.argv[1:] == ["pencil"]:
    print(f"with its weight {pencil_radius(0.2):.3f}, without {pencil_radius(0):.3f}")
else:
    print_tightness(sys.stdin)
