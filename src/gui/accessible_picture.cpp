// SPDX-License-Identifier: Apache-2.0
#include "gui/accessible_picture.h"

#include <QAccessible>
#include <QAccessibleWidget>

#include "gui/picture_view.h"

namespace sonar {
namespace {

class AccessiblePicture : public QAccessibleWidget {
 public:
  explicit AccessiblePicture(PictureView& view) : QAccessibleWidget(&view, QAccessible::Graphic), view_(view) {}
  [[nodiscard]] QString text(QAccessible::Text kind) const override {
    if (kind == QAccessible::Description || kind == QAccessible::Value) return view_.sentence();
    return QAccessibleWidget::text(kind);
  }

 private:
  PictureView& view_;
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
