// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sonar_explorer/ping.h"

namespace sonar {
struct ObservationProduct;
}

namespace sonar_explorer {

/// One column of a table, one value a row.
struct Column {
  std::string name;           ///< as in schools.csv
  std::string unit;           ///< UDUNITS, or of decibels; "1" and empty = none
  std::string long_name;      ///< what it is
  std::string standard_name;  ///< of the CF table; empty = there is none
  /// Numbers (NaN = unknown), whole numbers or texts; times are texts, ISO 8601.
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> values;
  std::vector<std::int64_t> times_ns = {};  ///< of a column of times: since 1970, UTC, 0 = unknown; else empty
  std::vector<std::int64_t> flags = {};     ///< what whole numbers may be, or their bits; empty = they are no flags
  bool flags_are_bits = false;              ///< several may be set at once
  std::string flag_meanings = {};           ///< a word for each of `flags`, apart by blanks
};
using Table = std::vector<Column>;

/// Neighbouring samples of one beam.
struct MaskRun {
  int fan = 0;
  int beam = 0;
  int first_sample = 0;
  int count = 0;
};

/// A school's voxels in one ping.
struct Mask {
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  std::vector<MaskRun> runs;             ///< sorted by fan, beam and sample, without overlap
  std::vector<std::uint8_t> confidence;  ///< of each voxel in the order of the runs, 1 to 255 for 255 f
};

/// What was found in an observation: schools, their masks and figures. A value that does not change.
/// threads  any
class Product {
 public:
  explicit Product(std::shared_ptr<const sonar::ObservationProduct> own) : own_(std::move(own)) {}
  /// throws  Error: not_found, io, format, newer_version, older_version
  [[nodiscard]] static Product read(const std::filesystem::path& file);
  /// One netCDF file, whole or not at all.
  /// throws  Error: not_found (no such folder), io, no_space, usage (where raw files lie)
  void write(const std::filesystem::path& file) const;

  [[nodiscard]] const std::string& observation() const;
  [[nodiscard]] const std::string& recipe_json() const;
  /// Of the grid that masks lie on; empty without one.
  [[nodiscard]] std::optional<Shape> shape() const;
  [[nodiscard]] Table schools() const;       ///< a row for each school
  [[nodiscard]] Table school_pings() const;  ///< a row for each school and ping
  [[nodiscard]] Table rejected() const;      ///< echoes that were judged not to be schools
  [[nodiscard]] std::vector<Mask> masks() const;
  /// [fan][beam][sample] the school of each voxel of a ping; 0 = none
  /// throws  Error: usage: no such ping
  [[nodiscard]] std::vector<std::int32_t> school_ids(std::int64_t ping) const;
  /// What is worth knowing, a line each.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// A product with other masks in place of its own, whose figures measure() works out.
  /// masks   of schools that the product has; of the others nothing stays
  /// throws  Error: bad_parameter: a mask that does not fit, or of no school of the product
  [[nodiscard]] Product with_masks(const std::vector<Mask>& masks) const;

  [[nodiscard]] const sonar::ObservationProduct& own() const { return *own_; }

 private:
  std::shared_ptr<const sonar::ObservationProduct> own_;
};

}  // namespace sonar_explorer
