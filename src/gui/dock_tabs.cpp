// SPDX-License-Identifier: Apache-2.0
#include "gui/dock_tabs.h"

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QFocusEvent>
#include <QMetaObject>
#include <QPointer>
#include <QTabBar>

#include "gui/translated.h"

namespace sonar {
namespace {

/// A window makes a bar of tabs when docks come together, and has it cut their words down to "Sc...".
void show_whole_words(QTabBar& bar) {
  bar.setElideMode(Qt::ElideNone);
  bar.setUsesScrollButtons(true);
  bar.setAccessibleName(translated("Panels that share this place"));
}

QDockWidget* dock_of(QWidget* widget) {
  while (widget != nullptr && qobject_cast<QDockWidget*>(widget) == nullptr) widget = widget->parentWidget();
  return qobject_cast<QDockWidget*>(widget);
}

class DockTabs : public QObject {
 public:
  explicit DockTabs(QMainWindow& window) : QObject(&window), window_(window) {
    for (auto* bar : window.findChildren<QTabBar*>(Qt::FindDirectChildrenOnly)) show_whole_words(*bar);
    qApp->installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (watched == &window_ && event->type() == QEvent::ChildPolished) {
      if (auto* bar = qobject_cast<QTabBar*>(dynamic_cast<QChildEvent&>(*event).child())) show_whole_words(*bar);
    }
    if (event->type() == QEvent::FocusIn) bring_in_front(watched, dynamic_cast<QFocusEvent&>(*event).reason());
    return false;
  }

 private:
  /// Behind another dock a widget counts as shown: Tab goes there, and nobody would see where.
  void bring_in_front(QObject* focused, Qt::FocusReason reason) {
    if (reason != Qt::TabFocusReason && reason != Qt::BacktabFocusReason) return;
    QDockWidget* dock = dock_of(qobject_cast<QWidget*>(focused));
    if (dock == nullptr || dock->parentWidget() != &window_ || !dock->visibleRegion().isEmpty()) return;
    QMetaObject::invokeMethod(
        this,
        [dock = QPointer<QDockWidget>(dock)] {
          if (dock) dock->raise();
        },
        Qt::QueuedConnection);
  }

  QMainWindow& window_;
};

}  // namespace

void keep_dock_tabs(QMainWindow& window) { new DockTabs(window); }

}  // namespace sonar
