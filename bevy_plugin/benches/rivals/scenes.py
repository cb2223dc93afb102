"""What is baked: scenes that the repository makes itself, and those that lie beside it."""

import hashlib
import math
import struct
from dataclasses import dataclass
from pathlib import Path

import glb

TEXELS = 60_000
# Texels per meter of scenes that come with a reference; finer ones would take Cycles too long.
DENSITIES = {"cornell": 64, "furnace": 64, "zdm2": 4}


@dataclass
class Scene:
    """`points`: a reference that comes with the scene."""

    name: str
    path: Path
    density: float
    points: Path | None = None

    def digest(self):
        return hashlib.sha256(self.path.read_bytes()).hexdigest()[:16]


def scene(path):
    """A scene, with a density that gives some 60 000 texels where none is known; `NAME.glb@N` names one."""
    text, _, density = str(path).partition("@")
    path = Path(text)
    if not path.exists():
        raise FileNotFoundError(f"{path} does not exist")
    points = path.with_suffix(".csv") if path.with_suffix(".csv").exists() else None
    known = DENSITIES.get(path.stem) if points else None
    return Scene(path.stem, path, float(density or known or fitting(path)), points)


def fitting(path):
    """Texels per meter, to two digits."""
    density = math.sqrt(TEXELS / max(glb.area(glb.read(path)[0]), 1e-9))
    return float(f"{density:.2g}")


def furnace(path):
    """A closed box whose walls reflect half of the light and emit 1 cd/m2: every texel is 2."""
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    # Each face counter-clockwise as seen from inside.
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    positions = [corners[corner] for face in faces for corner in face]
    triangles = [4 * face + corner for face in range(6) for corner in (0, 1, 2, 0, 2, 3)]
    packed = struct.pack("<72f", *(value for point in positions for value in point)) + struct.pack("<36H", *triangles)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "box", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}, "emissiveFactor": [1, 1, 1]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 288}, {"buffer": 0, "byteOffset": 288, "byteLength": 72}],
        "buffers": [{"byteLength": 360}],
    }
    glb.write(path, document, packed)


def usual(folder, gallery, beside):
    """The furnace, the Cornell box in `folder`, then those of two folders; a later one replaces one of the same name."""
    furnace(folder / "furnace.glb")
    paths = [folder / "furnace.glb", folder / "cornell.glb"]
    paths += sorted(gallery.glob("*.glb")) + sorted(beside.glob("*.glb"))
    by_name = {path.stem: path for path in paths if path.exists()}
    return list(by_name.values())
