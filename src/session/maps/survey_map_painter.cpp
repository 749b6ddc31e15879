// SPDX-License-Identifier: Apache-2.0
#include "session/maps/survey_map_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/stages/observe.h"
#include "pipeline/tasks/join_tracks.h"
#include "publish/maps/chart_layers.h"
#include "session/looks/screen_theme.h"
#include "view/school_look.h"

namespace sonar {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSmallMargin = 0.16;    ///< room for the scale bars beside the survey
constexpr double kLegendFrom_em = 56.0;  ///< a narrower map has no room for a legend

bool within(const GeoExtent& inner, const GeoExtent& outer) {
  const auto inside = [&](double latitude, double longitude) { return outer.contains({latitude, longitude}); };
  return inside(inner.south_deg, inner.west_deg) && inside(inner.north_deg, inner.east_deg);
}

/// Whether a raster that was read for one extent is still fine enough for another.
bool fits(const std::optional<GeoExtent>& read, const GeoExtent& shown) {
  constexpr double kCoarse = 3.0;
  return read && within(shown, *read) &&
         read->north_deg - read->south_deg < kCoarse * (shown.north_deg - shown.south_deg);
}

std::int64_t first_ping(const ObservationProduct& product, std::int64_t school) {
  const auto row = std::lower_bound(product.school_pings.begin(), product.school_pings.end(), school,
                                    [](const SchoolPingRow& r, std::int64_t id) { return r.school_id < id; });
  return row == product.school_pings.end() ? 0 : row->ping_index;
}

}  // namespace

bool SurveyMapPainter::know(const SurveyMapWish& wish) {
  const std::size_t count = wish.survey->observations.size();
  if (survey_ != wish.survey) {
    survey_ = wish.survey;
    light_.clear();
    for (const ObservationFiles& observation : survey_->observations) {
      light_.push_back(observation_head(observation));
    }
    products_.assign(count, nullptr);
    outlined_.assign(count, nullptr);
    outlines_.assign(count, {});
    swept_known_.assign(count, false);
    raster_extent_.reset();
    recipe_.clear();
    currents_.reset();
  }
  if (products_ != wish.products || numbers_ != wish.numbers) take_products(wish);
  bool more = false;
  for (std::size_t i = 0; i < count; ++i) more = more || !swept_known_[i] || outlined_[i] != products_[i];
  return !more;
}

void SurveyMapPainter::take_products(const SurveyMapWish& wish) {
  products_ = wish.products;
  numbers_ = wish.numbers;
  for (std::size_t i = 0; i < light_.size(); ++i) {
    ObservationProduct& light = light_[i];
    light.schools.clear();
    light.school_pings.clear();
    if (!products_[i]) continue;
    light.schools = products_[i]->schools;
    light.school_pings = products_[i]->school_pings;
    light.source = products_[i]->source;
    light.cut_after = products_[i]->cut_after;
    // Its recipe may turn the beams with the ship.
    if (light.recipe_json != products_[i]->recipe_json) swept_known_[i] = false;
    light.recipe_json = products_[i]->recipe_json;
  }
  take_currents();
  join_over_cuts(light_);
  number_known(light_, numbers_, wish.all_measured);
}

/// Of the first that is measured: all are measured by one recipe.
void SurveyMapPainter::take_currents() {
  for (std::size_t i = 0; i < light_.size(); ++i) {
    if (!products_[i]) continue;
    if (recipe_ == light_[i].recipe_json) return;
    recipe_ = light_[i].recipe_json;
    currents_ = map_currents(light_[i]);
    return;
  }
}

bool SurveyMapPainter::know_more(const SurveyMapWish& wish, const CancelToken& token) {
  for (std::size_t i = 0; i < light_.size(); ++i) {
    if (token.cancelled()) return false;
    outlines_[i].observation = light_[i].observation;
    if (products_[i] && outlined_[i] != products_[i]) {
      outlines_[i] = school_outlines(*products_[i], outlined_[i].get(), outlines_[i]);
    }
    outlined_[i] = products_[i];
  }
  for (std::size_t i = 0; i < light_.size(); ++i) {
    if (token.cancelled()) return false;
    if (swept_known_[i]) continue;
    if (wish.style.swept) outlines_[i].swept = swept_area(light_[i]);
    swept_known_[i] = true;
  }
  return true;
}

const DepthGrid* SurveyMapPainter::depths(const SurveyMapWish& wish, const MapFrame& map, std::string& note) {
  if (wish.depth_raster.empty()) return nullptr;
  const GeoExtent shown = shown_extent(map);
  if (raster_ != wish.depth_raster || !fits(raster_extent_, shown)) {
    raster_ = wish.depth_raster;
    raster_extent_ = shown;
    auto read = map_depths(raster_, shown);
    depths_.reset();
    raster_problem_ = read ? std::string{} : to_line(read.error());
    if (read) depths_ = std::move(*read);
  }
  note = raster_problem_;
  return depths_ ? &*depths_ : nullptr;
}

Result<SurveyMapPainter::Painted> SurveyMapPainter::painted(const SurveyMapWish& wish, PixelSize size) {
  const Theme theme = dock_theme(size, wish.look);
  SurveyMapStyle style = wish.style;
  style.currents = currents_;
  style.legend = size.width > kLegendFrom_em * theme.text_px;
  if (!style.legend) style.margin = kSmallMargin;
  auto map = survey_chart(light_, outlines_, style, size, theme);
  if (!map) return fail(ErrorCode::not_found, "no ping of the survey has a position: there is nothing to map");
  std::string note;
  const DepthGrid* grid = depths(wish, *map, note);
  auto frame = survey_map(light_, outlines_, grid, style, size, theme, note);
  if (!frame) return pass_on(frame);
  auto places = std::make_shared<SurveyMapPlaces>();
  places->scale = wish.look.scale;
  places->whole_metres_per_px = map->metres_per_px * style.zoom.factor;
  const SchoolLook look(light_, style, theme);
  for (std::size_t i = 0; i < light_.size(); ++i) {
    for (const SchoolRow& school : light_[i].schools) {
      if (!look.shown(school) || !std::isfinite(school.latitude) || !std::isfinite(school.longitude)) continue;
      const auto at = map->at(Geographic{school.latitude, school.longitude});
      if (!at) continue;
      places->schools.push_back({{i, school.school_id},
                                 first_ping(*products_[i], school.school_id),
                                 *at,
                                 look.radius_px(look.backscatter_m2(school))});
    }
    auto& track = places->tracks.emplace_back();
    for (const PingNavigation& n : light_[i].pings) {
      const auto at = n.has_position() ? map->at(n.transducer) : std::nullopt;
      track.push_back(at.value_or(PixelPoint{kNone, kNone}));
    }
  }
  places->map = std::make_shared<const MapFrame>(std::move(*map));
  return Painted{std::move(*frame), std::move(places)};
}

Result<void> SurveyMapPainter::paint(const SurveyMapWish& wish, PixelSize size, const CancelToken& token,
                                     const Show& show) {
  const bool complete = know(wish);
  auto first = painted(wish, size);
  if (!first) return pass_on(first);
  show(std::move(*first));
  if (complete || !know_more(wish, token)) return {};
  auto second = painted(wish, size);
  if (!second) return pass_on(second);
  show(std::move(*second));
  return {};
}

}  // namespace sonar
