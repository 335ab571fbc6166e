"""What simulations are made of, and what is refused."""

import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from engine_scenes import SOFT, loose, parameters
from small_runs import ROOT, FolderCase

import bergamo
from bergamo import engine

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
CUBE_FACES = np.array([(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6),
                       (0, 6, 4), (1, 5, 7), (1, 7, 3)])  # normals outwards


class Refused(unittest.TestCase):
    def refuse(self, words, call):
        with self.assertRaisesRegex(engine.ConfigError, words) as caught:
            call()
        self.assertIsInstance(caught.exception, (bergamo.Error, ValueError))


class Parameters(Refused):
    def test_laws_by_pair(self):
        hard, rough = engine.Material(1e9), engine.Law(0.9)
        given = engine.Parameters([SOFT, SOFT, hard], engine.Law(0.1), {(2, 0): rough})
        simulation = engine.Simulation(given, loose(1))
        back = simulation.parameters
        self.assertEqual(back.materials, (SOFT, SOFT, hard))
        self.assertEqual(back.laws[0, 2], rough)
        self.assertEqual(back.laws[1, 2], engine.Law(0.1))
        simulation.parameters = engine.Parameters(**{**vars(back), "gravity": (0, 0, -1), "time_step": 1e-6})
        self.assertEqual(simulation.parameters.gravity, (0, 0, -1))
        self.refuse("begin a new simulation", lambda: setattr(simulation, "parameters", engine.Parameters([hard] * 3)))
        self.assertEqual(simulation.parameters.time_step, 1e-6)

    def test_out_of_range(self):
        material, law = engine.Material, engine.Law
        for words, given in (("Young's modulus is -1: it must be positive", {"materials": [material(-1)]}),
                             ("Poisson's ratio is 0.5", {"materials": [material(poisson_ratio=0.5)]}),
                             ("friction coefficient is -1", {"law": law(-1)}), ("time step", {"time_step": 0}),
                             ("number of materials is 0", {"materials": []}), ("gravity", {"gravity": (0, 1)}),
                             ("gravity", {"gravity": "down"}), ("materials", {"laws": {(0, 5): law()}}),
                             ("two laws", {"laws": {(0, 1): law(0.1), (1, 0): law(0.2)}})):
            self.refuse(words, lambda: engine.Parameters(**given))

    def test_restitution(self):
        self.assertAlmostEqual(engine.restitution_of_ratio(engine.damping_ratio_of(0.6)), 0.6, delta=1e-8)
        time = engine.relaxation_time(0.7, 1e7, 1e-6, 0.5)
        self.assertAlmostEqual(engine.restitution(time, 1e7, 1e-6, 0.5), 0.7, delta=1e-8)
        self.refuse("restitution", lambda: engine.damping_ratio_of(2))


class Grains(Refused):
    def test_one_and_many(self):
        grains = engine.Grains()
        self.assertEqual(grains.add((0, 0, 1), 0.1), slice(0, 1))
        rows = grains.add(np.arange(9.).reshape(3, 3), (0.1, 0.2, 0.3), density=[1, 2, 4], quaternion=(0, 0, 3, 3))
        self.assertEqual((rows, len(grains)), (slice(1, 4), 4))
        np.testing.assert_allclose(grains["volume"], 4 / 3 * np.pi * np.array([1e-3, 6e-3, 6e-3, 6e-3]), rtol=1e-13)
        np.testing.assert_allclose(grains["mass"] / grains["volume"], [2650, 1, 2, 4], rtol=1e-13)
        np.testing.assert_allclose(grains["orientation"][1], [0, 0, 0.5**0.5, 0.5**0.5], rtol=1e-14)
        np.testing.assert_array_equal(grains.position[1:], np.arange(9.).reshape(3, 3))
        grains.add(np.zeros((0, 3)), 1)
        self.assertEqual(len(grains), 4)

    def test_refused_and_nothing_added(self):
        grains = engine.Grains()
        many = np.zeros((5, 3))
        for words, call in (
                (r"position has the shape \(5, 2\)", lambda: grains.add(np.zeros((5, 2)), 1)),
                (r"half_axes has the shape \(4, 3\)", lambda: grains.add(many, np.ones((4, 3)))),
                ("position is 'here': it must be numbers", lambda: grains.add("here", 1)),
                (r"density has the shape \(3,\): it must be one number or \(5,\)", lambda: grains.add(many, 1, density=[1, 2, 3])),
                ("half-ax", lambda: grains.add(many, [[1, 1, 1]] * 4 + [[1, -1, 1]])),
                ("exponent", lambda: grains.add(many, 1, exponents=(1, 2))),
                ("density of a grain is 0", lambda: grains.add(many, 1, density=0)),
                ("place of a grain", lambda: grains.add((0, 0, np.nan), 1)),
                ("quaternion|orientation", lambda: grains.add(many, 1, quaternion=(0, 0, 0, 0))),
                ("no array 'weights'", lambda: grains["weights"])):
            self.refuse(words, call)
            self.assertEqual(len(grains), 0)
        self.refuse("number of grains is 0", lambda: engine.Simulation(parameters(), grains))
        grains.add((0, 0, 0), 1, material=7)
        self.refuse("material", lambda: engine.Simulation(parameters(), grains))

    def test_clumps(self):
        """Two spheres that touch: volume and moments are sums, to the tolerance of the integrals."""
        clump = engine.Clump((1, 1, 1), [(-1, 0, 0), (1, 0, 0)])
        sphere = 4 / 3 * np.pi
        self.assertAlmostEqual(clump.volume, 2 * sphere, delta=1e-5)
        np.testing.assert_allclose(sorted(clump.inertia_per_density), sphere * np.array([0.8, 2.8, 2.8]), rtol=1e-5)
        small = clump.scaled(1e-3)
        self.assertAlmostEqual(small.bounding_radius, 2e-3, delta=1e-8)
        grains = engine.Grains()
        grains.add_clumps(small, [(0, 0, 0.01), (0, 0, 0.02)], density=1000)
        simulation = engine.Simulation(parameters(), grains, [engine.Plane()])
        simulation.step(10)
        self.assertEqual(len(simulation), 2)
        np.testing.assert_allclose(simulation.mass, 1000 * small.volume, rtol=1e-13)
        self.refuse("half_axes", lambda: engine.Clump((1, 1), [(0, 0, 0)]))

    def test_fixed_grains_hold_others(self):
        grains = engine.Grains()
        grains.add([(0, 0, 0), (0, 0, 1.9e-3)], 1e-3)
        grains.fix(0)
        simulation = engine.Simulation(parameters(law=engine.Law(0.4, 1.)), grains)
        simulation.run_until(0.2)
        row = {number: k for k, number in enumerate(simulation.id)}
        np.testing.assert_array_equal(simulation.position[row[0]], 0)
        self.assertTrue(np.isinf(simulation.mass[row[0]]))
        contacts = simulation.contacts()
        self.assertAlmostEqual(contacts.normal_force[0], 9.81 * simulation.mass[row[1]], delta=1e-3 * 9.81 * simulation.mass[row[1]])
        self.refuse("row of a grain|number of grains", lambda: grains._particles.fix(np.array([2])))
        with self.assertRaises(IndexError):
            grains.fix(2)


class Bodies(Refused, FolderCase):
    def test_planes(self):
        box = engine.box_planes((0, 0, 0), (1, 2, 3))
        self.assertEqual([plane.normal for plane in box[:2]], [(1, 0, 0), (-1, 0, 0)])
        self.refuse("normal", lambda: engine.Simulation(parameters(), loose(1), [engine.Plane(normal=(0, 0, 2))]))
        self.refuse("corners", lambda: engine.box_planes((0, 0, 0), (1, 1, 0)))
        simulation = engine.Simulation(parameters(), loose(1), box)
        simulation.set_plane_velocity(5, (0, 0, -1))
        simulation.step(10)
        self.assertAlmostEqual(simulation.planes[5].point[2], 3 - 2e-4, delta=1e-13)
        moving = engine.Simulation(parameters(), loose(1), [engine.Plane((0, 0, 3), (0, 0, -1), velocity=(0, 0, -1))])
        moving.step(10)
        self.assertAlmostEqual(moving.planes[0].point[2], 3 - 2e-4, delta=1e-13)
        simulation.remove_plane(0)
        self.assertEqual(len(simulation.planes), 5)
        for call in (simulation.remove_plane, lambda k: simulation.set_plane_velocity(k, (0, 0, 0)), simulation.plane_force):
            for number in (5, -1):
                self.refuse(f"is {number}", lambda: call(number))
        self.refuse("velocity of a plane", lambda: simulation.set_plane_velocity(0, (0, 0, np.inf)))

    def test_surfaces_from_arrays(self):
        surface = engine.Surface(CUBE, CUBE_FACES, offset=0.1, is_rigid=True)
        np.testing.assert_array_equal(surface.triangles, CUBE_FACES)
        np.testing.assert_array_equal(surface.nodes, CUBE)
        self.assertEqual((surface.offset, surface.is_rigid, surface.material), (0.1, True, engine.WALL))
        for words, nodes, triangles in ((r"nodes has the shape", CUBE[:, :2], CUBE_FACES), ("triangles", CUBE, CUBE_FACES + 1),
                                        ("triangles", CUBE, CUBE_FACES + 0.5), ("edge", CUBE, [(0, 1, 3), (0, 1, 2), (0, 1, 5)])):
            self.refuse(words, lambda: engine.Surface(nodes, triangles))
        self.refuse("area", lambda: engine.Simulation(parameters(), loose(1), (), [engine.Surface(CUBE * 0, [(0, 1, 2)])]))

    def test_surfaces_that_move(self):
        """A rigid cube under one grain, lifted: the grain rises with it and bears on it with its weight."""
        grains = engine.Grains()
        grains.add((5e-3, 5e-3, 0.01 + 0.99e-3), 1e-3)
        cube = engine.Surface(0.01 * CUBE, CUBE_FACES, is_rigid=True)
        simulation = engine.Simulation(parameters(law=engine.Law(0.4, 1.)), grains, (), [cube])
        simulation.set_surface_velocity(0, (0, 0, 0.02))
        simulation.run_until(0.1)
        self.assertAlmostEqual(simulation.surfaces[0].nodes[0, 2], 0.02 * simulation.time, delta=1e-12)
        weight = 9.81 * simulation.mass[0]
        np.testing.assert_allclose(simulation.surface_forces, [[0, 0, -weight]], atol=1e-3 * weight)
        np.testing.assert_allclose(simulation.node_forces(0).sum(axis=0), simulation.surface_forces[0], atol=1e-12 * weight)
        np.testing.assert_allclose(simulation.surface_moments[0], np.cross((5e-3, 5e-3, 0), (0, 0, -weight)), atol=1e-5 * weight)
        simulation.set_surface_velocity(0, None)
        simulation.remove_surface(0)
        self.assertEqual(simulation.surfaces, [])
        self.refuse("surface", lambda: simulation.remove_surface(0))

    def test_surfaces_from_files(self):
        lines = ["solid cube"]
        for face in CUBE_FACES:
            corners = "".join("vertex {} {} {}\n".format(*CUBE[k]) for k in face)
            lines.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet")
        path = self.write("cube.stl", "\n".join([*lines, "endsolid cube"]) + "\n")
        surface = engine.read_surface(path, unit=1e-3, use="body")
        self.assertEqual((len(surface.nodes), len(surface.triangles)), (8, 12))
        self.assertEqual(surface.nodes.max(), 1e-3)
        self.refuse("cube.stl", lambda: engine.read_surface(path, use="vessel"))
        self.refuse("use of a surface is 'bowl'", lambda: engine.read_surface(path, use="bowl"))
        self.refuse("nothing.stl", lambda: engine.read_surface(self.tmp / "nothing.stl"))


class Packings(Refused):
    def test_grains_lie_inside_and_make_up_the_fraction(self):
        sizes = engine.UniformSizes(1e-3, 1.2e-3, elongation=1., angularity=0.)
        packing = engine.pack(sizes, engine.Space.cylinder((0, 0, 0), 4e-3, 8e-3), solid_fraction=0.45)
        grains = packing.grains
        self.assertTrue(packing.has_reached_target)
        self.assertAlmostEqual(grains["volume"].sum() / (np.pi * 16e-6 * 8e-3), 0.45, delta=1e-3)
        radius = grains["bounding_radius"]
        self.assertTrue((np.hypot(*grains.position.T[:2]) + radius <= 4e-3 * (1 + 1e-9)).all())
        apart = np.linalg.norm(grains.position[:, None] - grains.position, axis=2) - radius[:, None] - radius
        self.assertGreaterEqual(apart[~np.eye(len(grains), dtype=bool)].min(), -1e-9 * radius.max())
        again = engine.pack(sizes, engine.Space.cylinder((0, 0, 0), 4e-3, 8e-3), solid_fraction=0.45)
        np.testing.assert_array_equal(grains.position, again.grains.position)

    def test_spaces_and_gradings(self):
        clump = engine.Clump((1, 1, 1), [(-1, 0, 0), (1, 0, 0)])
        octant = engine.Space.polyhedron([(-1, 0, 0), (0, -1, 0), (0, 0, -1), (1, 1, 1)], [0, 0, 0, 0.012])
        for sizes, space, options in ((engine.GaussianSizes(), octant, {}),
                                      (engine.SieveCurve([(0.8e-3, 0.), (1e-3, 0.6), (1.2e-3, 1.)]),
                                       engine.Space.box((0, 0, 0), (6e-3, 6e-3, 6e-3)), {}),
                                      (engine.UniformSizes(), engine.Space.periodic((6e-3, 6e-3, 6e-3)), {"clump": clump})):
            packing = engine.pack(sizes, space, solid_fraction=0.2, **options)
            self.assertAlmostEqual(packing.solid_fraction, 0.2, delta=1e-3)
        np.testing.assert_array_equal(packing.grains.cell, [6e-3] * 3)

    def test_refused(self):
        box = engine.Space.box((0, 0, 0), (0.01, 0.01, 0.01))
        sizes = engine.UniformSizes()
        for words, call in (("solid fraction", lambda: engine.pack(sizes, box, solid_fraction=0.9)),
                            ("edge|box", lambda: engine.pack(sizes, engine.Space.box((0, 0, 0), (1, 1, -1)))),
                            ("lower corner", lambda: engine.pack(sizes, engine.Space.box((0, 0), (1, 1, 1)))),
                            ("elongation", lambda: engine.pack(engine.UniformSizes(elongation=0.5), box)),
                            ("seed", lambda: engine.pack(sizes, box, seed=-1)),
                            ("offsets", lambda: engine.pack(sizes, engine.Space.polyhedron([(1, 0, 0)], [1, 2]))),
                            ("whole grains|too small", lambda: engine.pack(sizes, engine.Space.box((0, 0, 0), (1e-3,) * 3)))):
            self.refuse(words, call)

    def test_a_periodic_cell_under_pressure(self):
        packing = engine.pack(engine.UniformSizes(1e-3, 1.2e-3, 1., 0.), engine.Space.periodic((6e-3,) * 3), solid_fraction=0.5)
        simulation = engine.Simulation(parameters(gravity=(0, 0, 0), time_step=1e-5), packing.grains)
        loading = engine.Loading(pressure=2e3, friction=0.2, time_step=1e-5, inertial_number=1e-2, stress_tolerance=0.02)
        self.assertGreater(simulation.load_cell(loading), 0)
        np.testing.assert_allclose(simulation.cell_stress, [-2e3] * 3, rtol=0.03)
        volume = simulation.cell.prod()
        np.testing.assert_allclose(np.diag(bergamo.stress(simulation.contacts(), volume)), simulation.cell_stress, rtol=1e-9)
        self.assertLess(volume, 0.99 * 6e-3**3)
        simulation.cell_rate = 0, 0, 0
        edges = simulation.cell
        simulation.step(100)
        np.testing.assert_array_equal(simulation.cell, edges)
        simulation.cell_rate = 0, 0, -1e-3
        simulation.step(100)
        np.testing.assert_allclose(simulation.cell - edges, [0, 0, -1e-3 * 100 * simulation.parameters.time_step], atol=1e-12)
        self.refuse("rate of the periodic cell", lambda: setattr(simulation, "cell_rate", (0, 0)))
        self.refuse("wall 0 .*along z", lambda: simulation.add_plane(engine.Plane()))
        self.refuse("path of a loading is 'up'", lambda: simulation.load_cell(engine.Loading(path="up")))
        box = engine.Simulation(parameters(), loose(1))
        for call in (lambda: box.load_cell(loading), lambda: box.cell_stress, lambda: setattr(box, "cell_rate", (0, 0, 0))):
            self.refuse("periodic cell", call)
        self.refuse("six", lambda: box.compress_box(engine.Compression()))

    def test_a_cell_that_repeats_itself_along_one_axis(self):
        packing = engine.pack(engine.UniformSizes(1e-3, 1.2e-3, 1., 0.),
                              engine.Space.periodic((6e-3, 5e-3, 5e-3), repeats=(True, False, False)), solid_fraction=0.3)
        np.testing.assert_array_equal(packing.grains.cell, [6e-3, np.inf, np.inf])
        packing.grains.cell = 6e-3, None, None
        np.testing.assert_array_equal(packing.grains.cell, [6e-3, np.inf, np.inf])
        sides = engine.box_planes((0,) * 3, (6e-3, 5e-3, 5e-3))
        simulation = engine.Simulation(parameters(time_step=1e-5), packing.grains, sides[2:])
        simulation.velocity[:] = 0.2, 0., 0.
        simulation.step(6000)
        self.assertLess(np.ptp(simulation.position[:, 0]), 7e-3)  # put back into the cell
        np.testing.assert_array_equal(simulation.cell, [6e-3, np.inf, np.inf])
        contacts = simulation.contacts()
        np.testing.assert_array_equal(contacts.cell, simulation.cell)
        with self.assertRaisesRegex(bergamo.Error, "volume"):
            bergamo.stress(contacts)
        self.refuse("wall 4 .*along x", lambda: simulation.add_plane(sides[0]))
        self.refuse("three finite edges", lambda: simulation.cell_stress)
        self.refuse("three finite edges", lambda: simulation.load_cell(engine.Loading(pressure=1e3)))
        self.refuse("rate of a periodic cell along y", lambda: setattr(simulation, "cell_rate", (0, 1, 0)))
        self.refuse("keeps its edges", lambda: setattr(simulation, "cell_rate", (1, 0, 0)))
        self.refuse("gravity .*along x", lambda: engine.Simulation(parameters(gravity=(1, 0, 0)), packing.grains))
        self.refuse("give three values", lambda: engine.Space.periodic((1, 1, 1), repeats=(False,) * 3))

    def test_a_box_under_pressure(self):
        packing = engine.pack(engine.UniformSizes(1e-3, 1.2e-3, 1., 0.), engine.Space.box((0,) * 3, (6e-3,) * 3), solid_fraction=0.5)
        simulation = engine.Simulation(parameters(gravity=(0, 0, 0), time_step=1e-5, law=engine.Law(0., 0.3)), packing.grains,
                                       engine.box_planes((0,) * 3, (6e-3,) * 3))
        simulation.compress_box(engine.Compression(pressure=1e3, pressure_tolerance=0.05, force_tolerance=0.05))
        force = np.array([simulation.plane_force(k) for k in range(6)])
        edges = [plane.point[k // 2] for k, plane in enumerate(simulation.planes)]
        edges = np.diff(np.reshape(edges, (3, 2)), axis=1).ravel()
        for axis in range(3):
            area = edges.prod() / edges[axis]
            self.assertAlmostEqual(0.5 * (force[2 * axis + 1] - force[2 * axis])[axis] / area, 1e3, delta=100)
        again = engine.Compression(pressure=1e6, longest_time=simulation.time)
        with self.assertRaisesRegex(engine.RunError, "did not come to rest"):
            simulation.compress_box(again)
        simulation.step(1)  # it failed between two steps


class NotBuilt(FolderCase):
    def test_the_target_to_build_is_named(self):
        program = "import bergamo\ntry:\n  import bergamo.engine\nexcept ImportError as error:\n  print(error)"
        result = subprocess.run([sys.executable, "-B", "-c", program], capture_output=True, text=True, check=True,
                                env={"PYTHONPATH": str(ROOT / "drivers" / "python"), "BERGAMO_BUILD": str(self.tmp)})
        self.assertIn("build the target bergamo_engine", result.stdout)
        self.assertIn(str(self.tmp), result.stdout)
        other = self.write("drivers/python/_engine.cpython-23-x.so", "")
        self.assertTrue(Path(other).exists())
        result = subprocess.run([sys.executable, "-B", "-c", program], capture_output=True, text=True, check=True,
                                env={"PYTHONPATH": str(ROOT / "drivers" / "python"), "BERGAMO_BUILD": str(self.tmp)})
        self.assertIn("there is _engine.cpython-23-x.so, of another Python", result.stdout)


if __name__ == "__main__":
    unittest.main()
