// SPDX-License-Identifier: Apache-2.0
#include "signal/median_box.h"

#include <algorithm>
#include <span>

#include "base/units.h"
#include "signal/row_kernels.h"

namespace sonar {

namespace {

constexpr SampleFlags kCut = SampleFlags::near_field | SampleFlags::surface;

bool usable(std::int16_t count, SampleFlags flags) { return count != kNoData && !any(flags & kCut); }

}  // namespace

SampleBox usable_box(View3<const std::int16_t> sv, View3<const SampleFlags> flags) {
  const Shape3 shape = sv.shape();
  SampleBox box{shape.fans, 0, shape.beams, 0, shape.samples, 0};
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      const auto counts = sv.row(fan, beam);
      const auto row_flags = flags.row(fan, beam);
      const auto at = [&](int i) {
        return usable(counts[static_cast<std::size_t>(i)], row_flags[static_cast<std::size_t>(i)]);
      };
      int first = 0;
      while (first < shape.samples && !at(first)) ++first;
      if (first == shape.samples) continue;
      int end = shape.samples;
      while (end > box.sample_end && !at(end - 1)) --end;
      box.fan_begin = std::min(box.fan_begin, fan);
      box.fan_end = std::max(box.fan_end, fan + 1);
      box.beam_begin = std::min(box.beam_begin, beam);
      box.beam_end = std::max(box.beam_end, beam + 1);
      box.sample_begin = std::min(box.sample_begin, first);
      box.sample_end = std::max(box.sample_end, end);
    }
  }
  return box.fan_end > box.fan_begin ? box : SampleBox{};
}

void MaskedBox::cut(View3<const std::int16_t> sv, View3<const SampleFlags> flags, int margin_samples) {
  box = usable_box(sv, flags);
  margin = margin_samples;
  const Shape3 inner = box.shape();
  const auto first = static_cast<std::size_t>(box.sample_begin);
  const auto samples = static_cast<std::size_t>(inner.samples);
  const auto beyond = static_cast<std::size_t>(margin);
  counts.resize(inner.rows() * (samples + 2 * beyond));
  any_left_out.resize(inner.rows());
  for (int row = 0; row < static_cast<int>(inner.rows()); ++row) {
    const int fan = box.fan_begin + row / inner.beams;
    const int beam = box.beam_begin + row % inner.beams;
    const auto index = static_cast<std::size_t>(row);
    const auto whole = std::span(counts).subspan(index * (samples + 2 * beyond), samples + 2 * beyond);
    const auto middle = whole.subspan(beyond, samples);
    any_left_out[index] = mask_row(sv.row(fan, beam).subspan(first, samples),
                                   flags.row(fan, beam).subspan(first, samples), fan + beam + box.sample_begin, middle)
                              ? 1
                              : 0;
    std::fill_n(whole.begin(), beyond, middle.front());
    std::fill_n(whole.end() - margin, beyond, middle.back());
  }
}

}  // namespace sonar
