// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QStatusBar>
#include <functional>

namespace sonar {

/// A status bar whose message loses nothing in a narrow window: what has no room ends in an ellipsis and is whole under the
/// pointer. A click on the message leads to those before it.
class NoticeBar : public QStatusBar {
 public:
  NoticeBar(QWidget* parent, std::function<void()> clicked);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  [[nodiscard]] QRect room() const;

  std::function<void()> clicked_;
};

}  // namespace sonar
