# SPDX-License-Identifier: Apache-2.0
"""Part `judges` of tools/show: new seeds of array physics, half of them with fish, are run with all judges and with each of
them left out (detect.left_out). Each judge's own scene is in src/school/judge/judges_test.cpp."""

import json
import shutil

import fresh_seeds

JUDGES = ["size", "prominence", "confirmation", "ship", "level", "surface"]
PINGS = 60


def figures(show, survey, out, arguments):
    """(schools that count, found, sum of their Dice, false) of one survey."""
    show.call("run", survey, "--out", out, *arguments)
    told = json.loads(show.call("score", out, "--truth", survey / "truth", "--json").stdout)
    counted = [s for s in told["schools"] if s["counted"]]
    return (len(counted), sum(1 for s in counted if s["found_id"]), sum(s["dice"] or 0 for s in counted),
            len(told["false_schools"]))


def judges(show, seeds):
    version = json.loads(show.call("recipe").stdout)["recipe_version"]
    sums = {left_out: [0, 0, 0.0, 0, 0] for left_out in ["", *JUDGES]}  # ..., false in water without fish
    for number, seed in enumerate(seeds):
        fish = number < (len(seeds) + 1) // 2
        survey, out = show.work / f"judges{seed}-survey", show.work / f"judges{seed}-out"
        for folder in (survey, out):
            shutil.rmtree(folder, ignore_errors=True)
        show.call("simulate", survey, "--physics", "array", "--seed", seed, "--observations", 1, "--pings", PINGS,
                  *(() if fish else ("--no-fish",)))
        for left_out, sum_of in sums.items():
            recipe = show.work / "judges.json"
            recipe.write_text(json.dumps({"recipe_version": version, "detect": {"left_out": left_out}}))
            told = figures(show, survey, out, ("--recipe", recipe))
            for i in range(3):
                sum_of[i] += told[i]
            sum_of[3 if fish else 4] += told[3]
        for folder in (survey, out):
            shutil.rmtree(folder)
    return sums


def table(show, seeds, surveys):
    seeds = seeds or fresh_seeds.draw(2 * surveys)
    print(f"3. judges; again: tools/show judges --judge-seeds {','.join(map(str, seeds))} (the first half with fish)")
    sums = judges(show, seeds)
    print(f"  {'left out':<14}{'found':>10}{'Dice':>8}{'false':>8}{'false, no fish':>16}")
    for left_out, (counted, found, dice, false, false_empty) in sums.items():
        print(f"  {left_out or 'none':<14}{f'{found} of {counted}':>10}{dice / max(counted, 1):>8.3f}{false:>8}"
              f"{false_empty:>16}")
    all_of, without = sums[""], [sums[name] for name in JUDGES]
    show.line("no judge adds false schools", all(all_of[3] + all_of[4] <= s[3] + s[4] for s in without))
    show.line("no judge costs more than one school in twenty", all(20 * (s[1] - all_of[1]) <= s[0] for s in without))
