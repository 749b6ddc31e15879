// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "base/result.h"
#include "model/outline.h"
#include "model/product.h"

namespace sonar {

enum class MapFormat { geopackage, geojson };

/// Writes the survey map (INTERFACES section 5), EPSG:4326: one GeoPackage with seven layers, or a folder with one
/// GeoJSON file per layer.
///
/// Longitudes lie in -180 .. 180: what crosses the date line is cut there, in several parts of one feature, so that a
/// LineString or Polygon becomes a MultiLineString or MultiPolygon. Layers of a GeoPackage near the line are declared
/// accordingly. Outlines are built in metres about a ping and then turned into degrees.
/// `school_outlines` has one Polygon for each school and ping: where a mask is in several pieces, strips of 4 cm join
/// them. A school without cells has a feature without geometry, and so has what was measured without a position.
/// Equal products in equal order give equal bytes.
/// threads  one object belongs to one thread
class SurveyMapWriter {
 public:
  /// target        the .gpkg file, or the folder for GeoJSON
  /// observations  those that will be added; only their pings are looked at. The last one's time stands in the file
  ///               instead of today.
  /// errors        io
  static Result<SurveyMapWriter> create(const std::filesystem::path& target, MapFormat format,
                                        std::span<const ObservationProduct> observations);
  SurveyMapWriter(const SurveyMapWriter&) = delete;
  SurveyMapWriter& operator=(const SurveyMapWriter&) = delete;
  SurveyMapWriter(SurveyMapWriter&&) noexcept;
  SurveyMapWriter& operator=(SurveyMapWriter&&) noexcept;
  ~SurveyMapWriter();

  /// Adds one observation; its masks are needed. Call in the survey's order.
  /// placed  how the pings lie
  /// errors  io
  Result<void> add(const ObservationProduct& product, const PlacementOf& placed = &PingNavigation::placement);
  /// Closes, flushes and renames. Without it nothing appears.
  /// errors  io, no_space
  Result<void> finish();

 private:
  struct State;
  explicit SurveyMapWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sonar
