"""The arrays of a file for ParaView, without VTK."""

import re
import struct
from pathlib import Path

FORMATS = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B"}


def read_vtu(path):
    """All arrays by name, each a tuple of numbers; those of vectors go on from vector to vector."""
    content = Path(path).read_bytes()
    mark = b'<AppendedData encoding="raw">\n_'
    start = content.index(mark) + len(mark)
    arrays = {}
    for attributes in re.findall(r"<DataArray ([^>]*)>", content[:start].decode()):
        values = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
        begin = start + int(values["offset"])
        size = struct.unpack_from("<Q", content, begin)[0]
        kind = FORMATS[values["type"]]
        arrays[values["Name"]] = struct.unpack_from(f"<{size // struct.calcsize(kind)}{kind}", content, begin + 8)
    return arrays
