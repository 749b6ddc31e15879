// SPDX-License-Identifier: Apache-2.0
#include "gui/start_page.h"

#include <QAction>
#include <QCommandLinkButton>
#include <QEvent>
#include <QFontInfo>
#include <QGridLayout>
#include <QIcon>
#include <QLabel>
#include <QPixmap>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <functional>

#include "gui/action_menus.h"
#include "gui/translated.h"
#include "session/listening.h"
#include "session/open/recent_surveys.h"

namespace sonar {
namespace {

struct Beginning {
  const char* action;
  const char* text;
  const char* more;
};
constexpr std::array<Beginning, 5> kBeginnings{
    {{"file.open_folder", to_translate("Open a folder"),
      to_translate("Raw files of a survey, or the results of a run with their schools")},
     {"file.open_files", to_translate("Open some files"), to_translate("A part of a survey")},
     {"file.demo", to_translate("Open the demo survey"),
      to_translate("Simulated; it takes a moment to make at the first time")},
     {"help.tutorial", to_translate("Follow the tutorial"), to_translate("Ten steps through the demo survey")},
     {"help.guide", to_translate("Read the guide"),
      to_translate("From opening a survey to its map; [help.keys] shows all keys")}}};

constexpr const char* kSteps = to_translate(
    "<ol style=\"margin-left:-24px\">"
    "<li style=\"margin-bottom:6px\"><b>Open</b> a survey: drop its folder here, or a folder of results with its "
    "schools.</li>"
    "<li style=\"margin-bottom:6px\"><b>Find schools</b>: [schools.detect_all] detects them in all pings; or click on "
    "one in a "
    "slice, and [school.propagate] follows it.</li>"
    "<li><b>Review and export</b>: [review.accept] accepts, [review.reject] rejects; [export.results] writes tables, "
    "masks and the map.</li></ol>");

constexpr const char* kInstruments = to_translate(
    "Simrad MS70: schools are detected, followed and measured. ME70 and similar sonars: the same where the beams form "
    "fans. EK60: shown as an echogram; schools are not detected in single beams yet. EK80: named, but not read yet.");

class StartPage : public QWidget {
 public:
  StartPage(QMainWindow& window, AppModel& app) : QWidget(&window), window_(window), app_(app) {
    setObjectName("start_page");
    setAutoFillBackground(true);
    auto* page = new QGridLayout(this);
    page->setContentsMargins(56, 24, 56, 16);
    page->setHorizontalSpacing(64);
    page->setVerticalSpacing(16);
    page->setColumnStretch(0, 1);
    page->setColumnStretch(1, 1);
    page->setRowStretch(2, 1);
    page->addWidget(heading("Sonar Explorer", 2.0), 0, 0);
    page->addLayout(beginnings(), 1, 0, Qt::AlignTop);
    recent_->setSpacing(6);
    page->addLayout(recent_, 1, 1, 2, 1, Qt::AlignTop);
    page->addWidget(heading(translated("Opened before"), 1.3), 0, 1, Qt::AlignBottom);
    window.installEventFilter(this);
    listening_.to(app.workspace.document.changes(), [this](DocumentChange change) {
      if (change == DocumentChange::survey || change == DocumentChange::progress || change == DocumentChange::glance)
        follow();
    });
    follow();
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show)
      place();
    return QWidget::eventFilter(watched, event);
  }

 private:
  QLabel* heading(const QString& text, double size) {
    auto* label = new QLabel(text, this);
    QFont font = label->font();
    font.setPointSizeF(size * QFontInfo(font).pointSizeF());
    label->setFont(font);
    return label;
  }
  QLabel* words(const QString& html, const char* name) {
    auto* label = new QLabel(html, this);
    label->setObjectName(name);
    label->setWordWrap(true);
    return label;
  }

  /// A text that names actions, with their keys now and after each change of them.
  void keep_keys(const char* text, std::function<void(const QString&)> show) {
    const auto tell = [this, text, show = std::move(show)] {
      show(QString::fromStdString(app_.actions.with_keys(translated(text).toStdString())));
    };
    tell();
    listening_.to(app_.actions.keys_changed(), tell);
  }

  QVBoxLayout* beginnings() {
    auto* column = new QVBoxLayout;
    for (const auto& [id, text, more] : kBeginnings) {
      QAction* action = find_action(window_, id);
      auto* button = new QCommandLinkButton(translated(text), this);
      keep_keys(more, [button](const QString& now) { button->setDescription(now); });
      button->setObjectName(QString("start.") + id);
      QObject::connect(button, &QPushButton::clicked, action, &QAction::trigger);
      column->addWidget(button);
    }
    column->addSpacing(16);
    column->addWidget(heading(translated("Three steps"), 1.3));
    column->addSpacing(8);
    QLabel* steps = words({}, "start.steps");
    keep_keys(kSteps, [steps](const QString& now) { steps->setText(now); });
    column->addWidget(steps);
    column->addSpacing(8);
    column->addWidget(words(translated(kInstruments), "start.instruments"));
    return column;
  }

  /// As they are now: a survey that was just closed has a new thumbnail.
  void show_recent() {
    while (QLayoutItem* item = recent_->takeAt(0)) {
      delete item->widget();
      delete item;
    }
    const std::vector<RecentSurvey> surveys = recent_surveys(app_);
    for (std::size_t i = 0; i < surveys.size(); ++i) recent_->addWidget(recent_button(surveys[i], i));
    if (surveys.empty()) recent_->addWidget(words(translated("Nothing yet."), "start.nothing"));
  }

  QToolButton* recent_button(const RecentSurvey& survey, std::size_t index) {
    auto* button = new QToolButton(this);
    button->setObjectName(QString("start.recent.%1").arg(index + 1));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setIconSize(QSize(kThumbnail.width, kThumbnail.height) / 2);
    QPixmap picture(kThumbnail.width, kThumbnail.height);
    picture.fill(Qt::transparent);
    if (!survey.thumbnail.empty()) picture.load(QString::fromStdString(survey.thumbnail.string()));
    button->setIcon(picture);
    QString place = QString::fromStdString(survey.place);
    if (!survey.there) place += " " + translated("(not there now)");
    button->setText(QString::fromStdString(survey.name) + "\n" + place);
    button->setEnabled(survey.there);
    button->setAccessibleName(translated("Open %1 in %2").arg(QString::fromStdString(survey.name), place));
    QObject::connect(button, &QToolButton::clicked, button,
                     [this, index] { app_.workspace.document.open(app_.preferences.recent.at(index)); });
    return button;
  }

  void follow() {
    const Document& document = app_.workspace.document;
    const bool wanted = document.survey() == nullptr && !document.glance() && document.progress().stage.empty();
    if (wanted && !seen_) show_recent();
    seen_ = wanted;
    setVisible(wanted);
    if (wanted) place();
  }

  /// Between the tool bars and the status line.
  void place() {
    if (!seen_) return;
    int top = 0;
    for (const auto* bar : window_.findChildren<QToolBar*>()) {
      if (bar->isVisible() && window_.toolBarArea(bar) == Qt::TopToolBarArea)
        top = std::max(top, bar->geometry().bottom() + 1);
    }
    const int bottom = window_.statusBar()->geometry().top();
    setGeometry(0, top, window_.width(), std::max(0, bottom - top));
    raise();
  }

  QMainWindow& window_;
  AppModel& app_;
  QVBoxLayout* recent_ = new QVBoxLayout;
  bool seen_ = false;
  Listening listening_;  // the last member: it ends first
};

}  // namespace

void add_start_page(QMainWindow& window, AppModel& app) { new StartPage(window, app); }

}  // namespace sonar
