// SPDX-License-Identifier: Apache-2.0
#include "gui/accessible_picture.h"

#include <QAccessible>
#include <QAccessibleWidget>

#include "gui/picture_view.h"

namespace sonar {
namespace {

class AccessiblePicture : public QAccessibleWidget {
 public:
  explicit AccessiblePicture(PictureView& view) : QAccessibleWidget(&view, QAccessible::Graphic) {}
  [[nodiscard]] QString text(QAccessible::Text kind) const override {
    // Qt keeps this until the widget is no more than a QObject.
    const auto* view = dynamic_cast<const PictureView*>(object());
    if (view != nullptr && (kind == QAccessible::Description || kind == QAccessible::Value)) return view->sentence();
    return QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* made(const QString& /*class_name*/, QObject* object) {
  auto* view = dynamic_cast<PictureView*>(object);
  return view != nullptr ? new AccessiblePicture(*view) : nullptr;
}

}  // namespace

void tell_screen_readers_of_pictures() {
  static const bool kOnce = [] {
    QAccessible::installFactory(made);
    return true;
  }();
  (void)kOnce;
}

}  // namespace sonar
