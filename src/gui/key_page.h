// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QKeySequence>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QWidget>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "session/actions.h"
#include "session/listening.h"

namespace sonar {

/// Shows nothing but what it is for: a key that is pressed in it is told. Tab goes on, and Escape belongs to the window.
class KeyField : public QLineEdit {
 public:
  explicit KeyField(QWidget* parent);
  void on_key(std::function<void(const QKeySequence& key)> told) { told_ = std::move(told); }

 protected:
  bool event(QEvent* event) override;

 private:
  std::function<void(const QKeySequence& key)> told_;
};

/// Every action with its keys: a key is changed by pressing it; one that another action has is refused, and whose it is told.
class KeyPage : public QWidget {
 public:
  /// The actions outlive the page.
  explicit KeyPage(Actions& actions, QWidget* parent = nullptr);

 private:
  void fill();
  void narrow(const QString& words);
  void choose();
  void press(const QKeySequence& key);
  void set(std::vector<std::string> keys);
  void reset_all();
  [[nodiscard]] const Action* chosen() const;

  Actions& actions_;
  QTreeWidget* list_ = new QTreeWidget(this);
  KeyField* key_ = new KeyField(this);
  QPushButton* none_ = new QPushButton("No key", this);
  QPushButton* usual_ = new QPushButton("Usual key", this);
  QLabel* told_ = new QLabel(this);
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
