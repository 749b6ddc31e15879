// SPDX-License-Identifier: Apache-2.0
#include "view/timelines/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "view/colour_bar.h"
#include "view/key_rows.h"
#include "view/maps/map_items.h"
#include "view/school_look.h"
#include "view/shapes.h"
#include "view/timelines/timeline_strip.h"

namespace sonar {
namespace {

constexpr double kSecondsPerDay = 86'400.0;

/// Seconds since `zero`, or nautical miles. Unknown logs take the last known one.
Along along(const ObservationProduct& product, TimelineAxis axis, TimeNs zero) {
  Along a;
  double last = std::nan("");
  for (const PingNavigation& n : product.pings) {
    const double v = axis == TimelineAxis::time ? static_cast<double>(n.time - zero) / 1e9 : n.distance_nmi;
    if (std::isfinite(v)) last = std::isfinite(last) ? std::max(last, v) : v;
    a.x.push_back(last);
  }
  const auto known = std::find_if(a.x.begin(), a.x.end(), [](double v) { return std::isfinite(v); });
  if (known == a.x.end()) {
    a.x.clear();
    return a;
  }
  std::fill(a.x.begin(), known, *known);
  // A log that is coarser than the pings' distance stands still between its steps: those that it takes tell.
  std::vector<double> steps;
  for (std::size_t i = 1; i < a.x.size(); ++i) {
    if (a.x[i] > a.x[i - 1]) steps.push_back(a.x[i] - a.x[i - 1]);
  }
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    a.gap = kGapIntervals * *middle;
  }
  return a;
}

std::int16_t value_of(const EchogramCell& cell, EchogramValue value) {
  if (cell.empty()) return kNoData;
  if (value == EchogramValue::maximum) return cell.high;
  return value == EchogramValue::minimum ? cell.low : cell.mean_count();
}

/// Pings under a column of pixels: [first, end). A ping fills x up to the next one; before a gap, its own interval.
struct Pings {
  std::size_t first = 0;
  std::size_t end = 0;
};
Pings pings_under(std::span<const double> x, double gap, double from, double to) {
  const auto at = [&](double v) {
    return static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), v) - x.begin());
  };
  Pings p{at(from), at(to)};
  if (p.first < p.end || p.first == 0) return p;
  const std::size_t before = p.first - 1;
  if (from < filled_until(x, gap, before)) p = {before, before + 1};
  return p;
}

void add_y_axis(FrameDescription& frame, const PlotFrame& axes, const Theme& theme) {
  const PlotFrame plot = as_read(axes);
  const double em = theme.text_px;
  int most = std::max(2, static_cast<int>(plot.place.height / (3.5 * em)));
  Ticks ticks = nice_ticks(plot.y.first, plot.y.last, most);
  // A scale with one number on it is none.
  while (ticks.major.size() < 2 && most < 5) ticks = nice_ticks(plot.y.first, plot.y.last, ++most);
  for (const double v : ticks.major) {
    const double y = plot.at(0.0, v).y;
    frame.items.emplace_back(line_item({plot.place.x - 0.4 * em, y}, {plot.place.x, y}, theme.axis, theme.line_px));
    frame.items.emplace_back(
        text_item({plot.place.x - 0.6 * em, y}, tick_text(v, ticks.decimals), em, theme.text, TextAnchor::right));
  }
  TextItem label = text_item({plot.place.x - 4.4 * em, plot.place.y + plot.place.height / 2.0}, plot.y.label, em,
                             theme.muted, TextAnchor::centre);
  label.turned_deg = -90.0;
  frame.items.emplace_back(std::move(label));
}

double reach_m(std::span<const Strip> strips) {
  double reach = 0.0;
  for (const Strip& s : strips) {
    if (const EchogramPyramid* e = s.observation->echogram) {
      reach = std::max(reach, e->range().first_m + e->range().bins * e->range().bin_m);
    } else if (const auto& grid = s.observation->product->grid) {
      reach = std::max(reach, grid->range.range_m(grid->range.count - 0.5));
    }
    if (s.observation->echogram != nullptr || s.observation->product->grid) continue;
    for (const SchoolPingRow& row : s.observation->product->school_pings) {
      if (std::isfinite(row.range_m)) reach = std::max(reach, 1.05 * row.range_m);
    }
  }
  return reach > 0.0 ? reach : 100.0;
}

Result<std::vector<Strip>> strips_of(std::span<const TimelineObservation> observations, TimelineAxis axis,
                                     TimeNs zero) {
  std::vector<Strip> strips;
  for (const TimelineObservation& o : observations) {
    if (o.product == nullptr || o.product->pings.empty()) continue;
    Strip strip{&o, along(*o.product, axis, zero)};
    if (!strip.along.x.empty()) strips.push_back(std::move(strip));
  }
  if (strips.empty() && zero != 0 && axis == TimelineAxis::log) {
    return fail(ErrorCode::usage, "the data have no log (distance run); draw the timeline along time");
  }
  if (strips.empty()) return fail(ErrorCode::not_found, "there are no pings to draw a timeline of");
  return strips;
}

/// brief   in few words: there is no room for what decibels refer to
/// of_one  of one beam or channel, which needs no mean
const char* value_label(EchogramValue value, bool brief, bool of_one) {
  if (of_one) return brief ? "Sv (dB)" : kSvLabel;
  if (brief) return value == EchogramValue::mean ? "mean Sv (dB)" : "Sv (dB)";
  if (value == EchogramValue::maximum) return "largest Sv (dB re 1 m\u207B\u00B9)";
  return value == EchogramValue::minimum ? "smallest Sv (dB re 1 m\u207B\u00B9)" : "mean Sv (dB re 1 m\u207B\u00B9)";
}

}  // namespace

void add_x_axis(FrameDescription& frame, const PlotFrame& plot, TimelineAxis axis, TimeNs zero, const Theme& theme) {
  const double em = theme.text_px;
  const double bottom = plot.place.y + plot.place.height;
  const auto tick = [&](double x, const std::string& text) {
    const double px = plot.at(x, 0.0).x;
    frame.items.emplace_back(line_item({px, bottom}, {px, bottom + 0.4 * em}, theme.axis, theme.line_px));
    const double half = text_width_px(text.c_str(), em) / 2.0;
    if (px - half < 0.0 || px + half > frame.size.width) return;
    frame.items.emplace_back(text_item({px, bottom + 1.1 * em}, text, em, theme.text, TextAnchor::centre));
  };
  const int most = std::max(2, static_cast<int>(plot.place.width / (7.0 * em)));
  if (axis == TimelineAxis::log) {
    const Ticks ticks = nice_ticks(plot.x.first, plot.x.last, most);
    for (const double v : ticks.major) tick(v, tick_text(v, ticks.decimals));
  } else {
    const auto time_of = [&](double s) { return zero + static_cast<TimeNs>(std::llround(s * 1e9)); };
    for (const TimeTick& t : time_ticks(time_of(plot.x.first), time_of(plot.x.last), most)) {
      tick(static_cast<double>(t.time - zero) / 1e9, t.text);
    }
  }
  frame.items.emplace_back(text_item({plot.place.x + plot.place.width / 2.0, bottom + 2.5 * em}, plot.x.label, em,
                                     theme.muted, TextAnchor::centre));
}

TimelineHeights heights_of(const EchogramRange& range) {
  return {std::max(0.0, range.first_m), range.first_m + range.bins * range.bin_m};
}

std::vector<TimeTick> time_ticks(TimeNs first, TimeNs last, int most) {
  constexpr std::array<double, 24> kSteps_s{1,      2,      5,       10,      15,      30,        60,        120,
                                            300,    600,    900,     1800,    3600,    7200,      10'800,    21'600,
                                            43'200, 86'400, 172'800, 432'000, 604'800, 1'209'600, 2'592'000, 7'776'000};
  std::vector<TimeTick> ticks;
  if (last < first || most < 1) return ticks;
  const double span_s = static_cast<double>(last - first) / 1e9;
  double step_s = kSteps_s.back();
  for (const double s : kSteps_s) {
    if (span_s / s <= most) {
      step_s = s;
      break;
    }
  }
  while (span_s / step_s > most) step_s *= 2.0;
  const TimeNs step = static_cast<TimeNs>(step_s) * kSecondNs;
  for (TimeNs t = (first + step - 1) / step * step; t <= last; t += step) {
    const std::string text = clock_text(t, true);
    const bool day = step_s >= kSecondsPerDay || (text.substr(11) == "00:00:00" && span_s > 3'600.0);
    ticks.push_back({t, day ? text.substr(0, 10) : text.substr(11, step_s < 60.0 ? 8 : 5)});
  }
  return ticks;
}

EchogramImage echogram_image(const EchogramPyramid& echogram, std::span<const double> x, double gap,
                             const PlotFrame& plot, EchogramValue value, const SvColours& colours) {
  EchogramImage out;
  const PixelSize size{std::max(1, static_cast<int>(std::ceil(plot.place.width))),
                       std::max(1, static_cast<int>(std::ceil(plot.place.height)))};
  out.image = Image(size, {0, 0, 0, 0});
  out.finest_level = echogram.levels();
  x = x.first(std::min(x.size(), echogram.pings()));
  const auto per_column = static_cast<std::size_t>(echogram.pings_per_column());
  for (int i = 0; i < size.width; ++i) {
    const Pings pings = pings_under(x, gap, plot.x_at(plot.place.x + i), plot.x_at(plot.place.x + i + 1));
    if (pings.end <= pings.first) continue;
    const std::size_t first = pings.first / per_column;
    const std::size_t last = (pings.end - 1) / per_column;
    int level = 0;
    while (level + 1 < echogram.levels() && (last - first + 1) >> static_cast<unsigned>(level + 1) >= 1) ++level;
    out.finest_level = std::min(out.finest_level, level);
    const double bin_m = echogram.range().bin_m * echogram.range().bins / echogram.bins(level);
    for (int j = 0; j < size.height; ++j) {
      const double near_m = plot.y_at(plot.place.y + j) - echogram.range().first_m;
      const double far_m = plot.y_at(plot.place.y + j + 1) - echogram.range().first_m;
      const int from = static_cast<int>(std::floor(near_m / bin_m));
      const int to = std::max(from + 1, static_cast<int>(std::floor(far_m / bin_m)));
      EchogramCell cell;
      for (std::size_t c = first >> static_cast<unsigned>(level); c <= last >> static_cast<unsigned>(level); ++c) {
        for (int b = std::max(0, from); b < std::min(to, echogram.bins(level)); ++b) {
          cell.add(echogram.cell(level, c, b));
          ++out.cells_read;
        }
      }
      const bool inside = from >= 0 && from < echogram.bins(level);
      if (inside) out.image.at(i, j) = colours[value_of(cell, value)];
    }
  }
  return out;
}

namespace {

constexpr double kBarFrom_em = 40.0;  ///< a narrower picture without a title needs its width for time

/// Everything that timeline() decides before it draws.
struct LaidOut {
  TimeNs zero = 0;
  TimelineInterval all;
  TimeNs last = 0;
  std::string title;
  bool raw_gone = false;
  bool any_echogram = false;
  bool colour_bar = false;
  std::vector<Strip> strips;
  std::vector<KeyEntry> key;
  Layout layout;
  PlotFrame plot;
};

Result<LaidOut> laid_out(std::span<const TimelineObservation> observations, const TimelineStyle& style, PixelSize size,
                         const Theme& theme) {
  if (auto ok = validate(style); !ok) return pass_on(ok);
  const double em = theme.text_px;
  const double least_em = theme.bars && !style.brief ? 30.0 : 21.0;  // a brief one of that width has no colour bar
  if (size.width < least_em * em || size.height < (style.brief ? 10.0 : 13.0) * em) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a timeline", size.width, size.height));
  }
  LaidOut out;
  std::vector<ObservationProduct> heads;
  for (const TimelineObservation& o : observations) {
    if (o.product == nullptr || o.product->pings.empty()) continue;
    out.zero = out.zero == 0 ? o.product->pings.front().time : std::min(out.zero, o.product->pings.front().time);
    out.last = std::max(out.last, o.product->pings.back().time);
    out.raw_gone = out.raw_gone || o.echogram == nullptr;
    ObservationProduct& head = heads.emplace_back();
    head.title = o.product->title;
    head.observation = o.product->observation;
  }
  auto strips = strips_of(observations, style.axis, out.zero);
  if (!strips) return pass_on(strips);
  out.strips = std::move(*strips);
  out.title = heads.size() == 1 ? observation_title(heads.front()) : survey_title(heads);
  out.any_echogram = std::any_of(out.strips.begin(), out.strips.end(),
                                 [](const Strip& s) { return s.observation->echogram != nullptr; });
  out.colour_bar = out.any_echogram && (!style.brief || !theme.bars || size.width >= kBarFrom_em * em);
  const int title_lines = style.of.empty() ? 3 : 4;
  LayoutNeeds needs{
      .title_lines = style.brief ? 0 : title_lines, .colour_bar = out.colour_bar, .y_label_characters = 4};
  if (!style.brief) out.key = timeline_key(out.strips, style, theme);
  if (!out.key.empty()) {
    needs.foot_lines = 1;
    needs.foot_lines = key_lines(out.key, lay_out(size, theme, needs).foot.width, theme);
  }
  out.layout = lay_out(size, theme, needs);
  PlotFrame& plot = out.plot;
  plot.place = out.layout.plot;
  const double names = (style.brief ? 1.2 : 0.6) * em;
  plot.place.y += names;
  plot.place.height -= names;
  plot.x = {out.strips.front().span().first, out.strips.front().span().last, "", false};
  for (const Strip& s : out.strips) {
    plot.x.first = std::min(plot.x.first, s.span().first);
    plot.x.last = std::max(plot.x.last, s.span().last);
  }
  if (!(plot.x.last > plot.x.first)) plot.x.last = plot.x.first + 1.0;
  const auto time_of = [&](double s) { return out.zero + static_cast<TimeNs>(std::llround(s * 1e9)); };
  if (style.axis == TimelineAxis::time) out.all = {time_of(plot.x.first), time_of(plot.x.last)};
  TimeNs day = out.zero;
  if (style.shown && style.axis == TimelineAxis::time && style.shown->last > style.shown->first) {
    plot.x.first = static_cast<double>(style.shown->first - out.zero) / 1e9;
    plot.x.last = static_cast<double>(style.shown->last - out.zero) / 1e9;
    day = style.shown->first;
  }
  plot.x.label = style.axis == TimelineAxis::log ? "log (nmi)" : "time (UTC), " + clock_text(day, true).substr(0, 10);
  plot.y = length_axis(0.0, reach_m(out.strips), style.height == EchogramHeight::depth ? "depth" : "range", theme);
  if (const auto& part = style.shown_heights; part && part->last_m > part->first_m) {
    plot.y.first = part->first_m;
    plot.y.last = part->last_m;
  }
  return out;
}

void add_echogram(FrameDescription& frame, const Strip& s, const PlotFrame& plot, const TimelineStyle& style,
                  const SvColours& colours, const Theme& theme) {
  // Water where pings were made; a gap stays as empty as what lies between observations.
  const std::vector<double>& x = s.along.x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double from = plot.at(x[i], 0.0).x;
    while (i + 1 < x.size() && x[i + 1] - x[i] <= s.along.gap) ++i;
    const double to = std::max(from + 1.0, plot.at(filled_until(x, s.along.gap, i), 0.0).x);
    frame.items.emplace_back(rectangle_item({from, plot.place.y, to - from, plot.place.height}, theme.water));
  }
  if (s.observation->echogram == nullptr) return;
  auto image = std::make_shared<Image>(
      echogram_image(*s.observation->echogram, s.along.x, s.along.gap, plot, style.value, colours).image);
  const PixelRect place{plot.place.x, plot.place.y, static_cast<double>(image->size.width),
                        static_cast<double>(image->size.height)};
  frame.items.emplace_back(ImageItem{place, std::move(image), false});
}

}  // namespace

Result<TimelinePlot> timeline_plot(std::span<const TimelineObservation> observations, const TimelineStyle& style,
                                   PixelSize size, const Theme& theme) {
  auto out = laid_out(observations, style, size, theme);
  if (!out) return pass_on(out);
  return TimelinePlot{out->plot, out->zero, out->all};
}

Result<FrameDescription> timeline(std::span<const TimelineObservation> observations, const TimelineStyle& style,
                                  PixelSize size, const Theme& theme) {
  const auto laid = laid_out(observations, style, size, theme);
  if (!laid) return pass_on(laid);
  const PlotFrame& plot = laid->plot;
  FrameDescription frame;
  frame.size = size;
  frame.background = theme.background;
  frame.title = laid->title;
  frame.items.emplace_back(rectangle_item(plot.place, theme.plot));
  const SvColours colours = sv_colours(style.scale);
  frame.items.emplace_back(ClipItem{plot.place});
  for (const Strip& s : laid->strips) add_echogram(frame, s, plot, style, colours, theme);
  for (const Strip& s : laid->strips) add_shadow(frame, s, plot, theme);
  for (const Strip& s : laid->strips) add_silent(frame, s, plot, theme);
  for (const Strip& s : laid->strips) add_bad(frame, s, plot, theme);
  std::vector<TrackNumber> numbers;
  for (const Strip& s : laid->strips) {
    if (style.schools && !style.outlined) add_tracks(frame, s, plot, style, theme, numbers);
    if (style.schools && style.outlined) add_outlines(frame, s, plot, style, theme, numbers);
  }
  for (const Strip& s : laid->strips) add_line(frame, s, plot, theme);
  for (const Strip& s : laid->strips) add_refused(frame, s, plot, theme);
  add_track_numbers(frame, numbers, plot, theme);
  add_marks(frame, laid->strips, plot, theme);
  frame.items.emplace_back(ClipItem{});
  frame.items.emplace_back(rectangle_item(plot.place, {0, 0, 0, 0}, theme.axis, theme.line_px));
  add_names(frame, laid->strips, plot, theme);
  add_y_axis(frame, plot, theme);
  add_x_axis(frame, plot, style.axis, laid->zero, theme);
  if (laid->colour_bar)
    add_colour_bar(frame, laid->layout.colour_bar,
                   colour_bar(colours, value_label(style.value, style.brief && theme.bars, !style.of.empty())), theme);
  if (style.brief) return frame;
  add_key(frame, laid->layout.foot, laid->key, theme);
  std::string line = time_span_text(laid->zero, laid->last);
  if (laid->any_echogram) line += style.filtered ? " · noise removed" : " · not filtered";
  if (!style.searched) {
    line += " · schools not detected";
  } else if (!style.schools) {
    line += " · schools not shown";
  }
  if (laid->raw_gone && style.raw_there) line += " · echograms are being read";
  if (laid->raw_gone && !style.raw_there) {
    line += laid->any_echogram ? " · schools only where there are no raw data" : " · no raw data: schools only";
  }
  std::vector<std::string> lines{frame.title, line};
  if (!style.of.empty()) lines.insert(lines.begin() + 1, style.of);
  add_title(frame, laid->layout, theme, lines);
  return frame;
}

}  // namespace sonar
