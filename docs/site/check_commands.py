"""Commands that pages quote still run: drivers, parameter files, scripts and parameters that they name are there."""

import contextlib
import functools
import io
import re
import shlex

import parameters
from text import CODE, FENCE, blank_code
from tree import ROOT, drivers

SHELL = ("", "sh", "bash", "console")
BEFORE_A_COMMAND = ("sudo", "env", "nohup", "do", "time", "/usr/bin/python3", "python3")
WITH_VALUE = ("--set", "--output", "--threads")
WRITES_NOTHING_NEW = ("--help", "-h", "--dry-run", "--print-parameters", "--restart", "--force")
PATH = re.compile(r"[A-Z][\w' -]*(?:/[\w' .-]+)+")


def mistakes(source, text):
    """@param source path of a page from the root; @param text of it"""
    driver = source.split("/")[1] if source.startswith("drivers/") else None
    found, written = [], {}
    for line, command in commands(text):
        found += [f"{source}:{line}: {wrong}" for wrong in mistakes_of(command)]
        folder = folder_of(command)
        if folder in written:
            found.append(f"{source}:{line}: in {folder} is the run of line {written[folder]}; give this one an --output")
        elif folder:
            written[folder] = line
    for line, words in spans(text):
        found += [f"{source}:{line}: {wrong}" for wrong in mistakes_of_span(words, driver)]
    return found


def commands(text):
    """(line, words) of every command in the blocks of a page that are for a shell."""
    for block in FENCE.finditer(text):
        language, _, code = block[0].partition("\n")
        if language.strip("`~ ") not in SHELL:
            continue
        line = text.count("\n", 0, block.start()) + 2
        for logical in re.findall(r"(?:[^\n]*\\\n)*[^\n]*\n?", code):
            for words in split_commands(logical.replace("\\\n", " ")):
                yield line, words
            line += logical.count("\n")


def spans(text):
    """(line, words) of all code within the lines of a page."""
    plain = blank_code(text)
    for found in CODE.finditer(plain):
        yield plain.count("\n", 0, found.start()) + 1, " ".join(found[0].strip("`").split())


def split_commands(line):
    """The words of each command of a line; nothing of one that no shell would take, such as a usage."""
    lexer = shlex.shlex(line.removeprefix("$ "), posix=True, punctuation_chars=";&|")
    lexer.whitespace_split, lexer.commenters = True, "#"
    try:
        words = list(lexer)
    except ValueError:
        return
    command = []
    for word in [*words, ";"]:
        if set(word) <= set(";&|"):
            if command:
                yield command
            command = []
        else:
            command.append(word)


def program_of(command):
    """The words of a command from its program on; none where it is a pattern of one."""
    words = list(command)
    while words and (words[0] in BEFORE_A_COMMAND or re.match(r"\w+=", words[0])):
        words.pop(0)
    return [] if any("[" in word or "$" in word or word == "..." for word in words) else words


def driver_of(words):
    """(driver, its words) of a program that is one, right or wrong, else None."""
    name = words[0].split("/")[-1]
    if words[0] == "./run":
        is_one = len(words) > 1 and not words[1].startswith("-") and words[1] not in ("tests", "site", "DRIVER")
        return (words[1], words[2:]) if is_one else None
    return (name, words[1:]) if name in drivers() and words[0] in (name, f"build/release/drivers/{name}") else None


def folder_of(command):
    """The folder that a command begins a run in, None where it begins none: a second one there is refused."""
    words = program_of(command)
    driver, words = words and driver_of(words) or (None, [])
    if driver is None or any(word in WRITES_NOTHING_NEW for word in words):
        return None
    if "--output" in words[:-1]:
        return words[words.index("--output") + 1].rstrip("/")
    files = [word for word in words if word.endswith(".prm")]
    return "results/" + (files[0].split("/")[-1].removesuffix(".prm") if files else driver)


def mistakes_of(command):
    """What is wrong with one command; nothing of what is none of the project's."""
    words = program_of(command)
    if not words:
        return
    driver = driver_of(words)
    if driver:
        yield from mistakes_of_driver(*driver)
    elif words[:2] == ["-m", "bergamo"]:
        yield from mistakes_of_package(words[2:])
    elif words[0].partition("/")[0] in top_folders() and "/" in words[0] and not (ROOT / words[0]).exists():
        yield f"there is no '{words[0]}'"


def mistakes_of_package(words):
    """What the package's own parser says of `python3 -m bergamo WORDS`."""
    from bergamo.__main__ import parser  # found by parameters.py
    said = io.StringIO()
    try:
        with contextlib.redirect_stderr(said):
            parser().parse_args(words)
    except SystemExit as exit:
        if exit.code:
            yield said.getvalue().strip().splitlines()[-1]


@functools.cache
def top_folders():
    return [path.name for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith("build")]


@functools.cache
def options():
    """All that drivers take, by their command line's source."""
    source = (ROOT / "drivers" / "common" / "command_line.cc").read_text()
    return ["--help", "-h", *re.findall(r'"(--[a-z-]+)"', source)]


def mistakes_of_driver(driver, words):
    if driver not in drivers():
        yield f"there is no driver '{driver}'"
        return
    words = iter(words[:words.index(">")] if ">" in words else words)
    for word in words:
        if word.startswith("-") and word not in options():
            yield f"drivers have no option '{word}'"
        value = next(words, "") if word in WITH_VALUE else None
        if word == "--set":
            yield from mistakes_of_setting(driver, value)
        elif value is None and word.startswith("drivers/") and not (ROOT / word).is_file():
            yield f"there is no parameter file '{word}'"


def mistakes_of_setting(driver, setting):
    """@param setting "Section/name=value" """
    path, _, value = (part.strip() for part in setting.partition("="))
    known = parameters.of(driver)
    if path not in known:
        yield f"{driver} has no parameter '{path}'"
    elif value and not is_allowed(value, known[path].allowed):
        yield f"{driver}: '{value}' is no value of '{path}'; allowed: {known[path].allowed}"


def is_allowed(value, allowed):
    """Whether a text is a value of the kind that is allowed; limits of numbers are left to the program."""
    if allowed.startswith("one of "):
        return value in allowed.removeprefix("one of ").split(", ")
    if allowed == "true or false":
        return value in ("true", "false")
    if "number" not in allowed:
        return True
    try:
        return bool([float(part) for part in value.split(",")])
    except ValueError:
        return False


def mistakes_of_span(code, driver):
    """@param code that stands within a line; @param driver whose page it is, if it is one's"""
    if code.startswith("./run ") or '--set "' in code and driver:
        for command in split_commands(code if code.startswith("./run ") else f"{driver} {code}"):
            yield from mistakes_of(command)
    else:
        path = code.partition("=")[0].strip()
        known = set().union(*(parameters.of(name) for name in ([driver] if driver else drivers())))
        is_one = PATH.fullmatch(path) and any(name.startswith(path.split("/")[0] + "/") for name in known)
        if is_one and path not in known and not any(name.startswith(path + "/") for name in known):
            yield f"{driver or 'no driver'} has {'no' if driver else 'a'} parameter '{path}'"
