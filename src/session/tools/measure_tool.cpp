// SPDX-License-Identifier: Apache-2.0
#include "session/tools/measure_tool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"
#include "session/tools/brush_tool.h"
#include "view/slices/slice_area.h"

namespace sonar {
namespace {

using Shape = Measurement::Shape;

bool heading_known(const OpenObservation& observation, std::int64_t ping) {
  return std::isfinite(observation.files().navigation[static_cast<std::size_t>(ping)].heading_deg);
}

/// The ping's schools that take sound out of its beams: none that a human rejected.
std::vector<const PingMask*> schools_in(const Document& document, std::int64_t ping_index) {
  std::vector<const PingMask*> masks;
  for (const auto& school : document.state().schools) {
    if (school->masks.decided.status == "rejected") continue;
    if (const auto* there = in_ping(school->masks, ping_index)) masks.push_back(&there->mask);
  }
  return masks;
}

AreaFigures area_of(const Workspace& workspace, const Measurement& measured) {
  const OpenObservation& observation = *workspace.document.shown();
  const StagedPing& ping = *workspace.document.staged();
  const bool through = workspace.measure_all_fans() && std::holds_alternative<TopSlice>(*measured.slice);
  const auto runs = runs_within(observation.sector(), *measured.slice, measured.outline, through);
  const PingMask mask = that_can_belong(runs, ping.filtered->flags.view());
  AreaFigures area;
  for (const Run& run : runs) area.never += run.count;
  area.never -= static_cast<std::int64_t>(mask.voxels());
  const Placement placement = observation.placement(ping.ping_index);
  area.statistics = statistics_of(mask, ping, observation.sector(), placement);
  if (const ExtinctionParams& extinction = observation.recipe().measure.extinction; extinction.correct) {
    const double heard_m2 = area.statistics.echo.backscatter_m2;
    area.statistics = corrected_statistics_of(mask, ping, observation.sector(), placement,
                                              schools_in(workspace.document, ping.ping_index), extinction);
    area.extinction_db = db_from_linear(area.statistics.echo.backscatter_m2 / heard_m2);
  }
  if (through) area.fans = observation.sector().fans();
  return area;
}

}  // namespace

bool on_show(const Workspace& workspace, const Measurement& measured) {
  if (measured.on == Measurement::On::map) return true;
  const auto& shown = workspace.document.shown();
  return shown && shown->identity() == measured.observation && workspace.document.ping() == measured.ping;
}

std::string measured_text(const Workspace& workspace) {
  const auto& measured = workspace.measurement();
  return measured && on_show(workspace, *measured) ? whole_text(*measured, workspace.units()) : std::string{};
}

MeasuredEnd end_at(const Workspace& workspace, const Point<Sonar>& place, std::optional<Voxel> voxel) {
  const auto& observation = workspace.document.shown();
  const std::int64_t ping = workspace.document.staged()->ping_index;
  const Placement placement = observation->placement(ping);
  const Point<Sonar> level = levelled(place, placement);
  MeasuredEnd end;
  end.place = place;
  end.voxel = voxel;
  end.depth_m = level.z + placement.transducer_depth_m;
  if (voxel) end.sv_db = shown_sv_db(workspace, *voxel);
  const bool placed = observation->files().navigation[static_cast<std::size_t>(ping)].has_position();
  if (placed && heading_known(*observation, ping)) {
    end.where = to_geographic(to_enu(level, placement.heading_rad), placement.transducer);
  }
  return end;
}

Measurement of_ping(const Workspace& workspace, Measurement::On on) {
  Measurement measured;
  measured.on = on;
  measured.observation = workspace.document.shown()->identity();
  measured.name = workspace.document.shown()->name();
  measured.ping = workspace.document.staged()->ping_index;
  return measured;
}

bool has_ping(const Workspace& workspace) { return workspace.document.shown() && workspace.document.staged(); }

Measurement figured(const Workspace& workspace, Measurement measured) {
  const OpenObservation& observation = *workspace.document.shown();
  const std::int64_t ping = workspace.document.staged()->ping_index;
  if (measured.shape != Shape::line) {
    measured.area = area_of(workspace, measured);
  } else if (measured.ends) {
    for (MeasuredEnd& end : *measured.ends) end = end_at(workspace, *end.place, end.voxel);
    measured.line = line_figures(measured.ends->front(), measured.ends->back(), observation.placement(ping),
                                 heading_known(observation, ping));
  }
  return measured;
}

MeasureTool::MeasureTool(Workspace& workspace) : workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.tool.changed(), [this] {
    if (drawing()) cancel();
  });
  listening_.to(workspace.measure_all_fans.changed(), [this] { measure_again(); });
  listening_.to(workspace.display, [this] { measure_again(); });
}

bool MeasureTool::drawing() const { return workspace_.measurement() && workspace_.measurement()->drawing; }

void MeasureTool::hear(DocumentChange change) {
  if (change == DocumentChange::survey) return cancel();
  const auto& measured = workspace_.measurement();
  if (!measured || measured->on == Measurement::On::map) return;
  const auto& shown = workspace_.document.shown();
  if (change == DocumentChange::observation && (!shown || shown->identity() != measured->observation)) return cancel();
  // Another calibration stages the same ping anew.
  const bool corrected = measured->area.extinction_db.has_value();  // other schools take out other sound
  if (change == DocumentChange::ping || change == DocumentChange::observation ||
      (corrected && change == DocumentChange::state)) {
    measure_again();
  }
}

void MeasureTool::measure_again() {
  const auto& measured = workspace_.measurement();
  if (!measured || measured->on == Measurement::On::map || !has_ping(workspace_)) return;
  if (!on_show(workspace_, *measured) || workspace_.document.staged()->ping_index != measured->ping) return;
  workspace_.measurement.set(figured(workspace_, *measured));
}

void measure_voxel(Workspace& workspace, const Voxel& voxel) {
  if (!has_ping(workspace)) return;
  const auto& before = workspace.measurement();
  const bool second = before && before->on == Measurement::On::volume && before->drawing && on_show(workspace, *before);
  if (second) {
    hover_voxel(workspace, voxel);
    Measurement done = *workspace.measurement();
    done.drawing = false;
    return workspace.measurement.set(std::move(done));
  }
  const Point<Sonar> place = workspace.document.shown()->sector().centre(voxel.fan, voxel.beam, voxel.sample);
  Measurement begun = of_ping(workspace, Measurement::On::volume);
  begun.drawing = true;
  begun.ends = {end_at(workspace, place, voxel), end_at(workspace, place, voxel)};
  workspace.measurement.set(figured(workspace, std::move(begun)));
}

void hover_voxel(Workspace& workspace, const Voxel& voxel) {
  const auto& before = workspace.measurement();
  if (!before || before->on != Measurement::On::volume || !before->drawing) return;
  if (!on_show(workspace, *before) || !has_ping(workspace)) return;
  Measurement measured = *before;
  measured.ends->back().place = workspace.document.shown()->sector().centre(voxel.fan, voxel.beam, voxel.sample);
  measured.ends->back().voxel = voxel;
  workspace.measurement.set(figured(workspace, std::move(measured)));
}

std::vector<Overlay> measured_overlays(const Measurement& measured, const std::vector<PixelPoint>& at,
                                       const PixelRect& plot, const Units& units) {
  if (at.empty()) return {};
  const bool line = measured.shape == Shape::line;
  PixelPoint low = at.front();
  PixelPoint high = at.front();
  for (const PixelPoint& p : at) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // Zoomed so that none of it is in sight.
  if (high.x < plot.x || low.x > plot.x + plot.width || high.y < plot.y || low.y > plot.y + plot.height) return {};
  std::vector<Overlay> over(1);
  over.front().line = at;
  if (!line) over.front().line.push_back(at.front());
  over.front().dashed = !line;
  over.front().clip = plot;
  over.front().text = brief_text(measured, units);
  over.front().beside = {low.x, low.y, high.x - low.x, high.y - low.y};
  for (std::size_t i = 0; line && i < at.size(); ++i) {
    Overlay cross;
    cross.cross = at[i];
    cross.clip = plot;
    over.push_back(std::move(cross));
  }
  return over;
}

}  // namespace sonar
