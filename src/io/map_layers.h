// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "io/atomic_file.h"
#include "io/geojson_file.h"
#include "io/survey_layers.h"
#include "io/table_columns.h"

namespace sonar {

/// The open layers of one map: tables of features in files that appear together when committed.
class MapLayers {
 public:
  static Result<std::unique_ptr<MapLayers>> create(const std::filesystem::path& target, MapFormat format,
                                                   TimeNs last_ping_time);
  ~MapLayers();
  MapLayers(const MapLayers&) = delete;
  MapLayers& operator=(const MapLayers&) = delete;

  /// columns  names and types of the attributes
  Result<void> add_layer(const std::string& name, OGRwkbGeometryType type, const std::vector<TableColumn>& columns);
  /// Adds one feature with the values of one row; an empty or null geometry is left out, one that crosses the date line
  /// is cut there.
  Result<void> add(const std::string& layer, const OGRGeometry* geometry, const std::vector<TableColumn>& columns,
                   std::size_t row);
  Result<void> commit();

 private:
  struct DatasetCloser {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
  };
  using Dataset = std::unique_ptr<GDALDataset, DatasetCloser>;
  MapLayers(std::filesystem::path target, MapFormat format, TimeNs last_ping_time);
  Result<void> open_geopackage();
  Result<void> execute(const std::string& sql);
  Result<void> describe_columns();
  Result<void> add_styles();
  [[nodiscard]] tl::unexpected<Error> refused(std::string_view what) const;

  std::filesystem::path target_;
  MapFormat format_;
  std::string date_;
  std::string failure_;  ///< the first that GDAL told
  std::optional<AtomicFile> geopackage_;
  Dataset dataset_;
  std::map<std::string, OGRLayer*> layers_;                  ///< of the GeoPackage
  std::map<std::string, std::vector<TableColumn>> columns_;  ///< names and units, by layer of the GeoPackage
  std::map<std::string, GeoJsonFile> json_files_;            ///< by layer
};

}  // namespace sonar
