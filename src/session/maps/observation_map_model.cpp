// SPDX-License-Identifier: Apache-2.0
#include "session/maps/observation_map_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/geodesic.h"
#include "session/looks/place_text.h"
#include "session/looks/screen_theme.h"
#include "session/maps/observation_map_painter.h"
#include "session/open/survey_schools.h"
#include "session/review/refused_layer.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr double kTrackReach_px = 6.0;
constexpr double kCellReach_px = 4.0;

/// Where on the globe the linked cursor is; empty without one, or without position or heading.
std::optional<Geographic> cursor_place(const Workspace& workspace) {
  const auto& voxel = workspace.cursor();
  const auto& shown = workspace.document.shown();
  if (!voxel || !shown) return std::nullopt;
  const Sector& sector = shown->sector();
  if (voxel->fan < 0 || voxel->fan >= sector.fans() || voxel->beam < 0 || voxel->beam >= sector.beams() ||
      voxel->sample < 0 || voxel->sample >= sector.range().count) {
    return std::nullopt;
  }
  const PingNavigation& navigation = shown->files().navigation[static_cast<std::size_t>(workspace.document.ping())];
  if (!navigation.has_position() || !std::isfinite(navigation.heading_deg)) return std::nullopt;
  const Placement placement = shown->placement(workspace.document.ping());
  const Point<Sonar> place = levelled(sector.centre(voxel->fan, voxel->beam, voxel->sample), placement);
  return to_geographic(to_enu(place, placement.heading_rad), placement.transducer);
}

}  // namespace

std::int64_t ObservationMapPlaces::school_at(PixelPoint at) const {
  if (cells.empty()) return 0;
  // A school may be a few cells: the surest within reach counts, the nearest first.
  const int reach = std::max(1, static_cast<int>(kCellReach_px * scale / cell_px));
  const int x = static_cast<int>(std::floor((at.x - map->place.x) / cell_px));
  const int y = static_cast<int>(std::floor((at.y - map->place.y) / cell_px));
  for (int r = 0; r <= reach; ++r) {
    MaskMosaic::Cell best = 0;
    for (int j = std::max(0, y - r); j <= std::min(height - 1, y + r); ++j) {
      for (int i = std::max(0, x - r); i <= std::min(width - 1, x + r); ++i) {
        best = std::max(
            best, cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
      }
    }
    if (best == 0) continue;
    const auto found = std::find_if(numbers.begin(), numbers.end(), [&](std::int64_t number) {
      return static_cast<int>(number % MaskMosaic::kSchools) == MaskMosaic::school(best);
    });
    return found == numbers.end() ? 0 : *found;
  }
  return 0;
}

std::optional<std::int64_t> ObservationMapPlaces::ping_at(PixelPoint at, double reach_px) const {
  std::optional<std::int64_t> nearest;
  double best = reach_px;
  for (std::size_t i = 0; track && i < track->size(); ++i) {
    const double away = std::hypot((*track)[i].x - at.x, (*track)[i].y - at.y);
    if (!(away <= best)) continue;
    best = away;
    nearest = static_cast<std::int64_t>(i);
  }
  return nearest;
}

ObservationMapModel::ObservationMapModel(Workspace& workspace)
    : LivePicture(workspace), workspace_(workspace), painter_(std::make_shared<ObservationMapPainter>()) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.cursor.changed(), [this] { changed().tell(); });
  listening_.to(workspace.tool.changed(), [this] { changed().tell(); });
  listening_.to(workspace.measurement.changed(), [this] { changed().tell(); });
  listening_.to(workspace.school.changed(), [this] { update(); });
  listening_.to(workspace.echo.changed(), [this] { update(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
}

void ObservationMapModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation:
      running_.clear();
      if (places_ && workspace_.document.shown() && places_->observation != workspace_.document.shown()->index()) {
        gesture_.reset();
      }
      places_.reset();
      return update();
    case DocumentChange::propagating:
      keep_running(running_, workspace_.document.propagating());
      return update();
    case DocumentChange::looking:
    case DocumentChange::ping:
    case DocumentChange::state:
    case DocumentChange::measures:
      return update();
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

LivePicture::Build ObservationMapModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown()) return {};
  ObservationMapWish wish;
  wish.observation = document.shown();
  const std::size_t index = wish.observation->index();
  wish.product = document.product(index);
  if (const auto found = document.choices().states.find(index); found != document.choices().states.end()) {
    wish.state = found->second;
  }
  wish.running = running_;
  wish.carried = workspace_.document.followed();
  wish.ping = document.ping();
  if (workspace_.school() && workspace_.school()->observation == index) wish.selected = workspace_.school()->number;
  const DisplayParams& display = workspace_.display.values();
  wish.rejected = display.rejected;
  wish.searched = document.detected(index);
  wish.refused = refused_layer(workspace_, index);
  wish.chosen_echo = chosen_echo(workspace_, index);
  wish.palette.core_at = display.core_at;
  wish.palette.fuzzy_above = display.fuzzy_above;
  if (wish.state) wish.palette.rejected = rejected_schools(*wish.state);
  wish.look = look;
  wish.zoom = gesture_.zoom();
  return [painter = look.panel ? std::make_shared<ObservationMapPainter>() : painter_, wish = std::move(wish)](
             PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    auto painted = painter->paint(wish, size);
    if (!painted) return pass_on(painted);
    show({std::move(painted->frame), std::nullopt, std::move(painted->places)});
    return {};
  };
}

void ObservationMapModel::take(const std::shared_ptr<const void>& detail) {
  places_ = std::static_pointer_cast<const ObservationMapPlaces>(detail);
}

void ObservationMapModel::show_all() {
  gesture_.reset();
  update();
}

void ObservationMapModel::pointer(const PointerEvent& event) {
  if (!places_ || !places_->map) return;
  const MapMeasure::Did measured = measure_.take(event, *places_->map, scale());
  if (measured == MapMeasure::Did::clicked) return click(event.at);
  if (measured == MapMeasure::Did::taken) return;
  switch (gesture_.take(event, places_->map->place, places_->whole_metres_per_px, scale())) {
    case MapGesture::Did::moved:
      return update();
    case MapGesture::Did::clicked:
      return click(event.at);
    case MapGesture::Did::nothing:
      return;
  }
}

bool ObservationMapModel::aim(PixelPoint at) {
  if (!places_ || !places_->map) return true;
  const bool school = places_->school_at(at) != 0;
  click(at);
  return school;
}

std::optional<EchoName> ObservationMapModel::echo_at(PixelPoint at) const {
  const auto id = mark_at(places_->refused, at, mark_reach_px(dock_theme(size(), scale(), workspace_.dark())));
  return id ? std::optional(EchoName{places_->observation, *id}) : std::nullopt;
}

void ObservationMapModel::click(PixelPoint at) {
  const auto& shown = workspace_.document.shown();
  if (!shown || shown->index() != places_->observation) return;
  if (const auto echo = echo_at(at)) return go_to_echo(workspace_, *echo);
  if (const auto ping = places_->ping_at(at, kTrackReach_px * scale())) return workspace_.document.look_at(*ping);
  if (const std::int64_t school = places_->school_at(at)) workspace_.school.set(SchoolName{shown->index(), school});
}

std::vector<Overlay> ObservationMapModel::overlays() const {
  if (!places_ || !places_->map) return {};
  std::vector<Overlay> over = measure_.overlays(*places_->map);
  const auto there = cursor_place(workspace_);
  const auto at = there ? places_->map->at(*there) : std::nullopt;
  if (!at || !inside(places_->map->place, *at)) return over;
  Overlay cross;
  cross.cross = *at;
  over.push_back(std::move(cross));
  return over;
}

PointerShape ObservationMapModel::pointer_shape() const {
  return workspace_.tool() == ToolName::measure ? PointerShape::cross : PointerShape::arrow;
}

std::string ObservationMapModel::hint(PixelPoint at) const {
  const auto& shown = workspace_.document.shown();
  if (!places_ || !places_->map || !shown) return {};
  std::string text;
  if (const auto echo = echo_at(at)) {
    text = why_no_school(workspace_.document, *echo) + "\nclick goes there\n";
  } else if (const auto ping = places_->ping_at(at, kTrackReach_px * scale())) {
    const TimeNs time = shown->files().navigation[static_cast<std::size_t>(*ping)].time;
    text = fmt::format("ping {}, {} UTC\n", *ping, clock_text(time, true));
  } else if (const std::int64_t school = places_->school_at(at)) {
    text = title_of(workspace_.document, {shown->index(), school}) + "\n";
  }
  const auto there = places_->map->geographic(at);
  if (!there) return text;
  return text + latitude_minutes_text(there->latitude_deg) + ", " + longitude_minutes_text(there->longitude_deg);
}

}  // namespace sonar
