// SPDX-License-Identifier: Apache-2.0
#include "gui/notice_bar.h"

#include <QFontMetrics>
#include <QMouseEvent>
#include <QPainter>
#include <QStyleOption>
#include <algorithm>
#include <utility>

namespace sonar {
namespace {

constexpr int kMargin_px = 6;

}  // namespace

NoticeBar::NoticeBar(QWidget* parent, std::function<void()> clicked)
    : QStatusBar(parent), clicked_(std::move(clicked)) {
  connect(this, &QStatusBar::messageChanged, this, [this](const QString& message) {
    setToolTip(message);
    message.isEmpty() ? unsetCursor() : setCursor(Qt::PointingHandCursor);
  });
}

/// Qt hides what stands on the left while there is a message; what is on the right stays.
QRect NoticeBar::room() const {
  int right = width();
  for (const QWidget* widget : findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
    if (widget->isVisible()) right = std::min(right, widget->x());
  }
  return {kMargin_px, 0, std::max(0, right - 2 * kMargin_px), height()};
}

void NoticeBar::paintEvent(QPaintEvent* event) {
  if (currentMessage().isEmpty()) return QStatusBar::paintEvent(event);
  QPainter painter(this);
  QStyleOption option;
  option.initFrom(this);
  style()->drawPrimitive(QStyle::PE_PanelStatusBar, &option, &painter, this);
  painter.setPen(palette().windowText().color());
  const QRect place = room();
  painter.drawText(place, Qt::AlignLeading | Qt::AlignVCenter | Qt::TextSingleLine,
                   fontMetrics().elidedText(currentMessage(), Qt::ElideRight, place.width()));
}

void NoticeBar::mousePressEvent(QMouseEvent* event) {
  const bool on_message = !currentMessage().isEmpty() && event->button() == Qt::LeftButton;
  if (!on_message) return QStatusBar::mousePressEvent(event);
  clicked_();
}

}  // namespace sonar
