// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "signal/beam_overlap.h"
#include "signal/block_levels.h"
#include "signal/flags.h"

namespace sonar {

namespace {

using Row = std::span<const std::int16_t>;

int counts_of(double db) { return static_cast<int>(std::lround(counts_from_db(db))); }

/// Half-open stretch of blocks or samples.
struct Stretch {
  int begin = 0;
  int end = 0;
};

class CorruptedPackets {
 public:
  CorruptedPackets(View3<const std::int16_t> power, const BlockLevels& levels, const CorruptedPacketParams& params,
                   std::span<const double> fan_loss_db, View3<SampleFlags> flags)
      : power_(power),
        flags_(flags),
        params_(params),
        block_(levels.block_samples()),
        levels_(levels),
        fan_loss_db_(fan_loss_db),
        threshold_(counts_of(params.threshold_db)),
        neighbour_(counts_of(params.neighbour_db)),
        spread_(counts_of(params.beam_spread_db)) {}

  void flag_row(int row) {
    hot_.assign(static_cast<std::size_t>(levels_.blocks()), false);
    isolated_ = isolated(row);
    bool found = false;
    for (int block = 0; block < levels_.blocks(); ++block) {
      const bool hot = is_hot(row, block);
      hot_[static_cast<std::size_t>(block)] = hot;
      found = found || hot;
    }
    if (!found) return;
    for (Stretch blocks{0, 0}; next_stretch(row, blocks);) flag_stretch(row, blocks);
  }

 private:
  /// Above the neighbours both in level and relative to the beams' own backgrounds; or, for a beam that is hot all
  /// along, in level alone and by more than beams differ.
  bool is_hot(int row, int block) {
    const int level = levels_.level(row, block);
    if (level == BlockLevels::kUnknown) return false;
    if (is_above(row, block, false, level, spread_ + isolated_)) return true;
    const int above_own = level - levels_.background(row);
    return above_own >= threshold_ && is_above(row, block, true, above_own, isolated_) &&
           is_above(row, block, false, level, isolated_);
  }

  /// By how much more a beam must exceed its neighbours, counts, where a school in its middle already exceeds them as a beam with corrupted packets does.
  [[nodiscard]] int isolated(int row) const {
    const auto r = static_cast<std::size_t>(row);
    const double loss_db = r < fan_loss_db_.size() ? fan_loss_db_[r] : 0.0;
    return loss_db > params_.separate_beams_db ? counts_of(loss_db) : 0;
  }

  /// Above the median of the up to 8 neighbours, above both neighbours in fan (in beam on a sonar of one fan), and above
  /// the median of the nearest of its own fan: a whole fan may see what its neighbours do not, the surface.
  bool is_above(int row, int block, bool relative, int level, int more) {
    const Shape3 shape = power_.shape();
    const int fan = row / shape.beams;
    const int beam = row % shape.beams;
    around_.clear();
    beside_.clear();
    for (int df = -1; df <= 1; ++df) {
      for (int db = -params_.beside_beams; db <= params_.beside_beams; ++db) {
        const int f = fan + df;
        const int b = beam + db;
        const bool near = db >= -1 && db <= 1;
        if ((df == 0 && db == 0) || (df != 0 && !near) || f < 0 || f >= shape.fans || b < 0 || b >= shape.beams)
          continue;
        const int there = levels_.level(f * shape.beams + b, block);
        if (there == BlockLevels::kUnknown) continue;
        const int value = relative ? there - levels_.background(f * shape.beams + b) : there;
        const bool nearest = near && (shape.fans > 1 ? db == 0 : df == 0);
        if (nearest && level < value + neighbour_ + more) return false;
        if (near) around_.push_back(value);
        if (df == 0) beside_.push_back(value);
      }
    }
    if (around_.empty()) return false;
    return level >= middle(around_) + threshold_ + more &&
           (beside_.empty() || level >= middle(beside_) + threshold_ + more);
  }

  static int middle(std::vector<int>& values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }

  /// The next run of hot blocks from blocks.end on; blocks between hot ones that are as loud belong to it, so that a
  /// corrupted packets stays in one piece where it crosses a school.
  bool next_stretch(int row, Stretch& blocks) const {
    const auto hot = [&](int b) { return hot_[static_cast<std::size_t>(b)]; };
    int at = blocks.end;
    while (at < levels_.blocks() && !hot(at)) ++at;
    if (at == levels_.blocks()) return false;
    blocks = {at, at + 1};
    const int loud = levels_.level(row, at) - neighbour_;
    for (int b = at + 1; b < levels_.blocks(); ++b) {
      if (hot(b)) {
        blocks.end = b + 1;
      } else if (levels_.level(row, b) == BlockLevels::kUnknown || levels_.level(row, b) < loud) {
        break;
      }
    }
    return true;
  }

  /// Mean of the data in [begin, end) of a row.
  [[nodiscard]] double mean(int row, int begin, int end) const {
    const Row counts = power_.row(row);
    double sum = 0.0;
    int data = 0;
    for (int i = std::max(begin, 0); i < std::min(end, power_.shape().samples); ++i) {
      if (counts[static_cast<std::size_t>(i)] == kNoData) continue;
      sum += counts[static_cast<std::size_t>(i)];
      ++data;
    }
    return data > 0 ? sum / data : std::nan("");
  }

  struct Edge {
    int sample;
    double step;  ///< counts, towards the hot side; infinite at an end of the data
  };

  /// The sharpest step within a block of a stretch's coarse edge. direction: +1 rising along range, -1 falling.
  [[nodiscard]] Edge sharpest(int row, int around, int direction) const {
    const int step_samples = params_.edge_samples;
    const int samples = power_.shape().samples;
    Edge best{around, -1.0};
    for (int i = std::max(around - block_, step_samples); i <= std::min(around + block_, samples - step_samples); ++i) {
      const double step = direction * (mean(row, i, i + step_samples) - mean(row, i - step_samples, i));
      if (step > best.step) best = {i, step};
    }
    return best;
  }

  void flag_stretch(int row, Stretch blocks) {
    const int samples = power_.shape().samples;
    const int last = levels_.blocks();
    Stretch s{blocks.begin * block_, std::min(blocks.end * block_, samples)};
    const double inside = mean(row, s.begin, s.end);
    if (blocks.begin > 0 && known(row, blocks.begin - 1)) {
      const Edge edge = sharpest(row, s.begin, 1);
      if (edge.step < threshold_) return;
      s.begin = edge.sample;
    }
    if (blocks.end < last && known(row, blocks.end)) {
      const Edge edge = sharpest(row, s.end, -1);
      if (edge.step < threshold_) return;
      s.end = edge.sample;
    }
    if (s.end - s.begin < params_.minimum_samples) return;
    widen(row, inside, s);
    const auto flags = flags_.row(row);
    for (int i = s.begin; i < s.end; ++i) flags[static_cast<std::size_t>(i)] |= SampleFlags::corrupted;
  }

  [[nodiscard]] bool known(int row, int block) const { return levels_.level(row, block) != BlockLevels::kUnknown; }

  /// Takes in what is still loud next to the edges, and a margin.
  void widen(int row, double inside, Stretch& s) const {
    const Row counts = power_.row(row);
    const auto loud = [&](int i) { return counts[static_cast<std::size_t>(i)] > inside - threshold_; };
    for (int n = 0; n < params_.tail_samples && s.begin > 0 && loud(s.begin - 1); ++n) --s.begin;
    for (int n = 0; n < params_.tail_samples && s.end < power_.shape().samples && loud(s.end); ++n) ++s.end;
    s.begin = std::max(s.begin - params_.margin_samples, 0);
    s.end = std::min(s.end + params_.margin_samples, power_.shape().samples);
  }

  View3<const std::int16_t> power_;
  View3<SampleFlags> flags_;
  const CorruptedPacketParams& params_;
  int block_;
  const BlockLevels& levels_;
  std::span<const double> fan_loss_db_;
  int threshold_, neighbour_, spread_;
  int isolated_ = 0;
  std::vector<bool> hot_;
  std::vector<int> around_, beside_;
};

}  // namespace

void flag_corrupted_packets(View3<const std::int16_t> power, const BlockLevels& levels,
                            const CorruptedPacketParams& params, std::span<const double> fan_loss_db,
                            View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape());
  if (!params.enabled) return;
  CorruptedPackets beams(power, levels, params, fan_loss_db, flags);
  for (int row = 0; row < static_cast<int>(power.shape().rows()); ++row) beams.flag_row(row);
}

void flag_corrupted_packets(View3<const std::int16_t> power, const CorruptedPacketParams& params,
                            View3<SampleFlags> flags) {
  if (params.enabled) flag_corrupted_packets(power, BlockLevels(power, flags, params), params, {}, flags);
}

}  // namespace sonar
