"""The documentation site is built without a warning, and its checks see links, commands and excerpts that are wrong."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from small_runs import ROOT, FolderCase

SITE = ROOT / "docs" / "site"
sys.path.insert(0, str(SITE))

import check_commands  # noqa: E402
import check_commits  # noqa: E402
import check_formulas  # noqa: E402
import check_links  # noqa: E402
import parameters  # noqa: E402
import text  # noqa: E402
import tree  # noqa: E402


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="bergamo site ")
        cls.done = subprocess.run(["/usr/bin/python3", "-B", SITE, "--no-cpp", "--output", cls.folder.name],
                                  capture_output=True, text=True)
        cls.html = Path(cls.folder.name) / "html"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_is_built_without_a_mistake(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        self.assertIn(str(self.html / "index.html"), self.done.stdout)

    def test_every_page_of_the_repository_is_on_it(self):
        for source in tree.pages():
            self.assertTrue((self.html / tree.place_of(source)).with_suffix(".html").exists(), source)

    def test_every_driver_has_its_parameters_and_a_card_on_the_front(self):
        front = (self.html / "index.html").read_text()
        for driver in tree.drivers():
            self.assertIn(f'<a class="card" href="examples/{driver}.html">', front)
            page = (self.html / "examples" / f"{driver}.html").read_text()
            for path in parameters.of(driver):
                self.assertIn(f'id="{parameters.anchor(path.rpartition("/")[0])}"', page, path)
                self.assertIn(f"<td>{path.rpartition('/')[2]}</td>", page, path)

    def test_pages_are_searched_and_formulas_drawn_without_a_network(self):
        self.assertTrue((self.html / "search" / "search_index.json").exists())
        theory = (self.html / "theory" / "index.html").read_text()
        self.assertIn("assets/katex/katex.min.js", theory)


class Commands(unittest.TestCase):
    def wrong(self, page, source="docs/page.md"):
        return check_commands.mistakes(source, page)

    def block(self, command):
        return self.wrong(f"# Page\n\n```\n{command}\n```\n")

    def test_what_runs_is_right(self):
        self.assertEqual(self.block('./run penetration drivers/penetration/smoke.prm --set "Intruder/kind=cone" \\\n'
                                    '  --set "Sand/box=0.018, 0.018, 0.022" --output results/x # no --setting\n'
                                    "./run && ./run tests; ./run penetration --print-parameters > my.prm\n"
                                    "PYTHONPATH=drivers/python /usr/bin/python3 -m bergamo show results/x"), [])

    def test_what_is_not_there_is_named_with_its_line(self):
        gone = "drivers/penetration/gone.prm"
        for command, wrong in {
            "./run penetratoin": "there is no driver 'penetratoin'",
            f"./run penetration {gone}": f"there is no parameter file '{gone}'",
            "build/release/drivers/penetration --setting x": "drivers have no option '--setting'",
            './run penetration --set "Intruder/kid=cone"': "penetration has no parameter 'Intruder/kid'",
            './run tests && ./run penetration --set "Intruder/kind=ball"':
                "penetration: 'ball' is no value of 'Intruder/kind'; allowed: one of plate, cone, pile",
            './run penetration --set "Sand/box=0.018, wide"': "'0.018, wide' is no value of 'Sand/box'",
            "python3 -m bergamo export results/x --into y": "unrecognized arguments: --into y",
            "/usr/bin/python3 docs/gone.py page": "there is no 'docs/gone.py'",
        }.items():
            found = self.block("./run\n" + command)
            self.assertEqual(len(found), 1, command)
            self.assertTrue(found[0].startswith("docs/page.md:5: "), found[0])
            self.assertIn(wrong, found[0])

    def test_a_second_run_in_one_folder(self):
        small = "./run penetration drivers/penetration/smoke.prm"
        self.assertEqual(self.block(f"{small}\n./run penetration\n{small} --output results/x\n{small} --dry-run\n"
                                    f"{small} --output results/x --restart\n./run hourglass --help"), [])
        for first, second, folder in ((small, "./run hourglass drivers/hourglass/smoke.prm", "results/smoke"),
                                      ("./run penetration", './run penetration --threads 2 # another', "results/penetration"),
                                      (f"{small} --output results/x", "./run hourglass --output results/x/", "results/x")):
            self.assertEqual(self.block(f"{first}\n{second}"),
                             [f"docs/page.md:5: in {folder} is the run of line 4; give this one an --output"])

    def test_names_of_parameters_within_lines(self):
        page = ("Text with `Intruder/kind`, `Sand/Settling`, `Sand/box = 1` and\n"
                "`Intruder/kid`; `Other/thing`, `dem/core`.\n")
        self.assertEqual(self.wrong(page, "drivers/penetration/README.md"),
                         ["drivers/penetration/README.md:2: penetration has no parameter 'Intruder/kid'"])
        self.assertEqual(len(self.wrong('Take `--set "Intruder/kid=1"`.\n', "drivers/penetration/README.md")), 1)
        self.assertEqual(len(self.wrong("`./run penetratoin`\n")), 1)


class Excerpts(FolderCase):
    def test_lines_that_a_commit_does_not_have(self):
        command = ["git", "-C", ROOT, "log", "-1", "--format=%h", "--", "docs/mkdocs.yml"]
        last = subprocess.run(command, capture_output=True, text=True)
        if last.returncode != 0 or not last.stdout:
            self.skipTest("no git, or the site is not committed")
        commit = last.stdout.strip()
        line = next(line for line in check_commits.shown(commit) if line.startswith("+") and len(line) > 20)
        page = "<!-- commit {} -->\n```diff\n{}\n…\n```\n"
        self.assertEqual(check_commits.mistakes("docs/page.md", page.format(commit, line)), [])
        self.assertEqual(check_commits.mistakes("docs/page.md", page.format(commit, "+no such line")),
                         [f"docs/page.md:3: commit {commit} has no line '+no such line'"])


class Links(FolderCase):
    def test_dead_ones_anchors_and_the_network(self):
        self.write("a.html", '<h1 id="here">A</h1><a href="b.html">b</a><a href="#here">up</a>'
                             '<a href="https://debian.org">elsewhere</a>')
        self.write("b.html", '<a href="a.html#here">a</a><a href="a.html#gone">a</a><a href="c.html">c</a>'
                             '<img src="x.png"><script src="https://cdn.org/x.js"></script>')
        self.assertEqual(check_links.mistakes(self.tmp), [
            "b.html: 'a.html#gone': the page has no anchor 'gone'",
            "b.html: dead link 'c.html'",
            "b.html: dead link 'x.png'",
            "b.html: fetches 'https://cdn.org/x.js' from the network"])

    def test_formulas_that_cannot_be_drawn(self):
        katex = Path("/usr/share/javascript/katex/katex.min.js")
        if not katex.exists() or not any(os.access(Path(folder) / "node", os.X_OK) for folder in os.get_exec_path()):
            self.skipTest("needs nodejs and libjs-katex")
        (self.tmp / "assets" / "katex").mkdir(parents=True)
        (self.tmp / "assets" / "katex" / "katex.min.js").symlink_to(katex)
        self.write("a.html", r'<span class="arithmatex">\(a &lt; \frac{1}{2}\)</span>'
                             r'<div class="arithmatex">\[\frac{1}\]</div>')
        found = check_formulas.mistakes(self.tmp)
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("a.html: "), found[0])


class Pages(unittest.TestCase):
    PAGE = ("# A\n\n```\n# no heading\n```\n\n## B `c`\n\nText\n[x](y.md#z)\n\n| a |\n|---|\n\n### D\n\n![p](q.png)\n\n"
            "## E\n\nend\n")

    def test_sections_and_their_figures(self):
        self.assertEqual(text.section(self.PAGE, "E"), "end\n")
        inner = text.section(self.PAGE, "B `c`")
        self.assertTrue(inner.startswith("Text") and inner.endswith("![p](q.png)\n"), inner)
        self.assertEqual(text.figures(inner), "![p](q.png)\n\nText\n[x](y.md#z)\n\n| a |\n|---|\n")
        with self.assertRaises(tree.Mistake):
            text.section(self.PAGE, "no heading")

    def test_links_follow_a_page_to_its_place(self):
        page = "[a](../../docs/results/silo.md#b) `[c](d.md)` [`e`](f.png) [g](#h)\n```\n[i](j.md)\n```\n"
        self.assertEqual(text.moved(page, "drivers/penetration/README.md", "examples/penetration.md"),
                         page.replace("../../docs/results/silo.md", "../results/silo.md")
                         .replace("f.png", "../files/drivers/penetration/f.png"))
        self.assertEqual(text.slug("Jobs, and `Run`'s loop (new)"), "jobs-and-runs-loop-new")


if __name__ == "__main__":
    unittest.main()
