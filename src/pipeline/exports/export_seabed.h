// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "base/work.h"
#include "io/atomic_file.h"
#include "io/seabed_raster.h"
#include "model/product.h"
#include "model/school.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// The seabed as one beam of one ping sees it: a row of seabed.csv. NaN = unknown.
struct SeabedRow {
  std::string observation;
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  std::int64_t channel = 0;
  std::int64_t fan = 0;
  std::int64_t beam = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double range_m = kUnknown;  ///< slant, of the middle of the echo's strongest part
  double depth_m = kUnknown;  ///< there on the beam's axis, below the mean water line, positive down
  double depth_se_m = kUnknown;
  double below_plane_m = kUnknown;  ///< the ping's plane, positive down
};

template <class Visitor>
void columns(Visitor& v, SeabedRow& r) {
  v("observation", "", r.observation);
  v("ping_index", "1", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("channel", "1", r.channel);
  v("fan", "1", r.fan);
  v("beam", "1", r.beam);
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("range_m", "m", r.range_m);
  v("depth_m", "m", r.depth_m);
  v("depth_se_m", "m", r.depth_se_m);
  v("below_plane_m", "m", r.below_plane_m);
}

/// Writes the seabed of products' pings, one product after the other: seabed.csv, a row a beam, and seabed.tif. The seabed
/// is found again in the raw files, under the products' recipe and background: products hold nothing of it but
/// bottom_depth_m at schools.
class SeabedExport {
 public:
  /// errors  io, no_space; bad_parameter
  [[nodiscard]] static Result<SeabedExport> create(const std::filesystem::path& dest, const SeabedRasterParams& params);
  /// Nothing is written of a product without a grid.
  /// product  with its background levels
  /// errors   mismatch: the survey's observation has not the product's pings; io, no_space; cancelled
  [[nodiscard]] Result<void> add(const SurveyFiles& survey, const ObservationProduct& product, const Recipe& recipe,
                                 Work& work);
  /// The files, once they are whole; the raster is left out where no beam's place is known.
  /// errors  unsupported: no beam saw the seabed; io, no_space
  [[nodiscard]] Result<std::vector<std::filesystem::path>> finish();

 private:
  SeabedExport(AtomicFile table, std::filesystem::path dest, const SeabedRasterParams& params)
      : table_(std::move(table)), dest_(std::move(dest)), params_(params) {}
  [[nodiscard]] Result<void> write(const Engine& engine, const ObservationProduct& product, const StagedPing& ping);

  AtomicFile table_;
  std::filesystem::path dest_;
  SeabedRasterParams params_;
  std::unique_ptr<SeabedRaster> raster_;  ///< from the first depth with a place on
  std::string title_;
  std::int64_t rows_ = 0;
};

}  // namespace sonar
