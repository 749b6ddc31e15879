# SPDX-License-Identifier: Apache-2.0
"""Charts of schools' figures beside the tables that they are of: sonarx render chart."""
import html
import re

import sonarx
from rendering import BOTH, render
from sonarx import OUT, WORK, read_csv

PAIR = r"(-?[\d.]+) (-?[\d.]+)"


class Picture:
    def __init__(self, file):
        text = file.read_text(encoding="utf-8")
        self.words = " | ".join(html.unescape(one) for one in re.findall(r"<text [^>]*>([^<]*)</text>", text))
        self.discs = []
        for path in re.findall(r"<path (?=[^>]*fill=\"rgb|[^>]*fill:rgb)[^>]*\bd=\"([^\"]*)\"", text):
            corners = {(float(x), float(y)) for x, y in re.findall(PAIR, path)}
            if "Z" in path and len(corners) in (8, 16):
                self.discs.append((sum(x for x, _ in corners) / len(corners), sum(y for _, y in corners) / len(corners)))


def line_through(pairs):
    """Least squares: (slope, offset, largest distance)."""
    n = len(pairs)
    mean_a, mean_b = sum(a for a, _ in pairs) / n, sum(b for _, b in pairs) / n
    slope = (sum((a - mean_a) * (b - mean_b) for a, b in pairs) / sum((a - mean_a) ** 2 for a, _ in pairs))
    offset = mean_b - slope * mean_a
    return slope, offset, max(abs(slope * a + offset - b) for a, b in pairs)


class Charts(sonarx.Case):
    def chart(self, *arguments, source=OUT):
        sources = source if isinstance(source, list) else [source]
        file = WORK / "chart.svg"
        code, out, error = render("chart", *sources, *arguments, "--out", file)
        self.assertEqual((code, error), (0, ""), out)
        return Picture(file)

    def test_points_lie_where_the_table_has_them(self):
        rows = [row for row in read_csv(OUT / "school_pings.csv") if row["observation"] == "obs-0001"]
        rows = [row for row in rows if row["depth_m"] and row["volume_m3"]]
        picture = self.chart("--observation", "obs-0001", "--x", "volume_m3", "--y", "depth_m", "--size", "1600x1200")
        self.assertIn(f"{len(rows)} school ping{'' if len(rows) == 1 else 's'}", picture.words)
        schools = {row["school_id"] for row in rows}
        discs = picture.discs[:len(picture.discs) - len(schools)]  # the last stand in the key
        self.assertEqual(len(discs), len(rows))
        # Axes are straight: the order of values is that of places, and one line leads from all to all.
        lines = []
        for column, at in (("volume_m3", 0), ("depth_m", 1)):
            values = sorted(float(row[column]) for row in rows)
            places = sorted(disc[at] for disc in discs)
            slope, offset, off = line_through(list(zip(values, places)))
            self.assertGreater(slope, 0, "depths run downwards")
            self.assertLess(off, 0.1, column)
            lines.append((slope, offset))
        # Each row has its disc where both of its values say.
        for row in rows:
            x, y = (slope * float(row[column]) + offset for (slope, offset), column in zip(lines, ("volume_m3", "depth_m")))
            self.assertLess(min(abs(x - disc[0]) + abs(y - disc[1]) for disc in discs), 0.3, row)

    def test_titles_count_rows_and_what_is_unknown(self):
        rows = read_csv(OUT / "school_pings.csv")
        for column in ("sv_mean_db", "bottom_depth_m", "length_corrected_m"):
            known = sum(1 for row in rows if row[column])
            if known == 0:
                continue
            said = self.chart("--y", column).words
            self.assertIn(f"{known} school pings", said, column)
            self.assertEqual(f"{len(rows) - known} left out: unknown" in said, known < len(rows), column)
        self.assertEqual(self.chart("--table", "school_pings").words, self.chart("--table", "school-pings").words)
        schools = read_csv(OUT / "schools.csv")
        self.assertIn(f"{len(schools)} schools", self.chart("--table", "schools", "--x", "depth_m", "--y", "").words)
        of_first = sum(1 for row in rows if row["observation"] == "obs-0001" and row["school_id"] == "1")
        self.assertIn(f"{of_first} school pings", self.chart("--observation", "obs-0001", "--schools", "1").words)
        self.assertEqual(self.chart(source=BOTH).words, self.chart().words, "raw files add nothing")

    def test_every_column_of_numbers_has_a_chart(self):
        text = {"observation", "continues", "origin", "status", "operator", "species", "comment", "name", "ended_at_reach"}
        for table, columns in (("school_pings", sonarx.SCHOOL_PINGS), ("schools", sonarx.SCHOOLS)):
            rows = read_csv(OUT / f"{table}.csv")
            for column in columns:
                code, _, error = render("chart", OUT, "--table", table, "--x", column, "--y", "", "--out", WORK / "c.svg")
                if column in text:
                    self.assertEqual(code, 2, column)
                elif any(row[column] for row in rows):
                    self.assertEqual((code, error), (0, ""), column)
                else:
                    self.assertIn(f"{column} is unknown in every row of {table}", error)

    def test_what_is_wrong_is_said_in_a_line(self):
        out = ("--out", WORK / "bad.svg")
        for arguments, code, said in ((("--y", "depth"), 2, "did you mean depth_m?"),
                                      (("--x", "tiem_utc"), 2, "did you mean time_utc?"),
                                      (("--table", "schools", "--x", "ping_index"), 2, "schools has no column ping_index"),
                                      (("--bins", "900"), 2, "--bins"),
                                      (("--schools", "99"), 2, "no school 99 in any observation"),
                                      (("--observation", "obs-0001", "--schools", "99"), 2, "no school 99 in obs-0001"),
                                      (("--no-masks",), 2, "--no-masks"),
                                      (("--ping", "3"), 2, "no option of chart")):
            with self.subTest(arguments):
                self.one_line_error("render", "chart", OUT, *arguments, *out, code=code, names=said)
        self.one_line_error("render", "chart", sonarx.SURVEY, *out, code=1, names="schools have not been detected")
        self.one_line_error("render", "slice-top", OUT, "--y", "depth_m", *out, code=2, names="it suits chart")


if __name__ == "__main__":
    sonarx.main()
