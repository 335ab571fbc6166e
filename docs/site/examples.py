"""The page of each example: what its README says, with times, figures and parameters beside it."""

import re

import yaml

import parameters
from text import HEADING, PICTURE, blank_code, figures, links, moved, section, slug, without_pictures
from tree import ROOT, Mistake, drivers, place_of, relative

DATA = ROOT / "docs" / "site" / "examples.yml"

TIMES = """
## Time it takes

The processor's time on one core of an AMD EPYC (AVX2) that others used, too. Two cores need half of it where there are
many grains or elements, and all of it where there are few. Other parameter files: above.

| parameter file | core time |
|---|---|
"""

PAGE = """# {title}

<div class="lead" markdown>
{summary}
</div>

`./run {name}`
{{ .program }}

{picture}
## The job

{job}{times}
## Figures to compare with

{results}
## Parameters

{parameters}"""

INDEX = """# Examples

Each is a driver: one program, steered by parameter files, with the checks that hold it.
"""


def groups():
    """The examples by group, as docs/site/examples.yml has them; Mistake where they are not those of drivers/."""
    found = yaml.safe_load(DATA.read_text())
    listed = {name for group in found.values() for name in group}
    for name in sorted(listed.symmetric_difference(drivers())):
        wrong = f"{name} is no driver" if name in listed else f"the driver {name} is missing"
        raise Mistake(f"{DATA.relative_to(ROOT)}: {wrong}")
    return found


def entries():
    return {name: entry for group in groups().values() for name, entry in group.items()}


def readme(name):
    """What a driver's README says: its first line, which tells what the job is, and all else."""
    text = (ROOT / "drivers" / name / "README.md").read_text()
    first, _, rest = text.partition("\n\n")
    return first.replace("\n", " ").strip(), rest


def times_of(entry):
    if not entry["times"]:
        return ""
    rows = "".join(f"| `{file}` | {time} |\n" for file, time in entry["times"].items())
    return TIMES + rows


def figures_of(entry, place):
    """What docs/results has on an example: links to its sections, with pictures and first table of what stands there
    before the next heading."""
    found = []
    for result in entry["results"]:
        file, _, heading = result.partition(": ")
        source = f"docs/results/{file}"
        text = (ROOT / source).read_text()
        title = heading or HEADING.search(blank_code(text))[2]
        body = re.split(r"^##+ ", section(text, heading) if heading else text, flags=re.MULTILINE)[0]
        link = relative(place_of(source), place) + (f"#{slug(heading)}" if heading else "")
        found.append(f"**[{title}]({link})**\n\n{moved(figures(body), source, place)}")
    return "\n".join(found)


def page(name, entry):
    """The page of one example, ready for its place; a picture stands on it once."""
    source = f"drivers/{name}/README.md"
    place = place_of(source)
    summary, rest = readme(name)
    job = moved(rest, source, place)
    picture = "" if PICTURE.search(job) else f"![{entry['title']}]({relative(place_of(entry['picture']), place)})\n"
    results = without_pictures(figures_of(entry, place), links(picture + job))
    return PAGE.format(title=entry["title"], summary=summary, name=name, picture=picture, job=job,
                       times=times_of(entry), results=results, parameters=parameters.table_of(name))


def index():
    """The page that lists the examples."""
    rows = []
    for group, members in groups().items():
        rows.append(f"\n## {group}\n\n| example | driver | |\n|---|---|---|\n")
        rows += [f"| [{entry['title']}]({name}.md) | `{name}` | {readme(name)[0]} |\n"
                 for name, entry in members.items()]
    return INDEX + "".join(rows)


def navigation():
    """The examples as mkdocs' nav has them."""
    lists = [{group: [{entry["title"]: f"examples/{name}.md"} for name, entry in members.items()]}
             for group, members in groups().items()]
    return ["examples/index.md", *lists]
