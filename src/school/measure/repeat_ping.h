// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "base/array.h"
#include "model/mask.h"
#include "school/measure/fading_field.h"
#include "school/measure/measure_input.h"
#include "school/runs.h"
#include "signal/median.h"

namespace sonar {

/// What the neighbourhood of a school would look like under other fading or another threshold (school_errors.h).
class PingRepeater {
 public:
  /// Input and mask are borrowed.
  PingRepeater(const MeasureInput& ping, const PingMask& mask, const MedianParams& median, double tolerance_db);
  /// The mask under other fading. sv(), filtered() and threshold_db() then are the ping's; samples far from the school are as
  /// they were.
  [[nodiscard]] PingMask under_fading(std::uint64_t seed);
  [[nodiscard]] View3<const std::int16_t> sv() const { return sv_.view(); }
  [[nodiscard]] View3<const std::int16_t> filtered() const { return filtered_.view(); }
  [[nodiscard]] double threshold_db() const { return threshold_db_; }
  /// The mask if its threshold lay so much higher.
  [[nodiscard]] PingMask at_threshold(double step_db) const;

 private:
  [[nodiscard]] Array3<std::int16_t> heard_in_box() const;
  /// The level that new fading is put on, and that is filtered then. What is left in it of this ping's own fading would add
  /// to the new one: it is filtered along each beam again. What the filter takes from edges is put on it first.
  /// source  twicing (Tukey 1977, Exploratory data analysis, chapter 16)
  [[nodiscard]] Array3<std::int16_t> smoothed() const;
  /// Members where the filtered level is this (of the box) and the threshold that.
  [[nodiscard]] PingMask mask_again(View3<const std::int16_t> later, double threshold_db) const;
  /// By how much the mask's loud part then is louder.
  [[nodiscard]] double loud_part_db(View3<const std::int16_t> later) const;
  /// By how many counts the members' echo lies above their level. A median of fading is less than its mean, and a
  /// median over a box is less again where a school is not much larger than the box: up to 3 dB in all.
  [[nodiscard]] double echo_of_level() const;

  const MeasureInput& ping_;
  const PingMask& mask_;
  MedianParams median_;
  double tolerance_db_;
  IndexBox box_;  ///< round the school, the water beside it included
  Array3<std::int16_t> sv_;
  Array3<std::int16_t> filtered_;
  // In the box:
  Array3<std::uint8_t> members_;  ///< confidence, 0 = no member
  Array3<std::uint8_t> next_to_;  ///< 1 = within a beam, a fan and half the filter of a member
  Array3<std::int16_t> heard_;    ///< the filtered level
  Array3<std::int16_t> level_;    ///< what new fading is put on
  std::optional<FadingField> field_;
  double echo_of_level_ = 0.0;
  double threshold_db_ = kUnknown;
};

}  // namespace sonar
