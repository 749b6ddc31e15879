# SPDX-License-Identifier: Apache-2.0
"""A second, independent reader of Simrad .raw files, as plain as can be: for the recount only. Trusts its input."""
import struct

import numpy


def datagrams(data):
    offset = 0
    while offset + 16 <= len(data):
        (length,) = struct.unpack_from("<i", data, offset)
        kind = data[offset + 4:offset + 8]
        (ticks,) = struct.unpack_from("<Q", data, offset + 8)
        yield kind, ticks * 100 - 11644473600 * 10**9, data[offset + 16:offset + 4 + length]
        offset += length + 8


def beams(body):
    """Gain, sa correction tables and psi of each CON0 block."""
    (count,) = struct.unpack_from("<i", body, 512)
    found = []
    for i in range(count):
        at = 516 + 320 * i
        floats = struct.unpack_from("<3f", body, at + 132)
        tables = [struct.unpack_from("<5f", body, at + place) for place in (192, 220, 248)]
        found.append({"frequency": floats[0], "gain": floats[1], "psi": floats[2], "pulse_table": tables[0],
                      "gain_table": tables[1], "sa_table": tables[2]})
    return found


def pings(data, wanted):
    """{time: {channel: RAW0 as a dictionary}} of the wanted times, and the CON0 blocks."""
    config, found = [], {}
    for kind, time, body in datagrams(data):
        if kind == b"CON0":
            config = beams(body)
        elif kind == b"RAW0" and time in wanted:
            channel, mode, depth, frequency, power, pulse, _, interval, speed, absorption = struct.unpack_from(
                "<hh8f", body, 0)
            offset, count = struct.unpack_from("<ii", body, 64)
            counts = numpy.frombuffer(body, "<i2", count, 72)
            found.setdefault(time, {})[channel - 1] = {
                "mode": mode, "depth": depth, "frequency": frequency, "power": power, "pulse": pulse,
                "interval": interval, "speed": speed, "absorption": absorption, "offset": offset, "counts": counts}
    return config, found


def sv_db(raw, beam):
    """Sv of every stored sample: the sonar equation, gain and sa correction of the pulse length."""
    c, tau = raw["speed"], raw["pulse"]
    nearest = min(range(5), key=lambda k: abs(beam["pulse_table"][k] - tau))
    matched = abs(beam["pulse_table"][nearest] - tau) < 1e-5
    gain = beam["gain_table"][nearest] if matched else beam["gain"]
    sa = beam["sa_table"][nearest] if matched else 0.0
    spacing = c * raw["interval"] / 2
    r = (numpy.arange(len(raw["counts"])) + raw["offset"]) * spacing - c * tau / 4
    r = numpy.maximum(r, spacing)
    wavelength = c / raw["frequency"]
    constant = 10 * numpy.log10(raw["power"] * wavelength**2 * c * tau / (32 * numpy.pi**2))
    received = raw["counts"] * (10 * numpy.log10(2) / 256)
    return received + 20 * numpy.log10(r) + 2 * raw["absorption"] * r - constant - 2 * gain - beam["psi"] - 2 * sa
