// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/detect/noise_level.h"
#include "school/detect/thresholder.h"
#include "school/runs.h"

namespace sonar {

/// Which voxels belong to a school that the filtered data show. Their box of many beams finds schools in noise, but
/// takes the margins of small ones away and lets noise fill those of weak ones; a median along each beam alone does
/// neither.
class MemberSettler {
 public:
  /// filtered, unfiltered  [fan][beam][sample] Sv counts
  /// flags                 same shape
  /// tolerance_db          members lie no deeper below a school's reference
  /// peaked                whether the filter looked at many beams, so that its loudest voxels are a school's peak, no fading
  /// taken                 voxels that a human gave to schools; null = none
  /// All are borrowed.
  MemberSettler(View3<const std::int16_t> filtered, View3<const std::int16_t> unfiltered,
                View3<const SampleFlags> flags, const Background& background, const WaterLevels& water,
                double tolerance_db, bool peaked, const PingMask* taken);

  struct Settled {
    PingMask mask;
    double reference_db = 0.0;
    double threshold_db = 0.0;
  };
  /// One school, or several where saddles part them: the filter's box of beams bridges open water.
  /// part      what hangs together in the filtered data
  /// depth_db  members lie no deeper below the reference
  /// large     whether so many voxels may be a school: others go with the first school
  /// claimed   voxels of other schools; the members are added
  /// out       at least one
  [[nodiscard]] std::vector<Settled> settle(const std::vector<Run>& part, double depth_db,
                                            const std::function<bool(const std::vector<Run>&)>& large,
                                            View3<std::uint8_t> claimed);

 private:
  using Parts = std::vector<std::vector<Run>>;

  [[nodiscard]] IndexBox box_round(const std::vector<Run>& part, int margins) const;
  void look_along_beams();
  [[nodiscard]] double reference(const std::vector<Run>& part) const;
  /// From where a school's members are counted down. Most schools are about as loud all through, and many beams' voxels
  /// tell how loud; of one whose echo rises towards its core the filtered data show the peak.
  [[nodiscard]] double level(const std::vector<Run>& part) const;
  [[nodiscard]] Parts pieces(const std::vector<Run>& part, double threshold_db) const;
  struct Core {
    double top_db = 0.0;
    double saddle_db = 0.0;  ///< what its runs lie above
    std::vector<Run> runs;
  };
  /// Fading makes peaks too, but no large ones.
  [[nodiscard]] bool is_prominent(const std::vector<Run>& piece, double level_db,
                                  const std::function<bool(const std::vector<Run>&)>& large) const;
  /// Where each school is loudest: what stands min_prominence_db above the saddles round it, the strongest first.
  /// lowest_db  no core's top lies deeper
  /// others     water of schools that were found before: what hangs together with it is their margin
  [[nodiscard]] std::vector<Core> cores(const std::vector<Run>& part, double reference_db, double lowest_db,
                                        const std::vector<Run>& others,
                                        const std::function<bool(const std::vector<Run>&)>& large) const;
  /// Whether one of them goes on where the water that is looked at ends.
  [[nodiscard]] bool cut_by_box(const std::vector<Core>& cores) const;
  /// Each core's side of the saddles, down to the tolerance below its top; fragments above threshold_db to which no echo
  /// leads go with the first.
  [[nodiscard]] Parts waters(const std::vector<Run>& part, const std::vector<Core>& cores,
                             const std::vector<Run>& others, double threshold_db) const;
  [[nodiscard]] Settled members(const std::vector<Run>& runs, double reference_db, double threshold_db,
                                View3<std::uint8_t> claimed) const;

  View3<const std::int16_t> filtered_;
  View3<const std::int16_t> unfiltered_;
  View3<const SampleFlags> flags_;
  double tolerance_db_;
  bool peaked_;
  IndexBox box_;  ///< the water that is looked at
  Array3<std::int16_t> along_beams_;
  Thresholder thresholder_;
};

/// Whether two lists of runs, each sorted, have a voxel in common.
[[nodiscard]] bool share_a_voxel(const std::vector<Run>& a, const std::vector<Run>& b);

/// The voxels that two lists of runs, each sorted, have in common.
[[nodiscard]] std::vector<Run> common_runs(const std::vector<Run>& a, const std::vector<Run>& b);

/// The parts of runs that hang together, each sorted, in order of their first run.
[[nodiscard]] std::vector<std::vector<Run>> connected_parts(const std::vector<Run>& runs, const Shape3& shape,
                                                            Connectivity connectivity);

}  // namespace sonar
