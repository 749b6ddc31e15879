// SPDX-License-Identifier: Apache-2.0
#include "session/maps/survey_map_model.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "geo/geodesic.h"
#include "session/looks/place_text.h"
#include "session/looks/selection.h"
#include "session/maps/survey_map_painter.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

constexpr double kSchoolReach_px = 9.0;
constexpr double kTrackReach_px = 7.0;
constexpr double kRing_px = 9.0;

const std::shared_ptr<const SurveyFiles>& mapped(const Document& document) {
  return document.glance() ? document.glance() : document.survey_files();
}

/// Opens the observation where needed.
void look_at_ping(Document& document, std::size_t observation, std::int64_t ping) {
  if (document.glance()) return document.open_glanced(observation);
  const auto& shown = document.shown();
  if (!shown || shown->index() != observation) {
    if (const auto done = document.show(observation); !done) return document.tell(done.error().text);
  }
  document.look_at(ping);
}

}  // namespace

const SurveyMapPlaces::School* SurveyMapPlaces::school_at(PixelPoint at) const {
  const School* nearest = nullptr;
  double best = 1e300;
  for (const School& school : schools) {
    const double away = std::hypot(school.at.x - at.x, school.at.y - at.y);
    if (away > std::max(kSchoolReach_px * scale, school.radius_px) || away >= best) continue;
    best = away;
    nearest = &school;
  }
  return nearest;
}

std::optional<SurveyMapPlaces::Ping> SurveyMapPlaces::ping_at(PixelPoint at) const {
  std::optional<Ping> nearest;
  double best = kTrackReach_px * scale;
  for (std::size_t o = 0; o < tracks.size(); ++o) {
    for (std::size_t i = 0; i < tracks[o].size(); ++i) {
      const double away = std::hypot(tracks[o][i].x - at.x, tracks[o][i].y - at.y);
      if (!(away <= best)) continue;
      best = away;
      nearest = Ping{o, static_cast<std::int64_t>(i)};
    }
  }
  return nearest;
}

SurveyMapModel::SurveyMapModel(Workspace& workspace)
    : LivePicture(workspace), workspace_(workspace), painter_(std::make_shared<SurveyMapPainter>()) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.tool.changed(), [this] { changed().tell(); });
  listening_.to(workspace.measurement.changed(), [this] { changed().tell(); });
  listening_.to(workspace.school.changed(), [this] { changed().tell(); });
  listening_.to(workspace.chosen_schools.changed(), [this] { changed().tell(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.depth_raster.changed(), [this] { update(); });
  listening_.to(workspace.transects.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
}

void SurveyMapModel::hear(DocumentChange change) {
  const bool another = change == DocumentChange::survey || change == DocumentChange::glance;
  if (another) {
    gesture_.reset();
    places_.reset();
  }
  if (change == DocumentChange::ping || change == DocumentChange::looking)
    return changed().tell();  // the ship is an overlay
  if (another || change == DocumentChange::observation || change == DocumentChange::measures) {
    update();
  }
}

LivePicture::Build SurveyMapModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  // Where no observation can be looked at, or not yet, their tracks are what there is to see.
  if (!document.shown() && !document.glance() && document.nothing_shown().empty()) return {};
  SurveyMapWish wish;
  wish.survey = mapped(document);
  if (wish.survey->observations.empty()) return {};
  for (std::size_t i = 0; i < wish.survey->observations.size(); ++i) wish.products.push_back(document.product(i));
  wish.numbers = document.survey_numbers();
  wish.all_measured = document.all_measured();
  wish.depth_raster = workspace_.depth_raster();
  wish.style.transects = workspace_.transects().periods;
  wish.style.zoom = gesture_.zoom();
  wish.style.rejected = workspace_.display.values().rejected;
  wish.look = look;
  return [painter = look.panel ? std::make_shared<SurveyMapPainter>() : painter_, wish = std::move(wish)](
             PixelSize size, const CancelToken& token, const Show& show) {
    return painter->paint(wish, size, token, [&show](SurveyMapPainter::Painted painted) {
      show({std::move(painted.frame), std::nullopt, std::move(painted.places)});
    });
  };
}

void SurveyMapModel::take(const std::shared_ptr<const void>& detail) {
  places_ = std::static_pointer_cast<const SurveyMapPlaces>(detail);
}

void SurveyMapModel::show_all() {
  gesture_.reset();
  update();
}

void SurveyMapModel::pointer(const PointerEvent& event) {
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

bool SurveyMapModel::aim(PixelPoint at) {
  if (!places_ || !places_->map) return true;
  const bool school = places_->school_at(at) != nullptr;
  click(at);
  return school;
}

void SurveyMapModel::click(PixelPoint at) {
  if (const auto* school = places_->school_at(at)) {
    const SurveyMapPlaces::School clicked = *school;  // what follows may bring another picture
    look_at_ping(workspace_.document, clicked.name.observation, clicked.first_ping);
    return workspace_.school.set(clicked.name);
  }
  if (const auto ping = places_->ping_at(at)) look_at_ping(workspace_.document, ping->observation, ping->ping);
}

std::vector<Overlay> SurveyMapModel::overlays() const {
  std::vector<Overlay> out;
  const auto& shown = workspace_.document.shown();
  if (!places_ || !places_->map) return out;
  out = measure_.overlays(*places_->map);
  if (!shown) return out;
  const PixelRect& place = places_->map->place;
  const auto add = [&](PixelPoint at, bool cross) {
    if (!(at.x >= place.x && at.y >= place.y && at.x <= place.x + place.width && at.y <= place.y + place.height)) {
      return;
    }
    Overlay overlay;
    if (cross) overlay.cross = at;
    if (!cross) overlay.circle_at = at;
    overlay.circle_px = kRing_px * scale();
    out.push_back(std::move(overlay));
  };
  const auto ping = static_cast<std::size_t>(workspace_.document.ping());
  if (shown->index() < places_->tracks.size() && ping < places_->tracks[shown->index()].size()) {
    add(places_->tracks[shown->index()][ping], true);
  }
  const std::set<SchoolName> selected = selection(workspace_);
  for (const SurveyMapPlaces::School& school : places_->schools) {
    if (selected.contains(school.name)) add(school.at, false);
  }
  return out;
}

PointerShape SurveyMapModel::pointer_shape() const {
  return workspace_.tool() == ToolName::measure ? PointerShape::cross : PointerShape::arrow;
}

std::string SurveyMapModel::hint(PixelPoint at) const {
  const auto& survey = mapped(workspace_.document);
  if (!places_ || !places_->map || survey == nullptr) return {};
  const auto& observations = survey->observations;
  std::string text;
  if (const auto* school = places_->school_at(at); school != nullptr) {
    text = fmt::format("{}, {}\n", observations[school->name.observation].name,
                       title_of(workspace_.document, school->name));
  } else if (const auto ping = places_->ping_at(at)) {
    const std::string& name = observations[ping->observation].name;
    text =
        survey->from_ends ? name + ": a click opens its files alone\n" : fmt::format("{}, ping {}\n", name, ping->ping);
  }
  const auto there = places_->map->geographic(at);
  if (!there) return text;
  return text + latitude_minutes_text(there->latitude_deg) + ", " + longitude_minutes_text(there->longitude_deg);
}

}  // namespace sonar
