// SPDX-License-Identifier: Apache-2.0
#include "signal/median.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "signal/median_box.h"
#include "signal/median_histogram.h"
#include "signal/median_network.h"
#include "signal/row_kernels.h"

namespace sonar {

namespace {

void share_out(Work* work, int count, const std::function<void(std::int64_t)>& body) {
  if (work != nullptr) {
    work->for_each(count, body);
  } else {
    for (int i = 0; i < count; ++i) body(i);
  }
}

void copy_masked(View3<const std::int16_t> sv, View3<const SampleFlags> flags, View3<std::int16_t> out) {
  std::copy(sv.all().begin(), sv.all().end(), out.all().begin());
  for (std::size_t i = 0; i < out.all().size(); ++i) {
    if (any(flags.all()[i] & kNeverMember)) out.all()[i] = kNoData;
  }
}

/// Where row `row` of the box lies in a whole ping's array.
template <class T>
std::span<T> part(View3<T> whole, const SampleBox& box, int row) {
  const int beams = box.beam_end - box.beam_begin;
  const auto full = whole.row(box.fan_begin + row / beams, box.beam_begin + row % beams);
  return full.subspan(static_cast<std::size_t>(box.sample_begin),
                      static_cast<std::size_t>(box.sample_end - box.sample_begin));
}

void median_by_histogram(const MaskedBox& masked, const MedianParams& params, Work* work, View3<std::int16_t> out) {
  const int beams = masked.shape().beams;
  share_out(work, static_cast<int>(masked.shape().rows()), [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    median_row_histogram(masked, row / beams, row % beams, params.kernel_fans / 2, params.kernel_beams / 2,
                         params.kernel_samples / 2, part(out, masked.box, row));
  });
}

}  // namespace

bool has_network(const MedianParams& params) {
  return params.kernel_fans / 2 == 1 && params.kernel_beams / 2 == 1 && network_takes(params.kernel_samples | 1);
}

void median_into(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MedianParams& params,
                 MedianMethod method, Work* work, View3<std::int16_t> out) {
  SONAR_CHECK(sv.shape() == flags.shape() && sv.shape() == out.shape());
  SONAR_CHECK(method != MedianMethod::network || has_network(params));
  if (!params.enabled) return copy_masked(sv, flags, out);
  const bool network = method != MedianMethod::histogram && has_network(params);
  // Nested work may run another ping on this thread while it waits, so the thread's scratch is taken away meanwhile.
  static thread_local MaskedBox scratch;
  MaskedBox masked = std::exchange(scratch, {});
  masked.cut(sv, flags, network ? kNetworkMargin : 0);
  std::fill(out.all().begin(), out.all().end(), kNoData);
  if (!masked.box.empty()) {
    if (network) {
      median_network(masked, params.kernel_samples | 1, work, out);
      drop_unknown(masked, params.kernel_samples | 1, out);
    } else {
      median_by_histogram(masked, params, work, out);
    }
    for (int row = 0; row < static_cast<int>(masked.shape().rows()); ++row) {
      drop_never_members(part(flags, masked.box, row), part(out, masked.box, row));
    }
  }
  scratch = std::move(masked);
}

void median_into(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MedianParams& params,
                 View3<std::int16_t> out) {
  median_into(sv, flags, params, MedianMethod::automatic, nullptr, out);
}

Array3<std::int16_t> median(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MedianParams& params,
                            Work& work) {
  Array3<std::int16_t> out(sv.shape());
  median_into(sv, flags, params, MedianMethod::automatic, &work, out.view());
  return out;
}

}  // namespace sonar
