// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "school/detect/detect_params.h"
#include "school/judge/confirmation.h"
#include "school/judge/level.h"
#include "school/judge/ping_echo.h"
#include "school/judge/prominence.h"
#include "school/judge/ship.h"
#include "school/judge/size.h"
#include "school/judge/surface.h"

namespace sonar {

/// A judge of what one ping shows: why it is no school, if it thinks so.
struct PingJudge {
  std::string_view name;
  std::optional<Reason> (*judge)(const PingEcho& echo, const Detection& detection, const DetectParams& params);
};

inline constexpr PingJudge kSizeJudge{"size",
                                      [](const PingEcho& echo, const Detection& detection, const DetectParams& params) {
                                        return judge_size(echo, detection, params.size);
                                      }};
inline constexpr PingJudge kProminenceJudge{
    "prominence", [](const PingEcho& echo, const Detection& detection, const DetectParams& /*params*/) {
      return judge_prominence(echo, detection);
    }};

/// A judge of tracks.
struct TrackJudge {
  std::string_view name;
  std::optional<Reason> (*judge)(const TrackEcho& track, const TrackParams& params);
};

/// In the order in which they are asked: the first reason is the one that is told.
inline constexpr std::array<TrackJudge, 4> kTrackJudges{{
    {"confirmation",
     [](const TrackEcho& track, const TrackParams& params) { return judge_confirmation(track, params.confirmation); }},
    {"ship", [](const TrackEcho& track, const TrackParams& params) { return judge_ship(track, params.ship); }},
    {"level", [](const TrackEcho& track, const TrackParams& params) { return judge_level(track, params.level); }},
    {"surface", [](const TrackEcho& track, const TrackParams& /*params*/) { return judge_surface(track); }},
}};

/// What a judge of either kind says, if it is asked at all.
template <class Judge, class... Case, class Params>
[[nodiscard]] std::optional<Reason> ask(const Judge& judge, const Params& params, const Case&... what) {
  if (names_judge(params.left_out, judge.name)) return std::nullopt;
  return judge.judge(what..., params);
}

}  // namespace sonar
