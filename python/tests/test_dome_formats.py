"""Pictures of all directions in other layouts."""

import numpy as np
import pytest

from wend._dome_formats import as_latlong

#: To the right, up and ahead; columns and rows of a latlong picture, as parts of its size.
AHEAD, RIGHT, LEFT, UP = (0.5, 0.5), (0.75, 0.5), (0.25, 0.5), (0.5, 0.02)


def at(picture, place):
    return picture[int(place[1] * picture.shape[0]), int(place[0] * picture.shape[1])]


def drawn(height, width, colour):
    """By what `colour` says of across and down, from 0 to 1."""
    y, x = np.mgrid[0:height, 0:width]
    return np.stack(np.broadcast_arrays(*colour((x + 0.5) / width, (y + 0.5) / height)), axis=-1).astype(np.float32)


def test_the_radius_of_an_angular_picture_is_the_angle():
    picture = as_latlong(drawn(256, 256, lambda x, y: (x, y, 0)), "angular")
    assert at(picture, AHEAD) == pytest.approx([0.5, 0.5, 0], abs=0.01)
    assert at(picture, RIGHT) == pytest.approx([0.75, 0.5, 0], abs=0.01)
    assert at(picture, LEFT) == pytest.approx([0.25, 0.5, 0], abs=0.01)
    assert at(picture, UP) == pytest.approx([0.5, 0.26, 0], abs=0.01)


def test_a_mirrored_ball_is_by_its_normals():
    picture = as_latlong(drawn(256, 256, lambda x, y: (x, y, 0)), "mirroredBall")
    assert at(picture, AHEAD) == pytest.approx([0.5, 0.5, 0], abs=0.01)
    assert at(picture, RIGHT) == pytest.approx([0.5 + np.sqrt(0.5) / 2, 0.5, 0], abs=0.01)


def test_faces_of_a_vertical_cross():
    cross = drawn(256, 192, lambda x, y: (np.floor(x * 3), np.floor(y * 4), 0))
    picture = as_latlong(cross, "cubeMapVerticalCross")
    assert at(picture, AHEAD) == pytest.approx([1, 1, 0])
    assert at(picture, RIGHT) == pytest.approx([2, 1, 0])
    assert at(picture, LEFT) == pytest.approx([0, 1, 0])
    assert at(picture, UP) == pytest.approx([1, 0, 0])
    assert at(picture, (0.5, 0.98)) == pytest.approx([1, 2, 0])
    assert at(picture, (0.01, 0.5)) == pytest.approx([1, 3, 0])


@pytest.mark.parametrize("layout", ["angular", "mirroredBall", "cubeMapVerticalCross"])
def test_what_is_even_stays_so(layout):
    picture = as_latlong(np.full((64, 48, 3), 0.7, dtype=np.float32), layout)
    assert np.abs(picture - 0.7).max() < 1e-6
