// SPDX-License-Identifier: Apache-2.0
#include "session/looks/first_sight.h"

#include "model/strongest_ping.h"

namespace sonar {

FirstSight::FirstSight(Workspace& workspace) : workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey) waiting_ = workspace_.document.survey() != nullptr;
    const bool looks = change == DocumentChange::looking || change == DocumentChange::ping;
    if (looks && workspace_.document.ping() != 0) waiting_ = false;
    if (change == DocumentChange::measures) look();
  });
  listening_.to(workspace.school.changed(), [this] { waiting_ = waiting_ && !workspace_.school(); });
}

void FirstSight::look() {
  Document& document = workspace_.document;
  if (!waiting_ || !document.shown()) return;
  const ProductPtr product = document.product(document.shown()->index());
  if (!product) return;
  const SchoolPingRow* strongest =
      strongest_ping(*product, [](const SchoolRow& school) { return school.status != "rejected"; });
  if (strongest == nullptr) return;
  waiting_ = false;
  workspace_.school.set(SchoolName{document.shown()->index(), strongest->school_id});
  document.look_at(strongest->ping_index);
}

}  // namespace sonar
