// SPDX-License-Identifier: Apache-2.0
#include "publish/picture.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/time.h"
#include "pipeline/recipe/recipe.h"
#include "publish/chart_picture.h"
#include "publish/curves_picture.h"
#include "publish/echograms/echogram_picture.h"
#include "publish/frequency_picture.h"
#include "publish/lineage_picture.h"
#include "publish/maps/map_pictures.h"
#include "publish/noise_steps_picture.h"
#include "publish/reports/report_page.h"
#include "publish/slice_pictures.h"
#include "publish/volumes/volume_picture.h"

namespace sonar {
namespace {

Result<FrameDescription> observation_frame(PictureKind kind, DrawnObservation& observation,
                                           const PictureOptions& options, Work& work) {
  switch (kind) {
    case PictureKind::volume:
      return volume_frame(observation, options, work);
    case PictureKind::propagation:
      return propagation_frame(observation, options);
    case PictureKind::observation_map:
      return observation_map_frame(observation, options);
    case PictureKind::frequency:
      return frequency_frame(observation, options, work);
    case PictureKind::lineage:
      return lineage_frame(observation, options);
    case PictureKind::noise_steps:
      return noise_steps_frame(observation, options, work);
    default:
      return slice_frame(kind, observation, options, work);
  }
}

/// From the first ping of the observations to the last; empty without pings.
std::string time_of(const std::vector<DrawnObservation*>& observations) {
  std::optional<std::pair<TimeNs, TimeNs>> span;
  for (const DrawnObservation* one : observations) {
    const auto& pings = one->product().pings;
    if (pings.empty()) continue;
    if (!span) span = {pings.front().time, pings.back().time};
    span->first = std::min(span->first, pings.front().time);
    span->second = std::max(span->second, pings.back().time);
  }
  return span ? iso_time(span->first) + "/" + iso_time(span->second) : "";
}

PictureOrigin origin_of(const PictureSource& source, const std::vector<DrawnObservation*>& drawn) {
  return {"Sonar Explorer " SONAR_VERSION, recipe_hash(source.recipe()), time_of(drawn)};
}

std::vector<DrawnObservation*> all_of(PictureSource& source) {
  std::vector<DrawnObservation*> all;
  for (DrawnObservation& one : source.observations()) all.push_back(&one);
  return all;
}

Result<std::vector<DrawnObservation*>> drawn_of(PictureKind kind, PictureSource& source, const std::string& observation,
                                                const PictureOptions& options) {
  const bool all =
      kind == PictureKind::survey_map || kind == PictureKind::report ||
      (observation.empty() && (kind == PictureKind::chart ||
                               (kind == PictureKind::curves && options.kind.curves.curve == SchoolCurve::avoidance)));
  if (all || (kind == PictureKind::timeline && options.kind.timeline.whole_survey)) {
    return all_of(source);
  }
  const auto chosen = source.observation(observation);
  if (!chosen) return pass_on(chosen);
  return std::vector<DrawnObservation*>{*chosen};
}

Result<FrameDescription> frame_of(PictureKind kind, PictureSource& source, const std::vector<DrawnObservation*>& drawn,
                                  const PictureOptions& options, Work& work) {
  if (kind == PictureKind::survey_map) return survey_map_frame(source.observations(), options, work);
  if (kind == PictureKind::timeline) return timeline_frame(drawn, options, work);
  if (kind == PictureKind::echogram) return echogram_frame(source, *drawn.front(), options, work);
  if (kind == PictureKind::report) return report_page(source, options, work);
  if (kind == PictureKind::chart) return chart_frame(drawn, options);
  if (kind == PictureKind::curves) return curves_frame(drawn, options, work);
  return observation_frame(kind, *drawn.front(), options, work);
}

}  // namespace

Result<FrameDescription> picture_frame(PictureKind kind, PictureSource& source, const std::string& observation,
                                       const PictureOptions& options, Work& work) {
  if (auto valid = validate_options(options); !valid) return pass_on(valid);
  if (!is_one_picture(kind)) return fail(ErrorCode::usage, "a movie is no single picture; expected another kind");
  const auto drawn = drawn_of(kind, source, observation, options);
  if (!drawn) return pass_on(drawn);
  auto frame = frame_of(kind, source, *drawn, options, work);
  if (frame) frame->origin = origin_of(source, *drawn);
  return frame;
}

PictureOrigin survey_origin(PictureSource& source) { return origin_of(source, all_of(source)); }

}  // namespace sonar
