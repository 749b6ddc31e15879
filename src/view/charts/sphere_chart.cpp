// SPDX-License-Identifier: Apache-2.0
#include "view/charts/sphere_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "view/charts/chart_axes.h"
#include "view/charts/measured_marks.h"
#include "view/colour_bar.h"
#include "view/shapes.h"
#include "view/slices/slice_steps.h"

namespace sonar {
namespace {

constexpr double kLeastWidth_em = 44.0;
constexpr double kLeastHeight_em = 32.0;
constexpr double kMapShare = 0.56;    ///< of the width
constexpr double kUpperShare = 0.58;  ///< of the height
constexpr double kLeastSpan = 0.1;    ///< dB or degrees
constexpr double kPad = 0.06;         ///< of an axis, beyond what is on it

std::size_t index_of(SphereFigure figure) { return static_cast<std::size_t>(figure); }
bool is_width(SphereFigure figure) { return figure >= SphereFigure::width_along; }
const char* unit_of(SphereFigure figure) { return is_width(figure) ? "degrees" : "dB"; }

const char* words_of(SphereFigure figure) {
  switch (figure) {
    case SphereFigure::gain:
      return "gain";
    case SphereFigure::sa_correction:
      return "sa correction";
    case SphereFigure::psi:
      return "equivalent beam angle";
    case SphereFigure::width_along:
      return "width along";
    case SphereFigure::width_athwart:
      return "width athwart";
  }
  return "";
}

double shown(const SphereChartBeam& beam, const SphereLook& look) {
  const auto& figure = beam.figures[index_of(look.figure)];
  return look.errors ? figure.se : figure.after - figure.before;
}

/// The same layout in a part of the picture.
Layout within(const PixelRect& part, const Theme& theme, const LayoutNeeds& needs) {
  Layout out = lay_out({static_cast<int>(part.width), static_cast<int>(part.height)}, theme, needs);
  for (PixelRect* one : {&out.title, &out.plot, &out.colour_bar, &out.foot}) {
    one->x += part.x;
    one->y += part.y;
  }
  return out;
}

/// Round numbers across an axis; of counts whole ones alone.
std::vector<ChartTick> ticks_of(double low, double high, double length_px, double each_px, bool whole) {
  const Ticks ticks = nice_ticks(low, high, std::max(2, static_cast<int>(length_px / each_px)));
  std::vector<ChartTick> out;
  for (const double at : ticks.major) {
    if (whole && at != std::round(at)) continue;
    out.push_back({at, tick_text(at, whole ? 0 : ticks.decimals)});
  }
  return out;
}

void add_plot(FrameDescription& frame, const PlotFrame& plot, const Theme& theme, bool whole_x, bool whole_y) {
  const auto [low, high] = std::minmax(plot.y.first, plot.y.last);
  const auto x = ticks_of(plot.x.first, plot.x.last, plot.place.width, 5.0 * theme.text_px, whole_x);
  const auto y = ticks_of(low, high, plot.place.height, 2.6 * theme.text_px, whole_y);
  if (!whole_y) add_chart_grid(frame, plot, x, y, theme);
  add_chart_axes(frame, plot, x, y, theme);
}

class Drawing {
 public:
  Drawing(const SphereChartData& data, const SphereChartStyle& style, const Theme& theme, SphereChart& out)
      : data_(data), style_(style), theme_(theme), out_(out) {
    for (std::size_t i = 0; i < data.beams.size(); ++i) {
      if (data.beams[i].crossed()) out.crossed.push_back(i);
    }
  }

  void map(const PixelRect& part) {
    const Layout layout = within(part, theme_, {.title_lines = 2, .y_label_characters = 2, .foot_lines = 1});
    const double fans = data_.fans;
    out_.map = {layout.plot, {-0.5, data_.beams_a_fan - 0.5, "beam"}, {-0.5, fans - 0.5, "fan"}};
    double most = 0.0;
    for (const std::size_t i : out_.crossed) most = std::max(most, std::abs(shown(data_.beams[i], style_.look)));
    most = std::max(most, kLeastSpan);
    const bool errors = style_.look.errors;
    const ColourMap colours = errors ? colour_map(ColourMapName::viridis) : difference_colours(theme_);
    const double low = errors ? 0.0 : -most;
    auto image = std::make_shared<Image>();
    image->size = {data_.beams_a_fan, data_.fans};
    for (const SphereChartBeam& beam : data_.beams) {
      image->pixels.push_back(beam.crossed() ? colours.at((shown(beam, style_.look) - low) / (most - low))
                              : beam.state == SphereChartBeam::State::near_null ? theme_.muted
                                                                                : theme_.no_data);
    }
    out_.frame.items.emplace_back(ImageItem{layout.plot, std::move(image), false});
    if (style_.beam) outline(data_.beams[*style_.beam]);
    add_plot(out_.frame, out_.map, theme_, true, true);
    const char* kind = errors ? "standard error" : "change";
    add_title(out_.frame, layout, theme_, {data_.title, data_.words});
    if (layout.colour_bar.width > 0.0 || !theme_.bars) {
      const std::string label =
          fmt::format("{} of {} ({})", kind, words_of(style_.look.figure), unit_of(style_.look.figure));
      add_colour_bar(out_.frame, layout.colour_bar, colour_bar(colours, low, most, label), theme_);
    }
    const bool any_null = std::any_of(data_.beams.begin(), data_.beams.end(), [](const SphereChartBeam& beam) {
      return beam.state == SphereChartBeam::State::near_null;
    });
    const std::string foot =
        fmt::format("{} of {} beams crossed; the others stay as they were{}", out_.crossed.size(), data_.beams.size(),
                    any_null ? ", dark grey where the sphere's TS is not known well enough" : "");
    const double size_px = small_text_px(theme_, 0.9);
    out_.frame.items.emplace_back(text_item({layout.foot.x, layout.foot.y + 0.5 * layout.foot.height},
                                            elided(foot, size_px, layout.foot.width), size_px, theme_.muted));
  }

  void residuals(const PixelRect& part) {
    const Layout layout = within(part, theme_, {.title_lines = 1, .colour_bar = false, .y_label_characters = 4});
    double farthest = 0.0;
    double most = kLeastSpan;
    for (const SphereChartResidual& one : data_.residuals) {
      farthest = std::max(farthest, one.off_axis_deg);
      most = std::max(most, std::abs(one.residual_db));
    }
    most *= 1.0 + kPad;
    out_.residuals = {layout.plot,
                      {0.0, std::max(farthest, 1.0) * (1.0 + kPad), "angle off the beam's axis (degrees)"},
                      {most, -most, "measured TS less model (dB)"}};
    out_.frame.items.emplace_back(rectangle_item(layout.plot, theme_.plot));
    add_plot(out_.frame, out_.residuals, theme_, false, false);
    add_zero_line(out_.frame, out_.residuals, theme_);
    add_points(false);
    if (style_.beam) add_points(true);
    add_title(out_.frame, layout, theme_, {style_.beam ? "Residuals, of the chosen beam dark" : "Residuals"});
  }

  void figures(const PixelRect& part) {
    const SphereFigure figure = style_.look.figure;
    const Layout layout =
        within(part, theme_, {.title_lines = 1, .colour_bar = false, .y_label_characters = 5, .foot_lines = 1});
    const auto of = [&](std::size_t i) { return data_.beams[i].figures[index_of(figure)]; };
    double low = of(out_.crossed.front()).after;
    double high = low;
    for (const std::size_t i : out_.crossed) {
      const auto one = of(i);
      low = std::min({low, one.before, one.after - one.se});
      high = std::max({high, one.before, one.after + one.se});
    }
    const double pad = std::max(kLeastSpan, kPad * (high - low));
    const auto count = static_cast<double>(out_.crossed.size());
    out_.figures = {layout.plot,
                    {-0.5, count - 0.5, "crossed beams, fan by fan"},
                    {high + pad, low - pad, fmt::format("{} ({})", words_of(figure), unit_of(figure))}};
    out_.frame.items.emplace_back(rectangle_item(layout.plot, theme_.plot));
    add_plot(out_.frame, out_.figures, theme_, true, false);
    const MarkLook before{theme_.muted, false};
    const MarkLook after{school_colour(1), true};
    out_.frame.items.emplace_back(ClipItem{layout.plot});
    for (std::size_t k = 0; k < out_.crossed.size(); ++k) {
      const auto one = of(out_.crossed[k]);
      const auto x = static_cast<double>(k);
      if (style_.beam == out_.crossed[k]) {
        const PixelPoint at = out_.figures.at(x, 0.0);
        out_.frame.items.emplace_back(line_item({at.x, layout.plot.y}, {at.x, layout.plot.y + layout.plot.height},
                                                theme_.accent, 2.0 * theme_.line_px));
      }
      add_measured(out_.frame, out_.figures, {x, one.before, 0.0}, before, theme_);
      add_measured(out_.frame, out_.figures, {x, one.after, one.se}, after, theme_);
    }
    out_.frame.items.emplace_back(ClipItem{});
    add_title(out_.frame, layout, theme_, {"Before and after"});
    const std::vector<KeyEntry> key{mark_entry("as the raw file has it", before, theme_),
                                    mark_entry("by the sphere, with one standard error", after, theme_)};
    add_key(out_.frame, layout.foot, key, theme_);
  }

 private:
  void outline(const SphereChartBeam& beam) {
    const PixelPoint from = out_.map.at(beam.beam - 0.5, beam.fan - 0.5);
    const PixelPoint to = out_.map.at(beam.beam + 0.5, beam.fan + 0.5);
    out_.frame.items.emplace_back(rectangle_item({from.x, from.y, to.x - from.x, to.y - from.y}, {0, 0, 0, 0},
                                                 theme_.accent, 2.0 * theme_.line_px));
  }

  /// of_chosen  those of the chosen beam, over the others
  void add_points(bool of_chosen) {
    const double half = (of_chosen ? 0.16 : 0.1) * theme_.text_px;
    PathItem path;
    path.fill = of_chosen ? theme_.accent : with_alpha(school_colour(1), style_.beam ? 90 : 170);
    std::set<std::pair<long, long>> there;
    for (const SphereChartResidual& one : data_.residuals) {
      if (of_chosen && one.beam != *style_.beam) continue;
      // On a lattice, so that squares lie on one another or side by side: of overlapping parts even-odd leaves holes.
      const PixelPoint is = out_.residuals.at(one.off_axis_deg, one.residual_db);
      const auto place = std::pair{std::lround(is.x / (2.0 * half)), std::lround(is.y / (2.0 * half))};
      if (!there.insert(place).second) continue;
      const PixelPoint at{2.0 * half * static_cast<double>(place.first),
                          2.0 * half * static_cast<double>(place.second)};
      path.parts.push_back({{{at.x - half, at.y - half},
                             {at.x + half, at.y - half},
                             {at.x + half, at.y + half},
                             {at.x - half, at.y + half}},
                            true});
    }
    out_.frame.items.emplace_back(std::move(path));
  }

  const SphereChartData& data_;
  const SphereChartStyle& style_;
  const Theme& theme_;
  SphereChart& out_;
};

}  // namespace

std::optional<std::size_t> SphereChart::beam_at(const SphereChartData& data, PixelPoint at) const {
  if (inside(map.place, at)) {
    const auto fan = static_cast<int>(std::lround(map.y_at(at.y)));
    const auto beam = static_cast<int>(std::lround(map.x_at(at.x)));
    if (fan < 0 || fan >= data.fans || beam < 0 || beam >= data.beams_a_fan) return std::nullopt;
    return static_cast<std::size_t>(fan * data.beams_a_fan + beam);
  }
  if (!inside(figures.place, at) || crossed.empty()) return std::nullopt;
  const double k = std::clamp(std::round(figures.x_at(at.x)), 0.0, static_cast<double>(crossed.size() - 1));
  return crossed[static_cast<std::size_t>(k)];
}

Result<SphereChart> sphere_chart(const SphereChartData& data, const SphereChartStyle& style, PixelSize size,
                                 const Theme& theme) {
  if (size.width < kLeastWidth_em * theme.text_px || size.height < kLeastHeight_em * theme.text_px) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a picture of {} x {} pixels is too small for a beam map", size.width, size.height));
  }
  SphereChart out;
  Drawing drawing(data, style, theme, out);
  if (out.crossed.empty()) return fail(ErrorCode::not_found, "the sphere crossed no beam: there is nothing to show");
  out.frame.size = size;
  out.frame.background = theme.background;
  out.frame.title = data.title;
  const double left = std::round(kMapShare * size.width);
  const double upper = std::round(kUpperShare * size.height);
  drawing.map({0.0, 0.0, left, upper});
  drawing.residuals({left, 0.0, size.width - left, upper});
  drawing.figures({0.0, upper, static_cast<double>(size.width), size.height - upper});
  return out;
}

std::string sphere_beam_text(const SphereChartBeam& beam) {
  std::string text =
      fmt::format("fan {}, beam {}, channel {}, {:.1f} kHz", beam.fan, beam.beam, beam.channel, beam.frequency_khz);
  switch (beam.state) {
    case SphereChartBeam::State::left:
      return text + "\nnot crossed: stays as it was";
    case SphereChartBeam::State::near_null:
      return text + "\ncrossed, but the sphere's TS is not known well enough at this frequency: stays as it was";
    case SphereChartBeam::State::crossed:
      break;
  }
  for (std::size_t i = 0; i < beam.figures.size(); ++i) {
    const auto& one = beam.figures[i];
    const auto figure = static_cast<SphereFigure>(i);
    text += fmt::format("\n{}: {:.2f} -> {:.2f} \u00B1 {:.2f} {}", words_of(figure), one.before, one.after, one.se,
                        unit_of(figure));
  }
  return text + fmt::format("\n{}, residuals {:.2f} dB",
                            count_of(static_cast<std::size_t>(std::max(0, beam.hits)), "ping"), beam.rms_db);
}

}  // namespace sonar
