// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "session/looks/picture_look.h"
#include "session/maps/observation_map_model.h"
#include "view/maps/observation_map.h"

namespace sonar {

/// Everything that an observation map shows, as it was when the picture was asked for.
struct ObservationMapWish {
  OpenObservationPtr observation;
  ProductPtr product;  ///< null before the first measuring
  JournalStatePtr state;
  RunningMasks running;
  std::optional<std::int64_t> carried;  ///< number of the school that runs
  std::int64_t ping = 0;
  std::int64_t selected = 0;  ///< school number; 0 = none
  bool rejected = true;
  bool searched = false;  ///< schools were looked for; else that there is none says nothing
  RefusedPtr refused;     ///< that are marked; never null
  std::int64_t chosen_echo = 0;
  MaskPalette palette;
  PictureLook look;
  MapZoom zoom;
};

/// Draws observation maps one after another, and keeps what stays the same between them.
/// threads  one at a time
class ObservationMapPainter {
 public:
  struct Painted {
    FrameDescription frame;
    std::shared_ptr<const ObservationMapPlaces> places;
  };
  /// errors  as observation_map_base()
  [[nodiscard]] Result<Painted> paint(const ObservationMapWish& wish, PixelSize size);

 private:
  Result<void> lay_out(const ObservationMapWish& wish, PixelSize size);

  OpenObservationPtr observation_;
  PictureLook look_;
  MapZoom zoom_;
  ObservationProduct head_;
  std::optional<ObservationMapBase> base_;
  std::shared_ptr<const MapFrame> map_;
  std::shared_ptr<const std::vector<PixelPoint>> track_;
  MosaicFollower mosaic_;
};

}  // namespace sonar
