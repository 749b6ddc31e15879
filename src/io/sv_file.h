// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "base/sample_flags.h"
#include "model/product.h"

namespace sonar {

/// One ping's arrays for write of an SvFile; borrowed, all of the grid's shape [fan][beam][sample].
struct SvPing {
  View3<const std::int16_t> sv;        ///< unfiltered Sv counts; kNoData = none
  View3<const std::int16_t> filtered;  ///< median-filtered Sv counts
  View3<const SampleFlags> flags;
  /// Sv counts = power counts + this; one table serves many pings.
  std::shared_ptr<const Array3<std::int16_t>> calibration;
  std::span<const double> background_db;  ///< [row] power that was subtracted, dB re 1 W; NaN = none
};

/// Calibrated Sv of some pings of an observation as netCDF-4: what a school's figures are worked out from, with its masks. The
/// file is made in memory: whoever has many pings makes several.
/// threads  one object belongs to one thread; calls into netCDF take turns with others'
class SvFile {
 public:
  /// product     with masks that fit its grid, which it has
  /// first_ping  of the file; `pings` of them
  SvFile(const std::filesystem::path& path, const ObservationProduct& product, std::size_t first_ping,
         std::size_t pings);
  ~SvFile();
  SvFile(const SvFile&) = delete;
  SvFile& operator=(const SvFile&) = delete;

  /// Writes a ping's arrays; pings that are never written are without data.
  /// ping  index in the observation
  void write(std::size_t ping, const SvPing& arrays);
  /// The whole file under its name.
  /// errors  io, no_space, usage (as AtomicFile)
  [[nodiscard]] Result<void> finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sonar
