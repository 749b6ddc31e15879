// SPDX-License-Identifier: Apache-2.0
#include "session/lists/school_ping_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "model/school_totals.h"
#include "session/lists/cells.h"

namespace sonar {
namespace {

template <double SchoolPingRow::*member, int decimals>
Cell figure(const SchoolInPing& one) {
  return number_cell(one.row->*member, decimals);
}

template <double SchoolDescriptors::*member, int decimals>
Cell descriptor(const SchoolInPing& one) {
  return number_cell(one.row->*member, decimals);
}

std::string edge_text(std::int64_t flags) {
  constexpr std::array<std::string_view, 9> kNames{"fore", "aft",    "top fan", "bottom fan", "near",
                                                   "far",  "seabed", "surface", "flagged"};
  std::string text;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if ((static_cast<std::uint64_t>(flags) >> i & 1U) != 0)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", kNames[i]);
  }
  return text;
}

const std::vector<ColumnOf<SchoolInPing>>& ping_columns() {
  using S = SchoolInPing;
  using R = SchoolPingRow;
  using D = SchoolDescriptors;
  static const std::vector<ColumnOf<S>> kColumns{
      {{"School", "", "number of the school in its observation", true},
       [](const S& s) { return count_cell(s.name.number); }},
      {{"Observation", "", "", false}, [](const S& s) { return text_cell(s.row->observation); }},
      {{"Ping", "", "index in the observation, from 0", true},
       [](const S& s) { return count_cell(s.row->ping_index); }},
      {{"Time", "UTC", "", false}, [](const S& s) { return time_cell(s.row->time_utc); }},
      {{"Depth", "m", "of its centre below the sea surface", true}, figure<&R::depth_m, 1>},
      {{"Range", "m", "of its centre from the sonar", true}, figure<&R::range_m, 1>},
      {{"Bearing", "\u00B0", "true, from the sonar", true}, figure<&R::bearing_deg, 0>},
      {{"Voxels", "", "", true}, [](const S& s) { return count_cell(s.row->n_voxels); }},
      {{"Volume", "m\u00B3", "as the beams see it", true}, figure<&R::volume_m3, 0>},
      {{"Volume corrected", "m\u00B3", "with beam width and pulse length removed", true},
       figure<&R::volume_corrected_m3, 0>},
      {{"Length", "m", "", true}, figure<&R::length_m, 1>},
      {{"Width", "m", "", true}, figure<&R::width_m, 1>},
      {{"Height", "m", "", true}, figure<&R::height_m, 1>},
      {{"Shallowest", "m", "", true}, figure<&R::depth_min_m, 1>},
      {{"Deepest", "m", "", true}, figure<&R::depth_max_m, 1>},
      {{"Sv", "dB re 1 m\u207B\u00B9", "mean volume backscattering strength", true}, figure<&R::sv_mean_db, 1>},
      {{"Sv 95 %", "dB re 1 m\u207B\u00B9", "exceeded by 5 % of its voxels", true}, figure<&R::sv_p95_db, 1>},
      {{"Sv max", "dB re 1 m\u207B\u00B9", "", true}, figure<&R::sv_max_db, 1>},
      {{"Backscatter", "m\u00B2", "total backscattering cross-section (sum of sigma_bs, no 4 pi)", true},
       [](const S& s) { return broad_cell(echo_m2(*s.row)); }},
      {{"SNR", "dB", "signal-to-noise ratio", true}, figure<&R::snr_db, 1>},
      {{"Edges", "", "edges of what the sonar sees that it touches", false},
       [](const S& s) { return text_cell(edge_text(s.row->edge_flags)); }},
      {{"Seabed", "m", "depth of the seabed below it", true}, figure<&R::bottom_depth_m, 1>},
      {{"Latitude", "", "of its centre", true}, [](const S& s) { return latitude_cell(s.row->latitude); }},
      {{"Longitude", "", "of its centre", true}, [](const S& s) { return longitude_cell(s.row->longitude); }},
      {{"Surface", "m\u00B2", "area of its outer surface", true}, descriptor<&D::surface_m2, 0>},
      {{"Sphericity", "", "surface of the sphere of the same volume over its surface", true},
       descriptor<&D::sphericity, 2>},
      {{"Roughness", "", "surface over that of a smooth ellipsoid of the same volume and spread", true},
       descriptor<&D::roughness, 2>},
      {{"Vacuoles", "", "voids that it encloses on all sides", true}, descriptor<&D::n_vacuoles, 0>},
      {{"Nuclei", "", "dense parts, with half the echo or less between any two", true}, descriptor<&D::n_nuclei, 0>},
      {{"Sv robust", "dB re 1 m\u207B\u00B9", "mean without the highest and lowest 5 % of its voxels", true},
       descriptor<&D::sv_robust_mean_db, 1>},
      {{"Variation", "", "coefficient of variation of sv: 1 for fading alone", true}, descriptor<&D::sv_variation, 2>},
      {{"Core - edge", "dB", "mean Sv of its core less that of its edge", true}, descriptor<&D::core_edge_db, 1>},
      {{"NASC", "m\u00B2 nmi\u207B\u00B2", "over its own area, seen from above", true},
       [](const S& s) { return broad_cell(s.row->nasc_m2_nmi2); }},
      {{"Above seabed", "m", "of its deepest point", true}, descriptor<&D::bottom_distance_m, 1>},
      {{"Incidence", "\u00B0", "between beam and length: 0 end on, 90 broadside", true},
       descriptor<&D::incidence_deg, 0>},
      {{"Nb across", "", "Diner's relative size across the beam; doubt widths below 1.5", true},
       descriptor<&D::diner_nb_across, 1>},
      {{"Nb height", "", "Diner's relative size upright; doubt heights below 1.5", true},
       descriptor<&D::diner_nb_height, 1>},
      {{"Speed", "m/s", "over ground, smoothed over a window", true}, figure<&R::speed_smoothed_mps, 2>},
      {{"From the bow", "\u00B0", "bearing from the bow, positive to starboard", true},
       figure<&R::relative_bearing_deg, 0>},
      {{"Speed away", "m/s", "over ground, away from the ship; negative = towards it", true},
       figure<&R::speed_away_mps, 2>},
      {{"To closest", "s", "time to the ship's closest point of approach; negative = past", true},
       figure<&R::time_to_cpa_s, 0>},
      {{"Closest", "m", "distance at the closest point of approach", true}, figure<&R::cpa_m, 0>},
  };
  return kColumns;
}

}  // namespace

SchoolPingTable::SchoolPingTable(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::measures}), titles_(titles_of(ping_columns())) {}

void SchoolPingTable::make() {
  titles_ = titles_of(ping_columns(), workspace().units());
  pings_.clear();
  const auto& wanted = workspace().school();
  for (const auto& [index, state] : workspace().document.choices().states) {
    const ProductPtr product = workspace().document.product(index);
    if (!product || (!all_ && (!wanted || wanted->observation != index))) continue;
    for (const SchoolPingRow& row : product->school_pings) {
      if (all_ || row.school_id == wanted->number) pings_.push_back({{index, row.school_id}, product, &row});
    }
  }
}

void SchoolPingTable::show_all(bool all) {
  all_ = all;
  refresh();
}

Cell SchoolPingTable::cell(std::size_t row, std::size_t column) const {
  return cell_of(ping_columns()[column], pings_[row], workspace().units());
}

void SchoolPingTable::select(std::size_t row) {
  if (row >= pings_.size()) return;
  const SchoolInPing one = pings_[row];  // what follows may make the rows anew
  go_to_ping(workspace(), one.name.observation, one.row->ping_index);
  workspace().school.set(one.name);
}

std::optional<std::size_t> SchoolPingTable::selected() const {
  const auto& shown = workspace().document.shown();
  const auto& name = workspace().school();
  if (!shown || !name) return std::nullopt;
  const auto found = std::find_if(pings_.begin(), pings_.end(), [&](const SchoolInPing& one) {
    return one.name == *name && one.name.observation == shown->index() &&
           one.row->ping_index == workspace().document.ping();
  });
  return found == pings_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - pings_.begin()));
}

}  // namespace sonar
