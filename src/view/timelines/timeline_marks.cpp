// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "view/refused_marks.h"
#include "view/shapes.h"
#include "view/timelines/timeline_strip.h"

namespace sonar {
namespace {

/// Where a time of an observation lies along x: between its pings as the pings lie.
double x_of(const Strip& s, TimeNs time) {
  const auto& pings = s.observation->product->pings;
  const auto after =
      std::lower_bound(pings.begin(), pings.end(), time, [](const PingNavigation& n, TimeNs t) { return n.time < t; });
  const auto i = static_cast<std::size_t>(after - pings.begin());
  if (i == 0) return s.along.x.front();
  if (i == pings.size()) return s.span().last;
  const auto step = static_cast<double>(pings[i].time - pings[i - 1].time);
  const double part = step > 0.0 ? static_cast<double>(time - pings[i - 1].time) / step : 0.0;
  return s.along.x[i - 1] + part * (s.along.x[i] - s.along.x[i - 1]);
}

}  // namespace

/// Bad pings are shaded from their own time up to the next ping's.
void add_bad(FrameDescription& frame, const Strip& s, const PlotFrame& plot, const Theme& theme) {
  const auto& pings = s.observation->product->pings;
  for (const TimelineInterval& bad : s.observation->bad) {
    const auto after = std::upper_bound(pings.begin(), pings.end(), bad.last,
                                        [](TimeNs t, const PingNavigation& n) { return t < n.time; });
    const double end =
        after == pings.end() ? s.span().last : s.along.x[static_cast<std::size_t>(after - pings.begin())];
    const double from = plot.at(x_of(s, bad.first), 0.0).x;
    const double to = std::max(from + 2.0, plot.at(end, 0.0).x);
    frame.items.emplace_back(
        rectangle_item({from, plot.place.y, to - from, plot.place.height}, with_alpha(theme.no_data, 190)));
    frame.items.emplace_back(hatch_item({from, plot.place.y, to - from, plot.place.height}, -1.0, theme));
  }
}

PathItem hatch_item(const PixelRect& r, double slope, const Theme& theme) {
  PathItem lines;
  lines.stroke = {theme.hatch, 0.8 * theme.line_px, {}};
  const double right = r.x + r.width;
  for (double x = r.x - r.height; x < right; x += 0.9 * theme.text_px) {
    // A diagonal, cut to the rectangle.
    const double a = std::max(r.x, x);
    const double b = std::min(right, x + r.height);
    if (b <= a) continue;
    const double from = slope < 0.0 ? r.y + r.height : r.y;
    const double way = slope < 0.0 ? -1.0 : 1.0;
    lines.parts.push_back({{{a, from + way * (a - x)}, {b, from + way * (b - x)}}, false});
  }
  return lines;
}

namespace {

/// Between two points that are known; NaN elsewhere.
double height_at(std::span<const TimelinePoint> line, TimeNs time) {
  const auto after = std::ranges::lower_bound(line, time, {}, &TimelinePoint::time);
  if (after == line.end()) return std::nan("");
  if (after->time == time) return after->height_m;
  if (after == line.begin()) return std::nan("");
  const TimelinePoint& before = *(after - 1);
  const double part = static_cast<double>(time - before.time) / static_cast<double>(after->time - before.time);
  return before.height_m + part * (after->height_m - before.height_m);
}

}  // namespace

void add_line(FrameDescription& frame, const Strip& s, const PlotFrame& plot, const Theme& theme) {
  if (s.observation->line.empty()) return;
  // Pings that share a pixel make one point: what is drawn grows with the picture, not with the number of pings.
  constexpr double kLeastStep_px = 0.5;
  const auto& pings = s.observation->product->pings;
  std::vector<PathItem::Part> parts;
  bool on = false;
  for (std::size_t i = 0; i < s.along.x.size(); ++i) {
    const double height_m = height_at(s.observation->line, pings[i].time);
    on = on && std::isfinite(height_m) && !s.along.gap_between(i - 1, i);
    if (!std::isfinite(height_m)) continue;
    if (!on) parts.emplace_back();
    on = true;
    const PixelPoint at = plot.at(s.along.x[i], height_m);
    std::vector<PixelPoint>& points = parts.back().points;
    if (points.empty() || at.x - points.back().x >= kLeastStep_px) points.push_back(at);
  }
  std::erase_if(parts, [](const PathItem::Part& part) { return part.points.size() < 2; });
  if (parts.empty()) return;
  for (const bool halo : {true, false}) {
    PathItem item;
    item.parts = parts;
    item.stroke = {halo ? theme.halo : theme.accent, (halo ? 3.6 : 2.0) * theme.line_px, {}};
    frame.items.emplace_back(std::move(item));
  }
}

namespace {

bool silent(const EchogramPyramid& echogram, std::size_t column) {
  for (int bin = 0; bin < echogram.bins(0); ++bin) {
    if (!echogram.cell(0, column, bin).empty()) return false;
  }
  return true;
}

}  // namespace

bool any_silent(const Strip& s) {
  const EchogramPyramid* echogram = s.observation->echogram;
  if (echogram == nullptr || echogram->levels() == 0) return false;
  for (std::size_t c = 0; c < echogram->columns(0); ++c) {
    if (silent(*echogram, c)) return true;
  }
  return false;
}

void add_silent(FrameDescription& frame, const Strip& s, const PlotFrame& plot, const Theme& theme) {
  const EchogramPyramid* echogram = s.observation->echogram;
  if (echogram == nullptr || echogram->levels() == 0) return;
  const auto per_column = static_cast<std::size_t>(echogram->pings_per_column());
  const std::size_t pings = std::min(s.along.x.size(), echogram->pings());
  for (std::size_t c = 0; c < echogram->columns(0) && c * per_column < pings; ++c) {
    if (!silent(*echogram, c)) continue;
    const std::size_t first = c * per_column;
    while (c + 1 < echogram->columns(0) && (c + 1) * per_column < pings && silent(*echogram, c + 1)) ++c;
    const std::size_t last = std::min(pings, (c + 1) * per_column) - 1;
    const double from = plot.at(s.along.x[first], 0.0).x;
    const double to = std::max(from + 1.0, plot.at(filled_until(s.along.x, s.along.gap, last), 0.0).x);
    const PixelRect place{from, plot.place.y, to - from, plot.place.height};
    frame.items.emplace_back(rectangle_item(place, theme.no_data));
    frame.items.emplace_back(hatch_item(place, 1.0, theme));
  }
}

void add_refused(FrameDescription& frame, const Strip& s, const PlotFrame& plot, const Theme& theme) {
  for (const RefusedSightings& echo : refused_sightings(s.observation->refused)) {
    const RefusedEcho& row = *echo.loudest;
    if (row.ping_index < 0 || row.ping_index >= std::ssize(s.along.x) || !std::isfinite(row.range_m)) continue;
    const PixelPoint at = plot.at(s.along.x[static_cast<std::size_t>(row.ping_index)], row.range_m);
    if (inside(plot.place, at)) add_refused_mark(frame, at, row.echo_id == s.observation->chosen_echo, theme);
  }
}

/// Marks: a line through the plot with its kind's letter on a flag, the text beside it where there is room.
void add_marks(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme) {
  const double em = theme.text_px;
  struct Placed {
    double x = 0.0;
    const TimelineMark* mark = nullptr;
  };
  std::vector<Placed> all;
  for (const Strip& s : strips) {
    for (const TimelineMark& mark : s.observation->marks) {
      const double x = plot.at(x_of(s, mark.time), 0.0).x;
      // A mark outside the part that is shown has no flag in it either.
      if (x >= plot.place.x - 0.5 && x <= plot.place.x + plot.place.width + 0.5) all.push_back({x, &mark});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Placed& a, const Placed& b) { return a.x < b.x; });
  const double flag_px = 1.3 * em;
  const double y = plot.place.y + 0.9 * em;
  double free_x = plot.place.x;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [x, mark] = all[i];
    for (const auto& [colour, width] : {std::pair(theme.halo, 3.0), std::pair(theme.accent, 1.4)}) {
      frame.items.emplace_back(
          line_item({x, plot.place.y}, {x, plot.place.y + plot.place.height}, colour, width * theme.line_px));
    }
    const double end = plot.place.x + plot.place.width;
    const bool right = x + flag_px < end;
    const double from = right ? x : x - flag_px;
    frame.items.emplace_back(rectangle_item({from, y - 0.75 * em, flag_px, 1.5 * em}, theme.accent));
    const char letter = mark->kind.empty() ? '?' : static_cast<char>(mark->kind[0] - (mark->kind[0] >= 'a' ? 32 : 0));
    TextItem flag = text_item({from + flag_px / 2.0, y}, std::string(1, letter), small_text_px(theme, 0.95),
                              theme.background, TextAnchor::centre);
    flag.bold = true;
    frame.items.emplace_back(std::move(flag));
    // Beside the flag, to the right where nothing comes soon, else to the left; a mark without room has its hint.
    const std::string& words = mark->text.empty() ? mark->kind : mark->text;
    const double wide = text_width_px(words.c_str(), small_text_px(theme, 0.9));
    const double gap = 0.3 * em;
    const double next = i + 1 < all.size() ? std::min(all[i + 1].x, end) : end;
    const bool fits_right = from + flag_px + gap + wide < next;
    const bool fits_left = from - gap - wide > free_x;
    free_x = from + flag_px;
    if (!fits_right && !fits_left) continue;
    const double start = fits_right ? from + flag_px + gap : from - gap - wide;
    if (fits_right) free_x = start + wide;
    TextItem text = text_item({start, y}, words, small_text_px(theme, 0.9), theme.text, TextAnchor::left);
    text.halo = theme.halo;
    frame.items.emplace_back(std::move(text));
  }
}

void add_names(FrameDescription& frame, std::span<const Strip> strips, const PlotFrame& plot, const Theme& theme) {
  const double em = theme.text_px;
  const double size = small_text_px(theme, 0.9);
  double free_x = -1e9;
  for (const Strip& strip : strips) {
    const StripSpan s = strip.span();
    const double end = plot.place.x + plot.place.width;
    const double from = std::max(plot.place.x, plot.at(s.first, 0.0).x);
    const double to = std::min(end, std::max(from + 1.0, plot.at(s.last, 0.0).x));
    if (to <= from) continue;  // outside the part that is shown
    const double y = plot.place.y - 0.45 * em;
    frame.items.emplace_back(rectangle_item({from, y, to - from, 0.25 * em}, theme.track));
    const std::string& label = strip.observation->label;
    const std::string name =
        elided(label.empty() ? strip.observation->product->observation : label, size, plot.place.width);
    const double half = text_width_px(name.c_str(), size) / 2.0;
    const double middle = std::clamp((from + to) / 2.0, plot.place.x + half, plot.place.x + plot.place.width - half);
    if (middle - half < free_x) continue;
    free_x = middle + half + 0.6 * em;
    frame.items.emplace_back(text_item({middle, y - 0.75 * em}, name, size, theme.muted, TextAnchor::centre));
  }
}

}  // namespace sonar
