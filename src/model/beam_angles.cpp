// SPDX-License-Identifier: Apache-2.0
#include "model/beam_angles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"

namespace sonar {
namespace {

// Widths in files have three or four digits.
constexpr double kRounding_db = 0.1;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double psi_from_widths_db(double vertical_deg, double horizontal_deg) {
  const double widths_rad2 = rad_from_deg(vertical_deg) * rad_from_deg(horizontal_deg);
  return vertical_deg > 0.0 && horizontal_deg > 0.0 ? db_from_linear(kSquareBeamArea * widths_rad2) : kNaN;
}

std::vector<double> psi_from_widths_db(const BeamGrid& grid) {
  std::vector<double> psi_db;
  for (std::size_t row = 0; row < std::min(grid.vertical_width_deg.size(), grid.horizontal_width_deg.size()); ++row) {
    psi_db.push_back(psi_from_widths_db(grid.vertical_width_deg[row], grid.horizontal_width_deg[row]));
  }
  return psi_db;
}

std::vector<double> psi_excess_db(const BeamGrid& grid) {
  std::vector<double> excess_db = psi_from_widths_db(grid);
  for (std::size_t row = 0; row < excess_db.size(); ++row) {
    excess_db[row] = (row < grid.psi_stated_db.size() ? grid.psi_stated_db[row] : kNaN) - excess_db[row];
  }
  return excess_db;
}

PsiExcess excess_over(std::span<const double> excess_db) {
  PsiExcess out;
  double sum = 0.0;
  for (const double db : excess_db) {
    if (!std::isfinite(db)) continue;
    out.least_db = out.beams == 0 ? db : std::min(out.least_db, db);
    out.most_db = out.beams == 0 ? db : std::max(out.most_db, db);
    sum += linear_from_db(db);
    ++out.beams;
    if (db > kWidestTransmit_db + kRounding_db || db < -kRounding_db) ++out.impossible;
  }
  if (out.beams > 0) out.mean_db = db_from_linear(sum / static_cast<double>(out.beams));
  return out;
}

PsiExcess excess_of_fan(std::span<const double> excess_db, const BeamGrid& grid, int fan) {
  const auto beams = static_cast<std::size_t>(grid.beams());
  const std::size_t first = static_cast<std::size_t>(fan) * beams;
  return first + beams <= excess_db.size() ? excess_over(excess_db.subspan(first, beams)) : PsiExcess{};
}

std::string text_of(const PsiExcess& excess) {
  if (excess.beams == 0) return {};
  std::string text = fmt::format("psi is {:.1f} to {:.1f} dB (mean {:.1f}) more than the widths give", excess.least_db,
                                 excess.most_db, excess.mean_db);
  if (excess.impossible > 0) {
    text += fmt::format("; in {} of {} beams no transmit beam explains it", excess.impossible, excess.beams);
  }
  return text;
}

}  // namespace sonar
