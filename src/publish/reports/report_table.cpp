// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "view/axes.h"
#include "view/maps/graticule.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

struct Column {
  const char* head;
  double width;  ///< share of the table's
  double wider;  ///< by so much where figures have errors
  bool number;
  bool length = false;  ///< its unit stands behind its head
};
constexpr std::array<Column, 12> kColumns{{{"No.", 0.04, 0.0, true},
                                           {"School", 0.105, -0.003, false},
                                           {"First seen (UTC)", 0.128, -0.008, false},
                                           {"Latitude", 0.092, 0.0, false},
                                           {"Longitude", 0.098, 0.0, false},
                                           {"Depth", 0.064, 0.016, true, true},
                                           {"Length", 0.072, 0.008, true, true},
                                           {"Sv dB", 0.058, 0.014, true},
                                           {"Backsc. m\u00B2", 0.092, 0.026, true},
                                           {"Pings", 0.05, -0.005, true},
                                           {"Status", 0.091, -0.008, false},
                                           {"Species", 0.11, -0.04, false}}};

/// Not known = a dash.
std::string decimals(double value, int digits) {
  return std::isfinite(value) ? tick_text(value, digits) : std::string("\u2013");
}

/// With its standard error behind it where there is one, which needs a decimal.
std::string with_error(double value, double se, int digits) {
  if (!std::isfinite(value) || !std::isfinite(se)) return decimals(value, digits);
  return fmt::format("{} \u00B1 {}", tick_text(value, 1), tick_text(se, 1));
}

/// Three digits that count, and as many decimals of the standard error.
std::string three_digits(double value, double se) {
  if (!std::isfinite(value)) return "\u2013";
  const bool known = std::isfinite(se);
  const bool plain = value >= 0.001 && value < 1e6;
  if (!plain && (!known || !(value > 0.0))) return fmt::format("{:.2e}", value);
  const int power = static_cast<int>(std::floor(std::log10(value)));
  const double unit = plain ? 1.0 : std::pow(10.0, power);
  const int digits = plain ? std::max(0, 2 - power) : 2;
  if (!known) return fmt::format("{:.{}f}", value, digits);
  const std::string both = fmt::format("{:.{}f} \u00B1 {:.{}f}", value / unit, digits, se / unit, digits);
  return plain ? both : fmt::format("({})e{:+03}", both, power);
}

std::array<std::string, kColumns.size()> cells(const ReportSchool& s, const Unit& length) {
  constexpr double kStep_deg = 1.0 / 3600.0;
  const bool placed = std::isfinite(s.latitude) && std::isfinite(s.longitude);
  return {s.survey_school > 0 ? fmt::format("{}", s.survey_school) : std::string("\u2013"),
          s.name,
          clock_text(s.first_time, false),
          placed ? latitude_text(s.latitude, kStep_deg) : "\u2013",
          placed ? longitude_text(s.longitude, kStep_deg) : "\u2013",
          with_error(length.of(s.depth_m), length.of(s.depth_se_m), 1),
          with_error(length.of(s.length_m), length.of(s.length_se_m), 0),
          with_error(s.sv_mean_db, s.sv_mean_se_db, 1),
          three_digits(s.backscatter_m2, s.backscatter_se_m2),
          fmt::format("{}", s.pings),
          s.status,
          s.species};
}

/// Words without room are shortened.
void add_cell(FrameDescription& page, double left, double width, double y, const std::string& words, bool number,
              Rgba8 colour) {
  constexpr double kGap = 5.0;
  constexpr double kLeast = 1.5;  // between a number and what stands left of it
  page.items.emplace_back(text_item({number ? left + width - kGap : left, y},
                                    elided(words, kReportText_px, width - (number ? kLeast : kGap)), kReportText_px,
                                    colour, number ? TextAnchor::right : TextAnchor::left));
}

}  // namespace

std::size_t report_rows(double height_px) {
  return height_px < 2.0 * kReportRow_px ? 0 : static_cast<std::size_t>(height_px / kReportRow_px) - 1;
}

bool has_errors(std::span<const ReportSchool> schools) {
  return std::ranges::any_of(schools, [](const ReportSchool& s) {
    return std::isfinite(s.depth_se_m) || std::isfinite(s.length_se_m) || std::isfinite(s.sv_mean_se_db) ||
           std::isfinite(s.backscatter_se_m2);
  });
}

void add_report_table(FrameDescription& page, const PixelRect& place, std::span<const ReportSchool> schools,
                      const Theme& theme) {
  double y = place.y + 0.5 * kReportRow_px;
  const double wider = has_errors(schools) ? 1.0 : 0.0;
  const auto row = [&](const auto& words, Rgba8 colour) {
    double left = place.x;
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const double width = (kColumns[i].width + wider * kColumns[i].wider) * place.width;
      add_cell(page, left, width, y, words[i], kColumns[i].number, colour);
      left += width;
    }
    y += kReportRow_px;
  };
  std::array<std::string, kColumns.size()> heads;
  const Unit length = theme.units.length();
  std::ranges::transform(kColumns, heads.begin(), [&length](const Column& column) {
    return column.length ? fmt::format("{} {}", column.head, length.name) : std::string(column.head);
  });
  row(heads, theme.muted);
  const double under = place.y + kReportRow_px - 0.5;
  page.items.emplace_back(line_item({place.x, under}, {place.x + place.width, under}, theme.axis, 0.7));
  const std::size_t room = report_rows(place.height);
  const bool all = schools.size() <= room;
  for (const ReportSchool& school : schools.first(all ? schools.size() : room - 1))
    row(cells(school, length), theme.text);
  if (all) return;
  page.items.emplace_back(
      text_item({place.x, y}, fmt::format("and {} that are weaker", count_of(schools.size() - (room - 1), "school")),
                kReportText_px, theme.muted));
}

double report_lines_height(std::size_t lines) { return kReportRow_px * static_cast<double>((lines + 1) / 2); }

void add_report_lines(FrameDescription& page, const PixelRect& place,
                      std::span<const std::pair<std::string, std::string>> lines, const Theme& theme) {
  const std::size_t half = (lines.size() + 1) / 2;
  constexpr double kLeftShare = 0.56;
  constexpr double kName_px = 76.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool left = i < half;
    const double x = place.x + (left ? 0.0 : kLeftShare * place.width);
    const double width = (left ? kLeftShare : 1.0 - kLeftShare) * place.width;
    const double y = place.y + kReportRow_px * (static_cast<double>(left ? i : i - half) + 0.5);
    add_cell(page, x, kName_px, y, lines[i].first, false, theme.muted);
    add_cell(page, x + kName_px, width - kName_px, y, lines[i].second, false, theme.text);
  }
}

void add_report_counts(FrameDescription& page, const PixelRect& place, const ReportFacts& facts, const Theme& theme) {
  const double last = place.y + place.height - 0.5 * kReportRow_px;
  double y = place.y + 0.5 * kReportRow_px;
  constexpr double kNumber_px = 44.0;
  const auto line = [&](const std::string& name, const std::string& value, bool head) {
    if (y > last) return;
    add_cell(page, place.x, place.width - kNumber_px, y, name, false, head ? theme.muted : theme.text);
    add_cell(page, place.x + place.width - kNumber_px, kNumber_px, y, value, true, theme.text);
    y += kReportRow_px;
  };
  line("Schools by status", "", true);
  for (const auto& [status, count] : facts.by_status) line(status, fmt::format("{}", count), false);
  if (facts.rejected > 0) line("rejected, not counted", fmt::format("{}", facts.rejected), false);
  y += 0.5 * kReportRow_px;
  line("Schools by species", "", true);
  if (facts.by_species.empty()) line("none is named", "", false);
  for (const auto& [species, count] : facts.by_species) line(species, fmt::format("{}", count), false);
}

void add_report_depths(FrameDescription& page, const PixelRect& place, std::span<const ReportSchool> schools,
                       const Theme& theme) {
  double deepest = 0.0;
  for (const ReportSchool& school : schools) {
    if (std::isfinite(school.depth_m)) deepest = std::max(deepest, school.depth_m);
  }
  if (!(deepest > 0.0)) return;
  // About ten bars, each a round number of the unit of lengths.
  const Unit unit = theme.units.length();
  const double step = nice_ticks(0.0, unit.of(deepest), 12).step * unit.si;
  std::vector<int> bins(static_cast<std::size_t>(std::floor(deepest / step)) + 1);
  for (const ReportSchool& school : schools) {
    if (std::isfinite(school.depth_m) && school.depth_m >= 0.0) ++bins[static_cast<std::size_t>(school.depth_m / step)];
  }
  const int most = std::max(4, *std::ranges::max_element(bins));
  PlotFrame plot;
  const double em = theme.text_px;
  plot.place = {place.x + 4.0 * em, place.y + 1.2 * em, place.width - 5.0 * em, place.height - 4.4 * em};
  plot.x = {0.0, 1.05 * most, "schools", false};
  plot.y = length_axis(0.0, step * static_cast<double>(bins.size()), "depth", theme);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (bins[i] == 0) continue;
    const PixelPoint from = plot.at(0.0, step * (static_cast<double>(i) + 0.1));
    const PixelPoint to = plot.at(bins[i], step * (static_cast<double>(i) + 0.9));
    page.items.emplace_back(rectangle_item({from.x, from.y, to.x - from.x, to.y - from.y}, school_colour(1)));
  }
  add_axes(page, plot, theme, {.grid = false, .minor = false});
}

}  // namespace sonar
