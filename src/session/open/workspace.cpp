// SPDX-License-Identifier: Apache-2.0
#include "session/open/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/time.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "publish/reports/sample_looks.h"
#include "session/looks/curves.h"
#include "session/looks/place_text.h"
#include "session/slices/slice_places.h"
#include "view/slices/slice_picture.h"

namespace sonar {
namespace {

constexpr double kMostOpacity = 0.9;  // as pictures of volumes have it

TransferFunction first_view_curve() {
  auto curve = transfer_function(SvScale{}, kMostOpacity);
  return curve ? std::move(*curve) : TransferFunction{};
}

bool still_there(const std::optional<ChosenMark>& mark, const Document& document) {
  if (!mark) return true;
  const JournalState& state = document.state(mark->observation);
  const auto holds = [](const auto& list, const auto& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  };
  if (const auto* event = std::get_if<EventCommand>(&mark->what)) return holds(state.events, *event);
  return holds(state.bad_pings, std::get<BadPingsCommand>(mark->what));
}

bool still_there(const std::optional<EchoName>& echo, const Document& document) {
  if (!echo) return true;
  const auto& rows = *document.refused(echo->observation);
  return std::any_of(rows.begin(), rows.end(), [&](const RefusedEcho& row) { return row.echo_id == echo->id; });
}

/// Of several schools those that are there; one alone is no choice of several.
std::set<SchoolName> still_there(const std::set<SchoolName>& chosen, const Document& document) {
  std::set<SchoolName> there;
  for (const auto& [index, state] : document.choices().states) {
    if (!state || chosen.empty()) continue;
    for (const auto& school : state->schools) {
      const SchoolName name{index, school->number};
      if (chosen.contains(name)) there.insert(name);
    }
  }
  return there.size() > 1 ? there : std::set<SchoolName>{};
}

/// "school 3, f 0.82"; empty where nobody has the voxel.
std::string school_text(const JournalState& state, std::int64_t ping_index, int row, int sample) {
  for (const auto& school : state.schools) {
    const auto* there = in_ping(school->masks, ping_index);
    const int q = there == nullptr ? 0 : confidence_at(there->mask, row, sample);
    if (q > 0) return fmt::format("{}, f {:.2f}", school_title(*school), q / 255.0);
  }
  return {};
}

/// As the pictures have it.
std::int16_t shown_count(const StagedPing& staged, const DisplayParams& display, const Voxel& voxel) {
  const auto flags = staged.filtered->flags.view();
  const bool flagged = flags.shape() == staged.sv.counts.shape();
  const SampleFlags why = flagged ? flags(voxel.fan, voxel.beam, voxel.sample) & kNotFiltered : SampleFlags::none;
  const bool back = any(why) && (why & put_back(display)) == why;
  const Volume& volume = display.filtered && !back ? *staged.filtered : staged.sv;
  return volume.counts.view()(voxel.fan, voxel.beam, voxel.sample);
}

}  // namespace

Workspace::Workspace(ChangeQueue& changes, DocumentOptions options)
    : queue(changes),
      document(changes, std::move(options)),
      display(changes),
      select(changes),
      volume(changes),
      timelines(changes),
      views(changes),
      picture_file(changes),
      reduce(changes),
      integrate(changes),
      fish(changes),
      plane(changes),
      window(changes),
      figure(changes),
      view_curve(first_view_curve()) {
  listening_.to(document.changes(), [this, last = std::make_shared<std::weak_ptr<const int>>()](DocumentChange change) {
    if (change != DocumentChange::observation && change != DocumentChange::survey) return;
    const auto& shown = document.shown();
    const auto identity = shown ? shown->identity() : nullptr;
    // One more observation is open, or another calibration chosen: what is looked at is the same.
    if (change == DocumentChange::observation && last->lock() == identity) return;
    *last = identity;
    cursor.set(std::nullopt);
    preview.set({});
    if (!shown) return;
    const Sector& sector = shown->sector();
    slices.set({sector.fans() / 2, sector.beams() / 2, sector.range().count / 2});
    lay_plane(*this);
  });
  listening_.to(display.changed(), [this](const DisplayParams& params) {
    // A curve that a human drew keeps its shape and takes the scale's colours.
    auto curve = curve_follows_scale()
                     ? transfer_function(params.scale, kMostOpacity)
                     : curve_of(params.scale, corners_of(view_curve()), view_curve().opacity_length_m());
    if (curve) view_curve.set(std::move(*curve));
  });
  listening_.to(school.changed(), [this] {
    mark.set(std::nullopt);
    if (!school() || !chosen_schools().contains(*school())) chosen_schools.set({});
  });
  listening_.to(document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey || (change == DocumentChange::state && !still_there(mark(), document))) {
      mark.set(std::nullopt);
    }
    if (change == DocumentChange::survey || (change == DocumentChange::state && !still_there(echo(), document))) {
      echo.set(std::nullopt);
    }
    if (change == DocumentChange::survey) chosen_schools.set({});
    if (change == DocumentChange::state) chosen_schools.set(still_there(chosen_schools(), document));
  });
  listening_.to(window.changed(), [this](const WindowParams& params) { units.set(params.units); });
  listening_.to(view_curve.changed(), [this] { link(true); });
  listening_.to(growth_curve.changed(), [this] { link(false); });
  listening_.to(curves_linked.changed(), [this] { link(true); });
}

void Workspace::link(bool from_view) {
  if (!curves_linked() || linking_) return;
  linking_ = true;
  if (from_view) {
    if (auto curve = growth_curve_of(corners_of(view_curve()))) growth_curve.set(std::move(*curve));
  } else if (auto curve =
                 curve_of(display.values().scale, corners_of(growth_curve()), view_curve().opacity_length_m())) {
    curve_follows_scale.set(false);
    view_curve.set(std::move(*curve));
  }
  linking_ = false;
}

std::optional<std::size_t> Workspace::selected() const {
  if (!school() || !document.shown() || school()->observation != document.shown()->index()) return std::nullopt;
  const auto& schools = document.state().schools;
  const auto found =
      std::find_if(schools.begin(), schools.end(), [&](const auto& one) { return one->number == school()->number; });
  return found == schools.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - schools.begin()));
}

double shown_sv_db(const Workspace& workspace, const Voxel& voxel) {
  const auto& staged = workspace.document.staged();
  const std::int16_t count = staged ? shown_count(*staged, workspace.display.values(), voxel) : kNoData;
  return count == kNoData ? kUnknown : db_from_counts(count);
}

ReadOut read_out(const Workspace& workspace, const Voxel& voxel) {
  ReadOut text;
  const auto& shown = workspace.document.shown();
  if (!shown) return text;
  const Sector& sector = shown->sector();
  if (voxel.fan < 0 || voxel.fan >= sector.fans() || voxel.beam < 0 || voxel.beam >= sector.beams() ||
      voxel.sample < 0 || voxel.sample >= sector.range().count) {
    return text;
  }
  const std::int64_t ping = workspace.document.ping();
  const int row = voxel.fan * sector.beams() + voxel.beam;
  text.fan = fmt::format("fan {}", voxel.fan);
  text.beam = fmt::format("beam {}", voxel.beam);
  text.sample = fmt::format("sample {}", voxel.sample);
  const PingNavigation& navigation = shown->files().navigation[static_cast<std::size_t>(ping)];
  const Placement placement = shown->placement(ping);
  const Point<Sonar> place = levelled(sector.centre(voxel.fan, voxel.beam, voxel.sample), placement);
  const Unit length = workspace.units().length();
  text.range = "range " + quantity_text(norm(place), 1, length);
  text.depth = "depth " + quantity_text(place.z + placement.transducer_depth_m, 1, length);
  text.time = time_text(navigation.time);
  if (!std::isnan(navigation.speed_mps)) {
    text.ship = "ship " + quantity_text(navigation.speed_mps, 1, workspace.units().ship_speed());
  }
  if (!std::isnan(navigation.distance_nmi)) text.log = fmt::format("log {:.3f} nmi", navigation.distance_nmi);
  const double bow_deg = deg_from_rad(std::atan2(place.y, place.x));
  const bool headed = !std::isnan(navigation.heading_deg);
  text.bearing = headed ? fmt::format("bearing {:05.1f}\u00B0", wrap_360(bow_deg + navigation.heading_deg))
                        : fmt::format("bow {:+.1f}\u00B0", wrap_180(bow_deg));
  if (navigation.has_position() && headed) {
    const Geographic there = to_geographic(to_enu(place, placement.heading_rad), placement.transducer);
    text.latitude = latitude_minutes_text(there.latitude_deg);
    text.longitude = longitude_minutes_text(there.longitude_deg);
  }
  if (const auto& staged = workspace.document.staged(); staged && staged->ping_index == ping) {
    const double sv_db = shown_sv_db(workspace, voxel);
    text.sv = std::isnan(sv_db) ? "Sv none" : fmt::format("Sv {:.1f} dB", sv_db);
    if (staged->filtered->flags.shape() == staged->sv.counts.shape()) {
      text.flags = flag_text(staged->filtered->flags.view()(voxel.fan, voxel.beam, voxel.sample));
    }
  }
  text.school = school_text(workspace.document.state(), ping, row, voxel.sample);
  return text;
}

std::string ReadOut::line() const {
  std::string all;
  for (const std::string* part : std::array{&sv, &fan, &beam, &sample, &range, &depth, &bearing, &latitude, &longitude,
                                            &time, &flags, &school, &ship, &log}) {
    if (part->empty()) continue;
    if (!all.empty()) all += ", ";
    all += *part;
  }
  return all;
}

}  // namespace sonar
