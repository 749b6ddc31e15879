// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ogr_geometry.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/atomic_file.h"
#include "io/table_columns.h"

namespace sonar {

/// One layer of the map as a GeoJSON FeatureCollection that appears when whole. GDAL's own writer tells nobody of a full
/// disk, leaves unknown values out and writes times in a style of its own.
class GeoJsonFile {
 public:
  /// errors  io, no_space
  static Result<GeoJsonFile> create(const std::filesystem::path& target, std::string_view layer);
  /// One feature with the values of one row: coordinates with 8 decimals, times as ISO 8601 with Z, null where a value
  /// or the geometry is unknown.
  /// errors  io, no_space
  Result<void> add(const OGRGeometry* geometry, const std::vector<TableColumn>& columns, std::size_t row);
  /// Ends the collection; what the disk has no room for shows here at the latest, before any file of a map appears.
  /// errors  io, no_space
  Result<void> close();
  /// After close().
  /// errors  io, no_space
  Result<void> commit() { return file_.commit(); }

 private:
  explicit GeoJsonFile(AtomicFile file) : file_(std::move(file)) {}
  Result<void> write(std::string_view text);
  Result<void> flush();

  AtomicFile file_;
  std::string buffer_;
  bool empty_ = true;
};

}  // namespace sonar
