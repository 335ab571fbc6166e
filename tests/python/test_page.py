"""The Python of docs/python.md runs, block by block, on the runs that it asks for."""

import subprocess
import unittest

from small_runs import ROOT, FolderCase, run_of

FIGURES = ("resistance.png", "chains.png", "silo.png")


class Page(FolderCase):
    def test_all_blocks_run(self):
        (self.tmp / "results").mkdir()
        (self.tmp / "docs" / "python").mkdir(parents=True)
        for driver in ("penetration", "silo_discharge", "strip_footing"):
            (self.tmp / "results" / driver).symlink_to(run_of(driver))
        page = ROOT / "docs" / "python.md"
        before = page.read_bytes()
        result = subprocess.run(["/usr/bin/python3", "-B", str(ROOT / "docs" / "run_page.py"), str(page), "--check"],
                                cwd=self.tmp, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(page.read_bytes(), before)
        for name in FIGURES:
            self.assertTrue((self.tmp / "docs" / "python" / name).exists(), name)

    def test_an_error_names_its_line(self):
        page = self.write("page.md", "# Page\n\n```python\nprint(1)\n```\n\n```python\nbad\n```\n")
        command = ["/usr/bin/python3", "-B", str(ROOT / "docs" / "run_page.py"), str(page)]
        result = subprocess.run(command, capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r'page.md", line 8')
        page.write_text(page.read_text().replace("bad", "print(2)"))
        subprocess.run(command, check=True)
        blocks = [f"```python\nprint({k})\n```\n\n```text\n{k}\n```\n" for k in (1, 2)]
        self.assertEqual(page.read_text(), "# Page\n\n" + "\n".join(blocks))
        subprocess.run(command, check=True)
        self.assertEqual(page.read_text().count("```text"), 2)  # output is put in place of the old


if __name__ == "__main__":
    unittest.main()
