// SPDX-License-Identifier: Apache-2.0
#include "gui/main_window.h"
#include "gui/live_strip.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QLayout>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QScreen>

#include "gui/about.h"
#include "gui/action_menus.h"
#include "gui/animation_timer.h"
#include "gui/batch_window.h"
#include "gui/biomass_window.h"
#include "gui/control_panel_view.h"
#include "gui/default_layout.h"
#include "gui/dock_tabs.h"
#include "gui/dropped_paths.h"
#include "gui/figure_dialog.h"
#include "gui/integration_window.h"
#include "gui/key_sheet.h"
#include "gui/listening_of.h"
#include "gui/palette.h"
#include "gui/picture_view.h"
#include "gui/preferences_dialog.h"
#include "gui/questions.h"
#include "gui/rows_view.h"
#include "gui/setup_dialogs.h"
#include "gui/start_page.h"
#include "gui/status_line.h"
#include "gui/tool_bar.h"
#include "gui/translated.h"
#include "gui/view_keys.h"
#include "session/app_parts.h"
#include "session/pictures/picture_sentence.h"

namespace sonar {
namespace {

constexpr QSize kLeastSize{1280, 800};
constexpr QSize kMostSize{3840, 2160};
constexpr int kLayoutVersion = 4;  // raised when docks come or go

QDockWidget* add_dock(QMainWindow& window, const std::string& id, const std::string& title, QWidget* inside) {
  auto* dock = new QDockWidget(translated(title), &window);
  dock->setObjectName(QString::fromStdString(id));
  inside->setObjectName(QString::fromStdString(id + ".view"));
  inside->setAccessibleName(dock->windowTitle());
  dock->setWidget(inside);
  window.addDockWidget(Qt::TopDockWidgetArea, dock);
  return dock;
}

/// A list in its dock. Its title has what the list counts, also behind a tab.
void add_list(QMainWindow& window, RowsDock& list) {
  auto* view = new RowsView(*list.rows, list.tree);
  QDockWidget* dock = add_dock(window, list.id, list.title, view);
  view->set_title(translated(list.title));
  QObject::connect(dock, &QDockWidget::visibilityChanged, view, [view](bool in_front) {
    if (!in_front) view->let_go();
  });
  listening_of(*dock).to(list.rows->changed(), [dock, &list] {
    const std::string note = list.rows->note();
    dock->setWindowTitle(translated(list.title) + QString::fromStdString(note.empty() ? "" : ": " + note));
  });
}

/// Every dock can be had back from the menu bar, not only by who knows that titles have a menu.
void add_panels_menu(QMainWindow& window) {
  QMenu* panels = window.createPopupMenu();
  panels->setObjectName("panels");
  panels->setTitle(translated("&Panels"));
  for (QAction* one : window.menuBar()->actions()) {
    if (one->objectName() == "&View") one->menu()->insertMenu(find_action(window, "view.dark"), panels);
  }
  for (auto* dock : window.findChildren<QDockWidget*>()) {
    QObject::connect(dock->toggleViewAction(), &QAction::triggered, dock, [dock](bool on) {
      if (on) dock->raise();  // not behind another tab
    });
  }
}

template <class View>
View& view_of(const QMainWindow& window, const std::string& id) {
  return dynamic_cast<View&>(*window.findChild<QDockWidget*>(QString::fromStdString(id))->widget());
}

}  // namespace

QSize first_size(const QSize& available) {
  return (available * 9 / 10).boundedTo(kMostSize).expandedTo(kLeastSize).boundedTo(available);
}

MainWindow::MainWindow(AppModel& app, std::optional<QSize> at_first) : app_(app), animations_(app.animations) {
  setObjectName("main");
  setWindowTitle("Sonar Explorer");
  setDockOptions(AllowNestedDocks | AllowTabbedDocks);  // not animated: each step of the way would be drawn anew
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  setAcceptDrops(true);
  // Without a middle, Qt shares the room anew at each layout, and docks creep: a flat one holds them.
  auto* middle = new QWidget(this);
  middle->setMaximumHeight(0);
  setCentralWidget(middle);
  for (PictureDock& dock : app.pictures) {
    auto* view = new PictureView(*dock.picture, app.workspace.latencies);
    QDockWidget* shown = add_dock(*this, dock.id, dock.title, view);
    connect(shown, &QDockWidget::visibilityChanged, view, [view](bool in_front) { view->set_uncovered(in_front); });
    if (!dock.view_switch.empty()) bind_switch(*shown, dock.view_switch);
    view->set_idle_text([&app, id = dock.id] { return QString::fromStdString(idle_text(app, id)); });
    view->set_sentence([&app, id = dock.id] { return QString::fromStdString(picture_sentence(app, id)); });
  }
  for (RowsDock& dock : app.lists) add_list(*this, dock);
  add_dock(*this, "controls", to_translate("Controls"), new ControlPanelView(*app.transfer, app.workspace, app.panel));
  add_menus(*this, app.actions);
  for (const PictureDock& dock : app.pictures) {
    view_of<PictureView>(*this, dock.id).set_menu(add_context_menu(*this, dock.id, app.actions));
  }
  for (const RowsDock& dock : app.lists) {
    view_of<RowsView>(*this, dock.id).set_menu(add_context_menu(*this, dock.id, app.actions));
  }
  add_tool_bar(*this, app);
  add_panels_menu(*this);
  add_status_line(*this, app);
  add_live_strip(*this, app);
  add_start_page(*this, app);
  add_view_keys(*this, app);
  keep_dock_tabs(*this);
  answer();
  const auto theme = [this, &app] {
    take_theme(app.workspace.dark());
    tint_tool_bar(*this);
  };
  listening_.to(app.workspace.dark.changed(), theme);
  listening_.to(app.workspace.window, [](const WindowParams& window) { take_text_size(window.text_size_percent); });
  take_text_size(app.workspace.window.values().text_size_percent);
  theme();
  listening_.to(app.workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey || change == DocumentChange::observation) show_title();
    // Where there is no picture yet, the view tells what it waits for.
    if (change == DocumentChange::progress && app_.workspace.document.survey() == nullptr) {
      if (auto* first = findChild<QWidget*>("top_slice.view")) first->update();
    }
  });
  const QScreen* on = screen();
  const QSize wanted = at_first.value_or(on == nullptr ? kLeastSize : first_size(on->availableSize()));
  resize(wanted);
  lay_out_docks(*this);
  if (size() != wanted) {
    // Until they had their places the docks stood side by side, and were wider than a small screen.
    QMainWindow::layout()->activate();
    resize(wanted);
    lay_out_docks(*this);
    QMainWindow::layout()->activate();
    resize(wanted);
  }
  // Keys belong to the picture at first, not to a line of text.
  if (auto* first = findChild<QWidget*>("top_slice.view")) first->setFocus();
}

void MainWindow::bind_switch(QDockWidget& dock, const std::string& name) {
  // Tabs hide docks too: only closing and opening is a switch.
  connect(dock.toggleViewAction(), &QAction::triggered, &dock,
          [this, name](bool on) { (void)app_.workspace.views.set(name, on); });
  listening_.to(app_.workspace.views, [this, name, &dock] {
    const auto on = app_.workspace.views.value(name);
    if (!on || dock.isHidden() != std::get<bool>(*on)) return;
    dock.setVisible(std::get<bool>(*on));
    dock.raise();  // not behind another tab
  });
  const auto on = app_.workspace.views.value(name);
  if (on && !std::get<bool>(*on)) dock.hide();
}

void MainWindow::answer() {
  app_.dialogs.preferences = [this] { return ask_preferences(*this, app_); };
  app_.dialogs.show_batch = [this] {
    if (!batch_) batch_ = std::make_unique<BatchWindow>(app_, *this);
    batch_->come_to_front();
  };
  app_.dialogs.show_integration = [this] {
    if (!integration_) integration_ = std::make_unique<IntegrationWindow>(app_);
    integration_->come_to_front();
  };
  app_.dialogs.show_biomass = [this] {
    if (!biomass_) biomass_ = std::make_unique<BiomassWindow>(app_);
    biomass_->come_to_front();
  };
  app_.dialogs.figure = [this](FigureModel& figure) { compose_figure(*this, app_, figure); };
  app_.dialogs.sphere = [this](SpherePage& page) { show_sphere_page(*this, app_, page); };
  app_.dialogs.setup = [this](SetupPage& page) { show_setup_page(*this, app_, page); };
  app_.dialogs.show_keys = [this] { show_key_sheet(*this, app_.actions); };
  app_.dialogs.show_about = [this] { QMessageBox::about(this, "Sonar Explorer", about_text(app_)); };
  app_.dialogs.reset_layout = [this] { lay_out_docks(*this); };
  app_.dialogs.full_screen = [this] { isFullScreen() ? showNormal() : showFullScreen(); };
  answer_questions(*this, app_.dialogs);
  app_.dialogs.copy_rows = [] {
    for (QWidget* at = QApplication::focusWidget(); at != nullptr; at = at->parentWidget()) {
      auto* list = dynamic_cast<RowsView*>(at);
      if (list != nullptr) list->copy();
      if (list != nullptr) return true;
    }
    return false;
  };
}

void MainWindow::show_title() {
  const Document& document = app_.workspace.document;
  QString title = "Sonar Explorer";
  if (document.shown()) {
    title = QString::fromStdString(document.shown()->name() + " - " + document.paths().front().filename().string()) +
            " - " + title;
  }
  setWindowTitle(title);
}

MainWindow::~MainWindow() = default;

std::string MainWindow::layout() const {
  return (saveGeometry().toBase64() + " " + saveState(kLayoutVersion).toBase64()).toStdString();
}

void MainWindow::take_layout(const std::string& layout) {
  const QList<QByteArray> parts = QByteArray::fromStdString(layout).split(' ');
  if (parts.size() != 2) return;
  // Of a screen of another size neither is taken: a laptop's arrangement leaves a large screen's views small.
  if (!restoreGeometry(QByteArray::fromBase64(parts[0]))) return;
  restoreState(QByteArray::fromBase64(parts[1]), kLayoutVersion);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!batch_may_end(app_)) return event->ignore();
  if (batch_) batch_->close();
  if (integration_) integration_->close();
  if (biomass_) biomass_->close();
  app_.preferences.window_layout = layout();
  keep_preferences(app_);
  QMainWindow::closeEvent(event);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  auto paths = dropped_paths(*event->mimeData());
  if (!paths.empty()) app_.workspace.document.open(std::move(paths));
}

}  // namespace sonar
