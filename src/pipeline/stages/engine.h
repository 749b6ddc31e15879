// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "geo/refraction.h"
#include "model/filtered_ping.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/known_pings.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/calibration.h"
#include "pipeline/survey/survey.h"
#include "school/detect/noise_level.h"
#include "school/judge/ping_echo.h"
#include "school/seabed/seabed.h"
#include "school/track/dead_reckoning.h"
#include "signal/flags.h"

namespace sonar {

/// Everything the stages after the raw file know of one ping. Values, never changed once handed out.
struct StagedPing {
  std::int64_t ping_index = 0;
  Volume sv;                         ///< unfiltered Sv counts; flags with the seabed
  std::shared_ptr<Volume> filtered;  ///< median-filtered Sv counts; flags with the seabed and its beam-edge echo
  Seabed seabed;
  CalibrationTables::Table calibration;
  std::vector<double> background_db;  ///< [row] power, dB re 1 W; NaN = none known
  std::optional<WaterLevels> water;   ///< where a reduced file brings them; else its neighbours are needed to tell
  Array3<std::int16_t> means;         ///< block_means() of the unfiltered Sv; empty where water is known

  [[nodiscard]] Background background() const { return {background_db, calibration->view()}; }
};

/// "Stage S of ping i, please" for one observation under one recipe. Nothing is kept but what neighbouring pings share
/// (power volumes, calibration tables, background estimates), so that memory does not grow with the observation.
/// threads  staged() may be called from any thread once estimate_background() is done
class Engine {
 public:
  /// The observation has a grid; survey and observation outlive the engine.
  /// known  of an earlier engine of the same observation, when it had fewer pings; null = everything is worked out
  Engine(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
         KnownPings* known = nullptr);

  [[nodiscard]] std::int64_t pings() const { return static_cast<std::int64_t>(observation_.pings.size()); }
  [[nodiscard]] const Sector& sector() const { return sector_; }
  /// The median that selection works on, as it suits the beams.
  [[nodiscard]] MedianParams filter_box() const;
  /// With the widths of the recipe's calibration.
  [[nodiscard]] const BeamGrid& grid() const { return grid_; }
  [[nodiscard]] const BeamFigures& beam_figures() const { return figures_; }
  [[nodiscard]] const Recipe& recipe() const { return recipe_; }
  [[nodiscard]] const ObservationFiles& observation() const { return observation_; }
  [[nodiscard]] const SurveyFiles& survey() const { return survey_; }
  /// What was recorded: NaN where a ping has no position. Roll and pitch are in it where beams are not stabilised, rays
  /// where the recipe bends them.
  [[nodiscard]] Placement placement(std::int64_t ping_index) const;
  /// The same for following schools: gaps in the navigation are reckoned over.
  [[nodiscard]] const Placement& tracking_placement(std::int64_t ping_index) const {
    return reckoned_.pings[static_cast<std::size_t>(ping_index)];
  }
  /// Of the recipe's profile, whether sound is bent along them or not; null = no profile.
  [[nodiscard]] const std::shared_ptr<const Refraction>& rays() const { return rays_; }
  [[nodiscard]] const DeadReckoning& reckoned() const { return reckoned_; }
  /// Whether a ping shows nothing of the sea: no stage looks at it or compares others with it.
  [[nodiscard]] bool is_bad(std::int64_t ping_index) const {
    return observation_.navigation[static_cast<std::size_t>(ping_index)].bad;
  }
  /// Null, and no keys, where nothing is kept.
  [[nodiscard]] KnownPings* known() const { return known_; }
  [[nodiscard]] const PingKeys& keys() const { return *keys_; }
  [[nodiscard]] Diagnostics calibration_notes() const { return tables_.diagnostics(); }

  /// Estimates the background of pings first .. last (inclusive) and their neighbours; other calls need it.
  /// A ping that cannot be read has none. errors: cancelled
  [[nodiscard]] Result<void> estimate_background(std::int64_t first, std::int64_t last, Work& work);
  /// Takes the background of a ping from a product of the same observation and recipe instead of estimating it.
  /// background_db  by row, dB re 1 W
  void give_background(std::int64_t ping_index, std::vector<float> background_db);
  /// Background of a ping by row, dB re 1 W, rounded to float as it is stored; empty where it is not subtracted.
  [[nodiscard]] std::vector<float> background_db(std::int64_t ping_index) const;

  /// Water levels told by a ping alone, where its neighbours are not at hand.
  [[nodiscard]] WaterLevels own_water(const StagedPing& ping) const;
  /// A ping as detection sees it. water  its levels; outlives what is returned, as the ping does
  [[nodiscard]] PingEcho echo(const StagedPing& ping, const WaterLevels& water) const;

  /// All stages up to the seabed. errors: as load_volume()
  [[nodiscard]] Result<StagedPing> staged(std::int64_t ping_index);
  /// Hands a ping's stages to a later kept_or_staged(), as long as there is room: measuring need not work out again what
  /// detecting just did. Which pings are kept changes no result.
  void keep(std::shared_ptr<const StagedPing> ping);
  [[nodiscard]] Result<std::shared_ptr<const StagedPing>> kept_or_staged(std::int64_t ping_index);
  /// Lets go of the pings that are kept for their neighbours: an observation that nobody looks at costs no memory.
  void rest();
  /// A ping for growing and propagating.
  [[nodiscard]] Result<FilteredPing> filtered(std::int64_t ping_index);
  [[nodiscard]] FilteredPing filtered(const StagedPing& ping) const;

  /// What kept the system from reading a ping, the first such error that was met: what is made without that ping is no
  /// product of the survey. Damage in what could be read is no refusal.
  [[nodiscard]] Result<void> refusal() const;

 private:
  using Power = std::shared_ptr<const PowerVolume>;
  [[nodiscard]] Result<Power> power(std::int64_t ping_index);
  [[nodiscard]] Array3<std::int16_t> levels_of(const PowerVolume& power) const;
  [[nodiscard]] KnownPings::Background background_of(std::int64_t ping_index);
  /// By the levels of the ping and its neighbours, as far as they are known.
  [[nodiscard]] std::vector<float> background_told_round(std::int64_t ping_index) const;
  [[nodiscard]] PingGeometry ping_geometry(std::int64_t ping_index) const;
  [[nodiscard]] Volume calibrated(std::int64_t ping_index, const PowerVolume& power, const Array3<std::int16_t>& table);
  void flag(std::int64_t ping_index, const PowerVolume& power, Volume& volume);

  const SurveyFiles& survey_;
  const ObservationFiles& observation_;
  const Recipe recipe_;
  BeamGrid grid_;
  BeamFigures figures_;
  Sector sector_;
  CalibrationTables tables_;
  std::shared_ptr<const Refraction> rays_;
  DeadReckoning reckoned_;
  KnownPings* known_;
  std::optional<PingKeys> keys_;
  Array3<double> block_gain_;                 ///< by the observation's first settings
  std::vector<Array3<std::int16_t>> levels_;  ///< [ping] background_levels(), empty = not known
  /// [ping] as it was worked out, or as a reduced file or a product brings it along; empty = not known
  std::vector<std::vector<float>> background_db_;
  mutable std::mutex mutex_;
  Result<void> refusal_;
  std::size_t power_limit_;
  std::vector<std::int64_t> power_order_;
  std::unordered_map<std::int64_t, Power> power_;
  std::unordered_map<std::int64_t, std::shared_ptr<const StagedPing>> staged_;
  std::size_t staged_bytes_ = 0;  ///< of these
};

}  // namespace sonar
