# SPDX-License-Identifier: Apache-2.0
"""Two hundred kinds of damage to files of a simulated survey, ten files with one kind each at a time: `run` says what it makes
of them, never crashes or hangs, writes no number that is none, and the sound file's observation is what it was."""
import math
import shutil
import struct
import subprocess

import sonarx
from sonarx import Case, run

INT, FLOAT = "<i", "<f"
# Where fields lie in a RAW0's body (channel is a short) and in CON0's head and first beam.
RAW0 = {"channel": (0, "<h"), "mode": (2, "<h"), "depth": (4, FLOAT), "frequency": (8, FLOAT), "power": (12, FLOAT),
        "pulse": (16, FLOAT), "interval": (24, FLOAT), "sound_speed": (28, FLOAT), "absorption": (32, FLOAT),
        "heave": (36, FLOAT), "offset": (64, INT), "count": (68, INT)}
CON0 = {"beams": (512, INT), "frequency": (516 + 132, FLOAT), "gain": (516 + 136, FLOAT), "psi": (516 + 140, FLOAT),
        "width": (516 + 144, FLOAT), "direction": (516 + 180, FLOAT)}
ODD_FLOATS = {"nan": math.nan, "inf": math.inf, "huge": 3e38, "tiny": 1e-40, "zero": 0.0, "negative": -1.0}
ODD_WHOLE = {"zero": 0, "negative": -1, "huge": 32767}
ODD_INTS = {**ODD_WHOLE, "billions": 2**31 - 1}
DAMAGED = 10  # files at a time: a run of one costs as much for what is about it


def frames(data):
    """(type, ticks, body) of each datagram."""
    at, found = 0, []
    while at < len(data):
        length, kind, ticks = struct.unpack_from("<i4sQ", data, at)
        found.append((kind, ticks, data[at + 16:at + 4 + length]))
        at += length + 8
    return found


def joined(datagrams):
    return b"".join(framed(*datagram) for datagram in datagrams)


def framed(kind, ticks, body, head=None, tail=None):
    length = len(body) + 12
    return (struct.pack("<i4sQ", length if head is None else head, kind, ticks) + body
            + struct.pack("<i", length if tail is None else tail))


class Damage:
    """Kinds of damage by name: bytes -> bytes."""

    def __init__(self, data):
        self.data = data
        self.all = frames(data)
        self.kinds = {}
        raw = self.places(b"RAW0")
        self.where = {"first_raw0": raw[0], "middle_raw0": raw[len(raw) // 2], "last_raw0": raw[-1],
                      "con0": self.places(b"CON0")[0], "nme0": self.places(b"NME0")[3]}
        self.of_framing()
        self.of_fields()
        self.of_the_file()

    def places(self, kind):
        return [i for i, datagram in enumerate(self.all) if datagram[0] == kind]

    def with_bytes(self, at, instead):
        return joined(self.all[:at]) + instead + joined(self.all[at + 1:])

    def of_framing(self):
        for name, at in self.where.items():
            kind, ticks, body = self.all[at]
            changes = {"missing": b"", "twice": framed(kind, ticks, body) * 2, "type": framed(b"ZZZ9", ticks, body),
                       "type_zero": framed(b"\0\0\0\0", ticks, body), "body_cut": framed(kind, ticks, body[:len(body) // 2]),
                       "body_empty": framed(kind, ticks, b""), "time_zero": framed(kind, 0, body),
                       "time_far": framed(kind, 2**63, body), "time_back": framed(kind, ticks - 10**9, body),
                       "length_short": framed(kind, ticks, body, head=len(body)), "length_negative": framed(kind, ticks, body, head=-1),
                       "length_huge": framed(kind, ticks, body, head=2**31 - 1), "trailer": framed(kind, ticks, body, tail=7),
                       "before_garbage": bytes(range(256)) * 3 + framed(kind, ticks, body)}
            for change, instead in changes.items():
                self.kinds[f"{name}-{change}"] = self.with_bytes(at, instead)

    def of_fields(self):
        for name, fields, everywhere in (("raw0", RAW0, False), ("raw0_all", RAW0, True), ("con0", CON0, False)):
            chosen = self.places(b"CON0" if name == "con0" else b"RAW0")
            if not everywhere:
                chosen = chosen[:1]
            for field, (at, form) in fields.items():
                odd = {FLOAT: ODD_FLOATS, INT: ODD_INTS}.get(form, ODD_WHOLE)
                if everywhere:  # the worst two of each
                    odd = dict(list(odd.items())[:2])
                for word, value in odd.items():
                    self.kinds[f"{name}-{field}-{word}"] = self.with_field(chosen, at, form, value)

    def with_field(self, places, at, form, value):
        changed = list(self.all)
        for place in places:
            kind, ticks, body = changed[place]
            body = bytearray(body)
            struct.pack_into(form, body, at, value)
            changed[place] = (kind, ticks, bytes(body))
        return joined(changed)

    def of_the_file(self):
        data, middle = self.data, len(self.data) // 2
        whole = {"empty": b"", "one_byte": data[:1], "head_only": data[:20], "half": data[:middle], "less_a_byte": data[:-1],
                 "without_its_first_byte": data[1:], "begins_in_the_middle": data[middle:], "zeros_inside": data[:middle] + bytes(10000) + data[middle + 10000:],
                 "zeros_behind": data + bytes(100000), "garbage_behind": data + bytes(range(256)) * 400, "text_mode": data.replace(b"\n", b"\r\n"),
                 "seven_bits": bytes(b & 127 for b in data), "a_byte_lost_in_a_thousand": b"".join(data[i:i + 999] for i in range(0, len(data), 1000)),
                 "backwards": joined(self.all[::-1]), "twice": data + data, "halves_swapped": data[middle:] + data[:middle],
                 "no_con0": joined([d for d in self.all if d[0] != b"CON0"]), "no_nme0": joined([d for d in self.all if d[0] != b"NME0"]),
                 "no_raw0": joined([d for d in self.all if d[0] != b"RAW0"]), "hdf5": b"\x89HDF\r\n\x1a\n" + data,
                 "every_second_datagram": joined(self.all[::2]), "big_endian_lengths": joined(self.all).replace(self.data[:4], self.data[:4][::-1])}
        self.kinds.update({f"file-{name}": bytes_ for name, bytes_ in whole.items()})


class Mutation(Case):
    @classmethod
    def setUpClass(cls):
        folder = cls.fresh("mutation")
        sound = sonarx.simulate_tiny(folder, observations=DAMAGED + 1, pings=5)
        cls.folder = folder
        *cls.damaged, cls.last = sorted(sound.glob("*.raw"))

    def rows_of_last(self, out):
        """Rows of the sound file's observation, whatever it is called."""
        begin = self.last.name.split("-D")[1][:13]
        rows = []
        for row in sonarx.read_csv(out / "school_pings.csv"):
            for name, value in row.items():
                if value and name not in ("observation", "time_utc"):
                    self.assertTrue(math.isfinite(float(value)), f"{name} = {value}")
            if row["time_utc"].replace("-", "").replace(":", "")[:13] >= begin.replace("-", "")[:13]:
                rows.append({k: v for k, v in row.items() if k != "observation"})
        return rows

    def damages(self):
        """A list for each run: (file, kind of damage, bytes) of each damaged file. Kinds take turns with the files."""
        runs = {}
        for place, file in enumerate(self.damaged):
            kinds = Damage(file.read_bytes()).kinds
            self.assertGreater(len(kinds), 200)
            for turn, kind in enumerate(list(kinds)[place::len(self.damaged)]):
                runs.setdefault(turn, []).append((file, kind, kinds[kind]))
        return list(runs.values())

    def check_run(self, damages, expected):
        """Of damaged files and the sound one alone."""
        survey, out = self.folder / "damaged", self.folder / "out"
        shutil.rmtree(survey, ignore_errors=True)
        survey.mkdir()
        (survey / self.last.name).write_bytes(self.last.read_bytes())
        for file, _, data in damages:
            (survey / file.name).write_bytes(data)
        code, text, err = run("run", survey, "--out", out, "--jobs", 1, timeout=40 + 20 * len(damages))
        self.assertIn(code, (0, 3), err)
        for line in err.splitlines():
            self.assertTrue(line.startswith(("note ", "note: ", "sonarx: ")), line)
        self.assertIn("schools", text)
        self.assertEqual(self.rows_of_last(out), expected)

    def test_every_kind_of_damage(self):
        self.sonarx("run", self.folder / "sound", "--out", self.folder / "sound-out", "--jobs", 1)
        expected = self.rows_of_last(self.folder / "sound-out")
        self.assertTrue(expected)
        for damages in self.damages():
            try:
                self.check_run(damages, expected)
            except (AssertionError, subprocess.TimeoutExpired):
                for one in damages:  # which of them it was
                    with self.subTest(one[1]):
                        self.check_run([one], expected)
                raise


if __name__ == "__main__":
    sonarx.main()
