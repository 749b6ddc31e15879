# SPDX-License-Identifier: Apache-2.0
"""Raw files as the recount reads them: one ping at a time, no more of it than a recount needs."""
import pathlib
import struct

import numpy as np


def datagrams(path):
    data = path.read_bytes()
    at = 0
    while at + 16 <= len(data):
        length = struct.unpack_from("<i", data, at)[0]
        end = at + 8 + length
        if length < 12 or end > len(data) or struct.unpack_from("<i", data, end - 4)[0] != length:
            return
        kind = data[at + 4:at + 8].decode("latin-1")
        ticks = struct.unpack_from("<Q", data, at + 8)[0]
        yield kind, (ticks - 116444736000000000) * 100, memoryview(data)[at + 16:end - 4]
        at = end


def read_con0(body):
    beams = []
    for i in range(struct.unpack_from("<i", body, 512)[0]):
        f = lambda offset, n=1: struct.unpack_from(f"<{n}f", body, 516 + 320 * i + offset)
        beams.append({"gain": f(136)[0], "psi": f(140)[0], "along": f(144)[0], "athwart": f(148)[0],
                      "pulses": f(192, 5), "gains": f(220, 5), "sa": f(248, 5)})
    return beams


def read_raw0(body):
    names = ("power", "pulse", "interval", "c", "absorption")
    frequency, power, pulse, _, interval, c, absorption = struct.unpack_from("<7f", body, 8)
    offset, count = struct.unpack_from("<2i", body, 64)
    head = dict(zip(names, (power, pulse, interval, c, absorption)), frequency=frequency, offset=offset)
    head["counts"] = np.frombuffer(body, "<i2", count, 72).astype(int)
    return struct.unpack_from("<h", body, 0)[0] - 1, head


class Survey:
    """A folder of raw files, read one ping at a time."""

    def __init__(self, folder):
        self.paths = sorted(p for p in pathlib.Path(folder).iterdir() if p.suffix.lower() == ".raw")

    def load(self, wanted):
        """Yields (time, beams of CON0, {channel: head and counts}) of the wanted times."""
        for path in self.paths:
            beams, time, channels = None, None, {}
            for kind, stamp, body in datagrams(path):
                if kind == "CON0":
                    beams = read_con0(body)
                if kind != "RAW0":
                    continue
                if stamp != time:
                    if channels:
                        yield time, beams, channels
                    time, channels = stamp, {}
                if stamp in wanted:
                    channel, head = read_raw0(body)
                    channels[channel] = head
            if channels:
                yield time, beams, channels
