// SPDX-License-Identifier: Apache-2.0
#include "view/lineage/lineage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "view/key_rows.h"
#include "view/maps/map_items.h"
#include "view/school_look.h"
#include "view/shapes.h"
#include "view/timelines/timeline_strip.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 18.0;
constexpr double kLeastHeight_em = 9.0;
constexpr double kBarOfLane = 0.5;  ///< how high a bar is
constexpr double kHighestBar_em = 0.9;

/// Pings that follow one another, both included.
struct Stretch {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

std::vector<Stretch> stretches(const std::vector<std::int64_t>& pings) {
  std::vector<Stretch> out;
  for (const std::int64_t ping : pings) {
    if (out.empty() || ping != out.back().last + 1) out.push_back({ping, ping});
    out.back().last = ping;
  }
  return out;
}

/// What one lineage is drawn with.
class Drawing {
 public:
  Drawing(const LineageData& data, Lineage& to, const Theme& theme) : data_(data), to_(to), theme_(theme) {
    for (std::size_t i = 0; i < to.lanes.size(); ++i) lane_[to.lanes[i]] = i;
    const double lane_px = to.plot.place.height / (to.plot.y.last - to.plot.y.first);
    bar_px_ = std::clamp(kBarOfLane * lane_px, 1.0, kHighestBar_em * theme.text_px);
    // A ping fills up to the next one; the last of all as long as the one before.
    const auto n = data.times.size();
    usual_s_ = n > 1 ? static_cast<double>(data.times[n - 1] - data.times[0]) / 1e9 / static_cast<double>(n - 1) : 1.0;
  }

  void add_lanes() {
    for (std::size_t i = 0; i + 1 < to_.lanes.size(); ++i) {
      const double y = to_.plot.at(0.0, static_cast<double>(i) + 1.0).y;
      const PixelRect& place = to_.plot.place;
      item(line_item({place.x, y}, {place.x + place.width, y}, theme_.grid, theme_.line_px));
    }
  }

  void add_school(const LineageSchool& school) {
    const auto lane = lane_.find(school.school_id);
    if (lane == lane_.end()) return;
    const double y = middle_px(lane->second);
    const Rgba8 colour = colour_of(school);
    const std::vector<Stretch> seen = stretches(school.pings);
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
      PathItem lost = line_item({x_after(seen[i].last), y}, {x_of(seen[i + 1].first), y}, colour, theme_.line_px);
      lost.stroke.dashes_px = {3.0 * theme_.line_px, 3.0 * theme_.line_px};
      item(std::move(lost));
    }
    const bool selected = data_.selected == school.school_id;
    for (const Stretch& stretch : seen) {
      const double from = x_of(stretch.first);
      const PixelRect bar{from, y - 0.5 * bar_px_, std::max(1.0, x_after(stretch.last) - from), bar_px_};
      item(
          rectangle_item(bar, colour, selected ? theme_.accent : theme_.halo, (selected ? 2.5 : 0.5) * theme_.line_px));
    }
  }

  void add_edge(const TrackEdge& edge) {
    const auto own = lane_.find(edge.school_id);
    const LineageSchool* school = school_of(edge.school_id);
    if (own == lane_.end() || school == nullptr) return;
    const bool begins = edge.kind == TrackEdgeKind::born || edge.kind == TrackEdgeKind::split;
    const PixelPoint at{
        begins || edge.kind == TrackEdgeKind::refound ? x_of(edge.ping_index) : x_after(edge.ping_index),
        middle_px(own->second)};
    const double half = 0.5 * bar_px_;
    if (edge.kind == TrackEdgeKind::born) {
      item(dot(at, std::max(1.5 * theme_.line_px, 0.6 * half), theme_));
    } else if (edge.kind == TrackEdgeKind::lost) {
      item(line_item({at.x, at.y - 1.6 * half}, {at.x, at.y + 1.6 * half}, theme_.text, 1.5 * theme_.line_px));
    } else if (edge.other_id != 0) {
      const auto other = lane_.find(edge.other_id);
      if (other == lane_.end()) return;
      item(line_item({at.x, middle_px(other->second)}, at, colour_of(*school), 2.0 * theme_.line_px));
      item(dot({at.x, middle_px(other->second)}, 1.5 * theme_.line_px, theme_));
    }
  }

  /// Numbers at the left of their lanes, as far as there is room; the selected school's first.
  void add_numbers() {
    const double em = small_text_px(theme_, 0.9);
    std::vector<double> taken;
    std::vector<std::int64_t> order = to_.lanes;
    std::stable_partition(order.begin(), order.end(), [&](std::int64_t id) { return data_.selected == id; });
    for (const std::int64_t id : order) {
      const double y = middle_px(lane_[id]);
      if (std::ranges::any_of(taken, [&](double other) { return std::abs(other - y) < 1.05 * em; })) continue;
      taken.push_back(y);
      const bool selected = data_.selected == id;
      TextItem text = text_item({to_.plot.place.x - 0.6 * em, y}, fmt::format("{}", id), em,
                                selected ? theme_.accent : theme_.text, TextAnchor::right);
      text.bold = selected;
      item(std::move(text));
    }
  }

  static PathItem dot(PixelPoint at, double radius_px, const Theme& theme) {
    return polyline_item(
        {{at.x - radius_px, at.y}, {at.x, at.y - radius_px}, {at.x + radius_px, at.y}, {at.x, at.y + radius_px}}, true,
        theme.halo, 0.5 * theme.line_px, theme.text);
  }

 private:
  template <class Item>
  void item(Item made) {
    to_.frame.items.emplace_back(std::move(made));
  }
  [[nodiscard]] double seconds(std::int64_t ping) const {
    const auto last = std::ssize(data_.times) - 1;
    const auto at = static_cast<std::size_t>(std::clamp<std::int64_t>(ping, 0, last));
    return static_cast<double>(data_.times[at] - to_.zero) / 1e9;
  }
  [[nodiscard]] double x_of(std::int64_t ping) const { return to_.plot.at(seconds(ping), 0.0).x; }
  [[nodiscard]] double x_after(std::int64_t ping) const {
    const double own = seconds(ping);
    const double next = ping + 1 < std::ssize(data_.times) ? seconds(ping + 1) : own + usual_s_;
    return to_.plot.at(std::min(next, own + kGapIntervals * usual_s_), 0.0).x;
  }
  [[nodiscard]] double middle_px(std::size_t lane) const { return to_.plot.at(0.0, static_cast<double>(lane) + 0.5).y; }
  [[nodiscard]] const LineageSchool* school_of(std::int64_t id) const {
    const auto found = std::ranges::find(data_.schools, id, &LineageSchool::school_id);
    return found == data_.schools.end() ? nullptr : &*found;
  }
  [[nodiscard]] Rgba8 colour_of(const LineageSchool& school) const {
    return school.status == "rejected" ? status_colour(school.status, theme_)
                                       : school_colour(static_cast<int>(school.school_id));
  }

  const LineageData& data_;
  Lineage& to_;
  const Theme& theme_;
  std::map<std::int64_t, std::size_t> lane_;
  double bar_px_ = 1.0;
  double usual_s_ = 1.0;
};

std::vector<KeyEntry> key_of(const Theme& theme) {
  const auto middle = [](const PixelRect& at) { return PixelPoint{at.x + 0.5 * at.width, at.y + 0.5 * at.height}; };
  const auto upright = [=](const PixelRect& at, double width) {
    return line_item({middle(at).x, at.y}, {middle(at).x, at.y + at.height}, theme.text, width * theme.line_px);
  };
  return {
      {"first seen",
       [=](FrameDescription& frame, const PixelRect& at) {
         frame.items.emplace_back(Drawing::dot(middle(at), 0.25 * at.height, theme));
       }},
      {"lost", [=](FrameDescription& frame, const PixelRect& at) { frame.items.emplace_back(upright(at, 1.5)); }},
      {"not seen",
       [=](FrameDescription& frame, const PixelRect& at) {
         PathItem line = line_item({at.x, middle(at).y}, {at.x + at.width, middle(at).y}, theme.text, theme.line_px);
         line.stroke.dashes_px = {3.0 * theme.line_px, 3.0 * theme.line_px};
         frame.items.emplace_back(std::move(line));
       }},
      {"split off or merged", [=](FrameDescription& frame, const PixelRect& at) {
         frame.items.emplace_back(upright(at, 2.0));
         frame.items.emplace_back(Drawing::dot({middle(at).x, at.y}, 1.5 * theme.line_px, theme));
       }}};
}

Result<void> require_drawable(const LineageData& data, PixelSize size, const Theme& theme) {
  if (size.width < kLeastWidth_em * theme.text_px || size.height < kLeastHeight_em * theme.text_px) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a lineage", size.width, size.height));
  }
  if (data.times.empty()) return fail(ErrorCode::not_found, "there are no pings to draw a lineage of");
  if (data.schools.empty()) return fail(ErrorCode::not_found, "there are no schools to draw a lineage of");
  return {};
}

void lay_out_plot(Lineage& out, const LineageStyle& style, const LineageData& data) {
  PlotFrame& plot = out.plot;
  const TimelineInterval part = style.shown && style.shown->last > style.shown->first ? *style.shown : out.all;
  const auto there = [&](std::int64_t id) {
    const auto& pings = std::ranges::find(data.schools, id, &LineageSchool::school_id)->pings;
    const auto time = [&](std::int64_t ping) { return data.times[static_cast<std::size_t>(ping)]; };
    return time(pings.front()) <= part.last && time(pings.back()) >= part.first;
  };
  for (const std::int64_t id : lane_order(data)) {
    if (there(id)) out.lanes.push_back(id);
  }
  plot.x = {static_cast<double>(part.first - out.zero) / 1e9, static_cast<double>(part.last - out.zero) / 1e9,
            "time (UTC), " + clock_text(part.first, true).substr(0, 10), false};
  const std::size_t lanes = out.lanes.size() + (style.free_lane ? 1 : 0);
  plot.y = {0.0, static_cast<double>(std::max<std::size_t>(1, lanes)), "school", false};
}

}  // namespace

std::vector<std::int64_t> lane_order(const LineageData& data) {
  std::map<std::int64_t, std::int64_t> parent;
  for (const TrackEdge& edge : data.edges) {
    // Where it came from tells more than where it went; what comes out again belongs where it went first.
    if (edge.kind == TrackEdgeKind::split) parent[edge.school_id] = edge.other_id;
    if (edge.kind == TrackEdgeKind::merged) parent.try_emplace(edge.school_id, edge.other_id);
  }
  std::vector<const LineageSchool*> by_time;
  for (const LineageSchool& school : data.schools) by_time.push_back(&school);
  std::ranges::stable_sort(by_time, {},
                           [](const LineageSchool* s) { return std::pair(s->pings.front(), s->school_id); });
  std::vector<std::int64_t> order;
  std::set<std::int64_t> placed;
  std::map<std::int64_t, std::vector<std::int64_t>> children;
  for (const LineageSchool* school : by_time) {
    if (const auto of = parent.find(school->school_id); of != parent.end()) {
      children[of->second].push_back(school->school_id);
    }
  }
  const auto place = [&](const auto& self, std::int64_t id) -> void {
    if (!placed.insert(id).second) return;
    order.push_back(id);
    for (const std::int64_t child : children[id]) self(self, child);
  };
  for (const LineageSchool* school : by_time) {
    if (!parent.contains(school->school_id)) place(place, school->school_id);
  }
  // Of schools that went into each other none is the first.
  for (const LineageSchool* school : by_time) place(place, school->school_id);
  return order;
}

Result<Lineage> lineage(const LineageData& data, const LineageStyle& style, PixelSize size, const Theme& theme) {
  if (auto drawable = require_drawable(data, size, theme); !drawable) return pass_on(drawable);
  Lineage out;
  out.zero = data.times.front();
  const auto pings = static_cast<TimeNs>(data.times.size());
  const TimeNs usual = pings > 1 ? (data.times.back() - out.zero) / (pings - 1) : kSecondNs;
  out.all = {out.zero, data.times.back() + std::max<TimeNs>(1, usual)};
  LayoutNeeds needs{.title_lines = style.brief ? 0 : 2, .colour_bar = false, .y_label_characters = 4};
  std::vector<KeyEntry> key;
  if (!style.brief) {
    key = key_of(theme);
    needs.foot_lines = 1;
    needs.foot_lines = key_lines(key, lay_out(size, theme, needs).foot.width, theme);
  }
  const Layout layout = lay_out(size, theme, needs);
  out.plot.place = layout.plot;
  lay_out_plot(out, style, data);
  FrameDescription& frame = out.frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = data.title;
  frame.items.emplace_back(rectangle_item(out.plot.place, theme.plot));
  frame.items.emplace_back(ClipItem{out.plot.place});
  Drawing drawing(data, out, theme);
  drawing.add_lanes();
  for (const LineageSchool& school : data.schools) drawing.add_school(school);
  for (const TrackEdge& edge : data.edges) drawing.add_edge(edge);
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(rectangle_item(out.plot.place, {0, 0, 0, 0}, theme.axis, theme.line_px));
  drawing.add_numbers();
  TextItem label = text_item({out.plot.place.x - 4.4 * theme.text_px, out.plot.place.y + out.plot.place.height / 2.0},
                             out.plot.y.label, theme.text_px, theme.muted, TextAnchor::centre);
  label.turned_deg = -90.0;
  frame.items.emplace_back(std::move(label));
  add_x_axis(frame, out.plot, TimelineAxis::time, out.zero, theme);
  if (style.brief) return out;
  add_key(frame, layout.foot, key, theme);
  add_title(frame, layout, theme,
            {data.title, fmt::format("{} · {}", time_span_text(out.zero, data.times.back()),
                                     count_of(data.schools.size(), "school"))});
  return out;
}

}  // namespace sonar
