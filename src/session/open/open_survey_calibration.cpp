// SPDX-License-Identifier: Apache-2.0
// Another calibration: Sv and measures follow it, masks and decisions stay.
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/survey/calibration_json.h"
#include "session/open/document.h"

namespace sonar {
namespace {

/// Compared by content: each replay of the journal makes a new object, and unknown values equal nothing.
std::string text_of(const CalibrationParams& calibration) { return to_json(calibration).dump(); }

}  // namespace

Recipe OpenSurvey::measuring_recipe() const {
  Recipe recipe = read_.recipe;
  if (calibration_) recipe.calibration = *calibration_;
  return recipe;
}

OpenObservationPtr OpenSurvey::calibrated(const OpenObservationPtr& chosen_on) const {
  if (!calibration_) return chosen_on;
  chosen_on->cache().rest();
  chosen_on->cache().keep_last();  // growths are tried on it, again and again
  return std::make_shared<OpenObservation>(chosen_on, measuring_recipe(), document_.options().prefetch,
                                           document_.options().memory_bytes);
}

void OpenSurvey::follow_calibration() {
  if (choices_.states.empty() || !choices_.states.begin()->second) return;
  auto calibration = choices_.states.begin()->second->calibration;
  const std::string own = text_of(read_.recipe.calibration);
  const std::string now = calibration ? text_of(*calibration) : own;
  if (now == (calibration_ ? text_of(*calibration_) : own)) return;
  if (now == own) calibration.reset();
  calibration_ = std::move(calibration);
  for (auto& [index, at] : open_) {
    at.open = calibrated(at.chosen_on);
    at.kept = std::make_shared<KeptMeasures>();
  }
  tell(calibration_ ? "Sv and measures follow the chosen calibration; masks and decisions stay (undo takes it back)"
                    : "Sv and measures follow the calibration that the journal began with");
  if (!shown_) return;
  shown_ = open_.at(shown_->index()).open;
  tell(DocumentChange::observation);
  look_at(ping_);
}

}  // namespace sonar
