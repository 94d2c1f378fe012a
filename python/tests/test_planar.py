import signal
import threading

import numpy as np
import pytest
import wend


def test_all_combinations_against_the_exact_answer():
    table = wend.halfspace(albedo=[0.5, 0.9], sampler=["classical", "modes"], walks=20000)
    assert len(table["mean"]) == 4 and list(table["albedo"]) == [0.5, 0.5, 0.9, 0.9]
    assert np.all(np.abs(table["mean"] - table["exact"]) < 4.5 * table["std_error"] + 1e-9)
    assert table["variance"][1] < 1e-4 * table["variance"][0]
    assert "albedo" in repr(table) and "<table>" in table._repr_html_()
    assert table.rows[0]["sampler"] == "classical"


def test_a_slab_wants_a_thickness():
    table = wend.slab(thickness=np.array([1.0, 2.0]), tally="transmittance", walks=20000, seed=3)
    assert np.all(np.abs(table["mean"] - table["exact"]) < 4.5 * table["std_error"])
    with pytest.raises(TypeError, match="thickness"):
        wend.slab(albedo=0.5)


def test_an_adjoint_of_ones_own():
    table = [[2.5, 1, 0, 1, -0.6], [1, 0.5, 0, 1]]
    own = wend.halfspace(albedo=0.9, sampler="modes", adjoint=table, walks=20000)
    classical = wend.halfspace(albedo=0.9, walks=20000)
    assert abs(own["mean"][0] - own["exact"][0]) < 4.5 * own["std_error"][0]
    assert own["variance"][0] != classical["variance"][0]
    for wrong in ([], [[1, 1, 0]], [[1, -1, 0, 1]], np.full((80, 4), 1.0)):
        with pytest.raises(wend.InputError, match="adjoint"):
            wend.halfspace(albedo=0.9, sampler="modes", adjoint=wrong)
    with pytest.raises(wend.InputError, match="modes"):
        wend.halfspace(albedo=0.9, adjoint=table)


def test_control_c_ends_long_work():
    # Walks for hours.
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        wend.halfspace(albedo=0.99, walks=10**9, threads=2)
    timer.join()


def test_colours_are_tuples():
    table = wend.halfspace(albedo=(0.9, 0.8, 0.7), walks=2000)
    assert len(table["mean"]) == 1 and len(table["mean"][0]) == 3


@pytest.mark.parametrize("wrong", [{"albedo": 2}, {"sampler": "magic"}, {"walks": 0}, {"g": "x"}])
def test_values_are_checked(wrong):
    with pytest.raises(wend.InputError):
        wend.halfspace(**wrong)


def test_names_that_there_are_not_are_refused_by_python_itself():
    with pytest.raises(TypeError, match="albdo"):
        wend.halfspace(albdo=0.8)


def test_tables_become_dataframes():
    pandas = pytest.importorskip("pandas")
    frame = wend.halfspace(albedo=[0.5, 0.9], walks=1000).dataframe()
    assert isinstance(frame, pandas.DataFrame) and list(frame["albedo"]) == [0.5, 0.9]
