// SPDX-License-Identifier: Apache-2.0
#include "render/homogeneous_cells.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/homogeneous_cells.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

constexpr float kGauss = 0.21132487F;

template <class T>
V load(const T* from, std::size_t count) {
  HWY_ALIGN float values[hn::MaxLanes(D())];
  for (std::size_t i = 0; i < hn::Lanes(D()); ++i) values[i] = i < count ? static_cast<float>(from[i]) : 0.0F;
  return hn::Load(D(), values);
}

V load(const std::int16_t* from, std::size_t count) {
  if (count < hn::Lanes(D())) return load<std::int16_t>(from, count);
  const hn::Rebind<std::int16_t, D> half;
  return hn::ConvertTo(D(), hn::PromoteTo(I(), hn::LoadU(half, from)));
}

/// Values at the Gauss points across: [fan point][beam point].
template <class T>
void across(const T* const columns[4], int at, std::size_t count, V out[4]) {
  V c[4];
  for (int i = 0; i < 4; ++i) c[i] = load(columns[i] + at, count);
  const V g = set(kGauss);
  const V h = set(1.0F - kGauss);
  const V low0 = lerp(c[0], c[1], g);
  const V low1 = lerp(c[0], c[1], h);
  const V high0 = lerp(c[2], c[3], g);
  const V high1 = lerp(c[2], c[3], h);
  out[0] = lerp(low0, high0, g);
  out[1] = lerp(low1, high1, g);
  out[2] = lerp(low0, high0, h);
  out[3] = lerp(low1, high1, h);
}

void CellMean(const CellColumns& cell, const TraceOptics& optics, float* mean) {
  V sum[4] = {zero(), zero(), zero(), zero()};
  const auto lanes = static_cast<int>(hn::Lanes(D()));
  for (int at = 0; at < cell.count; at += lanes) {
    const auto count = static_cast<std::size_t>(std::min(lanes, cell.count - at));
    const M used = hn::FirstN(D(), count);
    V near_sv[4];
    V far_sv[4];
    V near_known[4];
    V far_known[4];
    across(cell.sv, at, count, near_sv);
    across(cell.sv, at + 1, count, far_sv);
    if (cell.known[0] != nullptr) {
      across(cell.known, at, count, near_known);
      across(cell.known, at + 1, count, far_known);
    }
    for (int i = 0; i < 8; ++i) {
      const V g = set(i < 4 ? kGauss : 1.0F - kGauss);
      const V value = lerp(near_sv[i & 3], far_sv[i & 3], g);
      const V entry = hn::MulAdd(value, set(optics.per_count), set(optics.first));
      const W k = nearest_int(hn::Clamp(entry, zero(), set(optics.last_entry)));
      V extinction;
      V colour;
      pairs_at(optics.entries, k, extinction, colour);
      extinction = hn::IfThenElseZero(used, extinction);
      if (cell.known[0] != nullptr) extinction = hn::Mul(extinction, lerp(near_known[i & 3], far_known[i & 3], g));
      const Rgb rgb = unpacked(hn::BitCast(I(), colour));
      sum[0] = hn::MulAdd(extinction, rgb.r, sum[0]);
      sum[1] = hn::MulAdd(extinction, rgb.g, sum[1]);
      sum[2] = hn::MulAdd(extinction, rgb.b, sum[2]);
      sum[3] = hn::Add(sum[3], extinction);
    }
  }
  const float per = 1.0F / static_cast<float>(8 * cell.count);
  for (int i = 0; i < 4; ++i) mean[i] = hn::GetLane(hn::SumOfLanes(D(), sum[i])) * per;
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {
namespace {

HWY_EXPORT(CellMean);

}  // namespace

std::vector<std::array<float, 4>> cell_means(const FilledVolume& volume, const Macrocells& cells,
                                             const TransferTable& table, const std::vector<std::uint8_t>& candidates,
                                             Work& work) {
  std::vector<std::array<float, 4>> out(cells.size());
  const TraceOptics optics = trace_optics(table);
  const Shape3 shape = volume.sv.shape();
  work.for_each(cells.fans, [&](std::int64_t fan) {
    const auto f = static_cast<int>(fan);
    for (int b = 0; b < cells.beams; ++b) {
      for (int k = 0; k < cells.ranges; ++k) {
        const auto cell = static_cast<std::size_t>((f * cells.beams + b) * cells.ranges + k);
        if (candidates[cell] == 0) continue;
        const int first = k * kCellSamples;
        CellColumns columns{{}, {}, std::min(kCellSamples, shape.samples - 1 - first)};
        for (int i = 0; i < 4; ++i) {
          columns.sv[i] = &volume.sv(f + i / 2, b + i % 2, first);
          const bool gaps = !cells.gaps.empty() && cells.gaps[cell] != 0;
          columns.known[i] = gaps ? &volume.known(f + i / 2, b + i % 2, first) : nullptr;
        }
        HWY_DYNAMIC_DISPATCH(CellMean)(columns, optics, out[cell].data());
      }
    }
  });
  return out;
}

std::vector<std::uint8_t> thin_cells(const Macrocells& cells, const TransferTable& table,
                                     const std::vector<std::uint8_t>& visible, double spacing_m, double limit) {
  std::vector<std::uint8_t> out(cells.size(), 0);
  const auto most = static_cast<float>(limit / (kCellSamples * spacing_m));
  for (std::size_t i = 0; i < out.size() && limit > 0.0; ++i) {
    if (visible[i] != 0) out[i] = table.largest_extinction(cells.least[i], cells.largest[i]) <= most ? 1 : 0;
  }
  return out;
}

}  // namespace sonar
#endif  // HWY_ONCE
