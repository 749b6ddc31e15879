// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sonar_explorer/ping.h"
#include "sonar_explorer/recipe.h"

namespace sonar_explorer {

/// Directions and ranges of an observation's samples.
struct Grid {
  std::vector<double> elevation_deg;  ///< [fan] positive up
  std::vector<double> azimuth_deg;    ///< [beam] clockwise from the bow
  std::vector<double> frequency_hz;   ///< [fan]
  std::vector<double> range_m;        ///< [sample] slant range from the transducer
  std::vector<int> channel;           ///< [fan][beam] number of the channel, from 0
  [[nodiscard]] Shape shape() const {
    return {static_cast<int>(elevation_deg.size()), static_cast<int>(azimuth_deg.size()),
            static_cast<int>(range_m.size())};
  }
};

/// When and where a ping was made. NaN = unknown.
struct PingPlace {
  std::int64_t time_ns = 0;  ///< since 1970, UTC: the ping's lasting key
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double heading_deg = 0.0;
  double speed_mps = 0.0;  ///< over ground
  double pitch_deg = 0.0;  ///< positive bow up
  double roll_deg = 0.0;   ///< positive port up
  double transducer_depth_m = 0.0;
  bool bad = false;  ///< left out everywhere
};

/// A run of pings of one sounder on one beam grid.
/// threads  any; ping() of several threads works side by side
class Observation {
 public:
  struct State;
  explicit Observation(std::shared_ptr<State> state) : state_(std::move(state)) {}

  [[nodiscard]] const std::string& name() const;  ///< "obs-0001"
  [[nodiscard]] std::string sounder() const;
  [[nodiscard]] std::vector<std::string> files() const;  ///< names without folder
  [[nodiscard]] std::size_t pings() const;
  [[nodiscard]] std::vector<PingPlace> places() const;  ///< [ping]
  /// Empty where the beams make no grid of fans and beams, as those of single-beam sounders: such pings have no arrays.
  [[nodiscard]] std::optional<Grid> grid() const;
  /// [fan][beam][sample] volume of each cell, m^3; empty without a grid
  [[nodiscard]] std::vector<double> cell_volumes_m3() const;
  /// Reads and processes one ping.
  /// throws  Error: usage (no such ping, no grid), io, format
  [[nodiscard]] Ping ping(std::int64_t index) const;

  [[nodiscard]] State& state() const { return *state_; }

 private:
  std::shared_ptr<State> state_;
};

/// A survey's raw files, which are never written to. Indexes are kept in the user's cache.
class Survey {
 public:
  /// paths    folders of raw files, or raw files
  /// threads  0 = all of the machine's
  /// throws   Error: not_found, io, bad_parameter
  [[nodiscard]] static Survey open(const std::vector<std::filesystem::path>& paths, const Recipe& recipe = {},
                                   int threads = 0);
  [[nodiscard]] const std::vector<Observation>& observations() const { return observations_; }
  /// throws  Error: usage
  [[nodiscard]] const Observation& observation(const std::string& name) const;
  /// What is wrong with the files, a line each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::vector<Observation> observations_;
  std::vector<std::string> notes_;
};

}  // namespace sonar_explorer
