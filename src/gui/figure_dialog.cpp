// SPDX-License-Identifier: Apache-2.0
#include "gui/figure_dialog.h"

#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gui/own_keys.h"
#include "gui/panel_section.h"
#include "gui/picture_view.h"
#include "gui/translated.h"
#include "session/listening.h"

namespace sonar {
namespace {

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

/// The views, those on the page first and in their order there: ticked, moved, and given a row of their own.
class ViewList : public QWidget {
 public:
  ViewList(FigureModel& figure, Workspace& workspace, QWidget* parent) : QWidget(parent), figure_(figure) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 2, 4, 2);
    list_->setObjectName("views");
    list_->setAccessibleName(translated("Views on the page"));
    list_->setToolTip(translated("Tick what goes on the page; Alt+Up and Alt+Down move a view among the others"));
    keep_own_keys(*list_);
    column->addWidget(list_);
    auto* row = new QHBoxLayout();
    earlier_ =
        button(to_translate("Up"), "earlier", to_translate("The chosen view comes earlier on the page (Alt+Up)"));
    later_ = button(to_translate("Down"), "later", to_translate("The chosen view comes later on the page (Alt+Down)"));
    wide_->setObjectName("wide");
    wide_->setToolTip(translated("The chosen view is as wide as the page: for timelines and echograms"));
    row->addWidget(earlier_);
    row->addWidget(later_);
    row->addWidget(wide_);
    row->addStretch(1);
    column->addLayout(row);
    QObject::connect(list_, &QListWidget::itemChanged, this,
                     [this](QListWidgetItem* item) { figure_.choose(id_of(item), item->checkState() == Qt::Checked); });
    QObject::connect(list_, &QListWidget::currentRowChanged, this, [this] { show_buttons(); });
    QObject::connect(earlier_, &QPushButton::clicked, this, [this] { move(-1); });
    QObject::connect(later_, &QPushButton::clicked, this, [this] { move(1); });
    QObject::connect(wide_, &QCheckBox::toggled, this, [this](bool on) { figure_.set_wide(id_of(here()), on); });
    fill();
    listening_.to(workspace.figure, [this] { fill(); });
  }

 protected:
  void keyPressEvent(QKeyEvent* event) override {
    const bool up = event->key() == Qt::Key_Up;
    if (event->modifiers() != Qt::AltModifier || (!up && event->key() != Qt::Key_Down)) {
      return QWidget::keyPressEvent(event);
    }
    move(up ? -1 : 1);
  }

 private:
  QPushButton* button(const char* words, const char* name, const char* tip) {
    auto* made = new QPushButton(translated(words), this);
    made->setObjectName(name);
    made->setToolTip(translated(tip));
    made->setAutoDefault(false);
    return made;
  }
  [[nodiscard]] QListWidgetItem* here() const { return list_->currentItem(); }
  static std::string id_of(const QListWidgetItem* item) {
    return item == nullptr ? std::string() : item->data(Qt::UserRole).toString().toStdString();
  }
  void move(int by) {
    if (here() != nullptr) figure_.move(id_of(here()), by);
  }

  void fill() {
    std::vector<FigureChoice> now = figure_.choices();
    if (now == shown_) return;
    const std::string current = id_of(here());
    const QSignalBlocker silent(list_);
    list_->clear();
    for (const FigureChoice& one : now) {
      auto* item =
          new QListWidgetItem(translated(one.title) + (one.wide ? " " + translated("(own row)") : QString()), list_);
      item->setData(Qt::UserRole, text(one.id));
      item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
      item->setCheckState(one.chosen ? Qt::Checked : Qt::Unchecked);
      if (one.id == current) list_->setCurrentItem(item);
    }
    shown_ = std::move(now);
    show_buttons();
  }

  void show_buttons() {
    const int row = list_->currentRow();
    const auto at = [this](int i) {
      return i >= 0 && i < static_cast<int>(shown_.size()) ? shown_[static_cast<std::size_t>(i)] : FigureChoice{};
    };
    const bool chosen = at(row).chosen;
    earlier_->setEnabled(chosen && row > 0);
    later_->setEnabled(chosen && at(row + 1).chosen);
    wide_->setEnabled(chosen);
    const QSignalBlocker silent(wide_);
    wide_->setChecked(at(row).wide);
  }

  FigureModel& figure_;
  QListWidget* list_ = new QListWidget(this);
  QPushButton* earlier_ = nullptr;
  QPushButton* later_ = nullptr;
  QCheckBox* wide_ = new QCheckBox(translated("Row of its own"), this);
  std::vector<FigureChoice> shown_;
  Listening listening_;  // the last member: it ends first
};

class FigureDialog : public QDialog {
 public:
  FigureDialog(QWidget& window, AppModel& app, FigureModel& figure) : QDialog(&window), app_(app), figure_(figure) {
    setObjectName("figure");
    setWindowTitle(translated("Figure for print"));
    resize(window.size().boundedTo(QSize(1280, 900)) * 19 / 20);
    auto* column = new QVBoxLayout(this);
    auto* halves = new QSplitter(Qt::Horizontal, this);
    halves->addWidget(controls());
    preview_ = new PictureView(figure, app.workspace.latencies, halves);
    preview_->setObjectName("preview");
    preview_->setAccessibleName(translated("The page"));
    halves->addWidget(preview_);
    halves->setStretchFactor(1, 1);
    halves->setChildrenCollapsible(false);
    column->addWidget(halves, 1);
    column->addLayout(foot());
    listening_.to(figure.changed(), [this] { show_state(); });
    show_state();
  }

 protected:
  /// Enter ends the typing of a number or a word, not the dialog.
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) QDialog::keyPressEvent(event);
  }

 private:
  QWidget* controls() {
    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setAccessibleName(translated("What goes on the page"));
    scroll->setFrameShape(QFrame::NoFrame);
    auto* inside = new QWidget(scroll);
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(new ViewList(figure_, app_.workspace, inside));
    const auto source = std::make_shared<SourceOf<FigureParams>>(app_.workspace.figure);
    const auto section = [&](const char* title, std::vector<std::string> names) {
      add_folding_section(*column, PanelSection{title, source, std::move(names)}, inside);
    };
    section(to_translate("Paper"), {"paper", "width_mm", "height_mm", "margin_mm", "dpi"});
    section(to_translate("Panels"),
            {"columns", "wide_height_percent", "letters", "headings", "legend", "text_pt", "dark"});
    section(to_translate("Words"), {"title", "caption", "source"});
    column->addStretch(1);
    scroll->setWidget(inside);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(inside->minimumSizeHint().width() + scroll->verticalScrollBar()->sizeHint().width());
    return scroll;
  }

  QHBoxLayout* foot() {
    told_->setObjectName("told");
    told_->setWordWrap(true);
    told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    write_ = buttons->addButton(translated("Write..."), QDialogButtonBox::ActionRole);
    write_->setObjectName("write");
    write_->setToolTip(translated("The page as the preview shows it: PNG with its dpi, SVG or PDF (Ctrl+S)"));
    write_->setShortcut(QKeySequence("Ctrl+S"));
    write_->setAutoDefault(false);
    QObject::connect(write_, &QPushButton::clicked, this, [this] { figure_.ask_and_write(); });
    QObject::connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* row = new QHBoxLayout();
    row->addWidget(told_, 1);
    row->addWidget(buttons);
    return row;
  }

  void show_state() {
    told_->setText(text(figure_.told()));
    write_->setEnabled(figure_.page() != nullptr);
  }

  AppModel& app_;
  FigureModel& figure_;
  PictureView* preview_ = nullptr;
  QLabel* told_ = new QLabel(this);
  QPushButton* write_ = nullptr;
  Listening listening_;  // the last member: it ends first
};

}  // namespace

void compose_figure(QWidget& window, AppModel& app, FigureModel& figure) { FigureDialog(window, app, figure).exec(); }

}  // namespace sonar
