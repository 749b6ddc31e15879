// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/measure_schools.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/hash.h"
#include "pipeline/stages/measure_ping.h"
#include "pipeline/survey/beam_figures.h"
#include "school/measure/correct_sizes.h"
#include "school/measure/movement.h"
#include "school/measure/school_errors.h"
#include "school/measure/summarise.h"
#include "school/measure/two_way_beam.h"
#include "school/measure/water_current.h"

namespace sonar {
namespace {

/// Sorting key of a school: ping, channel and sample of its first voxel by channel.
auto first_voxel(const SchoolMasks& school, const std::vector<int>& channel_of_row) {
  const PingMask& mask = school.pings.front().mask;
  std::pair<int, int> first{channel_of_row[static_cast<std::size_t>(mask.runs.front().row)],
                            mask.runs.front().first_sample};
  for (const Run& run : mask.runs) {
    first = std::min(first, {channel_of_row[static_cast<std::size_t>(run.row)], run.first_sample});
  }
  return std::tuple(school.pings.front().ping_index, first.first, first.second);
}

/// Whether a beam that holds some of a school holds some of another too: one may lie in the other's shadow.
bool shares_beams(const std::vector<InPingRef>& all, std::size_t index) {
  std::set<int> rows;
  for (const Run& run : all[index].in_ping->mask.runs) rows.insert(run.row);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<Run>& runs = all[i].in_ping->mask.runs;
    if (i != index && std::ranges::any_of(runs, [&](const Run& run) { return rows.contains(run.row); })) return true;
  }
  return false;
}

/// Everything that a ping's rows depend on; without the ping itself where the engine keeps no keys, being the same then.
Hash128 key_of(const Engine& engine, std::int64_t ping_index, const std::vector<InPingRef>& schools) {
  Hasher hasher;
  if (engine.known() != nullptr) hasher.add(std::as_bytes(std::span(&engine.keys().placed(ping_index), 1)));
  for (std::size_t i = 0; i < schools.size(); ++i) {
    const InPingRef& one = schools[i];
    const PingMask& mask = one.in_ping->mask;
    // Where echo is corrected, others hear their water in beams that they hold nothing of.
    const bool may_matter = engine.recipe().measure.extinction.correct ? schools.size() > 1 : shares_beams(schools, i);
    const bool lets_through = !is_fish(one) && may_matter;
    hasher.add(std::as_bytes(std::span(&lets_through, 1)));
    hasher.add(std::as_bytes(std::span(&one.school->decided.school_id, 1)));
    hasher.add(std::as_bytes(std::span(&one.in_ping->threshold_db, 1)));
    hasher.add(std::as_bytes(std::span(mask.runs)));
    hasher.add(std::as_bytes(std::span(mask.confidence)));
    if (!engine.recipe().errors.enabled) continue;
    hasher.add(std::as_bytes(std::span(&one.fadings, 1)));
  }
  return hasher.value();
}

std::vector<SchoolPingRow> rows_of(const ObservationProduct& product, std::int64_t school_id) {
  std::vector<SchoolPingRow> rows;
  for (const SchoolPingRow& row : product.school_pings) {
    if (row.school_id == school_id) rows.push_back(row);
  }
  return rows;
}

/// Rows of one school stand together.
void move_schools(const Recipe& recipe, const WaterCurrents* water, ObservationProduct& product) {
  const ShipWay ship(product.pings);
  const std::span<SchoolPingRow> all(product.school_pings);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    while (last < all.size() && all[last].school_id == all[first].school_id) ++last;
    add_movement(all.subspan(first, last - first), ship, recipe.summarise, water);
    first = last;
  }
}

/// Empty where no current was given.
std::optional<WaterCurrents> currents_of(const Recipe& recipe) {
  if (recipe.current_profiles.empty()) return std::nullopt;
  return WaterCurrents{&recipe.current_profiles, recipe.currents,
                       current_noise_mps(recipe.current_profiles, recipe.currents)};
}

using MeasuredPing = std::pair<std::int64_t, std::vector<InPingRef>>;

bool reaches_border(const PingMask& mask, const Sector& sector) {
  const IndexBox box = box_of(mask, sector.beams());
  return box.first_fan == 0 || box.last_fan == sector.fans() - 1 || box.first_beam == 0 ||
         box.last_beam == sector.beams() - 1 || box.first_sample == 0 || box.last_sample == sector.range().count - 1;
}

/// How often each of a school's pings is measured again. Where the school is seen whole, its figures are of these pings alone.
std::vector<std::size_t> fadings_of(const SchoolMasks& school, const Sector& sector) {
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < school.pings.size(); ++i) {
    if (!reaches_border(school.pings[i].mask, sector)) whole.push_back(i);
  }
  if (whole.empty()) {
    whole.resize(school.pings.size());
    std::iota(whole.begin(), whole.end(), std::size_t{0});
  }
  std::vector<std::size_t> fadings(school.pings.size(), 0);
  for (std::size_t i = 0; i < whole.size(); ++i) fadings[whole[i]] = fadings_of_ping(i, whole.size());
  return fadings;
}

std::vector<MeasuredPing> by_ping(const std::vector<SchoolMasks>& schools, const Sector& sector) {
  std::map<std::int64_t, std::vector<InPingRef>> pings;
  for (const SchoolMasks& school : schools) {
    const std::vector<std::size_t> fadings = fadings_of(school, sector);
    for (std::size_t i = 0; i < fadings.size(); ++i) {
      pings[school.pings[i].ping_index].push_back({&school, &school.pings[i], fadings[i]});
    }
  }
  return {pings.begin(), pings.end()};
}

void note_unreadable(std::int64_t ping_index, const std::string& why, ObservationProduct& product) {
  product.pings[static_cast<std::size_t>(ping_index)].bad = true;
  product.diagnostics.push_back({DiagnosticCode::ping_unreadable, "", -1, ping_index, why});
}

/// By school and ping.
using Faults = std::map<std::pair<std::int64_t, std::int64_t>, std::vector<bool>>;

void take_masks(std::vector<SchoolMasks>& schools, Faults& faults, ObservationProduct& product) {
  for (SchoolMasks& school : schools) {
    for (SchoolMasks::InPing& in_ping : school.pings) {
      if (product.pings[static_cast<std::size_t>(in_ping.ping_index)].bad) continue;
      const std::int64_t id = school.decided.school_id;
      product.masks.push_back(
          {id, in_ping.ping_index, std::move(in_ping.mask), std::move(faults[{id, in_ping.ping_index}])});
    }
  }
}

}  // namespace

void summarise_schools(const std::vector<SchoolMasks>& schools, const Recipe& recipe, ObservationProduct& product) {
  const auto currents = currents_of(recipe);
  const WaterCurrents* water = currents ? &*currents : nullptr;
  move_schools(recipe, water, product);
  for (const SchoolMasks& school : schools) {
    const std::vector<SchoolPingRow> rows = rows_of(product, school.decided.school_id);
    if (rows.empty()) continue;
    SchoolRow row = summarise(rows, recipe.summarise, water);
    row.observation = product.observation;
    row.school_id = school.decided.school_id;
    row.origin = school.decided.origin;
    row.status = school.decided.status;
    row.operator_name = school.decided.operator_name;
    row.decided_utc = school.decided.decided_utc;
    row.species = school.decided.species;
    row.comment = school.decided.comment;
    row.name = school.decided.name;
    row.continues = school.decided.continues;
    row.ended_at_reach = school.decided.ended_at_reach;
    product.schools.push_back(std::move(row));
  }
}

std::string ended_at_reach(const SchoolMasks& school) {
  if (school.pings.empty()) return {};
  const bool first = school.reach.first == school.pings.front().ping_index;
  const bool last = school.reach.last == school.pings.back().ping_index;
  return std::string(kEndNames[static_cast<std::size_t>(first) + 2 * static_cast<std::size_t>(last)]);
}

std::vector<SchoolMasks> numbered(std::vector<SchoolMasks> schools, const BeamGrid& grid) {
  std::erase_if(schools, [](const SchoolMasks& school) { return school.pings.empty(); });
  std::stable_sort(schools.begin(), schools.end(), [&](const SchoolMasks& a, const SchoolMasks& b) {
    return first_voxel(a, grid.channel) < first_voxel(b, grid.channel);
  });
  for (std::size_t i = 0; i < schools.size(); ++i) schools[i].decided.school_id = static_cast<std::int64_t>(i) + 1;
  return schools;
}

namespace {

/// They may come from a file that anyone can write.
bool are_of(const std::vector<MeasuredMask>& rows, std::int64_t ping_index, const std::vector<InPingRef>& schools) {
  return std::equal(rows.begin(), rows.end(), schools.begin(), schools.end(),
                    [&](const MeasuredMask& one, const InPingRef& of) {
                      const bool fits = one.fault.empty() || one.fault.size() == of.in_ping->mask.voxels();
                      return fits && one.school.row.ping_index == ping_index &&
                             one.school.row.school_id == of.school->decided.school_id;
                    });
}

const std::vector<MeasuredMask>* kept_rows(const MeasuredPings* before, const Engine& engine, std::int64_t ping_index,
                                           const std::vector<InPingRef>& schools) {
  if (before == nullptr) return nullptr;
  const auto found = before->pings.find(ping_index);
  if (found == before->pings.end() || found->second.first != key_of(engine, ping_index, schools)) return nullptr;
  return are_of(found->second.second, ping_index, schools) ? &found->second.second : nullptr;
}

/// What is known of other pings stays: a school that is not there now may come back, by undo or when a find is read.
void keep_rows(MeasuredPings& before, const Engine& engine, const std::vector<MeasuredPing>& pings,
               const std::vector<std::vector<MeasuredMask>>& rows, const std::vector<std::string>& problems) {
  for (std::size_t i = 0; i < pings.size(); ++i) {
    const auto& [ping_index, refs] = pings[i];
    if (!problems[i].empty() || kept_rows(&before, engine, ping_index, refs) != nullptr) continue;
    before.pings[ping_index] = {key_of(engine, ping_index, refs), rows[i]};
    before.changed = true;
  }
}

/// Fills in the standard errors of schools that were just summarised.
void add_errors(const std::vector<std::vector<MeasuredMask>>& pings, const Recipe& recipe,
                ObservationProduct& product) {
  std::map<std::int64_t, std::vector<const Repeats*>> by_number;
  for (const std::vector<MeasuredMask>& ping : pings) {
    for (const MeasuredMask& one : ping) by_number[one.school.row.school_id].push_back(&one.repeats);
  }
  for (SchoolRow& school : product.schools) {
    const std::vector<SchoolPingRow> rows = rows_of(product, school.school_id);
    school.se = school_errors(rows, by_number[school.school_id], recipe.summarise, recipe.errors);
  }
}

/// All rows, by school and ping, their corrected columns filled.
std::vector<SchoolPingRow> corrected_rows(const std::vector<std::vector<MeasuredMask>>& pings,
                                          const MeasureParams& params) {
  std::map<std::int64_t, SchoolThroughPings> by_number;
  for (const std::vector<MeasuredMask>& ping : pings) {
    for (const MeasuredMask& one : ping) by_number[one.school.row.school_id].push_back(&one.school);
  }
  std::vector<SchoolThroughPings> schools;
  for (auto& [number, school] : by_number) schools.push_back(std::move(school));
  return correct_sizes(schools, params);
}

}  // namespace

Result<void> measure_schools(Engine& engine, std::vector<SchoolMasks> schools, ObservationProduct& product, Work& work,
                             MeasuredPings* before) {
  std::sort(schools.begin(), schools.end(),
            [](const auto& a, const auto& b) { return a.decided.school_id < b.decided.school_id; });
  const std::vector<MeasuredPing> pings = by_ping(schools, engine.sector());
  std::vector<std::vector<MeasuredMask>> rows(pings.size());
  std::vector<std::string> problems(pings.size());
  std::atomic<std::int64_t> done{0};
  const double area = two_way_area(engine.grid(), engine.beam_figures().psi_used_db, engine.recipe().measure);
  work.for_each(static_cast<std::int64_t>(pings.size()), [&](std::int64_t i) {
    const auto& [ping_index, refs] = pings[static_cast<std::size_t>(i)];
    if (const auto* kept = kept_rows(before, engine, ping_index, refs)) {
      rows[static_cast<std::size_t>(i)] = *kept;
    } else if (const auto ping = engine.kept_or_staged(ping_index)) {
      rows[static_cast<std::size_t>(i)] = measure_ping(**ping, engine, refs, area);
    } else {
      problems[static_cast<std::size_t>(i)] = ping.error().text;
    }
    work.progress("measuring", ++done, static_cast<std::int64_t>(pings.size()));
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  if (before != nullptr && engine.refusal()) keep_rows(*before, engine, pings, rows, problems);
  Faults faults;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (!problems[i].empty()) note_unreadable(pings[i].first, problems[i], product);
    for (MeasuredMask& one : rows[i]) {
      faults[{one.school.row.school_id, one.school.row.ping_index}] = std::move(one.fault);
    }
  }
  product.grid = grid_record(engine.observation(), engine.recipe().calibration);
  product.school_pings = corrected_rows(rows, engine.recipe().measure);
  if (engine.recipe().measure.extinction.correct && !product.school_pings.empty()) {
    product.diagnostics.push_back({DiagnosticCode::extinction_corrected, "", -1, -1,
                                   fmt::format("schools are corrected for extinction, sigma_e/sigma = {:g}",
                                               engine.recipe().measure.extinction.ratio)});
  }
  summarise_schools(schools, engine.recipe(), product);
  add_errors(rows, engine.recipe(), product);
  take_masks(schools, faults, product);
  return {};
}

std::vector<std::int64_t> pings_to_measure(const Engine& engine, const std::vector<SchoolMasks>& schools,
                                           const MeasuredPings& before) {
  std::vector<std::int64_t> wanted;
  for (const auto& [ping_index, refs] : by_ping(schools, engine.sector())) {
    if (kept_rows(&before, engine, ping_index, refs) == nullptr) wanted.push_back(ping_index);
  }
  return wanted;
}

}  // namespace sonar
