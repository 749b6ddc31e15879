# SPDX-License-Identifier: Apache-2.0
"""Part `fresh` of tools/show: both simulators on seeds that nobody has seen, pooled, against the limits.

A figure holds or misses by itself; where its limit lies within its 95 % interval the line says `open`: more seeds would
tell. The interval is Wilson's for shares, the exact Poisson one for counts, that of order statistics for medians and 1.96
standard errors for means. All take schools to be independent; those of one survey share its water and so are a little
less certain than that. Medians of fewer than six schools have no interval and are not judged.
"""

import dataclasses
import json
import math
import random
import shutil
import statistics

Z95 = 1.959964
FEWEST = 6  # 1 - 2 / 2^6 is the first above 95 %


@dataclasses.dataclass
class Limits:
    found: float  # share of the schools that count
    dice: float  # mean
    false_per_200: float  # schools in 200 pings
    backscatter_db: float  # size of the signed median, in each third
    size: float  # size of the signed median, share
    purity: float  # mean


LIMITS = {"standard": Limits(0.98, 0.90, 0.2, 0.2, 0.05, 1.0), "array": Limits(0.95, 0.82, 0.5, 0.3, 0.08, 0.98)}


@dataclasses.dataclass
class Line:
    """One line of the table; `good` None = not judged, or nothing to judge it by."""
    title: str
    wanted: str
    figure: float | None
    interval: tuple | None
    n: int
    good: bool | None
    open: bool  # the limit lies within the interval
    text: str  # how a number is written

    def number(self, value):
        return "-" if value is None else self.text.format(value)

    def __str__(self):
        state = "few " if self.good is None and self.wanted else {True: "ok  ", False: "MISS", None: "    "}[self.good]
        interval = f"{self.number(self.interval[0])} .. {self.number(self.interval[1])}" if self.interval else "-"
        unsettled = "  open" if self.open and self.good is not None else ""
        return (f"{state} {self.title:<42}{self.wanted:>9}{self.number(self.figure):>9}  {interval:<18}{self.n:>5}"
                f"{unsettled}")


def wilson(hits, of):
    """(low, high) of a share; None of nothing."""
    if of == 0:
        return None
    share, z2 = hits / of, Z95 * Z95
    middle = share + z2 / (2 * of)
    half = Z95 * math.sqrt(share * (1 - share) / of + z2 / (4 * of * of))
    low, high = ((middle - half) / (1 + z2 / of), (middle + half) / (1 + z2 / of))
    return (0.0 if hits == 0 else low, 1.0 if hits == of else high)


def poisson(count):
    """(low, high) of the mean of what was counted, exact, 2.5 % on either side."""
    def at_most(k, mean):
        term = total = math.exp(-mean)
        for i in range(1, k + 1):
            term *= mean / i
            total += term
        return total

    def mean_where(k, share):
        low, high = 0.0, 10.0 + 3.0 * (k + 1)
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if at_most(k, middle) > share else (low, middle)
        return low

    return (0.0 if count == 0 else mean_where(count - 1, 0.975), mean_where(count, 0.025))


def median_interval(values):
    """The narrowest pair of order statistics, as far from either end, that holds the median with 95 %; None of few."""
    n = len(values)
    if n < FEWEST:
        return None
    values = sorted(values)
    out, tail = 0, 1.0  # tail: ways in which at most `out` lie below the median
    while 2 * (tail + math.comb(n, out + 1)) <= 0.05 * 2 ** n:
        out += 1
        tail += math.comb(n, out)
    return (values[out], values[n - 1 - out])


def mean_interval(values):
    if len(values) < 2:
        return None
    half = Z95 * statistics.stdev(values) / math.sqrt(len(values))
    return (statistics.mean(values) - half, statistics.mean(values) + half)


def at_least(title, limit, figure, interval, n, text="{:.3f}"):
    good = None if figure is None else figure >= limit - 1e-9
    return Line(title, ">= " + text.format(limit), figure, interval, n, good,
                bool(interval) and interval[0] < limit <= interval[1], text)


def at_most(title, limit, figure, interval, n, text="{:.2f}"):
    return Line(title, "<= " + text.format(limit), figure, interval, n, figure <= limit + 1e-9,
                bool(interval) and interval[0] <= limit < interval[1], text)


def within(title, limit, values, text="{:+.2f}"):
    """A signed median within +-limit; without a limit it is only told."""
    values = [v for v in values if v is not None]
    figure = statistics.median(values) if values else None
    interval = median_interval(values)
    good = None if interval is None or limit is None else abs(figure) <= limit + 1e-9
    judged = limit is not None and interval is not None
    unsettled = (judged and interval[0] <= limit and interval[1] >= -limit
                 and not (interval[0] >= -limit and interval[1] <= limit))
    wanted = "" if limit is None else "+-" + text.format(limit).lstrip("+")
    return Line(title, wanted, figure, interval, len(values), good, unsettled, text)


def off_one(schools, key):
    return [None if s[key] is None else s[key] - 1 for s in schools]


def third(value, bounds):
    """Index of the third that score put it in; None of an unknown place."""
    if value is None:
        return None
    return sum(1 for low in bounds[1:] if value >= low)


def thirds_of(told, found, place, key, low):
    """The found schools of one survey by third."""
    bounds = [t[low] for t in told["summary"][key]]
    out = [[], [], []]
    for school in found:
        at = third(school[place], bounds)
        if at is not None:
            out[at].append(school)
    return out


def judge(limits, scores):
    """The table's lines for what `score --json` told of some surveys."""
    counted, found, false, pings, causes = [], [], 0, 0, {}
    by_range, by_elevation = [[], [], []], [[], [], []]
    for told in scores:
        here = [s for s in told["schools"] if s["counted"]]
        held = [s for s in here if s["found_id"] and not s["merged"]]
        counted += here
        found += held
        false += len(told["false_schools"])
        pings += told["summary"]["pings"]
        for cause, schools in told["summary"]["false_by_cause"].items():
            causes[cause] = causes.get(cause, 0) + schools
        for thirds, more in ((by_range, thirds_of(told, held, "range_m", "by_range_third", "from_m")),
                             (by_elevation, thirds_of(told, held, "elevation_deg", "by_elevation_third", "from_deg"))):
            for third_, schools in zip(thirds, more):
                third_ += schools
    dice = [s["dice"] or 0.0 for s in counted]
    purity = [s["purity"] for s in found if s["purity"] is not None]
    n = len(counted)
    per_200 = 200 / pings if pings else math.nan
    lines = [at_least("counted schools found", limits.found, len(found) / n if n else None, wilson(len(found), n), n),
             at_least("mean Dice with the expected -10 dB mask", limits.dice, statistics.mean(dice) if dice else None,
                      mean_interval(dice), n),
             at_most("false schools in 200 pings", limits.false_per_200, false * per_200,
                     tuple(v * per_200 for v in poisson(false)), pings)]
    if scores:
        for name, thirds, key, low, high, unit in (
                ("range", by_range, "by_range_third", "from_m", "to_m", "m"),
                ("elevation", by_elevation, "by_elevation_third", "from_deg", "to_deg", "deg")):
            for at, schools in zip(scores[0]["summary"][key], thirds):
                where = f"{at[low]:.0f} .. {at[high]:.0f}" if at[low] is not None else "?"
                lines.append(within(f"backscatter_total, dB, {name} {where} {unit}", limits.backscatter_db,
                                    [s["total_backscatter_error_db"] for s in schools]))
    for side in ("length", "width", "height"):
        lines.append(within(f"corrected {side}, share", limits.size, off_one(found, f"{side}_corrected_ratio")))
    lines.append(at_least("mean purity", limits.purity, statistics.mean(purity) if purity else None,
                          mean_interval(purity), len(purity)))
    lines += [within("told only: backscatter, dB", None, [s["backscatter_error_db"] for s in found]),
              within("told only: backscatter of the body, dB", None, [s["body_backscatter_error_db"] for s in found]),
              within("told only: mean Sv, dB", None, [s["sv_error_db"] for s in found]),
              within("told only: apparent volume, share", None, off_one(found, "volume_ratio")),
              within("told only: corrected volume, share", None, off_one(found, "volume_corrected_ratio")),
              within("told only: speed, m/s", None, [s["speed_error_mps"] for s in found if s["n_unclipped"] >= 8],
                     "{:+.3f}")]
    return lines, sizes(found), causes


def sizes(found):
    """(error, median of its size, 90 % of it): the absolute errors beside the signed ones."""
    out = []
    for title, values in (("backscatter, dB", [s["backscatter_error_db"] for s in found]),
                          ("mean Sv, dB", [s["sv_error_db"] for s in found]),
                          *((f"corrected {side}, share", off_one(found, f"{side}_corrected_ratio"))
                            for side in ("length", "width", "height", "volume"))):
        known = sorted(abs(v) for v in values if v is not None)
        if known:
            out.append((title, statistics.median(known), known[math.ceil(0.9 * len(known)) - 1]))
    return out


def draw(count):
    return random.SystemRandom().sample(range(1000, 1_000_000), count)


def fresh(show, physics, seeds, arguments):
    """Simulates, runs and scores each seed and prints the table; misses are noted by `show`."""
    again = ",".join(map(str, seeds))
    print(f"6. fresh seeds, {physics} physics; again: tools/show fresh --{physics}-seeds {again}")
    scores = []
    for seed in seeds:
        survey, out = show.simulate_and_run("-".join(map(str, ["fresh", physics, seed, *arguments])).replace("--", ""),
                                            "--physics", physics, "--seed", seed, *arguments)
        told = json.loads(show.call("score", out, "--truth", survey / "truth", "--json").stdout)
        scores.append(told)
        summary = told["summary"]
        causes = ", ".join(f"{cause} {n}" for cause, n in summary["false_by_cause"].items())
        dice = "-" if summary["mean_dice"] is None else f"{summary['mean_dice']:.3f}"
        print(f"  seed {seed}: {summary['found']} of {summary['counted']} found, Dice {dice}, "
              f"{summary['false_schools']} false{' (' + causes + ')' if causes else ''}", flush=True)
        shutil.rmtree(survey, ignore_errors=True)
        shutil.rmtree(out, ignore_errors=True)
    lines, absolute, causes = judge(LIMITS[physics], scores)
    print(f"  {'':<5}{'medians are signed':<42}{'wanted':>9}{'got':>9}  {'95 % interval':<18}{'n':>5}")
    for line in lines:
        print(f"  {line}")
        if line.good is False:
            show.failures.append(f"{physics}: {line.title}")
    for title, median, most in absolute:
        print(f"       size of the error: {title}: median {median:.2f}, 90 % below {most:.2f}")
    if causes:
        print("       false schools by cause: " + ", ".join(f"{c} {n}" for c, n in sorted(causes.items())))
    judged = [line for line in lines if line.wanted]
    print(f"  {physics}: {sum(1 for line in judged if line.good)} of {len(judged)} hold, "
          f"{sum(1 for line in judged if line.good is False)} missed, "
          f"{sum(1 for line in judged if line.good is None)} of too few schools")
