"""The learned field: records of walks in, incident radiance out; for a renderer of your own.

    field = wend.guide.Field(bounds).fit(records)         # learn
    direction, pdf = field.sample(position, u)            # draw, for many positions at once
    pdf = field.pdf(position, direction)

Directions are unit vectors of propagation, away from the vertex; densities are per steradian, positions in scene units.
Arrays of vectors have the shape (..., 3) and broadcast. A field never changes, may be asked by any number of threads,
and can be pickled.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _wend
from ._arrays import Array, leading_shape, rows, spread
from ._errors import InputError
from ._path_records import PathRecorder, record_dtype, records

__all__ = [
    "Distribution",
    "Field",
    "Fields",
    "Lobes",
    "PathRecorder",
    "Phase",
    "record_dtype",
    "records",
]

class Lobes:
    """What scatters, as a function of the angle to an axis: von Mises-Fisher lobes that the guide multiplies with."""

    def __init__(self, native: _wend.Lobes) -> None:
        self._native = native

    @classmethod
    def cosine(cls) -> Lobes:
        """A surface that reflects diffusely; the axis is its normal."""
        return cls(_wend.Lobes.cosine())

    @classmethod
    def custom(cls, weights: npt.ArrayLike, kappas: npt.ArrayLike) -> Lobes:
        """1 to 24 lobes of relative weights and concentrations, at most 1e5; around the opposite of the axis where
        the concentration is negative."""
        pairs = np.stack(np.broadcast_arrays(np.atleast_1d(weights), np.atleast_1d(kappas)), axis=-1)
        return cls(_wend.Lobes.custom([(float(w), float(k)) for w, k in pairs]))

    @property
    def parts(self) -> list[tuple[float, float]]:
        """(weight, concentration) of each lobe; the weights add up to 1."""
        return self._native.parts


class Phase:
    """A phase function: density per steradian of the cosine between the directions before and after a collision."""

    def __init__(self, native: _wend.Phase) -> None:
        self._native = native

    @classmethod
    def henyey_greenstein(cls, g: float) -> Phase:
        """Henyey and Greenstein's, with mean cosine g in (-1, 1)."""
        return cls(_wend.Phase.henyey_greenstein(g))

    @classmethod
    def mixture(cls, parts: list[tuple[float, float]]) -> Phase:
        """1 to 4 of those, as (weight, g)."""
        return cls(_wend.Phase.mixture(parts))

    @classmethod
    def tabulated(cls, cosines: npt.ArrayLike, values: npt.ArrayLike) -> Phase:
        """Linear between the nodes of a table: cosines from -1 to 1, increasing, and values in any scale."""
        return cls(_wend.Phase.tabulated([float(c) for c in np.ravel(cosines)], [float(v) for v in np.ravel(values)]))

    @classmethod
    def fournier_forand(cls, index: float, slope: float) -> Phase:
        """Of particles in water: refractive index relative to it, above 1, and slope of their sizes, 3 to 5."""
        return cls(_wend.Phase.fournier_forand(index, slope))

    def evaluate(self, cosine: npt.ArrayLike) -> Array:
        """Density per steradian."""
        values = np.ascontiguousarray(cosine, dtype=np.float32)
        return self._native.evaluate(values.reshape(-1)).reshape(values.shape)

    def sample(self, before: npt.ArrayLike, u: npt.ArrayLike) -> Array:
        """Directions after the collision, (..., 3), from those before and points of the unit square, (..., 2)."""
        shape = leading_shape(before, u)
        return self._native.sample(spread(before, 3, "before", shape), spread(u, 2, "u", shape)).reshape(*shape, 3)

    @property
    def mean_cosine(self) -> float:
        """In (-1, 1)."""
        return self._native.mean_cosine

    def moment(self, degree: int) -> float:
        """The integral of the function times Legendre's polynomial of the cosine."""
        return self._native.moment(degree)

    @property
    def lobes(self) -> Lobes:
        """Its picture for the guide; the axis is the direction before the collision."""
        return Lobes(self._native.lobes())


class Distribution:
    """A distribution of directions at one position: the incident radiance, or its product with what scatters."""

    def __init__(self, native: _wend.Distribution) -> None:
        self._native = native

    def sample(self, u: npt.ArrayLike, *, threads: int = 1) -> tuple[Array, Array]:
        """Directions (..., 3) and their densities (...) from points of the unit square, (..., 2)."""
        shape = leading_shape(u)
        direction, density = self._native.sample(spread(u, 2, "u", shape), threads)
        return direction.reshape(*shape, 3), density.reshape(shape)

    def pdf(self, direction: npt.ArrayLike, *, threads: int = 1) -> Array:
        """Density of directions (..., 3), 1/sr."""
        shape = leading_shape(direction)
        return self._native.pdf(spread(direction, 3, "direction", shape), threads).reshape(shape)

    def product(self, lobes: Lobes, axis: npt.ArrayLike) -> Distribution:
        """Incident radiance times what scatters around `axis`, (3,), normalized."""
        x, y, z = (float(c) for c in rows(axis, 3, "axis", 1)[0])
        return Distribution(self._native.product(lobes._native, (x, y, z)))

    @property
    def integral(self) -> float | None:
        """Of a product of both densities, 1/sr; times the fluence it estimates the in-scattered radiance."""
        return self._native.integral

    @property
    def lobes(self) -> tuple[Array, Array, Array]:
        """Of the incident radiance: weights (n,), mean directions (n, 3) and concentrations (n,)."""
        return self._native.lobes()


class Field:
    """Incident radiance by cells of space, learned.

    Args:
        bounds: two corners of the scene's box, in scene units.
    """

    def __init__(self, bounds: npt.ArrayLike) -> None:
        lower, upper = rows(bounds, 3, "bounds", 2)
        if not (np.isfinite(lower).all() and np.isfinite(upper).all() and (lower <= upper).all()):
            raise InputError("bounds: expected two finite corners, the least first")
        self._native = _wend.Field.empty(tuple(lower.tolist()), tuple(upper.tolist()))
        self._report: dict[str, Any] = {}

    @classmethod
    def _of(cls, native: _wend.Field, report: dict[str, Any] | None = None) -> Field:
        field = cls.__new__(cls)
        field._native = native
        field._report = report or {}
        return field

    def fit(
        self,
        records: npt.NDArray[Any],
        *,
        lobes: int = 8,
        leaf_samples: float = 1000,
        max_depth: int = 32,
        max_bytes: int = 256 << 20,
        decay: float = 0.8,
        threads: int = 0,
    ) -> Field:
        """The next field; this one stays as it is.

        Args:
            records: of `record_dtype`, (N,), in an order that is always the same: the field depends on it, though
                not on the threads. Taken as they lie in memory.
            lobes: that a cell begins with, 1 to 16.
            leaf_samples: a cell with more records is split where its halves differ.
            max_depth: most splits above a cell, at most 64.
            max_bytes: memory of the field.
            decay: how much the records of earlier fits count, 0 to 1.
            threads: 0: all.

        Raises:
            InputError: for values out of range, or another array.
        """
        if not isinstance(records, np.ndarray) or records.dtype != record_dtype:
            raise InputError("records: expected an array of wend.guide.record_dtype; wend.guide.records() makes one")
        flat = np.ascontiguousarray(records).view(np.float32).reshape(-1, record_dtype.itemsize // 4)
        native, report = self._native.fit(flat, lobes, leaf_samples, max_depth, max_bytes, decay, threads)
        return Field._of(native, report)

    @property
    def report(self) -> dict[str, Any]:
        """Of the fit: `records`, `ignored` (not finite or out of range), `dark`, `cells`, `bytes`,
        `memory_limited`."""
        return self._report

    @property
    def is_trained(self) -> bool:
        """Whether it can be asked."""
        return self._native.is_trained

    @property
    def nbytes(self) -> int:
        """Memory."""
        return self._native.nbytes

    @property
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Two corners of the box that it was made for."""
        return self._native.bounds

    def __len__(self) -> int:
        """Number of cells."""
        return self._native.cell_count

    def incident(self, position: npt.ArrayLike) -> Distribution:
        """Directions in proportion to the incident radiance at one position, (3,)."""
        x, y, z = (float(c) for c in rows(position, 3, "position", 1)[0])
        return Distribution(self._native.incident((x, y, z)))

    def product(self, position: npt.ArrayLike, lobes: Lobes, axis: npt.ArrayLike) -> Distribution:
        """The same times what scatters there around `axis`, (3,)."""
        return self.incident(position).product(lobes, axis)

    def sample(
        self,
        position: npt.ArrayLike,
        u: npt.ArrayLike,
        *,
        lobes: Lobes | None = None,
        axis: npt.ArrayLike | None = None,
        threads: int = 1,
    ) -> tuple[Array, Array]:
        """Draw directions at many positions.

        Args:
            position: (..., 3), scene units.
            u: points of the unit square [0, 1)^2, (..., 2).
            lobes: what scatters, if directions shall follow the product with it.
            axis: of the lobes, (..., 3): normals, or directions before the collision.
            threads: 0: all. The result does not depend on it.

        Returns:
            Directions (..., 3) and their densities (...), 1/sr.

        Raises:
            InputError: as long as the field has learned nothing, or for shapes that do not go together.
        """
        shape = leading_shape(position, u, *(() if axis is None else (axis,)))
        direction, density = self._native.sample(
            spread(position, 3, "position", shape),
            spread(u, 2, "u", shape),
            None if lobes is None else lobes._native,
            None if axis is None else spread(axis, 3, "axis", shape),
            threads,
        )
        return direction.reshape(*shape, 3), density.reshape(shape)

    def pdf(
        self,
        position: npt.ArrayLike,
        direction: npt.ArrayLike,
        *,
        lobes: Lobes | None = None,
        axis: npt.ArrayLike | None = None,
        threads: int = 1,
    ) -> Array:
        """Density that `sample` has for directions (..., 3), 1/sr."""
        shape = leading_shape(position, direction, *(() if axis is None else (axis,)))
        density = self._native.pdf(
            spread(position, 3, "position", shape),
            spread(direction, 3, "direction", shape),
            None if lobes is None else lobes._native,
            None if axis is None else spread(axis, 3, "axis", shape),
            threads,
        )
        return density.reshape(shape)

    def fluence(self, position: npt.ArrayLike, *, threads: int = 1) -> Array:
        """The integral of the incident radiance over directions, by the cell of each position: radiance times sr."""
        shape = leading_shape(position)
        return self._native.fluence(spread(position, 3, "position", shape), threads).reshape(shape)

    def classical_share(self, position: npt.ArrayLike, *, threads: int = 1) -> Array:
        """How much of directions is best drawn by your own sampling: 0.1 to 0.9, and 0.3 where nothing tells it."""
        shape = leading_shape(position)
        return self._native.classical_share(spread(position, 3, "position", shape), threads).reshape(shape)

    def radiance(self, position: npt.ArrayLike, direction: npt.ArrayLike, *, threads: int = 1) -> Array:
        """The radiance that arrives from directions (..., 3), by channel: (..., 3)."""
        shape = leading_shape(position, direction)
        found = self._native.radiance(
            spread(position, 3, "position", shape), spread(direction, 3, "direction", shape), threads
        )
        return found.reshape(*shape, 3)

    def in_scattered(
        self, position: npt.ArrayLike, lobes: Lobes, axis: npt.ArrayLike, *, threads: int = 1
    ) -> Array:
        """The integral of radiance times what scatters, by channel, (..., 3): what is scattered on, but for the
        albedo."""
        shape = leading_shape(position, axis)
        found = self._native.in_scattered(
            spread(position, 3, "position", shape), lobes._native, spread(axis, 3, "axis", shape), threads
        )
        return found.reshape(*shape, 3)

    def cells(self) -> dict[str, Array]:
        """By cell: `lower` and `upper` corners (n, 3), `fluence`, `lobes`, `classical_share` and `records` (n,)."""
        names = ("lower", "upper", "fluence", "lobes", "classical_share", "records")
        return dict(zip(names, self._native.cells()))

    def to_bytes(self) -> bytes:
        """All that it knows, with a version and a checksum."""
        return self._native.to_bytes()

    @classmethod
    def from_bytes(cls, data: bytes) -> Field:
        """The field again: it answers the same, bit for bit, and learns on.

        Raises:
            InputError: for bytes that are no field, cut or changed.
        """
        return cls._of(_wend.Field.from_bytes(data))

    def __reduce__(self) -> tuple[Any, tuple[bytes]]:
        return Field.from_bytes, (self.to_bytes(),)

    def __repr__(self) -> str:
        return f"<wend.guide.Field of {len(self)} cells, {self.nbytes / 1e6:.1f} MB>"


class Fields:
    """What a render learned: a field of surfaces and one of volumes."""

    def __init__(self, surface: Field, volume: Field) -> None:
        self._native = _wend.Fields(surface._native, volume._native)

    @classmethod
    def _of(cls, native: _wend.Fields) -> Fields:
        fields = cls.__new__(cls)
        fields._native = native
        return fields

    @property
    def surface(self) -> Field:
        """Asked at surfaces."""
        return Field._of(self._native.surface)

    @property
    def volume(self) -> Field:
        """Asked at collisions in media."""
        return Field._of(self._native.volume)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write both, as `wend render --save-field` does."""
        self._native.save(os.fspath(path))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Fields:
        """Read them again.

        Raises:
            InputError: for a file that is missing, of another kind, or changed.
        """
        return cls._of(_wend.Fields.load(os.fspath(path)))
