// SPDX-License-Identifier: Apache-2.0
#include "gui/status_line.h"

#include <QApplication>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>
#include <QTimer>
#include <algorithm>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "gui/listening_of.h"
#include "gui/notice_bar.h"
#include "gui/own_keys.h"
#include "gui/translated.h"
#include "session/live/live_watch.h"
#include "session/review/beyond_reach.h"
#include "session/review/merge_offer.h"
#include "session/tools/measure_tool.h"

namespace sonar {
namespace {

constexpr int kNoticeTime_ms = 15000;
constexpr int kNoticeAtLeast_ms = 4000;  // then a pointer that moves has its read-out back
constexpr int kMargin_px = 4;
constexpr int kProgressWidth_px = 260;

QString text_at_cursor(const Workspace& workspace) {
  const auto& cursor = workspace.cursor();
  std::string line = cursor ? read_out(workspace, *cursor).line() : std::string{};
  const std::string& preview = workspace.preview().text;
  if (!preview.empty()) line += (line.empty() ? "" : "  |  ") + preview;
  if (const std::string measured = measured_text(workspace); !measured.empty()) {
    // Whoever measures wants to see all of it, however narrow the window is.
    const bool first = workspace.tool() == ToolName::measure;
    line = line.empty() ? measured : first ? measured + "  |  " + line : line + "  |  " + measured;
  }
  return QString::fromStdString(line);
}

/// The status bar's own background: a style sheet would keep the colours of the theme it was set under.
void clear_background(QLineEdit& line) {
  QPalette palette;
  palette.setColor(QPalette::Base, QApplication::palette().color(QPalette::Window));
  palette.setColor(QPalette::Text, QApplication::palette().color(QPalette::WindowText));
  line.setPalette(palette);
}

void show_progress(QProgressBar& bar, QPushButton& cancel, const Document& document) {
  const Progress progress = document.activity();
  const bool running = !progress.stage.empty();
  bar.setVisible(running);
  if (!running) bar.setFixedWidth(kProgressWidth_px);
  cancel.setVisible(!document.progress().stage.empty() || document.busy());
  if (!running) return;
  const QString stage = QString::fromStdString(progress.stage);
  bar.setFormat(stage + " %p %");
  bar.setToolTip(stage);
  // As wide as its words; no narrower while the work goes on, for what counts must not make it tremble.
  const int words = std::max(bar.width(), bar.fontMetrics().horizontalAdvance(stage + " 100 %  "));
  bar.setFixedWidth(std::clamp(words, kProgressWidth_px, std::max(kProgressWidth_px, bar.window()->width() / 2)));
  bar.setRange(0, static_cast<int>(progress.total));
  bar.setValue(static_cast<int>(progress.done));
}

/// What waits for a human to go on: a button that is there as long as it does.
void add_offer(QStatusBar& status, AppModel& app, std::string_view id, const char* name, std::function<bool()> waits) {
  const Action action = *app.actions.find(id);
  auto* button = new QPushButton(translated(action.text), &status);
  button->setObjectName(name);
  button->setToolTip(translated(action.tip));
  keep_own_keys(*button);
  // A click leaves the keyboard with the view: what follows is decided by letters.
  button->setFocusPolicy(Qt::TabFocus);
  status.addPermanentWidget(button);
  const auto show = [button, waits = std::move(waits), now = action.text_now] {
    const std::string text = now ? now() : std::string{};
    if (!text.empty()) button->setText(QString::fromStdString(text));
    button->setVisible(waits());
  };
  show();
  QObject::connect(button, &QPushButton::clicked, &status, [action] {
    if (!action.enabled || action.enabled()) action.run();
  });
  Listening& listening = listening_of(*button);
  listening.to(app.workspace.school.changed(), show);
  listening.to(app.merge_offer->changed(), show);
  listening.to(app.workspace.document.changes(), [show](DocumentChange change) {
    const bool may_matter =
        change == DocumentChange::state || change == DocumentChange::observation || change == DocumentChange::progress;
    if (may_matter) show();
  });
}

/// Where the notices before the last one stand.
void show_diagnostics(const QMainWindow& window) {
  auto* dock = window.findChild<QDockWidget*>("diagnostics");
  if (dock == nullptr) return;
  dock->show();
  dock->raise();
}

}  // namespace

void add_status_line(QMainWindow& window, AppModel& app) {
  Workspace& workspace = app.workspace;
  auto* status = new NoticeBar(&window, [&window] { show_diagnostics(window); });
  window.setStatusBar(status);
  QLineEdit* cursor = &status->read_out();
  auto* bar = new QProgressBar(status);
  bar->setAccessibleName(translated("Progress"));
  bar->setFixedWidth(kProgressWidth_px);
  auto* cancel = new QPushButton(translated("Cancel"), status);
  cancel->setFlat(true);
  keep_own_keys(*cancel);
  // A school that was carried as far as its reach; two schools that may be one; an observation in which nobody has detected schools or marked any.
  add_offer(*status, app, kContinueAction, "continue", app.actions.find(kContinueAction)->enabled);
  add_offer(*status, app, kMergeProposedAction, "merge", app.actions.find(kMergeProposedAction)->enabled);
  add_offer(*status, app, "schools.detect", "detect", [&document = workspace.document, &live = *app.live] {
    const auto& shown = document.shown();
    return shown && !document.detected(shown->index()) && document.state().schools.empty() &&
           document.progress().stage.empty() && !live.on();
  });
  status->addPermanentWidget(bar);
  status->addPermanentWidget(cancel);
  // What comes and goes must not push the views about.
  status->setFixedHeight(
      std::max({status->sizeHint().height(), bar->sizeHint().height(), cancel->sizeHint().height()}) + kMargin_px);
  show_progress(*bar, *cancel, workspace.document);
  QObject::connect(cancel, &QPushButton::clicked, status, [&workspace] {
    Document& document = workspace.document;
    document.progress().stage.empty() ? document.stop_propagation() : document.cancel();
  });
  const auto told = std::make_shared<QElapsedTimer>();
  const auto read = [status, told, &workspace] {
    if (told->isValid() && told->hasExpired(kNoticeAtLeast_ms)) {
      told->invalidate();
      status->clearMessage();
    }
    status->tell(text_at_cursor(workspace));
  };
  Listening& listening = listening_of(*status);
  listening.to(workspace.cursor.changed(), read);
  // After the window has taken the theme, at first too.
  const auto clear = [cursor] { QTimer::singleShot(0, cursor, [cursor] { clear_background(*cursor); }); };
  listening.to(workspace.dark.changed(), clear);
  clear();
  listening.to(workspace.preview.changed(), read);
  listening.to(workspace.units.changed(), read);
  listening.to(workspace.measurement.changed(), read);
  listening.to(workspace.document.changes(), [read, status, told, bar, cancel, &workspace](DocumentChange change) {
    if (change == DocumentChange::ping || change == DocumentChange::state) read();
    if (change == DocumentChange::progress) show_progress(*bar, *cancel, workspace.document);
    if (change == DocumentChange::notice) {
      status->showMessage(QString::fromStdString(workspace.document.notices().back()), kNoticeTime_ms);
      told->start();
    }
  });
}

}  // namespace sonar
