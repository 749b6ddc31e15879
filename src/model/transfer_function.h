// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.h"

namespace sonar {

struct TransferPoint {
  double sv_db = 0.0;
  double opacity = 0.0;                      ///< 0..1 for opacity_length_m of water
  std::array<double, 3> rgb{1.0, 1.0, 1.0};  ///< 0..1
  friend bool operator==(const TransferPoint&, const TransferPoint&) = default;
};

/// Sv -> opacity and colour, linear in dB between points, constant outside. Regions grow on its opacity.
class TransferFunction {
 public:
  /// The default growth curve: 0 at -70 dB to 1 at -30 dB.
  TransferFunction();
  /// errors  bad_parameter: fewer than one point, sv_db not strictly rising, opacity outside 0..1, length not positive
  static Result<TransferFunction> make(std::vector<TransferPoint> points, double opacity_length_m);

  [[nodiscard]] double opacity_length_m() const { return opacity_length_m_; }
  [[nodiscard]] const std::vector<TransferPoint>& points() const { return points_; }
  [[nodiscard]] double opacity(double sv_db) const;
  [[nodiscard]] std::array<double, 3> colour(double sv_db) const;
  /// How many dB one unit of opacity is worth, from the first point to the last; none where opacity ends no higher.
  [[nodiscard]] std::optional<double> mean_db_per_opacity() const;
  /// Opacity of every Sv count: entry [count + 32768]; 0 for "no data".
  [[nodiscard]] std::vector<float> table_i16() const;
  /// Opacity and colour at `size` even steps of dB from first_db to last_db: RGBA, 0..1.
  [[nodiscard]] std::vector<std::array<float, 4>> table(int size, double first_db, double last_db) const;

  friend bool operator==(const TransferFunction&, const TransferFunction&) = default;

 private:
  std::vector<TransferPoint> points_;
  double opacity_length_m_ = 10.0;
};

}  // namespace sonar
