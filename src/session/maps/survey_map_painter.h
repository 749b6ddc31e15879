// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/task_thread.h"
#include "model/current.h"
#include "model/depth_grid.h"
#include "model/map_outlines.h"
#include "session/looks/picture_look.h"
#include "session/maps/survey_map_model.h"
#include "session/open/document.h"
#include "view/maps/survey_map.h"

namespace sonar {

/// Everything that a survey map shows, as it was when the picture was asked for.
struct SurveyMapWish {
  std::shared_ptr<const SurveyFiles> survey;
  std::vector<ProductPtr> products;   ///< [observation], null where nothing is measured
  std::vector<SurveyNumber> numbers;  ///< of schools in the survey, as results had them
  bool all_measured = false;
  std::filesystem::path depth_raster;
  SurveyMapStyle style;
  PictureLook look;
};

/// Draws survey maps one after another, and keeps what stays the same between them.
/// threads  one at a time
class SurveyMapPainter {
 public:
  struct Painted {
    FrameDescription frame;
    std::shared_ptr<const SurveyMapPlaces> places;
  };
  using Show = std::function<void(Painted)>;
  /// Shows what is known at once, and what takes long as it comes.
  /// errors  as survey_map()
  [[nodiscard]] Result<void> paint(const SurveyMapWish& wish, PixelSize size, const CancelToken& token,
                                   const Show& show);

 private:
  [[nodiscard]] bool know(const SurveyMapWish& wish);
  void take_products(const SurveyMapWish& wish);
  void take_currents();
  bool know_more(const SurveyMapWish& wish, const CancelToken& token);
  [[nodiscard]] Result<Painted> painted(const SurveyMapWish& wish, PixelSize size);
  const DepthGrid* depths(const SurveyMapWish& wish, const MapFrame& map, std::string& note);

  std::shared_ptr<const SurveyFiles> survey_;
  std::vector<ObservationProduct> light_;      ///< [observation] without masks
  std::vector<ProductPtr> products_;           ///< that light_ was made from
  std::vector<SurveyNumber> numbers_;          ///< the same
  std::vector<ProductPtr> outlined_;           ///< that outlines_ was made from
  std::vector<ObservationOutlines> outlines_;  ///< [observation]
  std::vector<bool> swept_known_;
  std::string recipe_;  ///< that currents_ was read from
  std::shared_ptr<const CurrentProfiles> currents_;
  std::filesystem::path raster_;
  std::optional<GeoExtent> raster_extent_;
  std::optional<DepthGrid> depths_;
  std::string raster_problem_;
};

}  // namespace sonar
