// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/diagnostics.h"
#include "base/result.h"
#include "base/work.h"
#include "geo/sector.h"
#include "io/block_pool.h"
#include "io/index_cache.h"
#include "io/ping_navigation.h"
#include "io/raw_index.h"
#include "model/beam_grid.h"
#include "model/navigation.h"
#include "model/ping.h"
#include "model/product.h"
#include "model/sounder.h"
#include "pipeline/survey/sound_profile.h"

namespace sonar {

/// How files become observations.
struct SurveyParams {
  double observation_gap_s = 120.0;
  double observation_max_s = 3600.0;
  double range_zero_pulses = 0.25;
  double grid_tolerance_deg = 0.05;
  bool use_passive_pings = false;
  double sound_speed_mps = 0.0;
  bool bend_rays = false;
  SoundProfile sound_speed_profile{};  ///< stands in the recipe by content, as sound_speed_profile; empty = none
  friend bool operator==(const SurveyParams&, const SurveyParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, SurveyParams& p) {
  v.field(
      "observation_gap_s", p.observation_gap_s,
      {.unit = "s",
       .min = 0,
       .max = 1e9,
       .text =
           "A gap between pings longer than this begins a new observation; raise it for a sonar that pings rarely."});
  v.field("observation_max_s", p.observation_max_s,
          {.unit = "s",
           .min = 0,
           .max = 1e9,
           .text = "Longest duration of an observation, which is cut where it is longer; 0 sets no limit. Lower it to "
                   "keep products small."});
  v.field("range_zero_pulses", p.range_zero_pulses,
          {.unit = "pulse lengths",
           .min = 0,
           .max = 1,
           .text = "Share of the pulse's length in water that is taken off every range; 0.25 is c tau / 4. Change it "
                   "only for a sounder whose range zero is known to differ."});
  v.field("grid_tolerance_deg", p.grid_tolerance_deg,
          {.unit = "deg",
           .min = 0,
           .max = 5,
           .text = "Beams whose directions differ by less than this belong to one fan or one azimuth; raise it for a "
                   "sonar whose stated angles scatter."});
  v.field("use_passive_pings", p.use_passive_pings,
          {.text = "Take pings that were made without transmitting, or as a test, like all others; otherwise they are "
                   "marked bad. Switch it on to study noise."});
  v.field("sound_speed_mps", p.sound_speed_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 2000,
           .text = "Sound speed used in ranges, volumes, the sonar equation and absorption by Francois & Garrison; 0 "
                   "takes the harmonic mean of a given profile down to the deepest beam, or the files' value. Set it "
                   "when the sonar ran with a wrong one.",
           .tier = Tier::basic});
  v.field("bend_rays", p.bend_rays,
          {.text = "Bend sound along its rays through the given profile, so that positions and depths follow them; "
                   "otherwise paths are straight. Switch it on where depth_error_m of the schools is larger than what "
                   "your depths may be wrong by."});
}

/// One file of the survey. The name may be that of a file that could not be opened; then error says why.
struct SurveyFile {
  std::filesystem::path path;
  RawIndex index;
  std::optional<Error> error;
};

/// Where a ping of an observation lies.
struct SurveyPing {
  std::uint32_t file = 0;   ///< in SurveyFiles::files
  std::uint32_t entry = 0;  ///< in that file's index.pings
  friend auto operator<=>(const SurveyPing&, const SurveyPing&) = default;
};

/// A run of pings of one sounder on one grid (INTERFACES section 1), with everything but the samples.
struct ObservationFiles {
  std::string name;                  ///< "obs-0001"
  std::vector<SurveyPing> pings;     ///< in time order; the index in here is ping_index
  std::vector<std::uint32_t> files;  ///< those that pings come from, in order
  SounderConfig config;
  std::optional<BeamGrid> grid;            ///< empty where the beams make none; a diagnostic says why
  RangeAxis range;                         ///< of every row; count = the longest channel, first_m = -range_zero
  std::vector<std::int32_t> sample_count;  ///< [fan], longest channel of the fan, offset included; empty without grid
  TransmitSet transmit;                    ///< [channel] of the first ping; frequency NaN where not seen
  double sound_speed_mps = 0.0;            ///< middle of all pings', of the first channel, as are the next two; or
  bool sound_speed_given = false;          ///< a user's, which stands for every channel's
  double sample_interval_s = 0.0;
  double pulse_length_s = 0.0;
  std::vector<PingNavigation> navigation;  ///< [ping_index]
  Talkers talkers;
  double gps_minus_clock_s = 0.0;  ///< median; NaN = unknown
  bool continues_cut = false;  ///< begun only because the one before reached observation_max_s or sound speed drifted
  TimeNs cut_after = 0;        ///< datagram time of the ping before such a cut; 0 = no cut
  Diagnostics diagnostics;     ///< of the observation; those of its files are in their indexes
  std::size_t cut_notes = 0;   ///< how many of them, the first, tell why it was begun

  [[nodiscard]] Sector sector() const { return grid->sector(range); }  ///< only with a grid
};

/// A survey: every file, and the observations they make.
struct SurveyFiles {
  bool from_ends = false;                      ///< see glance_at_survey(): only some of the pings are known
  std::vector<SurveyFile> files;               ///< those with pings by first ping's time, then name; then the others
  std::vector<ObservationFiles> observations;  ///< MS70 first, then each other sounder, each in time order
  Diagnostics diagnostics;                     ///< duplicate files, repeated pings, unreadable files
  std::shared_ptr<BlockPool> blocks = std::make_shared<BlockPool>();
  std::string raw_gone{};  ///< why no ping can be read, its raw files being elsewhere; empty = they are there

  /// Where the other channels of a ping lie whose channels are spread over several places (two files that each hold
  /// some, say); by the first part, which is the one with most channels.
  std::map<SurveyPing, std::vector<SurveyPing>> further_parts;

  [[nodiscard]] const PingEntry& entry(const SurveyPing& ping) const {
    return files[ping.file].index.pings[ping.entry];
  }
  /// Settings of the part's channels.
  [[nodiscard]] const TransmitSet& transmit(const SurveyPing& part) const {
    return files[part.file].index.transmits[entry(part).transmit];
  }
  /// All places of a ping, the first part first.
  [[nodiscard]] std::vector<SurveyPing> parts(const SurveyPing& ping) const;
  /// Datagram time of a ping, the lasting key of human decisions.
  [[nodiscard]] TimeNs ping_time(const ObservationFiles& observation, std::size_t ping_index) const {
    return entry(observation.pings[ping_index]).time;
  }
  /// Null where there is none of that name.
  [[nodiscard]] const ObservationFiles* find(std::string_view observation) const;
};

/// What a product remembers of the files that an observation came from.
[[nodiscard]] std::vector<InputFile> input_files(const SurveyFiles& survey, const ObservationFiles& observation);

/// Where a sounder's pings are cut into observations from, when those before are over and not looked at any more.
struct SequenceStart {
  std::filesystem::path file;    ///< that the first ping lies in
  std::uint32_t entry = 0;       ///< in that file's index.pings
  std::size_t observations = 0;  ///< before it
  // What is known of the cut that begins it, as in ObservationFiles.
  bool continues_cut = false;
  TimeNs cut_after = 0;
  Diagnostics notes;
};
/// What pings of one sequence have in common: kind and name, as the files give them.
using Sounder = std::pair<SounderKind, std::string>;
[[nodiscard]] inline Sounder sounder_of(const SounderConfig& config) { return {config.kind, config.sounder_name}; }
using SequenceStarts = std::map<Sounder, SequenceStart>;

/// Files that a list of paths stands for: of a folder every *.raw in it (any case, not deeper) and every *.nc of
/// SONAR-netCDF4, which is named though not read, sorted by name; a file as it is.
/// errors  not_found, io
[[nodiscard]] Result<std::vector<std::filesystem::path>> list_survey(std::span<const std::filesystem::path> paths);

/// Indexes the files (from the cache where it can) and cuts them into observations. A file that cannot be read is
/// listed with its error and stops nothing. Nothing is written but the cache.
/// errors   not_found, io (a path or folder that is not there); bad_parameter; cancelled
/// threads  files are indexed in parallel; the result does not depend on it
[[nodiscard]] Result<SurveyFiles> open_survey(std::span<const std::filesystem::path> paths, const SurveyParams& survey,
                                              const NavigationParams& navigation, const IndexCache& cache, Work& work);

/// What a survey of any size is, within moments: what the first and last bytes of its files tell. Its observations have no
/// pings but those, are cut neither within files nor for their length, and have the names of their first files. For lists and
/// maps, never for samples.
/// errors   as open_survey()
[[nodiscard]] Result<SurveyFiles> glance_at_survey(std::span<const std::filesystem::path> paths,
                                                   const SurveyParams& survey, const NavigationParams& navigation,
                                                   Work& work);

/// Refuses paths that stand for no file at all.
/// errors  not_found, naming the first path
[[nodiscard]] Result<void> require_files(const SurveyFiles& survey, std::span<const std::filesystem::path> paths);

/// Nothing is ever written where raw files lie: refuses a folder that is, or lies in, the folder of one of them (links
/// followed).
/// errors  usage
[[nodiscard]] Result<void> require_outside_raw(const SurveyFiles& survey, const std::filesystem::path& folder);
/// raw  folders of raw files, or raw files, as a user named them
[[nodiscard]] Result<void> require_outside_raw(std::span<const std::filesystem::path> raw,
                                               const std::filesystem::path& folder);

/// The same for a folder whose survey nobody named: refuses one that lies beneath a folder with raw files in it, known by
/// their names and first bytes. The folder itself may hold some.
/// errors  usage, naming the folder
[[nodiscard]] Result<void> require_not_beneath_raw(const std::filesystem::path& folder);

/// The second half of open_survey: from indexed files to observations. Pure.
/// starts  of sounders whose first observations are left out; their number stays in the names of the others
[[nodiscard]] SurveyFiles arrange_survey(std::vector<SurveyFile> files, const SurveyParams& survey,
                                         const NavigationParams& navigation, const SequenceStarts& starts = {});

}  // namespace sonar
