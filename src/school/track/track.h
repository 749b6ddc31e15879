// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/time.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "school/detect/detect.h"
#include "school/judge/judge_params.h"

namespace sonar {

struct TrackParams {
  double acceleration_mps2 = 0.05;
  double initial_speed_mps = 2.0;
  double position_share = 0.08;
  double min_position_m = 2.0;
  double gate_sigmas = 4.0;
  int max_lost_pings = 3;
  double max_lost_s = 120.0;
  ConfirmationParams confirmation = {};
  bool divide_joined = true;
  ShipParams ship = {};
  LevelParams level = {};
  std::string left_out = {};  ///< judges that are not asked; not a parameter: DetectParams::left_out

  static constexpr double overlap_weight = 4.0;  ///< cost of no overlap with the moved mask
  static constexpr double size_weight = 1.0;     ///< cost of one e-fold of volume
  static constexpr double level_weight = 0.1;    ///< 1/dB, cost of one dB of level
  static constexpr double fragment_overlap =
      0.5;  ///< a stray detection with this share inside a school's moved mask is a piece of that school
  static constexpr double piece_volume = 0.5;      ///< a piece is no larger than this share of the school's main part
  static constexpr int split_pings = 3;            ///< pings, a piece apart for so many pings is a school of its own
  static constexpr double lost_cost = 1.0;         ///< cost of each ping in which the school was not seen
  static constexpr double censored_m = 200.0;      ///< m, uncertainty of a coordinate that a border cuts off
  static constexpr double unseen_speed_mps = 1.0;  ///< m s-1, ... and how fast it may change all the same, per axis
  static constexpr int overlap_samples = 8;        ///< samples, overlaps are counted at every so-manyth sample
  static constexpr int divide_own_pings = 3;       ///< pings, each was seen alone so often before
  static constexpr double divide_least_share =
      0.25;  ///< ... and gets at least this share of its volume when last alone
  static constexpr double divide_both_share =
      0.7;  ///< ... where the detection is this share of both schools' volumes or more
  static constexpr int divide_both_pings = 2;  ///< pings, ... or so often, which is enough ...
};

template <class Visitor>
void describe(Visitor& v, TrackParams& p) {
  v.field("acceleration_mps2", p.acceleration_mps2,
          {.unit = "m s-2",
           .min = 0.0001,
           .max = 10,
           .text = "Standard deviation of a school's acceleration; raise it for schools that turn sharply."});
  v.field("initial_speed_mps", p.initial_speed_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 20,
           .text = "Standard deviation of a new school's speed along each axis; raise it for fast fish, lower it where "
                   "new tracks jump between neighbouring schools."});
  v.field(
      "position_share", p.position_share,
      {.unit = "1",
       .min = 0.001,
       .max = 2,
       .text =
           "Uncertainty of a school's centre as a share of its extent; raise it for schools that change their shape."});
  v.field("min_position_m", p.min_position_m,
          {.unit = "m",
           .min = 0.01,
           .max = 100,
           .text = "Least standard deviation of a school's measured centre along each axis; raise it where the ship's "
                   "position or heading is noisy, lower it to tell small neighbouring schools apart."});
  v.field("gate_sigmas", p.gate_sigmas,
          {.unit = "1",
           .min = 0.1,
           .max = 20,
           .text = "Detections farther than this many standard deviations from a school's predicted place belong to "
                   "other schools; raise it when tracks break, lower it when tracks jump from school to school."});
  v.field("max_lost_pings", p.max_lost_pings,
          {.unit = "pings",
           .min = 0,
           .max = 100,
           .text = "A school may go unseen in up to this many successive pings and still be found again; raise it "
                   "where pings are often disturbed."});
  v.field("max_lost_s", p.max_lost_s,
          {.unit = "s",
           .min = 1,
           .max = 86400,
           .text = "A school may go unseen for up to this long and still be found again; raise it for long ping "
                   "intervals, lower it where different schools are joined after a pause."});
  describe(v, p.confirmation);
  v.field("divide_joined", p.divide_joined,
          {.text = "Share one detection between schools that were seen apart before and meet in it; switch it off to "
                   "let such schools merge."});
  describe(v, p.ship);
  describe(v, p.level);
}

/// The detections of one ping, for association.
struct DetectedPing {
  std::int64_t ping_index = 0;
  TimeNs time = 0;
  Placement placement;
  std::vector<Detection> detections;
  std::vector<RefusedDetection> refused =
      {};  ///< what lay clearly above the background and is no school; tracks do not see it
};

/// Where the ping of this index stands in the list.
[[nodiscard]] std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings,
                                                              std::int64_t ping_index);

/// One school in one ping: which of the ping's detections it is (several where it is torn).
struct TrackedDetection {
  std::int64_t ping_index = 0;
  std::vector<int> detections;              ///< indices into DetectedPing::detections, rising; the main one first
  PingMask part;                            ///< the school's voxels, where they are not all of theirs; empty = all
  std::optional<double> threshold_db = {};  ///< of the part; none = the main detection's
};

struct SchoolTrack {
  std::int64_t school_id = 0;  ///< 1.. by (first ping, channel, sample)
  std::vector<TrackedDetection> pings;
};

enum class TrackEventKind { birth, death, split, merge };
[[nodiscard]] std::string_view name(TrackEventKind kind);

struct TrackEvent {
  TrackEventKind kind = TrackEventKind::birth;
  std::int64_t ping_index = 0;
  std::int64_t school_id = 0;
  std::int64_t other_id = 0;  ///< split: the school it came from; merge: the school it went into; else 0
};
/// "ping 12: school 4 split from school 2".
[[nodiscard]] std::string to_text(const TrackEvent& event);
/// The event that to_text() told; none where a text tells none. Products hold events as such texts.
[[nodiscard]] std::optional<TrackEvent> event_from_text(std::string_view text);

/// What was followed and is no school.
struct RefusedTrack {
  Reason reason;
  std::vector<TrackedDetection> pings;
};

struct Tracks {
  std::vector<SchoolTrack> schools;   ///< by school_id
  std::vector<TrackEvent> events;     ///< by ping, kind, school_id; confirmed schools only
  std::vector<RefusedTrack> refused;  ///< in the order in which they were first seen
};

/// Joins the detections of an observation to schools: constant velocity over ground, gate, overlap of the moved mask,
/// assignment at least cost; coordinates that a border cuts off do not move the estimate.
/// pings    rising ping_index and time; gaps allowed
/// sector   of the observation
/// channel  [row] for the order of ids, BeamGrid::channel
/// threads  sequential, deterministic
[[nodiscard]] Tracks track(std::span<const DetectedPing> pings, const Sector& sector, std::span<const int> channel,
                           const TrackParams& params);

/// A tracked school's whole mask in one ping.
[[nodiscard]] PingMask mask_of(const TrackedDetection& tracked, const DetectedPing& ping);

}  // namespace sonar
