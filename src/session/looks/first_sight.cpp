// SPDX-License-Identifier: Apache-2.0
#include "session/looks/first_sight.h"

#include "model/strongest_ping.h"

namespace sonar {

FirstSight::FirstSight(Workspace& workspace) : workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    const Document& document = workspace_.document;
    if (change == DocumentChange::survey) {
      waiting_ = document.survey() != nullptr;
      opened_at_.reset();
      may_leave_ = waiting_ && !(document.options().left_at && document.options().left_at(document.named()));
    }
    if (const auto& shown = document.shown()) {
      if (!opened_at_) opened_at_ = shown->index();
      may_leave_ = may_leave_ && shown->index() == opened_at_;
    }
    const bool looks = change == DocumentChange::looking || change == DocumentChange::ping;
    if (looks && workspace_.document.ping() != 0) waiting_ = false;
    if (change == DocumentChange::measures) look();
  });
  listening_.to(workspace.school.changed(), [this] { waiting_ = waiting_ && !workspace_.school(); });
}

void FirstSight::look() {
  const Document& document = workspace_.document;
  const auto& shown = document.shown();
  if (!waiting_ || !shown || !document.product(shown->index())) return;
  if (look_at(shown->index()) || !may_leave_) return;
  for (std::size_t i = 0; i < document.survey()->observations.size(); ++i) {
    const bool awaited = document.open_observation(i) && !document.product(i);
    if (awaited || look_at(i)) return;
  }
}

bool FirstSight::look_at(std::size_t observation) {
  Document& document = workspace_.document;
  const ProductPtr product = document.product(observation);
  if (!product) return false;
  const SchoolPingRow* strongest =
      strongest_ping(*product, [](const SchoolRow& school) { return school.status != "rejected"; });
  if (strongest == nullptr) return false;
  waiting_ = false;
  workspace_.school.set(SchoolName{observation, strongest->school_id});
  if (observation != document.shown()->index()) return document.show(observation, strongest->ping_index).has_value();
  document.look_at(strongest->ping_index);
  return true;
}

}  // namespace sonar
