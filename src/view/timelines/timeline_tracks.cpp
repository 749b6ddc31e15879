// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "view/label_room.h"
#include "view/refused_marks.h"
#include "view/school_look.h"
#include "view/shapes.h"
#include "view/slices/slice_key.h"
#include "view/timelines/timeline_strip.h"

namespace sonar {

Rgba8 timeline_colour(std::int64_t school_id, const std::string& status, const TimelineStyle& style,
                      const Theme& theme) {
  if (!style.by_school || status == "rejected") return status_colour(status, theme);
  return school_colour(static_cast<int>(school_id));
}

void add_tracks(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const TimelineStyle& style,
                const Theme& theme, std::vector<TrackNumber>& numbers) {
  const ObservationProduct& product = *strip.observation->product;
  for (const SchoolRow& school : product.schools) {
    std::vector<PathItem::Part> parts;
    std::size_t last = 0;
    for (const SchoolPingRow& row : product.school_pings) {
      const auto i = static_cast<std::size_t>(std::max<std::int64_t>(0, row.ping_index));
      if (row.school_id != school.school_id || row.ping_index < 0 || i >= strip.along.x.size()) continue;
      if (!std::isfinite(row.range_m)) continue;
      if (parts.empty() || strip.along.gap_between(last, i)) parts.emplace_back();
      parts.back().points.push_back(plot.at(strip.along.x[i], row.range_m));
      last = i;
    }
    if (parts.empty()) continue;
    const bool selected = strip.observation->selected == school.school_id;
    const Rgba8 colour = timeline_colour(school.school_id, school.status, style, theme);
    std::vector<PixelPoint> points;
    for (PathItem::Part& part : parts) {
      points.insert(points.end(), part.points.begin(), part.points.end());
      if (part.points.size() == 1) part.points.push_back({part.points[0].x + 1.0, part.points[0].y});
    }
    // A dark line below a bright one is seen on every colour.
    const double wide = (style.by_school ? 3.0 : 1.8) + (selected ? 1.5 : 0.0);
    for (const auto& [line, width] : {std::pair(theme.halo, wide + 1.8), std::pair(colour, wide)}) {
      PathItem item;
      item.parts = parts;
      item.stroke = {line, width * theme.line_px,
                     width > wide ? std::vector<double>{} : status_dashes(school.status, theme)};
      frame.items.emplace_back(std::move(item));
    }
    TrackNumber number{fmt::format("{}", school.school_id), selected, {}};
    std::copy_if(points.begin(), points.end(), std::back_inserter(number.seen), [&](const PixelPoint& p) {
      return p.x >= plot.place.x - 0.5 && p.x <= plot.place.x + plot.place.width + 0.5;
    });
    if (!number.seen.empty()) numbers.push_back(std::move(number));
  }
}

void add_track_numbers(FrameDescription& frame, std::span<const TrackNumber> numbers, const PlotFrame& plot,
                       const Theme& theme) {
  const double em = theme.text_px;
  LabelRoom room(plot.place);
  // The selected school's number is the first to find room.
  for (const bool selected : {true, false}) {
    for (const TrackNumber& number : numbers) {
      if (number.selected != selected) continue;
      TextItem item = text_item({}, number.text, small_text_px(theme, 0.85), selected ? theme.accent : theme.text,
                                TextAnchor::left);
      item.bold = true;
      item.halo = theme.halo;
      const double width = text_width_px(item.text.c_str(), item.size_px);
      std::vector<PixelPoint> where;
      for (const PixelPoint& p : {number.seen.front(), number.seen.back(), number.seen[number.seen.size() / 2]}) {
        where.push_back({p.x, p.y - 0.9 * em});
        where.push_back({p.x, p.y + 0.9 * em});
        where.push_back({p.x - width - 0.5 * em, p.y});
        where.push_back({p.x + 0.5 * em, p.y});
      }
      item.at = where.front();
      auto placed = room.place(item, where);
      if (!placed && selected) placed = room.force(std::move(item));
      if (placed) frame.items.emplace_back(std::move(*placed));
    }
  }
}

namespace {

/// Dashes of the status names in the order of the key.
constexpr std::array<const char*, 4> kStatuses{"accepted", "corrected", "unreviewed", "rejected"};

KeyEntry hatched(std::string text, Rgba8 fill, double slope, const Theme& theme) {
  return {std::move(text), [=](FrameDescription& frame, const PixelRect& at) {
            frame.items.emplace_back(rectangle_item(at, fill, theme.axis, 0.5 * theme.line_px));
            frame.items.emplace_back(hatch_item(at, slope, theme));
          }};
}

}  // namespace

std::vector<KeyEntry> timeline_key(std::span<const Strip> strips, const TimelineStyle& style, const Theme& theme) {
  std::vector<KeyEntry> out;
  for (const char* status : kStatuses) {
    const auto of_status = [status](const auto& row) { return row.status == status; };
    const bool there = style.schools && std::any_of(strips.begin(), strips.end(), [&](const Strip& s) {
                         const TimelineObservation& o = *s.observation;
                         if (style.outlined) return std::any_of(o.schools.begin(), o.schools.end(), of_status);
                         return std::any_of(o.product->schools.begin(), o.product->schools.end(), of_status);
                       });
    if (!there) continue;
    SchoolRow row;
    row.status = status;
    // With a colour for each school any of them may be meant.
    const bool own = style.by_school && row.status != "rejected";
    const Rgba8 colour = own ? theme.text : status_colour(status, theme);
    const char* what = style.outlined ? "school" : "track of a school";
    out.push_back({fmt::format("{}, {}", what, status), [colour, dashes = status_dashes(status, theme), theme](
                                                            FrameDescription& frame, const PixelRect& at) {
                     const double y = at.y + 0.5 * at.height;
                     PathItem line = line_item({at.x, y}, {at.x + at.width, y}, colour, 1.8 * theme.line_px);
                     line.stroke.dashes_px = dashes;
                     frame.items.emplace_back(std::move(line));
                   }});
  }
  const auto lined = std::ranges::find_if(strips, [](const Strip& s) { return !s.observation->line.empty(); });
  if (lined != strips.end()) {
    out.push_back(
        {lined->observation->line_name, [theme](FrameDescription& frame, const PixelRect& at) {
           const double y = at.y + 0.5 * at.height;
           frame.items.emplace_back(line_item({at.x, y}, {at.x + at.width, y}, theme.accent, 2.0 * theme.line_px));
         }});
  }
  if (std::any_of(strips.begin(), strips.end(), [](const Strip& s) { return !s.observation->refused.empty(); })) {
    out.push_back(refused_key(theme));
  }
  if (std::any_of(strips.begin(), strips.end(), [](const Strip& s) { return !s.observation->shadow.empty(); })) {
    out.push_back(shadow_key(theme));
  }
  if (std::any_of(strips.begin(), strips.end(), any_silent)) {
    out.push_back(hatched("ping without data", theme.no_data, 1.0, theme));
  }
  if (std::any_of(strips.begin(), strips.end(), [](const Strip& s) { return !s.observation->bad.empty(); })) {
    out.push_back(hatched("ping not used", with_alpha(theme.no_data, 190), -1.0, theme));
  }
  return out;
}

}  // namespace sonar
