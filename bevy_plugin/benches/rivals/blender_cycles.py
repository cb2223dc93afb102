"""Blender's Cycles bakes the texels that `bake` laid out.

usage: blender_cycles.py BAKED_DIR OUT_DIR SAMPLES THREADS imported|tuned

BAKED_DIR holds scene.glb and manifest.json. Writes OUT_DIR/lightmap-K.npy, irradiance / pi, and copies of both files; the
last line printed is JSON: seconds of the bake call alone, and the peak memory of the process.

imported   What an artist gets from Blender's glTF importer: an object for every node, which Blender prepares and bakes
           one after the other, of Principled BSDFs.
tuned      What an expert would make of it: one object, a diffuse BSDF alone, emitters sampled from their front alone.

In both, what Blender limits by default (bounces, bright samples) has no limit, for the limits would darken the result, and
one-sided surfaces are black from behind. There is no denoiser, which would have to guess the light of a lightmap from
colors and normals that it does not get.
"""

import json
import os
import resource
import shutil
import sys
import time

import bpy
import numpy as np

import glb

SUN_ANGLE = np.radians(0.53)
MARGIN = 4


def prepare(samples, threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.transparent_max_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    return scene


def material(surface, image, tuned):
    """Reflects and emits on its front; the back of a one-sided surface is black."""
    made = bpy.data.materials.new(surface.name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    new, link = tree.nodes.new, tree.links.new
    front = diffuse(surface, new, link) if tuned else principled(surface, new)
    if tuned and surface.emission.max() > 0:
        made.cycles.emission_sampling = "FRONT_BACK" if surface.double_sided else "FRONT"
    if not surface.double_sided:
        geometry, mix = new("ShaderNodeNewGeometry"), new("ShaderNodeMixShader")
        link(geometry.outputs["Backfacing"], mix.inputs[0])
        link(front, mix.inputs[1])
        front = mix.outputs[0]
    link(front, new("ShaderNodeOutputMaterial").inputs["Surface"])
    if image is not None:
        target = new("ShaderNodeTexImage")
        target.image = image
        tree.nodes.active = target
    return made


def diffuse(surface, new, link):
    matt = new("ShaderNodeBsdfDiffuse")
    matt.inputs["Color"].default_value = (*surface.reflectance, 1)
    peak = surface.emission.max()
    if peak == 0:
        return matt.outputs[0]
    emission, both = new("ShaderNodeEmission"), new("ShaderNodeAddShader")
    emission.inputs["Color"].default_value = (*(surface.emission / peak), 1)
    emission.inputs["Strength"].default_value = peak
    link(matt.outputs[0], both.inputs[0])
    link(emission.outputs[0], both.inputs[1])
    return both.outputs[0]


def principled(surface, new):
    made = new("ShaderNodeBsdfPrincipled")
    made.inputs["Base Color"].default_value = (*surface.reflectance, 1)
    made.inputs["Roughness"].default_value = 1
    peak = surface.emission.max()
    if peak > 0:
        made.inputs["Emission Color"].default_value = (*(surface.emission / peak), 1)
        made.inputs["Emission Strength"].default_value = peak
    return made.outputs[0]


def place_object(name, parts, tuned):
    """One object of surfaces, each with its image and its coordinates there, v down; or without."""
    starts = np.cumsum([0] + [len(surface.positions) for surface, *_ in parts])
    positions = np.concatenate([surface.positions for surface, *_ in parts])
    corners = np.concatenate([(surface.triangles + start).ravel() for (surface, *_), start in zip(parts, starts)])
    count = len(corners) // 3
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", positions.astype(np.float32).ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners.astype(np.int32))
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    owners = np.repeat(np.arange(len(parts)), [len(surface.triangles) for surface, *_ in parts])
    mesh.polygons.foreach_set("material_index", owners.astype(np.int32))
    smooth = np.repeat([surface.smooth is not None for surface, *_ in parts], [len(s.triangles) for s, *_ in parts])
    for surface, image, _ in parts:
        mesh.materials.append(material(surface, image, tuned))
    layer = mesh.uv_layers.new(name="lightmap")
    uv = [np.zeros((len(s.positions), 2)) if uv is None else uv for s, _, uv in parts]
    uv = np.concatenate(uv)[corners]
    uv[:, 1] = 1 - uv[:, 1]
    layer.data.foreach_set("uv", uv.astype(np.float32).ravel())
    mesh.update(calc_edges=True)
    mesh.polygons.foreach_set("use_smooth", smooth)
    if smooth.any():
        flat = lambda s: np.zeros_like(s.positions)
        normals = np.concatenate([flat(s) if s.smooth is None else s.smooth for s, *_ in parts])
        # A normal of zero keeps the one that Blender finds.
        mesh.normals_split_custom_set(normals[corners].tolist())
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def place_lamp(lamp, index):
    kind = "SUN" if lamp.kind == "directional" else "POINT"
    light = bpy.data.lights.new(f"lamp{index}", kind)
    peak = max(lamp.strength.max(), 1e-30)
    light.color = lamp.strength / peak
    if kind == "SUN":
        light.energy, light.angle = peak, SUN_ANGLE
    else:
        # In Blender a power of 4 pi watts is an intensity of one.
        light.energy, light.shadow_soft_size = 4 * np.pi * peak, 0
    if lamp.kind == "spot":
        narrow(light, lamp)
    made = bpy.data.objects.new(light.name, light)
    made.location = lamp.position
    if kind == "SUN":
        from mathutils import Vector

        made.rotation_euler = Vector(lamp.direction).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(made)


def narrow(light, lamp):
    """The cone of glTF, which Blender's own spots do not have."""
    light.use_nodes = True
    tree = light.node_tree
    new, link = tree.nodes.new, tree.links.new
    inner, outer = lamp.cosines
    kinds = ("ShaderNodeNewGeometry", "ShaderNodeVectorMath", "ShaderNodeMapRange", "ShaderNodeMath")
    incoming, dot, ramp, square = (new(kind) for kind in kinds)
    dot.operation, square.operation = "DOT_PRODUCT", "MULTIPLY"
    dot.inputs[1].default_value = lamp.direction
    ramp.inputs["From Min"].default_value, ramp.inputs["From Max"].default_value = outer, max(inner, outer + 1e-4)
    link(incoming.outputs["Incoming"], dot.inputs[0])
    link(dot.outputs["Value"], ramp.inputs["Value"])
    link(ramp.outputs[0], square.inputs[0])
    link(ramp.outputs[0], square.inputs[1])
    link(square.outputs[0], next(node for node in tree.nodes if node.type == "EMISSION").inputs["Strength"])


def new_image(index, entry):
    image = bpy.data.images.new(f"lightmap{index}", entry["width"], entry["height"], float_buffer=True, alpha=True)
    image.colorspace_settings.name = "Non-Color"
    image.generated_color = (0, 0, 0, 0)
    return image


def texels(image):
    """Rows from the top, three channels."""
    values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)[::-1, :, :3].copy()


def in_image(uv, rectangle):
    low, high = np.array(rectangle[:2]), np.array(rectangle[2:])
    return low + uv * (high - low)


def peak_bytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def main():
    source, out, samples, threads = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    tuned = sys.argv[5] == "tuned"
    os.makedirs(out, exist_ok=True)
    manifest = json.load(open(f"{source}/manifest.json"))
    surfaces, lamps = glb.read(f"{source}/scene.glb")
    prepare(samples, threads)
    images = [new_image(index, entry) for index, entry in enumerate(manifest["images"])]
    places = {(entry["node"], entry["primitive"]): entry for entry in manifest["surfaces"]}
    objects = {}
    for surface in surfaces:
        place = places.get((surface.node, surface.primitive))
        part = (surface, images[place["image"]], in_image(surface.uv, place["uv_rect"])) if place else (surface, None, None)
        objects.setdefault((place is not None, 0 if tuned else surface.node), []).append(part)
    for index, lamp in enumerate(lamps):
        place_lamp(lamp, index)
    for (is_lit, node), parts in objects.items():
        made = place_object(f"{node}", parts, tuned)
        if is_lit:
            made.select_set(True)
            bpy.context.view_layer.objects.active = made
    start = time.perf_counter()
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=MARGIN, use_clear=True)
    seconds = time.perf_counter() - start
    for index, image in enumerate(images):
        np.save(f"{out}/lightmap-{index}.npy", texels(image))
    for name in ("manifest.json", "scene.glb"):
        shutil.copy(f"{source}/{name}", out)
    print(json.dumps({"seconds": seconds, "samples": samples, "peak_memory_bytes": peak_bytes()}))


if __name__ == "__main__":
    if len(sys.argv) != 6 or sys.argv[5] not in ("imported", "tuned"):
        sys.exit(__doc__)
    main()
