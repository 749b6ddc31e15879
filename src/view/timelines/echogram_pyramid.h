// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/time.h"
#include "base/units.h"
#include "geo/sector.h"
#include "model/volume.h"

namespace sonar {

/// All beams of some pings and ranges as one value: linear mean (volume-weighted), smallest and largest Sv.
struct EchogramCell {
  float sv_volume = 0.0F;        ///< sum of sv V, m^-1 m^3
  float volume_m3 = 0.0F;        ///< of the samples that have data; 0 = no data
  std::int16_t low = kMaxCount;  ///< Sv counts
  std::int16_t high = kMinCount;
  [[nodiscard]] bool empty() const { return !(volume_m3 > 0.0F); }
  /// Sv counts; kNoData where empty.
  [[nodiscard]] std::int16_t mean_count() const;
  void add(const EchogramCell& other);
  friend bool operator==(const EchogramCell&, const EchogramCell&) = default;
};

/// The range bins of an echogram's finest level: bin i holds samples whose middle lies in first_m + i * bin_m ..
struct EchogramRange {
  double first_m = 0.0;
  double bin_m = 1.0;
  int bins = 512;
  /// The same ranges in fewer bins.
  [[nodiscard]] EchogramRange coarser(int fewer) const {
    return fewer == bins ? *this : EchogramRange{first_m, bin_m * bins / fewer, fewer};
  }
  friend bool operator==(const EchogramRange&, const EchogramRange&) = default;
};
/// The bin that a range or depth falls into; -1 = none.
[[nodiscard]] int bin_of(const EchogramRange& range, double height_m);
/// Bins for a sonar's ranges: from 0 to the last sample, no finer than the samples, at most `most`.
[[nodiscard]] EchogramRange echogram_range(const RangeAxis& axis, int most = 512);

/// One ping's column while beams are added to it. Sums are doubles, in the order of the beams: the same on every machine.
class EchogramColumn {
 public:
  /// samples  of each beam, at most
  EchogramColumn(const EchogramRange& range, int samples);

  /// A beam's samples, as many as there are in the shortest.
  struct Beam {
    std::span<const std::int16_t> counts;  ///< Sv counts
    std::span<const SampleFlags> flags;
    std::span<const double> volumes_m3;  ///< 0 = left out
  };
  /// Where the samples of the beams that follow lie: sample i at first_m + i * step_m.
  void lay(double first_m, double step_m);
  /// Where each of them lies; [samples], in metres.
  void lay(std::span<const double> heights_m);
  /// Flagged samples, and those outside the range, are left out.
  void add(const Beam& beam, SampleFlags hidden);
  [[nodiscard]] std::vector<EchogramCell> cells() const;

 private:
  EchogramRange range_;
  std::vector<int> bin_of_;  ///< [sample]; -1 = outside
  double first_m_ = std::numeric_limits<double>::quiet_NaN();
  double step_m_ = 0.0;
  std::vector<double> sums_;
  std::vector<double> volumes_;
  std::vector<EchogramCell> cells_;
};

/// One ping's column: every sample of every beam, flagged ones left out.
/// volume  Sv counts and flags
/// hidden  samples with one of these flags are left out
/// cost    one pass over the volume
[[nodiscard]] std::vector<EchogramCell> echogram_column(const Sector& sector, const Volume& volume, SampleFlags hidden,
                                                        const EchogramRange& range);

/// One resolution of an echogram.
struct EchogramLevel {
  int bins = 0;
  std::size_t columns = 0;
  std::vector<EchogramCell> cells;  ///< [column][bin]
  friend bool operator==(const EchogramLevel&, const EchogramLevel&) = default;
};

/// An observation as an echogram, built ping by ping, at every resolution: a level has half the columns of the one
/// below, and half its range bins as long as 256 are left (a week is wide, not high); each cell is made of those below
/// it. Drawing needs only the level that fits.
/// memory  12 bytes a cell: with 512 bins 6 kB a column, and about as much again for the levels above; a week of pings
///         every 5 s with 16 pings a column and 256 bins takes 50 MB
/// threads  built by one thread; reading a pyramid that no one adds to is safe from any
class EchogramPyramid {
 public:
  /// pings_per_column  of the finest level; over 1 for surveys of days
  explicit EchogramPyramid(const EchogramRange& range, int pings_per_column = 1);

  /// Appends a ping. Times must not fall. An empty column (a bad ping) keeps its place without data.
  /// column        [range.bins] or empty
  /// distance_nmi  the vessel's log; NaN = unknown
  void add_ping(TimeNs time, std::span<const EchogramCell> column, double distance_nmi = kUnknownDistance);

  [[nodiscard]] const EchogramRange& range() const { return range_; }
  [[nodiscard]] int pings_per_column() const { return pings_per_column_; }
  [[nodiscard]] std::size_t pings() const { return times_.size(); }
  [[nodiscard]] const std::vector<TimeNs>& times() const { return times_; }
  [[nodiscard]] const std::vector<double>& distances_nmi() const { return distances_; }

  [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
  [[nodiscard]] std::size_t columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }
  [[nodiscard]] int bins(int level) const { return levels_[static_cast<std::size_t>(level)].bins; }
  [[nodiscard]] const EchogramCell& cell(int level, std::size_t column, int bin) const;
  [[nodiscard]] const EchogramLevel& level(int level) const { return levels_[static_cast<std::size_t>(level)]; }

  /// The same echogram from a level on, as if it were the finest; at most to the last one.
  [[nodiscard]] EchogramPyramid coarser(int level) const;
  /// A pyramid from its parts as they were kept. Empty where they do not belong together.
  [[nodiscard]] static std::optional<EchogramPyramid> of_parts(const EchogramRange& range, int pings_per_column,
                                                               std::vector<TimeNs> times,
                                                               std::vector<double> distances_nmi,
                                                               std::vector<EchogramLevel> levels);

  static constexpr double kUnknownDistance = std::numeric_limits<double>::quiet_NaN();
  static constexpr int kLeastBins = 256;

 private:
  void renew(std::size_t level, std::size_t column);

  EchogramRange range_;
  int pings_per_column_ = 1;
  std::vector<TimeNs> times_;
  std::vector<double> distances_;
  std::vector<EchogramLevel> levels_;
};

}  // namespace sonar
