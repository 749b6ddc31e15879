#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_scene.py FOLDER: the four scenes that renderers are measured on, as published with the baselines.

Writes volume.f32 (float32 dB, [fan 20][beam 25][sample 1319], fans counted from the surface, azimuth 0..60 degrees,
depression 0..45, 0.38 m a sample), schools.tf and haze.tf (256 x red, green, blue, extinction per metre over -90..-20
dB), overview.view and closeup.view (eye, right, up, forward, tan of half the field of view, target, field of view in
degrees; x, y, z up). Needs numpy; the answer does not depend on its version (PCG64), which the hash checks.
"""

import hashlib
import sys
from pathlib import Path

import numpy as np

FANS, BEAMS, SAMPLES, SPACING_M = 20, 25, 1319, 0.38
SHA256 = "44c81cd617560757"
# range m, azimuth deg, depression deg; semi-axes along, across, vertical m; peak dB
SCHOOLS = [
    (120, 20, 18, 14, 10, 6, -38),
    (210, 42, 12, 30, 18, 8, -35),
    (270, 12, 26, 22, 30, 12, -42),
    (330, 33, 20, 45, 28, 14, -33),
    (420, 50, 30, 35, 45, 18, -40),
    (460, 22, 9, 25, 60, 12, -45),
]


def place(range_m, azimuth, depression):
    a, e = np.radians(azimuth), np.radians(depression)
    return np.array([range_m * np.cos(e) * np.cos(a), range_m * np.cos(e) * np.sin(a), -range_m * np.sin(e)])


def make_volume():
    rng = np.random.default_rng(20070501)
    azimuth = np.radians(np.linspace(0.0, 60.0, BEAMS))
    depression = np.radians(np.linspace(0.0, 45.0, FANS))
    e, a, r = np.meshgrid(depression, azimuth, SPACING_M * np.arange(SAMPLES), indexing="ij")
    x, y, z = r * np.cos(e) * np.cos(a), r * np.cos(e) * np.sin(a), -r * np.sin(e)
    linear = 10 ** ((-78.0 + 3.5 * rng.standard_normal(e.shape) + 4.0 * (r / 500.0)) / 10)
    for range_m, az, el, along, across, vertical, peak in SCHOOLS:
        c, s = np.cos(np.radians(az)), np.sin(np.radians(az))
        dx, dy, dz = (p - q for p, q in zip((x, y, z), place(range_m, az, el)))
        u, w = dx * c + dy * s, -dx * s + dy * c
        q = np.sqrt((u / along) ** 2 + (w / across) ** 2 + (dz / vertical) ** 2)
        linear += np.clip((1.15 - q) / 0.3, 0, 1) * 10 ** ((peak + 3.0 * rng.standard_normal(e.shape)) / 10)
    linear += np.where(r < 15.0, 10 ** ((-40 + 5 * rng.standard_normal(e.shape)) / 10), 0)
    linear[0] += 10 ** ((-62 + 4 * rng.standard_normal(linear[0].shape)) / 10)
    return np.clip(10 * np.log10(linear), -90, -20).astype("<f4")


def unit(v):
    v = np.array(v, float)
    return v / np.linalg.norm(v)


def write_views(folder):
    a = place(1, 30, 0)
    side, up = np.array([-a[1], a[0], 0]), np.array([0, 0, 1.0])
    towards_eye = unit(-0.35 * a - 0.75 * side + 0.6 * up)
    for name, target, distance in (("overview", place(280, 30, 20), 880), ("closeup", place(330, 33, 20), 150)):
        forward = -towards_eye
        right = unit(np.cross(forward, up))
        rows = [target + distance * towards_eye, right, np.cross(right, forward), forward,
                [np.tan(np.radians(35.0) / 2)], target, [35.0]]
        text = "\n".join(" ".join("%.9g" % v for v in row) for row in rows) + "\n"
        (folder / f"{name}.view").write_text(text)


def write_tables(folder):
    db = np.linspace(-90, -20, 256)
    colours = [(-80, (0.05, 0.15, 0.35)), (-65, (0.1, 0.45, 0.75)), (-55, (0.2, 0.8, 0.6)),
               (-47, (0.95, 0.85, 0.2)), (-38, (0.9, 0.25, 0.1)), (-28, (1, 1, 1))]
    school = [(-55, 0.01), (-45, 0.06), (-30, 0.3), (-20, 0.3)]
    tables = {"schools": [(-90, 0), (-62, 0), *school],
              "haze": [(-90, 0), (-80, 0), (-72, 0.0008), (-62, 0.003), *school]}
    rgb = [np.interp(db, [p[0] for p in colours], [p[1][k] for p in colours]) for k in range(3)]
    for name, points in tables.items():
        extinction = np.interp(db, [p[0] for p in points], [p[1] for p in points], left=0)
        np.stack([*rgb, extinction], 1).astype("<f4").tofile(folder / f"{name}.tf")


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    volume = make_volume()
    # The libraries' exp and log may differ in the last digit: the hash is over hundredths of a decibel.
    digest = hashlib.sha256(np.rint(volume * 100).astype("<i2").tobytes()).hexdigest()[:16]
    if digest != SHA256:
        sys.exit(f"make_scene.py: hash {digest} instead of {SHA256}: not the published volume")
    (folder / "volume.f32").write_bytes(volume.tobytes())
    write_views(folder)
    write_tables(folder)


if __name__ == "__main__":
    main()
