"""Measures of grains and contacts made by hand, against closed forms."""

import itertools
import unittest

import numpy as np
from small_runs import ROOT  # noqa: F401 finds the package

import bergamo
from bergamo import rotation, shapes
from bergamo.measure.stresses import share_in_box


def grains_at(position, radii, ids=None, **fields):
    """Spheres."""
    position = np.asarray(position, dtype=float)
    n = len(position)
    radii = np.broadcast_to(np.asarray(radii, dtype=float), n)
    unit = np.tile([0., 0., 0., 1.], (n, 1))
    parts = shapes.Parts(np.arange(n), position, unit, np.tile(radii[:, None], (1, 3)), np.ones((n, 2)))
    return bergamo.Grains(0., np.arange(n) if ids is None else np.asarray(ids), position, np.zeros((n, 3)),
                          4 / 3 * np.pi * radii ** 3, fields, parts)


def contacts_of(first, second, start, branch, force, cell=None):
    """@param force on the first grains, along the branches"""
    start, branch, force = (np.asarray(rows, dtype=float).reshape(-1, 3) for rows in (start, branch, force))
    normal = branch / np.linalg.norm(branch, axis=1, keepdims=True)
    along = -(force * normal).sum(axis=1)
    return bergamo.Contacts(0., np.asarray(first), np.asarray(second), start, branch, along,
                            force + along[:, None] * normal, np.zeros(len(along)), normal, start + branch / 2, cell)


class Stress(unittest.TestCase):
    def test_a_stack_under_its_weight(self):
        """Spheres of weight W on one another: a slice bears what lies above it over the area."""
        n, weight, radius, area = 6, 0.5, 0.1, 0.09
        centre = [[0, 0, (2 * k + 1) * radius] for k in range(n)]
        first, second = list(range(n)), [*range(1, n), 0]
        bodies = [-1 if k == n - 1 else second[k] for k in range(n)]
        start = [*centre[:-1], centre[0]]
        branch = [[0, 0, 2 * radius]] * (n - 1) + [[0, 0, -radius]]
        force = [[0, 0, -weight * (n - 1 - k)] for k in range(n - 1)] + [[0, 0, weight * n]]
        contacts = contacts_of([*first[:-1], 0], bodies, start, branch, force)
        low, high = np.array([-0.15, -0.15, 0]), np.array([0.15, 0.15, 2 * n * radius])
        slices = bergamo.stress_profile(contacts, low, high, "z", 2 * n)  # half a sphere each
        wanted = [-weight * (n - (k + 1) // 2) / area for k in range(2 * n)]
        np.testing.assert_allclose(slices[:, 2, 2], wanted, rtol=1e-12)
        np.testing.assert_allclose(slices[:, :2], 0, atol=1e-12)

    def test_shares_of_lines_in_a_box(self):
        low, high = np.zeros(3), np.array([1., 2., 3.])
        for start, branch, share in (([0.5, 1, 1], [0.2, 0, 0], 1), ([0.5, 1, 1], [1, 0, 0], 0.5),
                                     ([-1, 1, 1], [4, 0, 0], 0.25), ([-1, 1, 1], [0.5, 0, 0], 0),
                                     ([0.5, 5, 1], [1, 0, 0], 0), ([-0.5, -0.5, 1], [1, 1, 0], 0.5),
                                     ([1, 1, 1], [0, 0, 1], 0), ([0, 1, 1], [0, 0, 1], 1),
                                     ([0.5, 1, 4], [0, 0, -2], 0.5)):
            found = share_in_box(np.array([start], float), np.array([branch], float), low, high)
            np.testing.assert_allclose(found, share, atol=1e-15, err_msg=f"{start} {branch}")

    def test_uniform_stress_of_a_lattice(self):
        """Spheres on a cubic lattice with forces f along all bonds in a periodic cell: -f / a^2 everywhere."""
        n, edge, push = 3, 0.2, 4.
        first, second, start, branch, force = [], [], [], [], []
        for place in itertools.product(range(n), repeat=3):
            for axis in range(3):
                other = list(place)
                other[axis] = (other[axis] + 1) % n
                first.append(place[0] + n * place[1] + n * n * place[2])
                second.append(other[0] + n * other[1] + n * n * other[2])
                start.append((np.array(place) + 0.3) * edge)
                branch.append(edge * np.eye(3)[axis])
                force.append(-push * np.eye(3)[axis])
        contacts = contacts_of(first, second, start, branch, force, cell=np.full(3, n * edge))
        wanted = -push / edge ** 2 * np.eye(3)
        np.testing.assert_allclose(bergamo.stress(contacts), wanted, atol=1e-10)
        for low in ([0, 0, 0], [0.1, 0.05, 0.15], [0.5, 0.5, 0.5]):  # of the edge that repeats itself, also over a face
            box = bergamo.stress_in_box(contacts, low, np.array(low) + edge)
            np.testing.assert_allclose(box, wanted, atol=1e-10)

    def test_invariants(self):
        stress = np.diag([-1., -1., -4.]) + np.array([[0, 3., 0], [-3, 0, 0], [0, 0, 0]])  # skew: no part of the stress
        self.assertAlmostEqual(bergamo.pressure(stress), 2)
        self.assertAlmostEqual(bergamo.deviatoric_stress(stress), 3)
        np.testing.assert_allclose(bergamo.principal_stresses(stress), [-4, -1, -1])

    def test_arguments_that_make_no_sense(self):
        contacts = contacts_of([0], [1], [[0, 0, 0]], [[1, 0, 0]], [[-1, 0, 0]])
        for call, words in ((lambda: bergamo.stress(contacts), "no periodic cell"),
                            (lambda: bergamo.stress(contacts, 0), "is 0"),
                            (lambda: bergamo.stress_in_box(contacts, [0, 0, 0], [1, 0, 1]), "lower one first"),
                            (lambda: bergamo.stress_in_box(contacts, [0, 0, 0], [1, 1, 1], "all"), "'all'"),
                            (lambda: bergamo.stress_profile(contacts, [0, 0, 0], [1, 1, 1], "w"), "'w'")):
            with self.assertRaisesRegex(bergamo.BadArgument, words):
                call()


class Structure(unittest.TestCase):
    def test_fabric(self):
        axis = contacts_of([0, 0], [1, 2], np.zeros((2, 3)), [[0, 0, 1], [0, 0, -1]], np.zeros((2, 3)))
        np.testing.assert_allclose(bergamo.fabric_tensor(axis), np.diag([0, 0, 1]))
        random = np.random.default_rng(1)
        lines = random.normal(size=(100000, 3))
        zero, ids = np.zeros_like(lines), np.zeros(len(lines), int)
        even = contacts_of(ids, ids + 1, zero, lines, zero)
        fabric = bergamo.fabric_tensor(even)
        self.assertAlmostEqual(np.trace(fabric), 1)
        np.testing.assert_allclose(fabric, np.eye(3) / 3, atol=5 / np.sqrt(len(lines)))
        # Density (1 + a (n_z^2 - 1/3)) / 4 pi along an axis: F' = 2 a / 15 (e_z (x) e_z)', so the measure is a.
        a = 0.6
        normal = lines / np.linalg.norm(lines, axis=1, keepdims=True)
        kept = random.random(len(lines)) < (1 + a * (normal[:, 2] ** 2 - 1 / 3)) / (1 + a)
        self.assertAlmostEqual(bergamo.anisotropy(bergamo.fabric_tensor(even.where(kept))), a, delta=0.05)

    def test_coordination_and_rattlers(self):
        """Five grains that all touch one another, one that has four contacts until the last one, its fourth, comes off."""
        pairs = [*itertools.combinations(range(5), 2), (1, 5), (2, 5), (3, 5), (5, 6)]
        first, second = np.array(pairs).T
        ids = np.array([70, 60, 50, 40, 30, 20, 10])
        grains = grains_at(np.random.default_rng(2).random((7, 3)), 0.1, ids)
        place = grains.position
        contacts = contacts_of(ids[first], ids[second], place[first], place[second] - place[first],
                               np.zeros((len(pairs), 3)))
        numbers = bergamo.coordination_numbers(grains, contacts)
        self.assertEqual(numbers.of_grains.tolist(), [4, 5, 5, 5, 4, 4, 1])
        self.assertAlmostEqual(numbers.mean, 2 * len(pairs) / 7)
        self.assertAlmostEqual(numbers.deviation, np.std([4, 5, 5, 5, 4, 4, 1]))
        self.assertAlmostEqual(numbers.mechanical, 27 / 6)
        self.assertEqual(numbers.without_rattlers, 4)
        self.assertEqual(numbers.n_rattlers, 2)
        fixed = bergamo.Grains(0., ids, grains.position, grains.velocity, grains.volume,
                               {"mass": np.array([1, 1, 1, 1, 1, 1, np.inf])}, grains.shape)
        self.assertEqual(bergamo.coordination_numbers(fixed, contacts).n_rattlers, 0)  # the last one is a wall, and holds
        self.assertAlmostEqual(bergamo.coordination_numbers(fixed, contacts).mean, 27 / 6)

    def test_force_chains(self):
        """Random contacts: chains are what a search through the strong ones finds, and walls join nothing."""
        random = np.random.default_rng(3)
        n, k = 60, 80
        first = random.integers(0, n, k)
        second = (first + random.integers(1, n, k)) % n
        second[::7] = -1
        branch = random.normal(size=(k, 3))
        force = -random.exponential(size=(k, 1)) * branch / np.linalg.norm(branch, axis=1, keepdims=True)
        contacts = contacts_of(first, second, np.zeros((k, 3)), branch, force)
        chains = bergamo.force_chains(contacts)
        strong = np.flatnonzero(contacts.normal_force > contacts.normal_force.mean())
        self.assertEqual(np.flatnonzero(chains.is_strong).tolist(), strong.tolist())
        members = [({int(first[c])} | ({int(second[c])} - {-1}), {int(c)}) for c in strong]
        merged = True
        while merged:
            merged = False
            for a, b in itertools.combinations(range(len(members)), 2):
                if members[a][0] & members[b][0]:
                    members[a] = (members[a][0] | members[b][0], members[a][1] | members[b][1])
                    del members[b]
                    merged = True
                    break
        self.assertEqual(len(chains), len(members))
        self.assertEqual(sorted(chains.n_contacts.tolist(), reverse=True), chains.n_contacts.tolist())
        for grains, numbers in members:
            [chain] = set(chains.chain[list(numbers)].tolist())
            self.assertEqual(chains.n_contacts[chain], len(numbers))
            self.assertEqual(chains.n_grains[chain], len(grains))
        self.assertEqual((chains.chain >= 0).sum(), len(strong))
        self.assertAlmostEqual(chains.strong_share, contacts.normal_force[strong].sum() / contacts.normal_force.sum())
        self.assertEqual(len(bergamo.force_chains(contacts, 1e9)), 0)


class Space(unittest.TestCase):
    def test_a_sphere_in_a_box(self):
        grains = grains_at([[0.5, 0.5, 0.5]], 0.5)
        box = bergamo.Box(np.zeros(3), np.ones(3))
        self.assertAlmostEqual(bergamo.solid_fraction_in(grains, box, 100), np.pi / 6, delta=1e-3)
        self.assertAlmostEqual(bergamo.solid_fraction(grains, 2), np.pi / 12, delta=1e-12)
        half = bergamo.Box([0.5, 0, 0], [1.5, 1, 1])
        self.assertAlmostEqual(bergamo.solid_fraction_in(grains, half, 100), np.pi / 12, delta=1e-3)

    def test_images_of_a_periodic_cell(self):
        """A sphere at a corner of the cell is an eighth at each corner."""
        grains = grains_at([[0, 0, 0]], 0.5)
        box = bergamo.Box(np.zeros(3), np.ones(3))
        self.assertAlmostEqual(bergamo.solid_fraction_in(grains, box, 100), np.pi / 48, delta=1e-3)
        self.assertAlmostEqual(bergamo.solid_fraction_in(grains, box, 100, np.ones(3)), np.pi / 6, delta=1e-3)

    def test_shapes_that_are_turned(self):
        """The volume of a superquadric by counting points, and by Wellmann's formula."""
        half_axes, exponents = np.array([[0.5, 0.3, 0.2]]), np.array([[0.4, 1.6]])
        turn = np.array([[0.1, 0.5, -0.3, 0.8]]) / np.linalg.norm([0.1, 0.5, -0.3, 0.8])
        parts = shapes.Parts(np.array([0]), np.zeros((1, 3)), turn, half_axes, exponents)
        grains = bergamo.Grains(0., np.array([0]), np.zeros((1, 3)), np.zeros((1, 3)), parts.volume, {}, parts)
        counted = bergamo.solid_fraction_in(grains, bergamo.Box(np.full(3, -0.6), np.full(3, 0.6)), 120) * 1.2 ** 3
        self.assertAlmostEqual(counted / parts.volume[0], 1, delta=2e-3)
        self.assertAlmostEqual(shapes.volume(np.array([[1, 2, 3]]), np.ones((1, 2)))[0], 8 * np.pi, delta=1e-12)

    def test_sampling_spheres(self):
        """Two equal spheres a radius apart share 5 pi r^3 / 12; a lens of two sizes by its integral."""
        grains = grains_at([[1, 0, 0], [9, 9, 9]], 1.)
        share = bergamo.sampled_solid_fraction(grains, np.array([[0, 0, 0], [9, 9, 9], [5, 5, 5]]), 1.)
        np.testing.assert_allclose(share, [5 / 16, 1, 0], atol=1e-14)
        within = bergamo.sampled_solid_fraction(grains, np.array([[1.1, 0, 0]]), 0.5)
        np.testing.assert_allclose(within, 1)
        counted = bergamo.solid_fraction_in(grains, bergamo.Sphere(np.array([0.2, 0.1, 0]), 0.8), 150)
        sampled = bergamo.sampled_solid_fraction(grains, np.array([[0.2, 0.1, 0]]), 0.8)[0]
        self.assertAlmostEqual(counted, sampled, delta=2e-3)

    def test_profiles(self):
        """Means by volume: values that are a function of the height come back by slices; empty ones have none."""
        random = np.random.default_rng(4)
        place = random.random((500, 3)) * [1, 1, 2]
        place[place[:, 2] > 1.5, 2] -= 1.5
        grains = grains_at(place, 0.01 + 0.02 * random.random(500), speed=np.floor(place[:, 2] * 10))
        found = bergamo.profile(grains, "speed", "z", np.linspace(0, 2, 21))
        np.testing.assert_allclose(found.mean[:15], np.arange(15))
        self.assertTrue(np.isnan(found.mean[15:]).all())
        self.assertEqual(found.n_grains.sum(), 500)
        self.assertAlmostEqual(found.volume.sum(), grains.volume.sum())
        np.testing.assert_allclose(found.middle[:2], [0.05, 0.15])
        whole = bergamo.profile(grains, grains.position, 0, 1)
        np.testing.assert_allclose(whole.mean[0], (grains.position * grains.volume[:, None]).sum(axis=0) / grains.volume.sum())
        for wrong in ({"values": np.zeros(3)}, {"values": "speed", "slices": [1, 0]}, {"values": "speed", "slices": 0}):
            with self.assertRaises(bergamo.BadArgument):
                bergamo.profile(grains, **wrong)

    def test_errors_of_counting_points_fall(self):
        """Over places of a sphere, faster than the spacing."""
        places = np.random.default_rng(5).random((8, 3)) * 0.2 + 0.4
        errors = [max(abs(bergamo.solid_fraction_in(grains_at([place], 0.4), bergamo.Box(np.zeros(3), np.ones(3)), n)
                          - 4 / 3 * np.pi * 0.4 ** 3) for place in places) for n in (6, 24, 96)]
        self.assertLess(errors[1], errors[0] / 4)
        self.assertLess(errors[2], errors[1] / 4)


class Rotations(unittest.TestCase):
    def test_quaternions_and_matrices(self):
        random = np.random.default_rng(6)
        one, two = (rows / np.linalg.norm(rows, axis=1, keepdims=True) for rows in random.normal(size=(2, 200, 4)))
        np.testing.assert_allclose(rotation.matrices(rotation.products(one, two)),
                                   rotation.matrices(one) @ rotation.matrices(two), atol=1e-14)
        found = rotation.quaternions(rotation.matrices(one))
        np.testing.assert_allclose(found, one * np.sign(one[:, 3:]), atol=1e-14)
        quarter = np.array([[0, 0, np.sqrt(0.5), np.sqrt(0.5)]])  # about z, (x, y, z, w)
        np.testing.assert_allclose(rotation.matrices(quarter)[0] @ [1, 0, 0], [0, 1, 0], atol=1e-15)
        half = np.eye(3) * [[[1, -1, -1]], [[-1, 1, -1]], [[-1, -1, 1]]]  # w is 0
        np.testing.assert_allclose(np.abs(rotation.quaternions(half)), np.eye(4)[:3], atol=1e-15)


if __name__ == "__main__":
    unittest.main()
