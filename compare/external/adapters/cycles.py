# SPDX-License-Identifier: MIT. Adapter for Blender Cycles, used by cycles.json. Cannot match: Lambertian diffuse
# (Cycles has Burley's), GGX without multiple scattering, light ranges, falloff at a spot's edge, discs and tubes.
import bpy, json, math, numpy, sys
from mathutils import Matrix, Vector
numpy.bool, job = bool, json.load(open(sys.argv[-2]))  # Debian 12's importer needs numpy.bool, which NumPy removed
turned = Matrix.Rotation(math.pi / 2, 4, 'X')  # Blender is Z-up
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=job['scene']['file'])
scene, told, sky = bpy.context.scene, job['camera'], job['environment']
for thing in [o for o in bpy.data.objects if o.type in ('LIGHT', 'CAMERA')]: bpy.data.objects.remove(thing)
def place(data, world):
    scene.collection.objects.link(thing := bpy.data.objects.new('told', data))
    thing.matrix_world = turned @ world
    return thing
lens = bpy.data.cameras.new('camera')
lens.sensor_fit, lens.clip_start, lens.clip_end = 'VERTICAL', told['near'], told['far'] or 1e6
lens.type, lens.ortho_scale = 'PERSP' if told['fov_degrees'] else 'ORTHO', 2 * (told['ymag'] or 1)
if told['fov_degrees']: lens.angle = math.radians(told['fov_degrees'])
scene.frame_set(int(job['time'] * 24), subframe=job['time'] * 24 % 1)
scene.camera = place(lens, Matrix([told['view_from_world'][row::4] for row in range(4)]).inverted())
kinds = {'directional': 'SUN', 'point': 'POINT', 'spot': 'SPOT', 'rect': 'AREA'}
for light in [one for one in job['lights'] if one['type'] in kinds or print('left out: a', one['type'], 'light', file=sys.stderr)]:
    lamp, spot = bpy.data.lights.new('light', kinds[light['type']]), light.get('spot')
    watts = {'SUN': 1, 'AREA': 4 * math.prod(light.get('size', [0]))}.get(lamp.type, 4 * math.pi)  # Cycles divides by it
    lamp.color, lamp.energy, back = light['color'], light['intensity'] * watts, -Vector(light.get('direction', (0, 0, -1)))
    lamp.cycles.cast_shadow = job['settings']['shadows'] != 'off' and (lamp.type == 'SUN' or light.get('shadow', False))
    if lamp.type == 'AREA': lamp.shape, (lamp.size, lamp.size_y) = 'RECTANGLE', light['size']
    else: setattr(lamp, 'angle' if lamp.type == 'SUN' else 'shadow_soft_size', 0)
    if spot: lamp.spot_size, lamp.spot_blend = 2 * spot['outerConeAngle'], 1 - spot['innerConeAngle'] / spot['outerConeAngle']
    right = Vector(light['axis']) if 'axis' in light else back.orthogonal().normalized()
    facing = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    place(lamp, Matrix.Translation(light.get('position', (0, 0, 0))) @ facing)
scene.world = bpy.data.worlds.new('sky')
scene.world.use_nodes = True
tree, around = scene.world.node_tree, scene.world.node_tree.nodes['Background'].inputs
around['Color'].default_value, around['Strength'].default_value = (*job['ambient'], 1), sky['intensity'] if sky else 1
if sky:
    picture, turn, where = (tree.nodes.new('ShaderNode' + kind) for kind in ('TexEnvironment', 'Mapping', 'TexCoord'))
    picture.image, yaw = bpy.data.images.load(sky['file']), math.radians(-90 - sky['rotation_degrees'])
    turn.inputs['Rotation'].default_value = 0, 0, yaw
    ends = where.outputs['Generated'], turn.inputs[0], turn.outputs[0], picture.inputs[0], picture.outputs[0], around[0]
    for a, b in zip(ends[::2], ends[1::2]): tree.links.new(a, b)
render, cycles, file = scene.render, scene.cycles, scene.render.image_settings
render.engine, render.film_transparent, render.use_file_extension = 'CYCLES', True, False
(render.resolution_x, render.resolution_y), render.resolution_percentage = job['size'], 100
cycles.samples, cycles.max_bounces, cycles.use_denoising, cycles.use_adaptive_sampling = 64, 0, False, False
cycles.pixel_filter_type, cycles.filter_width = 'BOX', 0.01 if job['samples'] == 1 else 1  # pixel centres only
file.file_format, file.color_depth, file.color_mode, render.filepath = 'OPEN_EXR', '32', 'RGB', job['output']['file']
bpy.ops.render.render(write_still=True)
