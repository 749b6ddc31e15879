// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "pipeline/score/score_cause.h"
#include "pipeline/score/score_index.h"
#include "pipeline/score/score_pairs.h"
#include "pipeline/score/score_place.h"

namespace sonar {
namespace {

bool spans_enough(const PingMask& mask, const std::vector<int>& row_of_channel, int beams_of_grid) {
  std::set<int> beams;
  std::set<int> fans;
  std::int32_t first = mask.runs.front().first_sample;
  std::int32_t last = first;
  for (const Run& run : mask.runs) {
    const int row = row_of_channel[static_cast<std::size_t>(run.row)];
    beams.insert(row % beams_of_grid);
    fans.insert(row / beams_of_grid);
    first = std::min(first, run.first_sample);
    last = std::max(last, run.end());
  }
  return std::ssize(beams) >= kCountedBeams && std::ssize(fans) >= kCountedFans && last - first >= kCountedSamples;
}

/// Errors over the unclipped pings in which both have a row.
void compare_rows(const std::vector<PingPair>& pairs, const Indexed& found, const SchoolKey& partner,
                  const std::map<std::int64_t, BodyInPing>& bodies, SchoolScore& out) {
  PairedMeans volume, corrected, length, width, height, backscatter, sv, body_volume, body_backscatter, total;
  double cog_m = 0.0;
  int cogs = 0;
  for (const PingPair& pair : pairs) {
    if (!pair.unclipped || pair.truth_row == nullptr || pair.found_ping < 0) continue;
    const auto found_row = found.rows.find({partner.first, partner.second, pair.found_ping});
    if (found_row == found.rows.end() || pair.found_observation != partner.first) continue;
    const SchoolPingRow& f = *found_row->second;
    const SchoolPingRow& t = *pair.truth_row;
    volume.add(f.volume_m3, t.volume_m3);
    corrected.add(f.volume_corrected_m3, t.volume_corrected_m3);
    length.add(f.length_corrected_m, t.length_corrected_m);
    width.add(f.width_corrected_m, t.width_corrected_m);
    height.add(f.height_corrected_m, t.height_corrected_m);
    backscatter.add(f.backscatter_m2, t.backscatter_m2);
    sv.add(linear_from_db(f.sv_mean_db), linear_from_db(t.sv_mean_db));
    if (const double d = distance_m(f, t); std::isfinite(d)) {
      cog_m += d;
      ++cogs;
    }
    if (const auto body = bodies.find(pair.ping_index); body != bodies.end()) {
      body_volume.add(f.volume_corrected_m3, body->second.volume_m3);
      body_backscatter.add(f.backscatter_m2, body->second.backscatter_m2);
      total.add(f.backscatter_total_m2, body->second.backscatter_m2);
    }
  }
  if (cogs > 0) out.cog_error_m = cog_m / cogs;
  out.volume_ratio = volume.ratio();
  out.volume_corrected_ratio = corrected.ratio();
  out.length_corrected_ratio = length.ratio();
  out.width_corrected_ratio = width.ratio();
  out.height_corrected_ratio = height.ratio();
  out.backscatter_error_db = backscatter.error_db();
  out.sv_error_db = sv.error_db();
  out.body_volume_corrected_ratio = body_volume.ratio();
  out.body_backscatter_error_db = body_backscatter.error_db();
  out.total_backscatter_error_db = total.error_db();
}

/// Mean Sv of the bodies over the unclipped pings, as a school's row takes it; over all where there are none.
double body_sv_db(const std::vector<PingPair>& pairs, const std::map<std::int64_t, BodyInPing>& bodies) {
  const bool any_whole = std::any_of(pairs.begin(), pairs.end(), [](const PingPair& pair) { return pair.unclipped; });
  double sum = 0.0;
  int known = 0;
  for (const PingPair& pair : pairs) {
    const auto body = bodies.find(pair.ping_index);
    if (body == bodies.end() || (any_whole && !pair.unclipped) || !(body->second.volume_m3 > 0.0)) continue;
    sum += body->second.backscatter_m2 / body->second.volume_m3;
    ++known;
  }
  return sum > 0.0 ? db_from_linear(sum / known) : kUnknown;
}

double mean_dice(const std::vector<PingPair>& pairs, const Indexed& found, const std::optional<SchoolKey>& partner) {
  double sum = 0.0;
  int pings = 0;
  for (const PingPair& pair : pairs) {
    if (!pair.unclipped) continue;
    ++pings;
    if (!partner || pair.found_ping < 0 || pair.found_observation != partner->first) continue;
    const auto mask = found.masks.find({partner->first, partner->second, pair.found_ping});
    if (mask != found.masks.end()) sum += dice(mask->second, *pair.truth);
  }
  return pings > 0 ? sum / pings : kUnknown;
}

using Likenesses = std::map<SchoolKey, TrackLikeness>;

/// The true school that a track is like in most pings; among equals the first.
std::optional<SchoolKey> most_like(const TrackLikeness& track) {
  std::optional<SchoolKey> best;
  int most = 0;
  for (const auto& [school, pings] : track.pings) {
    if (pings <= most) continue;
    most = pings;
    best = school;
  }
  return best;
}

std::map<std::int64_t, BodyInPing> bodies_of(const ScoreSide& truth, const std::string& observation,
                                             std::int64_t school_id) {
  std::map<std::int64_t, BodyInPing> out;
  for (auto it = truth.bodies.lower_bound({observation, school_id, 0});
       it != truth.bodies.end() && it->first.observation == observation && it->first.school_id == school_id; ++it) {
    out[it->first.ping_index] = it->second;
  }
  return out;
}

double inside(const std::vector<PingPair>& pairs, const std::map<std::int64_t, BodyInPing>& bodies,
              std::int64_t unclipped) {
  double sum = 0.0;
  int known = 0;
  for (const PingPair& pair : pairs) {
    const auto body = bodies.find(pair.ping_index);
    if (body == bodies.end() || !std::isfinite(body->second.fraction_inside)) continue;
    sum += body->second.fraction_inside;
    ++known;
  }
  return known > 0 ? sum / known : static_cast<double>(unclipped) / static_cast<double>(pairs.size());
}

std::string id_text(const ScoreSide& side, const SchoolKey& key) {
  return fmt::format("{}/{}", side.observations[key.first].observation, key.second);
}

SchoolScore score_school(const SchoolKey& key, const std::vector<PingPair>& pairs, const ScoreSide& found_side,
                         const Indexed& found, const ScoreSide& truth_side, const Indexed& truth) {
  SchoolScore out;
  const ObservationProduct& product = truth_side.observations[key.first];
  out.truth_id = id_text(truth_side, key);
  out.n_pings = std::ssize(pairs);
  std::vector<double> ranges;
  std::vector<double> elevations_deg;
  int enough = 0;
  const std::vector<int> row_of_channel = product.grid->grid.row_of_channel();
  for (const PingPair& pair : pairs) {
    if (pair.truth_row != nullptr) ranges.push_back(pair.truth_row->range_m);
    elevations_deg.push_back(mean_elevation_deg(*pair.truth, product.grid->grid, row_of_channel));
    if (!pair.unclipped) continue;
    ++out.n_unclipped;
    if (spans_enough(*pair.truth, row_of_channel, product.grid->grid.beams())) ++enough;
  }
  out.counted = enough >= kCountedPings;
  out.range_m = median_known(std::move(ranges));
  out.elevation_deg = median_known(std::move(elevations_deg));
  const auto bodies = bodies_of(truth_side, product.observation, key.second);
  out.inside = inside(pairs, bodies, out.n_unclipped);
  const std::optional<SchoolKey> partner = track_partner(pairs);
  out.dice = mean_dice(pairs, found, partner);
  if (!partner) return out;
  out.found_id = id_text(found_side, *partner);
  compare_rows(pairs, found, *partner, bodies, out);
  const auto truth_school = truth.schools.find(key);
  const auto found_school = found.schools.find(*partner);
  if (truth_school != truth.schools.end() && found_school != found.schools.end()) {
    out.body_sv_error_db = found_school->second->sv_corrected_db - body_sv_db(pairs, bodies);
    out.speed_error_mps = found_school->second->speed_mps - truth_school->second->speed_mps;
  }
  return out;
}

/// Tracks by what became of them.
struct Pairing {
  std::map<SchoolKey, std::vector<SchoolKey>> schools_of;  ///< found track -> true schools paired with it
  std::map<SchoolKey, std::vector<SchoolKey>> pieces_of;   ///< true school -> its fragments
  std::vector<SchoolKey> false_tracks;
};

Pairing pair_tracks(const std::map<SchoolKey, std::vector<PingPair>>& pairs, const Indexed& found,
                    const Likenesses& looks) {
  Pairing out;
  for (const auto& [school, of_school] : pairs) {
    if (const auto partner = track_partner(of_school)) out.schools_of[*partner].push_back(school);
  }
  std::set<SchoolKey> tracks;
  for (const auto& [key, mask] : found.masks) tracks.insert({std::get<0>(key), std::get<1>(key)});
  for (const SchoolKey& track : tracks) {
    if (out.schools_of.contains(track)) continue;
    const auto look = looks.find(track);
    const bool inside = look != looks.end() && static_cast<double>(look->second.inside) >=
                                                   kFragmentInside * static_cast<double>(look->second.voxels);
    const auto whose = inside ? most_like(look->second) : std::nullopt;
    if (whose) {
      out.pieces_of[*whose].push_back(track);
    } else {
      out.false_tracks.push_back(track);
    }
  }
  return out;
}

/// Of several true schools in one track it is the one that it is like in most pings; the others were not found.
SchoolKey owner_of(const std::vector<SchoolKey>& schools, const TrackLikeness& look) {
  const auto pings = [&](const SchoolKey& s) {
    const auto at = look.pings.find(s);
    return at == look.pings.end() ? 0 : at->second;
  };
  return *std::max_element(schools.begin(), schools.end(),
                           [&](const SchoolKey& a, const SchoolKey& b) { return pings(a) < pings(b); });
}

/// Share of a school's own pings in its track and in the fragments of the school.
double purity(const SchoolKey& school, const TrackLikeness& look, std::int64_t pings_of_fragments) {
  std::int64_t all = pings_of_fragments;
  std::int64_t own = 0;
  for (const auto& [other, pings] : look.pings) {
    all += pings;
    if (other == school) own += pings;
  }
  return all > 0 ? static_cast<double>(own) / static_cast<double>(all) : kUnknown;
}

}  // namespace

Score score(const ScoreSide& found_side, const ScoreSide& truth_side) {
  const Indexed found = index_side(found_side);
  const Indexed truth = index_side(truth_side);
  const Likenesses looks = look_back(found, found_side, truth);
  const std::map<SchoolKey, std::vector<PingPair>> pairs = pair_pings(found, truth, truth_side);
  std::map<SchoolKey, std::int64_t> pings_of;
  for (const auto& [key, mask] : found.masks) ++pings_of[{std::get<0>(key), std::get<1>(key)}];
  const Pairing pairing = pair_tracks(pairs, found, looks);
  std::map<SchoolKey, std::size_t> place;
  Score out;
  out.span = span_of(truth_side);
  out.pings = std::count_if(truth.pings.begin(), truth.pings.end(),
                            [&](const auto& ping) { return ping_at(found, ping.first).has_value(); });
  for (const auto& [key, of_school] : pairs) {
    place[key] = out.schools.size();
    out.schools.push_back(score_school(key, of_school, found_side, found, truth_side, truth));
    SchoolScore& school = out.schools.back();
    std::int64_t pings_of_fragments = 0;
    if (const auto pieces = pairing.pieces_of.find(key); pieces != pairing.pieces_of.end()) {
      for (const SchoolKey& piece : pieces->second) {
        pings_of_fragments += pings_of[piece];
        out.fragments.push_back({id_text(found_side, piece), school.truth_id, pings_of[piece]});
      }
      school.fragments = std::ssize(pieces->second);
    }
    const auto partner = track_partner(of_school);
    if (!partner) continue;
    const auto look = looks.find(*partner);
    if (look != looks.end()) school.purity = purity(key, look->second, pings_of_fragments);
  }
  for (const auto& [track, schools] : pairing.schools_of) {
    if (schools.size() < 2) continue;
    const SchoolKey owner = owner_of(schools, looks.at(track));
    MergedTrack merged{id_text(found_side, track), {}};
    for (const SchoolKey& school : schools) {
      merged.truth_ids.push_back(id_text(truth_side, school));
      out.schools[place[school]].merged = school != owner;
    }
    out.merged.push_back(std::move(merged));
  }
  for (const SchoolKey& key : pairing.false_tracks) {
    FalseSchool school;
    school.found_id = id_text(found_side, key);
    school.n_pings = pings_of[key];
    if (const auto row = found.schools.find(key); row != found.schools.end()) {
      school.volume_m3 = row->second->volume_m3;
      school.sv_mean_db = row->second->sv_mean_db;
    }
    std::tie(school.cause, school.cause_share) = cause_of(key, {found, found_side, truth, truth_side});
    out.false_schools.push_back(std::move(school));
  }
  return out;
}

}  // namespace sonar
