# SPDX-License-Identifier: Apache-2.0
"""What other programs are given, read back by readers that share nothing with ours."""
import base64
import html.parser
import json
import math
import re
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree
import zlib

import sonarx
from sonarx import OUT, SURVEY, Case

try:
    import numpy
except ImportError:
    numpy = None


def ply(file):
    """Comments, corners [n][3] and triangles [m][3]."""
    raw = file.read_bytes()
    head, body = raw.split(b"end_header\n", 1)
    head = head.decode("ascii")
    assert head.startswith("ply\nformat binary_little_endian 1.0\n"), head
    vertices, faces = (int(re.search(rf"element {what} (\d+)", head)[1]) for what in ("vertex", "face"))
    corners = numpy.frombuffer(body, "<f4", 3 * vertices).reshape(-1, 3).astype(float)
    rows = numpy.frombuffer(body[12 * vertices:], numpy.dtype([("n", "u1"), ("at", "<u4", 3)]))
    assert len(rows) == faces and (rows["n"] == 3).all()
    return head, corners, rows["at"].astype(int)


def glb(file):
    """The document and the meshes by node's name."""
    raw = file.read_bytes()
    magic, version, length, size, kind = struct.unpack_from("<4sIII4s", raw)
    assert (magic, version, length, kind) == (b"glTF", 2, len(raw), b"JSON")
    said = json.loads(raw[20:20 + size])
    bytes_, kind = struct.unpack_from("<I4s", raw, 20 + size)
    data = raw[28 + size:]
    assert kind == b"BIN\0" and bytes_ == len(data) and said["buffers"][0]["byteLength"] <= bytes_

    def values(accessor):
        accessor = said["accessors"][accessor]
        view = said["bufferViews"][accessor["bufferView"]]
        kind, width = {"VEC3": ("<f4", 3), "SCALAR": ("<u4", 1)}[accessor["type"]]
        assert accessor["componentType"] == {"<f4": 5126, "<u4": 5125}[kind]
        out = numpy.frombuffer(data[view["byteOffset"]:][:view["byteLength"]], kind)
        assert len(out) == accessor["count"] * width
        return out, accessor
    meshes = {}
    for node in said["nodes"]:
        part = said["meshes"][node["mesh"]]["primitives"][0]
        places, accessor = values(part["attributes"]["POSITION"])
        places = places.reshape(-1, 3).astype(float)
        assert numpy.allclose(places.min(0), accessor["min"]) and numpy.allclose(places.max(0), accessor["max"])
        meshes[node["name"]] = places, values(part["indices"])[0].reshape(-1, 3).astype(int)
    return said, meshes


def volume_and_middle(corners, triangles):
    a, b, c = (corners[triangles[:, k]] - corners[0] for k in range(3))
    six = numpy.einsum("ij,ij->i", a, numpy.cross(b, c))
    return six.sum() / 6, (six[:, None] * (a + b + c)).sum(0) / 4 / six.sum() + corners[0]


@unittest.skipIf(numpy is None, "python3-numpy is not installed")
class Meshes(Case):
    def setUp(self):
        self.schools = [r for r in sonarx.read_csv(OUT / "schools.csv") if r["status"] != "rejected"]
        self.rows = {(r["observation"], r["school_id"], r["ping_index"]): r
                     for r in sonarx.read_csv(OUT / "school_pings.csv")}

    def test_ply_is_closed_outward_and_where_the_tables_say(self):
        dest = self.fresh("export-ply")
        self.sonarx("export", OUT, "--to", "ply", "-o", dest)
        files = sorted(dest.glob("*.ply"))
        self.assertEqual(len(files), len(self.schools), "a mesh a school")
        for file in files:
            name = re.fullmatch(r"(obs-\d+)-school-(\d+)-ping-(\d+)", file.stem).groups()
            row = self.rows[name]
            whole = [r for r in self.rows.values() if r["observation"] == name[0] and r["school_id"] == name[1]]
            whole = [r for r in whole if r["touches_edge"] == "0"] or whole
            self.assertEqual(row, max(whole, key=lambda r: float(r["backscatter_m2"])), "the strongest, of whole ones")
            head, corners, triangles = ply(file)
            edges = numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
            keys = edges[:, 0] * len(corners) + edges[:, 1]
            self.assertEqual(len(numpy.unique(keys)), len(keys), "an edge once in each direction")
            self.assertTrue(numpy.isin(edges[:, 1] * len(corners) + edges[:, 0], keys).all(), "nothing gapes")
            volume, middle = volume_and_middle(corners, triangles)
            self.assertGreater(volume, 0.2 * float(row["volume_m3"]))
            self.assertLess(volume, 1.02 * float(row["volume_m3"]), "voxels that are less sure lie outside")
            origin = re.search(r"origin latitude (\S+) longitude (\S+)", head).groups()
            north = (float(row["latitude"]) - float(origin[0])) * 111400  # of a degree at 60 N
            east = (float(row["longitude"]) - float(origin[1])) * 111320 * math.cos(math.radians(float(origin[0])))
            for told, expected in zip(middle, (east, north, -float(row["depth_m"]))):
                self.assertAlmostEqual(told, expected, delta=0.15 * volume ** (1 / 3) + 0.004 * abs(expected))

    def test_gltf_has_the_same_meshes_with_y_up(self):
        dest = self.fresh("export-ply-too")
        self.sonarx("export", OUT, "--to", "ply", "-o", dest)
        meshes = {}
        folder = self.fresh("export-gltf")
        self.sonarx("export", OUT, "--to", "gltf", "-o", folder)
        for file in folder.glob("*.glb"):
            said, of_file = glb(file)
            self.assertEqual(said["asset"]["version"], "2.0")
            self.assertIn("y up", said["scenes"][0]["extras"]["axes"])
            meshes |= of_file
        self.assertEqual(sorted(meshes), sorted(file.stem for file in dest.glob("*.ply")))
        for name, (places, triangles) in meshes.items():
            _, corners, same = ply(dest / f"{name}.ply")
            self.assertTrue((triangles == same).all())
            self.assertTrue(numpy.allclose(places, numpy.stack([corners[:, 0], corners[:, 2], -corners[:, 1]], 1)))


if __name__ == "__main__":
    sonarx.main()
