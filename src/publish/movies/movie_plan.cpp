// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/movie_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "publish/volumes/drawn_schools.h"

namespace sonar {
namespace {

constexpr std::int64_t kMostPictures = 100'000;

/// From the school's first mask to its last; `all` where it has none.
MoviePings of_school(const ObservationProduct& product, std::int64_t school, MoviePings all) {
  MoviePings pings{all.last, all.first};
  for (const SchoolMask& mask : product.masks) {
    if (mask.school_id != school) continue;
    pings.first = std::min(pings.first, mask.ping_index);
    pings.last = std::max(pings.last, mask.ping_index);
  }
  return pings.first <= pings.last ? pings : all;
}

}  // namespace

PictureKind drawn_kind(MovieOf of) {
  switch (of) {
    case MovieOf::slice_top:
      return PictureKind::slice_top;
    case MovieOf::slice_side:
      return PictureKind::slice_side;
    case MovieOf::slice_range:
      return PictureKind::slice_range;
    case MovieOf::slice_plane:
      return PictureKind::slice_plane;
    case MovieOf::propagation:
      return PictureKind::propagation;
    case MovieOf::observation_map:
      return PictureKind::observation_map;
    case MovieOf::volume:
      break;
  }
  return PictureKind::volume;
}

Result<MoviePings> movie_pings(const DrawnObservation& observation, const PictureOptions& options) {
  const MovieParams& params = options.kind.movie;
  if (observation.pings() == 0) return fail(ErrorCode::usage, observation.name() + " has no pings");
  if (params.motion == MovieMotion::turntable) {
    const auto ping = chosen_ping(observation, options);
    if (!ping) return pass_on(ping);
    return MoviePings{*ping, *ping};
  }
  MoviePings pings{0, observation.pings() - 1};
  if (options.schools.size() == 1) pings = of_school(observation.product(), options.schools.front(), pings);
  if (params.first_ping >= 0) pings.first = params.first_ping;
  if (params.last_ping >= 0) pings.last = params.last_ping;
  for (const std::int64_t ping : {pings.first, pings.last}) {
    if (ping < observation.pings()) continue;
    return fail(ErrorCode::usage, fmt::format("no ping {} in {}: it has pings 0 to {}", ping, observation.name(),
                                              observation.pings() - 1));
  }
  if (pings.last < pings.first) {
    return fail(ErrorCode::usage,
                fmt::format("the movie's last ping, {}, lies before its first, {}", pings.last, pings.first));
  }
  const std::int64_t pictures = (pings.last - pings.first) * (params.between + 1) + 1;
  if (pictures <= kMostPictures) return pings;
  return fail(ErrorCode::usage,
              fmt::format("the movie would have {} pictures; expected {} at most: name first and last ping", pictures,
                          kMostPictures));
}

std::vector<MovieStep> movie_steps(const MovieParams& params, MoviePings pings) {
  std::vector<MovieStep> steps;
  if (params.motion == MovieMotion::turntable) {
    for (int i = 0; i < params.turntable_pictures; ++i) {
      steps.push_back({pings.first, 0, 0.0, params.turns_deg * i / params.turntable_pictures});
    }
    return steps;
  }
  for (std::int64_t ping = pings.first; ping <= pings.last; ++ping) {
    const int between = ping < pings.last ? params.between : 0;
    for (int i = 0; i <= between; ++i) steps.push_back({ping, i, 1.0 * i / (between + 1), 0.0});
  }
  return steps;
}

Result<void> validate_movie(const PictureOptions& options) {
  constexpr int kLeastHeight = 300;
  const MovieParams& params = options.kind.movie;
  if (auto valid = validate(params); !valid) return valid;
  if (params.motion != MovieMotion::pings && params.of != MovieOf::volume) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("motion {} moves a camera, which a volume alone has; expected of volume, or motion pings",
                            params.motion == MovieMotion::turntable ? "turntable" : "along-track"));
  }
  if (params.between > 0 && (params.of == MovieOf::propagation || params.of == MovieOf::observation_map)) {
    return fail(ErrorCode::bad_parameter,
                "between interpolates samples; expected of volume or of a slice, or between 0");
  }
  if (options.size.height < kLeastHeight) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a movie {} pixels high has no room for its caption; expected {} or more",
                            options.size.height, kLeastHeight));
  }
  return {};
}

}  // namespace sonar
