// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "view/school_look.h"
#include "view/slices/slice_key.h"
#include "view/timelines/timeline_strip.h"

namespace sonar {
namespace {

/// Pings that share a pixel make one column: what is drawn grows with the picture, not with the number of pings.
constexpr double kLeastColumn_px = 1.0;

/// Two lists of intervals as one, those that meet joined.
std::vector<std::pair<double, double>> united(std::vector<std::pair<double, double>> all) {
  std::sort(all.begin(), all.end());
  std::vector<std::pair<double, double>> out;
  for (const auto& one : all) {
    if (!out.empty() && one.first <= out.back().second) {
      out.back().second = std::max(out.back().second, one.second);
    } else {
      out.push_back(one);
    }
  }
  return out;
}

std::vector<OutlinedColumn> columns_of(const EchogramSchool& school, const Strip& strip, const PlotFrame& plot) {
  const std::vector<double>& x = strip.along.x;
  const double right = plot.place.x + plot.place.width;
  std::vector<OutlinedColumn> out;
  for (std::size_t i = 0; i < school.stretches.size();) {
    const std::size_t ping = school.stretches[i].ping;
    if (ping >= x.size()) break;
    OutlinedColumn column{plot.at(x[ping], 0.0).x, plot.at(filled_until(x, strip.along.gap, ping), 0.0).x, {}};
    for (; i < school.stretches.size() && school.stretches[i].ping == ping; ++i) {
      const EchogramStretch& s = school.stretches[i];
      column.stretches.emplace_back(plot.at(0.0, s.from_m).y, plot.at(0.0, s.to_m).y);
    }
    if (column.to < plot.place.x || column.from > right || !(column.to > column.from)) continue;
    OutlinedColumn* before = out.empty() || out.back().to != column.from ? nullptr : &out.back();
    if (before != nullptr && column.to - before->from < kLeastColumn_px) {
      before->to = column.to;
      before->stretches.insert(before->stretches.end(), column.stretches.begin(), column.stretches.end());
      before->stretches = united(std::move(before->stretches));
    } else {
      out.push_back(std::move(column));
    }
  }
  return out;
}

/// The pixels whose middle lies between two places, of so many.
struct PixelSpan {
  int first = 0;
  int end = 0;
};
PixelSpan pixels_between(double from_px, double to_px, int count) {
  const auto bound = [count](double px) { return static_cast<int>(std::clamp(std::ceil(px - 0.5), 0.0, 1.0 * count)); };
  return {bound(from_px), bound(to_px)};
}

}  // namespace

void add_shadow(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const Theme& theme) {
  if (strip.observation->shadow.empty()) return;
  const std::vector<double>& x = strip.along.x;
  const PixelRect& place = plot.place;
  const PixelSize size{std::max(1, static_cast<int>(std::ceil(place.width))),
                       std::max(1, static_cast<int>(std::ceil(place.height)))};
  auto image = std::make_shared<Image>(size, Rgba8{0, 0, 0, 0});
  for (const EchogramStretch& s : strip.observation->shadow) {
    if (s.ping >= x.size()) break;
    const PixelSpan columns =
        pixels_between(plot.at(x[s.ping], 0.0).x - place.x,
                       plot.at(filled_until(x, strip.along.gap, s.ping), 0.0).x - place.x, size.width);
    const PixelSpan lines =
        pixels_between(plot.at(0.0, s.from_m).y - place.y, plot.at(0.0, s.to_m).y - place.y, size.height);
    for (int j = lines.first; j < lines.end; ++j) {
      for (int i = columns.first; i < columns.end; ++i) {
        if (on_hatch(i, size.height - 1 - j, theme)) image->at(i, j) = theme.hatch;
      }
    }
  }
  frame.items.emplace_back(ImageItem{{place.x, place.y, 1.0 * size.width, 1.0 * size.height}, std::move(image), false});
}

void add_outlines(FrameDescription& frame, const Strip& strip, const PlotFrame& plot, const TimelineStyle& style,
                  const Theme& theme, std::vector<TrackNumber>& numbers) {
  for (const EchogramSchool& school : strip.observation->schools) {
    const std::vector<OutlinedColumn> columns = columns_of(school, strip, plot);
    if (columns.empty()) continue;
    const bool selected = strip.observation->selected == school.school_id;
    const Rgba8 colour = timeline_colour(school.school_id, school.status, style, theme);
    const std::vector<PathItem::Part> rings = outline_of_columns(columns);
    const double wide = 1.6 + (selected ? 1.2 : 0.0);
    for (const auto& [line, width] : {std::pair(theme.halo, wide + 1.6), std::pair(colour, wide)}) {
      PathItem item;
      item.parts = rings;
      item.stroke = {line, width * theme.line_px,
                     width > wide ? std::vector<double>{} : status_dashes(school.status, theme)};
      frame.items.emplace_back(std::move(item));
    }
    TrackNumber number{fmt::format("{}", school.school_id), selected, {}};
    for (const OutlinedColumn& column : columns) {
      // Zoomed, a school may begin above or beside what is seen of it.
      const double middle = (column.from + column.to) / 2.0;
      const double x = std::clamp(middle, plot.place.x, plot.place.x + plot.place.width);
      for (const auto& [from, to] : column.stretches) {
        const PixelPoint top{x, std::max(from, plot.place.y)};
        if (to < plot.place.y || !inside(plot.place, top)) continue;
        number.seen.push_back(top);
        break;
      }
    }
    if (!number.seen.empty()) numbers.push_back(std::move(number));
  }
}

}  // namespace sonar
