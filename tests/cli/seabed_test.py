# SPDX-License-Identifier: Apache-2.0
"""The seabed as a table of beams and a raster, against the simulator's truth/depth.tif and worked out again. Rasters are read by a
few lines of our own, and by GDAL's tools where they are installed."""
import math
import shutil
import struct
import subprocess
import unittest
import zlib

import sonarx
from sonarx import OUT, SURVEY, TRUTH, Case

try:
    import numpy
except ImportError:
    numpy = None


def read_tiff(path):
    """(bands [band][row][column], west, north, step x, step y) of a tiled, deflated 32-bit TIFF with predictor 3"""
    data = path.read_bytes()
    at = struct.unpack_from("<I", data, 4)[0]
    tags = {}
    for i in range(struct.unpack_from("<H", data, at)[0]):
        tag, kind, count, value = struct.unpack_from("<HHI4s", data, at + 2 + 12 * i)
        form = {1: "u1", 2: "u1", 3: "<u2", 4: "<u4", 12: "<f8"}.get(kind)
        if form is None:
            continue
        size = numpy.dtype(form).itemsize * count
        start = struct.unpack("<I", value)[0]
        tags[tag] = numpy.frombuffer(value[:size] if size <= 4 else data[start:start + size], form)
    columns, rows, wide, high = (int(tags[tag][0]) for tag in (256, 257, 322, 323))
    bands = int(tags[277][0])
    across = -(-columns // wide)
    out = numpy.zeros((-(-rows // high) * high, across * wide, bands), "f4")
    for i, (start, size) in enumerate(zip(tags[324], tags[325])):
        tile = numpy.frombuffer(zlib.decompress(data[start:start + size]), "u1").reshape(high, wide * 4, bands)
        planes = numpy.cumsum(tile, axis=1, dtype="u1").reshape(high, 4, wide * bands)
        values = numpy.ascontiguousarray(planes.transpose(0, 2, 1)).view(">f4").reshape(high, wide, bands)
        y, x = i // across * high, i % across * wide
        out[y:y + high, x:x + wide] = values
    return (out[:rows, :columns].transpose(2, 0, 1), tags[33922][3], tags[33922][4], tags[33550][0], tags[33550][1])


def utm(latitude, longitude, zone):
    """Easting and northing on the northern half, by the series of Krueger in n."""
    a, f = 6378137.0, 1 / 298.257223563
    n = f / (2 - f)
    radius = a / (1 + n) * (1 + n**2 / 4 + n**4 / 64)
    alpha = (n / 2 - 2 * n**2 / 3 + 5 * n**3 / 16, 13 * n**2 / 48 - 3 * n**3 / 5, 61 * n**3 / 240)
    phi, away = numpy.radians(latitude), numpy.radians(longitude - (6 * zone - 183))
    root = 2 * math.sqrt(n) / (1 + n)
    t = numpy.sinh(numpy.arctanh(numpy.sin(phi)) - root * numpy.arctanh(root * numpy.sin(phi)))
    xi, eta = numpy.arctan2(t, numpy.cos(away)), numpy.arctanh(numpy.sin(away) / numpy.sqrt(1 + t**2))
    north = xi + sum(k * numpy.sin(2 * (j + 1) * xi) * numpy.cosh(2 * (j + 1) * eta) for j, k in enumerate(alpha))
    east = eta + sum(k * numpy.cos(2 * (j + 1) * xi) * numpy.sinh(2 * (j + 1) * eta) for j, k in enumerate(alpha))
    return 500000 + 0.9996 * radius * east, 0.9996 * radius * north


@unittest.skipIf(numpy is None, "python3-numpy is not installed")
class Seabed(Case):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.fresh("seabed")
        code, _, err = sonarx.run("export", OUT, "--to", "seabed", "--survey", SURVEY, "-o", cls.folder)
        assert code == 0, err
        rows = sonarx.read_csv(cls.folder / "seabed.csv")
        names = ("latitude", "longitude", "depth_m", "depth_se_m", "fan")
        cls.rows = {name: numpy.array([float(row[name]) for row in rows]) for name in names}

    def test_depths_lie_within_their_error(self):
        self.assertGreater(len(self.rows["depth_m"]), 1000)
        (truth,), west, north, dx, dy = read_tiff(TRUTH / "depth.tif")
        column = ((self.rows["longitude"] - west) / dx).astype(int)
        row = ((north - self.rows["latitude"]) / dy).astype(int)
        error = self.rows["depth_m"] + truth[row, column]
        self.assertLess(abs(error.mean()), 0.005 * self.rows["depth_m"].mean())
        off = abs(error) / self.rows["depth_se_m"]
        self.assertTrue(0.5 < (off < 1).mean() < 0.85, (off < 1).mean())
        self.assertGreater((off < 2).mean(), 0.88)

    def test_cells_are_weighted_means_of_the_table(self):
        bands, west, north, step, _ = read_tiff(self.folder / "seabed.tif")
        self.assertEqual(step, 10)
        zone = int((self.rows["longitude"][0] + 180) // 6) + 1
        east, northing = utm(self.rows["latitude"], self.rows["longitude"], zone)
        column, row = ((east - west) // step).astype(int), ((north - northing) // step).astype(int)
        weight = self.rows["depth_se_m"]**-2
        sums, depths, counts = (numpy.zeros(bands.shape[1:]) for _ in range(3))
        numpy.add.at(sums, (row, column), weight)
        numpy.add.at(depths, (row, column), weight * self.rows["depth_m"])
        numpy.add.at(counts, (row, column), 1)
        fans = numpy.zeros((*counts.shape, 64), bool)
        fans[row, column, self.rows["fan"].astype(int)] = True
        hit = counts > 0
        # Eight decimals of a degree are a millimetre: a beam at a cell's border may lie on its other side.
        same = hit & (bands[2] == counts)
        self.assertGreater(same.sum(), 0.99 * hit.sum())
        self.assertTrue((bands[:, ~hit & (bands[2] < 0)] == -32767).all())
        numpy.testing.assert_allclose(bands[0][same], (depths / numpy.where(hit, sums, 1))[same], atol=1e-3)
        error = numpy.sqrt(counts / numpy.where(hit, sums, 1) / numpy.maximum(fans.sum(axis=2), 1))
        numpy.testing.assert_allclose(bands[1][same], error[same], rtol=1e-5)

    @unittest.skipIf(shutil.which("gdallocationinfo") is None, "gdal-bin is not installed")
    def test_gdal_reads_it(self):
        raster = self.folder / "seabed.tif"
        told = subprocess.run(["gdalinfo", raster], capture_output=True, text=True, check=True, timeout=60).stdout
        for words in ("UTM zone", "NoData Value=-32767", "standard_error", "count"):
            self.assertIn(words, told)
        bands, *_ = read_tiff(raster)
        row, column = (int(i[0]) for i in numpy.nonzero(bands[2] > 0))
        said = subprocess.run(["gdallocationinfo", "-valonly", raster, str(column), str(row)], capture_output=True,
                              text=True, check=True, timeout=60).stdout.split()
        numpy.testing.assert_allclose([float(value) for value in said], bands[:, row, column], rtol=1e-6)

    def test_cells_as_asked_and_what_is_refused(self):
        folder = self.fresh("seabed-geographic")
        self.sonarx("export", OUT, "--to", "seabed", "--survey", SURVEY, "--cell-m", 50, "--geographic", "-o", folder)
        bands, west, north, dx, dy = read_tiff(folder / "seabed.tif")
        self.assertAlmostEqual(dy * 111320, 50, 6)
        self.assertTrue(west <= self.rows["longitude"].min() and north >= self.rows["latitude"].max())
        self.assertEqual(bands[2][bands[2] > 0].sum(), len(self.rows["depth_m"]))
        self.sonarx("render", "survey-map", OUT, "--depth-raster", folder / "seabed.tif", "-o", folder / "map.png")
        self.one_line_error("export", OUT, "--to", "seabed", "-o", folder, code=2, names="--survey")
        self.one_line_error("export", OUT, "--to", "csv", "--cell-m", 5, "-o", folder, code=2, names="--cell-m")


if __name__ == "__main__":
    sonarx.main()
