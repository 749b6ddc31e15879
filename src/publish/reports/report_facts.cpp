// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/number_text.h"
#include "geo/map_projection.h"
#include "model/school_totals.h"
#include "pipeline/recipe/recipe.h"
#include "view/maps/graticule.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr double kPlaceStep_deg = 1.0 / 3600.0;

/// What totals need of the products; masks are large.
std::vector<ObservationProduct> without_masks(std::span<const DrawnObservation> observations) {
  std::vector<ObservationProduct> out;
  for (const DrawnObservation& one : observations) {
    const ObservationProduct& product = one.product();
    ObservationProduct& slim = out.emplace_back();
    slim.observation = product.observation;
    slim.title = product.title;
    slim.schools = product.schools;
    slim.school_pings = product.school_pings;
  }
  return out;
}

std::string area_text(std::span<const DrawnObservation> observations) {
  std::vector<Geographic> places;
  std::size_t unknown = 0;
  for (const DrawnObservation& one : observations) {
    for (const PingNavigation& ping : one.product().pings) {
      ping.has_position() ? places.push_back(ping.transducer) : void(++unknown);
    }
  }
  const auto extent = extent_of(places);
  if (!extent) return "no ping has a position";
  std::string text =
      fmt::format("{} to {}, {} to {}", latitude_text(extent->south_deg, kPlaceStep_deg),
                  latitude_text(extent->north_deg, kPlaceStep_deg), longitude_text(extent->west_deg, kPlaceStep_deg),
                  longitude_text(extent->east_deg, kPlaceStep_deg));
  if (unknown > 0) text += fmt::format(" ({} without position)", count_of(unknown, "ping"));
  return text;
}

std::string sounder_text(std::span<const DrawnObservation> observations) {
  std::set<std::string> sounders;
  for (const DrawnObservation& one : observations) {
    if (!one.product().source.empty()) sounders.insert(one.product().source);
  }
  std::string text;
  for (const std::string& one : sounders) text += (text.empty() ? "" : ", ") + one;
  return text.empty() ? "not told" : text;
}

/// A school of several rows is described by the one with most pings.
ReportSchool school_of(const CountedSchool& counted, std::span<const ObservationProduct> products) {
  const SchoolRow& first = *counted.rows.front();
  const SchoolRow* longest = &first;
  ReportSchool out;
  for (const SchoolRow* row : counted.rows) {
    if (row->n_pings > longest->n_pings) longest = row;
    out.pings += row->n_pings;
    if (out.species.empty()) out.species = row->species;
  }
  out.survey_school = first.survey_school;
  out.name = school_name(longest->observation, longest->school_id);
  out.school_id = longest->school_id;
  const auto in = std::ranges::find(products, longest->observation, &ObservationProduct::observation);
  out.observation = static_cast<std::size_t>(in - products.begin());
  out.first_time = first.first_time_utc;
  out.latitude = longest->latitude;
  out.longitude = longest->longitude;
  out.depth_m = longest->depth_m;
  out.length_m = longest->length_m;
  out.sv_mean_db = longest->sv_mean_db;
  out.backscatter_m2 = counted.backscatter_m2;
  out.depth_se_m = longest->se[error_at("depth_m")];
  out.length_se_m = longest->se[error_at("length_m")];
  out.sv_mean_se_db = longest->se[error_at("sv_mean_db")];
  if (counted.rows.size() == 1) out.backscatter_se_m2 = first.backscatter_total_se_m2;
  out.status = longest->status;
  return out;
}

std::vector<std::pair<std::string, std::size_t>> most_first(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> out(counts.begin(), counts.end());
  std::ranges::stable_sort(out, [](const auto& a, const auto& b) { return a.second > b.second; });
  return out;
}

std::string observations_text(const ReportFacts& facts) {
  std::string text = fmt::format("{}", facts.observations);
  if (facts.searched == 0) return text + ", schools not detected";
  if (facts.searched < facts.observations) {
    text += fmt::format(", schools not detected in {} of them", facts.observations - facts.searched);
  }
  return text;
}

std::string schools_line(const ReportFacts& facts, double total_m2) {
  if (facts.searched == 0) return "not detected";
  std::string text = fmt::format("{}", facts.schools.size());
  if (!facts.schools.empty()) text += fmt::format(", backscatter {:.3g} m\u00B2 in all", total_m2);
  if (facts.rejected > 0) text += fmt::format("; {} rejected, not counted", facts.rejected);
  return text;
}

}  // namespace

ReportFacts report_facts(std::span<const DrawnObservation> observations, const Recipe& recipe) {
  const std::vector<ObservationProduct> products = without_masks(observations);
  ReportFacts facts;
  facts.title = survey_title(products);
  facts.observations = observations.size();
  std::size_t pings = 0;
  std::size_t bad = 0;
  TimeNs first = 0;
  TimeNs last = 0;
  for (const DrawnObservation& one : observations) {
    if (one.has_product()) ++facts.searched;
    const auto& all = one.product().pings;
    pings += all.size();
    bad += static_cast<std::size_t>(std::ranges::count_if(all, [](const PingNavigation& p) { return p.bad; }));
    if (all.empty()) continue;
    first = first == 0 ? all.front().time : std::min(first, all.front().time);
    last = std::max(last, all.back().time);
  }
  const std::vector<CountedSchool> counted = counted_schools(products);
  std::map<std::string, std::size_t> status;
  std::map<std::string, std::size_t> species;
  for (const CountedSchool& school : counted) {
    const ReportSchool& one = facts.schools.emplace_back(school_of(school, products));
    ++status[one.status];
    if (!one.species.empty()) ++species[one.species];
  }
  for (const ObservationProduct& product : products) {
    facts.rejected +=
        static_cast<std::size_t>(std::ranges::count(product.schools, std::string("rejected"), &SchoolRow::status));
  }
  const auto strength = [](const ReportSchool& s) { return std::isfinite(s.backscatter_m2) ? s.backscatter_m2 : -1.0; };
  std::ranges::stable_sort(facts.schools, [&](const auto& a, const auto& b) { return strength(a) > strength(b); });
  facts.by_status = most_first(status);
  facts.by_species = most_first(species);
  facts.lines = {{"Recorded", time_span_text(first, last)},
                 {"Area", area_text(observations)},
                 {"Sounder", sounder_text(observations)},
                 {"Observations", observations_text(facts)},
                 {"Pings", bad == 0 ? fmt::format("{}", pings) : fmt::format("{}, {} of them bad", pings, bad)},
                 {"Schools", schools_line(facts, total_backscatter_m2(counted))},
                 {"Program", "Sonar Explorer " SONAR_VERSION},
                 {"Recipe", recipe_hash(recipe)}};
  return facts;
}

}  // namespace sonar
