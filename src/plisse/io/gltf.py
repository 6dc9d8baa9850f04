"""Binary glTF 2.0 as a container: buffers, primitives, materials. What goes into it is decided elsewhere.

glTF wants metres and y upwards. Paper is drawn in triangles with every corner of every face a vertex of its own, so
that faces stay flat when shaded; creases are lines over it.
"""

import json
import struct
from importlib.metadata import version

import numpy as np

from plisse.draw.colours import MOUNTAIN, PAPER, VALLEY, rgb
from plisse.recipe import MILLIMETRES

__all__ = ["LINES", "TRIANGLES", "Buffer", "linear", "materials", "one_mesh", "primitive", "upright"]

FLOAT, UNSIGNED = 5126, 5125
LINES, TRIANGLES = 1, 4
ARRAY, ELEMENTS = 34962, 34963


def upright(vertices: np.ndarray, units: str) -> np.ndarray:
    """The same points (…, 3) in metres, z of ours as y of glTF."""
    return vertices[..., [0, 2, 1]] * [1, 1, -1] * (MILLIMETRES[units] / 1000)


def primitive(mode: int, attributes: dict, indices: int, material: int, targets: list[dict] | None = None) -> dict:
    """LINES or TRIANGLES over accessors, with morph targets if there are any."""
    entry = {"mode": mode, "attributes": attributes, "indices": indices, "material": material}
    return entry | ({"targets": targets} if targets else {})


def linear(colours: np.ndarray) -> np.ndarray:
    """Linear values of sRGB colours (…, 3) in 0…1, as glTF counts them."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def materials(paper: str = PAPER) -> list[dict]:
    """0 paper, 1 mountains, 2 valleys; lines without light."""
    unlit: dict = {"extensions": {"KHR_materials_unlit": {}}}
    return [_plain("paper", paper), _plain("mountain", MOUNTAIN) | unlit, _plain("valley", VALLEY) | unlit]


def _plain(name: str, colour: str) -> dict:
    factors = {"baseColorFactor": [*linear(rgb(colour)).round(5).tolist(), 1.0], "metallicFactor": 0.0,
               "roughnessFactor": 0.9}
    return {"name": name, "doubleSided": True, "pbrMetallicRoughness": factors}


def one_mesh(mesh: dict, paper: str = PAPER) -> dict:
    """The document of a scene that shows one mesh."""
    return {
        "asset": {"version": "2.0", "generator": f"plisse {version('plisse')}"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": mesh["name"]}],
        "meshes": [mesh], "materials": materials(paper), "extensionsUsed": ["KHR_materials_unlit"],
    }


class Buffer:
    """Binary data in the making, with its accessors and buffer views."""

    def __init__(self):
        self._bytes, self._views, self._accessors = bytearray(), [], []

    def vectors(self, values: np.ndarray, *, bounds: bool = False) -> int:
        """Accessor of float vectors (N, 3)."""
        return self._add(values.astype("<f4"), "VEC3", FLOAT, ARRAY, bounds)

    def scalars(self, values: np.ndarray, *, bounds: bool = False) -> int:
        """Accessor of floats (N,)."""
        return self._add(values.astype("<f4"), "SCALAR", FLOAT, None, bounds)

    def indices(self, values: np.ndarray) -> int:
        """Accessor of vertex numbers, of any shape."""
        return self._add(values.astype("<u4").ravel(), "SCALAR", UNSIGNED, ELEMENTS, False)

    def packed(self, document: dict) -> bytes:
        """The whole .glb: header, JSON chunk, binary chunk."""
        document = document | {"buffers": [{"byteLength": len(self._bytes)}], "bufferViews": self._views,
                               "accessors": self._accessors}
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        header = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(self._bytes))
        return b"".join([header, struct.pack("<I4s", len(text), b"JSON"), text,
                         struct.pack("<I4s", len(self._bytes), b"BIN\0"), bytes(self._bytes)])

    def _add(self, values: np.ndarray, kind: str, component: int, target: int | None, bounds: bool) -> int:
        view = {"buffer": 0, "byteOffset": len(self._bytes), "byteLength": values.nbytes}
        self._views.append(view if target is None else view | {"target": target})
        self._bytes += values.tobytes()
        accessor = {"bufferView": len(self._views) - 1, "componentType": component, "count": len(values), "type": kind}
        if bounds:
            low, high = np.atleast_1d(values.min(axis=0)), np.atleast_1d(values.max(axis=0))
            accessor |= {"min": low.tolist(), "max": high.tolist()}
        self._accessors.append(accessor)
        return len(self._accessors) - 1
