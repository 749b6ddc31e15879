// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "publish/movies/movie_params.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// One picture of a movie.
struct MovieStep {
  std::int64_t ping = 0;
  int between = 0;        ///< 0 = the ping itself; 1..n of n pictures on the way to the next ping
  double fraction = 0.0;  ///< of the way to the next ping
  double turn_deg = 0.0;  ///< of the camera about its target
  friend bool operator==(const MovieStep&, const MovieStep&) = default;
};

/// The pings that a movie goes through, both ends included.
struct MoviePings {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// Those that are named; else those of the school, where the options choose one alone; else all. Of a turntable the ping
/// that a picture would show, once.
/// errors  usage: no such ping, the last before the first
[[nodiscard]] Result<MoviePings> movie_pings(const DrawnObservation& observation, const PictureOptions& options);

/// What is seen in which picture. A turntable's last picture is one step before its first, so that it runs on in a loop.
[[nodiscard]] std::vector<MovieStep> movie_steps(const MovieParams& params, MoviePings pings);

/// Refuses what does not go together, before anything is read.
/// errors  bad_parameter: only a volume is turned or sailed past; only samples are interpolated; too small for a caption
[[nodiscard]] Result<void> validate_movie(const PictureOptions& options);

}  // namespace sonar
