"""The scenes that other renderers are compared on, as plain data: triangles, Lambertian reflectances, one lamp or a sky,
and homogeneous media. What all renderers can do alike, and nothing else.

Coordinates are right-handed with y up. A medium is (absorption, scattering, g), coefficients by channel in 1/length.
"""

import math
from dataclasses import dataclass


@dataclass
class Mesh:
    points: list
    triangles: list
    reflectance: tuple = (0, 0, 0)
    emission: tuple = None
    inside: tuple = None  # a medium behind a boundary that neither reflects nor refracts


@dataclass
class Scene:
    eye: tuple
    target: tuple
    fov: float  # of the height, in degrees
    meshes: list
    fog: tuple = None  # the medium that fills all the rest
    sky: tuple = None
    depth: int = 100
    size: tuple = (320, 180)


def quad(a, b, c, d, **kind):
    return Mesh([a, b, c, d], [(0, 1, 2), (0, 2, 3)], **kind)


def box(centre, half, turned=0, **kind):
    """Half sizes along its axes, turned about the vertical by degrees."""
    s, c = math.sin(math.radians(turned)), math.cos(math.radians(turned))
    points = []
    for z in (-1, 1):
        for y in (-1, 1):
            for x in (-1, 1):
                px, pz = x * half[0], z * half[2]
                points.append((centre[0] + c * px + s * pz, centre[1] + y * half[1], centre[2] - s * px + c * pz))
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Mesh(points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))], **kind)


def ball(centre, radius, steps=32, **kind):
    """Rings of triangles, wound to face outwards."""
    points = [(centre[0], centre[1] + radius, centre[2])]
    for i in range(1, steps):
        y, r = math.cos(math.pi * i / steps), math.sin(math.pi * i / steps)
        for j in range(2 * steps):
            a = math.pi * j / steps
            points.append((centre[0] + radius * r * math.cos(a), centre[1] + radius * y,
                           centre[2] + radius * r * math.sin(a)))
    points.append((centre[0], centre[1] - radius, centre[2]))
    n, last = 2 * steps, len(points) - 1
    ring = lambda i, j: 1 + (i - 1) * n + j % n
    triangles = [(0, ring(1, j + 1), ring(1, j)) for j in range(n)]
    for i in range(1, steps - 1):
        for j in range(n):
            triangles += [(ring(i, j), ring(i, j + 1), ring(i + 1, j)),
                          (ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j))]
    triangles += [(last, ring(steps - 1, j), ring(steps - 1, j + 1)) for j in range(n)]
    return Mesh(points, triangles, **kind)


WALL, RED, BLUE = dict(reflectance=(0.62, 0.6, 0.55)), dict(reflectance=(0.55, 0.25, 0.2)), dict(reflectance=(0.25, 0.4, 0.5))


def room(*things, lamp):
    return Scene(
        eye=(2.6, 1.7, -3.2), target=(-0.7, 1.2, 2), fov=44,
        fog=((0.004, 0.004, 0.005), (0.12, 0.12, 0.13), 0.4),
        meshes=[
            quad((-3, 0, -4), (3, 0, -4), (3, 0, 7), (-3, 0, 7), **WALL),
            quad((-3, 3, -4), (-3, 3, 7), (3, 3, 7), (3, 3, -4), **WALL),
            quad((-3, 0, -4), (-3, 3, -4), (3, 3, -4), (3, 0, -4), **WALL),
            quad((-3, 0, 7), (3, 0, 7), (3, 3, 7), (-3, 3, 7), **WALL),
            quad((3, 0, -4), (3, 3, -4), (3, 3, 7), (3, 0, 7), **RED),
            quad((-3, 0, -4), (-3, 0, 7), (-3, 3, 7), (-3, 3, -4), **BLUE),
            box((-1.7, 0.6, -0.4), (0.45, 0.6, 0.45), turned=25, reflectance=(0.7, 0.7, 0.7)),
            ball((0.6, 0.45, 0.6), 0.45, steps=16, reflectance=(0.7, 0.55, 0.2)),
            lamp, *things,
        ])


def open_room():
    """A foggy room with a lamp in it: the easy case."""
    return room(lamp=box((1.6, 2.6, 2), (0.15, 0.15, 0.15), emission=(220, 180, 126)))


def door():
    """The lamp is in the next room, behind a door ajar."""
    return room(
        quad((3, 0, 3), (-0.4, 0, 3), (-0.4, 3, 3), (3, 3, 3), **WALL),
        quad((-1.4, 0, 3), (-3, 0, 3), (-3, 3, 3), (-1.4, 3, 3), **WALL),
        quad((-0.4, 2.1, 3), (-1.4, 2.1, 3), (-1.4, 3, 3), (-0.4, 3, 3), **WALL),
        box((-0.69, 1.05, 3.45), (0.5, 1.04, 0.025), turned=55, reflectance=(0.35, 0.2, 0.1)),
        lamp=box((1.6, 1.7, 5.3), (0.15, 0.15, 0.15), emission=(2200, 1800, 1260)))


def lump():
    """A dense ball, a hundred mean free paths across, under an even sky and a lamp behind it."""
    return Scene(
        eye=(0, 0.4, -4), target=(0, 0, 0), fov=40, sky=(0.1, 0.1, 0.1), depth=4000,
        meshes=[
            ball((0, 0, 0), 1, inside=((0.25, 0.5, 1.5), (49.75, 49.5, 48.5), 0.0)),
            box((1.6, 1.6, 2.4), (0.3, 0.3, 0.3), emission=(20, 20, 20)),
        ])


SCENES = {'room': open_room, 'door': door, 'lump': lump}
