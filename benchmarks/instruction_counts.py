#!/usr/bin/env python3
"""Counts the instructions of the hot kernels under callgrind and compares them with those kept in
instruction_counts.json: the same on every machine with this compiler and these libraries, whatever else runs there.

Prints kernel, instructions kept and now per item (contact, pair, grain, element) and the change; ends with status 1 if one
grew by more than 5 %, with 77 if the counts kept are another compiler's or another width's.
Usage: instruction_counts.py PROGRAM             compare
       instruction_counts.py PROGRAM --update    keep what is counted now
       instruction_counts.py PROGRAM --split KERNEL   where the instructions of one kernel are, by function of the program
"""

import argparse
import collections
import json
import os
import re
import signal
import subprocess
import sys
import tempfile

KEPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "instruction_counts.json")
TOLERANCE = 0.05
SKIPPED = 77

# The loader binds all functions at the start, and nothing of the caller's environment shifts memory about.
ENVIRONMENT = {"PATH": os.environ.get("PATH", ""), "LD_BIND_NOW": "1", "OMP_NUM_THREADS": "1", "LC_ALL": "C"}


def output_of(command):
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    if done.returncode == -signal.SIGILL:
        print("this processor lacks the instructions that the counts are of (x86-64-v3): not compared")
        sys.exit(SKIPPED)
    if done.returncode != 0:
        sys.exit(f"error: {' '.join(command)} ended with status {done.returncode}\n{done.stderr}")
    return done.stdout


def callgrind(program, kernel, passes, *options):
    """What the program said of itself, and the lines of callgrind's profile."""
    with tempfile.TemporaryDirectory() as folder:
        profile = os.path.join(folder, "profile")
        said = output_of(["valgrind", "--tool=callgrind", "--quiet", f"--callgrind-out-file={profile}", *options,
                          program, kernel, str(passes)])
        with open(profile, encoding="utf-8") as file:
            return dict(line.split(" ", 1) for line in said.splitlines()), file.read().splitlines()


def total(profile):
    return next(int(line.split()[1]) for line in profile if line.startswith("totals:"))


def count_all(program):
    """As kept in the file: the second pass of each kernel, over its items."""
    counts = {}
    for kernel in output_of([program]).split():
        said, once = callgrind(program, kernel, 1)
        _, twice = callgrind(program, kernel, 2)
        counts[kernel] = round((total(twice) - total(once)) / int(said["items"]), 1)
    return {"compiler": said["compiler"], "pack_width": int(said["pack_width"]), "instructions": counts}


def keep(counted):
    part = KEPT + ".part"
    with open(part, "w", encoding="utf-8") as file:
        json.dump(counted, file, indent=2)
        file.write("\n")
    os.replace(part, KEPT)


def compare(kept, counted):
    """Prints the table. @return status of the program"""
    before, now = kept["instructions"], counted["instructions"]
    print(f"{'kernel':<24}{'kept':>10}{'now':>10}{'change':>10}")
    grown, renew = [], sorted(before.keys() ^ now.keys())
    for kernel, count in now.items():
        if kernel not in before:
            print(f"{kernel:<24}{'-':>10}{count:>10.1f}{'new':>10}")
            continue
        change = count / before[kernel] - 1.
        print(f"{kernel:<24}{before[kernel]:>10.1f}{count:>10.1f}{100. * change:>+9.1f}%")
        if change > TOLERANCE:
            grown.append(kernel)
        elif change < -TOLERANCE:
            renew.append(kernel)
    if renew:
        print(f"{', '.join(renew)}: shrank, new or gone; renew {os.path.basename(KEPT)} with --update")
    if grown:
        print(f"{', '.join(grown)}: more than {100. * TOLERANCE:.0f} % above the count kept; mend it, or keep it with "
              "--update and say why in the commit")
    return 1 if grown else 0


def costs_by_address(profile):
    """Instructions by (object, function, address), calls from here not counted."""
    names, costs, place, is_call = {}, collections.Counter(), {}, False
    for line in profile:
        name = re.match(r"(c?)(ob|fn)=\((\d+)\)(?: (.*))?", line)
        if name:
            is_of_callee, kind, number, text = name.groups()
            if text:
                names[kind, number] = text
            if not is_of_callee:
                place[kind] = names[kind, number]
        elif line.startswith("calls="):
            is_call = True
        elif line.startswith("0x"):
            if not is_call:
                address, _, cost = line.split()
                costs[place["ob"], place["fn"], int(address, 16)] += int(cost)
            is_call = False
    return costs


def short(function):
    """The last name of a demangled function; none for an operator or a lambda, which belong to what they stand in."""
    name, bracketed = function, r"<[^<>]*>|\([^()]*\)|\{[^{}]*\}|\[[^\[\]]*\]"
    while re.search(bracketed, name):
        name = re.sub(bracketed, "", name)
    last = re.sub(r"\bconst\b", "", name).strip().split("::")[-1].split()
    return last[-1] if last and not last[-1].startswith("operator") else None


def functions_of_program(program, addresses):
    """By address: file and name of the innermost function of dem/ or fe_dealii/ there, inlined or not."""
    listing = subprocess.run(["addr2line", "-e", program, "-afiC"], env=ENVIRONMENT, capture_output=True, text=True,
                             input="\n".join(hex(a) for a in addresses), check=True).stdout
    found, address, function = {}, None, None
    for line in listing.splitlines():
        if line.startswith("0x"):
            address, function = int(line, 16), None
        elif function is None:
            function = line
        else:
            path = re.search(r"/((?:dem|fe_dealii|benchmarks)/[^:]*)", line)
            if address not in found and path and not path[1].endswith("core/pack.h") and short(function):
                found[address] = (path[1], short(function))
            function = None
    return found


def slow_instructions(program):
    """Addresses of the divisions and of the square roots."""
    listing = output_of(["objdump", "-d", "--no-show-raw-insn", program])
    slow = {"div": set(), "sqrt": set()}
    for address, kind in re.findall(r"^\s*([0-9a-f]+):\s+v(div|sqrt)[ps]d\b", listing, re.MULTILINE):
        slow[kind].add(int(address, 16))
    return slow


def split(program, kernel):
    profiles = [callgrind(program, kernel, n, "--dump-instr=yes", "--compress-pos=no") for n in (1, 2)]
    once, twice = (costs_by_address(profile) for _, profile in profiles)
    items = int(profiles[0][0]["items"])
    twice.subtract(once)
    costs = {place: cost for place, cost in twice.items() if cost}
    inside = [address for (path, _, address) in costs if os.path.basename(path) == os.path.basename(program)]
    functions, slow = functions_of_program(program, inside), slow_instructions(program)
    rows = collections.defaultdict(lambda: [0, 0, 0])
    for (path, function, address), cost in costs.items():
        is_inside = os.path.basename(path) == os.path.basename(program)
        around = re.split(r"::\{lambda| \[clone", function)[0]
        where = (functions.get(address) if is_inside else None) or (os.path.basename(path), short(around) or function)
        rows[where][0] += cost
        if is_inside:
            rows[where][1] += cost * (address in slow["div"])
            rows[where][2] += cost * (address in slow["sqrt"])
    rows["all", ""] = [sum(column) for column in zip(*rows.values())]
    print(f"{kernel}, per item\n{'function':<66}{'instr.':>8}{'div':>7}{'sqrt':>7}")
    for place, row in sorted(rows.items(), key=lambda row: -row[1][0]):
        print(f"{' '.join(place)[:64]:<66}{row[0] / items:>8.1f}{row[1] / items:>7.2f}{row[2] / items:>7.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="instruction_counts as built")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--split", metavar="KERNEL")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    if arguments.split:
        split(program, arguments.split)
        return
    if not arguments.update and not os.path.exists(KEPT):
        sys.exit(f"error: {KEPT} is missing; --update makes it")
    counted = count_all(program)
    kept = counted
    if os.path.exists(KEPT):
        with open(KEPT, encoding="utf-8") as file:
            kept = json.load(file)
    if arguments.update:
        compare(kept, counted)
        keep(counted)
        print(f"kept in {KEPT}")
        return
    if any(kept[key] != counted[key] for key in ("compiler", "pack_width")):
        print(f"counts kept are of {kept['compiler']}, these of {counted['compiler']}: not compared")
        sys.exit(SKIPPED)
    sys.exit(compare(kept, counted))


if __name__ == "__main__":
    main()
