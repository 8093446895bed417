# Renders a GLB with Blender's Cycles as `patina render` frames and lights it: unclamped, box filter, energy compensated, every
# path up to BOUNCES, no adaptive sampling, linear EXR on a transparent background. Called by
# scripts/compare-with-cycles, in Blender 3.4 or newer:
#   blender -b --factory-startup --python cycles-render.py -- SETTINGS.json
# SETTINGS.json: scene, environment (a lat-long image or null), output, yaw, pitch (degrees), distance,
# fov (vertical, degrees), target ([x, y, z], glTF axes), width, height, samples, bounces, seed.
import numpy

for name in ("bool", "int", "float"):  # Blender 3.4 uses names that newer versions of numpy have dropped
    setattr(numpy, name, {"bool": bool, "int": int, "float": float}[name])

import json
import math
import sys

import bpy
import mathutils

with open(sys.argv[sys.argv.index("--") + 1]) as file:
    settings = json.load(file)

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=settings["scene"])
for material in bpy.data.materials:  # energy compensation, as Patina has it
    for node in material.node_tree.nodes if material.use_nodes else ():
        if node.type == "BSDF_PRINCIPLED":
            node.distribution = "MULTI_GGX"
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = settings["samples"]
cycles.seed = settings["seed"]
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.max_bounces = settings["bounces"]
cycles.diffuse_bounces = settings["bounces"]
cycles.glossy_bounces = settings["bounces"]
cycles.transmission_bounces = settings["bounces"]
cycles.transparent_max_bounces = settings["bounces"]
cycles.sample_clamp_direct = 0
cycles.sample_clamp_indirect = 0
cycles.blur_glossy = 0
cycles.light_sampling_threshold = 0
cycles.caustics_reflective = True
cycles.caustics_refractive = True
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1
render = scene.render
render.resolution_x = settings["width"]
render.resolution_y = settings["height"]
render.resolution_percentage = 100
render.film_transparent = True
render.image_settings.file_format = "OPEN_EXR"
render.image_settings.color_depth = "32"
render.filepath = settings["output"]

world = bpy.data.worlds.new("Environment")
scene.world = world
world.use_nodes = True
nodes = world.node_tree
background = nodes.nodes["Background"]
if settings["environment"]:
    image = nodes.nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(settings["environment"])
    turn = nodes.nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value = (0, 0, math.radians(-90))
    direction = nodes.nodes.new("ShaderNodeTexCoord")
    nodes.links.new(direction.outputs["Generated"], turn.inputs["Vector"])
    nodes.links.new(turn.outputs["Vector"], image.inputs["Vector"])
    nodes.links.new(image.outputs["Color"], background.inputs["Color"])
else:
    background.inputs["Color"].default_value = (0, 0, 0, 1)

data = bpy.data.cameras.new("Camera")
camera = bpy.data.objects.new("Camera", data)
scene.collection.objects.link(camera)
scene.camera = camera
data.sensor_fit = "VERTICAL"
data.angle = math.radians(settings["fov"])
data.clip_start = 1e-3
data.clip_end = 1e3
yaw, pitch = math.radians(settings["yaw"]), math.radians(settings["pitch"])
x, y, z = settings["target"]
distance = settings["distance"]


def blender(x, y, z):
    """A point with y up, as glTF has it, with z up."""
    return mathutils.Vector((x, -z, y))


target = blender(x, y, z)
camera.location = blender(
    x + distance * math.sin(yaw) * math.cos(pitch),
    y + distance * math.sin(pitch),
    z + distance * math.cos(yaw) * math.cos(pitch),
)
camera.rotation_euler = (target - camera.location).to_track_quat("-Z", "Y").to_euler()

bpy.ops.render.render(write_still=True)
