// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/join_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "geo/geodesic.h"
#include "model/school_totals.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {
namespace {

/// A school through one observation, however many rows tell of it; as for totals, rejected ones tell of none, but hold a chain
/// together.
struct Track {
  SchoolRow* first = nullptr;  ///< the row that continues none of the others
  SchoolRow* at_begin = nullptr;
  SchoolRow* at_end = nullptr;
  const SchoolPingRow* begin = nullptr;
  const SchoolPingRow* end = nullptr;
};

using Span = std::pair<const SchoolPingRow*, const SchoolPingRow*>;

std::map<std::int64_t, Span> spans_of(const ObservationProduct& product) {
  std::map<std::int64_t, Span> spans;
  for (const SchoolPingRow& row : product.school_pings) {
    auto& [begin, end] = spans.try_emplace(row.school_id, &row, &row).first->second;
    if (row.ping_index < begin->ping_index) begin = &row;
    if (row.ping_index > end->ping_index) end = &row;
  }
  return spans;
}

std::vector<Track> tracks_of(ObservationProduct& product) {
  const std::map<std::int64_t, Span> spans = spans_of(product);
  std::vector<const SchoolRow*> rows;
  for (const SchoolRow& row : product.schools) rows.push_back(&row);
  const std::vector<int> chains = chains_of(rows);
  std::vector<Track> tracks;
  std::map<int, std::size_t> of_chain;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto span = spans.find(rows[i]->school_id);
    if (span == spans.end()) continue;
    const auto [at, is_new] = of_chain.try_emplace(chains[i], tracks.size());
    if (is_new) tracks.emplace_back();
    Track& track = tracks[at->second];
    SchoolRow* row = &product.schools[i];
    if (track.first == nullptr || row->continues.empty()) track.first = row;
    if (row->status == "rejected") continue;
    const auto& [begin, end] = span->second;
    if (track.begin == nullptr || begin->ping_index < track.begin->ping_index) {
      track.begin = begin;
      track.at_begin = row;
    }
    if (track.end == nullptr || end->ping_index > track.end->ping_index) {
      track.end = end;
      track.at_end = row;
    }
  }
  std::erase_if(tracks, [](const Track& track) { return track.begin == nullptr; });
  return tracks;
}

double known(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

/// Distance between where the earlier track would be by then and where the later one begins; negative = outside.
double miss(const Track& before, const Track& after, const MergeParams& params) {
  const SchoolRow& school = *before.at_end;
  const Geographic from{before.end->latitude, before.end->longitude};
  const Geographic to{after.begin->latitude, after.begin->longitude};
  if (!std::isfinite(from.latitude_deg) || !std::isfinite(to.latitude_deg)) return -1.0;
  const double seconds = static_cast<double>(after.begin->time_utc - before.end->time_utc) / 1e9;
  const bool moves = std::isfinite(school.speed_mps) && std::isfinite(school.course_deg);
  const Geographic predicted = moves ? destination(from, school.speed_mps * seconds, school.course_deg) : from;
  const double gate_m =
      params.gate_m + params.length_share * (known(school.length_m, 0.0) + known(after.at_begin->length_m, 0.0));
  const double depth_m = std::abs(known(before.end->depth_m, 0.0) - known(after.begin->depth_m, 0.0));
  const double distance_m = geodesic(predicted, to).distance_m;
  return distance_m <= gate_m && depth_m <= params.depth_gate_m ? distance_m : -1.0;
}

/// A pair of tracks that may be one school.
struct Join {
  double miss_m;
  const Track* before;
  const Track* after;
  [[nodiscard]] auto key() const { return std::tuple(miss_m, before->at_end->school_id, after->at_begin->school_id); }
};

/// may(before, after): whether a track ends, and another begins, at what parts them.
template <class May>
void join(const std::vector<Track>& before, const std::vector<Track>& after, const MergeParams& params,
          const May& may) {
  std::vector<Join> joins;
  for (const Track& a : before) {
    for (const Track& b : after) {
      const double miss_m = may(a, b) ? miss(a, b, params) : -1.0;
      if (miss_m >= 0.0) joins.push_back({miss_m, &a, &b});
    }
  }
  std::sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.key() < b.key(); });
  std::set<const Track*> followed;
  for (const Join& one : joins) {
    std::string& continues = one.after->first->continues;
    if (!continues.empty() || !followed.insert(one.before).second) continue;
    continues = school_name(one.before->at_end->observation, one.before->at_end->school_id);
  }
}

bool same_grid(const ObservationProduct& a, const ObservationProduct& b) {
  return a.grid && b.grid && a.grid->grid == b.grid->grid && a.grid->range.spacing_m == b.grid->range.spacing_m;
}

/// Whether `after` goes on where `before` was cut because it had become too long; nothing else is a cut.
bool is_cut(const ObservationProduct& before, const ObservationProduct& after) {
  if (before.pings.empty() || after.cut_after == 0 || after.cut_after != before.pings.back().time) return false;
  return before.source == after.source && same_grid(before, after);
}

MergeParams params_of(const ObservationProduct& product) {
  const auto recipe = recipe_from_text(product.recipe_json);
  return recipe ? recipe->merge : MergeParams{};
}

void note(const SchoolRow& school, const char* side, std::int64_t ping_index, ObservationProduct& product) {
  product.diagnostics.push_back(
      {DiagnosticCode::ended_at_reach, "", -1, ping_index,
       fmt::format("school {} goes on {} ping {}, where its propagation by hand had its reach: carry it on from there",
                   school.school_id, side, ping_index)});
}

}  // namespace

void join_over_cuts(std::span<ObservationProduct> products, const std::optional<MergeParams>& given) {
  for (ObservationProduct& after : products) {
    for (ObservationProduct& before : products) {
      if (&before == &after || !is_cut(before, after)) continue;
      const MergeParams params = given ? *given : params_of(after);
      const auto last_ping = std::ssize(before.pings) - 1;
      join(tracks_of(before), tracks_of(after), params, [&](const Track& a, const Track& b) {
        return a.end->ping_index >= last_ping - params.edge_pings && b.begin->ping_index <= params.edge_pings;
      });
    }
  }
}

void join_at_reach(ObservationProduct& product, const MergeParams& params) {
  const std::vector<Track> tracks = tracks_of(product);
  join(tracks, tracks, params, [&](const Track& a, const Track& b) {
    const std::int64_t unseen = b.begin->ping_index - a.end->ping_index - 1;
    const bool at_reach = ends_last(a.at_end->ended_at_reach) || ends_first(b.at_begin->ended_at_reach);
    return at_reach && unseen >= 0 && unseen <= params.edge_pings;
  });
  for (const Track& track : tracks_of(product)) {
    if (ends_first(track.at_begin->ended_at_reach)) note(*track.at_begin, "before", track.begin->ping_index, product);
    if (ends_last(track.at_end->ended_at_reach)) note(*track.at_end, "after", track.end->ping_index, product);
  }
}

}  // namespace sonar
