// SPDX-License-Identifier: Apache-2.0
#include "school/grow/grow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/check.h"
#include "base/units.h"
#include "school/grow/mask_edit.h"
#include "school/recorded_ends.h"

namespace sonar {
namespace {

constexpr int kCounts = 65536;

struct FrontRun {
  std::int32_t first;
  std::int32_t end;
  bool reached;
};

/// The runs of members, row by row, found when a row is first asked for.
class LazyRuns {
 public:
  LazyRuns(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MemberTable& members,
           const GrowLimits& limits)
      : sv_(sv),
        flags_(flags),
        members_(members),
        box_(limits.box ? limits.box->clipped(sv.shape()) : IndexBox::whole(sv.shape())),
        taken_(limits.taken),
        inside_(limits.inside),
        ends_(recorded_ends(flags)),
        known_(sv.shape().rows(), false),
        rows_(sv.shape().rows()) {
    if (taken_ != nullptr) taken_rows_ = index_rows(taken_->runs, sv.shape().rows());
    if (inside_ != nullptr) inside_rows_ = index_rows(inside_->runs, sv.shape().rows());
  }

  std::vector<FrontRun>& row(int row) {
    const auto r = static_cast<std::size_t>(row);
    if (!known_[r]) {
      known_[r] = true;
      extract(row, rows_[r]);
    }
    return rows_[r];
  }

 private:
  void extract(int row, std::vector<FrontRun>& runs) const {
    const int beams = sv_.shape().beams;
    if (box_.empty() || !box_.contains(row / beams, row % beams, box_.first_sample)) return;
    if (inside_ == nullptr) return extract(row, box_.first_sample, box_.last_sample, runs);
    const auto r = static_cast<std::size_t>(row);
    for (int i = inside_rows_[r]; i < inside_rows_[r + 1]; ++i) {
      const Run& run = inside_->runs[static_cast<std::size_t>(i)];
      extract(row, std::max(run.first_sample, box_.first_sample), std::min(run.end() - 1, box_.last_sample), runs);
    }
  }

  void extract(int row, int first, int last, std::vector<FrontRun>& runs) const {
    const auto counts = sv_.row(row);
    const auto flags = flags_.row(row);
    last = std::min(last, ends_[static_cast<std::size_t>(row / sv_.shape().beams)] - 1);
    int start = -1;
    for (int s = first; s <= last + 1; ++s) {
      const auto i = static_cast<std::size_t>(s);
      const bool member = s <= last && members_(counts[i]) != 0 && !any(flags[i] & kNeverMember);
      if (member && start < 0) start = s;
      if (!member && start >= 0) {
        cut_taken(row, start, s, runs);
        start = -1;
      }
    }
  }

  void cut_taken(int row, int start, int end, std::vector<FrontRun>& runs) const {
    if (taken_ != nullptr) {
      const auto r = static_cast<std::size_t>(row);
      for (int i = taken_rows_[r]; i < taken_rows_[r + 1]; ++i) {
        const Run& run = taken_->runs[static_cast<std::size_t>(i)];
        if (run.end() <= start || run.first_sample >= end) continue;
        if (run.first_sample > start) runs.push_back({start, run.first_sample, false});
        start = std::max(start, static_cast<int>(run.end()));
      }
    }
    if (start < end) runs.push_back({start, end, false});
  }

  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const MemberTable& members_;
  IndexBox box_;
  const PingMask* taken_;
  const PingMask* inside_;
  std::vector<int> ends_;  ///< [fan]
  std::vector<int> taken_rows_;
  std::vector<int> inside_rows_;
  std::vector<bool> known_;
  std::vector<std::vector<FrontRun>> rows_;
};

/// Marks the unreached runs of a row that overlap [first, end) and puts them on the front.
void touch(std::vector<FrontRun>& runs, int row, int first, int end, std::vector<Run>& front) {
  auto it = std::upper_bound(runs.begin(), runs.end(), first, [](int s, const FrontRun& run) { return s < run.end; });
  for (; it != runs.end() && it->first < end; ++it) {
    if (it->reached) continue;
    it->reached = true;
    front.push_back({row, it->first, it->end - it->first});
  }
}

PingMask with_confidence(std::vector<Run> runs, View3<const std::int16_t> sv, const MemberTable& members) {
  std::sort(runs.begin(), runs.end());
  PingMask mask;
  mask.runs = std::move(runs);
  for (const Run& run : mask.runs) {
    const auto counts = sv.row(run.row);
    for (int s = run.first_sample; s < run.end(); ++s) {
      mask.confidence.push_back(members(counts[static_cast<std::size_t>(s)]));
    }
  }
  return mask;
}

}  // namespace

MemberTable MemberTable::one_sided(double reference_db, double tolerance_db) {
  MemberTable table;
  if (!(tolerance_db > 0.0) || !std::isfinite(reference_db)) return table;
  const double lowest = counts_from_db(reference_db - tolerance_db);
  // a rounding error must not shut out a count that lies on the threshold
  const int from = static_cast<int>(std::ceil(std::clamp(lowest - 1e-9, double{kMinCount}, kMaxCount + 1.0)));
  for (int count = from; count <= kMaxCount; ++count) {
    const double d = std::max(reference_db - db_from_counts(count), 0.0) / tolerance_db;
    table.q_[static_cast<std::size_t>(count + 32768)] = d > 0.0 ? quantised_confidence(1.0 - d * d) : std::uint8_t{255};
  }
  return table;
}

MemberTable MemberTable::by_opacity(std::span<const float> opacity, double centre, double tolerance) {
  SONAR_CHECK(opacity.size() == kCounts);
  MemberTable table;
  // opacities are floats: a difference equal to the tolerance must count as equal
  constexpr double kRounding = 1e-6;
  for (std::size_t i = 1; i < opacity.size(); ++i) {
    const double value = static_cast<double>(opacity[i]);
    const double d = std::abs(value - centre);
    if (!(value > 0.0) || !(d <= tolerance + kRounding)) continue;
    const double share = tolerance > 0.0 ? std::min(d / tolerance, 1.0) : 0.0;
    table.q_[i] = quantised_confidence(1.0 - share * share);
  }
  return table;
}

PingMask grow(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MemberTable& members,
              std::span<const VoxelIndex> seeds, const GrowLimits& limits) {
  SONAR_CHECK(sv.shape() == flags.shape());
  const Shape3 shape = sv.shape();
  LazyRuns rows(sv, flags, members, limits);
  std::vector<Run> front;
  for (const VoxelIndex& seed : seeds) {
    if (seed.row < 0 || seed.row >= static_cast<std::int32_t>(shape.rows())) continue;
    if (seed.sample < 0 || seed.sample >= shape.samples) continue;
    touch(rows.row(seed.row), seed.row, seed.sample, seed.sample + 1, front);
  }
  const int widen = limits.connectivity == Connectivity::all ? 1 : 0;
  std::vector<Run> reached;
  while (!front.empty()) {
    const Run run = front.back();
    front.pop_back();
    reached.push_back(run);
    const NeighbourRows around = neighbour_rows(run.row, shape, limits.connectivity);
    for (int n = 0; n < around.count; ++n) {
      touch(rows.row(around.row[n]), around.row[n], run.first_sample - widen, run.end() + widen, front);
    }
  }
  return with_confidence(std::move(reached), sv, members);
}

Result<PingMask> grow_from_click(View3<const std::int16_t> sv, View3<const SampleFlags> flags, VoxelIndex seed,
                                 const TransferFunction& growth_curve, const GrowParams& params,
                                 const PingMask* inside) {
  const Shape3 shape = sv.shape();
  if (seed.row < 0 || seed.row >= static_cast<std::int32_t>(shape.rows()) || seed.sample < 0 ||
      seed.sample >= shape.samples) {
    return fail(ErrorCode::bad_parameter, fmt::format("the seed (row {}, sample {}) lies outside the volume of {} x {} "
                                                      "beams and {} samples",
                                                      seed.row, seed.sample, shape.fans, shape.beams, shape.samples));
  }
  const auto refuse = [&](std::string_view why) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("the seed at fan {}, beam {}, sample {} {}", seed.row / shape.beams, seed.row % shape.beams,
                            seed.sample, why));
  };
  const std::int16_t count = sv.row(seed.row)[static_cast<std::size_t>(seed.sample)];
  if (any(flags.row(seed.row)[static_cast<std::size_t>(seed.sample)] & kNeverMember)) {
    return refuse("lies in the near field, at the surface or beyond the seabed");
  }
  const int end = recorded_ends(flags)[static_cast<std::size_t>(seed.row / shape.beams)];
  if (count == kNoData || seed.sample >= end) return refuse("has no data");
  const std::vector<float> opacity = growth_curve.table_i16();
  const double centre = static_cast<double>(opacity[static_cast<std::size_t>(count + 32768)]);
  if (!(centre > 0.0)) return refuse(fmt::format("has opacity 0 ({:.1f} dB)", db_from_counts(count)));
  if (inside != nullptr && !contains(*inside, seed.row, seed.sample)) {
    return refuse(
        fmt::format("({:.1f} dB) is less than {:g} dB above the noise", db_from_counts(count), params.margin_db));
  }
  const MemberTable members = params.mode == GrowMode::paper
                                  ? MemberTable::by_opacity(opacity, centre, params.tolerance_opacity)
                                  : MemberTable::one_sided(db_from_counts(count), params.tolerance_db);
  GrowLimits limits;
  limits.connectivity = params.connectivity;
  limits.inside = inside;
  return grow(sv, flags, members, std::span(&seed, 1), limits);
}

PingMask at_least(const PingMask& mask, double threshold) {
  const int lowest = static_cast<int>(std::ceil(std::clamp(threshold, 0.0, 1.0) * 255.0 - 1e-9));
  PingMask out;
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    bool open = false;
    for (int s = run.first_sample; s < run.end(); ++s, ++i) {
      const bool inside = mask.confidence[i] >= lowest;
      if (inside) {
        if (!open) out.runs.push_back({run.row, s, 0});
        ++out.runs.back().count;
        out.confidence.push_back(mask.confidence[i]);
      }
      open = inside;
    }
  }
  return out;
}

std::int16_t percentile(View3<const std::int16_t> sv, const PingMask& mask, double share) {
  std::vector<std::int16_t> values;
  values.reserve(mask.voxels());
  for (const Run& run : mask.runs) {
    const auto counts = sv.row(run.row);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const std::int16_t count = counts[static_cast<std::size_t>(s)];
      if (count != kNoData) values.push_back(count);
    }
  }
  if (values.empty()) return kNoData;
  const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size()));
  const auto k = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

}  // namespace sonar
