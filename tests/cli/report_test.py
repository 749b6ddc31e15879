# SPDX-License-Identifier: Apache-2.0
"""The report's page says what the tables say."""
import html
import re
import shutil
import subprocess

import sonarx
from rendering import BOTH, render


class Report(sonarx.Case):
    def words(self, *paths):
        file = self.fresh("report") / "report.svg"
        code, out, error = render("report", *paths, "--out", file)
        self.assertEqual((code, error), (0, ""), out)
        return [html.unescape(text) for text in re.findall(r"<text [^>]*>([^<]*)</text>", file.read_text(encoding="utf-8"))]

    def test_the_schools_are_those_of_the_table(self):
        rows = [row for row in sonarx.read_csv(sonarx.OUT / "schools.csv") if row["status"] != "rejected"]
        self.assertTrue(all(not row["continues"] for row in rows), "the small survey has no school that is cut")
        strongest = max(rows, key=lambda row: float(row["backscatter_total_m2"] or row["backscatter_m2"]))
        for paths in (BOTH, [sonarx.OUT]):
            # Errors stand behind their figures.
            words = [text.split(" \u00b1")[0] for text in self.words(*paths)]
            self.assertIn(strongest["observation"] + "/" + strongest["school_id"], words)
            backscatter = float(strongest["backscatter_total_m2"] or strongest["backscatter_m2"])
            self.assertIn(f"{backscatter:#.3g}".rstrip("."), words)
            self.assertIn(f"{float(strongest['depth_m']):.1f}", words)
            self.assertIn(f"{float(strongest['sv_mean_db']):.1f}".replace("-", "\u2212"), words)
            self.assertIn(strongest["survey_school"], words)
            for row in rows:
                self.assertIn(row["observation"] + "/" + row["school_id"], words)
            self.assertTrue(any(text.startswith(f"{len(rows)}, backscatter ") for text in words), words)
            said = " ".join(words)
            self.assertIn("SYNTHETIC", said)
            self.assertIn("28", words, "pings of both observations")

    def test_raw_files_alone_say_that_nobody_looked(self):
        said = " ".join(self.words(sonarx.SURVEY))
        self.assertIn("Schools were not detected", said)
        self.assertNotIn("No school was found", said)

    def test_it_is_one_a4_page_with_text_that_can_be_found(self):
        file = self.fresh("report-pdf") / "report.pdf"
        self.sonarx("render", "report", sonarx.OUT, "--out", file)
        self.assertRegex(file.read_bytes(), rb"/MediaBox \[ 0 0 595\.\d+ 842\.\d+ \]")
        first = file.read_bytes()
        self.sonarx("render", "report", sonarx.OUT, "--out", file)
        self.assertEqual(file.read_bytes(), first, "the same page twice is the same file")
        if shutil.which("pdftotext") is None:
            self.skipTest("there is no pdftotext")
        text = subprocess.run(["pdftotext", "-layout", file, "-"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(text.count("\f"), 1, "one page")
        self.assertIn("obs-0001/1", text)

    def test_the_whole_of_it_is_many_pages(self):
        file = self.fresh("report-whole") / "report.pdf"
        self.sonarx("render", "report", sonarx.OUT, "--whole", "--out", file)
        data = file.read_bytes()
        pages = len(re.findall(rb"/Type /Page\b", data))
        self.assertGreater(pages, 5)
        self.assertIn(b"/Count %d" % pages, data)
        self.assertEqual(set(re.findall(rb"/MediaBox \[ 0 0 (\d+)\.\d+ (\d+)\.\d+ \]", data)), {(b"595", b"842")})
        if shutil.which("pdftotext") is None:
            self.skipTest("there is no pdftotext")
        text = subprocess.run(["pdftotext", "-layout", file, "-"], capture_output=True, text=True, check=True).stdout
        for words in ("SYNTHETIC", "Charts", "The strongest schools", "Recipe", "What the columns are", f"page {pages} of {pages}"):
            self.assertIn(words, text)

    def test_the_whole_goes_with_files_of_many_pages(self):
        for name in ("x.svg", "x.png", "-"):
            self.one_line_error("render", "report", sonarx.OUT, "--whole", "--out", name, code=2,
                                names="--whole: goes with a name that ends in .pdf or .html")
        self.one_line_error("render", "survey-map", sonarx.OUT, "--whole", "--out", sonarx.WORK / "x.pdf", code=2,
                            names="--whole: no option of survey-map")
        self.one_line_error("render", "report", sonarx.OUT, "--whole", "--out", sonarx.WORK / "x.pdf", "--reference",
                            sonarx.OUT / "survey.json", code=2, names="a whole report is no picture to be compared")

    def test_what_does_not_suit_a_page_is_refused(self):
        for option in (["--size", "640x480"], ["--schools", "1"], ["--ping", "3"]):
            self.one_line_error("render", "report", sonarx.OUT, *option, "--out", sonarx.WORK / "x.pdf", code=2,
                                names=option[0] + ": no option of report")


if __name__ == "__main__":
    sonarx.main()
