#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_ping.py OUT [PING]: a synthetic ping for benchmarks, as published with the baselines that we compare with.

int16 power in steps of 10 log10(2)/256 dB, C order [fan 20][beam 25][sample 1319]: beam-dependent background, five
schools, speckle, near field, surface fan, impulses, three corrupted packets and two stretches of interference at constant
range. Needs numpy; the answer does not depend on its version (PCG64), which the hash checks.
"""

import hashlib
import sys

import numpy as np

FANS, BEAMS, SAMPLES, SPACING_M = 20, 25, 1319, 0.38
UNIT_DB = 10 * np.log10(2) / 256
RAD = np.pi / 180
SHA256_OF_PING_0 = "2ad8e4032002271a"

# azimuth deg, elevation deg, range m, semi-axes m, level dB
SCHOOLS = [
    (-8, 14, 180, 70, 50, 25, 0),
    (12, 20, 260, 30, 40, 18, 0),
    (2, 30, 90, 10, 12, 6, -6),
    (-20, 10, 400, 80, 60, 30, 6),
    (20, 26, 330, 25, 20, 15, 6),
]


def make_ping(ping):
    g = np.random.Generator(np.random.PCG64(20070101 + ping))
    f, b, r = np.meshgrid(np.arange(FANS), np.arange(BEAMS), np.arange(SAMPLES), indexing="ij")
    R = (r + 0.5) * SPACING_M
    az = (-30 + 60 * (b + 0.5) / BEAMS) * RAD
    el = 45 * (f + 0.5) / FANS * RAD
    x, y, z = R * np.cos(el) * np.sin(az), R * np.cos(el) * np.cos(az), R * np.sin(el)
    p = 1e-12 * (1 + 0.3 * np.sin(f * 1.3) + 0.2 * np.sin(b * 0.7))
    loss_db = 20 * np.log10(np.maximum(R, 1)) + 2 * 0.025 * R
    for a, e, q, sa, sb, sc, db in SCHOOLS:
        q = q + 2.5 * ping
        e, a = e * RAD, a * RAD
        cx, cy, cz = q * np.cos(e) * np.sin(a), q * np.cos(e) * np.cos(a), q * np.sin(e)
        d = ((x - cx) / sa) ** 2 + ((y - cy) / sb) ** 2 + ((z - cz) / sc) ** 2
        p = p + np.where(d < 1, 10 ** ((db - 42 - loss_db) / 10) * (1.2 - d), 0)
    p = p * g.exponential(size=p.shape)
    p += np.where(R < 15, 10 ** (-6 - 0.2 * R) * g.exponential(size=p.shape), 0)
    p[0] += 10**-10.2 * g.exponential(size=p[0].shape)
    p.reshape(-1)[g.integers(0, p.size, 1320)] = 10 ** (-5 - g.exponential(size=1320) / 2)
    for _ in range(3):
        row, r0 = g.integers(0, FANS * BEAMS), g.integers(100, 900)
        p.reshape(FANS * BEAMS, SAMPLES)[row, r0 : r0 + 400] = 10**-6.5 * g.exponential(size=400)
    for k in range(2):
        r0 = g.integers(100, 1100)
        w = 3 + 3 * k
        p[:, :, r0 : r0 + w] += 10**-7.5 * g.exponential(size=(FANS, BEAMS, w))
    return np.clip(np.rint(10 * np.log10(p + 1e-17) / UNIT_DB), -32768, 32767).astype("<i2")


def main():
    ping = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    counts = make_ping(ping).tobytes()
    digest = hashlib.sha256(counts).hexdigest()
    if ping == 0 and not digest.startswith(SHA256_OF_PING_0):
        sys.exit(f"make_ping.py: hash {digest[:16]} instead of {SHA256_OF_PING_0}: not the published ping")
    with open(sys.argv[1], "wb") as out:
        out.write(counts)


if __name__ == "__main__":
    main()
