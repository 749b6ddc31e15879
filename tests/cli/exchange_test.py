# SPDX-License-Identifier: Apache-2.0
"""What other programs are given, read back by readers that share nothing with ours."""
import base64
import html.parser
import importlib
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
try:
    import netCDF4
except ImportError:
    netCDF4 = None


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


def through_vtk(file, module, kind):
    """The file as VTK itself reads it; called last, for the test is skipped where VTK is not installed."""
    try:
        reader = getattr(importlib.import_module(f"vtkmodules.{module}"), kind)()
    except ImportError:
        raise unittest.SkipTest("python3-vtk9 is not installed") from None
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


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
        surface = through_vtk(files[0], "vtkIOPLY", "vtkPLYReader")
        _, corners, triangles = ply(files[0])
        self.assertEqual((surface.GetNumberOfPoints(), surface.GetNumberOfPolys()), (len(corners), len(triangles)))

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
        file = min(folder.glob("*.glb"))
        self.assertEqual(through_vtk(file, "vtkIOGeometry", "vtkGLTFReader").GetNumberOfPoints(),
                         sum(len(places) for places, _ in glb(file)[1].values()))


KINDS = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}


def vtk(file):
    """What VTK's XML says, and its arrays by name."""
    head, data = file.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    said = xml.etree.ElementTree.fromstring(head + b"</VTKFile>")
    assert said.get("byte_order") == "LittleEndian" and said.get("header_type") == "UInt64"
    arrays = {}
    for array in said.iter("DataArray"):
        if array.get("format") != "appended":
            continue
        at = int(array.get("offset"))
        length = struct.unpack_from("<Q", data, at)[0]
        values = numpy.frombuffer(data[at + 8:at + 8 + length], KINDS[array.get("type")])
        width = int(array.get("NumberOfComponents"))
        arrays[array.get("Name")] = values.reshape(-1, width) if width > 1 else values
    return said, arrays


@unittest.skipIf(numpy is None, "python3-numpy is not installed")
class ParaView(Case):
    def test_cells_of_masks_have_the_tables_volumes(self):
        dest = self.fresh("export-vtu")
        self.sonarx("export", OUT, "--to", "vtu", "-o", dest)
        told = {}
        for row in sonarx.read_csv(OUT / "school_pings.csv"):
            told.setdefault((row["observation"], int(row["ping_index"])), {})[int(row["school_id"])] = row
        files = sorted(dest.glob("*.vtu"))
        self.assertEqual(len(files), len(told))
        for file in files[::5]:
            name = re.fullmatch(r"(obs-\d+)-ping-(\d+)", file.stem).groups()
            schools = told[name[0], int(name[1])]
            _, arrays = vtk(file)
            self.assertTrue((arrays["types"] == 12).all())
            self.assertTrue((arrays["offsets"] == 8 * numpy.arange(1, len(arrays["types"]) + 1)).all())
            places = arrays["Points"].astype(float)
            cells = places[arrays["connectivity"].reshape(-1, 8)]
            # A box from three edges at its first corner and three at its last: the cells are nearly boxes.
            first = numpy.linalg.det(cells[:, [1, 3, 4]] - cells[:, [0]])
            last = numpy.linalg.det(cells[:, [7, 5, 2]] - cells[:, [6]])
            volume = (first + numpy.abs(last)) / 2
            self.assertTrue((first > 0).all(), "right-handed")
            for school, row in schools.items():
                ours = arrays["school_id"] == school
                self.assertEqual(ours.sum(), int(row["n_voxels"]))
                self.assertAlmostEqual(volume[ours].sum() / float(row["volume_m3"]), 1, delta=0.03)
            self.assertTrue((arrays["confidence"] > 0).all() and (arrays["confidence"] <= 1).all())
        grid = through_vtk(files[0], "vtkIOXML", "vtkXMLUnstructuredGridReader")
        self.assertEqual(grid.GetNumberOfCells(), len(vtk(files[0])[1]["types"]))

    def test_the_series_is_in_the_order_of_time(self):
        dest = self.fresh("export-vtu-series")
        self.sonarx("export", OUT, "--to", "vtu", "-o", dest)
        for file in dest.glob("*.pvd"):
            steps = list(xml.etree.ElementTree.parse(file).getroot().iter("DataSet"))
            times = [float(step.get("timestep")) for step in steps]
            self.assertEqual(times, sorted(set(times)))
            for step, time in zip(steps, times):
                said, _ = vtk(dest / step.get("file"))
                self.assertEqual(float(next(a for a in said.iter("DataArray") if a.get("Name") == "TimeValue").text), time)

    def test_sv_on_the_grid_gives_the_tables_maxima(self):
        dest = self.fresh("export-vts")
        self.addCleanup(shutil.rmtree, dest)
        self.sonarx("export", OUT, "--to", "vts", "--survey", SURVEY, "-o", dest)
        row = next(r for r in sonarx.read_csv(OUT / "school_pings.csv") if float(r["valid_fraction"]) == 1)
        file = dest / f"{row['observation']}-ping-{int(row['ping_index']):05}.vts"
        said, arrays = vtk(file)
        extent = [int(n) for n in said.find("StructuredGrid").get("WholeExtent").split()]
        self.assertEqual(len(arrays["Points"]), numpy.prod([extent[2 * k + 1] + 1 for k in range(3)]))
        ours = arrays["school_id"] == int(row["school_id"])
        self.assertEqual(ours.sum(), int(row["n_voxels"]))
        # The table takes the background off, a fraction of a decibel in the strongest voxel.
        self.assertAlmostEqual(float(numpy.nanmax(arrays["Sv"][ours])), float(row["sv_max_db"]), delta=0.5)
        depth = -(arrays["Points"][ours, 2] * arrays["confidence"][ours]).sum() / arrays["confidence"][ours].sum()
        self.assertAlmostEqual(depth / float(row["depth_m"]), 1, delta=0.1)
        grid = through_vtk(file, "vtkIOXML", "vtkXMLStructuredGridReader")
        self.assertEqual(grid.GetNumberOfPoints(), len(arrays["Points"]))


class Ices(Case):
    """Against the order of elements in icesAcoustic.xsd of RstoxData."""
    ORDER = {
        "Acoustic": "Instrument Calibration DataAcquisition DataProcessing EchoType Vocabulary Cruise",
        "Instrument": "Frequency TransducerLocation TransducerManufacturer TransducerModel TransducerSerial TransducerBeamType "
                      "TransducerDepth TransducerOrientation",
        "Calibration": "Date AcquisitionMethod ProcessingMethod AccuracyEstimate Report Comments",
        "DataAcquisition": "SoftwareName SoftwareVersion StoredDataFormat PingDutyCycle Comments",
        "DataProcessing": "SoftwareName SoftwareVersion TriwaveCorrection ChannelID Bandwidth Frequency TransceiverPower "
                          "TransmitPulseLength OnAxisGain OnAxisGainUnit SaCorrection Absorption AbsorptionDescription SoundSpeed "
                          "SoundSpeedDescription TransducerPSI Comments",
        "Cruise": "Survey Country Platform StartDate EndDate Organisation LocalID Log",
        "Log": "Distance Time Latitude Longitude Origin Latitude2 Longitude2 Origin2 Validity BottomDepth Sample",
        "Sample": "ChannelDepthUpper ChannelDepthLower PingAxisInterval PingAxisIntervalType PingAxisIntervalUnit SvThreshold "
                  "Instrument Calibration DataAcquisition DataProcessing PingAxisIntervalOrigin Data",
        "Data": "SaCategory EchoType Type Unit Value"}
    OPTIONAL = {"EchoType", "TransducerManufacturer", "TransducerModel", "TransducerSerial", "TransducerDepth", "Report",
                "Comments", "ChannelID", "Bandwidth", "SaCorrection", "Absorption", "AbsorptionDescription", "SoundSpeed",
                "SoundSpeedDescription", "Organisation", "Log", "Latitude2", "Longitude2", "Origin2", "BottomDepth", "Sample",
                "PingAxisIntervalOrigin", "SaCategory"}
    OPTIONAL_IN_ACQUISITION = {"SoftwareName", "SoftwareVersion"}

    def setUp(self):
        self.out = self.fresh("export-ices-out")
        shutil.copytree(OUT, self.out, dirs_exist_ok=True)
        self.sonarx("integrate", SURVEY, "-o", self.out, "--edsu-nmi", "0.02")
        self.dest = self.fresh("export-ices")
        self.sonarx("export", self.out, "--to", "ices", "-o", self.dest)

    def test_a_logs_channels_add_up_to_the_effort_table(self):
        effort = [r for r in sonarx.read_csv(self.out / "effort.csv") if r["edsu"] != "0"]
        for name, column in (("acoustic.xml", "nasc_m2_nmi2"), ("acoustic-schools.xml", "nasc_school_m2_nmi2")):
            logs = xml.etree.ElementTree.parse(self.dest / name).getroot().findall("Cruise/Log")
            self.assertEqual(len(logs), len(effort))
            for log, row in zip(logs, effort):
                values = [float(sample.find("Data/Value").text) for sample in log.findall("Sample")]
                self.assertTrue(math.isclose(sum(values), float(row[column]), rel_tol=1e-4, abs_tol=1e-9), (values, row))
                self.assertAlmostEqual(float(log.find("Latitude").text), float(row["latitude"]), places=7)
                self.assertTrue(row["first_time_utc"][:19] <= log.find("Time").text <= row["last_time_utc"][:19])
                tops = [float(sample.find("ChannelDepthUpper").text) for sample in log.findall("Sample")]
                self.assertEqual(tops, sorted(set(tops)), "each channel once")

    def test_elements_stand_as_the_schema_has_them(self):
        for file in self.dest.glob("*.xml"):
            root = xml.etree.ElementTree.parse(file).getroot()
            for parent, order in self.ORDER.items():
                order = order.split()
                needed = set(order) - self.OPTIONAL - (self.OPTIONAL_IN_ACQUISITION if parent == "DataAcquisition" else set())
                for element in [root] if parent == "Acoustic" else root.iter(parent):
                    if element.get("IDREF"):
                        continue
                    places = [order.index(child.tag) for child in element]
                    self.assertEqual(places, sorted(places), parent)
                    self.assertLessEqual(needed, {child.tag for child in element}, parent)
            ids = [e.get("ID") for e in root.iter() if e.get("ID")]
            self.assertEqual(len(ids), len(set(ids)))
            self.assertLessEqual({e.get("IDREF") for e in root.iter() if e.get("IDREF")}, set(ids))

    @unittest.skipIf(shutil.which("xmllint") is None, "xmllint is not installed")
    def test_xmllint_reads_it(self):
        for file in self.dest.glob("*.xml"):
            done = subprocess.run(["xmllint", "--noout", file], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_what_was_not_integrated_is_refused(self):
        self.one_line_error("export", OUT, "--to", "ices", "-o", self.fresh("export-ices-none"), code=1, names="sonarx integrate")


def evr_regions(file):
    """(numbers of the first line, class, corners [(text of time, depth)], type, name) of each, read by the format's rules."""
    text = file.read_bytes().decode("utf-8-sig")
    assert "\n" not in text.replace("\r\n", "")
    lines = text.split("\r\n")
    assert re.fullmatch(r"EVRG 7 \S+", lines[0]), lines[0]
    at = 2
    for _ in range(int(lines[1])):
        assert lines[at] == ""
        head = lines[at + 1].split()
        at += 2
        for _ in range(2):  # notes, then detection settings
            at += 1 + int(lines[at])
        *points, kind = lines[at + 1].split()
        corners = [(points[k] + points[k + 1], float(points[k + 2])) for k in range(0, len(points), 3)]
        assert head[0] == "13" and int(head[1]) == len(corners)
        yield head, lines[at], corners, kind, lines[at + 2]
        at += 3


class Echoview(Case):
    def test_regions_hold_the_schools_of_their_fans(self):
        dest = self.fresh("export-echoview")
        self.sonarx("export", OUT, "--to", "echoview", "-o", dest)
        rows = {}
        for row in sonarx.read_csv(OUT / "school_pings.csv"):
            rows.setdefault(f"{row['observation']}/{row['school_id']}", []).append(row)
        seen = set()
        for file in dest.glob("*.evr"):
            for head, kind, corners, type_, name in evr_regions(file):
                seen.add(name)
                self.assertEqual((kind, type_, head[5], head[6]), ("school", "1", "-1", "1"))
                times = [time for time, _ in corners]
                half = len(corners) // 2
                self.assertEqual(times[:half], sorted(set(times[:half])), "there")
                self.assertEqual(times[half:], times[:half][::-1], "and back")
                self.assertTrue(all(len(time) == 18 for time in times))
                depths = [depth for _, depth in corners]
                self.assertAlmostEqual(min(depths), float(head[9]), places=3)
                self.assertAlmostEqual(max(depths), float(head[12]), places=3)
                self.assertTrue(all(near < far for near, far in zip(depths[:half], depths[half:][::-1])))
                stamps = {re.sub(r"\D", "", row["time_utc"])[:17] for row in rows[name]}
                self.assertLessEqual({time[:17] for time in times[1:half - 1]}, stamps, "corners at the pings of the school")
        self.assertEqual(seen, set(rows))
        for file in dest.glob("*.evl"):
            lines = file.read_bytes().decode("utf-8-sig").split("\r\n")
            self.assertRegex(lines[0], r"^EVBD 3 \S+$")
            self.assertEqual(len(lines), 3 + int(lines[1]))
            depths = {row["time_utc"]: float(row["bottom_depth_m"]) for of in rows.values() for row in of if row["bottom_depth_m"]}
            for line in lines[2:-1]:
                date, time, depth, status = line.split()
                self.assertEqual(status, "1")
                iso = f"{date[:4]}-{date[4:6]}-{date[6:]}T{time[:2]}:{time[2:4]}:{time[4:6]}.{time[6:9]}Z"
                self.assertAlmostEqual(float(depth), depths[iso], delta=0.05 * depths[iso])


def work_voxels(file, first):
    """(school, FILETIME, channel and sample from 0) of each voxel of a work file whose numbers count from `first`."""
    root = xml.etree.ElementTree.parse(file).getroot()
    assert root.tag == "schools"
    for school in root.findall("schoolData"):
        for ping in school.findall("schoolMask/pingMask"):
            beams = ping.findall("beam")
            assert len(beams) == int(ping.get("beamCount")) > 0
            for beam in beams:
                numbers = [int(n) for n in beam.get("range").split()]
                assert len(numbers) % 2 == 0
                for k in range(0, len(numbers), 2):
                    begin = sum(numbers[:k + 1])
                    assert first <= begin < begin + numbers[k + 1] <= int(beam.get("beamLength")) + first
                    for sample in range(begin, begin + numbers[k + 1]):
                        yield int(school.get("ObjectNumber")), int(ping.get("pingNtDate")), int(beam.get("channel")) - first, sample - first


def product_voxels(file):
    """The same of a product."""
    with netCDF4.Dataset(file) as product:
        mask = product["mask"]
        times = [int(t) // 100 + 116444736 * 10**9 for t in product["pings/time_ns"][:]]
        for school, ping, channel, begin, count in zip(*(mask[name][:].tolist() for name in (
                "school_id", "ping_index", "channel", "first_sample", "sample_count"))):
            for sample in range(begin, begin + count):
                yield school, times[ping], channel, sample


class Lsss(Case):
    def test_work_files_hold_the_voxels_of_the_tables_and_products(self):
        rejected = {(r["observation"], int(r["school_id"])) for r in sonarx.read_csv(OUT / "schools.csv") if r["status"] == "rejected"}
        wanted = {}
        for row in sonarx.read_csv(OUT / "school_pings.csv"):
            key = row["observation"], int(row["school_id"])
            if key not in rejected:
                wanted[key] = wanted.get(key, 0) + int(row["n_voxels"])
        for first, more in ((1, ()), (0, ("--count-from", "0"))):
            dest = self.fresh(f"export-lsss-{first}")
            self.sonarx("export", OUT, "--to", "lsss", "-o", dest, *more)
            counted = {}
            for file in sorted(dest.glob("*.work")):
                voxels = list(work_voxels(file, first))
                self.assertEqual(len(voxels), len(set(voxels)), "each once")
                for school, *_ in voxels:
                    counted[file.stem, school] = counted.get((file.stem, school), 0) + 1
                if netCDF4 is not None:
                    self.assertEqual(set(voxels), {v for v in product_voxels(OUT / "products" / f"{file.stem}.nc")
                                                   if (file.stem, v[0]) not in rejected})
            self.assertEqual(counted, wanted)

    @unittest.skipIf(shutil.which("xmllint") is None, "xmllint is not installed")
    def test_xmllint_reads_it(self):
        dest = self.fresh("export-lsss-lint")
        self.sonarx("export", OUT, "--to", "lsss", "-o", dest)
        for file in dest.glob("*.work"):
            done = subprocess.run(["xmllint", "--noout", file], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_numbering_belongs_to_it(self):
        self.one_line_error("export", OUT, "--to", "csv", "--count-from", "0", "-o", self.fresh("export-lsss-none"), code=2,
                            names="--count-from: belongs to --to lsss")

    def test_masks_come_back_voxel_by_voxel(self):
        folder = self.fresh("import-lsss")
        self.sonarx("export", OUT, "--to", "lsss", "--count-from", "0", "-o", folder)
        work, journal = folder / "obs-0001.work", folder / "masks.jsonl"
        voxels = list(work_voxels(work, 0))
        said = self.sonarx("import", SURVEY, work, "-o", journal, "--count-from", "0")
        schools = len({school for school, *_ in voxels})
        self.assertRegex(said, rf": {schools} schools?, {len(voxels)} voxels, 0 marks, 0 bad intervals\n$")
        lines = [json.loads(line) for line in journal.read_text().splitlines()[1:]]
        brushed = sorted((line["ping_time"] // 100 + 116444736 * 10**9, channel, sample)
                         for line in lines for channel, first, count in line["args"].get("runs", ())
                         for sample in range(first, first + count))
        self.assertEqual(brushed, sorted(voxel[1:] for voxel in voxels))
        # The file tells by itself; a human who says otherwise moves them.
        self.sonarx("import", SURVEY, work, "-o", folder / "told.jsonl")
        told = [json.loads(line) for line in (folder / "told.jsonl").read_text().splitlines()[1:]]
        self.assertEqual([line["args"] for line in told], [line["args"] for line in lines])
        for option, value, ending in (("--fan", "3", ".evr"), ("--beams", "1:2", ".evr")):
            self.one_line_error("import", SURVEY, work, "-o", folder / "b.jsonl", option, value, code=2,
                                names=f"{option}: belongs to files that end in {ending}; none is given")


class EchoviewBack(Case):
    """A journal of what was exported, and pictures of lines."""
    def test_regions_come_back_as_the_schools_that_they_were(self):
        folder = self.fresh("import-echoview")
        self.sonarx("export", OUT, "--to", "echoview", "-o", folder)
        journal = folder / "regions.jsonl"
        files = sorted(folder.glob("obs-0001-fan-*.evr"))
        schools = [r for r in sonarx.read_csv(OUT / "schools.csv") if (r["observation"], r["status"]) == ("obs-0001", "unreviewed")]
        rows = [r for r in sonarx.read_csv(OUT / "school_pings.csv")
                if (r["observation"], r["school_id"]) in {(s["observation"], s["school_id"]) for s in schools}]
        before = sonarx.contents(SURVEY)
        said = self.sonarx("import", SURVEY, *files, "-o", journal, "--operator", "somebody")
        self.assertEqual(sonarx.contents(SURVEY), before)
        voxels = sum(int(r["n_voxels"]) for r in rows)
        self.assertRegex(said, rf": {len(schools)} schools?, {voxels} voxels, 0 marks, 0 bad intervals\n$")
        # What the notes tell, read by rules of this test: every cell stands in the journal.
        cells = {}
        for file in files:
            for line in file.read_bytes().decode("utf-8-sig").split("\r\n"):
                if line.startswith("cells "):
                    time, *numbers = line.split()[2:]
                    cells[time[:9]] = cells.get(time[:9], 0) + sum(int(n) for n in numbers[2::3])
        lines = [json.loads(line) for line in journal.read_text().splitlines()[1:]]
        brushed = sum(count for line in lines if line["cmd"] == "brush" for _, _, count in line["args"]["runs"])
        self.assertEqual((sum(cells.values()), brushed), (voxels, voxels))
        self.assertEqual({line["operator"] for line in lines}, {"somebody"})
        # Schools of the files are all that there are: the journal's recipe looks for no others.
        self.sonarx("run", SURVEY, "-o", folder / "out", "--session", journal, "--only", "obs-0001")
        again = sonarx.read_csv(folder / "out" / "school_pings.csv")
        same = ("ping_index", "n_voxels", "n_beams", "n_fans", "range_m")
        self.assertEqual(sorted([r[c] for c in same[:4]] for r in again), sorted([r[c] for c in same[:4]] for r in rows))
        self.one_line_error("import", SURVEY, *files, "-o", journal, code=2, names="is there already")

    def test_marks_and_bad_pings_and_what_is_left_out(self):
        folder = self.fresh("import-marks")
        first = min(r["time_utc"] for r in sonarx.read_csv(OUT / "school_pings.csv") if r["observation"] == "obs-0001")
        time = f"{first[:4]}{first[5:7]}{first[8:10]} {first[11:13]}{first[14:16]}{first[17:19]}{first[20:23]}0"
        late = "20991231 2359590000"

        def regions(*corners_and_types):
            text = f"\ufeffEVRG 7 13.0\r\n{len(corners_and_types)}\r\n"
            for name, corners, kind in corners_and_types:
                text += f"\r\n13 {len(corners)} 1 0 6 -1 0\r\n0\r\n0\r\nherring\r\n{' '.join(corners)} {kind}\r\n{name}\r\n"
            return text.encode()
        evr = folder / "drawn.evr"
        evr.write_bytes(regions(("haul 12", [f"{time} 10"], 2), ("whole", [f"{time} -9999.99", f"{time} 9999.99"], 0),
                                ("part", [f"{time} 30", f"{time} 40"], 0), ("late", [f"{late} 30"], 2)))
        code, said, told = sonarx.run("import", SURVEY, evr, "-o", folder / "a.jsonl")
        self.assertEqual(code, 0, told)
        self.assertIn("0 schools, 0 voxels, 1 mark, 1 bad interval", said)
        self.assertEqual([re.sub(r"^note import-left-out: .*region (\w+): .*", r"\1", line) for line in told.splitlines()],
                         ["part", "late"])
        head, *lines = [json.loads(line) for line in (folder / "a.jsonl").read_text().splitlines()]
        self.assertEqual([line["cmd"] for line in lines], ["event", "bad_ping"])
        self.assertTrue(head["recipe"]["automatic"], "without schools in the file they are looked for")
        evr.write_bytes(regions(("school", [f"{time} 30", f"{time} 40"], 1)))
        self.one_line_error("import", SURVEY, evr, "-o", folder / "b.jsonl", code=2, names="its notes name no fan")
        self.one_line_error("import", SURVEY, evr, "-o", SURVEY / "b.jsonl", "--fan", "3", code=2, names="raw files")
        self.one_line_error("import", SURVEY, evr, "-o", folder / "b.jsonl", "--count-from", "0", code=2,
                            names="--count-from: belongs to files that end in .work; none is given")
        evr.write_bytes(regions(("late", [f"{late} 30"], 2)).replace(b"\r\n1\r\n", b"\r\n7\r\n", 1))
        self.one_line_error("import", SURVEY, evr, "-o", folder / "b.jsonl", code=1, names=f"{evr}: line 10: the file ends; expected a region")
        evr.write_bytes(regions(("late", [f"{late} 30"], 2)))
        code, said, told = sonarx.run("import", SURVEY, evr, "-o", folder / "b.jsonl", "-q")
        self.assertEqual((code, said, len(told.splitlines())), (1, "", 1), told)
        self.assertFalse((folder / "b.jsonl").exists())

    def test_a_line_is_drawn_over_depth(self):
        folder = self.fresh("line-of-echoview")
        line = folder / "bottom.evl"
        line.write_text("EVBD 3 13.0\n2\n20200101 0000000000 50 3\n20210101 0000000000 150 3\n")
        self.sonarx("render", "echogram", OUT, "--depth", "--line", line, "-o", folder / "line.svg")
        self.sonarx("render", "echogram", OUT, "--depth", "-o", folder / "none.svg")
        self.assertGreater((folder / "line.svg").stat().st_size, (folder / "none.svg").stat().st_size)
        self.one_line_error("render", "echogram", OUT, "--line", line, "-o", folder / "x.png", code=2, names="--depth")
        line.write_text("EVBD 3 13.0\n2\n20200101 0000000000 deep 3\n")
        self.one_line_error("render", "echogram", OUT, "--depth", "--line", line, "-o", folder / "x.png", code=1,
                            names=f"{line}: line 3: expected")


class Page(html.parser.HTMLParser):
    VOID = {"meta", "img", "wbr"}

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.pictures, self.cells, self.links, self.texts = [], [], [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.tags.append(tag)
        self.links += [attrs[name] for name in ("src", "href") if name in attrs]
        if tag == "img":
            self.pictures.append(attrs)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if self.open.pop() != tag:
            raise AssertionError(f"{tag} ends what it did not begin")

    def handle_data(self, data):
        self.texts.append(data)
        if self.open and self.open[-1] == "td":
            self.cells.append(data)


class HtmlReport(Case):
    def page(self, *paths):
        file = self.fresh("report-html") / "report.html"
        self.sonarx("render", "report", *paths, "-o", file)
        text = file.read_text(encoding="utf-8")
        self.assertTrue(text.startswith("<!DOCTYPE html>\n<html lang="))
        page = Page(text)
        self.assertEqual(page.open, [], "everything that begins ends")
        return text, page

    def test_one_file_says_what_the_tables_say(self):
        text, page = self.page(OUT)
        self.assertEqual(set(page.tags) & {"script", "link", "iframe", "object", "style"}, {"style"})
        self.assertTrue(all(link.startswith("data:image/png;base64,") for link in page.links))
        self.assertNotRegex(text, r"(?i)\bon\w+\s*=|url\(|@import")
        for picture in page.pictures:
            png = base64.b64decode(picture["src"].split(",", 1)[1], validate=True)
            width, height = struct.unpack(">II", png[16:24])
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            self.assertEqual(zlib.crc32(png[12:29]), struct.unpack(">I", png[29:33])[0])
            self.assertEqual((width, height), (2 * int(picture["width"]), 2 * int(picture["height"])))
            self.assertTrue(picture["alt"])
        self.assertGreater(len(page.pictures), 6)
        for row in sonarx.read_csv(OUT / "schools.csv"):
            for column in ("sv_mean_db", "volume_m3", "backscatter_total_se_m2", "speed_se_mps"):
                if row[column]:
                    self.assertIn(f"{float(row[column]):.5g}", page.cells, column)
        said = " ".join(page.texts)
        for words in ("SYNTHETIC", "recipe_version", "Not integrated", "What was noted", "standard error"):
            self.assertTrue(words in said, words)

    def test_integration_is_shown_and_names_are_text(self):
        out = self.fresh("report-html-out")
        shutil.copytree(OUT, out, dirs_exist_ok=True)
        evil = "<script>alert(1)</script>&\"'"
        for name, columns, row in (("effort.csv", "transect,nasc_m2_nmi2", f'"{evil.replace(chr(34), chr(34) * 2)}",12.345678'),
                                   ("strata.csv", "level,empty", "survey,")):
            (out / name).write_text(f"{columns}\n{row}\n", encoding="utf-8")
        text, page = self.page(out)
        self.assertNotIn("<script", text)
        self.assertIn(evil, "".join(page.texts))
        self.assertIn("12.346", page.cells)
        self.assertNotIn("Not integrated", "".join(page.texts))

    def test_it_is_no_picture(self):
        for kind, option in (("slice-top", ()), ("report", ("--reference", OUT / "survey.json"))):
            code, _, error = sonarx.run("render", kind, OUT, "-o", sonarx.WORK / "x.html", *option)
            self.assertEqual(code, 2, error)
            self.assertEqual(len(error.strip().splitlines()), 1, error)


if __name__ == "__main__":
    sonarx.main()
