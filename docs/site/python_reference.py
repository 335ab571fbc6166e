"""The public names of the package bergamo with what their docstrings say, read without importing it."""

import ast
import inspect
import re

from tree import ROOT

PACKAGE = ROOT / "drivers" / "python" / "bergamo"
HIDDEN = ("__init__", "__repr__", "__iter__", "__len__", "__contains__")  # what every reader expects


def imports(file):
    """Modules beside a file by the names that it imports from them."""
    nodes = [node for node in ast.parse(file.read_text()).body if isinstance(node, ast.ImportFrom) and node.level == 1]
    return {name.name: node.module for node in nodes for name in node.names}


def exported(package):
    """Modules by the names in a package's __all__."""
    listed = next(ast.literal_eval(node.value) for node in ast.parse((package / "__init__.py").read_text()).body
                  if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__")
    return {name: module for name, module in imports(package / "__init__.py").items() if name in listed}


def definition(package, module, name):
    """The node that defines a name, and its file; through packages within that hand it on."""
    file = package / f"{module}.py"
    if not file.exists():
        return definition(package / module, imports(package / module / "__init__.py")[name], name)
    for node in ast.parse(file.read_text()).body:
        parts = [part for target in getattr(node, "targets", []) for part in ast.walk(target)]
        if name in [getattr(node, "name", ""), *(part.id for part in parts if isinstance(part, ast.Name))]:
            return node, file
    raise KeyError(f"{file}: no {name}")


def prose(node):
    """A docstring as Markdown: its parameters become a list, one begun block of code stays one."""
    text = inspect.cleandoc(ast.get_docstring(node) or "")
    text = re.sub(r"^>>> .*(?:\n.+)*", lambda found: f"```pycon\n{found[0]}\n```", text, flags=re.MULTILINE)
    text = re.sub(r"(?<!\n)\n(?=@)", "\n\n", text)
    text = re.sub(r"(?<=\S)[;.]? *@(?=param|return)", "\n\n@", text)
    text = re.sub(r"^@param (\w+(?:, \w+)*)", r"- `\1`:", text, flags=re.MULTILINE)
    text = re.sub(r"^@return", "- returns", text, flags=re.MULTILINE)
    return re.sub(r"\n\n(?=- )", "\n", text.replace("\n- ", "\n\n- ", 1)) if "\n- " in text else text


def signature(name, node):
    arguments = ast.unparse(node.args)
    arguments = re.sub(r"^(self|cls)(, |$)", "", arguments)
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{name}({arguments}){result}"


def is_property(node):
    return any(getattr(mark, "id", getattr(mark, "attr", "")) in ("property", "cached_property", "setter")
               for mark in node.decorator_list)


def fields_of(node, file):
    """A table of a class's annotated names with their comments."""
    lines, rows = file.read_text().splitlines(), []
    for entry in node.body:
        if isinstance(entry, ast.AnnAssign) and not entry.target.id.startswith("_"):
            comment = lines[entry.end_lineno - 1][entry.end_col_offset:].partition("#")[2].strip()
            value = f" = {ast.unparse(entry.value)}" if entry.value else ""
            rows.append(f"| `{entry.target.id}` | `{(ast.unparse(entry.annotation) + value).replace('|', 'or')}` | "
                        f"{comment.replace('|', chr(92) + '|').replace('_', chr(92) + '_')} |")
    return "| field | | |\n|---|---|---|\n" + "\n".join(rows) + "\n" if rows else ""


def methods_of(node):
    for entry in node.body:
        if not isinstance(entry, ast.FunctionDef) or entry.name in HIDDEN or not ast.get_docstring(entry):
            continue
        if entry.name.startswith("_") and not entry.name.startswith("__"):
            continue
        shown = entry.name if is_property(entry) else signature(entry.name, entry)
        yield f"`{shown}`\n{{ .member }}\n\n{prose(entry)}\n"


def inherited(node, file):
    """Base classes of the package that have no entry of their own."""
    package, modules = file.parent, imports(file)
    names = [base.id for base in node.bases if isinstance(base, ast.Name)]
    return [definition(package, modules[name], name)[0] for name in names
            if name in modules and name not in exported(package)]


def class_text(name, node, file):
    made = next((entry for entry in node.body if getattr(entry, "name", "") == "__init__"), None)
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    begin = signature(name, made).partition(" ->")[0] if made else f"class {name}" + (f"({bases})" if bases else "")
    members = [text for part in (node, *inherited(node, file)) for text in methods_of(part)]
    return "\n".join([f"```python\n{begin}\n```\n", prose(node) + "\n", fields_of(node, file), *members])


def entry_text(package, module, name):
    node, file = definition(package, module, name)
    if isinstance(node, ast.ClassDef):
        return class_text(name, node, file)
    if isinstance(node, ast.FunctionDef):
        return f"```python\n{signature(name, node)}\n```\n\n{prose(node)}\n"
    return f"```python\n{ast.unparse(node)}\n```\n"


def package_text(package, title):
    overview = inspect.cleandoc(ast.get_docstring(ast.parse((package / "__init__.py").read_text())))
    lines = [f"## {title}\n\n{overview}\n"]
    for name, module in sorted(exported(package).items(), key=lambda entry: entry[0].lower()):
        lines.append(f"### {title}.{name}\n\n{entry_text(package, module, name)}")
    return "\n".join(lines)


def page():
    packages = (package_text(PACKAGE, "bergamo"), package_text(PACKAGE / "engine", "bergamo.engine"))
    return "\n".join(("# Python, all names\n\nFrom the docstrings of `drivers/python/bergamo`; "
                      "[Runs in Python](../python.md) shows them at work.\n", *packages))
