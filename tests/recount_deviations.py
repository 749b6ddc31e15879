# SPDX-License-Identifier: Apache-2.0
"""How far what the program says lies from what was recounted."""
import csv
import math

# Absolute tolerances where a relative one of 1e-7 is too narrow: positions stand with Vincenty's 0.1 mm, speeds on
# positions, and an angle of a nearly round outline is ill-defined.
TOLERANCE = {"latitude": 2e-9, "longitude": 4e-9, "axis_deg": 1e-4, "bearing_deg": 1e-6, "speed_mps": 1e-5,
             "speed_se_mps": 1e-5, "course_deg": 1e-2, "vertical_speed_mps": 1e-6, "sv_mean_db": 1e-6,
             "sv_p95_db": 1e-6, "sv_max_db": 1e-6, "snr_db": 1e-6, "sv_corrected_db": 1e-6,
             "sv_p5_db": 1e-6, "sv_p50_db": 1e-6, "sv_robust_mean_db": 1e-6, "box_bearing_deg": 1e-3, "box_tilt_deg": 1e-3,
             "backscatter_psi_error_db": 1e-6, "backscatter_calibration_se_db": 1e-6}
TURN = {"bearing_deg": 360, "course_deg": 360, "axis_deg": 180, "box_bearing_deg": 180, "longitude": 360}


class Deviations:
    def __init__(self):
        self.worst, self.failed = {}, False

    def add(self, table, name, got, wanted, where):
        got, wanted = float(got), float(wanted)
        if math.isnan(got) and math.isnan(wanted):
            off = 0.0
        elif math.isnan(got) or math.isnan(wanted):
            off = math.inf
        else:
            off = abs(got - wanted)
            if name in TURN:
                off = min(off, abs(TURN[name] - off))
        limit = TOLERANCE.get(name, 1e-7 * max(1e-3, abs(wanted)) if math.isfinite(wanted) else 1e-9)
        count, worst, _, _ = self.worst.get((table, name), (0, -1.0, limit, ""))
        if off / limit > worst if limit else off > 0:
            self.worst[(table, name)] = (count + 1, off / limit if limit else math.inf, limit,
                                         f"{where}: {got!r}, recounted {wanted!r}")
        else:
            self.worst[(table, name)] = (count + 1,) + self.worst[(table, name)][1:]
        self.failed |= not off <= limit

    def beyond(self):
        """(table, column) of all that are."""
        return {key for key, (_, worst, _, _) in self.worst.items() if worst > 1}

    def show(self):
        for (table, name), (count, worst, limit, where) in self.worst.items():
            mark = "  BEYOND " + where if worst > 1 else ""
            print(f"{table:18s}{name:24s}{count:7d} values, worst {worst * limit:10.3g}, allowed {limit:8.2g}{mark}")


def compare_table(path, rows, deviations):
    """The CSV says what the products say."""
    with open(path, newline="", encoding="utf-8") as file:
        read = list(csv.DictReader(file))
    key = lambda r: (str(r["observation"]), int(r["school_id"]), int(r.get("ping_index", 0)))
    by_key = {key(r): r for r in read}
    if len(read) != len(rows) or set(by_key) != {key(r) for r in rows}:
        print(f"{path}: other rows than the products")
        deviations.failed = True
        return
    # In a survey that was merged at once, numbers rise with the rows.
    schools = sorted({key(r)[:2] for r in rows}, key=lambda k: (len(k[0]), k))
    numbers = {school: number for number, school in enumerate(schools, 1)}
    for row in rows:
        for name, value in row.items():
            text = by_key[key(row)][name]
            if name == "continues":
                continue
            if name == "survey_school":
                value = numbers[key(row)[:2]]
            if isinstance(value, str):
                same = text == value
            elif name.endswith(("latitude", "longitude")):  # mass_latitude too
                same = (text == "") == math.isnan(value) and (text == "" or abs(float(text) - value) <= 5.1e-9)
            else:
                same = (math.isnan(float(value)) and text == "") or (text != "" and float(text) == value)
            if not same:
                print(f"{path}: {key(row)} {name}: {text!r}, product {value!r}")
                deviations.failed = True
                return
