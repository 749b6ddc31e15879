// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "session/looks/picture_look.h"
#include "session/open/workspace.h"
#include "session/slices/school_layers.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// Flags with the weak samples marked, kept from one picture to the next.
struct FlagRoom {
  Array3<SampleFlags> flags;
  std::weak_ptr<const StagedPing> all_of{};  ///< the ping of which every row is marked
  double below_db = 0.0;                     ///< with that margin
};

/// Everything that a slice's picture depends on, copied so that it can be made behind the window.
struct SliceWish {
  OpenObservationPtr observation;
  StagedPingPtr ping;
  SliceView view;
  DisplayParams display;
  std::shared_ptr<const SvColours> colours;
  std::vector<SchoolLayer> layers;
  std::vector<RefusedMark> refused;
  bool north_up = false;
  PictureLook look;
  std::shared_ptr<const SliceMap> earlier;
  std::shared_ptr<FlagRoom> room;  ///< of this slice; one picture at a time uses it
};

/// The ping that a slice's title names.
[[nodiscard]] SlicePing slice_ping(const OpenObservation& observation, std::int64_t ping_index);

/// Colours of the display scale, or of the view curve where a human has changed that.
[[nodiscard]] SvColours slice_colours(const Workspace& workspace);

/// errors  as slice_picture()
[[nodiscard]] Result<SlicePicture> slice_of(const SliceWish& wish, PixelSize size);

}  // namespace sonar
