// SPDX-License-Identifier: Apache-2.0
#include "gui/live_strip.h"

#include <QLabel>
#include <QToolBar>

#include "gui/listening_of.h"
#include "gui/translated.h"
#include "session/live/live_watch.h"

namespace sonar {

void add_live_strip(QMainWindow& window, AppModel& app) {
  auto* strip = new QToolBar(translated("Recording"), &window);
  strip->setObjectName("live");
  strip->setMovable(false);
  auto* text = new QLabel(strip);
  text->setObjectName("live_text");
  text->setTextFormat(Qt::RichText);
  strip->addWidget(text);
  window.addToolBar(Qt::BottomToolBarArea, strip);
  const auto show = [strip, text, live = app.live] {
    strip->setVisible(live->on());
    if (!live->on()) return;
    const QString line = QString::fromStdString(live->text()).toHtmlEscaped();
    const QString head =
        live->at_newest() ? translated("<b>LIVE</b>") : translated("LIVE, looking back (L: newest ping)");
    text->setText(head + "&nbsp;&nbsp; " + line);
  };
  show();
  listening_of(*strip).to(app.live->changed(), show);
  // A layout that is put back knows nothing of what is followed now.
  QObject::connect(strip, &QToolBar::visibilityChanged, strip, [strip, live = app.live] {
    if (strip->isHidden() == live->on()) strip->setVisible(live->on());
  });
}

}  // namespace sonar
