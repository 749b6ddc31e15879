// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "session/looks/picture_look.h"
#include "session/maps/masked_pings.h"
#include "session/maps/strip_model.h"

namespace sonar {

/// Everything that a strip shows, as it was when the picture was asked for.
struct StripWish {
  OpenObservationPtr observation;
  JournalStatePtr state;
  RunningMasks running;
  std::optional<std::int64_t> carried;  ///< number of the school that runs
  std::int64_t first = 0;
  int panes = 1;
  std::int64_t ping = 0;
  std::int64_t selected = 0;  ///< school number; 0 = none
  bool rejected = true;
  bool searched = false;  ///< schools were looked for; else that there is none says nothing
  PropagationStyle style;
  PictureLook look;
};

/// masks  own what the panels point to
[[nodiscard]] std::vector<PropagationPanel> strip_panels(const StripWish& wish, const MaskedPings& masks);
/// "obs-0001, pings 3 to 9 · school 2 in 12 pings", or how far what runs has come.
[[nodiscard]] std::string strip_title(const StripWish& wish);

}  // namespace sonar
