// SPDX-License-Identifier: Apache-2.0
#include "gui/page_window.h"

#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QTabBar>
#include <utility>

#include "gui/picture_view.h"
#include "gui/rows_view.h"
#include "gui/translated.h"
#include "session/app_parts.h"

namespace sonar {
namespace {

constexpr QSize kUsualSize{1180, 720};

}  // namespace

OwnWindow::OwnWindow(AppModel& app, const char* name, const char* title) : app_(app), told_(new QLabel(this)) {
  setObjectName(name);
  setWindowTitle(translated(title));
  resize(kUsualSize.boundedTo(screen()->availableSize()));
  setAttribute(Qt::WA_QuitOnClose, false);
  told_->setObjectName("told");
  told_->setTextFormat(Qt::PlainText);
  told_->setWordWrap(true);
  told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  told_->hide();
  connect(new QShortcut(QKeySequence::Close, this), &QShortcut::activated, this, [this] { close(); });
}

void OwnWindow::come_to_front() {
  show();
  setWindowState(windowState() & ~Qt::WindowMinimized);
  raise();
  activateWindow();
}

QPushButton* OwnWindow::add_button(QBoxLayout& row, const char* name, const char* text, const char* tip,
                                   std::function<void()> pressed) {
  auto* button = new QPushButton(translated(text), this);
  button->setObjectName(name);
  button->setToolTip(translated(tip));
  connect(button, &QPushButton::clicked, this, std::move(pressed));
  row.addWidget(button);
  return button;
}

void OwnWindow::tell(const std::string& line) {
  told_->setText(QString::fromStdString(line));
  told_->setVisible(!line.empty());
}

PageWindow::PageWindow(AppModel& app, const char* name, const char* title) : OwnWindow(app, name, title) {
  auto* column = new QVBoxLayout(this);
  auto* halves = new QSplitter(Qt::Horizontal, this);
  halves->setChildrenCollapsible(false);
  auto* scroll = new QScrollArea(halves);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setAccessibleName(translated("Choices"));
  inside_ = new QWidget(scroll);
  choices_ = new QVBoxLayout(inside_);
  choices_->setContentsMargins(0, 0, 0, 0);
  scroll->setWidget(inside_);
  results_ = new QTabWidget(halves);
  results_->setObjectName("results");
  results_->tabBar()->setAccessibleName(translated("Results"));
  halves->addWidget(scroll);
  halves->addWidget(results_);
  halves->setStretchFactor(1, 1);
  column->addWidget(halves, 1);
  column->addWidget(told());
  foot_ = new QHBoxLayout();
  column->addLayout(foot_);
}

void PageWindow::add_picture(LivePicture& picture, const char* name, const char* title) {
  auto* view = new PictureView(picture, app().workspace.latencies, results_);
  view->setObjectName(name);
  view->setAccessibleName(translated(title));
  results_->addTab(view, translated(title));
}

void PageWindow::add_rows(Rows& rows, const char* name, const char* title) {
  auto* list = new RowsView(rows, false, results_);
  list->setObjectName(name);
  list->set_title(translated(title));
  results_->addTab(list, translated(title));
}

void PageWindow::end_choices() {
  choices_->addStretch(1);
  auto* scroll = qobject_cast<QScrollArea*>(inside_->parentWidget()->parentWidget());
  if (scroll == nullptr) return;
  scroll->setMinimumWidth(inside_->minimumSizeHint().width() + scroll->verticalScrollBar()->sizeHint().width());
}

void PageWindow::write_into(const char* title, const std::function<Result<void>(const std::string& folder)>& write) {
  const std::string folder = asked_folder(app(), title, "-out");
  if (folder.empty()) return;
  const auto done = write(folder);
  tell(done ? "written into " + folder : to_line(done.error()));
}

}  // namespace sonar
