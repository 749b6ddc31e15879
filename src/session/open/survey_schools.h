// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/school_totals.h"
#include "session/open/workspace.h"

namespace sonar {

/// A school of the survey: what humans and detection made of it, and its figures as far as they are measured.
struct SurveySchool {
  SchoolName name;
  std::shared_ptr<const StateSchool> state;
  OpenObservationPtr observation;
  ProductPtr product;              ///< keeps `row`
  const SchoolRow* row = nullptr;  ///< null = not measured yet, or nothing of it counts
  std::int64_t survey_number = 0;  ///< in the survey, as its results would have it now; 0 = not measured yet

  [[nodiscard]] const SchoolRow& decided() const { return state->masks.decided; }
  [[nodiscard]] std::int64_t pings() const { return static_cast<std::int64_t>(state->masks.pings.size()); }
  [[nodiscard]] std::int64_t middle_ping() const;
  [[nodiscard]] double backscatter_m2() const { return row == nullptr ? kUnknown : echo_m2(*row); }
  /// Signal-to-noise over its pings: the mean of the linear ratios, each weighted by its volume, in dB; NaN = unknown.
  [[nodiscard]] double snr_db() const;
  /// Share of its pings that touch an edge; NaN = unknown.
  [[nodiscard]] double edge_share() const { return row == nullptr ? kUnknown : row->touches_edge_fraction; }
  /// One of its voxels, as commands name it.
  [[nodiscard]] SchoolKey key() const { return key_of(state->masks, observation->context()); }
};

/// Of all observations that are open, by observation and number.
[[nodiscard]] std::vector<SurveySchool> survey_schools(const Document& document);
/// How many schools an observation has, as totals count them; those that are not measured yet are there as well.
[[nodiscard]] std::int64_t school_count(const JournalState& state, const ProductPtr& product);
/// Empty where there is none, or none is selected.
[[nodiscard]] std::optional<SurveySchool> selected_school(const Workspace& workspace);
/// All that a table has selected, selected_school() first; that alone where the tables have not several.
[[nodiscard]] std::vector<SurveySchool> selected_schools(const Workspace& workspace);
/// Says the same of all of them, in one act and one step to undo.
/// schools   one or more
/// decision  its school is not looked at
void decide_on(Workspace& workspace, const std::vector<SurveySchool>& schools, const Decision& decision);

/// "school 3 (north wall)"; without its name where it is not known.
[[nodiscard]] std::string title_of(const Document& document, const SchoolName& school);

/// The voxel in the middle of a mask, each voxel counted by its confidence.
[[nodiscard]] Voxel middle_of(const PingMask& mask, int beams);
/// Selects a school, looks at its observation and its middle ping, and lays the slices through its middle.
void go_to_school(Workspace& workspace, const SurveySchool& school);
/// Looks at a ping of an observation; opens the observation where needed.
void go_to_ping(Workspace& workspace, std::size_t observation, std::int64_t ping_index);

}  // namespace sonar
