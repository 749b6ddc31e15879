// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QAction>
#include <QKeySequence>
#include <QMainWindow>

#include "session/app_model.h"

namespace sonar {

/// Whether a key is one character, with or without Shift: what a hand presses by mistake, and what is typed.
[[nodiscard]] bool is_single_character(const QKeySequence& key);

/// Lets single characters act only while a view or a table has the keyboard; elsewhere a line says so. A view that has it when it
/// is closed gives it to another one. What a key did is shown in the view that has the keyboard.
void add_view_keys(QMainWindow& window, AppModel& app);

/// An action that knows whether a key asked for it.
class KeyedAction : public QAction {
 public:
  using QAction::QAction;
  /// While it is triggered by a single character, Enter or Delete, which say nothing by themselves.
  [[nodiscard]] bool by_key() const { return by_key_; }

 protected:
  bool event(QEvent* event) override;

 private:
  bool by_key_ = false;
};

}  // namespace sonar
