// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "signal/block_levels.h"
#include "signal/flag_kernels.h"
#include "signal/flags.h"

namespace sonar {

namespace {

int counts_of(double db) { return static_cast<int>(std::lround(counts_from_db(db))); }

/// Half-open stretch of slices.
struct Slices {
  int begin = 0;
  int end = 0;
};

/// Median over i - half .. i + half of one row, clipped at its ends, without kNoData; values in steps of 32 counts,
/// renewed every few samples.
class RunningMedian {
 public:
  static constexpr int kRenewed = 4;  ///< for speed, as the coarse bins: far below what a shell is judged by

  void run(std::span<const std::int16_t> values, int half, std::span<std::int16_t> out) {
    std::fill(bins_.begin(), bins_.end(), 0);
    number_ = below_ = pointer_ = 0;
    const int size = static_cast<int>(values.size());
    for (int i = 0; i < std::min(half, size); ++i) change(values[static_cast<std::size_t>(i)], 1);
    std::int16_t now = kNoData;
    for (int i = 0; i < size; ++i) {
      if (i + half < size) change(values[static_cast<std::size_t>(i + half)], 1);
      if (i - half - 1 >= 0) change(values[static_cast<std::size_t>(i - half - 1)], -1);
      if (i % kRenewed == 0) now = middle();
      out[static_cast<std::size_t>(i)] = now;
    }
  }

 private:
  void change(std::int16_t value, int by) {
    if (value == kNoData) return;
    const int bin = (value + 32768) / 32;
    bins_[static_cast<std::size_t>(bin)] += by;
    number_ += by;
    below_ += by * static_cast<int>(bin < pointer_);  // without a branch: speckle makes it a coin's toss
  }
  std::int16_t middle() {
    if (number_ == 0) return kNoData;
    const int rank = number_ / 2;
    while (below_ > rank) below_ -= bins_[static_cast<std::size_t>(--pointer_)];
    while (below_ + bins_[static_cast<std::size_t>(pointer_)] <= rank) {
      below_ += bins_[static_cast<std::size_t>(pointer_++)];
    }
    return static_cast<std::int16_t>(std::max(pointer_ * 32 - 32768, -32767));
  }

  std::vector<int> bins_ = std::vector<int>(2048);
  int number_ = 0;
  int below_ = 0;
  int pointer_ = 0;
};

class InterferenceFinder {
 public:
  InterferenceFinder(View3<const std::int16_t> power, const BlockLevels& levels, const InterferenceParams& params,
                     View3<SampleFlags> flags, std::vector<std::int16_t>& scratch)
      : params_(params), shape_(power.shape()), flags_(flags) {
    scratch.resize(shape_.size());
    relative_ = {scratch.data(), shape_};
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      const int own = levels.background(row);
      const auto offset = static_cast<std::int16_t>(own == BlockLevels::kUnknown ? 0 : own);
      copy_unflagged(power.row(row), flags.row(row), kNotFiltered, offset, relative_.row(row));
    }
    const auto per_fan = static_cast<std::size_t>(shape_.fans) * samples();
    level_.resize(per_fan);
    usual_.resize(per_fan);
    excess_.resize(per_fan);
    RunningMedian median;
    for (int fan = 0; fan < shape_.fans; ++fan) {
      quantile_over_rows(relative_.row(fan, 0).data(), shape_.beams, shape_.samples, 1.0 - params.beam_fraction,
                         params.minimum_beams, of(level_, fan).data());
      median.run(of(level_, fan), params.window_samples, of(usual_, fan));
      for (std::size_t s = 0; s < samples(); ++s) {
        const bool known = of(level_, fan)[s] != kNoData;
        of(excess_, fan)[s] = known ? of(level_, fan)[s] - of(usual_, fan)[s] : kUnjudged;
      }
    }
  }

  void flag_all_fans() {
    if (shape_.fans < 2) return;
    const int threshold = counts_of(params_.threshold_db);
    std::vector<int> known(samples(), 0);
    std::vector<int> high(samples(), 0);
    for (int fan = 0; fan < shape_.fans; ++fan) {
      const int* excess = of(excess_, fan).data();
      for (std::size_t s = 0; s < samples(); ++s) {
        known[s] += excess[s] != kUnjudged ? 1 : 0;
        high[s] += excess[s] > threshold ? 1 : 0;
      }
    }
    candidate_.resize(samples());
    for (std::size_t s = 0; s < samples(); ++s) candidate_[s] = known[s] > 1 && most(high[s], known[s]) ? 1 : 0;
    for_each_candidate([&](Slices shell) {
      const auto s = static_cast<std::size_t>(shell.begin);
      int sharp = 0;
      for (int fan = 0; fan < shape_.fans; ++fan) {
        sharp += of(excess_, fan)[s] != kUnjudged && is_sharp(fan, shell, threshold) ? 1 : 0;
      }
      if (!most(sharp, known[s])) return;
      for (int fan = 0; fan < shape_.fans; ++fan) flag(fan, shell);
    });
  }

  void flag_fan(int fan) {
    const int threshold = counts_of(params_.fan_threshold_db);
    candidate_.resize(samples());
    const int* excess = of(excess_, fan).data();
    for (std::size_t s = 0; s < samples(); ++s) candidate_[s] = excess[s] > threshold ? 1 : 0;
    for_each_candidate([&](Slices shell) {
      if (is_sharp(fan, shell, threshold)) flag(fan, shell);
    });
  }

 private:
  static constexpr int kUnjudged = std::numeric_limits<int>::min();

  [[nodiscard]] std::size_t samples() const { return static_cast<std::size_t>(shape_.samples); }
  template <class T>
  std::span<T> of(std::vector<T>& per_fan, int fan) const {
    return std::span(per_fan).subspan(static_cast<std::size_t>(fan) * samples(), samples());
  }
  [[nodiscard]] bool most(int part, int whole) const { return part >= params_.beam_fraction * whole; }
  std::int16_t level(int fan, int s) const {
    return level_[static_cast<std::size_t>(fan) * samples() + static_cast<std::size_t>(s)];
  }

  /// Stretches of candidate slices, small gaps closed, of a shell's thickness and not at the near end of the data.
  template <class Body>
  void for_each_candidate(const Body& body) {
    for (int s = 0; s < shape_.samples; ++s) {
      if (candidate_[static_cast<std::size_t>(s)] == 0) continue;
      Slices shell{s, s + 1};
      for (int i = s + 1; i < std::min(shell.end + params_.gap_samples + 1, shape_.samples); ++i) {
        if (candidate_[static_cast<std::size_t>(i)] != 0) shell.end = i + 1;
      }
      if (shell.end - shell.begin <= params_.maximum_samples) body(shell);
      s = shell.end;
    }
  }

  /// True where a fan's level falls by the threshold on both sides of a shell, within a few slices and for all beams
  /// alike. The seabed falls slowly; a school's beams do not begin at one range.
  bool is_sharp(int fan, Slices shell, int threshold) {
    int peak = kNoData;
    for (int s = shell.begin; s < shell.end; ++s) peak = std::max<int>(peak, level(fan, s));
    const int limit = of(usual_, fan)[static_cast<std::size_t>(shell.begin)] + threshold;
    return side_is_sharp(fan, shell.begin, -1, peak, limit, threshold) &&
           side_is_sharp(fan, shell.end - 1, 1, peak, limit, threshold);
  }

  bool side_is_sharp(int fan, int edge, int direction, int peak, int limit, int threshold) {
    int known = 0;
    for (int n = params_.shoulder_near_samples; n <= params_.shoulder_far_samples; ++n) {
      const int s = edge + direction * n;
      if (s < 0 || s >= shape_.samples || level(fan, s) == kNoData) continue;
      if (level(fan, s) > peak - threshold) return false;
      ++known;
    }
    // Nearer than the first usable sample nothing tells a shell from a school's or the near field's tail.
    if (known == 0) return direction > 0;
    const double beside =
        share_above(fan, edge, direction, params_.shoulder_near_samples, params_.shoulder_far_samples, limit);
    const double farther =
        share_above(fan, edge, direction, params_.maximum_samples + 1, params_.window_samples, limit);
    return beside - farther <= params_.tapered_share;
  }

  /// Share of a fan's sound samples above a limit, `from`..`to` slices off an edge.
  [[nodiscard]] double share_above(int fan, int edge, int direction, int from, int to, int limit) const {
    int data = 0;
    int above = 0;
    for (int beam = 0; beam < shape_.beams; ++beam) {
      const auto row = relative_.row(fan, beam);
      for (int n = from; n <= to; ++n) {
        const int s = edge + direction * n;
        if (s < 0 || s >= shape_.samples || row[static_cast<std::size_t>(s)] == kNoData) continue;
        ++data;
        above += row[static_cast<std::size_t>(s)] > limit ? 1 : 0;
      }
    }
    return data > 0 ? static_cast<double>(above) / data : 0.0;
  }

  /// With a margin on either side: the blurred edge.
  void flag(int fan, Slices shell) {
    for (int beam = 0; beam < shape_.beams; ++beam) {
      const auto row = flags_.row(fan, beam);
      for (int s = std::max(shell.begin - params_.margin_samples, 0);
           s < std::min(shell.end + params_.margin_samples, shape_.samples); ++s) {
        row[static_cast<std::size_t>(s)] |= SampleFlags::interference;
      }
    }
  }

  const InterferenceParams& params_;
  Shape3 shape_;
  View3<SampleFlags> flags_;
  View3<std::int16_t> relative_;     ///< counts above each beam's own background; kNoData where flagged
  std::vector<std::int16_t> level_;  ///< [fan][sample] what most beams reach
  std::vector<std::int16_t> usual_;  ///< [fan][sample] its running median
  std::vector<int> excess_;          ///< [fan][sample] the one above the other, kUnjudged where too few beams are sound
  std::vector<char> candidate_;      ///< [sample]
};

}  // namespace

void flag_interference(View3<const std::int16_t> power, const BlockLevels& levels, const InterferenceParams& params,
                       View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape());
  const int beams = power.shape().beams;
  if (!params.enabled || power.all().empty() || beams < params.minimum_beams || beams > 32767) return;
  static thread_local std::vector<std::int16_t> scratch;
  InterferenceFinder finder(power, levels, params, flags, scratch);
  finder.flag_all_fans();
  for (int fan = 0; fan < power.shape().fans; ++fan) finder.flag_fan(fan);
}

void flag_interference(View3<const std::int16_t> power, const InterferenceParams& params, View3<SampleFlags> flags) {
  if (params.enabled) flag_interference(power, BlockLevels(power, flags, CorruptedPacketParams{}), params, flags);
}

}  // namespace sonar
