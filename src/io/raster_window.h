// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "geo/frames.h"

namespace sonar {

/// Keeps GDAL from printing while it lives.
class SilentGdal {
 public:
  SilentGdal();
  ~SilentGdal();
  SilentGdal(const SilentGdal&) = delete;
  SilentGdal& operator=(const SilentGdal&) = delete;
};

/// Pixels of a raster; first included, end not.
struct PixelWindow {
  int first_x = 0;
  int first_y = 0;
  int end_x = 0;
  int end_y = 0;
  [[nodiscard]] bool empty() const { return end_x <= first_x || end_y <= first_y; }
};

/// A place in a raster in pixels: (0, 0) is the upper left corner of the first pixel, (0.5, 0.5) its centre.
struct RasterPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Where latitudes and longitudes lie in a raster of any coordinate system.
/// threads  one object belongs to one thread
class RasterPlaces {
 public:
  /// errors  format: no georeference, a degenerate one, no coordinate system that says where on Earth it lies
  static Result<RasterPlaces> of(GDALDataset& dataset, const std::string& named);

  /// Empty where the coordinate system has no place for it. Geographic rasters: x within the raster's own turn.
  [[nodiscard]] std::optional<RasterPoint> at(const Geographic& place) const;
  /// Pixel size, degrees of latitude (about).
  [[nodiscard]] double step_deg() const { return step_deg_; }
  /// Whether one more turn to the east is the same place.
  [[nodiscard]] bool geographic() const { return geographic_; }

 private:
  RasterPlaces() = default;
  [[nodiscard]] RasterPoint pixel(double x, double y) const;
  std::array<double, 6> inverse_{};
  double west_deg_ = 0.0;  ///< geographic: where the raster's turn begins
  bool geographic_ = false;
  double step_deg_ = 0.0;
  struct Destroy {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
  };
  std::unique_ptr<OGRCoordinateTransformation, Destroy> transform_;
};

/// Values of a window, averaged where it is larger than asked for. NaN = no value.
struct RasterValues {
  PixelWindow window;
  int width = 0;
  int height = 0;
  std::vector<float> values;  ///< [height][width]

  /// Bilinear at a place of the raster; with unknown neighbours the nearest; NaN outside the window.
  [[nodiscard]] float at(const RasterPoint& p) const;
};

/// most_side  of the values read
/// errors     format: the bytes cannot be read; a block of them would take over 1 GiB
[[nodiscard]] Result<RasterValues> read_window(GDALRasterBand& band, const PixelWindow& window, int most_side,
                                               const std::string& named);

}  // namespace sonar
