// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_contents.h"

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
#include "publish/maps/map_pictures.h"
#include "publish/reports/report_facts.h"
#include "publish/slice_pictures.h"
#include "publish/volumes/volume_picture.h"

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

/// Rows as the table that export writes of them.
template <class Row>
Result<CsvTable> table_of(const std::vector<Row>& rows, std::string_view name) {
  return parse_csv(csv_text(rows), std::string(name));
}

class Contents {
 public:
  Contents(ReportWriter& writer, PictureSource& source, std::span<const fs::path> paths, const PictureOptions& options,
           Work& work)
      : writer_(writer),
        source_(source),
        paths_(paths),
        options_(options),
        work_(work),
        facts_(report_facts(source.observations(), source.recipe())) {
    options_.limits_given = false;
    options_.dark = false;  // paper is white
    options_.units = {};    // as its tables, which are those of the files: column names carry their units
    for (DrawnObservation& one : source_.observations()) all_.push_back(&one);
  }

  Result<void> written() {
    writer_.title(facts_.title);
    writer_.words(facts_.lines);
    using Step = Result<void> (Contents::*)();
    constexpr std::array<Step, 7> kSteps = {&Contents::add_overview,  &Contents::add_schools, &Contents::add_charts,
                                            &Contents::add_strongest, &Contents::add_effort,  &Contents::add_files,
                                            &Contents::add_notes};
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
      if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      if (auto added = (this->*kSteps[i])(); !added) return pass_on(added);
      work_.progress("report", static_cast<std::int64_t>(i) + 1, std::ssize(kSteps));
    }
    add_recipe();
    add_meaning();
    writer_.closing("Times are UTC, places WGS 84; an empty field is not known.");
    return {};
  }

 private:
  /// A picture that could not be made leaves a sentence in its place; only a stop is passed on.
  Result<void> add(const Result<FrameDescription>& frame, const std::string& caption) {
    if (!frame) {
      if (frame.error().code == ErrorCode::cancelled) return pass_on(frame);
      writer_.paragraph(caption + ": " + frame.error().text + ".");
      return {};
    }
    return writer_.picture(*frame, caption);
  }

  Result<void> add_overview() {
    writer_.heading("Where and when");
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
    writer_.heading("Schools");
    if (facts_.searched == 0) {
      writer_.paragraph("Schools were not detected: these are raw files without the results of a run.");
      return {};
    }
    std::vector<SchoolRow> rows;
    for (const DrawnObservation* one : all_) {
      rows.insert(rows.end(), one->product().schools.begin(), one->product().schools.end());
    }
    if (rows.empty()) {
      writer_.paragraph("No school was found.");
      return {};
    }
    return add_table(
        table_of(rows, "schools.csv"),
        "Every school; uncertainties stand in columns of their own: se = standard error. Figures have five "
        "digits here, and all of them in schools.csv.");
  }

  Result<void> add_charts() {
    if (facts_.schools.empty()) return {};
    writer_.heading("Charts");
    writer_.begin_pair();
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
    writer_.end_pair();
    return {};
  }

  Result<void> add_strongest() {
    if (facts_.schools.empty()) return {};
    writer_.heading("The strongest schools");
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
    writer_.subheading(school.name);
    writer_.begin_pair();
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
    writer_.end_pair();
    if (!added) return added;
    std::vector<SchoolPingRow> rows = observation.product().school_pings;
    std::erase_if(rows, [&](const SchoolPingRow& row) { return !of_school(row); });
    return add_table(
        table_of(rows, "school_pings.csv"),
        fmt::format("{} in each of its pings; those of all schools are in school_pings.csv.", school.name));
  }

  Result<void> add_table(const Result<CsvTable>& table, const std::string& caption) {
    if (!table) return pass_on(table);
    for (const std::string& name : table->header) columns_.insert(name);
    writer_.table(*table, caption, kMostRows);
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
    writer_.heading("Echo integration and effort");
    bool any = false;
    for (const fs::path& path : paths_) {
      for (const Table& table : kTables) {
        std::error_code absent;
        if (!fs::is_regular_file(path / table.file, absent)) continue;
        any = true;
        if (auto added = add_table(read_csv(path / table.file), table.caption); !added) return added;
      }
    }
    if (!any) writer_.paragraph("Not integrated: \"sonarx integrate\" puts its tables beside the products.");
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
    writer_.heading("Observations and raw files");
    writer_.table(table, "What the observations were made from.", kMostRows);
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
    writer_.heading("What was noted");
    if (table.records.empty()) {
      writer_.paragraph("Nothing was wrong with the data.");
    } else {
      writer_.table(table, "Bad and doubtful data.", kMostNotes);
    }
    return {};
  }

  void add_recipe() {
    writer_.heading("Recipe");
    writer_.plain_text(recipe_text(source_.recipe()));
  }

  void add_meaning() {
    if (columns_.empty()) return;
    writer_.heading("What the columns are");
    NamedWords meanings;
    for (const std::string& column : columns_) {
      const ColumnWords* words = words_of(column);
      if (words == nullptr) continue;
      meanings.emplace_back(column, std::string(words->long_name));
    }
    writer_.words(meanings);
  }

  ReportWriter& writer_;
  PictureSource& source_;
  std::span<const fs::path> paths_;
  PictureOptions options_;
  Work& work_;
  ReportFacts facts_;
  std::vector<DrawnObservation*> all_;
  std::set<std::string> columns_;  ///< of the tables shown
};

}  // namespace

Result<void> write_report(ReportWriter& writer, PictureSource& source, std::span<const fs::path> paths,
                          const PictureOptions& options, Work& work) {
  if (auto valid = validate_options(options); !valid) return pass_on(valid);
  return Contents(writer, source, paths, options, work).written();
}

}  // namespace sonar
