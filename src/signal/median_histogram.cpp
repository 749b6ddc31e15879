// SPDX-License-Identifier: Apache-2.0
#include "signal/median_histogram.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/units.h"

namespace sonar {

namespace {

/// Counts of the values in the window, with a pointer to the median that walks as values come and go.
class SlidingHistogram {
 public:
  void add(std::int16_t value) { change(value, 1); }
  void remove(std::int16_t value) { change(value, -1); }
  [[nodiscard]] std::int32_t left_out() const { return left_out_; }

  /// The value with `rank` values before it in sorted order.
  [[nodiscard]] std::int16_t at_rank(std::int32_t rank) {
    while (below_ > rank) below_ -= coarse_[--pointer_];
    while (below_ + coarse_[pointer_] <= rank) below_ += coarse_[pointer_++];
    std::size_t bin = pointer_ * kBlock;
    for (std::int32_t before = below_ + fine_[bin]; before <= rank; before += fine_[bin]) ++bin;
    return static_cast<std::int16_t>(static_cast<int>(bin) - 32768);
  }

 private:
  static constexpr std::size_t kBlock = 16;  // 0.2 dB: about as far as a median moves from sample to sample

  void change(std::int16_t value, std::int32_t by) {
    const auto bin = static_cast<std::size_t>(value + 32768);
    fine_[bin] += by;
    coarse_[bin / kBlock] += by;
    below_ += by * static_cast<std::int32_t>(bin / kBlock < pointer_);
    left_out_ += by * static_cast<std::int32_t>(is_left_out(value));
  }

  std::array<std::int32_t, 65536> fine_{};
  std::array<std::int32_t, 65536 / kBlock> coarse_{};
  std::size_t pointer_ = 32768 / kBlock;  ///< the block that holds the median
  std::int32_t below_ = 0;                ///< values in the blocks below
  std::int32_t left_out_ = 0;
};

}  // namespace

void median_row_histogram(const MaskedBox& masked, int fan, int beam, int half_fans, int half_beams, int half_samples,
                          std::span<std::int16_t> out) {
  const Shape3 shape = masked.shape();
  std::vector<const std::int16_t*> rows;
  for (int df = -half_fans; df <= half_fans; ++df) {
    for (int db = -half_beams; db <= half_beams; ++db) {
      rows.push_back(masked.row(std::clamp(fan + df, 0, shape.fans - 1), std::clamp(beam + db, 0, shape.beams - 1)));
    }
  }
  // The histogram is emptied again at the end of the row, which is cheaper than clearing 256 kB.
  static thread_local SlidingHistogram window;
  const auto last = shape.samples - 1;
  const auto each = [&](int sample, auto&& change) {
    const int at = std::clamp(sample, 0, last);
    for (const std::int16_t* row : rows) change(row[at]);
  };
  const auto add = [&](std::int16_t v) { window.add(v); };
  const auto remove = [&](std::int16_t v) { window.remove(v); };

  const auto size = static_cast<std::int32_t>(rows.size()) * (2 * half_samples + 1);
  for (int s = -half_samples; s < half_samples; ++s) each(s, add);
  for (int s = 0; s <= last; ++s) {
    each(s + half_samples, add);
    const std::int16_t middle = window.at_rank(size / 2);
    const bool unknown = 2 * window.left_out() > size || is_left_out(middle);
    out[static_cast<std::size_t>(s)] = unknown ? kNoData : middle;
    each(s - half_samples, remove);
  }
  for (int s = last + 1 - half_samples; s <= last + half_samples; ++s) each(s, remove);
}

}  // namespace sonar
