// SPDX-License-Identifier: Apache-2.0
// What pointers do to an echogram, and what lies at a place of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "session/echograms/echogram_model.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr double kWheelStep = 1.25;           ///< of one notch
constexpr TimeNs kShortest = 10 * kSecondNs;  ///< that fills an echogram: a few pings
constexpr double kLowest_m = 2.0;

/// The last one that began by then, or the first: a ping fills up to the next one.
std::int64_t ping_at(const std::vector<PingNavigation>& pings, TimeNs time) {
  const auto after =
      std::upper_bound(pings.begin(), pings.end(), time, [](TimeNs t, const PingNavigation& n) { return t < n.time; });
  return std::max<std::int64_t>(0, (after - pings.begin()) - 1);
}

}  // namespace

std::optional<EchogramModel::There> EchogramModel::there(PixelPoint at) const {
  const SurveyFiles* survey = workspace_.document.survey();
  if (!places_ || survey == nullptr) return std::nullopt;
  for (const EchogramPlot* plot : {&places_->above, places_->below ? &*places_->below : nullptr}) {
    if (plot == nullptr || !inside(plot->places.plot.place, at)) continue;
    if (plot->of.name.observation >= survey->observations.size()) continue;
    const auto& pings = survey->observations[plot->of.name.observation].navigation;
    const std::int64_t ping = ping_at(pings, plot->places.time_at(at.x));
    return There{plot, ping, plot->places.plot.y_at(at.y)};
  }
  return std::nullopt;
}

EchogramRow EchogramModel::row_of(const EchogramName& name, std::int64_t ping) const {
  const auto& shown = workspace_.document.shown();
  EchogramOf of = name.of;
  // Of a fan the beam of the slices stands for all.
  if (!of.beam) of.beam = std::clamp(workspace_.slices().beam, 0, shown->sector().beams() - 1);
  return echogram_rows(shown->sector(), shown->placement(ping), of).front();
}

std::optional<Voxel> EchogramModel::voxel_at(PixelPoint at) const {
  const auto& shown = workspace_.document.shown();
  const auto here = there(at);
  if (!here || !shown || here->plot->of.name.channel >= 0) return std::nullopt;
  if (here->plot->of.name.observation != shown->index() || here->ping >= shown->pings()) return std::nullopt;
  if (here->ping != workspace_.document.ping()) return std::nullopt;  // the cursor is one of the ping on show
  const EchogramRow row = row_of(here->plot->of.name, here->ping);
  const auto at_height = row.sample_at(here->height_m);
  if (!at_height) return std::nullopt;
  const double sample = std::round(*at_height);
  if (!(sample >= 0.0 && sample < shown->sector().range().count)) return std::nullopt;
  const int beams = shown->sector().beams();
  return Voxel{row.row / beams, row.row % beams, static_cast<int>(sample)};
}

void EchogramModel::point(PixelPoint at) {
  pointed_ = true;
  workspace_.cursor.set(voxel_at(at));
}

void EchogramModel::go_to(PixelPoint at) {
  const auto& shown = workspace_.document.shown();
  const auto here = there(at);
  if (!here || !shown) return;
  std::int64_t ping = here->ping;
  if (here->plot->of.name.observation != shown->index()) {
    // Another sounder's echogram: the ping of the same time.
    ping = ping_at(shown->files().navigation, here->plot->places.time_at(at.x));
  }
  if (ping != workspace_.document.ping()) workspace_.document.look_at(ping);
}

void EchogramModel::pointer(const PointerEvent& event) {
  if (!places_) return;
  switch (event.action) {
    case PointerAction::press:
      if (event.button == PointerButton::middle) pan_ = Pan{event.at, part(), heights()};
      if (event.button != PointerButton::left) return;
      scrubbing_ = true;
      go_to(event.at);
      return point(event.at);
    case PointerAction::move:
      if (event.button == PointerButton::middle) return pan_to(event.at);
      if (event.button == PointerButton::left && scrubbing_) go_to(event.at);
      return point(event.at);
    case PointerAction::release:
      scrubbing_ = false;
      pan_.reset();
      return;
    case PointerAction::wheel: {
      const double factor = std::pow(kWheelStep, event.wheel_steps);
      return event.control ? zoom_heights(event.at.y, factor) : zoom_time(event.at.x, factor);
    }
    case PointerAction::pan:
      pan_ = Pan{{}, part(), heights()};
      pan_to(event.by);
      return pan_.reset();
    case PointerAction::zoom:
      zoom_heights(event.at.y, event.factor);
      return zoom_time(event.at.x, event.factor);
    case PointerAction::double_press:
      return show_all();
    case PointerAction::leave:
      pointed_ = false;
      workspace_.cursor.set(std::nullopt);
      return changed().tell();
  }
}

bool EchogramModel::aim(PixelPoint at) {
  go_to(at);
  return true;
}

void EchogramModel::show_all() {
  pan_.reset();
  if (!zoomed()) return;
  shown_.reset();
  heights_.reset();
  update();
}

void EchogramModel::show_part(TimeNs first, TimeNs length) {
  const TimelineInterval& all = places_->above.places.all;
  std::optional<TimelineInterval> to;
  if (length < all.last - all.first) {
    first = std::clamp(first, all.first, all.last - length);
    to = TimelineInterval{first, first + length};
  }
  if (shown_ == to) return;
  shown_ = to;
  update();
}

void EchogramModel::show_heights(double first_m, double length_m) {
  const TimelineHeights& all = places_->heights;
  std::optional<TimelineHeights> to;
  if (length_m < all.last_m - all.first_m) {
    first_m = std::clamp(first_m, all.first_m, all.last_m - length_m);
    to = TimelineHeights{first_m, first_m + length_m};
  }
  if (heights_ == to) return;
  heights_ = to;
  update();
}

void EchogramModel::zoom_time(double x_px, double factor) {
  const TimelineInterval now = part();
  const PixelRect& place = places_->above.places.plot.place;
  const auto length = static_cast<double>(now.last - now.first);
  const double share = std::clamp((x_px - place.x) / place.width, 0.0, 1.0);
  const double to = std::max(length / factor, static_cast<double>(kShortest));
  if (to >= length && factor > 1.0) return;
  show_part(now.first + static_cast<TimeNs>(share * (length - to)), static_cast<TimeNs>(to));
}

void EchogramModel::zoom_heights(double y_px, double factor) {
  const TimelineHeights now = heights();
  const PixelRect& place = places_->above.places.plot.place;
  const double length = now.last_m - now.first_m;
  const double share = std::clamp((y_px - place.y) / place.height, 0.0, 1.0);
  const double to = std::max(length / factor, kLowest_m);
  if (to >= length && factor > 1.0) return;
  show_heights(now.first_m + share * (length - to), to);
}

void EchogramModel::pan_to(PixelPoint at) {
  if (!pan_) return;
  const PixelRect& place = places_->above.places.plot.place;
  if (shown_) {
    const TimeNs length = pan_->part.last - pan_->part.first;
    const double share = (pan_->from.x - at.x) / place.width;
    show_part(pan_->part.first + static_cast<TimeNs>(share * static_cast<double>(length)), length);
  }
  if (heights_) {
    const double length = pan_->heights.last_m - pan_->heights.first_m;
    show_heights(pan_->heights.first_m + (pan_->from.y - at.y) / place.height * length, length);
  }
}

/// A ping that is looked at from elsewhere comes into sight.
void EchogramModel::follow_ping() {
  const auto& shown = workspace_.document.shown();
  if (!shown_ || !places_ || !shown) return;
  const TimeNs time = shown->files().navigation[static_cast<std::size_t>(workspace_.document.ping())].time;
  if (time >= shown_->first && time <= shown_->last) return;
  const TimeNs length = shown_->last - shown_->first;
  show_part(time - length / 2, length);
}

std::vector<Overlay> EchogramModel::overlays() const {
  std::vector<Overlay> out;
  const auto& shown = workspace_.document.shown();
  if (!places_ || !shown || places_->above.of.name.observation != shown->index()) return out;
  const std::int64_t ping = workspace_.document.ping();
  const TimeNs time = shown->files().navigation[static_cast<std::size_t>(ping)].time;
  for (const EchogramPlot* plot : {&places_->above, places_->below ? &*places_->below : nullptr}) {
    if (plot == nullptr) continue;
    const PixelRect& place = plot->places.plot.place;
    const double x = plot->places.x_of(time);
    if (x < place.x - 0.5 || x > place.x + place.width + 0.5) continue;
    Overlay playhead;
    playhead.line = {{x, place.y}, {x, place.y + place.height}};
    out.push_back(std::move(playhead));
  }
  const auto& cursor = workspace_.cursor();
  if (!cursor || pointed_) return out;
  const EchogramPlot& plot = places_->above;
  const double height_m = row_of(plot.of.name, ping).height_m(cursor->sample);
  const PixelPoint at{plot.places.x_of(time), plot.places.plot.at(0.0, height_m).y};
  if (inside(plot.places.plot.place, at)) out.push_back({{}, at, {}, 0.0});
  return out;
}

std::string EchogramModel::hint(PixelPoint at) const {
  const auto here = there(at);
  if (!here) return {};
  const EchogramName& name = here->plot->of.name;
  const SurveyFiles& survey = *workspace_.document.survey();
  const auto& navigation = survey.observations[name.observation].navigation[static_cast<std::size_t>(here->ping)];
  const auto& shown = workspace_.document.shown();
  std::string text = fmt::format("{}, ping {}\n{} UTC\n{}", survey.observations[name.observation].name, here->ping,
                                 clock_text(navigation.time, true), echogram_text(survey, name, shown));
  const bool depth = name.of.height == EchogramHeight::depth;
  const Unit unit = workspace_.units().length();
  const auto add_place = [&](double range_m, double depth_m) {
    text += fmt::format("\nrange {}, depth {}", quantity_text(range_m, 1, unit), quantity_text(depth_m, 1, unit));
  };
  if (name.channel >= 0) {
    const double other_m = here->height_m + (depth ? -1.0 : 1.0) * navigation.transducer_depth_m;
    add_place(depth ? other_m : here->height_m, depth ? here->height_m : other_m);
  } else if (shown && here->ping < shown->pings()) {
    if (const auto sample = row_of(name, here->ping).sample_at(here->height_m)) {
      EchogramName deep = name;
      deep.of.height = EchogramHeight::depth;
      add_place(shown->sector().range().range_m(*sample), row_of(deep, here->ping).height_m(*sample));
    }
  }
  const EchogramPyramid* echogram = here->plot->of.echogram.get();
  if (echogram == nullptr || here->ping >= static_cast<std::int64_t>(echogram->pings())) return text;
  const int bin = bin_of(echogram->range(), here->height_m);
  if (bin < 0) return text;
  const EchogramCell& cell =
      echogram->cell(0, static_cast<std::size_t>(here->ping / echogram->pings_per_column()), bin);
  if (!cell.empty()) text += fmt::format("\nSv {:.1f} dB", db_from_counts(cell.mean_count()));
  return text;
}

}  // namespace sonar
