# SPDX-License-Identifier: Apache-2.0
"""Help, versions, wrong usage, and every command that the README and the pages show."""
import json
import re
import shlex

import sonarx
from sonarx import PROJECT, VERBS, Case, run


class Usage(Case):
    def test_help_names_every_verb(self):
        text = self.sonarx("--help")
        for verb in VERBS:
            self.assertRegex(text, rf"(?m)^\s+{verb}\b")

    def test_every_verb_has_help(self):
        self.assertIn("Usage: sonarx [OPTIONS] VERB\n", self.sonarx("--help"))
        self.assertIn("\nVerbs:\n", self.sonarx("--help"))
        for verb in VERBS:
            with self.subTest(verb):
                self.assertGreater(len(self.sonarx(verb, "--help")), 80)

    def test_help_says_what_stands_for_a_value(self):
        kinds = {"N", "X", "X|FILE", "FILE", "FOLDER", "PATH", "NAME", "WORD", "A:B", "HOST:PORT", "RULE", "TIME", "N,N", "WIDTHxHEIGHT",
                 "X,Y,Z", "X,Y,X,Y", "T,S,DEPTH", "FROM,TO", "PING,FAN,BEAM,SAMPLE", "COLUMN"}
        found = set()
        for verb in VERBS:
            found |= set(re.findall(r"(?m)^  -\S+ ([A-Z]\S*)", self.sonarx(verb, "--help")))
        self.assertEqual(found, kinds)
        for verb, line in (("run", "-o,--out FOLDER  "), ("run", "--recipe FILE  "), ("run", "--session PATH  "), ("run", "--only NAME  "),
                           ("recipe", "--preset WORD  "), ("recipe", "-o,--out FILE  "), ("render", "--eye X,Y,Z  "),
                           ("render", "--size WIDTHxHEIGHT (1200x900)"), ("export", "--to WORD (required)"), ("follow", "--nmea HOST:PORT  ")):
            self.assertIn(f"\n  {line}", self.sonarx(verb, "--help"))

    def test_help_names_a_manual_that_is_there(self):
        for arguments in (("--help",), ("run", "--help")):
            manual = re.search(r"(?m)^Manual: (.*)$", self.sonarx(*arguments)).group(1)
            self.assertTrue((PROJECT / manual).is_file(), manual)

    def test_an_empty_value_of_an_unset_variable_is_refused(self):
        for option in ("--recipe", "--session", "--calibration", "--sound-speed"):
            code, _, err = run("run", "x", "--out", "y", option, "")
            self.assertEqual((code, err), (2, f"sonarx: {option}: an empty path names nothing; see sonarx run --help\n"))

    def test_version_is_the_projects(self):
        project = re.search(r"project\(sonar-explorer VERSION (\S+)", (PROJECT / "CMakeLists.txt").read_text()).group(1)
        self.assertIn(project, self.sonarx("--version"))

    def test_wrong_usage_is_two(self):
        for arguments in [(), ("no-such-verb",), ("info",), ("info", "--no-such-flag"), ("simulate",), ("run",),
                          ("score",), ("compare", "a"), ("simulate", "x", "--preset", "no-such-preset"),
                          ("simulate", "x", "--pings", "-3"), ("simulate", "x", "--seed", "word"),
                          ("export", "x", "--to", "no-such-format", "--dest", "y")]:
            with self.subTest(arguments):
                code, out, err = run(*arguments)
                self.assertEqual(code, 2, out + err)
                self.assertEqual(out, "")
                self.assertNotEqual(err.strip(), "")

    def test_wrong_usage_names_what_was_wrong(self):
        for arguments, said in [(("foo",), "there is no verb 'foo'; see sonarx --help"),
                                (("run", "x", "--out", "y", "--only", ""), "--only: an empty name names nothing"),
                                (("simulate", "x", "--seed", "9" * 30), "9 is out of range"),
                                (("simulate", "x", "--seed", "word"), "--seed: word is no whole number; see"),
                                (("simulate", "x", "--seed", "1.5"), "--seed: 1.5 is no whole number; see"),
                                (("simulate", "x", "--noise", "word"), "--noise: word is no number; see"),
                                (("render", "volume", "x", "--out", "y", "--ping", "abc"),
                                 "--ping: abc is no whole number; see"),
                                (("render", "volume", "x", "--out", "y", "--low-db", "abc"), "--low-db: abc is no number"),
                                (("render", "volume", "x", "--out", "y", "--scale", "x"), "--scale: x is no number"),
                                (("follow", "x", "--out", "y", "--idle-exit", "x"), "--idle-exit: x is no number"),
                                ((), "a verb is needed; see sonarx --help"),
                                (("simulate", "x", "--pings", "-3"), "--pings: -3 is outside 1 .. 100000"),
                                (("simulate", "x", "--speed-knots", "-1"), "--speed-knots: -1 is outside "),
                                (("simulate", "x", "--noise", "-1"), "--noise: -1 is outside "),
                                (("simulate", "x", "--noise", "nan"), "--noise: nan is outside "),
                                (("simulate", "x", "--jobs", "-3"), "--jobs: "),
                                (("run", "--plan", "plan.json", "--task", "-1"), "--task: -1 is no whole number in 0"),
                                (("propagate", "x", "--observation", "obs-0001", "--seed", "0,0,0,0", "--out", "y",
                                  "--tolerance-db", "nan"), "--tolerance-db: nan is outside 0.1 .. 60"),
                                (("recipe", "foo"), "sonarx: 'foo' is one word too many; see sonarx recipe --help"),
                                (("status", "OUT", "one", "two"), "sonarx: 'one' is one word too many; see"),
                                (("help", "run", "extra"), "sonarx: 'extra' is one word too many; see"),
                                (("run", "x", "-o", "a", "--out", "b"), "sonarx: --out is given more than once; see"),
                                (("run", "x", "--out"), "sonarx: --out needs a value; see"),
                                (("run", "x", "--out", "y", "--json=word"), "sonarx: --json takes no value; see"),
                                (("render", "volume", "x", "-o", "y", "--no-masks=word"), "sonarx: --no-masks takes no value; see"),
                                (("recipe", "--preset", "papr"),
                                 "--preset: papr is none of default, paper (did you mean paper?); see"),
                                (("export", "OUT", "--to", "csvs", "-o", "y"), "--to: csvs is none of csv, netcdf-mask"),
                                (("export", "OUT", "--to", "csvs", "-o", "y"), "(did you mean csv?); see sonarx export"),
                                (("info", "--no-such-flag"), "there is no option --no-such-flag; see sonarx info --help"),
                                (("run", "x", "--ouf", "y"), "there is no option --ouf; did you mean --out?"),
                                (("--no-such-flag",), "there is no option --no-such-flag; see sonarx --help"),
                                (("merge", "OUT", "--jsn"), "there is no option --jsn; did you mean --json?")]:
            with self.subTest(arguments):
                code, _, err = run(*arguments)
                self.assertEqual(code, 2)
                self.assertIn(said, err)
                self.assertLess(len(err), 200)
                self.assertEqual(err, "\n".join(line.rstrip() for line in err.splitlines()) + "\n")

    def test_more_jobs_than_cores_are_no_matter_of_the_user(self):
        code, _, err = run("simulate", sonarx.WORK / "many-jobs", "--preset", "easy", "--pings", "2", "--observations",
                           "1", "--schools", "1", "--force", "--jobs", "500")
        self.assertEqual((code, err), (0, ""))

    def test_what_is_not_there_fails_in_one_line(self):
        gone = sonarx.WORK / "not-there"
        for arguments in [("run", gone, "--out", sonarx.WORK / "nowhere"), ("merge", gone), ("compare", gone, gone),
                          ("score", gone, "--truth", gone), ("recipe", "--validate", gone / "r.json")]:
            with self.subTest(arguments):
                self.one_line_error(*arguments, code=1, names=gone)

    def test_earlier_names_of_simulator_parameters_are_read_and_noted(self):
        params = self.fresh("earlier-names") / "params.json"
        for earlier, name in (("walls", "interference"), ("impulses", "impulse_noise")):
            params.write_text(json.dumps({"noise": {earlier: 3}}))
            code, out, err = run("simulate", "x", "--params", params, "--print-params")
            self.assertEqual((code, json.loads(out)["noise"][name]), (0, 3))
            self.assertIn(f"noise.{earlier} is called noise.{name} now", err)

    def test_a_file_is_written_only_where_its_folder_is(self):
        folder = self.fresh("file-to-write")
        for arguments in (("recipe",), ("render", "slice-top", sonarx.WORK)):
            with self.subTest(arguments[0]):
                self.one_line_error(*arguments, "-o", folder, code=2, names=f"{folder}: is a folder; a file is meant")
                self.one_line_error(*arguments, "-o", folder / "none" / "x.png", code=1,
                                    names=f"{folder / 'none'}: no such folder to write to")
        self.assertEqual(list(folder.iterdir()), [])

    def test_commands_in_the_pages_exist(self):
        pages = [PROJECT / "README.md", *sorted((PROJECT / "docs").glob("*.md"))]
        commands = []
        for page in pages:
            for block in re.findall(r"```(?:sh|bash)\n(.*?)```", page.read_text(), re.DOTALL):
                joined = block.replace("\\\n", " ")
                commands += [(page.name, line.split("#")[0].strip()) for line in joined.splitlines() if line.strip()]
        shown = [(page, shlex.split(line)) for page, line in commands if line]
        self.assertGreater(len(shown), 10)
        help_of = {verb: self.sonarx(verb, "--help") for verb in VERBS}
        for page, words in shown:
            with self.subTest(f"{page}: {' '.join(words)}"):
                if words[0] == "sonarx":
                    if words[1].startswith("--"):
                        continue
                    self.assertIn(words[1], VERBS)
                    for flag in (w.split("=")[0] for w in words[2:] if w.startswith("--")):
                        self.assertIn(flag, help_of[words[1]])
                elif words[0].startswith("tools/"):
                    self.assertTrue((PROJECT / words[0]).stat().st_mode & 0o111, words[0])


if __name__ == "__main__":
    sonarx.main()
