// SPDX-License-Identifier: Apache-2.0
#include "gui/batch_window.h"

#include <QBoxLayout>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFontDatabase>
#include <QKeyEvent>
#include <QSplitter>
#include <cmath>
#include <utility>

#include "gui/dropped_paths.h"
#include "gui/translated.h"
#include "session/app_parts.h"

namespace sonar {
namespace {

constexpr const char* kRecipes = to_translate("Recipes (*.json *.JSON);;All files (*)");
constexpr const char* kTexts = to_translate("Texts (*.txt *.log);;All files (*)");
constexpr int kMostJobs = 1024;
constexpr int kPermille = 1000;

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

}  // namespace

BatchWindow::BatchWindow(AppModel& app, QWidget& main)
    : OwnWindow(app, "batch", to_translate("Run surveys")),
      batch_(*app.batch),
      main_(main),
      table_(new BatchTable(batch_, this)) {
  setAcceptDrops(true);
  auto* halves = new QSplitter(Qt::Vertical, this);
  halves->setChildrenCollapsible(false);
  halves->addWidget(upper_half());
  halves->addWidget(lower_half());
  halves->setStretchFactor(0, 3);
  halves->setStretchFactor(1, 2);
  auto* column = new QVBoxLayout(this);
  column->addWidget(halves);
  table_->installEventFilter(this);
  connect(table_, &QTreeView::doubleClicked, this, [this] { open_current(); });
  connect(table_->selectionModel(), &QItemSelectionModel::currentChanged, this, [this] { show_state(); });
  listening_.to(batch_.changed(), [this](BatchChange change) { follow(change); });
  listening_.to(app.workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey) follow(BatchChange::surveys);
  });
  follow(BatchChange::surveys);
  show_log();
}

QWidget* BatchWindow::upper_half() {
  auto* half = new QWidget(this);
  auto* column = new QVBoxLayout(half);
  column->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout();
  add_button(
      *row, "add", to_translate("&Add folder..."),
      to_translate(
          "A folder of raw files; or a folder of such folders, each of which is a survey of its own. Folders can be "
          "dropped here as well"),
      [this] {
        const std::string folder = app().dialogs.folder_to_run ? app().dialogs.folder_to_run() : std::string();
        if (!folder.empty()) add_paths({folder});
      });
  open_window_ = add_button(*row, "add_open", to_translate("Add the open survey"),
                            to_translate("The one that the main window shows"),
                            [this] { tell(batch_.add_survey(app().workspace.document.paths())); });
  remove_ = add_button(*row, "remove", to_translate("Remove"),
                       to_translate("Takes the marked survey out of the list (Del); no file is touched"),
                       [this] { remove(); });
  earlier_ = add_button(*row, "earlier", to_translate("Earlier"),
                        to_translate("Runs the marked survey earlier (Alt+Up)"), [this] { move(false); });
  later_ = add_button(*row, "later", to_translate("Later"), to_translate("Runs the marked survey later (Alt+Down)"),
                      [this] { move(true); });
  row->addStretch(1);
  out_ =
      add_button(*row, "out", to_translate("&Results folder..."),
                 to_translate("Where results of the marked survey go; beside its raw files, unless another is chosen"),
                 [this] { choose_out(); });
  open_ = add_button(
      *row, "open", to_translate("&Open in the window"),
      to_translate("Shows the marked survey in the main window, with the schools that its run found (double-click)"),
      [this] { open_current(); });
  column->addLayout(row);
  table_->setAccessibleName(translated("Surveys to be run"));
  column->addWidget(table_, 1);
  add_recipe_row(*column);
  add_run_row(*column);
  column->addWidget(told());
  return half;
}

void BatchWindow::add_recipe_row(QBoxLayout& column) {
  auto* row = new QHBoxLayout();
  recipe_->setObjectName("recipe");
  recipe_->addItem(translated("of the open survey"));
  recipe_->addItem(translated("default"));
  recipe_->addItem(translated("of a file..."));
  recipe_->setToolTip(
      "Parameters that all surveys are run under. That of the open survey has the calibration that was chosen in it");
  connect(recipe_, &QComboBox::activated, this, [this](int choice) { choose_recipe(choice); });
  auto* recipe_label = new QLabel(translated("Re&cipe"), this);
  recipe_label->setBuddy(recipe_);
  recipe_file_->setTextFormat(Qt::PlainText);
  recipe_file_->setObjectName("recipe_file");
  jobs_->setObjectName("jobs");
  jobs_->setRange(0, kMostJobs);
  jobs_->setSpecialValueText(translated("all of the machine's"));
  jobs_->setToolTip(translated("Threads of a run; fewer leave more of the machine to others"));
  connect(jobs_, &QSpinBox::valueChanged, this, [this](int jobs) { batch_.set_jobs(jobs); });
  auto* jobs_label = new QLabel(translated("&Threads"), this);
  jobs_label->setBuddy(jobs_);
  row->addWidget(recipe_label);
  row->addWidget(recipe_);
  row->addWidget(recipe_file_, 1);
  row->addWidget(jobs_label);
  row->addWidget(jobs_);
  column.addLayout(row);
}

void BatchWindow::add_run_row(QBoxLayout& column) {
  auto* row = new QHBoxLayout();
  total_->setObjectName("total");
  total_->setAccessibleName(translated("Progress of all surveys"));
  total_->setRange(0, kPermille);
  row->addWidget(total_, 1);
  start_ = add_button(*row, "start", to_translate("&Start"),
                      to_translate("Runs the surveys one after another; what is done already stays"),
                      [this] { tell(start_batch(app())); });
  stop_ = add_button(*row, "stop", to_translate("S&top"),
                     to_translate("Finished observations stay, and the next start goes on from there"),
                     [this] { batch_.stop(); });
  column.addLayout(row);
}

QWidget* BatchWindow::lower_half() {
  auto* half = new QWidget(this);
  auto* column = new QVBoxLayout(half);
  column->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout();
  auto* label = new QLabel(translated("&Log"), this);
  label->setBuddy(log_);
  row->addWidget(label);
  row->addStretch(1);
  add_button(*row, "copy_log", to_translate("Copy log"), to_translate("All lines, to the clipboard"), [this] {
    if (app().dialogs.copy) app().dialogs.copy(log_->toPlainText().toStdString());
  });
  add_button(*row, "save_log", to_translate("Save log..."), to_translate("All lines, as a text file"),
             [this] { save_log(); });
  column->addLayout(row);
  log_->setObjectName("log");
  log_->setReadOnly(true);
  log_->setLineWrapMode(QPlainTextEdit::NoWrap);
  log_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  log_->setPlaceholderText(translated("What the runs tell stands here, as sonarx run tells it."));
  column->addWidget(log_, 1);
  return half;
}

void BatchWindow::add_paths(const std::vector<std::filesystem::path>& paths) {
  if (paths.empty()) return;
  tell(batch_.add(paths));
}

void BatchWindow::choose_out() {
  const auto at = table_->current();
  if (!at || !app().dialogs.folder_to_save) return;
  const BatchSurvey& survey = batch_.surveys()[*at];
  const std::filesystem::path beside = survey.out.empty() ? survey.paths.front() : survey.out;
  const std::string folder =
      app().dialogs.folder_to_save(to_translate("Folder for the results"), beside.parent_path().string());
  if (!folder.empty()) tell(batch_.set_out(*at, folder));
}

void BatchWindow::choose_recipe(int choice) {
  const auto chosen = static_cast<BatchRecipe>(choice);
  std::string file;
  if (chosen == BatchRecipe::of_file) {
    file = app().dialogs.file_to_open ? app().dialogs.file_to_open(to_translate("Recipe"), kRecipes) : std::string();
    if (file.empty()) return show_recipe();
  }
  tell(batch_.set_recipe(chosen, file));
  show_recipe();
}

void BatchWindow::move(bool later) {
  const auto at = table_->current();
  if (!at || (later ? *at + 1 == batch_.surveys().size() : *at == 0)) return;
  batch_.move(*at, later);
  table_->set_current(later ? *at + 1 : *at - 1);
}

void BatchWindow::remove() {
  if (const auto at = table_->current()) tell(batch_.remove(*at));
}

void BatchWindow::open_current() {
  const auto at = table_->current();
  if (!at) return;
  open_run_survey(app(), *at);
  main_.raise();
  main_.activateWindow();
}

void BatchWindow::save_log() {
  const std::string file = app().dialogs.file_to_save
                               ? app().dialogs.file_to_save(to_translate("Save log"), kTexts, "runs.txt")
                               : std::string();
  if (!file.empty()) tell(batch_.save_log(file));
}

void BatchWindow::follow(BatchChange change) {
  if (change == BatchChange::log) return show_log();
  if (change == BatchChange::surveys) show_recipe();
  show_state();
}

void BatchWindow::show_recipe() {
  const BatchRecipe choice = batch_.recipe_choice();
  recipe_->setCurrentIndex(static_cast<int>(choice));
  // That of a survey that is not there cannot be taken.
  recipe_->setItemData(static_cast<int>(BatchRecipe::of_window),
                       app().workspace.document.survey() != nullptr ? QVariant() : QVariant(0), Qt::UserRole - 1);
  const QString file = choice == BatchRecipe::of_file ? text(printable(batch_.recipe_file().string())) : QString();
  recipe_file_->setToolTip(file);
  recipe_file_->setText(recipe_file_->fontMetrics().elidedText(file, Qt::ElideMiddle, width() / 3));
}

void BatchWindow::show_state() {
  const bool running = batch_.running();
  const auto at = table_->current();
  const bool marked = at && *at < batch_.surveys().size();
  const bool at_work = marked && batch_.surveys()[*at].state == BatchState::running;
  open_window_->setEnabled(app().workspace.document.survey() != nullptr);
  remove_->setEnabled(marked && !at_work);
  earlier_->setEnabled(marked && *at > 0);
  later_->setEnabled(marked && *at + 1 < batch_.surveys().size());
  out_->setEnabled(marked && !at_work);
  open_->setEnabled(marked);
  recipe_->setEnabled(!running);
  jobs_->setEnabled(!running);
  start_->setEnabled(!running && !batch_.surveys().empty());
  stop_->setEnabled(running && !batch_.stopping());
  const std::string now = total_text(batch_);
  total_->setValue(static_cast<int>(std::lround(kPermille * (running ? batch_.share() : 0.0))));
  total_->setFormat(text(now));
  setWindowTitle(translated("Run surveys") + (running ? ": " + text(now) : QString()));
}

void BatchWindow::show_log() {
  for (; lines_shown_ < batch_.log().size(); ++lines_shown_) log_->appendPlainText(text(batch_.log()[lines_shown_]));
}

void BatchWindow::closeEvent(QCloseEvent* event) {
  if (!batch_may_end(app())) return event->ignore();
  OwnWindow::closeEvent(event);
}

void BatchWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void BatchWindow::dropEvent(QDropEvent* event) { add_paths(dropped_paths(*event->mimeData())); }

bool BatchWindow::eventFilter(QObject* watched, QEvent* event) {
  const auto* key = event->type() == QEvent::KeyPress ? static_cast<QKeyEvent*>(event) : nullptr;
  if (watched != table_ || key == nullptr) return OwnWindow::eventFilter(watched, event);
  const bool alt = key->modifiers() == Qt::AltModifier;
  if (key->key() == Qt::Key_Delete) return remove(), true;
  if (key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) return open_current(), true;
  if (alt && key->key() == Qt::Key_Up) return move(false), true;
  if (alt && key->key() == Qt::Key_Down) return move(true), true;
  return OwnWindow::eventFilter(watched, event);
}

}  // namespace sonar
