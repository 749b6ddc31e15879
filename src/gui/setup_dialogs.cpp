// SPDX-License-Identifier: Apache-2.0
#include "gui/setup_dialogs.h"

#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "gui/panel_section.h"
#include "gui/picture_view.h"
#include "gui/translated.h"
#include "session/listening.h"
#include "session/setup/setup_page.h"
#include "session/setup/sphere_page.h"

namespace sonar {
namespace {

constexpr int kPermille = 1000;

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

/// A picture, a line that tells, and buttons below it.
class PageDialog : public QDialog {
 public:
  PageDialog(QWidget& window, AppModel& app, LivePicture& picture, const char* name, const char* title)
      : QDialog(&window), view_(new PictureView(picture, app.workspace.latencies, this)) {
    setObjectName(name);
    setWindowTitle(translated(title));
    resize(window.size().boundedTo(QSize(1380, 900)) * 19 / 20);
    view_->setObjectName("picture");
    view_->setAccessibleName(windowTitle());
    told_->setObjectName("told");
    told_->setWordWrap(true);
    told_->setTextFormat(Qt::PlainText);
    told_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  }

 protected:
  /// Enter ends the typing of a number, not the dialog.
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() != Qt::Key_Return && event->key() != Qt::Key_Enter) QDialog::keyPressEvent(event);
  }
  QPushButton* add_button(const char* words, const char* name, const char* tip, std::function<void()> pressed) {
    auto* made = buttons_->addButton(translated(words), QDialogButtonBox::ActionRole);
    made->setObjectName(name);
    made->setToolTip(translated(tip));
    made->setAutoDefault(false);
    connect(made, &QPushButton::clicked, this, std::move(pressed));
    return made;
  }

  PictureView* view_;
  QLabel* told_ = new QLabel(this);
  QDialogButtonBox* buttons_ = new QDialogButtonBox(QDialogButtonBox::Close, this);
};

class SphereDialog : public PageDialog {
 public:
  SphereDialog(QWidget& window, AppModel& app, SpherePage& page)
      : PageDialog(window, app, page, "sphere", to_translate("Calibration by a sphere")), page_(page) {
    view_->set_idle_text([] { return translated("The map of the beams stands here after a fit."); });
    auto* halves = new QHBoxLayout();
    halves->addWidget(controls());
    halves->addWidget(view_, 1);
    auto* column = new QVBoxLayout(this);
    column->addLayout(halves, 1);
    progress_->setObjectName("progress");
    progress_->setAccessibleName(translated("Progress of the fit"));
    progress_->setRange(0, kPermille);
    column->addWidget(progress_);
    column->addWidget(told_);
    column->addWidget(buttons_);
    start_ = add_button(to_translate("Fit"), "start", to_translate("Finds the sphere and fits the beams"),
                        [this] { page_.start(); });
    stop_ = add_button(to_translate("Stop"), "stop", to_translate("Gives the fit up"), [this] { page_.stop(); });
    write_ = add_button(to_translate("Write table..."), "write",
                        to_translate("The calibration table (CSV) for sonarx run --calibration"),
                        [this] { page_.ask_and_write(); });
    use_ = add_button(to_translate("Use for the open survey"), "use",
                      to_translate("Measures with these figures from now on: masks and decisions stay, undo takes it "
                                   "back"),
                      [this] { page_.use(); });
    listening_.to(page.changed(), [this] { show_state(); });
    show_state();
  }

 private:
  QWidget* controls() {
    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setAccessibleName(translated("What is known of the sphere run"));
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* inside = new QWidget(scroll);
    auto* column = new QVBoxLayout(inside);
    run_->setObjectName("run");
    run_->setWordWrap(true);
    run_->setTextFormat(Qt::PlainText);
    column->addWidget(run_);
    choose_ = new QPushButton(translated("Sphere run..."), inside);
    choose_->setObjectName("choose");
    choose_->setToolTip(translated("Folder of the raw files in which the sphere is; at first the open survey"));
    choose_->setAutoDefault(false);
    connect(choose_, &QPushButton::clicked, this, [this] { page_.choose_sphere_run(); });
    column->addWidget(choose_);
    const auto asked = std::make_shared<SourceOf<SphereAsked>>(page_.asked());
    PanelSection sphere{to_translate("Sphere"), asked, {"sphere", "material", "diameter_mm"}};
    sphere.notes.push_back({"material", [this] { return page_.material_text(); }});
    add_folding_section(*column, sphere, inside);
    add_folding_section(*column, {to_translate("Where it hangs"), asked, {"range_from_m", "range_to_m"}}, inside);
    PanelSection water{to_translate("Water"), asked, {"measured_water", "temperature_c", "salinity_psu", "depth_m"}};
    for (const char* name : {"temperature_c", "salinity_psu", "depth_m"}) {
      water.uses.push_back({name, [this] { return page_.asked().values().measured_water; }});
    }
    add_folding_section(*column, water, inside);
    add_folding_section(*column, {to_translate("Picture"), std::make_shared<SourceOf<SphereLook>>(page_.look())},
                        inside);
    column->addStretch(1);
    scroll->setWidget(inside);
    scroll->setMinimumWidth(inside->minimumSizeHint().width() + 24);
    return scroll;
  }

  void show_state() {
    QString paths;
    for (const auto& path : page_.sphere_run()) paths += (paths.isEmpty() ? "" : "\n") + text(path.filename().string());
    run_->setText(paths.isEmpty() ? translated("No sphere run is chosen.") : paths);
    told_->setText(text(page_.told()));
    progress_->setVisible(page_.running());
    progress_->setValue(static_cast<int>(std::lround(kPermille * page_.share())));
    choose_->setEnabled(!page_.running());
    start_->setEnabled(!page_.running() && !page_.sphere_run().empty());
    stop_->setEnabled(page_.running());
    write_->setEnabled(page_.made() != nullptr && !page_.running());
    use_->setEnabled(page_.usable() && !page_.running());
  }

  SpherePage& page_;
  QLabel* run_ = new QLabel(this);
  QProgressBar* progress_ = new QProgressBar(this);
  QPushButton* choose_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* stop_ = nullptr;
  QPushButton* write_ = nullptr;
  QPushButton* use_ = nullptr;
  Listening listening_;  // the last member: it ends first
};

class SetupDialog : public PageDialog {
 public:
  SetupDialog(QWidget& window, AppModel& app, SetupPage& page)
      : PageDialog(window, app, page, "setup", to_translate("Setup check")), page_(page) {
    view_->set_idle_text([] { return translated("Mean speeds stand here as soon as schools are measured."); });
    auto* column = new QVBoxLayout(this);
    column->addWidget(view_, 1);
    column->addWidget(told_);
    auto* row = new QHBoxLayout();
    for (QCheckBox* one : {mounting_, speed_}) {
      one->setChecked(true);
      row->addWidget(one);
      connect(one, &QCheckBox::toggled, this, [this] { show_state(); });
    }
    mounting_->setObjectName("mounting");
    speed_->setObjectName("speed");
    row->addStretch(1);
    column->addLayout(row);
    column->addWidget(buttons_);
    use_ = add_button(to_translate("Put into the recipe"), "use",
                      to_translate("Opens the survey under the proposed values; decisions stay, and File > Recipe "
                                   "before takes it back"),
                      [this] { use(); });
    listening_.to(page.changed(), [this] { show_state(); });
    listening_.to(app.workspace.document.changes(), [this](DocumentChange) { show_state(); });
    show_state();
  }

 private:
  void use() {
    const auto used = page_.use(mounting_->isChecked(), speed_->isChecked());
    if (used) return accept();
    told_->setText(text(to_line(used.error())));
  }
  void show_state() {
    told_->setText(text(page_.told()));
    for (QCheckBox* one : {mounting_, speed_}) one->setEnabled(page_.proposes());
    use_->setEnabled(page_.proposes() && (mounting_->isChecked() || speed_->isChecked()));
  }

  SetupPage& page_;
  QCheckBox* mounting_ = new QCheckBox(translated("Mounting angle"), this);
  QCheckBox* speed_ = new QCheckBox(translated("Sound speed"), this);
  QPushButton* use_ = nullptr;
  Listening listening_;  // the last member: it ends first
};

}  // namespace

void show_sphere_page(QWidget& window, AppModel& app, SpherePage& page) { SphereDialog(window, app, page).exec(); }

void show_setup_page(QWidget& window, AppModel& app, SetupPage& page) { SetupDialog(window, app, page).exec(); }

}  // namespace sonar
