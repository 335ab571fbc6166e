#!/usr/bin/env python3
"""Element tests of hypoplastic sand, computed apart from the program: the tensor equation in the notation of Herle and
Gudehus (Mech. Cohes.-Frict. Mater. 4 (1999) 461-486), tension positive, by the classical method of Runge and Kutta in
steps so small that it has no error to speak of. Writes fe_hypoplastic_reference.csv, against which
fe_hypoplastic_tests.cc holds the law:

  fe_hypoplastic_reference.py > fe_hypoplastic_reference.csv

The equation itself is held against another program: with the intergranular strain of Niemunis and Herle (ibid. 2 (1997)
279-299) beside it, an oedometer on Hochstetten sand has to give what F. Sarabia published for the UMAT of Tamagnini,
Sellari, Masin and von Wolffersdorff (documentation of OpenSees, nDMaterial UMAT, worked example):

  fe_hypoplastic_reference.py --check fe_hypoplastic_reference.csv

which looks, too, whether the file is what larger steps give.
"""

import csv
import math
import sys

# phi_c [degrees], h_s [Pa], n, e_d0, e_c0, e_i0, alpha, beta
SANDS = {
    # The calibration in the worked example above; Niemunis and Herle (1997).
    "hochstetten": (33.0, 1.0e9, 0.25, 0.55, 0.95, 1.05, 0.25, 1.5),
    # Fitted by Mendez, Mendez and Pasculli (arXiv:2211.13652, tutorial of GA-cal) to the tests in MEASURED of
    # fe_hypoplastic_tests.cc.
    "tutorial": (33.38, 1.23e9, 0.24, 0.58 * 1.04, 1.04, 1.10 * 1.04, 0.20, 1.22),
}
INTERGRANULAR = {"m_R": 5.0, "m_T": 2.0, "R": 1e-4, "beta_r": 0.5, "chi": 6.0}  # of the worked example
I3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
R3 = range(3)


def tensor(entry):
    return [[entry(i, j) for j in R3] for i in R3]


def trace(a):
    return a[0][0] + a[1][1] + a[2][2]


def dot(a, b):
    return tensor(lambda i, j: sum(a[i][k] * b[k][j] for k in R3))


def ddot(a, b):
    return sum(a[i][j] * b[i][j] for i in R3 for j in R3)


def norm(a):
    return math.sqrt(ddot(a, a))


def combined(*parts):
    return tensor(lambda i, j: sum(factor * part[i][j] for factor, part in parts))


class Response:
    """L : D and N at a stress T [Pa], tension positive, and a void ratio."""

    def __init__(self, sand, T, e):
        phi, h_s, n, e_d0, e_c0, e_i0, alpha, beta = sand
        sine = math.sin(math.radians(phi))
        a = math.sqrt(3) * (3 - sine) / (2 * math.sqrt(2) * sine)
        p_s = -trace(T) / 3
        bauer = math.exp(-((3 * p_s / h_s) ** n))
        e_d, e_c, e_i = e_d0 * bauer, e_c0 * bauer, e_i0 * bauer
        self.T_hat = combined((1 / trace(T), T))
        self.T_star = combined((1, self.T_hat), (-1 / 3, I3))
        size = norm(self.T_star)
        tan_psi = math.sqrt(3) * size
        cubed = trace(dot(self.T_star, dot(self.T_star, self.T_star)))
        cos_3_theta = -math.sqrt(6) * cubed / size**3 if size > 1e-12 else 1
        self.F = math.sqrt(tan_psi**2 / 8 + (2 - tan_psi**2) / (2 + math.sqrt(2) * tan_psi * cos_3_theta)) \
            - tan_psi / (2 * math.sqrt(2))
        f_d = ((e - e_d) / (e_c - e_d)) ** alpha
        f_e = (e_c / e) ** beta
        f_b = (e_i0 / e_c0) ** beta * h_s / n * (1 + e_i) / e_i * (3 * p_s / h_s) ** (1 - n) \
            / (3 + a**2 - math.sqrt(3) * a * ((e_i0 - e_d0) / (e_c0 - e_d0)) ** alpha)
        self.f_s = f_b * f_e / ddot(self.T_hat, self.T_hat)
        self.a = a
        self.N = combined((self.f_s * f_d * a * self.F, combined((1, self.T_hat), (1, self.T_star))))

    def L(self, D):
        return combined((self.f_s * self.F**2, D), (self.f_s * self.a**2 * ddot(self.T_hat, D), self.T_hat))

    def rate(self, D):
        return combined((1, self.L(D)), (norm(D), self.N))


def axial(a, r):
    return [[r, 0.0, 0.0], [0.0, r, 0.0], [0.0, 0.0, a]]


def lateral_rate(sand, T, e, guess):
    """The lateral rate at which the lateral stress stays, for an axial rate of -1: Newton's method."""
    response = Response(sand, T, e)
    r = guess
    for _ in range(50):
        miss = response.rate(axial(-1, r))[0][0]
        h = 1e-6
        slope = (response.rate(axial(-1, r + h))[0][0] - response.rate(axial(-1, r - h))[0][0]) / (2 * h)
        r -= miss / slope
        if abs(miss / slope) < 1e-13:
            return r
    raise RuntimeError("no lateral rate holds the stress")


def advance(rates, state, step):
    """Classical Runge-Kutta; a state is a list of numbers."""
    def moved(k, share):
        return [x + share * step * y for x, y in zip(state, k)]
    k1 = rates(state)
    k2 = rates(moved(k1, 0.5))
    k3 = rates(moved(k2, 0.5))
    k4 = rates(moved(k3, 1))
    return [x + step * (a + 2 * b + 2 * c + d) / 6 for x, a, b, c, d in zip(state, k1, k2, k3, k4)]


def oedometer(sand, start, e, compression, grid):
    """Rows (axial logarithmic compression, axial, lateral stress, e); start: axial and lateral stress [Pa]; grid: how many
    rows, and steps from row to row."""
    def rates(state):
        D = axial(-1, 0)
        T = Response(sand, axial(state[0], state[1]), state[2]).rate(D)
        return [T[2][2], T[0][0], (1 + state[2]) * trace(D)]
    return followed(rates, [start[0], start[1], e], compression, grid)


def triaxial(sand, pressure, e, compression, grid):
    guess = [0.2]

    def rates(state):
        T = axial(state[0], state[1])
        guess[0] = lateral_rate(sand, T, state[2], guess[0])
        D = axial(-1, guess[0])
        return [Response(sand, T, state[2]).rate(D)[2][2], 0.0, (1 + state[2]) * trace(D)]
    return followed(rates, [-pressure, -pressure, e], compression, grid)


def followed(rates, state, compression, grid):
    n_rows, n_steps = grid
    rows = [(0.0, *state)]
    for row in range(1, n_rows + 1):
        for _ in range(n_steps):
            state = advance(rates, state, compression / (n_rows * n_steps))
        rows.append((row * compression / n_rows, *state))
    return rows


def sarabia():
    """The worked example: axial stress at 0.5 %, stiffness of the last step of loading, of the first of unloading."""
    sand, p = SANDS["hochstetten"], INTERGRANULAR

    def rates_along(direction):
        D = axial(direction, 0)

        def rates(state):
            T, e = axial(state[0], state[1]), state[2]
            h = axial(state[3], state[4])
            response = Response(sand, T, e)
            rho = norm(h) / p["R"]
            unit = combined((1 / norm(h), h)) if norm(h) > 0 else tensor(lambda i, j: 0.0)
            along, share = ddot(unit, D), rho ** p["chi"]
            stiffness = share * p["m_T"] + (1 - share) * p["m_R"]
            rate = combined((stiffness, response.L(D)))
            if along > 0:
                rate = combined((1, rate), (share * (1 - p["m_T"]) * along, response.L(unit)),
                                (share * along, response.N))
                grown = combined((1, D), (-(rho ** p["beta_r"]) * along, unit))
            else:
                rate = combined((1, rate), (share * (p["m_R"] - p["m_T"]) * along, response.L(unit)))
                grown = D
            return [rate[2][2], rate[0][0], (1 + e) * trace(D), grown[2][2], grown[0][0]]
        return rates

    state, axial_stress = [-100e3, -100e3, 0.70, 0.0, 0.0], []
    for step in range(51):
        rates = rates_along(-1 if step < 50 else 1)
        for _ in range(200):
            state = advance(rates, state, 1e-4 / 200)
        axial_stress.append(-state[0])
    return axial_stress[49], (axial_stress[49] - axial_stress[48]) / 1e-4, (axial_stress[49] - axial_stress[50]) / 1e-4


def check():
    """@return whether the published figures are met, to half of the thousandth at which that UMAT integrates"""
    good = True
    for name, here, published in zip(("axial stress", "loading", "unloading"), sarabia(), (294.3e3, 29080e3, 316559e3)):
        good = good and abs(here / published - 1) < 5e-4
        print(f"{name}: {here:.6g} Pa, published {published:.6g} Pa, {100 * (here / published - 1):+.2f} %")
    return good


def tests(n_steps):
    """(sand, test, rows) of each; n_steps from row to row."""
    for sand, e, compression in (("hochstetten", 0.87, 0.08), ("hochstetten", 0.60, 0.03)):
        yield sand, "oedometer", oedometer(SANDS[sand], (-20e3, -20e3), e, compression, (20, n_steps))
    for sand, e, compression in (("tutorial", 0.730, 0.04), ("tutorial", 0.695, 0.04)):
        yield sand, "oedometer", oedometer(SANDS[sand], (-25e3, -12.5e3), e, compression, (20, n_steps))
    for sand, pressure, e, compression in (("hochstetten", 100e3, 0.85, 0.20), ("hochstetten", 100e3, 0.60, 0.20),
                                           ("tutorial", 100e3, 0.69, 0.10), ("tutorial", 300e3, 0.90, 0.10)):
        yield sand, "triaxial", triaxial(SANDS[sand], pressure, e, compression, (20, n_steps))


COLUMNS = ["sand", "test", "start_axial_Pa", "start_lateral_Pa", "start_void_ratio", "compression", "axial_stress_Pa",
           "lateral_stress_Pa", "void_ratio"]


def table(n_steps):
    for sand, test, rows in tests(n_steps):
        for row in rows:
            yield [sand, test, *(float(f"{x:.13g}") for x in (*rows[0][1:], *row))]


def is_current(path):
    """Whether the file holds what this program gives, to the error of steps ten times as long."""
    with open(path, newline="") as file:
        names, *stored = csv.reader(file)
    here = list(table(10))
    if names != COLUMNS or [row[:2] for row in stored] != [row[:2] for row in here]:
        return False
    worst = max(abs(float(x) - y) / max(abs(y), 1e-3)
                for old, new in zip(stored, here) for x, y in zip(old[2:], new[2:]))
    print(f"{path}: {len(stored)} rows, at most {worst:.2g} from those of longer steps")
    return worst < 1e-6


if __name__ == "__main__":
    if sys.argv[1:2] == ["--check"]:
        sys.exit(0 if check() and is_current(sys.argv[2]) else 1)
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerows(table(100))
