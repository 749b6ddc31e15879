// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QScrollArea>
#include <vector>

#include "session/looks/transfer_editor.h"
#include "session/recipes/parameter_source.h"

namespace sonar {

/// The transfer function on top, the generated sections below.
class ControlPanelView : public QScrollArea {
 public:
  /// The editor outlives the view.
  ControlPanelView(TransferEditor& editor, Workspace& workspace, const std::vector<PanelSection>& sections);
  [[nodiscard]] QSize sizeHint() const override { return {340, 800}; }
};

}  // namespace sonar
