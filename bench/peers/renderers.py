"""Each renderer's own way to say a scene, and to render it: render(scene, seconds, path, seed) writes an EXR picture and
returns (samples a pixel, seconds); no samples are told by Cycles."""

import json
import math
import os
import subprocess
import time

THREADS = 2


# ---------------------------------------------------------------------------------------------------------------- Wend

def pbrt_text(scene):
    """pbrt's coordinates are left-handed: x is turned around."""
    numbers = lambda v: ' '.join(f'{x:.9g}' for x in v)
    mirrored = lambda p: (-p[0], p[1], p[2])

    def medium(name, m):
        return (f'MakeNamedMedium "{name}" "string type" "homogeneous" "rgb sigma_a" [ {numbers(m[0])} ] '
                f'"rgb sigma_s" [ {numbers(m[1])} ] "float g" [ {m[2]} ]')

    lines = [f'Integrator "volpath" "integer maxdepth" [ {scene.depth} ]',
             'Sampler "sobol"', 'PixelFilter "box"',
             f'Film "rgb" "integer xresolution" [ {scene.size[0]} ] "integer yresolution" [ {scene.size[1]} ] '
             '"string filename" "out.exr"']
    if scene.fog:
        lines += [medium('fog', scene.fog), 'MediumInterface "" "fog"']
    lines += [f'LookAt {numbers(mirrored(scene.eye))}  {numbers(mirrored(scene.target))}  0 1 0',
              f'Camera "perspective" "float fov" [ {scene.fov} ]', 'WorldBegin']
    if scene.fog:
        lines.append('MediumInterface "fog" "fog"')  # on both sides of walls, whichever way these face
    if scene.sky:
        lines.append(f'LightSource "infinite" "rgb L" [ {numbers(scene.sky)} ]')
    for i, mesh in enumerate(scene.meshes):
        lines.append('AttributeBegin')
        if mesh.inside:
            lines += [medium(f'm{i}', mesh.inside), 'Material "interface"', f'MediumInterface "m{i}" ""']
        else:
            lines.append(f'Material "diffuse" "rgb reflectance" [ {numbers(mesh.reflectance)} ]')
        if mesh.emission:
            lines.append(f'AreaLightSource "diffuse" "rgb L" [ {numbers(mesh.emission)} ] "bool twosided" [ true ]')
        points = '  '.join(numbers(mirrored(p)) for p in mesh.points)
        # Mirroring turns triangles around; these are turned back.
        indices = '  '.join(f'{a} {c} {b}' for a, b, c in mesh.triangles)
        lines += [f'Shape "trianglemesh" "point3 P" [ {points} ] "integer indices" [ {indices} ]', 'AttributeEnd']
    return '\n'.join(lines) + '\n'


def pbrt_file(scene, path):
    """A scene that is a file already, or what it is in pbrt's words, written beside the picture."""
    if not hasattr(scene, 'meshes'):
        return scene.wend_file
    with open(path + '.pbrt', 'w') as out:
        out.write(pbrt_text(scene))
    return path + '.pbrt'


def wend(program, *options):
    def render(scene, seconds, path, seed):
        file = pbrt_file(scene, path)
        report = path + '.json'
        subprocess.run([program, 'render', file, '-o', path, '--time', str(seconds), '--seed', str(seed), '--threads',
                        str(THREADS), '--json', report, '--quiet', *options], check=True)
        with open(report) as text:
            told = json.load(text)
        return told['spp'], told['seconds']
    return render


# ------------------------------------------------------------------------------------------------------------- Mitsuba

def mitsuba_dict(mi, scene):
    def medium(m):
        extinction = [a + s for a, s in zip(m[0], m[1])]
        scale = max(extinction)
        return {'type': 'homogeneous', 'scale': scale,
                'sigma_t': {'type': 'rgb', 'value': [t / scale for t in extinction]},
                'albedo': {'type': 'rgb', 'value': [s / t for s, t in zip(m[1], extinction)]},
                'phase': {'type': 'hg', 'g': m[2]} if m[2] else {'type': 'isotropic'}}

    camera = {'type': 'perspective', 'fov': scene.fov, 'fov_axis': 'y',
              'to_world': mi.ScalarTransform4f().look_at(origin=scene.eye, target=scene.target, up=(0, 1, 0)),
              'film': {'type': 'hdrfilm', 'width': scene.size[0], 'height': scene.size[1], 'rfilter': {'type': 'box'},
                       'component_format': 'float32', 'pixel_format': 'rgb'},
              'sampler': {'type': 'independent'}}
    result = {'type': 'scene', 'sensor': camera}
    if scene.fog:
        result['fog'] = medium(scene.fog)
        camera['medium'] = {'type': 'ref', 'id': 'fog'}
    if scene.sky:
        result['sky'] = {'type': 'constant', 'radiance': {'type': 'rgb', 'value': list(scene.sky)}}
    for i, mesh in enumerate(scene.meshes):
        if mesh.inside:
            properties = mi.Properties()
            properties['bsdf'] = mi.load_dict({'type': 'null'})
            properties['interior'] = mi.load_dict(medium(mesh.inside))
        else:
            properties = mi.Properties()
            properties['bsdf'] = mi.load_dict({'type': 'twosided', 'bsdf': {
                'type': 'diffuse', 'reflectance': {'type': 'rgb', 'value': list(mesh.reflectance)}}})
            if mesh.emission:
                properties['emitter'] = mi.load_dict(
                    {'type': 'area', 'radiance': {'type': 'rgb', 'value': list(mesh.emission)}})
        shape = mi.Mesh(f'mesh{i}', len(mesh.points), len(mesh.triangles), properties)
        parameters = mi.traverse(shape)
        parameters['vertex_positions'] = [x for p in mesh.points for x in p]
        parameters['faces'] = [k for t in mesh.triangles for k in t]
        parameters.update()
        result[f'mesh{i}'] = shape
    return result


def quiet_mitsuba():
    import mitsuba as mi
    mi.set_variant('scalar_rgb')
    mi.Thread.thread().logger().set_log_level(mi.LogLevel.Warn)
    return mi


def mitsuba(scene, seconds, path, seed):
    mi = quiet_mitsuba()
    built = mi.load_dict(mitsuba_dict(mi, scene))
    integrator = mi.load_dict({'type': 'volpath', 'max_depth': scene.depth + 1, 'rr_depth': 5})
    return render_by_mitsuba(mi, built, integrator, seconds, path, seed)


def render_by_mitsuba(mi, built, integrator, seconds, path, seed):
    """`integrator`: None for the scene's."""
    def run(spp, number):
        start = time.time()
        picture = mi.render(built, spp=spp, seed=number, **({'integrator': integrator} if integrator else {}))
        return picture, time.time() - start

    # Samples are added in passes until the time is spent.
    spp = 4
    total, samples, spent, number = None, 0, 0.0, 1000 * seed
    while samples == 0 or spent + 0.5 * spent / samples * spp < seconds:
        picture, took = run(spp, number)
        total = picture * spp if total is None else total + picture * spp
        samples, spent, number = samples + spp, spent + took, number + 1
    mi.Bitmap(total / samples).write(path)
    return samples, spent


# -------------------------------------------------------------------------------------------------------------- Cycles

def build_blender(bpy, scene):
    """Blender's z is up: (x, y, z) becomes (x, -z, y)."""
    from mathutils import Matrix, Vector
    turned = lambda p: (p[0], -p[2], p[1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    there = bpy.context.scene

    def add(name, points, triangles, material):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([turned(p) for p in points], [], triangles)
        mesh.materials.append(material)
        there.collection.objects.link(bpy.data.objects.new(name, mesh))

    def nodes_of(material):
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        return tree, tree.nodes.new('ShaderNodeOutputMaterial')

    def volume(tree, output, m):
        absorption, scattering, g = m
        most = max(scattering)
        scatter = tree.nodes.new('ShaderNodeVolumeScatter')
        scatter.inputs['Color'].default_value = (*(s / most for s in scattering), 1)
        scatter.inputs['Density'].default_value = most
        scatter.inputs['Anisotropy'].default_value = g
        absorb = tree.nodes.new('ShaderNodeVolumeAbsorption')
        most = max(absorption)
        absorb.inputs['Color'].default_value = (*(1 - a / most for a in absorption), 1)
        absorb.inputs['Density'].default_value = most
        both = tree.nodes.new('ShaderNodeAddShader')
        tree.links.new(scatter.outputs[0], both.inputs[0])
        tree.links.new(absorb.outputs[0], both.inputs[1])
        tree.links.new(both.outputs[0], output.inputs['Volume'])

    for i, mesh in enumerate(scene.meshes):
        material = bpy.data.materials.new(f'm{i}')
        tree, output = nodes_of(material)
        if mesh.inside:
            volume(tree, output, mesh.inside)
        else:
            kind = 'ShaderNodeEmission' if mesh.emission else 'ShaderNodeBsdfDiffuse'
            shader = tree.nodes.new(kind)
            colour = mesh.emission or mesh.reflectance
            most = max(max(colour), 1e-9) if mesh.emission else 1
            shader.inputs['Color'].default_value = (*(c / most for c in colour), 1)
            if mesh.emission:
                shader.inputs['Strength'].default_value = most
            tree.links.new(shader.outputs[0], output.inputs['Surface'])
        add(f'mesh{i}', mesh.points, mesh.triangles, material)
    if scene.fog:
        from scenes import box
        material = bpy.data.materials.new('fog')
        tree, output = nodes_of(material)
        volume(tree, output, scene.fog)
        around = box((0, 1.5, 1.5), (20, 20, 20))
        add('fog', around.points, around.triangles, material)
    world = bpy.data.worlds.new('world')
    there.world = world
    world.use_nodes = True
    sky = scene.sky or (0, 0, 0)
    world.node_tree.nodes['Background'].inputs['Color'].default_value = (*sky, 1)
    world.node_tree.nodes['Background'].inputs['Strength'].default_value = 1

    camera = bpy.data.cameras.new('camera')
    camera.sensor_fit = 'VERTICAL'
    camera.angle = math.radians(scene.fov)
    camera.clip_start, camera.clip_end = 1e-3, 1e4
    eye, target = Vector(turned(scene.eye)), Vector(turned(scene.target))
    back = (eye - target).normalized()
    right = Vector((0, 0, 1)).cross(back).normalized()
    up = back.cross(right)
    thing = bpy.data.objects.new('camera', camera)
    thing.matrix_world = Matrix(((right.x, up.x, back.x, eye.x), (right.y, up.y, back.y, eye.y),
                                 (right.z, up.z, back.z, eye.z), (0, 0, 0, 1)))
    there.collection.objects.link(thing)
    there.camera = thing
    return there


def render_by_cycles(bpy, guided, depth, seconds, path, seed):
    """The scene at hand, at its own size; no samples are told."""
    there = bpy.context.scene
    there.render.engine = 'CYCLES'
    there.render.resolution_percentage = 100
    there.render.threads_mode, there.render.threads = 'FIXED', THREADS
    there.render.image_settings.file_format = 'OPEN_EXR'
    there.render.image_settings.color_depth = '32'
    there.render.filepath = os.path.abspath(path)
    c = there.cycles
    c.device = 'CPU'
    c.seed = seed
    c.samples, c.time_limit = 1_000_000, seconds
    c.use_adaptive_sampling = c.use_denoising = False
    c.pixel_filter_type = 'BOX'
    if depth:
        bounces = min(depth, 1024)
        c.max_bounces = c.diffuse_bounces = c.glossy_bounces = c.transmission_bounces = c.volume_bounces = bounces
        c.transparent_max_bounces = bounces
    c.sample_clamp_direct = c.sample_clamp_indirect = 0
    c.use_guiding = guided
    start = time.time()
    bpy.ops.render.render(write_still=True)
    return None, time.time() - start


def cycles(guided):
    def render(scene, seconds, path, seed):
        import bpy
        there = build_blender(bpy, scene)
        there.render.resolution_x, there.render.resolution_y = scene.size
        return render_by_cycles(bpy, guided, scene.depth, seconds, path, seed)
    return render
