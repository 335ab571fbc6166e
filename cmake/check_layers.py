#!/usr/bin/env python3
"""Checks that #include arrows only point down, and that no driver's main.cc grows too long.

Prints one line for each violation, "file:line: what is wrong", and ends with status 1 if there is any.
Usage: check_layers.py [SOURCE_FOLDER]
"""

import os
import re
import sys

# Floors of a house, from the ground up: the tables of ARCHITECTURE.md, whose rows begin with the floor and name its
# rooms in backticks. A room may include itself and rooms on lower floors.
TABLE_HEAD = re.compile(r"\| floor of `(\w+)/` \|")
TABLE_ROW = re.compile(r"\| (\d+) \|(.*)\|")


def floors_of_houses(text):
    floors, house = {}, None
    for line in text.splitlines():
        head, row = TABLE_HEAD.match(line), TABLE_ROW.match(line)
        if head:
            house = head[1]
            floors[house] = {}
        elif row and house:
            for room in re.findall(r"`(\w+)/?`", row[2]):
                floors[house][room] = int(row[1])
        elif not line.startswith("|"):
            house = None
    return floors


# Which houses a house may include. dem/core is the ground floor of all: it knows neither grain nor element.
GROUND = "dem/core/"
HOUSES = {
    "dem": {"dem"},
    "fe_dealii": {"fe_dealii"},
    "coupling": {"dem", "coupling"},  # and fe_dealii, from coupling/adapter alone
    "drivers": {"dem", "fe_dealii", "coupling", "drivers"},
}

MAX_MAIN_LINES = 150
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The room of a file: its folder in the house, or its own name for a file that lies in the house itself."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else os.path.splitext(parts[1])[0]


def included_path(root, path, quote, name):
    """The included file from the project's root, or nothing for a file of another project."""
    if name.split("/")[0] in HOUSES and (quote == '"' or os.path.exists(os.path.join(root, name))):
        return name
    beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
    return beside if quote == '"' and os.path.exists(os.path.join(root, beside)) else None


def floor_violation(floors, path, target):
    house, room, target_room = path.split("/")[0], room_of(path), room_of(target)
    for name in (room, target_room):
        if name not in floors:
            return f"{house}/{name} has no floor in ARCHITECTURE.md"
    if room != target_room and floors[target_room] >= floors[room]:
        return (f"{house}/{room} (floor {floors[room]}) must not include {house}/{target_room} "
                f"(floor {floors[target_room]}): {target}")
    return None


def house_violation(floors, path, target):
    house, target_house = path.split("/")[0], target.split("/")[0]
    if target.startswith(GROUND) and house in HOUSES:
        return None
    if path.startswith(("coupling/arlequin/", "coupling/model/")) and target_house == "dem":
        return f"{os.path.dirname(path)}/ knows neither grains nor meshes, of dem/ it may include the core alone: {target}"
    if path.startswith("coupling/adapter/") and target_house == "fe_dealii":
        return None
    if target_house not in HOUSES[house]:
        return f"{house}/ must not include {target_house}/: {target}"
    if path.startswith("coupling/") and not path.startswith("coupling/adapter/") \
            and target.startswith("coupling/adapter/"):
        return f"only drivers may include coupling/adapter/: {target}"
    if path.startswith("drivers/common/") and target_house == "drivers" and not target.startswith("drivers/common/"):
        return f"drivers/common/ must not include a driver: {target}"
    return floor_violation(floors[house], path, target) if house == target_house and house in floors else None


def library_violation(path, name):
    """Of an include of another project's file."""
    may_name_dealii = path.startswith(("fe_dealii/", "drivers/", "coupling/adapter/dealii_adapter"))
    if name.startswith("deal.II/") and not may_name_dealii:
        return f"deal.II belongs to fe_dealii/, coupling/adapter/dealii_adapter and drivers/: <{name}>"
    if re.match(r"(hdf5|H5)\w*\.h", name) and not path.startswith("dem/core/archive"):
        return f"HDF5 belongs to dem/core/archive: <{name}>"
    if name.startswith("CGAL/") and path != "dem/io/stl_file.cc":
        return f"CGAL belongs to dem/io/stl_file.cc: <{name}>"
    if name.startswith("gmsh.h") and path != "dem/io/gmsh_file.cc":
        return f"Gmsh belongs to dem/io/gmsh_file.cc: <{name}>"
    return None


def violations_of(root, floors, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        lines = file.read().splitlines()
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        target = included_path(root, path, *match.groups())
        wrong = house_violation(floors, path, target) if target else library_violation(path, match.group(2))
        if wrong:
            yield f"{path}:{number}: {wrong}"
    if re.fullmatch(r"drivers/[^/]+/main\.cc", path) and len(lines) > MAX_MAIN_LINES:
        yield f"{path}:{len(lines)}: a driver's main.cc has at most {MAX_MAIN_LINES} lines"


def sources(root):
    for house in HOUSES:
        for folder, _, files in os.walk(os.path.join(root, house)):
            for file in files:
                if file.endswith((".h", ".cc")):
                    yield os.path.relpath(os.path.join(folder, file), root)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(here)
    paths = sorted(sources(root))
    if not paths:
        sys.exit(f"error: no sources in {root}")
    with open(os.path.join(root, "ARCHITECTURE.md"), encoding="utf-8") as file:
        floors = floors_of_houses(file.read())
    if not floors:
        sys.exit("error: ARCHITECTURE.md has no table of floors")
    violations = [violation for path in paths for violation in violations_of(root, floors, path)]
    print("\n".join(violations) if violations else f"layers: {len(paths)} files, all arrows point down")
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
