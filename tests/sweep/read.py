"""Reads a sweep's dataset as docs/sweeps.md says: read.py <victim>."""
import math
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "swing.h5")
    subprocess.run([sys.argv[1], path, "200", "1", "20"], check=True, stdout=subprocess.DEVNULL)
    with h5py.File(path, "r") as file:
        assert dict(file.attrs) == dict(dalembert_sweep=1, rows=200, done=200, failed=10, complete=1)
        runs = file["runs"][:]
        failures = file["failures"][:]
        columns = {name.decode(): (unit.decode(), role.decode()) for name, unit, role in file["columns"]}
        about = {name: file["about"][name][()].decode() for name in file["about"]}

assert runs.dtype.names == ("angle", "tension", "x", "state")
assert columns == {"angle": ("rad", "parameter"), "tension": ("N", "result"), "x": ("m", "result")}
assert np.array_equal(runs["angle"][[0, -1]], [0.1, 3.0])
assert np.allclose(runs["angle"], np.linspace(0.1, 3.0, 200), rtol=1e-15, atol=0)
bad = np.arange(200) % 20 == 19
assert np.array_equal(runs["state"], np.where(bad, 2, 1))
assert np.array_equal(np.isnan(runs["tension"]), bad)
assert np.array_equal(failures["row"], np.flatnonzero(bad))
assert np.all((failures["time"] > 0) & (failures["time"] <= 0.5))
assert all(b"a gale" in error for error in failures["error"])
# By the energy theorem the tension is at most m g (3 - 2 cos angle); errors of the run are below 1e-6 of it.
good = runs[~bad]
assert np.all(good["tension"] <= 9.81 * (3 - 2 * np.cos(good["angle"])) * (1 + 1e-6))
assert about["title"] == "sweep" and about["seed"] == "0" and about["library"].startswith("dalembert ")
assert "1 Distance" in about["scene"] and "tolerance 1e-08" in about["scene"]
assert about["parameters"].startswith("angle [rad]\ngrid: ") and about["results"] == "tension [N], x [m]"
assert math.isfinite(good["x"].sum()) and ("g++" in about["compiler"] or "clang" in about["compiler"])
