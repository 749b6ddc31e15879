// SPDX-License-Identifier: Apache-2.0
#include "gui/own_keys.h"

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMetaObject>
#include <algorithm>
#include <initializer_list>

namespace sonar {
namespace {

bool one_of(int key, std::initializer_list<Qt::Key> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

bool is_enter(int key) { return one_of(key, {Qt::Key_Return, Qt::Key_Enter}); }

bool is_field(const QObject* control) {
  return qobject_cast<const QAbstractSpinBox*>(control) != nullptr ||
         qobject_cast<const QLineEdit*>(control) != nullptr;
}

/// What lines of text take by themselves is not repeated here.
bool works_with(const QObject* control, int key) {
  const bool up_down =
      one_of(key, {Qt::Key_Up, Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown, Qt::Key_Home, Qt::Key_End});
  if (is_field(control)) return is_enter(key) || one_of(key, {Qt::Key_Left, Qt::Key_Right}) || up_down;
  if (qobject_cast<const QAbstractSlider*>(control) != nullptr) {
    return up_down || one_of(key, {Qt::Key_Left, Qt::Key_Right});
  }
  if (qobject_cast<const QComboBox*>(control) != nullptr) return up_down || key == Qt::Key_Space;
  return qobject_cast<const QAbstractButton*>(control) != nullptr && key == Qt::Key_Space;
}

class OwnKeys : public QObject {
 public:
  explicit OwnKeys(QWidget& control) : QObject(&control), control_(control) { control.installEventFilter(this); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Wheel && !control_.hasFocus()) {
      event->ignore();
      return true;
    }
    if (event->type() != QEvent::ShortcutOverride && event->type() != QEvent::KeyPress) return false;
    const auto& key = dynamic_cast<const QKeyEvent&>(*event);
    const bool plain = (key.modifiers() & ~Qt::KeypadModifier) == 0;
    if (!plain || !works_with(watched, key.key())) return false;
    if (event->type() == QEvent::ShortcutOverride) {
      event->accept();
      return true;
    }
    // After the field itself has taken what stands in it.
    if (is_enter(key.key()))
      QMetaObject::invokeMethod(
          this, [this] { control_.clearFocus(); }, Qt::QueuedConnection);
    return false;
  }

 private:
  QWidget& control_;
};

}  // namespace

void keep_own_keys(QWidget& control) {
  const bool typed = is_field(&control);
  const bool known = typed || qobject_cast<QAbstractSlider*>(&control) != nullptr ||
                     qobject_cast<QComboBox*>(&control) != nullptr ||
                     qobject_cast<QAbstractButton*>(&control) != nullptr;
  if (!known) return;
  control.setFocusPolicy(typed ? Qt::StrongFocus : Qt::TabFocus);
  new OwnKeys(control);
}

}  // namespace sonar
