# SPDX-License-Identifier: Apache-2.0
"""Parts `ground` and `waters` of tools/show: schools close to loud seabeds, and seabeds and other waters without fish."""

import csv
import json
import math
import re
import statistics
from collections import defaultdict

import fresh_seeds

# Least and greatest height above the seabed, m, and the water.
GROUND = [((15, 30), {"seabed_db": -5, "seabed_depth_m": 120}), ((20, 40), {"seabed_db": -5, "seabed_depth_m": 150}),
          ((15, 30), {"seabed_db": -15, "seabed_depth_m": 120}), ((25, 40), {"seabed_db": -20, "seabed_depth_m": 120}),
          ((12, 40), {"seabed_db": -12, "seabed_depth_m": 140, "seabed_slope_east": 0.08}),
          ((8, 25), {"seabed_db": -25, "seabed_depth_m": 140}), ((8, 30), {"seabed_db": -30, "seabed_depth_m": 200})]


def rows(path):
    with open(path, newline="") as table:
        return list(csv.DictReader(table))


def metres_apart(a, b):
    north = (float(a["latitude"]) - float(b["latitude"])) * 111_200
    east = (float(a["longitude"]) - float(b["longitude"])) * 111_200 * math.cos(math.radians(float(a["latitude"])))
    return math.hypot(north, east, float(a["depth_m"]) - float(b["depth_m"]))


def nearest(row, bodies):
    return min(bodies, key=lambda body: metres_apart(row, body))


def totals_against_bodies(survey, out):
    """Of each school the median over its pings of the found total against the body's own, dB. The truth's masks of schools
    that reach down to the seabed count as cut, so that score leaves them out; the bodies know no mask."""
    found = defaultdict(list)
    for row in rows(out / "school_pings.csv"):
        if row["backscatter_total_m2"]:
            found[row["observation"], row["ping_index"]].append(row)
    errors, all_bodies = defaultdict(list), defaultdict(list)
    for body in rows(survey / "truth" / "bodies.csv"):
        all_bodies[body["observation"], body["ping_index"]].append(body)
    for body in (body for of_ping in all_bodies.values() for body in of_ping):
        bodies = all_bodies[body["observation"], body["ping_index"]]
        if float(body["fraction_inside"]) < 0.97:
            continue
        reach = float(body["length_m"]) / 2 + 15
        near = [r for r in found[body["observation"], body["ping_index"]]
                if metres_apart(r, body) < reach and nearest(r, bodies) is body]
        total = sum(float(r["backscatter_total_m2"]) for r in near)
        errors[body["observation"], body["school_id"]].append(
            10 * math.log10(total / float(body["backscatter_m2"])) if total > 0 else -math.inf)
    return [statistics.median(of_pings) for of_pings in errors.values() if len(of_pings) >= 5]


def ground(show):
    print("3. schools above a loud seabed, by the same rule")
    counted, false, totals_db, low_db = [], 0, [], []
    for number, ((low, high), water) in enumerate(GROUND):
        parameters = show.work / "ground.json"
        parameters.write_text(json.dumps({
            "observations": 1, "pings": 60, "range_min_m": 100, "range_max_m": 250, "length_min_m": 40, "sv_min_db": -42,
            "above_seabed_min_m": low, "above_seabed_max_m": high, "water": water}))
        survey, out = show.simulate_and_run(f"ground{number}", "--params", parameters, "--seed", 46 + number)
        told = json.loads(show.call("score", out, "--truth", survey / "truth", "--json").stdout)
        counted += [s for s in told["schools"] if s["counted"]]
        false += len(told["false_schools"])
        errors_db = totals_against_bodies(survey, out)
        totals_db += errors_db
        if low < 10:
            low_db += errors_db
        show.drop(survey)
    found = [s for s in counted if s["found_id"]]
    show.line(f"found {len(found)} of {len(counted)} that count", len(found) >= 0.95 * len(counted))
    dice = [s["dice"] or 0 for s in counted] or [0.0]
    show.line(f"mean Dice {statistics.mean(dice):.3f} (least {min(dice):.3f})", statistics.mean(dice) >= 0.80)
    show.spread(found, "backscatter_error_db", "backscatter, dB", 1, abs)
    for name, errors_db in (("all", totals_db), ("from 8 m", low_db)):
        low, high = fresh_seeds.median_interval(errors_db) or (math.nan, math.nan)
        median = statistics.median(errors_db or [math.nan])
        show.line(f"total backscatter against the bodies, {name}, dB: median {median:+.2f} ({low:+.2f} .. {high:+.2f}), least "
                  f"{min(errors_db, default=math.nan):+.2f}, most {max(errors_db, default=math.nan):+.2f}, {len(errors_db)} schools",
                  abs(median) <= 1)
    show.line(f"{false} false schools", false == 0)


def cases_without_fish():
    """Name: (preset, water or None, further arguments)."""
    seabeds = {f"seabed of {strength} dB at {depth} m": {"seabed_db": strength, "seabed_depth_m": depth}
               for depth in (90, 180, 260) for strength in (-10, -25, -35)}
    reverberation = {f"reverberation of {level} dB": {"reverberation_sv_db": level, "seabed_db": -400}
                     for level in (-65, -60, -55)}
    hills = {f"hills of {relief} m every {length} m at {depth} m":
             {"seabed_db": -20, "seabed_depth_m": depth, "seabed_relief_m": relief, "seabed_relief_length_m": length}
             for depth, relief, length in ((90, 8, 150), (120, 15, 300), (160, 4, 100), (160, 12, 200), (220, 20, 150),
                                           (260, 25, 400))}
    cases = {name: ("standard", water, ("--seed", 1)) for name, water in (seabeds | reverberation | hills).items()}
    for preset, noise in (("standard", 1), ("hard", 2)):
        for pattern in ("uniform_line", "wide_transmit", "wide_fan"):
            cases[f"{pattern} beams over the seabed of preset {preset}, noise times {noise}"] = (
                preset, None, ("--beam-pattern", pattern, "--noise", noise, "--seed", 91))
    return cases


# A hill that stands alone between two pings' footprints is what a school on the ground is, by all that is measured of either.
KNOWN_FALSE = {"hills of 20 m every 150 m at 220 m": 1}


def waters(show):
    print("3. other waters without fish")
    cases, false, known = cases_without_fish(), 0, 0
    for name, (preset, water, arguments) in cases.items():
        if water is not None:
            parameters = show.work / "water.json"
            parameters.write_text(json.dumps({"water": water}))
            arguments = ("--params", parameters, *arguments)
        survey, out = show.simulate_and_run("water-" + re.sub("[ ,]+", "-", name), "--preset", preset,
                                            "--schools", 0, "--observations", 1, "--pings", 16, *arguments)
        n = show.schools_in(out)
        if n:
            print(f"  {name}: {n} false schools, {KNOWN_FALSE.get(name, 0)} known")
        known += min(n, KNOWN_FALSE.get(name, 0))
        false += n
        show.drop(survey)
    show.line(f"{false} false schools in {len(cases)} waters, {known} of them known", false == known)
