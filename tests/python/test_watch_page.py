"""The page of `watch --page`: what it tells of a run, what it draws, and that nothing else gets out."""

import fcntl
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import threading
import unittest

import numpy as np
from small_runs import ROOT, FolderCase

import bergamo
from bergamo.page import HOST, Looks, PageServer
from bergamo.page.look import POINTS, thinned
from bergamo.page.picture import quadrilaterals_of
from bergamo.watch import Watch

HANGS_AFTER = 60  # s, of a program that takes a moment
SECRET = "nobody's business"
PNG = b"\x89PNG"


def hexahedra(heights):
    """A VTU of unit cubes above one another, each with points of its own, as drivers write them."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    points = " ".join(f"{x} {y} {z + height}" for height in heights for x, y, z in corners)
    n = len(heights)
    arrays = [("connectivity", " ".join(map(str, range(8 * n)))), ("offsets", " ".join(str(8 * (k + 1)) for k in range(n))),
              ("types", " ".join(["12"] * n))]
    cells = "".join(f'<DataArray type="Int64" Name="{name}" format="ascii">{text}</DataArray>' for name, text in arrays)
    return (f'<?xml version="1.0"?><VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="{8 * n}" '
            f'NumberOfCells="{n}"><Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">{points}'
            f"</DataArray></Points><Cells>{cells}</Cells></Piece></UnstructuredGrid></VTKFile>")


class Case(FolderCase):
    """A run by hand, "one", beside a file that is not of it."""

    def setUp(self):
        super().setUp()
        self.write("secret.txt", SECRET)
        self.write("one/parameters.prm", f"# {SECRET}\nsubsection Output\n  set samples = 10\nend\n")
        self.write("one/history.csv", "time_s,stage,force_N,zero_J\n0,1,0,0\n0.1,1,nan,0\n0.2,1,4,0\n")
        self.now = [0.]

    def serve(self, **options):
        self.looks = Looks(bergamo.open(self.tmp / "one"), Watch(None, clock=lambda: self.now[0], **options))
        server = PageServer(self.looks)
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        for step in (thread.join, server.shutdown, server.server_close):
            self.addCleanup(step)
        self.addCleanup(server.shutdown)
        self.port = server.server_port
        return server

    def get(self, target, method="GET", **headers):
        """As a program may ask, with an address that no browser has tidied up."""
        connection = http.client.HTTPConnection(HOST, self.port, timeout=HANGS_AFTER)
        try:
            connection.putrequest(method, target, skip_host="Host" in headers)
            for name, value in headers.items():
                connection.putheader(name, value)
            connection.endheaders()
            answer = connection.getresponse()
            return answer.status, answer.read()
        finally:
            connection.close()

    def look(self):
        status, content = self.get("/look.json")
        self.assertEqual(status, 200)
        return json.loads(content)

    def hold(self):
        lock = os.open(self.tmp / "one", os.O_RDONLY)
        fcntl.flock(lock, fcntl.LOCK_EX)
        return lock


class WhatIsTold(Case):
    def test_the_page_is_whole_in_itself(self):
        self.serve(interval=2.)
        status, content = self.get("/")
        self.assertEqual(status, 200)
        self.assertIn("INTERVAL = 1000 * 2.0", content.decode())
        addresses = re.findall(r"(?:https?:)?//[a-z][^\s\"'`]*", re.sub(r"(?m)\s// .*$", "", content.decode()))
        self.assertEqual(addresses, ["http://www.w3.org/2000/svg"])  # a name of XML: nothing is loaded from there

    def test_a_run_from_its_begin_to_its_end(self):
        lock = self.hold()
        self.serve()
        look = self.look()
        self.assertEqual(look["state"], "running")
        self.assertAlmostEqual(look["share"], 0.3)
        self.assertEqual(look["words"], ["t = 0.2 s", "row 3 of about 10"])
        force, = look["curves"]
        self.assertEqual((force["name"], force["unit"], force["last"]), ("force_N", "N", "4"))
        self.assertEqual((force["x"], force["y"]), ([0, 0.1, 0.2], [0, None, 4]))  # what is no number is a gap
        self.assertEqual(look["constant"], [{"name": "zero_J", "unit": "J", "last": "0"}])
        self.assertIsNone(look["picture"])

        with open(self.tmp / "one" / "history.csv", "a") as file:
            file.write("0.3,1,9,0\n0.4,2,1")  # the last one is not whole yet
        self.now[0] = 2.
        look = self.look()
        self.assertEqual(look["words"], ["t = 0.3 s", "row 4 of about 10", "12 s left"])  # a row in 2 s
        self.assertEqual(look["curves"][0]["y"][-1], 9)

        self.write("one/summary.json", '{"steps": 100, "wall_time_s": 75}')
        os.close(lock)
        look = self.look()
        self.assertEqual((look["state"], look["share"]), ("finished", 1))
        self.assertEqual(look["words"][-1], "finished in 1 min 15 s: steps = 100")

    def test_a_run_that_failed_and_a_table_that_is_damaged(self):
        self.serve()
        look = self.look()
        self.assertEqual((look["state"], look["words"][-1]), ("interrupted", "interrupted"))
        self.assertAlmostEqual(look["share"], 0.3)
        self.write("one/history.csv", "time_s,force_N\n0,1\n0,1,2\n0,3\n")
        self.assertIn("line 3 has 3 values", self.look()["trouble"][0])

    def test_columns_that_are_asked_for(self):
        self.serve(columns=["zero_J"])
        self.assertEqual([curve["name"] for curve in self.look()["curves"]], ["zero_J"])
        self.looks.watch.columns = ["froce_N"]
        self.assertIn("did you mean 'force_N'", self.look()["trouble"][0])

    def test_a_long_curve_keeps_its_peaks(self):
        values = np.sin(np.arange(100_000) / 5000.)
        values[[12_345, 54_321]] = 7, -7
        values[70_000:90_000] = np.nan
        rows = thinned(values, POINTS)
        self.assertLessEqual(len(rows), POINTS + 2)
        self.assertTrue({0, 12_345, 54_321, 99_999} <= set(rows))
        self.assertTrue((np.diff(rows) > 0).all())
        self.assertEqual(list(thinned(values[:5], POINTS)), [0, 1, 2, 3, 4])


class Pictures(Case):
    def test_the_last_picture(self):
        self.serve()
        status, content = self.get("/picture.png")
        self.assertEqual((status, b"has no picture" in content), (404, True))
        self.write("one/continuum_0000.vtu", hexahedra([0, 5]))
        first = self.look()["picture"]
        status, drawn = self.get("/picture.png")
        self.assertEqual((status, drawn[:4]), (200, PNG))
        self.write("one/continuum_0001.vtu", hexahedra([0, 1]))
        second = self.look()["picture"]
        self.assertEqual((first["name"], second["name"]), ("continuum_0000.vtu", "continuum_0001.vtu"))
        self.assertNotEqual(first["version"], second["version"])
        self.assertNotEqual(self.get("/picture.png")[1], drawn)
        self.write("one/continuum_0002.vtu", "<VTKFile")  # as if it were cut
        status, content = self.get("/picture.png")
        self.assertEqual((status, b"is damaged" in content), (404, True))

    def test_faces_between_elements_are_not_drawn(self):
        for heights, outer in (([0, 5], 12), ([0, 1], 10), ([0, 1, 2], 14)):
            mesh = bergamo.read_vtu(self.write("cubes.vtu", hexahedra(heights)))
            faces, cell = quadrilaterals_of(mesh)
            self.assertEqual(len(faces), outer)
            z = mesh.points[faces][:, :, 2]
            bottom = np.array(heights)[cell]
            self.assertTrue(((z.min(axis=1) >= bottom) & (z.max(axis=1) <= bottom + 1)).all())

    def test_diagrams_of_the_run(self):
        self.write("one/plots/curve.png", "a diagram")
        self.serve()
        self.assertEqual(self.look()["plots"], ["curve.png"])
        self.assertEqual(self.get("/plots/curve.png"), (200, b"a diagram"))


class NothingElse(Case):
    def test_no_other_file_gets_out(self):
        self.write("one/plots/curve.png", "a diagram")
        os.symlink(self.tmp / "secret.txt", self.tmp / "one" / "plots" / "link.png")
        os.symlink(self.tmp, self.tmp / "one" / "plots" / "up")
        self.serve()
        for target in ("/parameters.prm", "/history.csv", "/../secret.txt", "/plots/../parameters.prm", "/plots/link.png",
                       "/plots/%2e%2e/parameters.prm", "/plots/..%2fparameters.prm", "/plots/%2e%2e%2f%2e%2e%2fsecret.txt",
                       "/plots/up/secret.txt", f"/{self.tmp}/secret.txt", f"/plots/{self.tmp}/secret.txt", "/plots/",
                       "/plots/..\\parameters.prm", "//etc/passwd", "/plots/curve.png%00", "secret.txt", "/page.html",
                       f"/plots//{self.tmp}/one/plots/curve.png", "/..%252f..%252fsecret.txt"):
            status, content = self.get(target)
            self.assertEqual(status, 404, target)
            self.assertNotIn(SECRET.encode(), content)
            self.assertNotIn(b"root:", content)
        self.assertEqual(self.look()["plots"], ["curve.png"])

    def test_plots_that_lead_elsewhere(self):
        self.write("other/curve.png", SECRET)
        os.symlink(self.tmp / "other", self.tmp / "one" / "plots")
        self.serve()
        self.assertEqual(self.get("/plots/curve.png")[0], 404)

    def test_this_machine_alone(self):
        """Bound to one address: not even another one of the machine's own answers. A site whose name was made to lead
        here is told apart by that name."""
        server = self.serve()
        self.assertEqual(server.server_address[0], "127.0.0.1")
        with self.assertRaises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.2", self.port), timeout=HANGS_AFTER)
        for host in ("evil.example", f"evil.example:{self.port}", f"{HOST}:{self.port + 1}"):
            self.assertEqual(self.get("/look.json", Host=host)[0], 403)
        self.assertEqual(self.get("/look.json", Host=f"localhost:{self.port}")[0], 200)
        for method in ("POST", "PUT", "DELETE"):
            self.assertEqual(self.get("/", method)[0], 501)

    def test_a_browser_that_says_nothing_does_not_keep_others_out(self):
        self.serve()
        with socket.create_connection((HOST, self.port), timeout=HANGS_AFTER):
            self.assertEqual(self.look()["state"], "interrupted")


class TheProgram(Case):
    def start(self, *words):
        program = subprocess.Popen(
            ["/usr/bin/python3", "-B", "-m", "bergamo", "watch", "one", *words], text=True, cwd=self.tmp,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": str(ROOT / "drivers" / "python")})
        self.addCleanup(program.communicate)
        self.addCleanup(program.kill)
        return program

    def test_it_serves_until_ctrl_c(self):
        program = self.start("--page")
        found = re.fullmatch(r"one: http://127\.0\.0\.1:(\d+)/ \(Ctrl-C ends it\)\n", program.stdout.readline())
        self.port = int(found[1])
        self.assertEqual(self.look()["state"], "interrupted")
        taken = self.start("--page", "--port", found[1])
        self.assertRegex(taken.communicate(timeout=HANGS_AFTER)[1], rf"\Aerror: --port {found[1]}: .* in use; leave .*\n\Z")
        self.assertEqual(taken.returncode, 2)
        program.send_signal(signal.SIGINT)
        stdout, stderr = program.communicate(timeout=HANGS_AFTER)
        self.assertEqual((program.returncode, stdout, stderr), (0, "\n", ""))
        with self.assertRaises(ConnectionRefusedError):
            self.look()

    def test_mistakes(self):
        for words, text in ((["--page", "--port", "70000"], "--port 70000"), (["--port", "0"], "--port .* --page"),
                            (["--page", "--interval", "0"], "above 0")):
            program = self.start(*words)
            stderr = program.communicate(timeout=HANGS_AFTER)[1]
            self.assertRegex(stderr, f"\\Aerror: .*{text}.*\n\\Z")
            self.assertEqual(program.returncode, 2)


if __name__ == "__main__":
    unittest.main()
