#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Independent recount of a result: raw files and masks in, every number out again.

    recount.py SURVEY OUT [--observation obs-0001] [--every N]

Needs numpy and netCDF4 only. Reads the raw files with a parser of its own, takes masks, navigation, recipe and
background levels from the products, works the columns of school_pings.csv and schools.csv out anew, and prints the
worst deviation of each. Exit code 1 where one is beyond its tolerance.

Which members were faulty is in the product (/mask/fault), so the columns of Sv and valid_fraction are recounted in
every row; of an older product only where all members are valid. That a fault was one is not judged, but for samples that
no file holds, which must be faults. Which samples beyond the masks were faulty or seabed is not in the product. Hence:

- edge_flags: those of the sector, the near field and the surface, from the recipe. The bits 64 (seabed) and 256 (flagged)
  are taken as they stand, and 32 (far) as well beside faulty samples, because a beam may end in lost ones; edge_fraction
  is recounted where these are the same.
- length_corrected_m, width_corrected_m, height_corrected_m: not recounted. They are moments of the echo round the mask,
  with the filtered volume at faults and nothing at the seabed. What follows from them is: volume_corrected_m3 (the
  ellipsoid of these extents), sv_corrected_db.
- surface_m2, sphericity, roughness, n_vacuoles, vacuole_fraction, n_nuclei, core_edge_db: not recounted. Their tests are
  bodies whose figures are known. Nor are diner_nb_across, diner_nb_height, bottom_distance_m, mass_latitude and
  mass_longitude in school_pings.csv. incidence_deg is of the extents that are not recounted.
- the columns of movement that came with them (speed_smoothed_mps to wake_distance_m, and in schools.csv course_se_deg to
  current_se_mps) and their errors, depth_error_m and the columns of extinction of a ping: not recounted. Their tests are ways and currents whose figures are known.
- where sound is bent along rays (survey.bend_rays): not recounted is what follows the rays (BENT).
- columns that came after the product was written: left out.
- threshold_db: not recounted. It comes from the level at which the detection split the filtered volume; masks and
  confidences follow from it, not the other way round.
- bottom_depth_m: not recounted. It is a plane through echoes of the seabed, no sample of which is a member.
- schools.csv: origin, status, operator, decided_utc, species, comment, name, continues and ended_at_reach are
  no measures; the table only has to say what the product says (continues excepted, which the merge may fill in).
- survey_school rises with the rows, as in a survey that was merged at once.
"""
import argparse
import datetime
import math
import pathlib
import sys

import numpy as np

from recount_deviations import Deviations, compare_table
from recount_earth import plane, travel
from recount_product import Observation
from recount_raw import Survey

DB_PER_COUNT = 10 * math.log10(2) / 256
EXTINCTION = ("extinction_loss_db", "extinction_share", "extinction_share_low", "extinction_share_high",
              "extinction_corrected")
BENT = {"latitude", "longitude", "depth_m", "length_m", "width_m", "height_m", "axis_deg", "depth_min_m", "depth_max_m",
        "surface_distance_m", "horizontal_range_m", "mass_depth_m"}


# --- one observation -------------------------------------------------------------------------------------------------

def geometry(o, school, ping):
    """Columns that need no samples."""
    channel, fan, beam, sample, weight = o.voxels(school, ping)
    volume = o.cell_volumes(fan, beam, sample)
    heading = math.radians(float(o.pings["heading"][ping]))
    depth = float(o.pings["transducer_depth"][ping])
    lat, lon = float(o.pings["latitude"][ping]), float(o.pings["longitude"][ping])
    r = o.first + sample * o.dr
    az = o.azimuth[beam] + heading
    level = r * np.cos(o.elevation[fan])
    east, north, down = level * np.sin(az), level * np.cos(az), -r * np.sin(o.elevation[fan])
    w = weight * volume
    total = w.sum()
    e, n, z = ((w * v).sum() / total for v in (east, north, down))
    cov = [[(w * p * q).sum() / total - a * b for q, b in ((east, e), (north, n))] for p, a in ((east, e), (north, n))]
    bearing = 0.5 * math.atan2(2 * cov[0][1], cov[1][1] - cov[0][0])
    near, far = np.maximum(r - o.dr / 2, 0), np.maximum(r + o.dr / 2, 0)
    along, across, depths = [], [], []
    for el in (o.e[fan], o.e[fan + 1]):
        for a in (o.a[beam] + heading, o.a[beam + 1] + heading):
            for rr in (near, far):
                x, y = rr * np.cos(el) * np.sin(a), rr * np.cos(el) * np.cos(a)
                along.append(x * math.sin(bearing) + y * math.cos(bearing))
                across.append(x * math.cos(bearing) - y * math.sin(bearing))
                depths.append(depth - rr * np.sin(el))
    length, width, depths = np.ptp(along), np.ptp(across), np.array(depths)
    axis = math.degrees(bearing) + (90 if width > length else 0)
    where = travel(lat, lon, math.hypot(e, n), math.atan2(e, n))
    corners = [rr * np.array([np.cos(el) * np.sin(a), np.cos(el) * np.cos(a), -np.sin(el)])
               for el in (o.e[fan], o.e[fan + 1]) for a in (o.a[beam] + heading, o.a[beam + 1] + heading)
               for rr in (near, far)]
    return form(o, fan, beam, near, far, (e, n, z), np.stack((east, north, down)), w, corners) | {
            "equivalent_radius_m": (volume.sum() / (4 / 3 * math.pi))**(1 / 3), "surface_distance_m": depths.min(),
            "n_voxels": len(fan), "n_beams": len(set(beam.tolist())), "n_fans": len(set(fan.tolist())),
            "volume_m3": volume.sum(), "latitude": where[0], "longitude": where[1], "depth_m": depth + z,
            "range_m": math.sqrt(e * e + n * n + z * z), "bearing_deg": math.degrees(math.atan2(e, n)) % 360,
            "length_m": max(length, width), "width_m": min(length, width), "axis_deg": axis % 180,
            "depth_min_m": depths.min(), "depth_max_m": depths.max(), "height_m": np.ptp(depths)}


def form(o, fan, beam, near, far, centre, places, weight, corners):
    """The oriented box, and what is seen from above and from the sonar."""
    off = places - np.array(centre)[:, None]
    _, axes = np.linalg.eigh(weight * off @ off.T)
    sides = sorted(((np.ptp([axis @ c for c in corners]), axis) for axis in axes.T), key=lambda s: -s[0])
    east, north, down = sides[0][1]
    bearing = math.degrees(math.atan2(east, north)) % 360
    tilt = math.degrees(math.atan2(-down, math.hypot(east, north)))
    cosines = np.stack((np.cos(o.e[fan]), np.cos(o.e[fan + 1])))
    least, most = near * cosines.min(0), far * np.where(o.e[fan] * o.e[fan + 1] <= 0, 1, cosines.max(0))
    area = 0.0
    for b in set(beam.tolist()):
        covered = 0.0
        for start, end in sorted(zip(least[beam == b].tolist(), most[beam == b].tolist())):
            start = max(start, covered)
            area += (o.a[b + 1] - o.a[b]) * max(end**2 - start**2, 0) / 2
            covered = max(covered, end)
    return {"box_length_m": sides[0][0], "box_width_m": sides[1][0], "box_thickness_m": sides[2][0],
            "box_bearing_deg": bearing % 180, "box_tilt_deg": -tilt if bearing >= 180 else tilt, "area_m2": area,
            "horizontal_range_m": math.hypot(centre[0], centre[1])}


FORE, AFT, TOP, BOTTOM, NEAR, FAR, SEABED, SURFACE, FLAGGED = (1 << i for i in range(9))


def usable(o, ping):
    """First and end sample of each beam between the near field and the surface, [fan][beam]."""
    flags = o.recipe["flags"]
    at = lambda r: np.clip(np.ceil((r - o.first) / o.dr - 1e-9), 0, o.samples)
    shape = o.widths_deg.shape
    first = np.full(shape, at(flags["near_field"]["range_m"]) if flags["near_field"]["enabled"] else 0.0)
    end = np.full(shape, float(o.samples))
    surface = flags["surface"]
    elevation = np.degrees(o.elevation)
    if surface["enabled"] and surface["mode"] == "fan" and surface["fans"] < len(elevation):
        end[np.argsort(-elevation, kind="stable")[:surface["fans"]]] = 0
    elif surface["enabled"] and surface["mode"] == "edge":
        clear = max(float(o.pings["transducer_depth"][ping]) - surface["margin_m"], 0)
        edge = np.radians(np.minimum(elevation[:, None] + o.widths_deg / 2, 90))
        with np.errstate(divide="ignore", invalid="ignore"):
            end = at(np.where(edge > 0, clear / np.sin(edge), np.inf))
    with np.errstate(divide="ignore"):  # above the water line under any recipe
        line = np.where(elevation > 0, float(o.pings["transducer_depth"][ping]) / np.sin(o.elevation), np.inf)
    air = np.clip(np.floor((line - o.first) / o.dr) + 1, 0, o.samples)
    end = np.minimum(end, air[:, None])
    return first.astype(int), end.astype(int)


def edges(o, school, ping):
    """Edge flags without seabed and faults, and the share of the mask's outer faces that lie at them."""
    _, fan, beam, sample, _ = o.voxels(school, ping)
    mask = np.zeros(o.widths_deg.shape + (o.samples,), bool)
    mask[fan, beam, sample] = True
    first, end = usable(o, ping)
    fans, beams = first.shape
    last_is_fore = math.cos(o.azimuth[-1]) > math.cos(o.azimuth[0])
    sides = ((0, 0, -1, NEAR), (0, 0, 1, FAR), (1, 0, 0, TOP), (-1, 0, 0, BOTTOM),
             (0, 1, 0, FORE if last_is_fore else AFT), (0, -1, 0, AFT if last_is_fore else FORE))
    found = faces = at_edge = 0
    for df, db, ds, border in sides:
        f, b, s = fan + df, beam + db, sample + ds
        out = (f < 0) | (f >= fans) | (b < 0) | (b >= beams) | (s < 0) | (s >= o.samples)
        f, b, s = np.clip(f, 0, fans - 1), np.clip(b, 0, beams - 1), np.clip(s, 0, o.samples - 1)
        outer = out | ~mask[f, b, s]
        flags = np.zeros(len(f), int)
        # a row of which nothing is usable is no row: the sector ends before it
        flags[(first[f, b] >= end[f, b]) & (ds == 0)] |= border
        flags[s < first[f, b]] |= NEAR
        flags[s >= end[f, b]] |= SURFACE
        flags[out] = border
        found |= int(np.bitwise_or.reduce(flags[outer])) if outer.any() else 0
        faces += int(outer.sum())
        at_edge += int((flags[outer] != 0).sum())
    return found, at_edge / faces


def user_line(o, channel):
    return next((l for l in o.recipe.get("beam_calibration", []) if l.get("channel") == channel), {})


def beam_angle(o, beam, channel):
    """Equivalent beam angle in use and the other reading of it, dB re 1 sr."""
    user, known = user_line(o, channel), lambda v, otherwise: otherwise if v is None else v
    along, athwart = (math.radians(known(user.get(f"width_{k}_deg"), beam[k])) for k in ("along", "athwart"))
    widths = 10 * math.log10(math.pi / (8 * math.log(2)) * along * athwart)
    source = o.recipe["calibration"]["psi"]
    if source == "from_widths":
        return widths, beam["psi"]
    return known(user.get("psi_db"), beam["psi"]) if source == "table" else beam["psi"], widths


def calibration_error(o, beam, channel):
    """Standard error of Sv by those of the calibration table, dB; NaN where it tells none."""
    user = user_line(o, channel)
    parts = [2 * user.get("gain_db_se", math.nan), 2 * user.get("sa_correction_db_se", math.nan),
             user.get("extra_factor_db_se", math.nan)]
    if o.recipe["calibration"]["psi"] == "table" and "psi_db" in user:
        parts.append(user.get("psi_db_se", math.nan))
    if o.recipe["calibration"]["psi"] == "from_widths":
        shares = [user.get(f"width_{k}_deg_se", math.nan) / user.get(f"width_{k}_deg", beam[k])
                  for k in ("along", "athwart")]
        parts.append(10 / math.log(10) * math.hypot(*shares))
    told = [p for p in parts if math.isfinite(p)]
    return math.sqrt(sum(p * p for p in told)) if told else math.nan


def calibration(o, beam, head, channel, samples):
    """Counts added to power counts to give Sv counts, as 16-bit whole numbers."""
    gain, sa, extra = beam["gain"], 0.0, 0.0
    for pulse, g, s in zip(beam["pulses"], beam["gains"], beam["sa"]):
        if pulse > 0 and abs(pulse - head["pulse"]) <= o.recipe["calibration"]["pulse_tolerance"] * pulse:
            gain, sa = g, s
            break
    for line in o.recipe.get("beam_calibration", []):
        if line.get("channel") == channel:
            gain = gain if line.get("gain_db") is None else line["gain_db"]
            sa = sa if line.get("sa_correction_db") is None else line["sa_correction_db"]
            extra = extra if line.get("extra_factor_db") is None else line["extra_factor_db"]
    given = o.recipe["survey"].get("sound_speed_mps") or o.recipe.get("sound_speed_profile")
    c = o.sound_speed if given else head["c"]
    constant = -10 * math.log10(head["power"] * (c / head["frequency"])**2 * c * head["pulse"] / (32 * math.pi**2))
    constant += -beam_angle(o, beam, channel)[0] - 2 * gain - 2 * sa + extra
    r = np.maximum(o.first + samples * o.dr, o.dr)
    db = constant + 20 * np.log10(r) + 2 * head["absorption"] * r
    counts = np.clip(db / DB_PER_COUNT, -32767, 32767)
    return np.where(counts < 0, np.ceil(counts - 0.5), np.floor(counts + 0.5))


def echo(o, row, beams, channels):
    """Sv columns, over the members without a fault."""
    school, ping = int(row["school_id"]), int(row["ping_index"])
    channel, fan, beam, sample, _ = o.voxels(school, ping)
    volume = o.cell_volumes(fan, beam, sample)
    whole, valid = volume.sum(), o.valid(school, ping)
    columns = ("sv_mean_db", "sv_p95_db", "sv_max_db", "backscatter_m2", "snr_db", "sv_corrected_db",
               "backscatter_psi_error_db", "backscatter_calibration_se_db", "sv_p5_db", "sv_p50_db", "sv_robust_mean_db",
               "sv_variation", "sv_skewness", "sv_kurtosis", "nasc_m2_nmi2", "mass_depth_m")
    out = dict.fromkeys(columns, math.nan)
    if valid is not None:
        channel, sample, volume = channel[valid], sample[valid], volume[valid]
        out["valid_fraction"] = volume.sum() / whole
        if not volume.sum() > 0:
            return out
    sv, noise = np.empty(len(sample)), np.zeros(len(sample))
    other, error = np.empty(len(sample)), np.empty(len(sample))
    levels = o.pings.get("background_db")
    nothing = {"offset": 0, "counts": []}
    for c in set(channel.tolist()):
        of = channel == c
        head = channels.get(c, nothing)
        if (sample[of] < head["offset"]).any() or (sample[of] - head["offset"] >= len(head["counts"])).any():
            return out | {"valid_fraction": math.nan}  # a member without a sample, and no fault
        table = calibration(o, beams[c], head, c, sample[of])
        used, otherwise = beam_angle(o, beams[c], c)
        other[of], error[of] = 10**((used - otherwise) / 10), calibration_error(o, beams[c], c)
        power = np.clip(head["counts"][sample[of] - head["offset"]], -32766, 32766)
        sv[of] = 2.0**(np.clip(power + table, -32766, 32766) / 256)
        if levels is not None and np.isfinite(levels[ping, c]):
            noise[of] = 10**(float(levels[ping, c]) / 10) * 2.0**(table / 256)
    rest = sv - noise
    mean = (rest * volume).sum() / volume.sum()
    db = lambda v: 10 * math.log10(v) if v > 0 else math.nan
    p95 = np.sort(rest)[math.ceil(0.95 * len(rest)) - 1]
    out |= {"sv_mean_db": db(mean), "sv_p95_db": db(p95), "sv_max_db": db(rest.max()), "backscatter_m2": mean * whole}
    if noise.any():
        out["snr_db"] = db((rest * volume).sum() / (noise * volume).sum())
    rank = lambda share: np.sort(rest)[math.ceil(share * len(rest)) - 1]
    out |= {"sv_p5_db": db(rank(0.05)), "sv_p50_db": db(rank(0.5)), "nasc_m2_nmi2":
            4 * math.pi * 1852**2 * out["backscatter_m2"] / row.get("area_m2", math.nan)}
    echo_m2 = rest * volume
    if mean > 0:
        middle = (rest >= rank(0.05)) & (rest <= rank(0.95))
        share = lambda p: (1 - math.log(1 - p)) * (1 - p)  # of an exponential's mean, above its quantile
        kept = (share(0.05) - share(0.95)) / 0.9
        out["sv_robust_mean_db"] = db(echo_m2[middle].sum() / volume[middle].sum() / kept)
        moment = lambda k: ((rest - mean)**k * volume).sum() / volume.sum()
        out["sv_variation"] = math.sqrt(moment(2)) / mean
        out["sv_skewness"], out["sv_kurtosis"] = moment(3) / moment(2)**1.5, moment(4) / moment(2)**2 - 3
        down = -(o.first + sample * o.dr) * np.sin(o.elevation[fan if valid is None else fan[valid]])
        out["mass_depth_m"] = float(o.pings["transducer_depth"][ping]) + (echo_m2 * down).sum() / echo_m2.sum()
    if echo_m2.sum() > 0:
        out["backscatter_psi_error_db"] = db(echo_m2.sum() / (echo_m2 * other).sum())
        out["backscatter_calibration_se_db"] = (echo_m2 * error).sum() / echo_m2.sum()
    if math.isfinite(row["volume_corrected_m3"]):
        out["sv_corrected_db"] = db(out["backscatter_m2"] / row["volume_corrected_m3"])
    return out


# --- one school over its pings ---------------------------------------------------------------------------------------

def line(t, x):
    """Slope of the least-squares line."""
    tc = t - t.mean()
    return (tc * (x - x.mean())).sum() / (tc**2).sum()


def slope_covariance(t, xy):
    """Covariance of the plain slopes for deviations with a correlation of exp(-dt / tau), tau by restricted likelihood.

    With full matrices, where the program goes from ping to ping."""
    design = np.stack([np.ones(len(t)), t - t.mean()], axis=1)
    best = None
    for intervals in (0, .3, .5, .7, 1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22, 32, 45, 64):
        tau = intervals * np.sort(np.diff(t))[(len(t) - 1) // 2]
        apart = np.abs(t[:, None] - t[None, :])
        correlation = np.exp(-apart / tau) if tau > 0 else np.eye(len(t))
        inverse = np.linalg.inv(correlation)
        normal = design.T @ inverse @ design
        rest = xy - design @ np.linalg.solve(normal, design.T @ inverse @ xy)
        scatter = rest.T @ inverse @ rest / (len(t) - 2)
        likelihood = -(np.linalg.slogdet(correlation)[1] + np.linalg.slogdet(normal)[1]
                       + (len(t) - 2) * math.log(np.trace(scatter)))
        tc = design[:, 1]
        if best is None or likelihood > best[0]:
            best = likelihood, scatter * (tc @ correlation @ tc) / (tc @ tc)**2
    return best[1]


MEDIANS = ("surface_m2", "area_m2", "equivalent_radius_m", "box_length_m", "box_width_m", "box_thickness_m", "sphericity",
           "roughness", "n_vacuoles", "vacuole_fraction", "n_nuclei", "sv_variation", "sv_skewness", "sv_kurtosis",
           "core_edge_db", "surface_distance_m", "bottom_distance_m", "horizontal_range_m", "incidence_deg",
           "diner_nb_across", "diner_nb_height")


def summary(o, rows):
    whole = [r for r in rows if r["touches_edge"] == 0]
    used = whole or rows
    values = lambda name: np.array([r[name] for r in used if math.isfinite(r.get(name, math.nan))])
    median = lambda name: float(np.median(values(name))) if len(values(name)) else math.nan
    mean = lambda name: float(values(name).mean()) if len(values(name)) else math.nan
    db = lambda name: 10 * math.log10((10**(values(name) / 10)).mean()) if len(values(name)) else math.nan
    both = [r for r in used if math.isfinite(r["volume_corrected_m3"]) and math.isfinite(r["backscatter_m2"])]
    echo = [r for r in both or used if math.isfinite(r["backscatter_m2"])]
    placed = [r for r in used if math.isfinite(r["latitude"])]
    out = {"n_pings": len(rows), "n_pings_whole": len(whole), "touches_edge_fraction": 1 - len(whole) / len(rows),
           "depth_m": mean("depth_m"), "sv_mean_db": db("sv_mean_db"), "backscatter_m2": math.nan,
           "volume_corrected_m3": math.nan, "sv_corrected_db": math.nan, "backscatter_psi_error_db": math.nan,
           "backscatter_calibration_se_db": math.nan, "backscatter_total_m2": mean("backscatter_total_m2"),
           "depth_error_m": mean("depth_error_m"),
           **{name: mean(name) for name in EXTINCTION}}
    errors = values("backscatter_total_se_m2")
    out["backscatter_total_se_m2"] = math.sqrt((errors**2).sum()) / len(errors) if len(errors) else math.nan
    for name in ("volume_m3", "length_m", "width_m", "height_m", *MEDIANS):
        out[name] = median(name)
    for name in ("sv_p5_db", "sv_p50_db", "sv_robust_mean_db"):
        out[name] = db(name)
    out["nasc_m2_nmi2"] = mean("nasc_m2_nmi2")
    if echo:
        sums = np.array([r["backscatter_m2"] for r in echo])
        out["backscatter_m2"] = sums.mean()
        other = sum(b / 10**(r["backscatter_psi_error_db"] / 10) for b, r in zip(sums, echo))
        errors = np.array([r["backscatter_calibration_se_db"] for r in echo])
        out["backscatter_psi_error_db"] = 10 * math.log10(sums.sum() / other) if other > 0 else math.nan
        out["backscatter_calibration_se_db"] = (sums * errors).sum() / sums.sum()
    if both:
        out["volume_corrected_m3"] = sum(r["volume_corrected_m3"] for r in both) / len(both)
        ratio = out["backscatter_m2"] / out["volume_corrected_m3"]
        out["sv_corrected_db"] = 10 * math.log10(ratio) if ratio > 0 else math.nan
    if placed:
        lat, lon = placed[0]["latitude"], placed[0]["longitude"]
        xy = np.array([plane(lat, lon, r["latitude"], r["longitude"]) for r in placed]).mean(axis=0)
        out["latitude"], out["longitude"] = travel(lat, lon, math.hypot(*xy), math.atan2(*xy))
    moving = [r for r in rows if not r["edge_flags"] & (1 | 2 | 16 | 32) and math.isfinite(r["latitude"])]
    out |= dict.fromkeys(("speed_mps", "speed_se_mps", "course_deg", "vertical_speed_mps"), math.nan)
    speed = o.recipe.get("summarise", {})
    if len(moving) < speed.get("min_speed_pings", 4):
        return out
    time = np.array([int(o.pings["time_ns"][r["ping_index"]]) for r in moving])
    t = (time - time[0]) / 1e9
    if t[-1] < speed.get("min_speed_span_s", 15):
        return out
    lat, lon = moving[0]["latitude"], moving[0]["longitude"]
    xy = np.array([plane(lat, lon, r["latitude"], r["longitude"]) for r in moving])
    slope = np.array([line(t, xy[:, 0]), line(t, xy[:, 1])])
    covariance = slope_covariance(t, xy)
    length = math.hypot(*slope)
    ahead = slope / length
    across = np.array([ahead[1], -ahead[0]])
    speed = math.sqrt(max(length**2 - across @ covariance @ across, 0))
    error = math.sqrt(ahead @ covariance @ ahead)
    out |= {"speed_mps": speed, "speed_se_mps": error,
            "vertical_speed_mps": line(t, np.array([r["depth_m"] for r in moving])),
            "course_deg": math.degrees(math.atan2(*slope)) % 360 if speed > 0 and speed >= 2 * error else math.nan}
    return out


def check_time(o, told, ping, where, deviations):
    time = int(o.pings["time_ns"][ping])
    whole = datetime.datetime.fromtimestamp(time // 10**9, datetime.timezone.utc)
    text = f"{whole:%Y-%m-%dT%H:%M:%S}.{time % 10**9 // 10**6:03d}Z"
    if (told != text) if isinstance(told, str) else (int(told) != time):
        print(f"{where}: time {told!r}, recounted {text!r}")
        deviations.failed = True


def compare(deviations, o, table, row, name, value, where):
    """What the product tells with what was recounted, but for what it did not know yet and for what follows bent rays."""
    bent = table == "school_pings" and name in BENT and o.recipe["survey"].get("bend_rays", False)
    if name in row and not bent:
        deviations.add(table, name, row[name], value, where)


def recount_observation(o, survey, every, deviations):
    skipped, wanted = 0, {}
    for i, row in enumerate(o.rows):
        where = f"{o.name} school {row['school_id']} ping {row['ping_index']}"
        add = lambda name, value: compare(deviations, o, "school_pings", row, name, value, where)
        for name, value in geometry(o, int(row["school_id"]), int(row["ping_index"])).items():
            add(name, value)
        flags, share = edges(o, int(row["school_id"]), int(row["ping_index"]))
        told = int(row["edge_flags"])
        unknown = SEABED | FLAGGED | (FAR if told & FLAGGED else 0)
        add("edge_flags", flags & ~unknown | told & unknown)
        if not told & SEABED and (not told & FLAGGED or told & FAR == flags & FAR):
            add("edge_fraction", share)
        add("touches_edge", float(int(row["edge_flags"]) & 255 != 0))
        add("provisional", 0)
        check_time(o, row["time_utc"], row["ping_index"], where, deviations)
        if math.isfinite(row["volume_corrected_m3"]):
            add("volume_corrected_m3", math.pi / 6 * row["length_corrected_m"] * row["width_corrected_m"]
                * row["height_corrected_m"])
        if abs(row["valid_fraction"] - 1) > 1e-9 and not o.faults:
            skipped += 1
        elif i % every == 0:
            wanted.setdefault(int(o.pings["time_ns"][row["ping_index"]]), []).append((row, where))
    if o.recipe["calibration"]["absorption"] != "file" or o.recipe["navigation"]["time_offset_s"] != 0:
        print(f"{o.name}: sv not recounted: absorption by formula, or shifted times")
        wanted = {}
    seen = set()
    for time, beams, channels in survey.load(wanted):
        seen.add(time)
        for row, where in wanted[time]:
            for name, value in echo(o, row, beams, channels).items():
                compare(deviations, o, "school_pings", row, name, value, where)
    if seen != set(wanted):
        print(f"{o.name}: {len(wanted) - len(seen)} pings are not in the raw files")
        deviations.failed = True
    for school in o.schools:
        rows = [r for r in o.rows if r["school_id"] == school["school_id"]]
        where = f"{o.name} school {school['school_id']}"
        check_time(o, school["first_time_utc"], rows[0]["ping_index"], where, deviations)
        check_time(o, school["last_time_utc"], rows[-1]["ping_index"], where, deviations)
        for name, value in summary(o, rows).items():
            compare(deviations, o, "schools", school, name, value, where)
    print(f"{o.name}: {len(o.rows)} school pings, {len(o.schools)} schools; sv of {skipped} pings left out (faulty samples)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("survey", help="folder of the raw files")
    parser.add_argument("out", help="work folder of the run")
    parser.add_argument("--observation", help="only this one")
    parser.add_argument("--every", type=int, default=1, help="recount the Sv of every N-th row only")
    options = parser.parse_args()
    out, survey, deviations = pathlib.Path(options.out), Survey(options.survey), Deviations()
    observations = [Observation(p) for p in sorted((out / "products").glob("obs-*.nc"))]
    for o in observations:
        if o.has_grid and options.observation in (None, o.name):
            recount_observation(o, survey, options.every, deviations)
    compare_table(out / "schools.csv", [r for o in observations for r in o.schools], deviations)
    compare_table(out / "school_pings.csv", [r for o in observations for r in o.rows], deviations)
    deviations.show()
    print("beyond tolerance" if deviations.failed else "all within tolerance")
    return 1 if deviations.failed else 0


if __name__ == "__main__":
    sys.exit(main())
