// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QLineEdit>
#include <QStatusBar>
#include <functional>

namespace sonar {

class UnfoldedWords;

/// The foot of a window: the values under the pointer or the last notice, what waits for an answer to its right. Words that
/// have no room in its line unfold upwards, over the views but not over what is pointed at: nothing is cut, and nothing
/// moves. A click on a notice leads to those before it.
class NoticeBar : public QStatusBar {
 public:
  NoticeBar(QWidget* window, std::function<void()> clicked);

  /// A line of text, not a label: its words can be copied, and new ones do not have the whole window laid out anew.
  [[nodiscard]] QLineEdit& read_out() const { return *read_out_; }
  void tell(const QString& under_pointer);

 protected:
  bool event(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QRect room() const;
  void unfold();

  std::function<void()> clicked_;
  QLineEdit* read_out_;
  UnfoldedWords* unfolded_;
};

}  // namespace sonar
