"""Scenes of any size for bench/scale.py: each function writes one into a folder and returns its file. They are as plain
as can be, so that what grows is all that costs."""

import random
import struct

import numpy

# A walk ends where it meets nothing, and is as long as it is let be otherwise.
CAMERA = "LookAt 0 -3 2  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" [ 45 ]\n"
FLOOR = '"point3 P" [ -1 -1 0  1 -1 0  1 1 0  -1 1 0 ] "integer indices" [ 0 1 2 0 2 3 ]'


def head(size, depth=5, camera=CAMERA):
    return (f'Integrator "volpath" "integer maxdepth" [ {depth} ]\nSampler "independent"\nPixelFilter "box"\n'
            f'Film "rgb" "integer xresolution" [ {size[0]} ] "integer yresolution" [ {size[1]} ]\n{camera}')


def write(folder, name, text):
    path = folder / f"{name}.pbrt"
    path.write_text(text)
    return path


def open_floor(folder, size):
    """A floor below a sky and a lamp: two or three segments a walk."""
    return write(folder, "floor", head(size) + f'WorldBegin\nLightSource "infinite" "rgb L" [ .3 .3 .3 ]\n'
                 f'LightSource "point" "point3 from" [ 0 0 2 ]\nMaterial "diffuse"\nShape "trianglemesh" {FLOOR}\n')


def box_around(scale, inside):
    """The six walls of a cube of that half size; `inside` says what each is like, by its number."""
    lines = []
    for axis in range(3):
        for sign in (-1, 1):
            a, b = [0, 0, 0], [0, 0, 0]
            a[(axis + 1) % 3], b[(axis + 2) % 3] = scale, scale
            middle = [0, 0, 0]
            middle[axis] = sign * scale
            corners = [[m + s * x + t * y for m, x, y in zip(middle, a, b)]
                       for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            points = "  ".join(" ".join(f"{x:.9g}" for x in corner) for corner in corners)
            lines.append(f"AttributeBegin\n{inside(2 * axis + (sign > 0))}\n"
                         f'Shape "trianglemesh" "point3 P" [ {points} ] "integer indices" [ 0 1 2 0 2 3 ]\nAttributeEnd\n')
    return "".join(lines)


def equilibrium(folder, size, depth=10000, scale=1.0):
    """A cube of walls that shine as much as they absorb, filled by fog that absorbs nothing: every ray brings 1, however
    walks go. So what a picture is off by is known without a reference."""
    reflectances = [0.9, 0.5, 0.7, 0.9, 0.8, 0.2]

    def wall(number):
        r = reflectances[number]
        return (f'AreaLightSource "diffuse" "rgb L" [ {3 * [1 - r]} ] "bool twosided" [ true ]\n'
                f'Material "diffuse" "rgb reflectance" [ {3 * [r]} ]').replace("[ [", "[ ").replace("] ]", "]").replace(
                    ",", "")
    sigma = 0.7 / scale
    camera = (f'MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ 0 0 0 ] "rgb sigma_s" '
              f'[ {sigma:.9g} {sigma:.9g} {sigma:.9g} ] "float g" [ 0.3 ]\nMediumInterface "" "fog"\n'
              f'LookAt {-0.5 * scale:.9g} {-0.6 * scale:.9g} {0.1 * scale:.9g}  0 0 0  0 0 1\n'
              'Camera "perspective" "float fov" [ 60 ]\n')
    return write(folder, "equilibrium", head(size, depth, camera) + 'WorldBegin\nMediumInterface "fog" "fog"\n'
                 + box_around(scale, wall))


def bright_cube(folder, size, depth):
    """A closed cube of white walls with a small lamp: walks end at the depth, and seldom before."""
    return write(folder, "cube", head(size, depth, "LookAt -0.5 -0.6 0.1  0 0 0  0 0 1\nCamera \"perspective\"\n")
                 + 'WorldBegin\nLightSource "point" "point3 from" [ 0 0 .5 ]\n'
                 + box_around(1.0, lambda _: 'Material "diffuse" "rgb reflectance" [ 1 1 1 ]'))


def many_lights(folder, size, count):
    """Small lamps all over the air above a floor, of the same power all together."""
    numbers = random.Random(3)
    lines = [head(size), 'WorldBegin\nMaterial "diffuse"\n', f'Shape "trianglemesh" {FLOOR}\n']
    for _ in range(count):
        x, y, z = numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(0.1, 1)
        lines.append(f'LightSource "point" "point3 from" [ {x:.5g} {y:.5g} {z:.5g} ] "rgb I" '
                     f'[ {1 / count:.6g} {1 / count:.6g} {1 / count:.6g} ]\n')
    return write(folder, "lights", "".join(lines))


def many_triangles(folder, size, count):
    """A wavy square of so many triangles, from a PLY file."""
    side = int((count / 2) ** 0.5) + 1
    y, x = numpy.mgrid[0:side, 0:side]
    points = numpy.empty((side * side, 3), "<f4")
    points[:, 0], points[:, 1] = 2 * x.ravel() / (side - 1) - 1, 2 * y.ravel() / (side - 1) - 1
    points[:, 2] = 0.02 * ((x * 7 + y * 11) % 13).ravel() / 13
    corner = (y[:-1, :-1] * side + x[:-1, :-1]).ravel()
    faces = numpy.empty((2 * corner.size, 1), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"] = 3
    faces["v"][0::2, 0] = numpy.stack([corner, corner + 1, corner + side], 1)
    faces["v"][1::2, 0] = numpy.stack([corner + 1, corner + side + 1, corner + side], 1)
    with open(folder / "mesh.ply", "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(faces)}\n"
                   "property list uchar int vertex_indices\nend_header\n".encode())
        file.write(points.tobytes())
        file.write(faces.tobytes())
    return write(folder, "triangles", head(size) + 'WorldBegin\nLightSource "infinite"\nMaterial "diffuse"\n'
                 'Shape "plymesh" "string filename" "mesh.ply"\n')


def many_instances(folder, size, count):
    numbers = random.Random(1)
    with open(folder / "instances.pbrt", "w") as file:
        file.write(head(size) + 'WorldBegin\nLightSource "infinite"\nMaterial "diffuse"\nObjectBegin "a"\n'
                   'Shape "trianglemesh" "point3 P" [ 0 0 0 .01 0 0 0 .01 0 ] "integer indices" [ 0 1 2 ]\nObjectEnd\n')
        for _ in range(count):
            place = tuple(numbers.uniform(-1, 1) for _ in range(3))
            file.write('AttributeBegin\nTranslate %.6g %.6g %.6g\nObjectInstance "a"\nAttributeEnd\n' % place)
    return folder / "instances.pbrt"


def grid(folder, size, side):
    """A ball of smoke in a grid of side³ numbers, some twenty mean free paths across, as Mitsuba's scenes have it: its
    `.vol` files are binary. Its waves are as long in voxels whatever the grid: more voxels are more detail."""
    with open(folder / "smoke.vol", "wb") as file:
        file.write(b"VOL\x03" + struct.pack("<5i6f", 1, side, side, side, 1, -1, -1, -1, 1, 1, 1))
        place = (numpy.arange(side, dtype="f4") + 0.5) * (2 / side) - 1
        wave = numpy.sin(numpy.arange(side, dtype="f4") * 0.4)
        flat = place[:, None] ** 2 + place[None, :] ** 2
        ripples = 0.5 + 0.25 * (wave[:, None] + wave[None, :])
        for z in range(side):
            file.write(numpy.where(flat + place[z] ** 2 < 1, ripples * (0.75 + 0.25 * wave[z]), 0).astype("<f4").tobytes())
    path = folder / "grid.xml"
    path.write_text(f"""<scene version="3.0.0">
  <integrator type="volpath"><integer name="max_depth" value="50"/></integrator>
  <sensor type="perspective"><float name="fov" value="40"/>
    <transform name="to_world"><lookat origin="0, -4, 1" target="0, 0, 0" up="0, 0, 1"/></transform>
    <film type="hdrfilm"><integer name="width" value="{size[0]}"/><integer name="height" value="{size[1]}"/>
      <rfilter type="box"/></film></sensor>
  <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
  <shape type="sphere"><bsdf type="null"/><medium name="interior" type="heterogeneous">
    <float name="scale" value="30"/><float name="albedo" value="0.9"/>
    <volume name="sigma_t" type="gridvolume"><string name="filename" value="smoke.vol"/>
      <transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2"/></transform></volume>
  </medium></shape>
</scene>
""")
    return path
