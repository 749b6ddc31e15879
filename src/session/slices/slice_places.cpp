// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "session/open/survey_schools.h"

namespace sonar {
namespace {

PlaneFrame frame_in(const Workspace& workspace, std::int64_t ping_index) {
  const auto& navigation = workspace.document.shown()->files().navigation;
  const auto ping = static_cast<std::size_t>(ping_index);
  return ping < navigation.size() ? plane_frame(navigation[ping]) : PlaneFrame{};
}

PlaneFrame frame_now(const Workspace& workspace) { return frame_in(workspace, workspace.document.ping()); }

bool* switch_of(ViewSwitches& views, SliceKind kind) {
  switch (kind) {
    case SliceKind::top:
      return &views.top_slice;
    case SliceKind::side:
      return &views.side_slice;
    case SliceKind::range:
      return &views.range_slice;
    case SliceKind::plane:
      break;
  }
  return &views.plane_slice;
}

std::string numbers_text(const Point<Sonar>& p) { return fmt::format("{:.3f},{:.3f},{:.3f}", p.x, p.y, p.z); }

/// A plane as it is asked for, in words and numbers.
PlaneSliceParams params_of(const PlanePlace& place, const PlaneSlice& plane, PlaneSliceParams params) {
  constexpr double kFar_m = 1000.0;  // what a millimetre turns is less than a pixel
  switch (place.lies) {
    case PlaneSlice::Kind::horizontal:
      params.plane = PlaneLies::horizontal;
      params.depth_m = place.depth_m;
      return params;
    case PlaneSlice::Kind::vertical: {
      // Along a bearing it would go through the sonar.
      const Point<Sonar> to = plane.origin + plane.right * kFar_m;
      params.plane = place.offset_m == 0.0 ? PlaneLies::along_bearing : PlaneLies::through_places;
      params.bearing_deg = place.bearing_deg;
      params.through = fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}", plane.origin.x, plane.origin.y, to.x, to.y);
      return params;
    }
    case PlaneSlice::Kind::oblique:
      break;
  }
  params.plane = PlaneLies::oblique;
  params.point = numbers_text(plane.origin);
  const auto& [d, r] = std::pair(plane.down, plane.right);  // their product points to the viewer
  params.normal =
      numbers_text(Point<Sonar>{d.y * r.z - d.z * r.y, d.z * r.x - d.x * r.z, d.x * r.y - d.y * r.x} * kFar_m);
  return params;
}

Voxel middle_voxel(const Sector& sector) { return {sector.fans() / 2, sector.beams() / 2, sector.range().count / 2}; }

}  // namespace

Slice live_slice(const Workspace& workspace, SliceKind kind, std::int64_t ping_index) {
  const SlicePlaces& places = workspace.slices();
  switch (kind) {
    case SliceKind::top:
      return TopSlice{places.fan};
    case SliceKind::side:
      return SideSlice{places.beam};
    case SliceKind::range:
      return RangeSlice{places.sample};
    case SliceKind::plane:
      break;
  }
  return plane_slice(workspace.plane.values(), frame_in(workspace, ping_index));
}

PictureParams at_live_places(const Workspace& workspace, PictureParams params) {
  const RangeAxis& range = workspace.document.shown()->sector().range();
  constexpr double kLeast_m = 1e-3;  // 0 asks for the largest school's
  params.slice_range.range_m = std::max(kLeast_m, range.range_m(workspace.slices().sample));
  const Slice plane = live_slice(workspace, SliceKind::plane, workspace.document.ping());
  params.slice_plane = params_of(workspace.plane.values(), std::get<PlaneSlice>(plane), params.slice_plane);
  return params;
}

bool switched_on(const Workspace& workspace, SliceKind kind) {
  ViewSwitches views = workspace.views.values();
  return *switch_of(views, kind);
}

void switch_on(Workspace& workspace, SliceKind kind) {
  ViewSwitches views = workspace.views.values();
  *switch_of(views, kind) = true;
  workspace.views.assign(views);
}

double slice_step_m(const Sector& sector) {
  const double wanted_m = std::max(1e-3, 0.01 * sector.range().range_m(sector.range().count));
  const double ten = std::pow(10.0, std::floor(std::log10(wanted_m)));
  const double share = wanted_m / ten;
  return ten * (share < 2.0 ? 1.0 : share < 5.0 ? 2.0 : 5.0);
}

void step_slice(Workspace& workspace, SliceKind kind, int by, bool fine) {
  const auto& shown = workspace.document.shown();
  if (!shown) return;
  const Sector& sector = shown->sector();
  const double step_m = slice_step_m(sector);
  SlicePlaces places = workspace.slices();
  const auto next = [by](int& place, int step, int count) { place = std::clamp(place + by * step, 0, count - 1); };
  switch (kind) {
    case SliceKind::top:
      next(places.fan, 1, sector.fans());
      break;
    case SliceKind::side:
      next(places.beam, 1, sector.beams());
      break;
    case SliceKind::range: {
      const int samples = static_cast<int>(std::lround(step_m / sector.range().spacing_m));
      next(places.sample, fine ? 1 : std::max(1, samples), sector.range().count);
      break;
    }
    case SliceKind::plane:
      return workspace.plane.assign(moved_by(workspace.plane.values(), by * step_m, sector, frame_now(workspace)));
  }
  workspace.slices.set(places);
}

void turn_plane(Workspace& workspace, double by_deg) {
  const auto& shown = workspace.document.shown();
  if (!shown) return;
  const auto school = selected_middle(workspace);
  const Point<Sonar> about =
      school ? shown->sector().centre(school->fan, school->beam, school->sample) : Point<Sonar>{};
  if (const auto turned = turned_by(workspace.plane.values(), by_deg, about, frame_now(workspace))) {
    workspace.plane.assign(*turned);
  }
}

void lay_slices_through(Workspace& workspace, const Voxel& voxel, std::span<const SliceKind> kinds) {
  const auto& shown = workspace.document.shown();
  if (!shown) return;
  SlicePlaces places = workspace.slices();
  for (const SliceKind kind : kinds) {
    if (kind == SliceKind::top) places.fan = voxel.fan;
    if (kind == SliceKind::side) places.beam = voxel.beam;
    if (kind == SliceKind::range) places.sample = voxel.sample;
    if (kind == SliceKind::plane) {
      const Point<Sonar> point = shown->sector().centre(voxel.fan, voxel.beam, voxel.sample);
      workspace.plane.assign(moved_through(workspace.plane.values(), point, frame_now(workspace)));
    }
  }
  workspace.slices.set(places);
}

void lay_plane(Workspace& workspace) {
  const auto& shown = workspace.document.shown();
  if (!shown) return;
  const Voxel v = selected_middle(workspace).value_or(middle_voxel(shown->sector()));
  const Point<Sonar> point = shown->sector().centre(v.fan, v.beam, v.sample);
  workspace.plane.assign(laid_through(workspace.plane.values(), point, frame_now(workspace)));
}

void choose_plane(Workspace& workspace, PlaneSlice::Kind kind) {
  switch_on(workspace, SliceKind::plane);
  PlanePlace place = workspace.plane.values();
  if (place.lies == kind) return;
  place.lies = kind;
  workspace.plane.assign(place);
  lay_plane(workspace);
}

void lay_section(Workspace& workspace, const Point<Sonar>& a, const Point<Sonar>& b) {
  Document& document = workspace.document;
  if (!document.shown() || !document.staged()) return;
  const auto place =
      vertical_through(workspace.plane.values(), a, b, frame_in(workspace, document.staged()->ping_index));
  if (!place) return document.tell(place.error().text);
  workspace.plane.assign(*place);
  switch_on(workspace, SliceKind::plane);
}

std::optional<Voxel> selected_middle(const Workspace& workspace) {
  const Document& document = workspace.document;
  const auto selected = workspace.selected();
  if (!selected || !document.shown()) return std::nullopt;
  const auto* there = in_ping(document.state().schools[*selected]->masks, document.ping());
  if (there == nullptr) return std::nullopt;
  return middle_of(there->mask, document.shown()->sector().beams());
}

}  // namespace sonar
