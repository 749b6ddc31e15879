// SPDX-License-Identifier: Apache-2.0
#include "gui/view_keys.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMetaObject>
#include <QPointer>
#include <QShortcutEvent>
#include <QStatusBar>
#include <QTimer>
#include <QTreeView>
#include <algorithm>

#include "gui/picture_view.h"
#include "gui/rows_view.h"
#include "gui/translated.h"
#include "session/listening.h"

namespace sonar {
namespace {

constexpr int kSaidTime_ms = 2500;
constexpr int kFromTop_px = 8;
constexpr int kTold_ms = 5000;

/// The view or table that a widget is, or lies in; its filter line is a field like any other.
QWidget* view_of(QWidget* widget) {
  if (dynamic_cast<PictureView*>(widget) != nullptr) return widget;
  if (qobject_cast<QTreeView*>(widget) == nullptr) return nullptr;
  for (QWidget* at = widget; at != nullptr; at = at->parentWidget()) {
    if (dynamic_cast<RowsView*>(at) != nullptr) return widget;
  }
  return nullptr;
}

QKeySequence sequence_of(const QKeyEvent& event) {
  return {QKeyCombination(event.modifiers() & ~Qt::KeypadModifier, static_cast<Qt::Key>(event.key()))};
}

/// A line over the upper edge of a view, for as long as one reads it; the mouse goes through it.
class SaidLabel : public QLabel {
 public:
  explicit SaidLabel(QWidget& view) : QLabel(&view) {
    setObjectName("key_said");
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAutoFillBackground(true);
    setMargin(5);
    setWordWrap(true);
    QPalette colours;
    colours.setColor(QPalette::Window, QColor(20, 24, 28));
    colours.setColor(QPalette::WindowText, Qt::white);
    setPalette(colours);
    time_.setSingleShot(true);
    QObject::connect(&time_, &QTimer::timeout, this, &QWidget::hide);
  }
  void say(const QString& text) {
    const int width = parentWidget()->width();
    setText(text);
    const int wide = std::min(std::max(1, width - 2 * margin()), fontMetrics().horizontalAdvance(text) + 4 * margin());
    setFixedSize(wide, heightForWidth(wide));
    move((width - this->width()) / 2, kFromTop_px);
    show();
    raise();
    time_.start(kSaidTime_ms);
  }

 private:
  QTimer time_;
};

class ViewKeys : public QObject {
 public:
  ViewKeys(QMainWindow& window, AppModel& app) : QObject(&window), window_(window), app_(app) {
    qApp->installEventFilter(this);
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget* before, QWidget* now) { follow(before, now); });
    listening_.to(app.key_said.changed(), [this] { say(); });
  }

 protected:
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() != QEvent::ShortcutOverride || QApplication::activeWindow() != &window_) return false;
    QWidget* focus = QApplication::focusWidget();
    if (view_of(focus) != nullptr || event->isAccepted()) return false;
    const auto& key = dynamic_cast<const QKeyEvent&>(*event);
    if (!is_single_character(sequence_of(key)) || QApplication::activePopupWidget() != nullptr) return false;
    // Typed into a field, or lost; never a shortcut of the window.
    event->accept();
    const bool typed =
        focus != nullptr && (focus->testAttribute(Qt::WA_InputMethodEnabled) || focus->inherits("QMenuBar"));
    if (!typed && acts(sequence_of(key))) {
      window_.statusBar()->showMessage(
          translated("%1 acts while a view or a table has the keyboard: click one first").arg(key.text().toUpper()),
          kTold_ms);
    }
    return true;
  }

 private:
  [[nodiscard]] bool acts(const QKeySequence& asked) const {
    const auto actions = window_.actions();
    return std::any_of(actions.begin(), actions.end(),
                       [&](const QAction* action) { return action->shortcuts().contains(asked); });
  }

  /// The keyboard goes back to a view from a field that is done with, and from what is closed: a view, the start page.
  void follow(const QWidget* before, QWidget* now) {
    if (QWidget* view = view_of(now)) last_ = view;
    if (QApplication::activeWindow() != &window_ || view_of(now) != nullptr) return;
    const bool closed = before != nullptr && !before->isVisible();
    if (now != nullptr && !closed) return;
    QMetaObject::invokeMethod(
        this, [this] { give_to_view(); }, Qt::QueuedConnection);
  }

  void give_to_view() {
    if (view_of(QApplication::focusWidget()) != nullptr) return;
    if (QWidget* view = seen_view()) view->setFocus();
  }

  /// The one that has, or had, the keyboard, where it is seen; else the first that is.
  [[nodiscard]] QWidget* seen_view() const {
    if (last_ && last_->isVisible() && !last_->visibleRegion().isEmpty()) return last_;
    for (const PictureDock& dock : app_.pictures) {
      auto* view = window_.findChild<QWidget*>(QString::fromStdString(dock.id + ".view"));
      if (view != nullptr && view->isVisible() && !view->visibleRegion().isEmpty()) return view;
    }
    return nullptr;
  }

  void say() {
    QWidget* view = seen_view();
    if (view == nullptr) return;
    if (said_.isNull() || said_->parentWidget() != view) {
      delete said_;
      said_ = new SaidLabel(*view);
    }
    said_->say(QString::fromStdString(app_.key_said.text()));
  }

  QMainWindow& window_;
  AppModel& app_;
  QPointer<QWidget> last_;
  QPointer<SaidLabel> said_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace

bool is_single_character(const QKeySequence& key) {
  if (key.count() != 1) return false;
  const auto modifiers = key[0].keyboardModifiers() & ~Qt::KeypadModifier;
  const bool plain = modifiers == Qt::NoModifier || modifiers == Qt::ShiftModifier;
  return plain && key[0].key() > Qt::Key_Space && key[0].key() < Qt::Key_Escape;
}

void add_view_keys(QMainWindow& window, AppModel& app) { new ViewKeys(window, app); }

bool KeyedAction::event(QEvent* event) {
  // Others come while it is triggered, as when a switch is set: they are no keys.
  if (event->type() != QEvent::Shortcut) return QAction::event(event);
  const QKeySequence key = dynamic_cast<QShortcutEvent&>(*event).key();
  const auto bare = key.count() == 1 ? key[0].key() : Qt::Key_unknown;
  by_key_ = is_single_character(key) || bare == Qt::Key_Return || bare == Qt::Key_Enter || bare == Qt::Key_Delete;
  const bool taken = QAction::event(event);
  by_key_ = false;
  return taken;
}

}  // namespace sonar
