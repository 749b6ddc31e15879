// SPDX-License-Identifier: Apache-2.0
#include "gui/tool_bar.h"

#include <QAction>
#include <QApplication>
#include <QIcon>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QStyle>
#include <QTimer>
#include <QToolBar>
#include <array>
#include <string_view>
#include <utility>

#include "gui/action_menus.h"
#include "gui/listening_of.h"
#include "gui/translated.h"
#include "session/playing/playback.h"

namespace sonar {
namespace {

constexpr int kIcon_px = 16;
constexpr float kGreyed = 0.4F;

struct Button {
  const char* id = "";                                  ///< empty = a separator
  QStyle::StandardPixmap icon = QStyle::SP_CustomBase;  ///< SP_CustomBase: the action's text
};

constexpr std::array<Button, 23> kButtons{{{"file.open_folder", QStyle::SP_DirOpenIcon},
                                           {""},
                                           {"edit.undo", QStyle::SP_ArrowBack},
                                           {"edit.redo", QStyle::SP_ArrowForward},
                                           {""},
                                           {"ping.first", QStyle::SP_MediaSkipBackward},
                                           {"ping.previous", QStyle::SP_MediaSeekBackward},
                                           {"ping.play", QStyle::SP_MediaPlay},
                                           {"ping.next", QStyle::SP_MediaSeekForward},
                                           {"ping.last", QStyle::SP_MediaSkipForward},
                                           {""},
                                           {"tool.seed"},
                                           {"tool.brush"},
                                           {"tool.eraser"},
                                           {"tool.measure"},
                                           {""},
                                           {"schools.detect"},
                                           {"school.propagate"},
                                           {"school.stop", QStyle::SP_MediaStop},
                                           {""},
                                           {"review.next"},
                                           {"review.accept", QStyle::SP_DialogApplyButton},
                                           {"review.reject", QStyle::SP_DialogCancelButton}}};

/// In the colours of text, and of text that is greyed.
QIcon tinted(const QIcon& icon) {
  QIcon both;
  for (const auto& [mode, group] :
       {std::pair(QIcon::Normal, QPalette::Active), {QIcon::Disabled, QPalette::Disabled}}) {
    QPixmap shape = icon.pixmap(QSize(kIcon_px, kIcon_px));
    QPainter painter(&shape);
    painter.setCompositionMode(QPainter::CompositionMode_SourceIn);
    QColor colour = QApplication::palette().color(group, QPalette::ButtonText);
    if (mode == QIcon::Disabled) colour.setAlphaF(kGreyed);  // a filled shape looks darker than a word
    painter.fillRect(shape.rect(), colour);
    painter.end();
    both.addPixmap(shape, mode);
  }
  return both;
}

/// Greys the buttons that cannot act now. Their actions stay alive: a greyed action's key is dead.
void grey_buttons(const QMainWindow& window, QToolBar& bar, const Actions& actions) {
  for (const Button& button : kButtons) {
    QAction* shown = *button.id == '\0' ? nullptr : find_action(window, button.id);
    QWidget* widget = shown == nullptr ? nullptr : bar.widgetForAction(shown);
    const Action* action = actions.find(button.id);
    if (widget != nullptr && action != nullptr) widget->setEnabled(!action->enabled || action->enabled());
  }
}

void follow(QMainWindow& window, QToolBar& bar, AppModel& app) {
  auto* soon = new QTimer(&bar);  // once for all changes of a turn
  soon->setSingleShot(true);
  QObject::connect(soon, &QTimer::timeout, &bar, [&window, &bar, &app] { grey_buttons(window, bar, app.actions); });
  const auto later = [soon] { soon->start(0); };
  Listening& listening = listening_of(*soon);
  listening.to(app.workspace.document.changes(), [later](DocumentChange) { later(); });
  listening.to(app.workspace.school.changed(), later);
  listening.to(app.workspace.mark.changed(), later);
  for (const Button& button : kButtons) {
    QAction* shown = *button.id == '\0' ? nullptr : find_action(window, button.id);
    // A button takes over what its action tells of itself, also that it can act.
    if (shown != nullptr) QObject::connect(shown, &QAction::changed, soon, later);
  }
  grey_buttons(window, bar, app.actions);
}

/// How fast it plays, beside the buttons that play.
void add_rate(QToolBar& bar, Playback& playback) {
  auto* rate = new QLabel(&bar);
  rate->setObjectName("play_rate");
  rate->setToolTip(translated("Speed of playing, and what is reached; + and - change it"));
  // What it says while it plays must not push the buttons behind it about.
  rate->setMinimumWidth(rate->fontMetrics().horizontalAdvance("20 pings/s, 19.9 reached"));
  rate->setAlignment(Qt::AlignCenter);
  bar.addWidget(rate);
  const auto show = [rate, &playback] {
    const QString text = QString::fromStdString(playback.rate_text());
    if (text != rate->text()) rate->setText(text);
  };
  listening_of(*rate).to(playback.changed(), show);
  show();
}

}  // namespace

void add_tool_bar(QMainWindow& window, AppModel& app) {
  auto* bar = window.addToolBar(translated("Tools"));
  bar->setObjectName("tools");
  bar->setIconSize({kIcon_px, kIcon_px});
  for (const Button& button : kButtons) {
    if (*button.id == '\0') {
      bar->addSeparator();
      continue;
    }
    QAction* action = find_action(window, button.id);
    if (action == nullptr) continue;
    bar->addAction(action);
    if (std::string_view(button.id) == "ping.last") add_rate(*bar, *app.playback);
  }
  tint_tool_bar(window);
  follow(window, *bar, app);
}

void tint_tool_bar(QMainWindow& window) {
  for (const Button& button : kButtons) {
    QAction* action = *button.id == '\0' ? nullptr : find_action(window, button.id);
    if (action == nullptr || button.icon == QStyle::SP_CustomBase) continue;
    const QIcon icon = window.style()->standardIcon(button.icon);
    const bool black = button.icon >= QStyle::SP_MediaPlay && button.icon <= QStyle::SP_MediaSeekBackward;
    action->setIcon(black ? tinted(icon) : icon);
  }
}

}  // namespace sonar
