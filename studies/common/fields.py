"""Reads the fields of a run (.pvd, .vtu) and samples them on a regular grid."""
from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_TYPES = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "UInt64": "u8", "UInt32": "u4", "UInt8": "u1",
          "Int8": "i1"}


@dataclass
class Frame:
    """One .vtu: points (n, 2) m, triangles (m, 3), arrays by name with n and m rows."""

    points: Array
    triangles: NDArray[np.int64]
    point_data: dict[str, Array] = field(default_factory=dict)
    cell_data: dict[str, Array] = field(default_factory=dict)


def frame_path(folder: Path, t: float, tolerance: float) -> Path:
    """The .vtu of fields.pvd whose time is nearest to t; ValueError if it is further away than the tolerance (s)."""
    root = ElementTree.parse(Path(folder) / "fields.pvd").getroot()
    frames = [(float(e.attrib["timestep"]), e.attrib["file"]) for e in root.iter("DataSet")]
    if not frames:
        raise ValueError(f"{folder}/fields.pvd lists no frame")
    at, name = min(frames, key=lambda frame: abs(frame[0] - t))
    if abs(at - t) > tolerance:
        raise ValueError(f"{folder}: the frame nearest to t = {t} s is at {at} s")
    return Path(folder) / name


@dataclass
class Grid:
    """One .vtu as it is: points (n, 2) m, cells by VTK's numbers of their types, arrays by name."""

    points: Array
    connectivity: NDArray[np.int64]
    types: NDArray[np.int64]
    point_data: dict[str, Array]
    cell_data: dict[str, Array]


def read_frame(path: Path) -> Frame:
    """Reads a .vtu of linear triangles."""
    grid = read_vtu(path)
    if not np.all(grid.types == 5):
        raise ValueError(f"{path}: holds other cells than linear triangles")
    return Frame(grid.points, grid.connectivity.reshape(-1, 3), grid.point_data, grid.cell_data)


def read_vtu(path: Path) -> Grid:
    """Reads a .vtu: VTK's XML format with its data appended raw, compressed by zlib.

    (meshio reads them in 13 times the time, and not at all under the Python of Debian 13.)
    """
    content = Path(path).read_bytes()
    mark = re.search(rb"<AppendedData[^>]*encoding=\"raw\"[^>]*>\s*_", content)
    if mark is None:
        raise ValueError(f"{path}: no raw appended data")
    head = ElementTree.fromstring(content[: mark.start()] + b"</VTKFile>")
    if head.attrib.get("compressor") != "vtkZLibDataCompressor" or head.attrib.get("byte_order") != "LittleEndian":
        raise ValueError(f"{path}: expected little-endian data compressed by zlib")
    header = np.dtype("<" + _TYPES[head.attrib.get("header_type", "UInt32")])

    def array(element: ElementTree.Element) -> NDArray:
        position = mark.end() + int(element.attrib["offset"])
        n_blocks = int(np.frombuffer(content, header, 1, position)[0])
        sizes = np.frombuffer(content, header, n_blocks, position + 3 * header.itemsize).astype(int)
        position += (3 + n_blocks) * header.itemsize
        blocks = []
        for size in sizes:
            blocks.append(zlib.decompress(content[position : position + size]))
            position += size
        values = np.frombuffer(b"".join(blocks), "<" + _TYPES[element.attrib["type"]])
        columns = int(element.attrib.get("NumberOfComponents", 1))
        return values.reshape(-1, columns) if columns > 1 else values

    def arrays(parent: str) -> dict[str, NDArray]:
        return {e.attrib["Name"]: array(e) for e in head.iterfind(f".//{parent}/DataArray")}

    cells = arrays("Cells")
    points = array(head.find(".//Points/DataArray"))[:, :2]
    return Grid(points, cells["connectivity"], cells["types"], arrays("PointData"), arrays("CellData"))


def sample_on_grid(points: Array, triangles: NDArray[np.int64], values: Array, x: Array, y: Array) -> Array:
    """Linear interpolation of nodal values on the grid x (nx), y (ny), both equidistant; (ny, nx, ...), NaN outside.

    Every triangle is drawn onto the grid points in its bounding box, all triangles at once.
    """
    pitch_x, pitch_y = x[1] - x[0], y[1] - y[0]
    grid = np.full((y.size * x.size,) + values.shape[1:], np.nan)
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    inside = (high[:, 0] >= x[0]) & (low[:, 0] <= x[-1]) & (high[:, 1] >= y[0]) & (low[:, 1] <= y[-1])
    triangles, corners, low, high = triangles[inside], corners[inside], low[inside], high[inside]

    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    twice_area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    first_i = np.ceil((low[:, 0] - x[0]) / pitch_x).astype(int)
    first_j = np.ceil((low[:, 1] - y[0]) / pitch_y).astype(int)
    wide = int(np.max(np.ceil((high[:, 0] - low[:, 0]) / pitch_x))) + 1
    tall = int(np.max(np.ceil((high[:, 1] - low[:, 1]) / pitch_y))) + 1
    rim = 1e-9  # a grid point on an edge belongs to both triangles: round-off must not lose it
    for dj in range(tall):
        for di in range(wide):
            i, j = first_i + di, first_j + dj
            px, py = x[0] + i * pitch_x, y[0] + j * pitch_y
            lb = ((px - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (py - a[:, 1])) / twice_area
            lc = ((b[:, 0] - a[:, 0]) * (py - a[:, 1]) - (px - a[:, 0]) * (b[:, 1] - a[:, 1])) / twice_area
            hit = (lb >= -rim) & (lc >= -rim) & (lb + lc <= 1 + rim) & (i >= 0) & (i < x.size) & (j >= 0) & (j < y.size)
            weights = np.stack([1 - lb - lc, lb, lc], -1)[hit]
            corner_values = values[triangles[hit]]
            weights = weights.reshape(weights.shape + (1,) * (values.ndim - 1))
            grid[j[hit] * x.size + i[hit]] = np.sum(corner_values * weights, axis=1)
    return grid.reshape((y.size, x.size) + values.shape[1:])
