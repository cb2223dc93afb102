"""A .glb in world space: triangles with matt materials, lightmap coordinates, and lamps."""

import json
import struct
from dataclasses import dataclass

import numpy as np

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
PUNCTUAL = "KHR_lights_punctual"
STRENGTH = "KHR_materials_emissive_strength"
# Far beyond any scene, in meters: Bevy darkens lamps towards their range, other renderers do not.
NO_RANGE = 1e5


class Unsupported(Exception):
    """The scene has something that the reference or the rival would treat in another way than the bake."""


@dataclass
class Surface:
    """One primitive of one node; `smooth` are normals of its vertices where they differ from those of the triangles."""

    node: int
    primitive: int
    name: str
    positions: np.ndarray
    triangles: np.ndarray
    smooth: np.ndarray | None
    uv: np.ndarray | None
    reflectance: np.ndarray
    emission: np.ndarray
    double_sided: bool

    def corners(self):
        """Corners of each triangle, in meters."""
        return self.positions[self.triangles]


@dataclass
class Lamp:
    """Strength: intensity in cd of points and spots, illuminance in lx of a sun. Cosines: of a spot's inner, outer angle."""

    kind: str
    position: np.ndarray
    direction: np.ndarray
    strength: np.ndarray
    cosines: tuple[float, float]

    def share(self, cosine):
        """What a spot gives of its strength, for the cosine of the angle from its axis; squared, as glTF suggests."""
        inner, outer = self.cosines
        ramp = np.clip((cosine - outer) / max(inner - outer, 1e-4), 0, 1)
        return ramp * ramp if self.kind == "spot" else np.ones_like(cosine)


def chunks(path):
    """The document and the binary part of a file."""
    data = open(path, "rb").read()
    if data[:4] != b"glTF":
        raise Unsupported(f"{path} is no .glb file")
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def write(path, document, binary):
    """The opposite of `chunks`."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def write_without_ranges(source, target):
    """Copies a scene so that all renderers agree on how far a lamp reaches."""
    document, binary = chunks(source)
    for light in document.get("extensions", {}).get(PUNCTUAL, {}).get("lights", []):
        if light["type"] != "directional":
            light["range"] = NO_RANGE
    write(target, document, binary)


def read(path):
    """Surfaces and lamps of the scene."""
    document, binary = chunks(path)
    surfaces, lamps = [], []

    def visit(index, parent):
        node = document["nodes"][index]
        place = parent @ local_place(node)
        for k, primitive in enumerate(document["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []):
            surfaces.append(surface(document, binary, index, k, primitive, place))
        if PUNCTUAL in node.get("extensions", {}):
            light = node["extensions"][PUNCTUAL]["light"]
            lamps.append(lamp(document["extensions"][PUNCTUAL]["lights"][light], place))
        for child in node.get("children", []):
            visit(child, place)

    for root in document["scenes"][document.get("scene", 0)]["nodes"]:
        visit(root, np.eye(4))
    return surfaces, lamps


def accessor(document, binary, index):
    accessor = document["accessors"][index]
    if "sparse" in accessor or "bufferView" not in accessor:
        raise Unsupported("sparse accessors")
    view = document["bufferViews"][accessor["bufferView"]]
    component, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    strides = (view.get("byteStride", component.itemsize * width), component.itemsize)
    values = np.ndarray((accessor["count"], width), component, binary, start, strides)
    return values / np.iinfo(component).max if accessor.get("normalized") else values.copy()


def local_place(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    place = np.eye(4)
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    rotation = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    place[:3, :3] = np.array(rotation) * np.array(node.get("scale", [1, 1, 1]), float)
    place[:3, 3] = node.get("translation", [0, 0, 0])
    return place


def surface(document, binary, node_index, k, primitive, place):
    node = document["nodes"][node_index]
    name = f"{node.get('name', node_index)}.{k}"
    if primitive.get("mode", 4) != 4 or "COLOR_0" in primitive["attributes"]:
        raise Unsupported(f"{name}: only triangles without vertex colors are compared")
    attributes = {key: accessor(document, binary, value) for key, value in primitive["attributes"].items()}
    positions = attributes["POSITION"] @ place[:3, :3].T + place[:3, 3]
    if "indices" in primitive:
        triangles = accessor(document, binary, primitive["indices"]).reshape(-1, 3).astype(np.int64)
    else:
        triangles = np.arange(len(positions)).reshape(-1, 3)
    if np.linalg.det(place[:3, :3]) < 0:
        triangles = triangles[:, ::-1].copy()
    smooth = None
    if "NORMAL" in attributes:
        normals = normalized(attributes["NORMAL"] @ np.linalg.inv(place[:3, :3]))
        smooth = None if is_flat(positions[triangles], normals[triangles]) else normals
    material = document["materials"][primitive["material"]] if "material" in primitive else {}
    reflectance, emission = colors(material, name)
    uv, double_sided = attributes.get("TEXCOORD_1"), material.get("doubleSided", False)
    return Surface(node_index, k, name, positions, triangles, smooth, uv, reflectance, emission, double_sided)


def colors(material, name):
    matt = material.get("pbrMetallicRoughness", {})
    textures = [key for part in (material, matt) for key in ("baseColorTexture", "emissiveTexture") if key in part]
    if textures or material.get("alphaMode", "OPAQUE") != "OPAQUE" or "KHR_materials_unlit" in material.get("extensions", {}):
        raise Unsupported(f"{name}: only opaque materials without textures are compared")
    base = np.array(matt.get("baseColorFactor", [1, 1, 1, 1])[:3], float)
    strength = material.get("extensions", {}).get(STRENGTH, {}).get("emissiveStrength", 1.0)
    emission = np.array(material.get("emissiveFactor", [0, 0, 0]), float) * strength
    return np.clip(base * (1 - matt.get("metallicFactor", 1.0)), 0, 1), emission


def lamp(light, place):
    spot = light.get("spot", {})
    cosines = (np.cos(spot.get("innerConeAngle", 0.0)), np.cos(spot.get("outerConeAngle", np.pi / 4)))
    strength = np.array(light.get("color", [1, 1, 1]), float) * light.get("intensity", 1.0)
    return Lamp(light["type"], place[:3, 3], normalized(-place[:3, 2]), strength, cosines)


def normalized(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-30)


def is_flat(corners, normals):
    flat = normalized(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    return bool(((normals * flat[:, None]).sum(-1) > 0.9999).all()) if len(corners) else True


def extent(surfaces):
    """The longest side of the scene in meters."""
    return float(np.ptp(np.concatenate([surface.positions for surface in surfaces]), axis=0).max())


def area(surfaces):
    """In square meters."""
    sides = [(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) for c in (surface.corners() for surface in surfaces)]
    return sum(float(np.linalg.norm(np.cross(a, b), axis=1).sum()) / 2 for a, b in sides)
