"""What `python3 -m bergamo export` writes, beside the grains that it was given; and read by a driver again."""

import contextlib
import io
import unittest
from unittest import mock

import numpy as np
from small_runs import FolderCase, run_of, stopped_run_of

import bergamo
from bergamo import __main__ as program
from bergamo import export, rotation
from bergamo.export import paraview, tessellation
from bergamo.shapes import Parts, inside_outside, volume


def grains_by_hand(n=40, material=True):
    """Turned superquadrics of sizes one to six, exponents on the grid of the glyphs."""
    random = np.random.default_rng(3)
    half_axes = np.geomspace(1e-3, 6e-3, n)[:, None] * random.uniform(0.6, 1., (n, 3))
    exponents = random.choice([0.3, 0.6, 1., 1.5], (n, 2))
    turn = rotation.quaternions(rotation.matrices(normed(random.standard_normal((n, 4)))))
    centre = random.uniform(-1 / 3, 1 / 3, (n, 3))
    parts = Parts(np.arange(n), centre, turn, half_axes, exponents, np.arange(n) % 2 if material else None)
    return bergamo.Grains(0.1, np.arange(n) + 10, centre, random.standard_normal((n, 3)), volume(half_axes, exponents),
                          {"pressure": random.uniform(0, 1, n)}, parts)


def normed(rows):
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def columns(lines, names, separator=None):
    """Columns of texts by name."""
    return {name: np.array(values) for name, values in zip(names, zip(*(line.split(separator) for line in lines)))}


def numbers(table, *names):
    return np.stack([table[name].astype(float) for name in names], axis=1)


class Tables(FolderCase):
    def test_grains_come_back_to_the_last_digit(self):
        grains = grains_by_hand()
        table = bergamo.read_table(export.write_grains(grains, self.tmp / "grains.csv"))
        self.assertEqual(table.names, ["id", "x_m", "y_m", "z_m", "qx", "qy", "qz", "qw", "a_m", "b_m", "c_m", "exponent_1",
                                       "exponent_2", "material"])
        for names, values in ((("x_m", "y_m", "z_m"), grains.position), (("qx", "qy", "qz", "qw"), grains.quaternion),
                              (("a_m", "b_m", "c_m"), grains.half_axes), (("exponent_1", "exponent_2"), grains.exponents)):
            np.testing.assert_array_equal(np.stack([table[name] for name in names], axis=1), values)
        np.testing.assert_array_equal(table["id"], grains.id)
        np.testing.assert_array_equal(table["material"], grains.parts.material)
        self.assertEqual([path.name for path in self.tmp.iterdir()], ["grains.csv"])  # nothing half written
        without = export.write_grains(grains_by_hand(material=False), self.tmp / "picture.csv")
        self.assertNotIn("material", bergamo.read_table(without).names)

    def test_parts_of_a_clump_have_its_id(self):
        one = grains_by_hand(4)
        parts = Parts(np.array([0, 0, 0, 1]), one.position, one.quaternion, one.half_axes, one.exponents)
        clumps = bergamo.Grains(0., np.array([7, 3]), one.position[:2], one.velocity[:2], one.volume[:2], {}, parts)
        self.assertEqual(list(bergamo.read_table(export.write_grains(clumps, self.tmp / "c.csv"))["id"]), [7, 7, 7, 3])
        lines = export.write_dump(clumps, self.tmp / "c.dump").read_text().splitlines()
        table = columns(lines[11:], lines[10].split()[2:])
        self.assertEqual((list(table["id"]), list(table["mol"])), (list("0123"), list("7773")))

    def test_a_snapshot_through_a_driver(self):
        """Grains of a stopped run, as a table, settle in another run: the same shapes, ids and masses to the last bit."""
        before = bergamo.open(stopped_run_of("penetration", "history.csv", 5)).snapshot()
        path = export.write_grains(before.grains, self.tmp / "grains.csv")
        after = bergamo.open(stopped_run_of("penetration", "history.csv", 5, f"Sand/grains file={path}",
                                            "Sand/Settling/time=1.2e-4")).snapshot().grains
        rows = after.rows_of(before.grains.id)
        np.testing.assert_array_equal(after.half_axes[rows], before.grains.half_axes)
        np.testing.assert_array_equal(after.exponents[rows], before.grains.exponents)
        np.testing.assert_array_equal(after["mass"][rows], before.grains["mass"])
        self.assertLess(np.abs(after.position[rows] - before.grains.position).max(), 2e-3)

    def test_contacts(self):
        contacts = bergamo.open(stopped_run_of("penetration", "history.csv", 5)).snapshot().contacts
        table = bergamo.read_table(export.write_contacts(contacts, self.tmp / "contacts.csv"))
        self.assertGreater(table.n_rows, 100)
        for names, values in ((("x_m", "y_m", "z_m"), contacts.point), (("nx", "ny", "nz"), contacts.normal),
                              (("bx_m", "by_m", "bz_m"), contacts.branch), (("fx_N", "fy_N", "fz_N"), contacts.force),
                              (("tx_N", "ty_N", "tz_N"), contacts.tangential_force)):
            np.testing.assert_array_equal(np.stack([table[name] for name in names], axis=1), values)
        for name, values in (("first", contacts.first), ("second", contacts.second), ("overlap_m", contacts.overlap),
                             ("normal_force_N", contacts.normal_force), ("wall", contacts["wall"]),
                             ("feature", contacts["feature"])):
            np.testing.assert_array_equal(table[name], values)

    def test_a_kind_of_contact_that_has_none_yet(self):
        snapshot = bergamo.open(stopped_run_of("penetration", "history.csv", 5)).snapshot()
        position, nothing = snapshot.grains.position, np.zeros(0, dtype=np.int64)
        group = {"pair": nothing, "first": nothing, "second": nothing, "image": nothing, "state": np.zeros(0)}
        with mock.patch.object(type(snapshot), "arrays", lambda *_: group):
            for kind in ("grain_grain", "sphere_sphere", "grain_plane", "grain_surface"):
                found = snapshot._contacts_of(kind, 0, position, np.zeros(3))
                self.assertEqual(found["tangential_force"].shape, (0, 3), kind)


class Ovito(FolderCase):
    def test_a_dump_has_the_names_of_ovitos_properties(self):
        grains = grains_by_hand()
        lines = export.write_dump(grains, self.tmp / "grains.dump").read_text().splitlines()
        self.assertEqual([lines[k] for k in (0, 2, 4, 6)], ["ITEM: TIME", "ITEM: TIMESTEP", "ITEM: NUMBER OF ATOMS",
                                                            "ITEM: BOX BOUNDS ff ff ff"])
        self.assertEqual((float(lines[1]), int(lines[5])), (0.1, len(grains)))
        self.assertTrue(lines[10].startswith("ITEM: ATOMS id type "))
        table = columns(lines[11:], lines[10].split()[2:])
        for names, values in ((("x", "y", "z"), grains.position), (("vx", "vy", "vz"), grains.velocity),
                              ([f"AsphericalShape.{x}" for x in "XYZ"], grains.half_axes),
                              ([f"Orientation.{x}" for x in "XYZW"], grains.quaternion),  # the scalar comes last
                              ([f"SuperquadricRoundness.{x}" for x in ("Phi", "Theta")], grains.exponents)):
            np.testing.assert_array_equal(numbers(table, *names), values)
        np.testing.assert_array_equal(table["id"].astype(int), grains.id)
        np.testing.assert_array_equal(table["type"].astype(int), grains.parts.material + 1)
        low, high = np.array([line.split() for line in lines[7:10]], dtype=float).T
        points, _ = tessellation.tessellated(grains.parts, 6)
        self.assertTrue((points >= low).all() and (points <= high).all())

    def test_extended_xyz_and_a_periodic_cell(self):
        grains, cell = grains_by_hand(), np.array([0.5, 0.25, 2.])
        lines = export.write_xyz(grains, self.tmp / "grains.xyz", cell).read_text().splitlines()
        self.assertEqual(int(lines[0]), len(grains))
        self.assertIn('Lattice="0.5 0 0 0 0.25 0 0 0 2" Origin="0 0 0" Properties=', lines[1])
        self.assertIn('pbc="T T T"', lines[1])
        fields = lines[1].split("Properties=")[1].split()[0].split(":")
        names = [f"{name}{k}" for name, n in zip(fields[::3], fields[2::3]) for k in range(int(n))]
        table = columns(lines[2:], names)
        for name, values in (("pos", grains.position), ("velo", grains.velocity), ("aspherical_shape", grains.half_axes),
                             ("orientation", grains.quaternion), ("SuperquadricRoundness", grains.exponents)):
            np.testing.assert_array_equal(numbers(table, *(f"{name}{k}" for k in range(values.shape[1]))), values)
        self.assertIn("BOX BOUNDS pp pp pp\n0 0.5\n0 0.25\n0 2\n",
                      export.write_dump(grains, self.tmp / "cell.dump", cell).read_text())


class ForParaView(FolderCase):
    def read(self, reader, path):
        from vtkmodules import vtkIOXML
        reader = getattr(vtkIOXML, reader)()
        reader.SetFileName(str(path))
        reader.Update()
        return reader.GetOutput()

    def test_surfaces_are_closed_and_lie_on_the_grains(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        grains = grains_by_hand()
        data = self.read("vtkXMLPolyDataReader", export.write_surfaces(grains, self.tmp / "surfaces.vtp"))
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
        offsets = vtk_to_numpy(data.GetPolys().GetOffsetsArray())
        ids, pressure = (vtk_to_numpy(data.GetCellData().GetArray(name)) for name in ("id", "pressure"))
        sizes = []
        for k, number in enumerate(grains.id):
            faces = [corners[offsets[f]:offsets[f + 1]] for f in np.flatnonzero(ids == number)]
            edges = {(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1))}
            self.assertEqual(len(edges), sum(map(len, faces)))  # none twice in one direction
            self.assertEqual(edges, {(b, a) for a, b in edges})  # each has its neighbour
            triangles = np.array([(face[0], face[j], face[j + 1]) for face in faces for j in range(1, len(face) - 1)])
            a, b, c = (points[triangles[:, j]] - grains.position[k] for j in range(3))
            share = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 / grains.volume[k]
            self.assertTrue(0.5 < share < 1, share)  # outwards, and inscribed but where it is hollow
            turn = rotation.matrices(grains.quaternion[k:k + 1])[0]
            used = points[np.unique(np.concatenate(faces))]
            on = inside_outside((used - grains.position[k]) @ turn, grains.half_axes[k], grains.exponents[k])
            self.assertLess(np.abs(on ** (grains.exponents[k, 1] / 2) - 1).max(), 1e-3)  # by scale, of single precision
            self.assertLess(np.abs(pressure[ids == number] - grains["pressure"][k]).max(), 1e-6)
            sizes.append(len(faces))
        self.assertEqual(sizes[int(grains.half_axes.max(axis=1).argmax())], 288)
        self.assertEqual(sizes[int(grains.half_axes.max(axis=1).argmin())], 32)

    def test_more_steps_come_nearer(self):
        one = grains_by_hand(1).parts
        shares = []
        for steps in (2, 4, 8):
            points, faces = tessellation.tessellated(one, steps)
            a, b, c, d = (points[0, faces[:, j]].astype(float) - one.centre for j in range(4))
            shares.append(sum(np.einsum("ij,ij->i", p, np.cross(q, r)).sum() / 6 for p, q, r in ((a, b, c), (a, c, d)))
                          / one.volume[0])
        self.assertTrue(shares[0] < shares[1] < shares[2] < 1, shares)
        self.assertLess(1 - shares[2], 0.4 * (1 - shares[1]))

    def test_a_glyph_drawn_as_paraview_does_is_the_grains_surface(self):
        """Stretched by half_axes, turned by the quaternion in the order w, x, y, z, moved to the point."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        grains = grains_by_hand()
        files = export.write_glyphs(grains, self.tmp)
        self.assertEqual([file.name for file in files], ["glyphs.vtp", "shapes.vtm", "show_glyphs.py"])
        data, shapes = self.read("vtkXMLPolyDataReader", files[0]), self.read("vtkXMLMultiBlockDataReader", files[1])
        array = {name: vtk_to_numpy(data.GetPointData().GetArray(name)).astype(float)
                 for name in ("half_axes", "quaternion", "shape", "id")}
        centre = vtk_to_numpy(data.GetPoints().GetData())
        kinds = {tuple(row) for row in grains.exponents}
        self.assertEqual(shapes.GetNumberOfBlocks(), len(kinds))
        expected, _ = tessellation.tessellated(grains.parts, paraview.GLYPH_STEPS)
        turns = rotation.matrices(array["quaternion"][:, [1, 2, 3, 0]])
        for k in range(len(grains)):
            shape = vtk_to_numpy(shapes.GetBlock(int(array["shape"][k])).GetPoints().GetData())
            drawn = (shape * array["half_axes"][k]) @ turns[k].T + centre[k]
            self.assertLess(np.abs(drawn - expected[k]).max(), 1e-6 * grains.half_axes[k].max() + 1e-7)
        np.testing.assert_array_equal(array["id"], grains.id)

    def test_exponents_between_the_shapes_go_to_the_nearest(self):
        from dataclasses import replace
        grains = grains_by_hand(3)
        exponents = np.array([[0.64, 1.], [0.01, 1.99], [1.26, 0.849]])
        grains = replace(grains, shape=replace(grains.parts, exponents=exponents))
        with mock.patch.object(paraview, "write_shapes") as write:
            write.side_effect = lambda kinds, path, steps: path
            export.write_glyphs(grains, self.tmp)
        kinds = {tuple(row) for row in np.round(write.call_args.args[0], 9)}
        self.assertEqual(kinds, {(0.6, 1.), (0.1, 1.9), (1.3, 0.8)})


class Program(FolderCase):
    def run_program(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            status = program.main(["export", *map(str, words), "--output", str(self.tmp / "out")])
        return status, out.getvalue(), err.getvalue()

    def test_the_last_picture_of_a_finished_run(self):
        folder = run_of("penetration")
        status, out, err = self.run_program(folder, "--as", "csv,dump,xyz,surfaces,glyphs,chains")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("grains_0001.vtu: 312 grains at 0.042 s", out)
        names = {path.name for path in (self.tmp / "out").iterdir()}
        self.assertEqual(names, {"grains.csv", "contacts.csv", "grains.dump", "grains.xyz", "surfaces.vtp", "glyphs.vtp",
                                 "shapes.vtm", "shapes", "show_glyphs.py", "force_chains.py"})
        contacts = bergamo.open(folder).pictures["contacts"][-1]
        for name in ("show_glyphs.py", "force_chains.py"):
            lines = (self.tmp / "out" / name).read_text().splitlines()
            settings = [line for line in lines if line.split(" = ")[0].isupper()]
            scope = {}
            exec("\n".join(settings), scope)
            self.assertNotIn(None, scope.values(), name)
            compile("\n".join(lines), name, "exec")
        self.assertEqual(scope["MEAN_FORCE"], contacts.normal_force.mean())
        self.assertEqual(scope["CONTACTS"], str((folder / "contacts.pvd").resolve()))
        self.assertEqual(self.run_program(folder, "--picture", "0", "--as", "csv")[0], 0)

    def test_a_snapshot(self):
        path = stopped_run_of("penetration", "history.csv", 5) / "snapshot.h5"
        status, out, err = self.run_program(path)
        self.assertEqual((status, err), (0, ""))
        table = bergamo.read_table(self.tmp / "out" / "grains.csv")
        np.testing.assert_array_equal(table["x_m"], bergamo.Snapshot(path).grains.position[:, 0])
        np.testing.assert_array_equal(table["material"], np.zeros(312))
        self.assertIn(f"{path}: 312 grains at ", out)

    def test_what_is_refused(self):
        folder = run_of("penetration")
        for words, text in (((folder, "--as", "dmup"), "there is no format 'dmup'; did you mean 'dump'"),
                            ((folder, "--picture", "7"), "has 2 pictures of grains; --picture is 7"),
                            ((folder, "--as", "surfaces", "--steps", "3"), "are 3; give an even number"),
                            ((self.tmp / "none",), "no such folder of a run")):
            status, _, err = self.run_program(*words)
            self.assertEqual(status, 2, words)
            self.assertIn(text, err)
        self.assertFalse((self.tmp / "out" / "surfaces.vtp").exists())


if __name__ == "__main__":
    unittest.main()
