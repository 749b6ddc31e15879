// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/voxel_statistics.h"
#include "school/grow/grow.h"

namespace sonar {

/// How a volume of water is shared out over Sv as it was recorded: each voxel counts with the volume of its cell, and its
/// background is not taken off. Of voxels that are neither faulty nor without data.
struct SvHistogram {
  std::map<int, double> volume_m3;  ///< by bins of 1 dB: b holds b <= Sv < b + 1, dB re 1 m^-1
  double heard_m3 = 0.0;            ///< of all bins
  double sv_m2 = 0.0;               ///< sum of sv times volume, linear
  double background_m2 = 0.0;       ///< the same of the expected background of these voxels

  /// cost  linear in the mask's voxels
  void add(const PingMask& mask, const StagedPing& ping, const Sector& sector);
  void add(const SvHistogram& more);
  /// Share of the volume in a bin, 0..1.
  [[nodiscard]] double share(int bin) const;
  /// Means, linear and weighted by volume, dB re 1 m^-1; NaN = there is none.
  [[nodiscard]] double mean_db() const;
  [[nodiscard]] double background_db() const;
};

/// From where and how a school grew in a ping.
struct GrowthStart {
  std::vector<VoxelIndex> seeds;
  double tolerance_db = 0.0;  ///< members lie at most this much below their seed's filtered Sv
  double margin_db = 0.0;     ///< and at least this much above their beam's noise
  Connectivity connectivity = Connectivity::faces;
};

/// Of a mask that no click of this ping made: its voxel of the highest filtered Sv, and that over the threshold that the mask
/// was made with.
/// threshold_db  lowest filtered Sv that could be a member; NaN = not known
/// rules         margin and connectivity
/// out           empty where the threshold is not known, or no voxel reaches it
[[nodiscard]] std::optional<GrowthStart> start_at_strongest(const PingMask& mask, double threshold_db,
                                                            const Volume& filtered, const GrowParams& rules);

/// A school grown again with another tolerance.
struct GrownSize {
  double change_db = 0.0;     ///< of the tolerance from the one that was used
  double tolerance_db = 0.0;  ///< that is
  EchoStatistics echo;        ///< as in tables, of no voxel where the tolerance is 0 or less
};

/// Grows anew from the same seeds for each change of the tolerance; volumes never fall while it rises.
/// taken    voxels of other schools: taken away, as a click does
/// go_on    asked before each growth; false ends it
/// errors   cancelled
[[nodiscard]] Result<std::vector<GrownSize>> growth_sensitivity(const GrowthStart& start, const StagedPing& ping,
                                                                const FilteredPing& filtered, const PingMask& taken,
                                                                const Sector& sector,
                                                                std::span<const double> changes_db,
                                                                const std::function<bool()>& go_on);

/// The changes round 0 over which the backscatter stays within so many dB of that at 0: a wide plateau tells that the
/// tolerance matters little.
/// sizes  by rising change
/// out    empty where 0 is not among them, or has no echo
[[nodiscard]] std::optional<std::pair<double, double>> plateau(std::span<const GrownSize> sizes, double within_db);

}  // namespace sonar
