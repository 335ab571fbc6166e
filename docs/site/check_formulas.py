"""Formulas of the built site are ones that KaTeX can draw, where node is there to ask it."""

import html
import json
import re
import shutil
import subprocess

FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
ASK = """
const katex = require(process.argv[1]);
for (const [page, formula] of JSON.parse(require('fs').readFileSync(0)))
  try { katex.renderToString(formula, {throwOnError: true}); }
  catch (error) { console.log(`${page}: ${error.message.replace(/\\n/g, ' ')}`); }
"""


def mistakes(folder):
    """@param folder of the site"""
    node, katex = shutil.which("node"), folder / "assets" / "katex" / "katex.min.js"
    if not node or not katex.exists():
        return []
    formulas = [(str(path.relative_to(folder)), html.unescape(found[2])) for path in sorted(folder.rglob("*.html"))
                for found in FORMULA.finditer(path.read_text())]
    asked = subprocess.run([node, "-e", ASK, katex], input=json.dumps(formulas), capture_output=True, text=True,
                           check=True)
    return asked.stdout.splitlines()
