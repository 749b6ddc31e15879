// SPDX-License-Identifier: Apache-2.0
#include "session/maps/observation_map_painter.h"

#include <limits>
#include <utility>

#include "pipeline/stages/observe.h"
#include "pipeline/stages/placements.h"
#include "session/looks/screen_theme.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Result<void> ObservationMapPainter::lay_out(const ObservationMapWish& wish, PixelSize size) {
  const bool other = observation_ != wish.observation;
  if (!other && base_ && base_->size == size && look_ == wish.look && zoom_ == wish.zoom) return {};
  if (other) head_ = observation_head(wish.observation->files());
  base_.reset();
  observation_ = wish.observation;
  const auto placed = [recipe = observation_->recipe(), rays = observation_->rays()](const PingNavigation& ping) {
    return placement_under(recipe, ping, rays);
  };
  auto base = observation_map_base(head_, size, dock_theme(size, wish.look), wish.zoom, false, false, placed);
  if (!base) return pass_on(base);
  base_ = std::move(*base);
  look_ = wish.look;
  zoom_ = wish.zoom;
  map_ = std::make_shared<const MapFrame>(base_->map);
  std::vector<PixelPoint> track;
  for (const PingNavigation& n : head_.pings) {
    const auto at = n.has_position() ? base_->map.at(n.transducer) : std::nullopt;
    track.push_back(at.value_or(PixelPoint{kNone, kNone}));
  }
  track_ = std::make_shared<const std::vector<PixelPoint>>(std::move(track));
  mosaic_.start(empty_mosaic(*base_, head_.pings.size()));
  return {};
}

Result<ObservationMapPainter::Painted> ObservationMapPainter::paint(const ObservationMapWish& wish, PixelSize size) {
  if (auto done = lay_out(wish, size); !done) return pass_on(done);
  base_->searched = wish.searched;
  auto places = std::make_shared<ObservationMapPlaces>();
  MaskedPings masks = masked_pings(wish.state, wish.running, wish.rejected, wish.carried);
  if (wish.state) {
    for (const auto& school : wish.state->schools) places->numbers.push_back(school->number);
  }
  places->pings_set = mosaic_.follow(observation_->sector(), head_.pings, std::move(masks));
  const MaskMosaic& mosaic = mosaic_.mosaic();
  const ObservationProduct& shown = wish.product ? *wish.product : head_;
  Painted painted;
  // Those that are not measured yet are there as well.
  const std::int64_t schools = wish.state ? school_count(*wish.state, wish.product) : school_count(shown);
  painted.frame = observation_map(*base_, shown, mosaic, static_cast<std::size_t>(wish.ping), wish.palette,
                                  static_cast<std::size_t>(schools));
  if (wish.product) {
    const PingNavigation& current = shown.pings[static_cast<std::size_t>(wish.ping)];
    add_map_schools(painted.frame, *base_, map_schools(shown, wish.selected, wish.rejected),
                    current.has_position() ? base_->map.at(current.transducer) : std::nullopt);
  }
  places->refused = add_map_refused(painted.frame, *base_, *wish.refused, wish.chosen_echo);
  places->observation = observation_->index();
  places->map = map_;
  places->scale = wish.look.scale;
  places->whole_metres_per_px = map_->metres_per_px * wish.zoom.factor;
  places->track = track_;
  places->cell_px = mosaic.cell_px();
  places->width = mosaic.width();
  places->height = mosaic.height();
  places->cells = mosaic.cells();
  places->cells_touched = mosaic.cells_touched();
  painted.places = std::move(places);
  return painted;
}

}  // namespace sonar
