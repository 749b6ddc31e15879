// SPDX-License-Identifier: Apache-2.0
#include "publish/slice_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "pipeline/stages/placements.h"
#include "pipeline/stages/voxel_statistics.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/movies/between_pings.h"
#include "publish/reports/sample_looks.h"
#include "publish/volumes/drawn_schools.h"
#include "view/school_look.h"

namespace sonar {
namespace {

double known_heading_rad(const PingNavigation& navigation) {
  return std::isnan(navigation.heading_deg) ? 0.0 : rad_from_deg(navigation.heading_deg);
}

struct Chosen {
  const Sector& sector;
  const PingNavigation& navigation;
  std::optional<MaskMiddle> school;
  const PictureOptions& options;

  [[nodiscard]] double heading_rad() const { return known_heading_rad(navigation); }
};

/// What of the picture is not as recorded, and the schools in it.
SliceKey slice_key_of(const DrawnPing& ping, const PictureOptions& options) {
  SliceKey key;
  key.filtered = ping.staged != nullptr && options.display.filtered;
  key.weak_below_db = weak_below(options.display);
  // Keys and masks are in one order.
  for (const DrawnSchoolKey& school : school_keys(ping, options)) {
    key.schools.push_back({school.colour, status_line(school.status), school.name, key.schools.size()});
  }
  return key;
}

Result<Slice> range_slice(const Chosen& chosen) {
  const RangeAxis& range = chosen.sector.range();
  const double range_m = chosen.options.kind.slice_range.range_m;
  if (range_m == 0.0) return Slice{RangeSlice{chosen.school ? chosen.school->sample : range.count / 2}};
  const double sample = std::round(range.sample_at(range_m));
  if (!(sample >= 0 && sample <= range.count - 1)) {
    return fail(ErrorCode::usage, fmt::format("no samples at a range of {} m: they reach from {:.2f} to {:.2f} m",
                                              range_m, range.range_m(0), range.range_m(range.count - 1)));
  }
  return Slice{RangeSlice{static_cast<int>(sample)}};
}

/// Through the school, or half way out: what one would look at first.
Slice plane_of_school(const Chosen& chosen) {
  const Sector& s = chosen.sector;
  const Point<Sonar> at = chosen.school ? s.centre(chosen.school->fan, chosen.school->beam, chosen.school->sample)
                                        : s.centre(s.fans() / 2, s.beams() / 2, s.range().count / 2);
  const double depth = chosen.navigation.transducer_depth_m;
  return Slice{horizontal_plane(at.z + depth, depth)};
}

Result<Slice> plane_slice(const Chosen& chosen) {
  const PlaneSliceParams& params = chosen.options.kind.slice_plane;
  const auto places = places_of(params);
  if (!places) return pass_on(places);
  const auto slice = [](const auto& made) { return made ? Result<Slice>(Slice{*made}) : pass_on(made); };
  switch (params.plane) {
    case PlaneLies::through_school:
      break;
    case PlaneLies::horizontal:
      return Slice{horizontal_plane(params.depth_m, chosen.navigation.transducer_depth_m)};
    case PlaneLies::along_bearing:
      return Slice{vertical_plane(rad_from_deg(params.bearing_deg) - chosen.heading_rad())};
    case PlaneLies::through_places: {
      const auto& t = places->through;
      return slice(vertical_plane({t[0], t[1], 0.0}, {t[2], t[3], 0.0}));
    }
    case PlaneLies::oblique: {
      const auto& p = places->point;
      const auto& n = places->normal;
      return slice(oblique_plane({p[0], p[1], p[2]}, {n[0], n[1], n[2]}));
    }
  }
  return plane_of_school(chosen);
}

PictureKind kind_of_steps(StepsSlice slice) {
  switch (slice) {
    case StepsSlice::side:
      return PictureKind::slice_side;
    case StepsSlice::range:
      return PictureKind::slice_range;
    case StepsSlice::plane:
      return PictureKind::slice_plane;
    default:
      return PictureKind::slice_top;
  }
}

Result<Slice> slice_of(PictureKind kind, const Chosen& chosen) {
  const auto& o = chosen.options;
  switch (kind) {
    case PictureKind::slice_top:
      return Slice{TopSlice{o.fan.value_or(chosen.school ? chosen.school->fan : chosen.sector.fans() / 2)}};
    case PictureKind::slice_side:
      return Slice{SideSlice{o.beam.value_or(chosen.school ? chosen.school->beam : chosen.sector.beams() / 2)}};
    case PictureKind::slice_range:
      return range_slice(chosen);
    default:
      return plane_slice(chosen);
  }
}

}  // namespace

Result<Slice> chosen_slice(PictureKind kind, const DrawnPing& ping, const Sector& sector,
                           const PictureOptions& options) {
  if (kind == PictureKind::noise_steps) kind = kind_of_steps(options.kind.noise_steps.slice);
  return slice_of(kind,
                  {sector, ping.navigation, middle_of_largest(chosen_layers(ping, options), sector.beams()), options});
}

SlicePing titled_ping(const DrawnObservation& observation, const DrawnPing& ping) {
  SlicePing titled;
  titled.observation = observation.title() + (ping.staged ? "" : " (masks alone: no raw files)");
  titled.ping_index = ping.ping_index;
  titled.time = ping.navigation.time;
  titled.heading_rad = rad_from_deg(ping.navigation.heading_deg);
  titled.transducer_depth_m = ping.navigation.transducer_depth_m;
  titled.frequency_hz = observation.frequency_hz();
  titled.rays = observation.rays();
  titled.moved = moves_places(observation.recipe(), ping.navigation);
  return titled;
}

SliceView drawn_view(const Slice& slice, const DrawnPing& ping, const PictureOptions& options) {
  return {slice, options.display.north_up ? -known_heading_rad(ping.navigation) : 0.0, std::nullopt};
}

Result<FrameDescription> slice_frame(PictureKind kind, DrawnObservation& observation, const PictureOptions& options,
                                     Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto ping = drawn_ping(observation, *index, options, work);
  if (!ping) return pass_on(ping);
  const auto slice = chosen_slice(kind, *ping, *sector, options);
  if (!slice) return pass_on(slice);
  const Shape3 shape{sector->fans(), sector->beams(), sector->range().count};
  const Array3<std::int16_t> nothing(ping->staged ? Shape3{} : shape, kNoData);
  SliceData data;
  Array3<SampleFlags> flags;
  Array3<std::int16_t> restored;
  if (ping->staged) {
    const DisplayParams& display = options.display;
    data.sv = (display.filtered ? *ping->staged->filtered : ping->staged->sv).counts.view();
    if (const SampleFlags reasons = put_back(display); display.filtered && any(reasons)) {
      restored = counts_put_back(*ping->staged, reasons);
      data.sv = View3<const std::int16_t>(restored.view());
    }
    data.flags = ping->staged->filtered->flags.view();
    if (const auto below_db = weak_below(display)) {
      flags = Array3<SampleFlags>(data.flags.shape());
      flag_weak(*ping->staged, *below_db, flags.view());
      data.flags = View3<const SampleFlags>(flags.view());
    }
  } else {
    data.sv = nothing.view();
  }
  data.masks = chosen_layers(*ping, options);
  data.refused = drawn_refused(observation, *sector, ping->ping_index, options);
  if (options.display.shadow && ping->staged) {
    data.shadow_from = shadow_from(*ping->heard, *sector, casting_shadow(*ping, options),
                                   observation.recipe().measure.extinction, options.display.shadow_db);
  }
  SliceStyle style = slice_style(options.display, colours_of(options));
  style.masks.shown = options.display.masks;
  style.key = slice_key_of(*ping, options);
  auto picture = slice_picture(*sector, data, titled_ping(observation, *ping), drawn_view(*slice, *ping, options),
                               style, theme_of(options), options.size);
  if (!picture) return pass_on(picture);
  picture->frame.title = observation.title() + ": " + picture->frame.title;
  return std::move(picture->frame);
}

}  // namespace sonar
