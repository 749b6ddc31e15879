# SPDX-License-Identifier: Apache-2.0
"""A product as the recount reads it: rows, navigation, grid and masks of one observation."""
import json
import math

import netCDF4
import numpy as np


def bounds(centres, lone):
    if len(centres) == 1:
        return np.array([centres[0] - lone / 2, centres[0] + lone / 2])
    mid = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[centres[0] - (centres[1] - centres[0]) / 2], mid,
                           [centres[-1] + (centres[-1] - centres[-2]) / 2]])


class Observation:
    def __init__(self, path):
        with netCDF4.Dataset(path) as data:
            data.set_auto_mask(False)
            self.name = data.observation
            self.recipe = json.loads(data.recipe)
            self.pings = {k: v[:] for k, v in data["pings"].variables.items()}
            self.rows = self.table(data["school_pings"])
            self.schools = self.table(data["schools"])
            grid = data["grid"]
            self.has_grid = "elevation" in grid.variables
            if not self.has_grid:
                return
            self.elevation, self.azimuth = (np.radians(grid[k][:]) for k in ("elevation", "azimuth"))
            widths = [math.radians(float(grid[k][0, 0])) for k in ("vertical_width", "horizontal_width")]
            self.e, self.a = bounds(self.elevation, widths[0]), bounds(self.azimuth, widths[1])
            self.first, self.dr = float(grid["range_of_first_sample"][...]), float(grid["sample_spacing"][...])
            self.sound_speed = float(grid["sound_speed"][...])
            self.samples = int(grid["sample_count_of_grid"][...])
            self.widths_deg = grid["vertical_width"][:]
            self.place = {int(c): index for index, c in np.ndenumerate(grid["channel"][:])}
            mask = data["mask"]
            mask["confidence"].set_auto_scale(False)
            q = mask["confidence"][:]
            runs = [mask[k][:] for k in ("school_id", "ping_index", "channel", "first_sample", "sample_count")]
            fault = mask["fault"][:] if "fault" in mask.variables else None
            self.masks, self.faults, at = {}, {}, 0
            for school, ping, channel, first, count in zip(*(r.tolist() for r in runs)):
                self.masks.setdefault((school, ping), []).append((channel, first, q[at:at + count]))
                if fault is not None:
                    self.faults.setdefault((school, ping), []).append(fault[at:at + count])
                at += count

    @staticmethod
    def table(group):
        # Times stand there as numbers too: `first_time` beside the column `first_time_utc`.
        columns = {k: v[:] for k, v in group.variables.items() if not k.endswith("time")}
        return [dict(zip(columns, values)) for values in zip(*columns.values())]

    def voxels(self, school, ping):
        parts = self.masks[(school, ping)]
        channel = np.concatenate([np.full(len(q), c) for c, _, q in parts])
        sample = np.concatenate([np.arange(first, first + len(q)) for _, first, q in parts])
        weight = np.concatenate([q for _, _, q in parts]) / 255.0
        fan = np.array([self.place[int(c)][0] for c in channel])
        beam = np.array([self.place[int(c)][1] for c in channel])
        return channel, fan, beam, sample, weight

    def valid(self, school, ping):
        """Which voxels count for Sv; None where an older product does not tell."""
        parts = self.faults.get((school, ping))
        return None if parts is None else np.concatenate(parts) == 0

    def cell_volumes(self, fan, beam, sample):
        r = self.first + sample * self.dr
        shell = ((r + self.dr / 2)**3 - (r - self.dr / 2)**3) / 3
        shell[r < self.dr] = 0
        return shell * (self.a[beam + 1] - self.a[beam]) * np.abs(np.sin(self.e[fan + 1]) - np.sin(self.e[fan]))
