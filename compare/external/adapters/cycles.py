# SPDX-License-Identifier: MIT
# Blender Cycles: cycles.json names this file. It cannot match glTF's diffuse light (its principled surface has
# Burley's, not Lambert's), GGX without light between microfacets, ranges of lights and the curve of a cone's edge.
import bpy, json, math, numpy, sys
from mathutils import Matrix, Vector
numpy.bool = bool  # Debian 12's importer asks for this name, which its numpy has no more
job, turned = json.load(open(sys.argv[-2])), Matrix.Rotation(math.pi / 2, 4, 'X')  # Blender has Z up
told, sky = job['camera'], job['environment']
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=job['scene']['file'])
scene = bpy.context.scene
for thing in [o for o in bpy.data.objects if o.type in ('LIGHT', 'CAMERA')]: bpy.data.objects.remove(thing)
def place(data, world):
    scene.collection.objects.link(thing := bpy.data.objects.new('told', data))
    thing.matrix_world = turned @ world
    return thing
lens = bpy.data.cameras.new('camera')
lens.sensor_fit, lens.clip_start, lens.clip_end = 'VERTICAL', told['near'], told['far'] or 1e6
if told['projection'] == 'perspective': lens.angle = math.radians(told['fov_degrees'])
else: lens.type, lens.ortho_scale = 'ORTHO', 2 * told['ymag']
scene.frame_set(int(job['time'] * 24), subframe=job['time'] * 24 % 1)
scene.camera = place(lens, Matrix([told['view_from_world'][row::4] for row in range(4)]).inverted())
kinds = {'directional': 'SUN', 'point': 'POINT', 'spot': 'SPOT', 'rect': 'AREA'}
for light in [one for one in job['lights'] if one['type'] in kinds or print('left out:', one['type'], 'light')]:
    lamp, spot = bpy.data.lights.new('light', kinds[light['type']]), light.get('spot')
    watts = {'SUN': 1, 'AREA': 4 * math.prod(light.get('size', [0]))}.get(lamp.type, 4 * math.pi)  # as Cycles divides
    lamp.color, lamp.energy, shadows = light['color'], light['intensity'] * watts, job['settings']['shadows'] != 'off'
    lamp.cycles.cast_shadow = shadows and (lamp.type == 'SUN' or light.get('shadow', False))
    if lamp.type == 'AREA': lamp.shape, (lamp.size, lamp.size_y) = 'RECTANGLE', light['size']
    else: setattr(lamp, 'angle' if lamp.type == 'SUN' else 'shadow_soft_size', 0)
    if spot: lamp.spot_size, lamp.spot_blend = 2 * spot['outerConeAngle'], 1 - spot['innerConeAngle'] / spot['outerConeAngle']
    back = -Vector(light.get('direction', (0, 0, -1)))
    right = Vector(light['axis']) if 'axis' in light else back.orthogonal().normalized()
    facing, position = Matrix((right, back.cross(right), back)).transposed(), light.get('position', (0, 0, 0))
    place(lamp, Matrix.Translation(position) @ facing.to_4x4())
scene.world = bpy.data.worlds.new('sky')
scene.world.use_nodes = True
tree, around = scene.world.node_tree, scene.world.node_tree.nodes['Background'].inputs
around['Color'].default_value, around['Strength'].default_value = (*job['ambient'], 1), sky['intensity'] if sky else 1
if sky:
    picture, turn, where = (tree.nodes.new('ShaderNode' + kind) for kind in ('TexEnvironment', 'Mapping', 'TexCoord'))
    picture.image = bpy.data.images.load(sky['file'])
    turn.inputs['Rotation'].default_value[2] = math.radians(-90 - sky['rotation_degrees'])
    for a, b in ((where.outputs['Generated'], turn.inputs[0]), (turn.outputs[0], picture.inputs[0]),
                 (picture.outputs[0], around[0])): tree.links.new(a, b)
render, cycles, file = scene.render, scene.cycles, scene.render.image_settings
render.engine, render.film_transparent, render.use_file_extension = 'CYCLES', True, False
render.resolution_x, render.resolution_y, render.resolution_percentage = *job['size'], 100
cycles.samples, cycles.max_bounces, cycles.use_denoising, cycles.use_adaptive_sampling = 64, 0, False, False
cycles.pixel_filter_type, cycles.filter_width = 'BOX', 0.01 if job['samples'] == 1 else 1  # pixels' middles alone
file.file_format, file.color_depth, file.color_mode, file.exr_codec = 'OPEN_EXR', '32', 'RGB', 'ZIP'
render.filepath = job['output']['file']
bpy.ops.render.render(write_still=True)
