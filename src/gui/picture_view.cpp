// SPDX-License-Identifier: Apache-2.0
#include "gui/picture_view.h"

#include <QAccessible>
#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QMetaObject>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <utility>
#include <vector>

#include "gui/accessible_picture.h"
#include "gui/action_menus.h"

namespace sonar {
namespace {

constexpr double kWheelUnitsPerStep = 120.0;  // Qt's eighths of a degree, fifteen degrees a notch
constexpr double kCrossArm_px = 7.0;
constexpr double kFocus_px = 2.0;
constexpr double kLeastPinch = 0.1;  // of one event: a pinch never turns the picture inside out

PointerButton button_of(Qt::MouseButtons buttons) {
  if ((buttons & Qt::LeftButton) != 0) return PointerButton::left;
  if ((buttons & Qt::MiddleButton) != 0) return PointerButton::middle;
  return (buttons & Qt::RightButton) != 0 ? PointerButton::right : PointerButton::none;
}

PointerEvent with_keys(PointerEvent event, Qt::KeyboardModifiers keys) {
  event.shift = (keys & Qt::ShiftModifier) != 0;
  event.control = (keys & Qt::ControlModifier) != 0;
  event.alt = (keys & Qt::AltModifier) != 0;
  return event;
}

void draw_twice(QPainter& painter, const QPainterPath& path) {
  // A dark line in a light one is seen on every colour.
  painter.setPen(QPen(QColor(0, 0, 0, 160), 3.0));
  painter.drawPath(path);
  painter.setPen(QPen(QColor(255, 255, 255, 230), 1.0));
  painter.drawPath(path);
}

void draw_muted(QPainter& painter, const QPainterPath& path) {
  painter.setPen(QPen(QColor(0, 0, 0, 90), 2.0));
  painter.drawPath(path);
  painter.setPen(QPen(QColor(255, 255, 255, 170), 1.0));
  painter.drawPath(path);
}

/// The same with the light line broken.
void draw_dashed(QPainter& painter, const QPainterPath& path) {
  painter.setPen(QPen(QColor(0, 0, 0, 160), 3.0));
  painter.drawPath(path);
  QPen dashes(QColor(255, 255, 255, 230), 1.0);
  dashes.setDashPattern({5.0, 4.0});
  painter.setPen(dashes);
  painter.drawPath(path);
}

/// To the right of a rectangle, else to its left, below or above it: the first place with room; else as near as can be.
QRectF beside(const QRectF& what, const QSizeF& size, const QRectF& view) {
  constexpr double kGap_px = 8.0;
  const QPointF corners[] = {{what.right() + kGap_px, what.top()},
                             {what.left() - kGap_px - size.width(), what.top()},
                             {what.left(), what.bottom() + kGap_px},
                             {what.left(), what.top() - kGap_px - size.height()}};
  const auto within = [&](QPointF at) {
    at.setX(std::clamp(at.x(), view.left(), std::max(view.left(), view.right() - size.width())));
    at.setY(std::clamp(at.y(), view.top(), std::max(view.top(), view.bottom() - size.height())));
    return QRectF(at, size);
  };
  for (const QPointF& corner : corners) {
    const QRectF placed = within(corner);
    if (!placed.intersects(what.adjusted(-1, -1, 1, 1))) return placed;
  }
  return within(corners[0]);
}

/// Figures of what was measured, light on dark whatever lies below them.
void draw_figures(QPainter& painter, const QRectF& what, const QRectF& view, const QString& text) {
  constexpr int kMargin_px = 4;
  const QRect words = painter.fontMetrics().boundingRect(QRect(0, 0, 4096, 4096), Qt::AlignLeft, text);
  const QRectF box = beside(what, words.size() + QSize(2 * kMargin_px, 2 * kMargin_px), view);
  painter.fillRect(box, QColor(0, 0, 0, 190));
  painter.setPen(Qt::white);
  painter.drawText(box.adjusted(kMargin_px, kMargin_px, 0, 0), Qt::AlignLeft, text);
}

/// A line in the lower left corner, light on dark whatever lies below it.
void draw_on_seabed(QPainter& painter, const QRect& view, const QString& text) {
  constexpr int kMargin_px = 4;
  const QRect words = painter.fontMetrics().boundingRect(text);
  const QRect box(view.left() + kMargin_px, view.bottom() - words.height() - 3 * kMargin_px,
                  words.width() + 2 * kMargin_px, words.height() + 2 * kMargin_px);
  painter.fillRect(box, QColor(0, 0, 0, 200));
  painter.setPen(Qt::white);
  painter.drawText(box, Qt::AlignCenter, text);
}

/// In the window's units.
QPainterPath path_of(const Overlay& overlay, double scale) {
  QPainterPath path;
  for (std::size_t i = 0; i < overlay.line.size(); ++i) {
    const QPointF at(overlay.line[i].x / scale, overlay.line[i].y / scale);
    i == 0 ? path.moveTo(at) : path.lineTo(at);
  }
  if (overlay.cross) {
    const double x = overlay.cross->x / scale;
    const double y = overlay.cross->y / scale;
    path.moveTo(x - kCrossArm_px, y);
    path.lineTo(x + kCrossArm_px, y);
    path.moveTo(x, y - kCrossArm_px);
    path.lineTo(x, y + kCrossArm_px);
  }
  if (overlay.circle_at) {
    const double radius = overlay.circle_px / scale;
    path.addEllipse(QPointF(overlay.circle_at->x / scale, overlay.circle_at->y / scale), radius, radius);
  }
  return path;
}

}  // namespace

void PictureView::draw_overlays(QPainter& painter) {
  const double scale = picture_.scale();
  const auto in_units = [scale](const PixelRect& r) {
    return QRectF(r.x / scale, r.y / scale, r.width / scale, r.height / scale);
  };
  const std::vector<Overlay> overlays = picture_.overlays();
  for (const Overlay& overlay : overlays) {
    if (overlay.clip) painter.setClipRect(in_units(*overlay.clip));
    const QPainterPath path = path_of(overlay, scale);
    const auto draw = overlay.muted ? draw_muted : overlay.dashed ? draw_dashed : draw_twice;
    draw(painter, path);
    painter.setClipping(false);
  }
  for (const Overlay& overlay : overlays) {
    if (overlay.text.empty()) continue;
    const QRectF view = overlay.clip ? in_units(*overlay.clip) : QRectF(rect());
    draw_figures(painter, in_units(overlay.beside), view, QString::fromStdString(overlay.text));
  }
}

PictureView::PictureView(LivePicture& picture, Shared<bool>& latencies, QWidget* parent)
    : QWidget(parent), picture_(picture), latencies_(latencies), listening_(picture.changed(), [this] {
        show_shape();
        update();
        tell_screen_reader();
      }) {
  tell_screen_readers_of_pictures();
  listening_.to(latencies.changed(), [this] { update(); });
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

PictureView::~PictureView() { picture_.set_seen(false); }

void PictureView::paintEvent(QPaintEvent* /*event*/) {
  // What is painted is seen. A tab behind another counts as shown, somewhere off the window, and is never painted.
  picture_.set_seen(true);
  show_size();  // the window may have come to another screen
  QPainter painter(this);
  const Image& image = picture_.image();
  painter.fillRect(rect(), palette().color(QPalette::Base));
  if (image.size.width > 0) {
    // The image outlives the call: Qt borrows its pixels.
    const QImage shown(reinterpret_cast<const uchar*>(image.pixels.data()), image.size.width, image.size.height,
                       QImage::Format_RGBA8888);
    // Pixel for pixel: the picture was made for this screen.
    const QSizeF drawn = QSizeF(image.size.width, image.size.height) / picture_.scale();
    painter.drawImage(QRectF(QPointF(0, 0), drawn), shown);
  } else {
    painter.setPen(palette().color(QPalette::Text));
    painter.drawText(rect().adjusted(12, 12, -12, -12), Qt::AlignCenter | Qt::TextWordWrap,
                     !picture_.problem().empty() ? QString::fromStdString(picture_.problem())
                     : idle_text_                ? idle_text_()
                                                 : QString());
  }
  painter.setRenderHint(QPainter::Antialiasing);
  draw_overlays(painter);
  if (latencies_()) {
    draw_on_seabed(painter, rect(), QString::fromStdString(picture_.timing()));
  }
  draw_focus(painter);
}

/// Once a picture, not at each move of what is laid over it.
void PictureView::tell_screen_reader() {
  if (std::exchange(told_, picture_.pictures()) == picture_.pictures() || !QAccessible::isActive()) return;
  QAccessibleEvent changed(this, QAccessible::DescriptionChanged);
  QAccessible::updateAccessibility(&changed);
}

/// Where the keyboard is, once keys have brought it there: a click needs no frame.
void PictureView::draw_focus(QPainter& painter) {
  if (!hasFocus() || !window()->testAttribute(Qt::WA_KeyboardFocusChange)) return;
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(palette().color(QPalette::Highlight), kFocus_px));
  painter.drawRect(QRectF(rect()).adjusted(kFocus_px / 2, kFocus_px / 2, -kFocus_px / 2, -kFocus_px / 2));
}

void PictureView::show_shape() {
  const bool cross = picture_.pointer_shape() == PointerShape::cross;
  const Qt::CursorShape shape = cross ? Qt::CrossCursor : Qt::ArrowCursor;
  if (cursor().shape() != shape) setCursor(shape);
}

void PictureView::show_size() { picture_.resize({width(), height()}, devicePixelRatioF()); }

PixelPoint PictureView::pixel_at(QPointF at) const { return {at.x() * picture_.scale(), at.y() * picture_.scale()}; }

void PictureView::resizeEvent(QResizeEvent* /*event*/) { show_size(); }

void PictureView::showEvent(QShowEvent* /*event*/) { show_size(); }

void PictureView::set_uncovered(bool uncovered) {
  if (!uncovered) picture_.set_seen(false);
  update();
}

void PictureView::hideEvent(QHideEvent* /*event*/) { picture_.set_seen(false); }

void PictureView::forward(QMouseEvent* event, PointerAction action) {
  const bool moving = action == PointerAction::move;
  const Qt::MouseButtons buttons = moving ? event->buttons() : Qt::MouseButtons(event->button());
  picture_.pointer(with_keys({action, button_of(buttons), pixel_at(event->position())}, event->modifiers()));
}

void PictureView::mouseMoveEvent(QMouseEvent* event) { forward(event, PointerAction::move); }
void PictureView::mousePressEvent(QMouseEvent* event) { forward(event, PointerAction::press); }
void PictureView::mouseReleaseEvent(QMouseEvent* event) { forward(event, PointerAction::release); }
void PictureView::mouseDoubleClickEvent(QMouseEvent* event) { forward(event, PointerAction::double_press); }

namespace {

/// Two fingers, not a wheel: under X11 some wheels have pixels too.
bool by_fingers(const QWheelEvent& event) {
  const bool touch = event.device() != nullptr && event.device()->type() == QInputDevice::DeviceType::TouchPad;
  return !event.pixelDelta().isNull() && (event.phase() != Qt::NoScrollPhase || touch);
}

}  // namespace

void PictureView::wheelEvent(QWheelEvent* event) {
  if (event->pixelDelta().isNull() && event->angleDelta().isNull()) return;  // fingers put down or lifted
  const bool keys = (event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier)) != 0;
  if (by_fingers(*event) && !keys && picture_.pans()) {
    PointerEvent pan{PointerAction::pan, PointerButton::none, pixel_at(event->position())};
    pan.by = pixel_at(event->pixelDelta());
    return picture_.pointer(with_keys(pan, event->modifiers()));
  }
  PointerEvent wheel{PointerAction::wheel, PointerButton::none, pixel_at(event->position())};
  wheel.wheel_steps = event->angleDelta().y() / kWheelUnitsPerStep;
  picture_.pointer(with_keys(wheel, event->modifiers()));
}

void PictureView::leaveEvent(QEvent* /*event*/) {
  // An open menu is about what is pointed at.
  if (!menu_open_) picture_.pointer({PointerAction::leave, PointerButton::none, {}});
}

void PictureView::set_menu(QMenu* menu) {
  menu_ = menu;
  connect(menu, &QMenu::aboutToHide, this, [this] {
    // After what was chosen has been done.
    QMetaObject::invokeMethod(
        this,
        [this] {
          menu_open_ = false;
          if (!underMouse()) leaveEvent(nullptr);
        },
        Qt::QueuedConnection);
  });
}

void PictureView::contextMenuEvent(QContextMenuEvent* event) {
  if (menu_ == nullptr) return;
  const bool by_mouse = event->reason() == QContextMenuEvent::Mouse;
  menu_->setProperty(kBesideSchools, by_mouse && !picture_.aim(pixel_at(event->pos())));
  menu_open_ = true;
  menu_->popup(event->globalPos());
}

/// A pinch: what lies between the fingers stays there.
void PictureView::pinch(const QNativeGestureEvent& event) {
  PointerEvent zoom{PointerAction::zoom, PointerButton::none, pixel_at(event.position())};
  zoom.factor = std::max(kLeastPinch, 1.0 + event.value());
  picture_.pointer(with_keys(zoom, event.modifiers()));
}

bool PictureView::event(QEvent* event) {
  const auto* gesture = event->type() == QEvent::NativeGesture ? dynamic_cast<QNativeGestureEvent*>(event) : nullptr;
  if (gesture != nullptr && gesture->gestureType() == Qt::ZoomNativeGesture) return pinch(*gesture), true;
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = dynamic_cast<QHelpEvent*>(event);
  const std::string hint = help == nullptr ? std::string{} : picture_.hint(pixel_at(help->pos()));
  if (hint.empty()) {
    QToolTip::hideText();
  } else {
    QToolTip::showText(help->globalPos(), QString::fromStdString(hint), this);
  }
  return true;
}

}  // namespace sonar
