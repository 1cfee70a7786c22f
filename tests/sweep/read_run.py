"""Reads a run as docs/exports.md says: read_run.py <the program of that page>."""
import csv
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], "exports-1"], cwd=folder, check=True)
    with h5py.File(os.path.join(folder, "pendulum.h5")) as file:
        run = {name: column[:] for name, column in file["samples"].items()}
        dimension = {name: column.attrs["dimension"] for name, column in file["samples"].items()}
        about = dict(file.attrs)
        events = file["events"][:]
    with open(os.path.join(folder, "pendulum.csv")) as file:
        table = list(csv.reader(line for line in file if not line.startswith("#")))
    with open(os.path.join(folder, "pendulum.glb"), "rb") as file:
        assert file.read(4) == b"glTF"

text = lambda value: value.decode() if isinstance(value, bytes) else str(value)
errors = ["bob.position.error", "bob.velocity.error", "rod.lambda.error"]
assert list(run) == table[0] + errors  # in this order
numbers = np.array(table[1:], dtype=float)
assert numbers.shape == (1001, len(table[0]))
for k, name in enumerate(table[0]):
    assert np.array_equal(run[name], numbers[:, k]), name
assert text(dimension["bob.vx"]) == "length/time" and text(dimension["rod.on.bob.Zy"]) == "force"
assert about["dalembert_run"] == 1 and text(about["scene"]) == "pendulum" and about["tolerance"] == 1e-8
assert events.dtype.names == ("time", "what", "of", "time_error") and len(events) == 0
# Energy and tension of a pendulum let go at the height of its pivot: v^2 = -2 g y, T = m (v^2/l - g y/l) = -3 m g y.
off = np.abs(-run["rod.lambda"] + 3 * 9.81 * run["bob.y"])
v_squared = run["bob.vx"] ** 2 + run["bob.vy"] ** 2
assert np.allclose(v_squared, -2 * 9.81 * run["bob.y"], rtol=0, atol=1e-4)
assert off.max() < 1e-4  # errors of the run are of the order of 1e-6 of the length and of the weight
assert np.all(run["rod.lambda.error"] < 1e-3) and run["bob.position.error"].max() > 0
try:
    import pandas
except ImportError:
    sys.exit()
frame = pandas.DataFrame(run)
assert frame.shape == (1001, len(table[0]) + 3) and frame["t"].iloc[-1] == 10.0
