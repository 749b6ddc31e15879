// SPDX-License-Identifier: Apache-2.0
#include "gui/preferences_dialog.h"

#include <QApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QKeyEvent>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/key_page.h"
#include "gui/panel_section.h"
#include "gui/translated.h"
#include "session/words/window_preferences.h"

namespace sonar {
namespace {

class PreferencesDialog : public QDialog {
 public:
  PreferencesDialog(QWidget& window, AppModel& app) : QDialog(&window) {
    setObjectName("preferences");
    setWindowTitle(translated("Preferences"));
    resize(640, 520);
    auto* column = new QVBoxLayout(this);
    auto* pages = new QTabWidget(this);
    pages->setObjectName("pages");
    for (const PanelSection& section : preference_pages(app)) add_page(*pages, section);
    pages->addTab(new KeyPage(app.actions, pages), translated("Keys"));
    pages->tabBar()->setAccessibleName(translated("Pages of preferences"));
    column->addWidget(pages, 1);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    QObject::connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    QObject::connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    column->addWidget(buttons);
  }

 protected:
  /// Enter ends the typing of a number, not the dialog.
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) QDialog::keyPressEvent(event);
  }

 private:
  static void add_page(QTabWidget& pages, const PanelSection& section) {
    auto* scroll = new QScrollArea(&pages);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    auto* inside = new QWidget(scroll);
    auto* column = new QVBoxLayout(inside);
    column->addWidget(panel_section(section, inside));
    column->addStretch(1);
    scroll->setWidget(inside);
    // As wide as what stands in it: it scrolls up and down alone.
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(inside->minimumSizeHint().width() + scroll->verticalScrollBar()->sizeHint().width());
    pages.addTab(scroll, translated(section.title));
    scroll->setAccessibleName(translated(section.title));
  }
};

}  // namespace

bool ask_preferences(QWidget& window, AppModel& app) {
  return PreferencesDialog(window, app).exec() == QDialog::Accepted;
}

void take_text_size(double percent) {
  constexpr double kLeast_pt = 9.0;
  constexpr int kLeast_px = 12;  // of 96 an inch
  static const QFont kUsual = QApplication::font();
  QFont font = QApplication::font();
  // A font has its size in points or in pixels.
  if (kUsual.pixelSize() > 0) {
    font.setPixelSize(std::max(kLeast_px, static_cast<int>(std::lround(kUsual.pixelSize() * percent / 100.0))));
  } else {
    font.setPointSizeF(std::max(kLeast_pt, kUsual.pointSizeF() * percent / 100.0));
  }
  if (font != QApplication::font()) QApplication::setFont(font);
}

}  // namespace sonar
