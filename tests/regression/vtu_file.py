"""The arrays of a file for ParaView, without VTK."""

import base64
import re
import struct
import zlib
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


def read_heights(path):
    """Heights of the points of a file of deal.II's, whose arrays are compressed [m]."""
    text = re.search(r"<Points>\s*<DataArray[^>]*>\s*(\S+)", Path(path).read_text()).group(1)
    n_blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    n_header = -(-4 * (3 + n_blocks) // 3) * 4  # characters
    sizes = struct.unpack(f"<{n_blocks}I", base64.b64decode(text[:n_header])[12:12 + 4 * n_blocks])
    blocks, heights, begin = base64.b64decode(text[n_header:]), b"", 0
    for size in sizes:
        heights += zlib.decompress(blocks[begin:begin + size])
        begin += size
    return struct.unpack(f"<{len(heights) // 4}f", heights)[2::3]
