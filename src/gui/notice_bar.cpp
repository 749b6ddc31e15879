// SPDX-License-Identifier: Apache-2.0
#include "gui/notice_bar.h"

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

/// All the words, over what is above their line. It takes no click: what lies below does.
class Unfolded : public QWidget {
 public:
  explicit Unfolded(QWidget* window) : QWidget(window) {
    setObjectName("unfolded");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAutoFillBackground(true);
    hide();
  }

  /// @param line where they stand as far as they have room.
  void tell(const QString& words, const QRect& line) {
    lay_out(words, line.width() - 2 * kMargin_px);
    const int height = above() + static_cast<int>(std::ceil(layout_.boundingRect().height()));
    const bool cut = !words.isEmpty() && height > line.height();
    if (cut) {
      setGeometry(line.x(), line.y() + line.height() - height, line.width(), height);
      raise();
      update();
    }
    setVisible(cut);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setPen(palette().mid().color());
    painter.drawLine(0, 0, width(), 0);
    painter.setPen(palette().windowText().color());
    layout_.draw(&painter, QPointF(kMargin_px, above() / 2));
  }

 private:
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
};

}  // namespace

NoticeBar::NoticeBar(QWidget* window, std::function<void()> clicked)
    : QStatusBar(window),
      clicked_(std::move(clicked)),
      read_out_(new QLineEdit(this)),
      unfolded_(new Unfolded(window)) {
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
  if (read_out_->text() == under_pointer) return;
  read_out_->setText(under_pointer);
  read_out_->setCursorPosition(0);
  unfold();
}

/// What the words have: all that is left of the buttons.
QRect NoticeBar::room() const {
  int right = width();
  for (const QWidget* widget : findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
    if (widget != read_out_ && widget->isVisible()) right = std::min(right, widget->x());
  }
  return {mapTo(window(), QPoint(0, 0)), QSize(right, height())};
}

void NoticeBar::unfold() {
  const QString notice = currentMessage();
  static_cast<Unfolded*>(unfolded_)->tell(notice.isEmpty() ? read_out_->text() : notice, room());
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
