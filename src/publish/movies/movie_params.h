// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "publish/picture_kind.h"

namespace sonar {

/// What a movie's pictures are of: the kinds that show one ping.
enum class MovieOf : std::uint8_t {
  volume,
  slice_top,
  slice_side,
  slice_range,
  slice_plane,
  propagation,
  observation_map,
};
inline constexpr std::array<std::string_view, 7> kMovieOfNames{
    "volume", "slice_top", "slice_side", "slice_range", "slice_plane", "propagation", "observation_map"};

enum class MovieMotion : std::uint8_t { pings, turntable, along_track };
inline constexpr std::array<std::string_view, 3> kMovieMotionNames{"pings", "turntable", "along_track"};

struct MovieParams {
  MovieOf of = MovieOf::volume;
  MovieMotion motion = MovieMotion::pings;
  int first_ping = -1;
  int last_ping = -1;
  double pictures_per_second = 5.0;
  int between = 0;
  double turns_deg = 360.0;
  int turntable_pictures = 72;
  bool each_picture = false;
};

template <class Visitor>
void describe(Visitor& v, MovieParams& p) {
  v.choice("of", p.of, kMovieOfNames, "what is shown of each ping, as the kind of that name draws it");
  v.choice("motion", p.motion, kMovieMotionNames,
           "pings = one after another; turntable = the camera goes round one ping; along track = the ship sails past a "
           "camera that stays where it is on the earth, or follows evenly where the track is long");
  v.field("first_ping", p.first_ping,
          {.unit = "1",
           .min = -1,
           .max = 1e9,
           .text = "first ping of the movie; -1 = the first of the school that is chosen, else of the observation"});
  v.field("last_ping", p.last_ping,
          {.unit = "1",
           .min = -1,
           .max = 1e9,
           .text = "last ping of the movie; -1 = the last of the school that is chosen, else of the observation"});
  v.field("pictures_per_second", p.pictures_per_second,
          {.unit = "1/s", .min = 0.02, .max = 60, .text = "how many pictures a movie shows in a second"});
  v.field("between", p.between,
          {.unit = "1",
           .min = 0,
           .max = 60,
           .text = "pictures interpolated between two pings, for a smoother movie; each says that it is interpolated"});
  v.field("turns_deg", p.turns_deg,
          {.unit = "deg",
           .min = -3600,
           .max = 3600,
           .text = "how far a turntable turns; 360 = once round, so that the movie can be played in a loop"});
  v.field("turntable_pictures", p.turntable_pictures,
          {.unit = "1", .min = 2, .max = 10000, .text = "pictures of a turntable's turn"});
  v.field("each_picture", p.each_picture, {.text = "write each picture as a PNG beside the movie, too"});
}

/// The kind of picture that is drawn.
[[nodiscard]] PictureKind drawn_kind(MovieOf of);

}  // namespace sonar
