"""Units as the names of columns and figures carry them: `stress_3_Pa`, `mass_flow_kg_s`."""

from __future__ import annotations

import re

# A unit is the longest of these at the end of a name, after an underscore.
UNITS = {
    "s": "s", "h": "h", "hours": "h", "m": "m", "m3": "m3", "m_s": "m/s", "kg": "kg", "kg_s": "kg/s", "kg_m3": "kg/m3",
    "N": "N", "Nm": "N m", "Ns": "N s", "N_m3": "N/m3", "Pa": "Pa", "J": "J", "1_s": "1/s", "per_second": "1/s",
    "deg": "degree", "degrees": "degree",
}
IN_PARAMETERS = re.compile(r"\[([^\][]*)\]\s*$")


def unit_of(name: str) -> str:
    """The unit of a column or figure by its name; empty where it has none.

    >>> unit_of("mass_flow_kg_s"), unit_of("stage")
    ('kg/s', '')
    """
    words = name.split("_")
    for first in range(1, len(words)):
        unit = UNITS.get("_".join(words[first:]))
        if unit is not None:
            return unit
    return ""


def unit_of_text(text: str) -> str:
    """The unit in brackets at the end of a parameter's explanation; empty where there is none."""
    found = IN_PARAMETERS.search(text)
    return found[1] if found else ""
