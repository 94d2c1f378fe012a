import pickle
import threading

import numpy as np
import pytest
import wend
from wend import guide

BOUNDS = [[0, 0, 0], [1, 1, 1]]


def sphere(rng, n):
    v = rng.normal(size=(n, 3))
    return (v / np.linalg.norm(v, axis=1, keepdims=True)).astype(np.float32)


def lit_from(direction, n=20000, seed=1):
    """Records of light around a direction, 3 + 0.5 of a sky."""
    rng = np.random.default_rng(seed)
    w = sphere(rng, n)
    radiance = 3 * np.exp(20 * (w @ np.asarray(direction, dtype=np.float32) - 1)) + 0.5
    return guide.records(rng.random((n, 3)), w, radiance, 1 / (4 * np.pi), colour=(1, 2, 3))


@pytest.fixture(scope="module")
def field():
    return guide.Field(BOUNDS).fit(lit_from([0, 0.6, 0.8]))


def integral(pdf, n=400):
    """Over the sphere, by the midpoint rule."""
    z = (np.arange(n) + 0.5) / n * 2 - 1
    phi = (np.arange(2 * n) + 0.5) / (2 * n) * 2 * np.pi
    z, phi = np.meshgrid(z, phi, indexing="ij")
    r = np.sqrt(1 - z * z)
    return pdf(np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)).sum() * 4 * np.pi / (2 * n * n)


def test_records_lie_as_the_library_has_them():
    assert guide.record_dtype.itemsize == 60
    made = guide.records([[1, 2, 3]], [0, 0, 1], [2.0], 0.5)
    assert made.shape == (1,) and made["distance"][0] == np.inf


def test_a_field_learns(field):
    assert field.is_trained and field.report["records"] == 20000
    assert field.fluence([0.5, 0.5, 0.5]) == pytest.approx(
        3 * 2 * np.pi / 20 * (1 - np.exp(-40)) + 0.5 * 4 * np.pi, rel=0.05
    )
    towards = field.radiance([0.5, 0.5, 0.5], [[0, 0.6, 0.8], [0, -0.6, -0.8]])
    assert towards[0].mean() > 4 * towards[1].mean()
    assert towards[1].mean() == pytest.approx(0.5, rel=0.2)
    whole = integral(lambda w: field.radiance(np.full(3, 0.5), w).mean(axis=-1))
    assert whole == pytest.approx(field.fluence(np.full(3, 0.5)).item(), rel=2e-3)
    assert towards[0] / towards[0].sum() == pytest.approx([1 / 6, 2 / 6, 3 / 6], rel=0.05)


def test_densities_are_normalized_and_those_of_samples(field):
    rng = np.random.default_rng(2)
    position = np.full(3, 0.5, dtype=np.float32)
    cosine = guide.Lobes.cosine()
    axis = np.float32([0, 0, 1])
    for options in ({}, {"lobes": cosine, "axis": axis}):
        assert integral(lambda w: field.pdf(position, w, **options)) == pytest.approx(1, rel=2e-3)
        u = rng.random((100000, 2))
        w, density = field.sample(position, u, **options)
        assert np.allclose(np.linalg.norm(w, axis=1), 1, atol=1e-5)
        assert np.allclose(density, field.pdf(position, w, **options), rtol=1e-4)
        # The mean of z from samples, and by quadrature.
        exact = integral(lambda v: field.pdf(position, v, **options) * v[..., 2])
        assert w[:, 2].mean() == pytest.approx(exact, abs=4 * w[:, 2].std() / np.sqrt(len(w)) + 2e-3)


def test_one_position_and_many_agree(field):
    rng = np.random.default_rng(3)
    position = np.float32([0.2, 0.7, 0.4])
    u = rng.random((1000, 2))
    many = field.sample(position, u)
    one = field.incident(position).sample(u)
    assert np.array_equal(many[0], one[0]) and np.array_equal(many[1], one[1])
    product = field.product(position, guide.Lobes.cosine(), [0, 0, 1])
    many = field.sample(position, u, lobes=guide.Lobes.cosine(), axis=[0, 0, 1])
    assert np.array_equal(many[0], product.sample(u)[0])
    scattered = field.in_scattered(position, guide.Lobes.cosine(), [0, 0, 1])
    assert scattered.mean() == pytest.approx(product.integral * field.fluence(position).item(), rel=1e-4)
    weights, means, kappas = field.incident(position).lobes
    assert weights.sum() == pytest.approx(1, rel=1e-5) and means.shape == (len(kappas), 3)


def test_shapes_broadcast(field):
    u = np.zeros((4, 5, 2), dtype=np.float32) + 0.3
    w, density = field.sample(np.full((5, 3), 0.5), u)
    assert w.shape == (4, 5, 3) and density.shape == (4, 5)
    with pytest.raises(wend.InputError, match="do not go together"):
        field.sample(np.zeros((3, 3)), np.zeros((2, 2)))
    with pytest.raises(wend.InputError, match=r"expected shape"):
        field.pdf(np.zeros(2), np.zeros(3))
    with pytest.raises(wend.InputError, match="lobes and axis"):
        field.pdf(np.zeros(3), np.float32([0, 0, 1]), lobes=guide.Lobes.cosine())


def test_neither_threads_nor_pickling_change_a_field():
    records = lit_from([1, 0, 0])
    one = guide.Field(BOUNDS).fit(records, threads=1)
    two = guide.Field(BOUNDS).fit(records, threads=2)
    assert one.to_bytes() == two.to_bytes() == pickle.loads(pickle.dumps(one)).to_bytes()
    on = one.fit(lit_from([0, 1, 0]))
    again = guide.Field.from_bytes(one.to_bytes()).fit(lit_from([0, 1, 0]))
    assert on.to_bytes() == again.to_bytes() != one.to_bytes()


def test_what_is_wrong_is_said(field):
    with pytest.raises(wend.InputError, match="learned nothing"):
        guide.Field(BOUNDS).sample(np.zeros(3), np.zeros(2))
    with pytest.raises(wend.InputError, match="record_dtype"):
        guide.Field(BOUNDS).fit(np.zeros((5, 15), dtype=np.float32))
    with pytest.raises(wend.InputError, match="lobes"):
        guide.Field(BOUNDS).fit(lit_from([0, 0, 1]), lobes=99)
    with pytest.raises(wend.InputError):
        guide.Field.from_bytes(field.to_bytes()[:-1])
    with pytest.raises(wend.InputError, match="corners"):
        guide.Field([[1, 1, 1], [0, 0, 0]])
    bad = lit_from([0, 0, 1])
    bad["radiance"][::100] = np.nan
    assert guide.Field(BOUNDS).fit(bad).report["ignored"] == 200


def test_threads_may_ask_at_once(field):
    results = []

    def ask():
        results.append(field.sample(np.full(3, 0.5), np.random.default_rng(5).random((50000, 2))))

    workers = [threading.Thread(target=ask) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all(np.array_equal(results[0][0], other[0]) for other in results)


def test_phase_functions():
    for phase, g in (
        (guide.Phase.henyey_greenstein(0.6), 0.6),
        (guide.Phase.mixture([(1, 0.8), (1, -0.2)]), 0.3),
        (guide.Phase.tabulated([-1, 1], [1, 1]), 0),
        (guide.Phase.tabulated([-1, 0, 1], [0, 1, 2]), 1 / 3),
    ):
        assert phase.mean_cosine == pytest.approx(g, abs=1e-4)
        assert integral(lambda w: phase.evaluate(w[..., 2])) == pytest.approx(1, rel=1e-3)
        u = np.random.default_rng(1).random((50000, 2))
        w = phase.sample([0, 0, 1], u)
        assert w[:, 2].mean() == pytest.approx(g, abs=4 / np.sqrt(len(u)))
        assert sum(weight for weight, _ in phase.lobes.parts) == pytest.approx(1, rel=1e-4)
    with pytest.raises(wend.InputError):
        guide.Phase.henyey_greenstein(1.0)
    with pytest.raises(wend.InputError):
        guide.Phase.tabulated([-1, 1], [-1, 1])


def test_the_recorder_sweeps_back():
    """Two vertices by hand: L1 = gathered, L0 = gathered + weights on the way times L1."""
    recorder = guide.PathRecorder(2)
    up = np.float32([0, 0, 1])
    recorder.scatter([True, True], np.zeros(3), up, 0.25, 0.5, classical_density=0.2, guided_density=0.3)
    recorder.meet([2.0, np.inf])
    recorder.gather([[1, 1, 1], [0, 0, 0]])
    recorder.weigh(0.8)
    recorder.gather(0.5)
    recorder.scatter([True, False], np.ones(3), up, 0.1, [0.9, 0.6, 0.3])
    recorder.weigh(2.0)
    recorder.gather(4.0)
    made = recorder.records()
    assert len(made) == 3
    second = 2 * 4.0
    expected = 1 + 0.8 * 0.5 + 0.8 * second * np.array([0.9, 0.6, 0.3])
    assert made["colour"][0] == pytest.approx(expected, rel=1e-6)
    assert made["radiance"][0] == pytest.approx(expected.mean(), rel=1e-6)
    assert made["colour"][1] == pytest.approx(np.full(3, 0.4), rel=1e-6)
    assert made["radiance"][2] == pytest.approx(second)
    assert made["scattered"][0] == pytest.approx(0.5 * expected.mean() * 0.25, rel=1e-6)
    assert list(made["distance"]) == [2, np.inf, np.inf]
