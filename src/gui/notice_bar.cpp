// SPDX-License-Identifier: Apache-2.0
#include "gui/notice_bar.h"

#include <QCursor>
#include <QEvent>
#include <QFontMetrics>
#include <QMouseEvent>
#include <QPainter>
#include <QTextLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/translated.h"

namespace sonar {
namespace {

constexpr int kMargin_px = 8;

}  // namespace

/// All the words, over what is above their line.
class UnfoldedWords : public QWidget {
 public:
  UnfoldedWords(QWidget* window, std::function<void()> clicked) : QWidget(window), clicked_(std::move(clicked)) {
    setObjectName("unfolded");
    setAutoFillBackground(true);
    fold();
  }

  /// @param line    where they stand as far as they have room
  /// @param notice  takes clicks; values under the pointer leave them, and the pointer's place, to what lies below
  void tell(const QString& words, const QRect& line, bool notice) {
    lay_out(words, line.width() - 2 * kMargin_px);
    if (layout_.lineCount() < 2) return fold();
    const int height = std::max(line.height(), above() + static_cast<int>(std::ceil(layout_.boundingRect().height())));
    const int top = std::max(0, line.y() + line.height() - height);
    const QRect place(line.x(), top, line.width(), height);
    if (!notice && place.contains(window()->mapFromGlobal(QCursor::pos()))) return fold();
    setAttribute(Qt::WA_TransparentForMouseEvents, !notice);
    setGeometry(place);
    raise();
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setPen(palette().mid().color());
    painter.drawLine(0, 0, width(), 0);
    painter.setPen(palette().windowText().color());
    layout_.draw(&painter, QPointF(kMargin_px, above() / 2));
  }
  void mousePressEvent(QMouseEvent*) override { clicked_(); }

 private:
  /// Hidden, it would have the whole window laid out anew.
  void fold() { setGeometry(0, 0, 0, 0); }
  /// Between words where it can be.
  void lay_out(const QString& words, int width_px) {
    layout_.setText(words);
    layout_.setFont(font());
    QTextOption option;
    option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    layout_.setTextOption(option);
    layout_.beginLayout();
    double y = 0.0;
    for (QTextLine line = layout_.createLine(); line.isValid(); line = layout_.createLine()) {
      line.setLineWidth(std::max(1, width_px));
      line.setPosition({0.0, y});
      y += line.height();
    }
    layout_.endLayout();
  }
  [[nodiscard]] int above() const { return fontMetrics().height() / 2; }

  QTextLayout layout_;
  std::function<void()> clicked_;
};

NoticeBar::NoticeBar(QWidget* window, std::function<void()> clicked)
    : QStatusBar(window),
      clicked_(std::move(clicked)),
      read_out_(new QLineEdit(this)),
      unfolded_(new UnfoldedWords(window, clicked_)) {
  read_out_->setObjectName("read_out");
  read_out_->setAccessibleName(translated("Values under the pointer"));
  read_out_->setReadOnly(true);
  read_out_->setFrame(false);
  read_out_->setFocusPolicy(Qt::ClickFocus);
  addWidget(read_out_, 1);
  connect(this, &QStatusBar::messageChanged, this, [this](const QString& message) {
    setToolTip(message);
    message.isEmpty() ? unsetCursor() : setCursor(Qt::PointingHandCursor);
    unfold();
  });
}

void NoticeBar::tell(const QString& under_pointer) {
  if (read_out_->text() != under_pointer) {
    read_out_->setText(under_pointer);
    read_out_->setCursorPosition(0);
  }
  unfold();
}

/// What the words have: all that is left of the buttons, which stand where lines end.
QRect NoticeBar::room() const {
  int left = 0;
  int right = width();
  for (const QWidget* widget : findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
    if (widget == read_out_ || !widget->isVisible()) continue;
    isRightToLeft() ? left = std::max(left, widget->geometry().right() + 1) : right = std::min(right, widget->x());
  }
  return {mapTo(window(), QPoint(left, 0)), QSize(right - left, height())};
}

void NoticeBar::unfold() {
  const bool notice = !currentMessage().isEmpty();
  unfolded_->tell(notice ? currentMessage() : read_out_->text(), room(), notice);
}

bool NoticeBar::event(QEvent* event) {
  const bool done = QStatusBar::event(event);
  const QEvent::Type type = event->type();
  if (type == QEvent::Resize || type == QEvent::LayoutRequest || type == QEvent::FontChange) unfold();
  return done;
}

void NoticeBar::mousePressEvent(QMouseEvent* event) {
  const bool on_message = !currentMessage().isEmpty() && event->button() == Qt::LeftButton;
  if (!on_message) return QStatusBar::mousePressEvent(event);
  clicked_();
}

}  // namespace sonar
