// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/time.h"
#include "view/colour_bar.h"
#include "view/key_rows.h"
#include "view/shapes.h"
#include "view/slices/slice_context.h"
#include "view/slices/slice_key.h"

namespace sonar {
namespace {

constexpr double kName_em = 1.4;       ///< height of a line with a step's name
constexpr double kWords_em = 1.2;      ///< of a line on what it did
constexpr double kSmall = 0.9;         ///< its text, of the theme's
constexpr double kGap_em = 0.7;        ///< between pictures
constexpr double kSign = 0.1;          ///< size of signs in the picture of a step, of its height
constexpr double kLeastPlot_em = 6.0;  ///< height of a picture, before lines of words are left out
constexpr double kWordsFrom_em = 7.0;  ///< a narrower picture has its number alone: words would be cut to a letter
constexpr double kLeast_px = 12.0;
constexpr double kRowShare = 0.24;  ///< of the height, for the row of all steps below two that are compared

using Shows = SliceStepPlace::Shows;

/// Places of as many pictures of one size, row by row, as large as their shape lets them be.
/// aspect  width over height of what each shows
std::vector<PixelRect> cells(const PixelRect& area, std::size_t count, double aspect, double words_px, double gap_px) {
  const auto n = static_cast<double>(count);
  double columns = n;
  double best = -1.0;
  for (double c = 1.0; c <= n; c += 1.0) {
    const double rows = std::ceil(n / c);
    const double width = (area.width - (c - 1.0) * gap_px) / c;
    const double height = (area.height - (rows - 1.0) * gap_px) / rows - words_px;
    const double shown = std::min(width, height * aspect);
    if (shown > best) {
      best = shown;
      columns = c;
    }
  }
  const double rows = std::ceil(n / columns);
  const double width = std::max(kLeast_px, std::floor((area.width - (columns - 1.0) * gap_px) / columns));
  const double height = std::max(words_px + kLeast_px, std::floor((area.height - (rows - 1.0) * gap_px) / rows));
  std::vector<PixelRect> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double row = std::floor(static_cast<double>(i) / columns);
    const double column = static_cast<double>(i) - row * columns;
    out.push_back(
        {std::round(area.x + column * (width + gap_px)), std::round(area.y + row * (height + gap_px)), width, height});
  }
  return out;
}

class Page {
 public:
  Page(const Sector& sector, const SliceStepsData& data, const SlicePing& ping, const SliceView& view,
       const SliceStepsStyle& style, const Theme& theme, SliceStepsPicture& out)
      : sector_(sector), data_(data), ping_(ping), view_(view), style_(style), theme_(theme), out_(out) {}

  /// All steps with what they did.
  Result<void> add_all(const PixelRect& area) {
    std::size_t lines = 0;
    for (const SliceStep& step : data_.steps) lines = std::max(lines, step.words.size());
    // In a small panel the pictures come before the words.
    const auto height = [&](std::size_t with) {
      const double words = words_px(with);
      return plot_of(cells(area, data_.steps.size(), aspect(), words, kGap_em * em()).front(), words).height;
    };
    while (lines > 0 && height(lines) < kLeastPlot_em * em()) --lines;
    if (narrow(cells(area, data_.steps.size(), aspect(), words_px(lines), kGap_em * em()).front())) lines = 0;
    return add_steps(area, lines);
  }

  Result<void> add_compared(const PixelRect& area, const std::pair<std::size_t, std::size_t>& steps) {
    const double row = std::round(std::max(kRowShare * area.height, (kName_em + 3.0) * em()));
    PixelRect above = area;
    above.height -= row + kGap_em * em();
    if (auto done = add_large(above, steps); !done) return done;
    return add_steps({area.x, area.y + area.height - row, area.width, row}, 0);
  }

 private:
  [[nodiscard]] double em() const { return theme_.text_px; }
  [[nodiscard]] double aspect() const {
    const auto extent = view_.extent ? view_.extent : whole_extent(sector_, view_);
    return extent ? (extent->x1 - extent->x0) / std::max(1e-9, extent->y1 - extent->y0) : 1.0;
  }
  [[nodiscard]] double words_px(std::size_t lines) const {
    return std::round((kName_em + kWords_em * static_cast<double>(lines) + 0.2) * em());
  }

  [[nodiscard]] bool narrow(const PixelRect& cell) const { return cell.width < kWordsFrom_em * em(); }

  /// Where a cell's slice lies below its words.
  [[nodiscard]] static PixelRect plot_of(const PixelRect& cell, double words_px) {
    return {cell.x, cell.y + words_px, cell.width, cell.height - words_px};
  }

  Result<void> map_onto(const PixelRect& plot, std::shared_ptr<const SliceMap>& map) const {
    auto mapped = mapped_slice(sector_, view_, plot);
    if (!mapped) return fail(ErrorCode::bad_parameter, "the slice does not meet the sonar's sector");
    map = std::move(mapped->map);
    return {};
  }

  Result<void> add_steps(const PixelRect& area, std::size_t lines) {
    const double words = words_px(lines);
    const std::vector<PixelRect> places = cells(area, data_.steps.size(), aspect(), words, kGap_em * em());
    if (auto mapped = map_onto(plot_of(places.front(), words), out_.map); !mapped) return mapped;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const SliceStepPlace place{Shows::step, i, places[i], plot_of(places[i], words)};
      const std::string number = std::to_string(i + 1);
      add_words(place, narrow(places[i]) ? number : number + "  " + data_.steps[i].name, data_.steps[i], lines);
      if (auto drawn = add_step(place, i > 0 ? i - 1 : 0, *out_.map); !drawn) return drawn;
      out_.places.push_back(place);
    }
    return {};
  }

  Result<void> add_large(const PixelRect& area, const std::pair<std::size_t, std::size_t>& steps) {
    const auto& [before, after] = steps;
    const std::size_t lines = std::max(data_.steps[before].words.size(), data_.steps[after].words.size());
    const double words = words_px(lines);
    const std::vector<PixelRect> places = cells(area, 3, aspect(), words, 1.5 * kGap_em * em());
    if (auto mapped = map_onto(plot_of(places.front(), words), out_.large); !mapped) return mapped;
    const auto place = [&](Shows shows, std::size_t step, std::size_t i) {
      return SliceStepPlace{shows, step, places[i], plot_of(places[i], words)};
    };
    const SliceStepPlace left = place(Shows::before, before, 0);
    add_words(left, fmt::format("Before: {}  {}", before + 1, data_.steps[before].name), data_.steps[before], lines);
    if (auto drawn = add_step(left, before, *out_.large); !drawn) return drawn;
    const SliceStepPlace right = place(Shows::after, after, 1);
    add_words(right, fmt::format("After: {}  {}", after + 1, data_.steps[after].name), data_.steps[after], lines);
    if (auto drawn = add_step(right, before, *out_.large); !drawn) return drawn;
    const SliceStepPlace third = place(Shows::difference, after, 2);
    SliceStep words_of_difference;
    words_of_difference.words = {fmt::format("{} less {}", after + 1, before + 1)};
    add_words(third, "Difference", words_of_difference, lines);
    add_image(
        third,
        difference_image(*out_.large, data_, data_.steps[before], data_.steps[after], style_.difference_db, theme_),
        *out_.large);
    out_.places.insert(out_.places.end(), {left, right, third});
    return {};
  }

  void add_words(const SliceStepPlace& place, const std::string& name, const SliceStep& step, std::size_t lines) {
    const double width = place.place.width;
    TextItem title = text_item({place.place.x, place.place.y + 0.5 * kName_em * em()}, elided(name, 1.1 * em(), width),
                               em(), step.off ? theme_.muted : theme_.text);
    title.bold = !step.off;
    out_.frame.items.emplace_back(std::move(title));
    const double size = small_text_px(theme_, kSmall);
    for (std::size_t i = 0; i < std::min(lines, step.words.size()); ++i) {
      const double y = place.place.y + (kName_em + (static_cast<double>(i) + 0.5) * kWords_em) * em();
      out_.frame.items.emplace_back(
          text_item({place.place.x, y}, elided(step.words[i], size, width), size, theme_.muted));
    }
  }

  Result<void> add_step(const SliceStepPlace& place, std::size_t before, const SliceMap& map) {
    const SliceStep& step = data_.steps[place.step];
    SliceData data;
    data.sv = step.sv;
    data.flags = data_.flags;
    const bool large = place.shows != Shows::step;
    if (large) data.masks = data_.masks;
    FlagStyle flags;
    flags.hidden = step.taken_out;
    auto image = slice_image(map, data, style_.colours, flags, style_.masks, theme_);
    if (!image) return pass_on(image);
    // What the first of two compared looks like is marked nowhere: it is where the other begins.
    if (style_.mark && before != place.step) {
      mark_fates(*image, map, data_, data_.steps[before], step, style_.mark_db, theme_);
    }
    add_image(place, std::move(*image), map);
    return {};
  }

  void add_image(const SliceStepPlace& place, Image image, const SliceMap& map) {
    FrameDescription& frame = out_.frame;
    frame.items.emplace_back(rectangle_item(place.plot, theme_.plot));
    frame.items.emplace_back(ImageItem{place.plot, std::make_shared<const Image>(std::move(image)), false});
    frame.items.emplace_back(ClipItem{place.plot});
    SliceStyle style;
    style.rings = place.shows != Shows::step;
    style.north_up = style_.north_up;
    SlicePing ping = ping_;
    if (place.shows != Shows::before)
      ping.heading_rad = std::numeric_limits<double>::quiet_NaN();  // one arrow is enough
    Theme theme = theme_;
    if (place.shows == Shows::step)
      theme.text_px = std::min(em(), kSign * place.plot.height);  // the ship hides no echo
    add_slice_context(frame, map, {place.plot.x, place.plot.y}, ping, style, theme);
    frame.items.emplace_back(ClipItem{});
    const bool chosen = place.shows == Shows::step && style_.compared &&
                        (place.step == style_.compared->first || place.step == style_.compared->second);
    frame.items.emplace_back(rectangle_item(place.plot, {0, 0, 0, 0}, chosen ? theme_.accent : theme_.axis,
                                            (chosen ? 2.5 : 1.0) * theme_.line_px));
  }

  const Sector& sector_;
  const SliceStepsData& data_;
  const SlicePing& ping_;
  const SliceView& view_;
  const SliceStepsStyle& style_;
  const Theme& theme_;
  SliceStepsPicture& out_;
};

KeyEntry patch(std::string text, Rgba8 colour, const Theme& theme) {
  return {std::move(text), [colour, &theme](FrameDescription& frame, const PixelRect& swatch) {
            frame.items.emplace_back(rectangle_item(swatch, colour, theme.axis, 0.5 * theme.line_px));
          }};
}

KeyEntry striped(std::string text, Rgba8 colour, const Theme& theme) {
  return {
      std::move(text), [colour, &theme](FrameDescription& frame, const PixelRect& swatch) {
        const PixelSize size{std::max(1, static_cast<int>(swatch.width)), std::max(1, static_cast<int>(swatch.height))};
        auto image = std::make_shared<Image>(size, theme.water);
        for (int y = 0; y < size.height; ++y) {
          for (int x = 0; x < size.width; ++x) {
            if (on_hatch(x, y, theme)) image->at(x, y) = colour;
          }
        }
        frame.items.emplace_back(ImageItem{swatch, std::move(image), false});
        frame.items.emplace_back(rectangle_item(swatch, {0, 0, 0, 0}, theme.axis, 0.5 * theme.line_px));
      }};
}

std::vector<KeyEntry> key_of(const SliceStepsStyle& style, const Theme& theme) {
  std::vector<KeyEntry> key;
  if (style.mark || style.compared) {
    key.push_back(patch("taken out by the step", theme.accent, theme));
    key.push_back(striped(
        style.mark ? fmt::format("filled in, or changed by {:g} dB or more", style.mark_db) : std::string("filled in"),
        theme.accent, theme));
  }
  key.push_back(patch("no data, or taken out before", theme.no_data, theme));
  return key;
}

/// The scale of Sv, and below it that of differences where one is shown.
void add_bars(FrameDescription& frame, const PixelRect& place, const SliceStepsStyle& style, const Theme& theme) {
  PixelRect upper = place;
  if (style.compared) {
    upper.height = std::floor(0.5 * place.height - 1.2 * theme.text_px);
    PixelRect lower = upper;
    lower.y = place.y + place.height - lower.height;
    add_colour_bar(frame, lower,
                   colour_bar(difference_colours(theme), -style.difference_db, style.difference_db, "difference (dB)"),
                   theme);
  }
  add_colour_bar(frame, upper, colour_bar(style.colours), theme);
}

Result<void> check(const Sector& sector, const SliceStepsData& data, const SliceView& view,
                   const SliceStepsStyle& style, PixelSize size) {
  if (size.width < 160 || size.height < 120) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("noise steps of {} x {} pixels; expected 160 x 120 or more", size.width, size.height));
  }
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  if (shape.size() == 0) return fail(ErrorCode::bad_parameter, "the ping has no data to slice");
  if (data.steps.empty()) return fail(ErrorCode::bad_parameter, "there are no steps to show");
  const std::size_t count = data.steps.size();
  if (style.compared && (style.compared->first >= count || style.compared->second >= count)) {
    return fail(ErrorCode::bad_parameter, fmt::format("no such step to compare; there are {}", count));
  }
  const auto fits = [&](const SliceStep& step) { return step.sv.shape() == shape; };
  if (data.flags.shape() != shape || !std::all_of(data.steps.begin(), data.steps.end(), fits)) {
    return fail(ErrorCode::mismatch, "the steps' samples do not lie on the slice's grid");
  }
  return check_slice(sector, view);
}

}  // namespace

const SliceStepPlace* SliceStepsPicture::at(PixelPoint pixel) const {
  const auto found =
      std::find_if(places.begin(), places.end(), [&](const SliceStepPlace& one) { return inside(one.place, pixel); });
  return found == places.end() ? nullptr : &*found;
}

std::optional<Voxel> SliceStepsPicture::voxel_at(PixelPoint pixel) const {
  const SliceStepPlace* place = at(pixel);
  if (place == nullptr || !inside(place->plot, pixel)) return std::nullopt;
  return map_of(*place).voxel_at({pixel.x - place->plot.x, pixel.y - place->plot.y});
}

Result<SliceStepsPicture> slice_steps(const Sector& sector, const SliceStepsData& data, const SlicePing& ping,
                                      const SliceView& view, const SliceStepsStyle& style, const Theme& theme,
                                      PixelSize size) {
  if (auto valid = check(sector, data, view, style, size); !valid) return pass_on(valid);
  const std::vector<KeyEntry> key = key_of(style, theme);
  LayoutNeeds needs{.x_axis = false, .y_axis = false, .foot_lines = 1};
  needs.foot_lines = key_lines(key, lay_out(size, theme, needs).foot.width, theme);
  const Layout layout = lay_out(size, theme, needs);
  SliceStepsPicture out;
  out.frame.size = size;
  out.frame.background = theme.background;
  SliceStyle slice;
  slice.north_up = style.north_up;
  slice.rings = style.compared.has_value();
  const std::string where = slice_text(sector, view, ping, slice, theme.units);
  out.frame.title = "Noise steps: " + where;
  Page page(sector, data, ping, view, style, theme, out);
  const auto done = style.compared ? page.add_compared(layout.plot, *style.compared) : page.add_all(layout.plot);
  if (!done) return pass_on(done);
  add_title(out.frame, layout, theme,
            {fmt::format("Noise steps, {}   ping {}", ping.observation, ping.ping_index), where},
            ping.time != 0 ? time_text(ping.time) : "");
  add_bars(out.frame, layout.colour_bar, style, theme);
  add_key(out.frame, layout.foot, key, theme);
  return out;
}

}  // namespace sonar
