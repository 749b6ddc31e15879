// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "session/looks/choices.h"
#include "view/maps/mask_mosaic.h"

namespace sonar {

/// A running propagation as pictures keep it: each ping's mask is copied once, when it arrives.
using RunningMasks = std::map<std::int64_t, std::shared_ptr<const PingMask>>;
/// Takes what is new; what is no longer there goes.
void keep_running(RunningMasks& kept, const std::map<std::int64_t, PingMask>& running);

/// Which masks each ping shows. School numbers are those of the state; what runs has the number that it will get.
struct MaskedPings {
  std::map<std::int64_t, std::vector<MosaicMask>> pings;  ///< without those that show nothing
  JournalStatePtr state;                                  ///< owns the masks
  RunningMasks running;                                   ///< and these
};
/// rejected  whether rejected schools are shown
/// carried   number of the school that runs; empty = a new one
[[nodiscard]] MaskedPings masked_pings(JournalStatePtr state, RunningMasks running, bool rejected,
                                       std::optional<std::int64_t> carried = std::nullopt);

/// [school number modulo MaskMosaic::kSchools]: whether it was rejected, for MaskPalette.
[[nodiscard]] std::vector<bool> rejected_schools(const JournalState& state);

/// A mosaic that follows the masks of an observation: only pings that show something else than before are set.
/// threads  one at a time
class MosaicFollower {
 public:
  /// Begins anew with an empty mosaic.
  void start(MaskMosaic mosaic);
  /// out  how many pings were set
  std::size_t follow(const Sector& sector, const std::vector<PingNavigation>& navigation, MaskedPings masks);
  [[nodiscard]] const MaskMosaic& mosaic() const { return *mosaic_; }
  [[nodiscard]] bool started() const { return mosaic_ != nullptr; }

 private:
  std::unique_ptr<MaskMosaic> mosaic_;
  MaskedPings shown_;
};

}  // namespace sonar
