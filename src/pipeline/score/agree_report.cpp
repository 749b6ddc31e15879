// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/time.h"
#include "pipeline/score/agree.h"

namespace sonar {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

/// Visitor that makes an object of one row; what is unknown or empty is null.
class JsonRow {
 public:
  void operator()(std::string_view name, std::string_view, const std::string& v) {
    row_[std::string(name)] = v.empty() ? json(nullptr) : json(v);
  }
  void operator()(std::string_view name, std::string_view, const std::int64_t& v) { row_[std::string(name)] = v; }
  void operator()(std::string_view name, std::string_view, const double& v) { row_[std::string(name)] = number(v); }
  void operator()(std::string_view name, std::string_view, TimeColumn v) {
    row_[std::string(name)] = v.value == 0 ? json(nullptr) : json(iso_time(v.value));
  }
  [[nodiscard]] json take() { return std::move(row_); }

 private:
  json row_ = json::object();
};

json kappa_json(const Kappa& kappa) {
  return {{"counts", kappa.counts},
          {"units", kappa.units},
          {"agreed_fraction", number(kappa.agreed_fraction)},
          {"agreed_yes_fraction", number(kappa.agreed_yes_fraction)},
          {"kappa", number(kappa.kappa)},
          {"kappa_se", number(kappa.kappa_se)}};
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : std::string("-");
}

std::string name_of(const std::string& school) { return school.empty() ? "-" : school; }

std::string row_text(const AgreementRow& row) {
  std::string line =
      fmt::format("{:<14}{:<14}{:>6}{:>6}{:>6}{:>7}{:>9}{:>8}{:>8}  {} / {}", name_of(row.school_a),
                  name_of(row.school_b), row.n_pings_a, row.n_pings_b, row.n_pings_both, cell(row.dice, 3),
                  cell(row.centre_distance_m, 2), cell(row.volume_ratio, 3), cell(row.backscatter_difference_db, 2),
                  row.status_a.empty() ? "none" : row.status_a, row.status_b.empty() ? "none" : row.status_b);
  if (!row.lies_in.empty()) line += fmt::format("  (lies in {})", row.lies_in);
  return line + "\n";
}

std::string kappa_text(const Kappa& kappa, std::string_view unit) {
  if (kappa.units == 0) return fmt::format("{}: there are none\n", unit);
  const auto& n = kappa.counts;
  std::string out =
      fmt::format("{}: {}; yes of both {}, of A alone {}, of B alone {}, no of both {}; agreed {} %\n", unit,
                  kappa.units, n[0][0], n[0][1], n[1][0], n[1][1], cell(100.0 * kappa.agreed_fraction, 1));
  if (std::isfinite(kappa.kappa)) {
    out += fmt::format("  Cohen's kappa {}, standard error {}\n", cell(kappa.kappa, 3), cell(kappa.kappa_se, 3));
  } else {
    out += "  Cohen's kappa is not defined: a reader gave one answer only\n";
  }
  return out;
}

}  // namespace

std::string agreement_json(const Agreement& agreement) {
  json schools = json::array();
  for (AgreementRow row : agreement.rows) {  // a copy: columns() takes a mutable row
    JsonRow object;
    columns(object, row);
    schools.push_back(object.take());
  }
  const json out = {{"pings", agreement.pings},
                    {"schools", std::move(schools)},
                    {"kappa_schools", kappa_json(agreement.schools)},
                    {"kappa_decisions", kappa_json(agreement.decisions)},
                    {"voxels",
                     {{"a", agreement.voxels_a},
                      {"b", agreement.voxels_b},
                      {"both", agreement.voxels_both},
                      {"dice", number(agreement.voxel_dice)}}}};
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string agreement_text(const Agreement& agreement) {
  std::string out = fmt::format("{:<14}{:<14}{:>6}{:>6}{:>6}{:>7}{:>9}{:>8}{:>8}  {}\n", "A", "B", "in A", "in B",
                                "both", "dice", "apart m", "B by A", "bsc dB", "status of A / of B");
  for (const AgreementRow& row : agreement.rows) out += row_text(row);
  out += fmt::format("\n{} pings in both; {} voxels of A, {} of B, {} of both: Dice {}\n", agreement.pings,
                     agreement.voxels_a, agreement.voxels_b, agreement.voxels_both, cell(agreement.voxel_dice, 3));
  out += kappa_text(agreement.schools, "schools that either has (yes = has it and did not reject it)");
  out += fmt::format("  agreed on yes {} (twice the yes of both, by all yes)\n",
                     cell(agreement.schools.agreed_yes_fraction, 3));
  out += kappa_text(agreement.decisions, "schools that both decided on (yes = accepted or corrected)");
  return out;
}

}  // namespace sonar
