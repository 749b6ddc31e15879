// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/maps/map_gesture.h"
#include "session/maps/masked_pings.h"
#include "session/open/workspace.h"
#include "session/tools/map_measure.h"
#include "view/refused_marks.h"

namespace sonar {

class ObservationMapPainter;

/// What lies where on an observation map, for pointers; and what the picture cost.
struct ObservationMapPlaces {
  std::size_t observation = 0;
  std::shared_ptr<const MapFrame> map;
  double whole_metres_per_px = 1.0;
  double scale = 1.0;                                    ///< pixels a unit of the window: how far a pointer reaches
  std::shared_ptr<const std::vector<PixelPoint>> track;  ///< [ping], NaN without a position
  double cell_px = 1.0;
  int width = 0;
  int height = 0;
  std::vector<MaskMosaic::Cell> cells;
  std::vector<std::int64_t> numbers;  ///< of the schools on show, rising
  std::vector<PlacedMark> refused;
  std::size_t pings_set = 0;        ///< of the mosaic, by this picture
  std::uint64_t cells_touched = 0;  ///< of the mosaic so far

  /// Number of the school that has a place; 0 = none.
  [[nodiscard]] std::int64_t school_at(PixelPoint at) const;
  /// The ping whose ship lies nearest, no farther than `reach_px`.
  [[nodiscard]] std::optional<std::int64_t> ping_at(PixelPoint at, double reach_px) const;
};

/// The observation on show from above: ship and path, what was swept, the masks of all pings (a running propagation's
/// among them), schools with paths and numbers. A click on the path looks at that ping, one on a school selects it.
class ObservationMapModel : public LivePicture {
 public:
  explicit ObservationMapModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] PointerShape pointer_shape() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const ObservationMapPlaces>& places() const { return places_; }
  void show_all();

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  void click(PixelPoint at);
  [[nodiscard]] std::optional<EchoName> echo_at(PixelPoint at) const;

  Workspace& workspace_;
  MapGesture gesture_;
  MapMeasure measure_{workspace_};
  RunningMasks running_;
  std::shared_ptr<ObservationMapPainter> painter_;
  std::shared_ptr<const ObservationMapPlaces> places_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
