// SPDX-License-Identifier: Apache-2.0
#include "school/settle_members.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"
#include "school/beam_medians.h"
#include "school/flood.h"
#include "school/grow.h"

namespace sonar {
namespace {

/// How finely valleys are sounded.
constexpr double kLevelStep_db = 1.0;

std::vector<Run> joined(const std::vector<std::vector<Run>>& parts) {
  std::vector<Run> runs;
  for (const std::vector<Run>& part : parts) runs.insert(runs.end(), part.begin(), part.end());
  std::sort(runs.begin(), runs.end());
  return runs;
}

}  // namespace

MemberSettler::MemberSettler(View3<const std::int16_t> filtered, View3<const std::int16_t> unfiltered,
                             View3<const SampleFlags> flags, const Background& background, WaterLevels water,
                             const DetectParams& params, const PingMask* taken)
    : filtered_(filtered),
      unfiltered_(unfiltered),
      flags_(flags),
      params_(params),
      along_beams_(filtered.shape(), kNoData),
      thresholder_(std::as_const(along_beams_).view(), flags, background, std::move(water), taken) {}

IndexBox MemberSettler::box_round(const std::vector<Run>& part) const {
  PingMask mask;
  mask.runs = part;
  return box_of(mask, filtered_.shape().beams)
      .enlarged(params_.rim_fans, params_.rim_beams, params_.rim_samples)
      .clipped(filtered_.shape());
}

void MemberSettler::look_along_beams(const IndexBox& box) {
  std::vector<std::int16_t> medians;
  for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
    for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
      const int row = fan * filtered_.shape().beams + beam;
      beam_medians(unfiltered_.row(row), flags_.row(row), filtered_.row(row), box.first_sample, box.last_sample + 1,
                   params_.member_samples / 2, medians);
      std::copy(medians.begin(), medians.end(), along_beams_.view().row(row).begin() + box.first_sample);
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
    const double rank = std::ceil(params_.member_percentile / 100.0 * static_cast<double>(values.size()));
    const auto k = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + k, values.end());
    return values[static_cast<std::size_t>(k)];
  };
  // what the search's lower level let in does not count
  const double lowest = high() - counts_from_db(params_.tolerance_db);
  std::erase_if(values, [lowest](std::int16_t value) { return value < lowest; });
  return db_from_counts(high());
}

double MemberSettler::level(const std::vector<Run>& part) const {
  const double along_beams_db = reference(part);
  if (params_.peak_percentile <= 0.0) return along_beams_db;
  PingMask mask;
  mask.runs = part;
  const std::int16_t peak = percentile(filtered_, mask, params_.peak_percentile / 100.0);
  return std::max(along_beams_db, db_from_counts(peak) + params_.peak_above_db);
}

MemberSettler::Parts MemberSettler::pieces(const std::vector<Run>& part, double threshold_db) const {
  const std::vector<Run> all = thresholder_.above(box_round(part), threshold_db, params_.background_rest_db);
  Parts parts = connected_parts(all, filtered_.shape(), params_.connectivity);
  std::erase_if(parts, [&](const std::vector<Run>& piece) { return !share_a_voxel(piece, part); });
  return parts;
}

MemberSettler::Parts MemberSettler::hearts(const std::vector<Run>& part, double reference_db, double threshold_db,
                                           const std::function<bool(const std::vector<Run>&)>& large) const {
  std::vector<std::pair<double, std::vector<Run>>> found;
  for (double level_db = std::max(reference_db - params_.min_valley_db, threshold_db);;
       level_db = std::max(level_db - kLevelStep_db, threshold_db)) {
    for (std::vector<Run>& piece : pieces(part, level_db)) {
      const bool known = std::any_of(found.begin(), found.end(),
                                     [&](const auto& heart) { return share_a_voxel(piece, heart.second); });
      if (known || !large(piece)) continue;
      const double top_db = reference(piece);
      if (top_db >= level_db + params_.min_valley_db) found.emplace_back(top_db, std::move(piece));
    }
    if (level_db <= threshold_db) break;
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Parts hearts;
  for (auto& [top_db, heart] : found) hearts.push_back(std::move(heart));
  return hearts;
}

MemberSettler::Parts MemberSettler::shared_out(const std::vector<Run>& part, const Parts& hearts,
                                               double threshold_db) const {
  const std::vector<Run> all = joined(pieces(part, threshold_db));
  if (hearts.size() < 2) return {all};
  // Faint echo round a school leads its fragments to it.
  const std::vector<Run> water = joined(pieces(part, threshold_db - params_.link_db));
  Parts schools = flood(along_beams_.view(), water, hearts, params_.connectivity);
  const std::vector<Run> reached = joined(schools);
  for (std::vector<Run>& school : schools) school = common_runs(school, all);
  for (const std::vector<Run>& fragment : connected_parts(all, filtered_.shape(), params_.connectivity)) {
    if (share_a_voxel(fragment, reached)) continue;
    schools.front().insert(schools.front().end(), fragment.begin(), fragment.end());
  }
  std::sort(schools.front().begin(), schools.front().end());
  return schools;
}

std::vector<MemberSettler::Settled> MemberSettler::settle(const std::vector<Run>& part, double depth_db,
                                                          const std::function<bool(const std::vector<Run>&)>& large,
                                                          View3<std::uint8_t> claimed) {
  look_along_beams(box_round(part));
  const double reference_db = level(part);
  const double threshold_db = reference_db - depth_db;
  const Parts schools = shared_out(part, hearts(part, reference_db, threshold_db, large), threshold_db);
  std::vector<Settled> settled;
  for (const std::vector<Run>& school : schools) {
    // Beside a stronger one a school goes down to where the two part, as there.
    const double own_db = schools.size() == 1 ? reference_db : level(school);
    settled.push_back(members(school, own_db, std::max(threshold_db, own_db - depth_db), claimed));
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
