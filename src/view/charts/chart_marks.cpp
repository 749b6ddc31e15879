// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "model/school_totals.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr int kFaint = 60;  ///< alpha of what is not selected, where something is
constexpr double kRadius_em = 0.3;
constexpr double kLeastRadius_em = 0.11;
constexpr double kFewRows = 200.0;  ///< more are drawn smaller

PathItem disc(PixelPoint centre, double radius_px, Rgba8 fill, Stroke stroke) {
  const int corners = radius_px < 3.0 ? 8 : 16;
  PathItem item;
  item.fill = fill;
  item.stroke = std::move(stroke);
  PathItem::Part part;
  part.closed = true;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / corners;
    part.points.push_back({centre.x + radius_px * std::cos(angle), centre.y + radius_px * std::sin(angle)});
  }
  item.parts.push_back(std::move(part));
  return item;
}

double radius_px(std::size_t rows, const Theme& theme) {
  const double share = std::min(1.0, std::pow(kFewRows / std::max(1.0, static_cast<double>(rows)), 0.25));
  return theme.text_px * std::max(kLeastRadius_em, kRadius_em * share);
}

PathItem mark(PixelPoint at, double radius, Rgba8 colour, bool hollow, const Theme& theme) {
  if (hollow) return disc(at, radius, {0, 0, 0, 0}, {colour, 1.2 * theme.line_px, {}});
  // Of some colours the rim is all that stands out from the plot.
  return disc(at, radius, colour, {theme.axis, 0.6 * theme.line_px, {}});
}

/// Points that no eye tells apart have one name.
std::uint64_t name_of_place(PixelPoint at, Rgba8 colour) {
  const auto half_px = [](double v) { return static_cast<std::uint64_t>(std::llround(2.0 * v)) & 0xFFFFU; };
  const std::uint64_t rgba =
      (std::uint64_t{colour.r} << 24U) | (std::uint64_t{colour.g} << 16U) | (std::uint64_t{colour.b} << 8U) | colour.a;
  return (half_px(at.x) << 48U) | (half_px(at.y) << 32U) | rgba;
}

PixelPoint place_of(const ChartPlaces& places, const ChartData& data, std::size_t row) {
  return places.plot.at(data.x_values[row], data.y_values[row]);
}

/// One path a colour: lines of one school hang together.
void add_lines(FrameDescription& frame, const ChartPlaces& places, const ChartData& data, const ChartLooks& looks,
               const Theme& theme) {
  PathItem lines;
  const auto finish = [&] {
    if (!lines.parts.empty()) frame.items.emplace_back(std::move(lines));
    lines = {};
  };
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    if (!joins_previous(data, row)) continue;
    const bool goes_on = row > 1 && joins_previous(data, row - 1) && !lines.parts.empty();
    if (!goes_on) {
      if (row > 0 && (lines.parts.empty() || lines.stroke.colour != looks.colour(row))) finish();
      lines.stroke = {looks.colour(row), theme.line_px, {}};
      lines.parts.push_back({{place_of(places, data, row - 1)}, false});
    }
    lines.parts.back().points.push_back(place_of(places, data, row));
  }
  finish();
}

}  // namespace

ChartLooks::ChartLooks(const ChartData& data, const ChartStyle& style, const Theme& theme)
    : data_(data), style_(style), theme_(theme) {
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    if (!data.known(row)) continue;
    const ChartRow& one = data.rows[row];
    if (schools_.empty() || schools_.back().name != one.school) schools_.push_back({one.school, one.rejected});
  }
  make_parts();
}

bool ChartLooks::selected(std::size_t row) const { return style_.selected.contains(data_.rows[row].school); }

Rgba8 ChartLooks::own_colour(const School& school) const {
  return school.rejected ? theme_.muted : school_colour(static_cast<int>(school.name.number));
}

Rgba8 ChartLooks::colour(std::size_t row) const {
  const Rgba8 own = own_colour({data_.rows[row].school, data_.rows[row].rejected});
  return style_.selected.empty() || selected(row) ? own : with_alpha(own, kFaint);
}

/// Each school that has a name in the key has a part of its own; else the selected, the others and the rejected have one
/// each.
void ChartLooks::make_parts() {
  const bool each = schools_.size() <= kNamedSchools;
  const auto chosen = [&](const ChartSchool& school) { return style_.selected.contains(school); };
  std::map<ChartSchool, std::size_t> part_of;
  const auto faint = [&](Rgba8 colour, bool lit) {
    return style_.selected.empty() || lit ? colour : with_alpha(colour, kFaint);
  };
  for (int turn = 0; turn < 3; ++turn) {
    bool begun = false;
    for (const School& school : schools_) {
      const bool lit = chosen(school.name);
      const int wanted = lit ? 0 : school.rejected ? 2 : 1;
      if (wanted != turn) continue;
      if (!begun || each) {
        const Rgba8 shared = lit ? theme_.accent : school.rejected ? theme_.muted : theme_.track;
        const Rgba8 colour = faint(each ? own_colour(school) : shared, lit);
        const bool hollow = school.rejected && (each || !lit);
        parts_.push_back(hollow ? Part{{0, 0, 0, 0}, colour} : Part{colour, {0, 0, 0, 0}});
      }
      begun = true;
      part_of[school.name] = parts_.size() - 1;
    }
  }
  part_of_row_.assign(data_.rows.size(), 0);
  for (std::size_t row = 0; row < data_.rows.size(); ++row) {
    const auto found = part_of.find(data_.rows[row].school);
    if (found != part_of.end()) part_of_row_[row] = found->second;
  }
}

std::string ChartLooks::name_of(const School& school) const {
  const std::string status = school.rejected ? ", rejected" : "";
  if (data_.observations.size() == 1) return fmt::format("school {}{}", school.name.number, status);
  return school_name(data_.observations[school.name.observation], school.name.number) + status;
}

KeyEntry ChartLooks::entry(std::string text, Rgba8 colour, bool hollow) const {
  const bool square = !data_.y;
  return {std::move(text), [colour, hollow, square, theme = theme_](FrameDescription& frame, const PixelRect& swatch) {
            const PixelPoint middle{swatch.x + swatch.width / 2.0, swatch.y + swatch.height / 2.0};
            const double half = 0.32 * theme.text_px;
            const Rgba8 none{0, 0, 0, 0};
            if (!square) {
              frame.items.emplace_back(mark(middle, half, colour, hollow, theme));
              return;
            }
            const PixelRect box{middle.x - 1.6 * half, middle.y - half, 3.2 * half, 2.0 * half};
            frame.items.emplace_back(rectangle_item(box, hollow ? none : colour, hollow ? colour : none,
                                                    hollow ? 1.2 * theme.line_px : 0.0));
          }};
}

bool ChartLooks::any_rejected() const {
  return std::any_of(schools_.begin(), schools_.end(), [](const School& school) { return school.rejected; });
}

std::vector<KeyEntry> ChartLooks::key() const {
  if (schools_.size() > kNamedSchools) return short_key();
  std::vector<KeyEntry> entries;
  for (const School& school : schools_) {
    entries.push_back(entry(name_of(school), own_colour(school), school.rejected));
  }
  return entries;
}

std::vector<KeyEntry> ChartLooks::short_key() const {
  std::vector<KeyEntry> entries;
  const bool own = data_.y || schools_.size() <= kNamedSchools;
  if (own) {
    const auto first = std::find_if(schools_.begin(), schools_.end(), [](const School& s) { return !s.rejected; });
    if (first != schools_.end())
      entries.push_back(entry("colours tell the schools' numbers", own_colour(*first), false));
  } else if (!style_.selected.empty()) {
    entries.push_back(entry("selected", theme_.accent, false));
  }
  if (any_rejected()) entries.push_back(entry("rejected", theme_.muted, true));
  return entries;
}

bool joins_previous(const ChartData& data, std::size_t row) {
  if (row == 0 || !data.y || data.table != ChartTable::school_pings || !data.x.is_order()) return false;
  const ChartRow& before = data.rows[row - 1];
  const ChartRow& here = data.rows[row];
  return before.school == here.school && before.ping_index + 1 == here.ping_index && data.known(row - 1) &&
         data.known(row);
}

void add_points(FrameDescription& frame, const ChartPlaces& places, const ChartData& data, const ChartLooks& looks,
                const Theme& theme) {
  add_lines(frame, places, data, looks, theme);
  const double radius = radius_px(data.rows.size(), theme);
  std::unordered_set<std::uint64_t> drawn;
  // The selected come last: nothing lies on them.
  for (const bool last : {false, true}) {
    for (std::size_t row = 0; row < data.rows.size(); ++row) {
      if (!data.known(row) || looks.selected(row) != last) continue;
      const PixelPoint at = place_of(places, data, row);
      const Rgba8 colour = looks.colour(row);
      if (std::isnan(places.points[row].x) || !drawn.insert(name_of_place(at, colour)).second) continue;
      frame.items.emplace_back(mark(at, last ? 1.25 * radius : radius, colour, data.rows[row].rejected, theme));
    }
  }
}

void add_bars(FrameDescription& frame, ChartPlaces& places, const ChartData& data, const ChartBins& bins,
              const ChartLooks& looks, const Theme& theme) {
  std::vector<std::vector<std::size_t>> rows(bins.count());
  std::vector<std::vector<std::size_t>> counts(bins.count(), std::vector<std::size_t>(looks.parts().size()));
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    const std::size_t bin = bins.bin_of_row[row];
    if (bin == ChartBins::kNone) continue;
    rows[bin].push_back(row);
    ++counts[bin][looks.part_of_row(row)];
  }
  const PixelRect& plot = places.plot.place;
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    const double left = places.plot.at(bins.edges[bin], 0.0).x;
    const double right = places.plot.at(bins.edges[bin + 1], 0.0).x;
    if (rows[bin].empty() || right < plot.x || left > plot.x + plot.width) continue;
    const double gap = right - left > 4.0 ? theme.line_px / 2.0 : 0.0;
    double below = 0.0;
    for (std::size_t part = 0; part < counts[bin].size(); ++part) {
      if (counts[bin][part] == 0) continue;
      const double above = below + static_cast<double>(counts[bin][part]);
      const double top = places.plot.at(bins.edges[bin], above).y;
      const double height = places.plot.at(bins.edges[bin], below).y - top;
      const ChartLooks::Part& look = looks.parts()[part];
      const double inset = look.stroke.a > 0 ? gap + 0.5 * theme.line_px : gap;
      const PixelRect box{left + inset, top + (inset - gap), std::max(0.5, right - left - 2.0 * inset),
                          std::max(0.5, height - (inset - gap))};
      frame.items.emplace_back(rectangle_item(box, look.fill, look.stroke, look.stroke.a > 0 ? theme.line_px : 0.0));
      below = above;
    }
    const double top = places.plot.at(bins.edges[bin], below).y;
    places.bars.push_back({{left, top, right - left, places.plot.at(bins.edges[bin], 0.0).y - top},
                           bins.edges[bin],
                           bins.edges[bin + 1],
                           std::move(rows[bin])});
  }
}

}  // namespace sonar
