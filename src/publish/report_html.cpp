// SPDX-License-Identifier: Apache-2.0
#include "publish/report_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "io/column_words.h"
#include "io/csv.h"
#include "model/strongest_ping.h"
#include "publish/chart_picture.h"
#include "publish/html_text.h"
#include "publish/map_pictures.h"
#include "publish/report_facts.h"
#include "publish/slice_pictures.h"
#include "publish/volume_picture.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPicturedSchools = 3;
constexpr std::size_t kMostRows = 2000;  ///< of a table: a browser stays quick, and the CSV has all
constexpr std::size_t kMostNotes = 200;
constexpr PixelSize kWide{1000, 560};
constexpr PixelSize kTimeline{1000, 320};
constexpr PixelSize kChart{640, 400};
constexpr PixelSize kSlice{640, 480};

constexpr std::string_view kStyle = R"(
html{font:15px/1.45 system-ui,sans-serif;color:#1b1f24;background:#fff}
body{max-width:1040px;margin:2em auto;padding:0 1.2em}
h1{font-size:1.6em;margin:0 0 .4em}h2{font-size:1.25em;margin:2em 0 .5em;border-bottom:1px solid #c9d1d9;padding-bottom:.2em}
h3{font-size:1.05em;margin:1.4em 0 .4em}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15em 1.2em;margin:0}dt{color:#57606a}dd{margin:0;overflow-wrap:anywhere}
figure{margin:1em 0}img{max-width:100%;height:auto}figcaption,caption{color:#57606a;font-size:.9em;text-align:left;padding:.2em 0}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:0 1em}.pair figure{margin:.4em 0}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.8em}th,td{padding:.15em .5em;border-bottom:1px solid #e1e4e8;text-align:left;vertical-align:top}
th{background:#f3f5f7;font-weight:600}td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
pre{font-size:.8em;background:#f6f8fa;padding:.8em;white-space:pre-wrap;overflow-wrap:anywhere}
footer{margin-top:3em;color:#57606a;font-size:.85em}
@media print{@page{size:A4 landscape;margin:12mm}html{font-size:10px}body{max-width:none;margin:0;padding:0}
.wide{overflow:visible}table{font-size:5.5px}th,td{padding:1px 2px}figure,tr{break-inside:avoid}h2,h3{break-after:avoid}thead{display:table-header-group}}
)";

/// Rows as the table that export writes of them.
template <class Row>
Result<CsvTable> table_of(const std::vector<Row>& rows, std::string_view name) {
  return parse_csv(csv_text(rows), std::string(name));
}

class HtmlReport {
 public:
  HtmlReport(PictureSource& source, std::span<const fs::path> paths, const PictureOptions& options, Work& work)
      : source_(source),
        paths_(paths),
        options_(options),
        work_(work),
        facts_(report_facts(source.observations(), source.recipe())) {
    options_.limits_given = false;
    options_.dark = false;  // paper is white
    for (DrawnObservation& one : source_.observations()) all_.push_back(&one);
  }

  Result<std::string> made() {
    add_head();
    using Step = Result<void> (HtmlReport::*)();
    constexpr std::array<Step, 7> kSteps = {
        &HtmlReport::add_overview, &HtmlReport::add_schools, &HtmlReport::add_charts, &HtmlReport::add_strongest,
        &HtmlReport::add_effort,   &HtmlReport::add_files,   &HtmlReport::add_notes};
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      if (auto added = (this->*kSteps[i])(); !added) return pass_on(added);
      work_.progress("report", static_cast<std::int64_t>(i) + 1, std::ssize(kSteps));
    }
    add_recipe();
    add_meaning();
    page_ += "<footer>Times are UTC, places WGS 84; an empty field is not known.</footer>\n</body>\n</html>\n";
    return std::move(page_);
  }

 private:
  void add_head() {
    const std::string title = html_escaped(facts_.title);
    page_ =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
        title + "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n<h1>" + title + "</h1>\n<dl>\n";
    for (const auto& [name, value] : facts_.lines) {
      page_ += "<dt>" + html_escaped(name) + "</dt><dd>" + html_escaped(value) + "</dd>\n";
    }
    page_ += "</dl>\n";
  }

  /// A picture that could not be made leaves a sentence in its place; only a stop is passed on.
  Result<void> add(const Result<FrameDescription>& frame, const std::string& caption) {
    if (!frame) {
      if (frame.error().code == ErrorCode::cancelled) return pass_on(frame);
      page_ += html_paragraph(caption + ": " + frame.error().text + ".");
      return {};
    }
    const auto picture = html_picture(*frame, caption);
    if (!picture) return pass_on(picture);
    page_ += *picture;
    return {};
  }

  Result<void> add_overview() {
    page_ += html_heading("Where and when");
    PictureOptions options = options_;
    options.size = kWide;
    if (auto added = add(survey_map_frame(source_.observations(), options, work_), "Map of the survey"); !added) {
      return added;
    }
    options.size = kTimeline;
    return add(timeline_frame(all_, options, work_),
               source_.has_raw() ? "Sv against time, with the schools" : "Depths of the schools against time");
  }

  Result<void> add_schools() {
    page_ += html_heading("Schools");
    if (facts_.searched == 0) {
      page_ += html_paragraph("Schools were not detected: these are raw files without the results of a run.");
      return {};
    }
    std::vector<SchoolRow> rows;
    for (const DrawnObservation* one : all_) {
      rows.insert(rows.end(), one->product().schools.begin(), one->product().schools.end());
    }
    if (rows.empty()) {
      page_ += html_paragraph("No school was found.");
      return {};
    }
    return add_table(
        table_of(rows, "schools.csv"),
        "Every school; uncertainties stand in columns of their own: se = standard error. Figures have five "
        "digits here, and all of them in schools.csv.");
  }

  Result<void> add_charts() {
    if (facts_.schools.empty()) return {};
    page_ += html_heading("Charts");
    page_ += "<div class=\"pair\">\n";
    PictureOptions options = options_;
    options.size = kChart;
    ChartParams& chart = options.kind.chart;
    struct Axes {
      const char* x;
      const char* y;
      const char* caption;
    };
    constexpr std::array<Axes, 4> kCharts = {
        {{"depth_m", "", "Depth of the schools' centres of gravity"},
         {"sv_mean_db", "", "Mean Sv of the schools"},
         {"volume_corrected_m3", "sv_corrected_db", "Sv against volume, both corrected for the beams' widths"},
         {"time_utc", "backscatter_m2", "Backscatter against time"}}};
    chart.table = ChartTable::schools;
    for (const Axes& axes : kCharts) {
      chart.x = axes.x;
      chart.y = axes.y;
      if (auto added = add(chart_frame(all_, options), axes.caption); !added) return added;
    }
    page_ += "</div>\n";
    return {};
  }

  Result<void> add_strongest() {
    if (facts_.schools.empty()) return {};
    page_ += html_heading("The strongest schools");
    const std::size_t count = std::min(kPicturedSchools, facts_.schools.size());
    for (std::size_t i = 0; i < count; ++i) {
      if (auto added = add_school(facts_.schools[i]); !added) return added;
    }
    return {};
  }

  /// In its strongest ping, whole where there is one such.
  Result<void> add_school(const ReportSchool& school) {
    DrawnObservation& observation = source_.observations()[school.observation];
    const auto of_school = [&](const auto& row) { return row.school_id == school.school_id; };
    const SchoolPingRow* ping = strongest_ping(observation.product(), of_school);
    if (ping == nullptr) return {};
    page_ += "<h3>" + html_escaped(school.name) + "</h3>\n<div class=\"pair\">\n";
    PictureOptions options = options_;
    options.size = kSlice;
    options.ping = static_cast<int>(ping->ping_index);
    options.schools = {school.school_id};
    options.depth_raster.clear();
    const std::string where = fmt::format("{} in ping {}", school.name, ping->ping_index);
    auto added = add(volume_frame(observation, options, work_), where + ", in three dimensions");
    if (added) {
      added = add(slice_frame(PictureKind::slice_top, observation, options, work_), where + ", from above");
    }
    if (added) {
      added = add(slice_frame(PictureKind::slice_side, observation, options, work_), where + ", from the side");
    }
    if (added) added = add(observation_map_frame(observation, options), school.name + " on the map");
    if (observation.engine() != nullptr) observation.engine()->rest();
    page_ += "</div>\n";
    if (!added) return added;
    std::vector<SchoolPingRow> rows = observation.product().school_pings;
    std::erase_if(rows, [&](const SchoolPingRow& row) { return !of_school(row); });
    return add_table(
        table_of(rows, "school_pings.csv"),
        fmt::format("{} in each of its pings; those of all schools are in school_pings.csv.", school.name));
  }

  Result<void> add_table(const Result<CsvTable>& table, std::string_view caption) {
    if (!table) return pass_on(table);
    for (const std::string& name : table->header) columns_.insert(name);
    page_ += html_table(*table, caption, kMostRows);
    return {};
  }

  Result<void> add_effort() {
    struct Table {
      const char* file;
      const char* caption;
    };
    constexpr std::array<Table, 3> kTables = {
        {{"strata.csv", "Transects, strata and the survey: strata.csv"},
         {"effort.csv", "Elementary distance sampling units, and what lay off effort: effort.csv"},
         {"nasc.csv", "Range bins and depth channels of each unit: nasc.csv"}}};
    page_ += html_heading("Echo integration and effort");
    bool any = false;
    for (const fs::path& path : paths_) {
      for (const Table& table : kTables) {
        std::error_code absent;
        if (!fs::is_regular_file(path / table.file, absent)) continue;
        any = true;
        if (auto added = add_table(read_csv(path / table.file), table.caption); !added) return added;
      }
    }
    if (!any) page_ += html_paragraph("Not integrated: \"sonarx integrate\" puts its tables beside the products.");
    return {};
  }

  Result<void> add_files() {
    CsvTable table{.file = "",
                   .header = {"observation", "first_ping_utc", "pings", "raw_file", "bytes", "xxh3_128"},
                   .records = {}};
    for (const DrawnObservation* one : all_) {
      const ObservationProduct& product = one->product();
      const std::string first = product.pings.empty() ? "" : iso_time(product.pings.front().time);
      const std::string pings = std::to_string(product.pings.size());
      if (product.input_files.empty()) table.records.push_back({0, {product.observation, first, pings, "", "", ""}});
      for (const InputFile& file : product.input_files) {
        // A hash of digits alone is no number.
        table.records.push_back(
            {0, {product.observation, first, pings, file.name, std::to_string(file.size), "xxh3:" + file.hash}});
      }
    }
    page_ += html_heading("Observations and raw files");
    page_ += html_table(table, "What the observations were made from.", kMostRows);
    return {};
  }

  Result<void> add_notes() {
    CsvTable table{
        .file = "", .header = {"observation", "note", "file", "ping_index", "text", "meaning"}, .records = {}};
    for (const DrawnObservation* one : all_) {
      for (const Diagnostic& note : one->product().diagnostics) {
        const auto entry = std::ranges::find(diagnostic_table(), note.code, &DiagnosticEntry::code);
        const std::string meaning = entry == diagnostic_table().end() ? "" : std::string(entry->sentence);
        const std::string ping = note.ping_index < 0 ? "" : std::to_string(note.ping_index);
        table.records.push_back({0, {one->name(), std::string(name(note.code)), note.file, ping, note.text, meaning}});
      }
    }
    page_ += html_heading("What was noted");
    if (table.records.empty()) {
      page_ += html_paragraph("Nothing was wrong with the data.");
    } else {
      page_ += html_table(table, "Bad and doubtful data.", kMostNotes);
    }
    return {};
  }

  void add_recipe() {
    page_ += html_heading("Recipe");
    page_ += "<pre>" + html_escaped(recipe_text(source_.recipe())) + "</pre>\n";
  }

  void add_meaning() {
    if (columns_.empty()) return;
    page_ += html_heading("What the columns are");
    page_ += "<dl>\n";
    for (const std::string& column : columns_) {
      const ColumnWords* words = words_of(column);
      if (words == nullptr) continue;
      page_ += "<dt>" + html_escaped(column) + "</dt><dd>" + html_escaped(words->long_name) + "</dd>\n";
    }
    page_ += "</dl>\n";
  }

  PictureSource& source_;
  std::span<const fs::path> paths_;
  PictureOptions options_;
  Work& work_;
  ReportFacts facts_;
  std::vector<DrawnObservation*> all_;
  std::set<std::string> columns_;  ///< of the tables shown
  std::string page_;
};

}  // namespace

bool is_report_html(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending == ".html" || ending == ".htm";
}

Result<std::string> report_html(PictureSource& source, std::span<const fs::path> paths, const PictureOptions& options,
                                Work& work) {
  if (auto valid = validate_options(options); !valid) return pass_on(valid);
  return HtmlReport(source, paths, options, work).made();
}

}  // namespace sonar
