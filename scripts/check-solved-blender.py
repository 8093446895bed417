# Imports a solved file into Blender and says what has arrived; scripts/check-solved-files runs it.
#   blender -b --factory-startup --python check-solved-blender.py -- FILE PICTURE WIDTH HEIGHT SAMPLES CAMERA
# PICTURE is rendered by Cycles without any light but what the file shows by itself, through the camera of the
# file, or of the document CAMERA (.dae) where it has none. Colours are as displays have them (view transform
# Standard).
import numpy

numpy.bool, numpy.int, numpy.float = bool, int, float  # Blender 3.4 beside numpy 1.24, as in Debian 12
import sys

import bpy

file, picture, width, height, samples, camera_file = sys.argv[sys.argv.index("--") + 1 :][:6]
bpy.ops.wm.read_factory_settings(use_empty=True)
if file.endswith(".dae"):
    bpy.ops.wm.collada_import(filepath=file)
else:
    bpy.ops.import_scene.gltf(filepath=file)


def say(*words):
    print("CHECK", *words)


scene = bpy.context.scene
of = lambda kind: [o for o in bpy.data.objects if o.type == kind]
meshes = of("MESH")
say(
    f"{len(meshes)} meshes, {sum(len(o.data.polygons) for o in meshes)} polygons, "
    f"{len(of('LIGHT'))} lights, {len(of('CAMERA'))} cameras"
)
for o in meshes[:3]:
    attributes = {
        a.name: (a.domain, a.data_type, [round(v, 4) for v in a.data[0].color])
        for a in o.data.color_attributes
    }
    say(f"{o.name}: UV sets {[u.name for u in o.data.uv_layers]}, colour attributes {attributes}")
for material in bpy.data.materials[:3]:
    if not material.use_nodes:
        continue
    links = [
        f"{l.from_node.bl_idname}.{l.from_socket.name} > {l.to_node.bl_idname}.{l.to_socket.name}"
        for l in material.node_tree.links
    ]
    say(f"{material.name}: {links}")

# Backs are not there in Patina's pictures; Cycles shows them.
for material in bpy.data.materials:
    if not material.use_nodes:
        continue
    nodes, links = material.node_tree.nodes, material.node_tree.links
    for output in [n for n in nodes if n.bl_idname == "ShaderNodeOutputMaterial"]:
        for link in list(output.inputs["Surface"].links):
            geometry, clear, mix = (
                nodes.new(f"ShaderNode{name}") for name in ("NewGeometry", "BsdfTransparent", "MixShader")
            )
            links.new(geometry.outputs["Backfacing"], mix.inputs["Fac"])
            links.new(link.from_socket, mix.inputs[1])
            links.new(clear.outputs[0], mix.inputs[2])
            links.new(mix.outputs[0], output.inputs["Surface"])

# The two sides of a sheet are two meshes in one place, of which Cycles would meet either: a little apart.
for o in meshes:
    o.data.calc_normals_split()
    normals = {loop.vertex_index: loop.normal.copy() for loop in o.data.loops}
    for index, normal in normals.items():
        o.data.vertices[index].co += 1e-4 * normal

cameras = of("CAMERA")
if not cameras:
    before = set(bpy.data.objects)
    bpy.ops.wm.collada_import(filepath=camera_file)
    for o in set(bpy.data.objects) - before:
        if o.type == "CAMERA":
            cameras.append(o)
        else:
            bpy.data.objects.remove(o)
if cameras:
    scene.camera = cameras[0]
    for o in of("LIGHT"):
        bpy.data.objects.remove(o)
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = int(samples)
    scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 1
    scene.cycles.max_bounces = scene.cycles.transparent_max_bounces = 8
    scene.render.resolution_x, scene.render.resolution_y = int(width), int(height)
    scene.render.resolution_percentage = 100
    scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1
    scene.render.film_transparent = True
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    say("rendered")
else:
    say("no camera: not rendered")
