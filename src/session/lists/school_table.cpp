// SPDX-License-Identifier: Apache-2.0
#include "session/lists/school_table.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include "base/units.h"
#include "session/lists/cells.h"

namespace sonar {
namespace {

/// A measured figure; unknown before it is measured.
template <double SchoolRow::*member>
double figure(const SurveySchool& school) {
  return school.row == nullptr ? kUnknown : school.row->*member;
}

template <double SchoolDescriptors::*member, int decimals>
Cell descriptor(const SurveySchool& school) {
  return number_cell(school.row == nullptr ? kUnknown : school.row->*member, decimals);
}

/// A figure of schools.csv and its standard error, which runs tell that were asked to. error = error_at(its column)
template <auto member, int decimals, std::size_t error>
Cell with_error_of(const SurveySchool& school) {
  static_assert(error < kErrorCount);
  if (school.row == nullptr) return {};
  return with_error(number_cell(school.row->*member, decimals), school.row->se[error]);
}

std::vector<ColumnOf<SurveySchool>> made_columns() {
  using S = SurveySchool;
  using R = SchoolRow;
  using D = SchoolDescriptors;
  return {
      {{"School", "", "number of the school in its observation", true},
       [](const S& s) { return count_cell(s.name.number); }},
      {{"In survey", "", "number of the school in the survey, as its results and the survey map have it", true},
       [](const S& s) { return s.survey_number > 0 ? count_cell(s.survey_number) : Cell{}; }},
      {{"Observation", "", "", false}, [](const S& s) { return text_cell(s.observation->name()); }},
      {{"Status", "", "what a human decided", false}, [](const S& s) { return text_cell(s.decided().status); }},
      {{"Backscatter", "m\u00B2", "total backscattering cross-section (sum of sigma_bs, no 4 pi)", true},
       [](const S& s) { return broad_cell(s.backscatter_m2()); }},
      {{"Name", "", "that a human gave it", false}, [](const S& s) { return text_cell(s.decided().name); }},
      {{"Species", "", "", false}, [](const S& s) { return text_cell(s.decided().species); }},
      {{"First seen", "UTC", "time of its first ping", false},
       [](const S& s) {
         const auto& there = s.state->masks.pings;
         const auto& navigation = s.observation->files().navigation;
         return there.empty() ? Cell{} : time_cell(navigation[static_cast<std::size_t>(there.front().ping_index)].time);
       }},
      {{"Pings", "", "pings in which it was seen", true}, [](const S& s) { return count_cell(s.pings()); }},
      {{"Depth", "m", "of its centre below the sea surface", true}, with_error_of<&R::depth_m, 1, error_at("depth_m")>},
      {{"Volume", "m\u00B3", "as the beams see it", true}, with_error_of<&R::volume_m3, 0, error_at("volume_m3")>},
      {{"Volume corrected", "m\u00B3", "with beam width and pulse length removed", true},
       with_error_of<&R::volume_corrected_m3, 0, error_at("volume_corrected_m3")>},
      {{"Length", "m", "", true}, with_error_of<&R::length_m, 1, error_at("length_m")>},
      {{"Width", "m", "", true}, with_error_of<&R::width_m, 1, error_at("width_m")>},
      {{"Height", "m", "", true}, with_error_of<&R::height_m, 1, error_at("height_m")>},
      {{"Sv", "dB re 1 m\u207B\u00B9", "mean volume backscattering strength", true},
       with_error_of<&R::sv_mean_db, 1, error_at("sv_mean_db")>},
      {{"SNR", "dB", "signal-to-noise ratio", true}, [](const S& s) { return number_cell(s.snr_db(), 1); }},
      {{"Edge", "%", "share of its pings that touch an edge of what the sonar sees", true},
       [](const S& s) { return number_cell(100.0 * s.edge_share(), 0); }},
      {{"Speed", "kn", "over ground", true},
       [](const S& s) { return number_cell(figure<&R::speed_mps>(s) / kKnot_mps, 1); }},
      {{"Course", "\u00B0", "true, of its movement over ground", true},
       [](const S& s) { return number_cell(figure<&R::course_deg>(s), 0); }},
      {{"Latitude", "", "of its centre", true}, [](const S& s) { return latitude_cell(figure<&R::latitude>(s)); }},
      {{"Longitude", "", "of its centre", true}, [](const S& s) { return longitude_cell(figure<&R::longitude>(s)); }},
      {{"Origin", "", "who found it", false}, [](const S& s) { return text_cell(s.decided().origin); }},
      {{"Operator", "", "who decided last", false}, [](const S& s) { return text_cell(s.decided().operator_name); }},
      {{"Comment", "", "", false}, [](const S& s) { return text_cell(s.decided().comment); }},
      {{"Surface", "m\u00B2", "area of its outer surface", true},
       with_error_of<&D::surface_m2, 0, error_at("surface_m2")>},
      {{"Sphericity", "", "surface of the sphere of the same volume over its surface", true},
       with_error_of<&D::sphericity, 2, error_at("sphericity")>},
      {{"Vacuoles", "", "voids that it encloses on all sides", true},
       with_error_of<&D::n_vacuoles, 0, error_at("n_vacuoles")>},
      {{"Nuclei", "", "dense parts, with half the echo or less between any two", true},
       with_error_of<&D::n_nuclei, 0, error_at("n_nuclei")>},
      {{"NASC", "m\u00B2 nmi\u207B\u00B2", "over its own area, seen from above", true},
       [](const S& s) { return broad_cell(s.row == nullptr ? kUnknown : s.row->nasc_m2_nmi2); }},
      {{"Above seabed", "m", "of its deepest point", true},
       with_error_of<&D::bottom_distance_m, 1, error_at("bottom_distance_m")>},
      {{"Incidence", "\u00B0", "between beam and length: 0 end on, 90 broadside", true},
       descriptor<&D::incidence_deg, 0>},
      {{"Speed through water", "kn", "where a run was told the current", true},
       [](const S& s) { return number_cell(figure<&R::speed_water_mps>(s) / kKnot_mps, 1); }},
      {{"Course through water", "\u00B0", "true, where a run was told the current", true},
       [](const S& s) { return number_cell(figure<&R::course_water_deg>(s), 0); }},
      {{"Tortuosity", "", "length of its path over the distance from beginning to end; 1 = straight", true},
       [](const S& s) { return number_cell(figure<&R::tortuosity>(s), 2); }},
  };
}

}  // namespace

const std::vector<ColumnOf<SurveySchool>>& school_columns() {
  static const std::vector<ColumnOf<SurveySchool>> kColumns = made_columns();
  return kColumns;
}

SchoolTable::SchoolTable(Workspace& workspace)
    : DocumentRows(workspace, {DocumentChange::survey, DocumentChange::observation, DocumentChange::state,
                               DocumentChange::measures}),
      titles_(titles_of(school_columns())),
      listening_(workspace.chosen_schools.changed(), [this] { moved().tell(); }) {}

void SchoolTable::make() {
  titles_ = titles_of(school_columns(), workspace().units());
  schools_ = survey_schools(workspace().document);
}

Cell SchoolTable::cell(std::size_t row, std::size_t column) const {
  return cell_of(school_columns()[column], schools_[row], workspace().units());
}

void SchoolTable::select(std::size_t row) {
  if (row >= schools_.size()) return;
  const SurveySchool school = schools_[row];  // what follows may make the rows anew
  go_to_school(workspace(), school);
}

std::optional<std::size_t> SchoolTable::selected() const {
  const auto& name = workspace().school();
  if (!name) return std::nullopt;
  const auto found =
      std::find_if(schools_.begin(), schools_.end(), [&](const SurveySchool& one) { return one.name == *name; });
  return found == schools_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - schools_.begin()));
}

void SchoolTable::choose(const std::vector<std::size_t>& rows) {
  std::set<SchoolName> names;
  for (const std::size_t row : rows) {
    if (row < schools_.size()) names.insert(schools_[row].name);
  }
  if (names.size() < 2) names.clear();
  workspace().chosen_schools.set(std::move(names));
}

std::optional<std::vector<std::size_t>> SchoolTable::chosen() const {
  const std::set<SchoolName>& names = workspace().chosen_schools();
  std::vector<std::size_t> rows;
  if (const auto row = selected(); row && names.empty()) rows.push_back(*row);
  for (std::size_t row = 0; !names.empty() && row < schools_.size(); ++row) {
    if (names.contains(schools_[row].name)) rows.push_back(row);
  }
  return rows;
}

}  // namespace sonar
