// SPDX-License-Identifier: Apache-2.0
#include "school/detect/settle_members.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"
#include "school/beam_medians.h"
#include "school/detect/detect_params.h"
#include "school/detect/flood.h"
#include "school/grow/grow.h"

namespace sonar {
namespace {

constexpr double kMemberShare = 0.92;        ///< of a school's medians lies below its reference
constexpr double kPeakShare = 0.995;         ///< of a school's filtered voxels lies below its peak
constexpr double kPeakAbove_db = 1.5;        ///< the reference lies so far above the filtered peak at least
constexpr double kLeastAboveWater_db = 2.5;  ///< members stand so far above the background
constexpr double kLeastProminence_db =
    5.0;                                ///< two schools that the filter joined stand so far above the saddle between
constexpr double kSaddleStep_db = 1.0;  ///< which is sounded in such steps
constexpr double kUpperShare = 0.5;     ///< both are as large as a school so far up from it to their peaks
constexpr double kLink_db = 3.0;        ///< parts joined by echo this far below the threshold are one school
constexpr int kMostSearches = 6;        ///< boxes are enlarged so often where a neighbour goes on

std::vector<Run> joined(const std::vector<std::vector<Run>>& parts) {
  std::vector<Run> runs;
  for (const std::vector<Run>& part : parts) runs.insert(runs.end(), part.begin(), part.end());
  std::sort(runs.begin(), runs.end());
  return runs;
}

/// Runs of what is not 0 within a box.
std::vector<Run> set_runs(View3<std::uint8_t> marks, const IndexBox& box) {
  std::vector<Run> runs;
  for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
    for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
      const int row = fan * marks.shape().beams + beam;
      const auto marked = marks.row(row);
      for (int s = box.first_sample; s <= box.last_sample; ++s) {
        if (marked[static_cast<std::size_t>(s)] == 0) continue;
        if (runs.empty() || runs.back().row != row || runs.back().end() != s) runs.push_back({row, s, 0});
        ++runs.back().count;
      }
    }
  }
  return runs;
}

}  // namespace

MemberSettler::MemberSettler(View3<const std::int16_t> filtered, View3<const std::int16_t> unfiltered,
                             View3<const SampleFlags> flags, const Background& background, const WaterLevels& water,
                             double tolerance_db, bool peaked, const PingMask* taken)
    : filtered_(filtered),
      unfiltered_(unfiltered),
      flags_(flags),
      tolerance_db_(tolerance_db),
      peaked_(peaked),
      along_beams_(filtered.shape(), kNoData),
      thresholder_(std::as_const(along_beams_).view(), flags, background, &water, taken) {}

IndexBox MemberSettler::box_round(const std::vector<Run>& part, int margins) const {
  PingMask mask;
  mask.runs = part;
  return box_of(mask, filtered_.shape().beams)
      .enlarged(margins * SearchReach::margin_fans, margins * SearchReach::margin_beams,
                margins * SearchReach::margin_samples)
      .clipped(filtered_.shape());
}

void MemberSettler::look_along_beams() {
  std::vector<std::int16_t> medians;
  for (int fan = box_.first_fan; fan <= box_.last_fan; ++fan) {
    for (int beam = box_.first_beam; beam <= box_.last_beam; ++beam) {
      const int row = fan * filtered_.shape().beams + beam;
      beam_medians(unfiltered_.row(row), flags_.row(row), filtered_.row(row), box_.first_sample, box_.last_sample + 1,
                   kMemberSamples / 2, medians);
      std::copy(medians.begin(), medians.end(), along_beams_.view().row(row).begin() + box_.first_sample);
    }
  }
}

double MemberSettler::reference(const std::vector<Run>& part) const {
  std::vector<std::int16_t> values;
  for (const Run& run : part) {
    const auto row = along_beams_.view().row(run.row);
    values.insert(values.end(), row.begin() + run.first_sample, row.begin() + run.end());
  }
  const auto high = [&] {
    const double rank = std::ceil(kMemberShare * static_cast<double>(values.size()));
    const auto k = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return values[static_cast<std::size_t>(k)];
  };
  // what the search's lower level let in does not count
  const double lowest = high() - counts_from_db(tolerance_db_);
  std::erase_if(values, [lowest](std::int16_t value) { return value < lowest; });
  return db_from_counts(high());
}

double MemberSettler::level(const std::vector<Run>& part) const {
  const double along_beams_db = reference(part);
  if (!peaked_) return along_beams_db;
  PingMask mask;
  mask.runs = part;
  const std::int16_t peak = percentile(filtered_, mask, kPeakShare);
  return std::max(along_beams_db, db_from_counts(peak) + kPeakAbove_db);
}

MemberSettler::Parts MemberSettler::pieces(const std::vector<Run>& part, double threshold_db) const {
  const std::vector<Run> all = thresholder_.above(box_, threshold_db, kLeastAboveWater_db);
  Parts parts = connected_parts(all, filtered_.shape(), Connectivity::faces);
  std::erase_if(parts, [&](const std::vector<Run>& piece) { return !share_a_voxel(piece, part); });
  return parts;
}

bool MemberSettler::is_prominent(const std::vector<Run>& piece, double level_db,
                                 const std::function<bool(const std::vector<Run>&)>& large) const {
  const std::vector<Run> above = common_runs(piece, thresholder_.above(box_, level_db, kLeastAboveWater_db));
  const Parts parts = connected_parts(above, filtered_.shape(), Connectivity::faces);
  return std::any_of(parts.begin(), parts.end(), large);
}

std::vector<MemberSettler::Core> MemberSettler::cores(const std::vector<Run>& part, double reference_db,
                                                      double lowest_db, const std::vector<Run>& others,
                                                      const std::function<bool(const std::vector<Run>&)>& large) const {
  std::vector<Core> found;
  for (double top_db = reference_db;; top_db = std::max(top_db - kSaddleStep_db, lowest_db)) {
    const double saddle_db = top_db - kLeastProminence_db;
    for (std::vector<Run>& piece : pieces(part, saddle_db)) {
      const bool known =
          std::any_of(found.begin(), found.end(), [&](const Core& core) { return share_a_voxel(piece, core.runs); });
      if (known || !large(piece) || share_a_voxel(piece, others)) continue;
      const double own_db = reference(piece);
      if (own_db < top_db || !is_prominent(piece, top_db - (1.0 - kUpperShare) * kLeastProminence_db, large)) continue;
      found.push_back({own_db, saddle_db, std::move(piece)});
    }
    if (top_db <= lowest_db) break;
  }
  std::stable_sort(found.begin(), found.end(), [](const Core& a, const Core& b) { return a.top_db > b.top_db; });
  return found;
}

bool MemberSettler::cut_by_box(const std::vector<Core>& cores) const {
  const IndexBox whole = IndexBox::whole(filtered_.shape());
  return std::any_of(cores.begin(), cores.end(), [&](const Core& core) {
    PingMask mask;
    mask.runs = core.runs;
    const IndexBox box = box_of(mask, filtered_.shape().beams);
    const auto cut = [](int at, int end, int border) { return at == end && end != border; };
    return cut(box.first_fan, box_.first_fan, whole.first_fan) || cut(box.last_fan, box_.last_fan, whole.last_fan) ||
           cut(box.first_beam, box_.first_beam, whole.first_beam) ||
           cut(box.last_beam, box_.last_beam, whole.last_beam) ||
           cut(box.first_sample, box_.first_sample, whole.first_sample) ||
           cut(box.last_sample, box_.last_sample, whole.last_sample);
  });
}

MemberSettler::Parts MemberSettler::waters(const std::vector<Run>& part, const std::vector<Core>& cores,
                                           const std::vector<Run>& others, double threshold_db) const {
  Parts springs;
  double bed_db = threshold_db;
  for (const Core& core : cores) {
    springs.push_back(core.runs);
    bed_db = std::min({bed_db, core.top_db - tolerance_db_, core.saddle_db});
  }
  // Faint echo round a school leads its fragments to it.
  const std::vector<Run> bed = joined(pieces(part, bed_db - kLink_db));
  springs.push_back(common_runs(others, bed));
  Parts waters = flood(along_beams_.view(), bed, springs, Connectivity::faces);
  const std::vector<Run> reached = joined(waters);
  waters.pop_back();
  for (const std::vector<Run>& fragment : pieces(part, threshold_db)) {
    if (share_a_voxel(fragment, reached)) continue;
    waters.front().insert(waters.front().end(), fragment.begin(), fragment.end());
  }
  std::sort(waters.front().begin(), waters.front().end());
  return waters;
}

std::vector<MemberSettler::Settled> MemberSettler::settle(const std::vector<Run>& part, double depth_db,
                                                          const std::function<bool(const std::vector<Run>&)>& large,
                                                          View3<std::uint8_t> claimed) {
  // What rises above a stronger neighbour's skirt alone: it is to be seen where that one lies.
  box_ = box_round(part, depth_db < tolerance_db_ ? SearchReach::most_margins : 1);
  look_along_beams();
  const double reference_db = level(part);
  const double threshold_db = reference_db - depth_db;
  std::vector<Run> others = set_runs(claimed, box_);
  std::vector<Core> schools = cores(part, reference_db, threshold_db, others, large);
  // The part ends where the search for one school ended, and so may its neighbour's piece.
  for (int times = 0; times < kMostSearches && schools.size() > 1 && cut_by_box(schools); ++times) {
    box_ = box_.enlarged(SearchReach::fans, SearchReach::beams, SearchReach::samples).clipped(filtered_.shape());
    look_along_beams();
    others = set_runs(claimed, box_);
    schools = cores(part, reference_db, threshold_db, others, large);
  }
  if (schools.empty() || (schools.size() == 1 && others.empty())) {
    box_ = box_round(part, 1);
    return {members(joined(pieces(part, threshold_db)), reference_db, threshold_db, claimed)};
  }
  // The flood knows where they part: none need stop above that.
  const Parts sides = waters(part, schools, others, threshold_db);
  std::vector<Settled> settled;
  for (std::size_t i = 0; i < schools.size(); ++i) {
    const auto above = [&](double level_db) {
      return common_runs(sides[i], thresholder_.above(box_, level_db, kLeastAboveWater_db));
    };
    const std::vector<Run> loud = above(schools[i].top_db - tolerance_db_);
    // With the background taken off, less than the tolerance may be left of it.
    const double own_db = level(loud.empty() ? schools[i].runs : loud);
    settled.push_back(members(above(own_db - tolerance_db_), own_db, own_db - tolerance_db_, claimed));
  }
  return settled;
}

MemberSettler::Settled MemberSettler::members(const std::vector<Run>& runs, double reference_db, double threshold_db,
                                              View3<std::uint8_t> claimed) const {
  Settled settled{{}, reference_db, threshold_db};
  const MemberTable table = MemberTable::one_sided(reference_db, reference_db - threshold_db);
  for (const Run& run : runs) {
    const auto counts = along_beams_.view().row(run.row);
    const auto of_others = claimed.row(run.row);
    bool open = false;
    for (auto s = static_cast<std::size_t>(run.first_sample); s < static_cast<std::size_t>(run.end()); ++s) {
      const std::uint8_t confidence = table(counts[s]);
      const bool inside = confidence != 0 && of_others[s] == 0;
      if (inside) {
        if (!open) settled.mask.runs.push_back({run.row, static_cast<std::int32_t>(s), 0});
        ++settled.mask.runs.back().count;
        settled.mask.confidence.push_back(confidence);
        of_others[s] = 1;
      }
      open = inside;
    }
  }
  return settled;
}

bool share_a_voxel(const std::vector<Run>& a, const std::vector<Run>& b) {
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (i->row == j->row && i->first_sample < j->end() && j->first_sample < i->end()) return true;
    const bool a_first = i->row != j->row ? i->row < j->row : i->end() < j->end();
    (a_first ? i : j)++;
  }
  return false;
}

std::vector<Run> common_runs(const std::vector<Run>& a, const std::vector<Run>& b) {
  std::vector<Run> common;
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    const std::int32_t first = std::max(i->first_sample, j->first_sample);
    const std::int32_t end = std::min(i->end(), j->end());
    if (i->row == j->row && first < end) common.push_back({i->row, first, end - first});
    const bool a_first = i->row != j->row ? i->row < j->row : i->end() < j->end();
    (a_first ? i : j)++;
  }
  return common;
}

std::vector<std::vector<Run>> connected_parts(const std::vector<Run>& runs, const Shape3& shape,
                                              Connectivity connectivity) {
  const Components components = label_runs(runs, shape, connectivity);
  std::vector<std::vector<Run>> parts(static_cast<std::size_t>(components.count));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    parts[static_cast<std::size_t>(components.label[i])].push_back(runs[i]);
  }
  return parts;
}

}  // namespace sonar
