// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/strongest_ping.h"
#include "publish/maps/map_pictures.h"
#include "publish/reports/report_facts.h"
#include "publish/reports/report_table.h"
#include "publish/volumes/volume_picture.h"
#include "view/composed_figure.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

// A4 upright at 96 pixels an inch, as FrameDescription has it.
constexpr PixelSize kPaper{794, 1123};
constexpr double kMargin = 40.0;
constexpr double kWidth = kPaper.width - 2.0 * kMargin;
constexpr double kMap_px = 320.0;
constexpr double kTimeline_px = 178.0;
constexpr double kBottom_px = 196.0;  ///< counts, depths, the strongest school
constexpr double kFoot_px = 62.0;
constexpr double kGap = 10.0;

constexpr const char* kMeaning =
    "No.: number in the survey. School: observation and number in it. A school that several rows tell of counts once, "
    "and its "
    "place, depth, length and Sv are those of the row with most pings. Depth: of the centre of gravity, below the sea "
    "surface. "
    "Length: of the mask, along its longer horizontal axis. Sv: mean volume backscattering strength in the mask, dB re "
    "1 "
    "m\u207B\u00B9. Backscatter: total backscattering cross-section, the sum of sv times volume, m\u00B2, without "
    "4\u03C0. Rejected "
    "schools are not counted. Times are UTC, places WGS 84.";

constexpr const char* kErrorMeaning =
    " \u00B1: one standard error, as the run told it; that of backscatter is by fading alone.";

/// A picture that could not be made leaves a line in its place; only a stop is passed on.
Result<void> place_or_say(FrameDescription& page, const Result<FrameDescription>& picture, const PixelRect& place,
                          const Theme& theme) {
  if (picture) {
    place_frame(page, *picture, place);
    return {};
  }
  if (picture.error().code == ErrorCode::cancelled) return pass_on(picture);
  page.items.emplace_back(rectangle_item(place, {0, 0, 0, 0}, theme.grid, 0.7));
  page.items.emplace_back(text_item({place.x + place.width / 2.0, place.y + place.height / 2.0},
                                    elided(picture.error().text, kReportText_px, place.width - 2.0 * kGap),
                                    kReportText_px, theme.muted, TextAnchor::centre));
  return {};
}

/// So many pixels for a place that its text is small on the page, but not too small to be read.
PixelSize drawn_size(const PixelRect& place, double times) {
  return {static_cast<int>(times * place.width), static_cast<int>(times * place.height)};
}

class Page {
 public:
  Page(PictureSource& source, const PictureOptions& options, Work& work)
      : source_(source), options_(options), work_(work), facts_(report_facts(source.observations(), source.recipe())) {
    options_.size = kPaper;
    options_.limits_given = false;
    theme_ = theme_of(options_);
    theme_.text_px = kReportText_px;
    page_.size = kPaper;
    page_.background = theme_.background;
    page_.title = "Report: " + facts_.title;
  }

  Result<FrameDescription> made() {
    add_head();
    const bool timeline = source_.has_raw();
    const double rest = kPaper.height - kMargin - kFoot_px - y_ - kMap_px - kBottom_px - 3.0 * kGap -
                        (timeline ? kTimeline_px + kGap : 0.0);
    // What few schools leave free makes the map larger; the table ends where they do.
    const double table = std::min(rest, kReportRow_px * (static_cast<double>(facts_.schools.size()) + 2.0));
    if (auto added = add_map(kMap_px + rest - table); !added) return pass_on(added);
    if (timeline) {
      if (auto added = add_timeline(); !added) return pass_on(added);
    }
    add_table(table);
    if (auto added = add_bottom(); !added) return pass_on(added);
    add_foot();
    return std::move(page_);
  }

 private:
  /// However long it is, that the data is synthetic stays.
  [[nodiscard]] std::string whole_or_short(double size_px) const {
    constexpr std::string_view kSynthetic = "SYNTHETIC";
    const std::string shown = elided(facts_.title, size_px, kWidth - 90.0);
    const bool lost = facts_.title.find(kSynthetic) != std::string::npos && shown.find(kSynthetic) == std::string::npos;
    return lost ? elided(std::string(kSynthetic) + " " + facts_.title, size_px, kWidth - 90.0) : shown;
  }

  void add_head() {
    constexpr double kTitle_px = 19.0;
    const double right = kMargin + kWidth;
    TextItem mark = text_item({right, kMargin + 0.5 * kTitle_px}, "survey report", kReportText_px + 1.0, theme_.muted,
                              TextAnchor::right);
    double size = kTitle_px;
    while (size > 11.0 && text_width_px(facts_.title.c_str(), 1.1 * size) > kWidth - 90.0) size -= 1.0;
    TextItem title = text_item({kMargin, kMargin + 0.5 * kTitle_px}, whole_or_short(1.1 * size), size, theme_.text);
    title.bold = true;
    page_.items.emplace_back(std::move(title));
    page_.items.emplace_back(std::move(mark));
    y_ = kMargin + kTitle_px + 7.0;
    page_.items.emplace_back(line_item({kMargin, y_}, {right, y_}, theme_.axis, 1.0));
    y_ += 6.0;
    const double height = report_lines_height(facts_.lines.size());
    add_report_lines(page_, {kMargin, y_, kWidth, height}, facts_.lines, theme_);
    y_ += height + kGap;
  }

  Result<void> add_map(double height) {
    const PixelRect place{kMargin, y_, kWidth, height};
    y_ += height + kGap;
    PictureOptions options = options_;
    options.size = drawn_size(place, 1.45);
    return place_or_say(page_, survey_map_frame(source_.observations(), options, work_), place, theme_);
  }

  Result<void> add_timeline() {
    const PixelRect place{kMargin, y_, kWidth, kTimeline_px};
    y_ += kTimeline_px + kGap;
    PictureOptions options = options_;
    options.size = drawn_size(place, 1.25);
    std::vector<DrawnObservation*> drawn;
    for (DrawnObservation& one : source_.observations()) drawn.push_back(&one);
    return place_or_say(page_, timeline_frame(drawn, options, work_), place, theme_);
  }

  void add_table(double height) {
    const PixelRect place{kMargin, y_, kWidth, height};
    y_ += height + kGap;
    if (!facts_.schools.empty()) return add_report_table(page_, place, facts_.schools, theme_);
    std::string words = "No school was found.";
    if (facts_.searched == 0) words = "Schools were not detected: these are raw files without the results of a run.";
    if (facts_.searched > 0 && facts_.rejected > 0) words = "No school is left: all that were found are rejected.";
    page_.items.emplace_back(text_item({kMargin, place.y + 0.5 * kReportRow_px}, words, kReportText_px, theme_.text));
  }

  /// The strongest school in its strongest ping, where raw files are there.
  Result<void> add_bottom() {
    if (facts_.schools.empty()) return {};
    const ReportSchool& school = facts_.schools.front();
    DrawnObservation& observation = source_.observations()[school.observation];
    const SchoolPingRow* ping =
        strongest_ping(observation.product(), [&](const SchoolRow& row) { return row.school_id == school.school_id; });
    const bool picture = observation.engine() != nullptr && ping != nullptr;
    constexpr double kCounts = 0.24;
    const double depths = (picture ? 0.34 : 1.0 - kCounts) * kWidth;
    const double left = kMargin + kCounts * kWidth;
    add_report_counts(page_, {kMargin, y_, kCounts * kWidth - kGap, kBottom_px}, facts_, theme_);
    add_report_depths(page_, {left, y_, depths - kGap, kBottom_px}, facts_.schools, theme_);
    if (!picture) return {};
    const PixelRect place{left + depths, y_, kMargin + kWidth - left - depths, kBottom_px};
    PictureOptions options = options_;
    options.size = drawn_size(place, 1.6);
    options.scale = 2.0;  // rays, not pixels: print is finer than a screen
    options.ping = static_cast<int>(ping->ping_index);
    options.schools.clear();
    options.depth_raster.clear();
    const auto volume = volume_frame(observation, options, work_);
    observation.engine()->rest();
    return place_or_say(page_, volume, place, theme_);
  }

  void add_foot() {
    double y = kPaper.height - kMargin - kFoot_px + kReportRow_px;
    page_.items.emplace_back(
        line_item({kMargin, y - kReportRow_px}, {kMargin + kWidth, y - kReportRow_px}, theme_.axis, 0.7));
    constexpr double kSmall = kReportText_px - 1.0;
    const std::string meaning = kMeaning + std::string(has_errors(facts_.schools) ? kErrorMeaning : "");
    for (const std::string& line : wrapped(meaning, kWidth, kSmall)) {
      page_.items.emplace_back(text_item({kMargin, y - 4.0}, line, kSmall, theme_.muted));
      y += 1.45 * kSmall;
    }
  }

  PictureSource& source_;
  PictureOptions options_;
  Work& work_;
  ReportFacts facts_;
  Theme theme_;
  FrameDescription page_;
  double y_ = 0.0;
};

}  // namespace

Result<FrameDescription> report_page(PictureSource& source, const PictureOptions& options, Work& work) {
  return Page(source, options, work).made();
}

}  // namespace sonar
