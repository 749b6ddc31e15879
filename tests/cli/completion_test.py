# SPDX-License-Identifier: Apache-2.0
"""Completion as somebody at a terminal gets it: bash and zsh on a terminal of their own, in which words are typed and keys pressed;
fish is asked what it would offer. What is expected comes from what `sonarx --help` says."""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import termios
import unittest

import sonarx
from sonarx import PROJECT, WORK, Case

WORDS = WORK / "completion"
HERE = WORK / "completion-folder"  # where completion of paths takes place
FILES = ["recipe-a.json", "recipe b.json", "survey.raw"]
FOLDERS = ["recipes", "export"]  # the latter is called as a verb is


def setUpModule():
    for folder in (WORDS, HERE):
        shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, "-B", PROJECT / "packaging" / "make_man", "--sonarx", sonarx.PROGRAM, "--out", WORDS],
                   check=True, timeout=300)
    for folder in FOLDERS:
        (HERE / folder).mkdir(parents=True)
    for file in FILES:
        (HERE / file).touch()


def options(verb):
    """Every option that `sonarx VERB --help` lists."""
    return set(re.findall(r"(?:^  |, ?)(--[a-z][a-z0-9-]*)", sonarx.run(verb, "--help")[1], re.MULTILINE))


class Typed:
    """A shell on a terminal of its own. `begin`: what it is told first; it shall send its line to the file $TOLD at Ctrl-X Ctrl-P and
    put everything that it offers into its line at Ctrl-X Ctrl-A."""

    def __init__(self, words, begin):
        self.told_path = WORDS / f"told-by-{words[0]}"
        os.mkfifo(self.told_path)
        self.told = os.open(self.told_path, os.O_RDWR)
        self.terminal, theirs = pty.openpty()
        termios.tcsetwinsize(theirs, (50, 2000))  # no line is broken
        self.shell = subprocess.Popen(words, stdin=theirs, stdout=theirs, stderr=theirs, cwd=HERE, start_new_session=True,
                                      env={"PATH": os.environ["PATH"], "HOME": str(WORDS), "TERM": "dumb", "LC_ALL": "C.UTF-8",
                                           "TOLD": str(self.told_path), "WORDS": str(WORDS), "PS1": "> "})
        os.close(theirs)
        self.press(begin + "\nprintf '%s\\0' ready >$TOLD\n")
        self.heard()

    def press(self, keys):
        os.write(self.terminal, keys.encode())

    def heard(self):
        said, seen = b"", b""
        while not said.endswith(b"\0"):
            ready, _, _ = select.select([self.told, self.terminal], [], [], 60)
            if not ready:
                raise TimeoutError(f"{self.shell.args[0]} says nothing; its terminal shows {seen[-2000:]!r}")
            if self.told in ready:
                said += os.read(self.told, 65536)
            if self.terminal in ready:
                seen += os.read(self.terminal, 65536)
        return said[:-1].decode()

    def line_after(self, typed, key):
        self.press(typed + key + "\x18\x10")
        line = self.heard()
        self.press("\x15")  # Ctrl-U: an empty line again
        return line

    def end(self):
        self.shell.kill()
        self.shell.wait()
        for descriptor in (self.told, self.terminal):
            os.close(descriptor)


class Shells:
    """The same for each; `offered(line)` is the set of words that the shell offers for the last one."""

    def test_verbs(self):
        self.assertEqual(self.offered("sonarx "), {*sonarx.VERBS, "help"})
        self.assertEqual(self.offered("sonarx re"), {"recipe", "render"})
        self.assertEqual(self.offered("sonarx --v"), {"--version"})
        self.assertEqual(self.offered("sonarx help re"), {"recipe", "render"})

    def test_options_of_every_verb_are_those_of_its_help(self):
        for verb in sonarx.VERBS:
            of_help = options(verb)
            self.assertIn("--help", of_help)
            self.assertEqual(self.offered(f"sonarx {verb} --"), of_help, verb)

    def test_options_are_those_of_the_verb(self):
        self.assertEqual(self.offered("sonarx run survey.raw --re"), {"--recipe", "--remeasure"})
        self.assertEqual(self.offered("sonarx info export --"), options("info"), "a folder called as a verb is")

    def test_values(self):
        self.assertEqual(self.offered("sonarx simulate recipes --preset "), {"easy", "standard", "hard", "demo"})
        self.assertEqual(self.offered("sonarx export recipes --to g"), {"gpkg", "geojson", "gltf"})
        self.assertEqual(self.offered("sonarx render volume recipes --map v"), {"viridis"})
        self.assertEqual(self.offered("sonarx render slice-"), {"slice-top", "slice-side", "slice-range", "slice-plane"})

    def test_values_behind_an_equals_sign(self):
        self.assertEqual(self.offered("sonarx simulate recipes --preset=h"), {"hard"})
        self.assertEqual(self.offered("sonarx run survey.raw --recipe=recipe-"), {"recipe-a.json"})

    def test_paths(self):
        self.assertEqual(self.offered("sonarx info s"), {"survey.raw"})
        self.assertEqual(self.offered("sonarx render volume r"), {"recipe-a.json", "recipe b.json", "recipes"})
        self.assertEqual(self.offered("sonarx run survey.raw --recipe r"), {"recipe-a.json", "recipe b.json", "recipes"})
        self.assertEqual(self.offered("sonarx run survey.raw -o r"), {"recipes"}, "folders alone")

    def test_nothing_is_offered_for_a_number_or_a_text(self):
        for line in ("run survey.raw -j ", "simulate recipes --seed ", "simulate recipes --file-mb ", "propagate survey.raw --tolerance-db ",
                     "propagate survey.raw --tolerance-opacity ", "follow survey.raw --alarm ", "run survey.raw --only "):
            self.assertEqual(self.offered("sonarx " + line), set(), line)
        self.assertFalse(self.offered("sonarx recipe ") & {*FILES, *FOLDERS}, "it takes no path")


class AtATerminal(Shells):
    @classmethod
    def tearDownClass(cls):
        cls.shell.end()

    def offered(self, line):
        begun = line.rsplit(" ", 1)[0] + " "
        got = self.shell.line_after(line, "\x18\x01")
        self.assertTrue(got.startswith(begun), f"{line!r} became {got!r}")
        if got.rstrip() == line.rstrip():
            return set()  # nothing was put in
        words = re.findall(r"(?:\\.|[^\s\\])+", got[len(begun):])
        return {re.sub(r"\\(.)", r"\1", re.sub(r"^--[a-z-]+=(?=.)", "", word)).rstrip("/=") for word in words}

    def test_a_single_one_is_put_in(self):
        for typed, expected in (("sonarx rec", "sonarx recipe "), ("sonarx info survey", "sonarx info survey.raw "),
                                ("sonarx run survey.raw --cal", "sonarx run survey.raw --calibration"),
                                ("sonarx run -o recipe", "sonarx run -o recipes/"),
                                ("sonarx info recipe\\ ", "sonarx info recipe\\ b.json ")):
            self.assertEqual(self.shell.line_after(typed, "\t").rstrip(" ="), expected.rstrip(), typed)


@unittest.skipUnless(shutil.which("bash"), "bash is not installed")
class Bash(AtATerminal, Case):
    @classmethod
    def setUpClass(cls):
        # With Debian's bash-completion the file is found by its name, as an installed one is.
        folder = WORDS / ".local" / "share" / "bash-completion" / "completions"
        folder.mkdir(parents=True)
        (folder / "sonarx").symlink_to(WORDS / "bash" / "sonarx")
        cls.shell = Typed(["bash", "--norc", "--noprofile", "-i"], r"""
            if [[ -f /usr/share/bash-completion/bash_completion ]]; then . /usr/share/bash-completion/bash_completion
            else . "$WORDS/bash/sonarx"; fi
            bind 'set completion-query-items 0'; bind 'set page-completions off'; bind 'set enable-bracketed-paste off'
            bind '"\C-x\C-a": insert-completions'; bind -x '"\C-x\C-p": printf "%s\0" "$READLINE_LINE" >$TOLD'""")


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class Zsh(AtATerminal, Case):
    @classmethod
    def setUpClass(cls):
        cls.shell = Typed(["zsh", "-f", "-i"], r"""
            fpath=($WORDS/zsh $fpath); autoload -Uz compinit; compinit -u -D; unsetopt beep
            tell() { printf '%s\0' "$BUFFER" >$TOLD }; zle -N tell; bindkey '^X^P' tell
            zle -C all-matches complete-word _generic; bindkey '^X^A' all-matches
            zstyle ':completion:all-matches::::' completer _all_matches _complete; zstyle ':completion:all-matches:*' insert true""")


@unittest.skipUnless(shutil.which("fish"), "fish is not installed")
class Fish(Shells, Case):
    def offered(self, line):
        done = subprocess.run(["fish", "--no-config", "-c", "source $argv[1]; complete -C $argv[2]", WORDS / "fish" / "sonarx.fish", line],
                              cwd=HERE, env={**os.environ, "HOME": str(WORDS), "XDG_CONFIG_HOME": str(WORDS), "XDG_DATA_HOME": str(WORDS)},
                              capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(done.stderr, "")
        return {re.sub(r"^--[a-z-]+=", "", text.split("\t")[0]).rstrip("/") for text in done.stdout.splitlines()}


if __name__ == "__main__":
    sonarx.main()
