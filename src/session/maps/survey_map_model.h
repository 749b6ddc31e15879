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
#include "session/open/workspace.h"
#include "session/tools/map_measure.h"

namespace sonar {

class SurveyMapPainter;

/// What lies where on a survey map, for pointers.
struct SurveyMapPlaces {
  struct School {
    SchoolName name;
    std::int64_t first_ping = 0;
    PixelPoint at;
    double radius_px = 0.0;
  };
  struct Ping {
    std::size_t observation = 0;
    std::int64_t ping = 0;
  };
  std::shared_ptr<const MapFrame> map;
  double whole_metres_per_px = 1.0;
  double scale = 1.0;  ///< pixels a unit of the window: how far a pointer reaches
  std::vector<School> schools;
  std::vector<std::vector<PixelPoint>> tracks;  ///< [observation][ping], NaN without a position

  /// Null where none lies there.
  [[nodiscard]] const School* school_at(PixelPoint at) const;
  [[nodiscard]] std::optional<Ping> ping_at(PixelPoint at) const;
};

/// All observations of the survey over the depth chart: tracks, what was swept, schools as far as they are known. A click
/// on a school selects it and looks at its first ping; one on a track looks at that ping.
class SurveyMapModel : public LivePicture {
 public:
  explicit SurveyMapModel(Workspace& workspace);

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] bool pans() const override { return true; }
  bool aim(PixelPoint at) override;
  [[nodiscard]] std::vector<Overlay> overlays() const override;
  [[nodiscard]] PointerShape pointer_shape() const override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null before the first.
  [[nodiscard]] const std::shared_ptr<const SurveyMapPlaces>& places() const { return places_; }
  void show_all();

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void hear(DocumentChange change);
  void click(PixelPoint at);

  Workspace& workspace_;
  MapGesture gesture_;
  MapMeasure measure_{workspace_};
  std::shared_ptr<SurveyMapPainter> painter_;
  std::shared_ptr<const SurveyMapPlaces> places_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
