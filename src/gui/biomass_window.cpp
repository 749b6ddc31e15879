// SPDX-License-Identifier: Apache-2.0
#include "gui/biomass_window.h"

#include <QSignalBlocker>
#include <utility>
#include <vector>

#include "gui/own_keys.h"
#include "gui/panel_section.h"
#include "gui/translated.h"
#include "session/app_parts.h"

namespace sonar {
namespace {

constexpr const char* kTables = to_translate("Tables (*.csv *.CSV);;All files (*)");

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

}  // namespace

BiomassWindow::BiomassWindow(AppModel& app)
    : PageWindow(app, "biomass", to_translate("Numbers and biomass")),
      fish_(*app.fish),
      causes_(std::make_unique<CausePicture>(app.workspace, fish_)) {
  add_choices();
  add_rows(fish_.strata_rows, "strata", to_translate("Survey and strata"));
  add_rows(fish_.school_rows, "schools", to_translate("Schools"));
  add_picture(*causes_, "causes", to_translate("What makes the band"));
  add_foot();
  listening_.to(fish_.changed(), [this] { show_state(); });
  listening_.to(fish_.params, [this] { show_state(); });
  show_state();
}

void BiomassWindow::showEvent(QShowEvent* event) {
  PageWindow::showEvent(event);
  fish_.begin();
}

void BiomassWindow::hideEvent(QHideEvent* event) {
  PageWindow::hideEvent(event);
  fish_.end();
}

PanelSection BiomassWindow::section(const char* title, std::vector<std::string> names) {
  PanelSection made{title, std::make_shared<SourceOf<FishParams>>(fish_.params), std::move(names)};
  PanelSection::Words relations{"relation", {}};
  for (const TsRelation& one : fish_.relations()) relations.words.push_back(one.name);
  made.looks = {{"weight_a_g", to_translate("no biomass"), {kNoWeight_g, 0.02}}};
  made.words = {std::move(relations)};
  const auto own = [this] { return fish_.params.values().aspect == AspectModel::own; };
  const auto normal = [this] { return fish_.params.values().lengths == LengthsFrom::mean_and_sd; };
  for (const char* name : {"line_share", "any_aspect_share", "heading_sd_deg", "tilt_sd_deg"}) {
    made.uses.push_back({name, own});
  }
  for (const char* name : {"mean_length_cm", "sd_length_cm"}) made.uses.push_back({name, normal});
  return made;
}

void BiomassWindow::add_choices() {
  strength_ = new QVBoxLayout();
  choices().addLayout(strength_);
  relation_ = new QLabel(inside());
  relation_->setObjectName("relation_text");
  relation_->setTextFormat(Qt::PlainText);
  relation_->setWordWrap(true);
  choices().addWidget(relation_);
  choices().addWidget(new QLabel(translated("Relations that the band spans"), inside()));
  relations_ = new QListWidget(inside());
  relations_->setObjectName("relations");
  relations_->setAccessibleName(translated("Relations that the band spans"));
  relations_->setMaximumHeight(160);
  keep_own_keys(*relations_);
  connect(relations_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
    fish_.set_spans(item->data(Qt::UserRole).toString().toStdString(), item->checkState() == Qt::Checked);
  });
  choices().addWidget(relations_);
  add_folding_section(
      choices(),
      section(to_translate("Fish"), {"lengths", "mean_length_cm", "sd_length_cm", "weight_a_g", "weight_b", "species"}),
      inside());
  add_folding_section(
      choices(),
      section(to_translate("Aspect"), {"aspect", "line_share", "any_aspect_share", "heading_sd_deg", "tilt_sd_deg"}),
      inside());
  auto* row = new QHBoxLayout();
  choices().addLayout(row);
  add_button(
      *row, "open_relations", to_translate("TS relations..."),
      to_translate("A table of relations between target strength and length, as sonarx biomass --print-ts writes "
                   "one; they take the place of the program's"),
      [this] { open_table(to_translate("Relations of target strength"), &FishBiomass::read_relations); });
  add_button(*row, "open_lengths", to_translate("Lengths..."),
             to_translate("A table length_cm,count or length_cm,fraction"),
             [this] { open_table(to_translate("Lengths of fish"), &FishBiomass::read_lengths); });
  add_button(*row, "open_areas", to_translate("Areas..."), to_translate("A table stratum,area_nmi2"),
             [this] { open_table(to_translate("Areas of strata"), &FishBiomass::read_areas); });
  files_ = new QLabel(inside());
  files_->setTextFormat(Qt::PlainText);
  files_->setWordWrap(true);
  choices().addWidget(files_);
  show_relations();
  end_choices();
}

void BiomassWindow::add_foot() {
  add_button(foot(), "incidence", to_translate("Sv over &incidence"),
             to_translate("The chart of the main window shows Sv over the angle between beam and school"),
             [this] { show_incidence_chart(app().workspace); });
  foot().addStretch(1);
  write_ = add_button(foot(), "write", to_translate("&Write tables..."),
                      to_translate("biomass.csv, biomass_pings.csv and biomass_strata.csv into a folder"), [this] {
                        write_into(to_translate("Folder for the tables"),
                                   [this](const std::string& folder) { return fish_.write(folder); });
                      });
}

void BiomassWindow::open_table(const char* title, Result<void> (FishBiomass::*read)(const std::filesystem::path&)) {
  const Dialogs& dialogs = app().dialogs;
  const std::string file = dialogs.file_to_open ? dialogs.file_to_open(title, kTables) : std::string();
  if (!file.empty()) tell((fish_.*read)(file));
}

void BiomassWindow::show_relations() {
  const QSignalBlocker silent(relations_);
  const auto& all = fish_.relations();
  bool same = relation_choice_ != nullptr && relations_->count() == static_cast<int>(all.size());
  for (int i = 0; same && i < relations_->count(); ++i) {
    same = relations_->item(i)->text() == text(all[static_cast<std::size_t>(i)].name);
  }
  if (!same) {
    delete relation_choice_;
    relation_choice_ = new QWidget(inside());
    auto* column = new QVBoxLayout(relation_choice_);
    column->setContentsMargins(0, 0, 0, 0);
    add_folding_section(*column, section(to_translate("Target strength"), {"relation"}), relation_choice_);
    strength_->addWidget(relation_choice_);
    relations_->clear();
    for (const TsRelation& one : all) {
      auto* item = new QListWidgetItem(text(one.name), relations_);
      item->setData(Qt::UserRole, text(one.name));
      item->setToolTip(text(one.source));
      item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    }
  }
  for (int i = 0; i < relations_->count(); ++i) {
    const bool on = fish_.spans(all[static_cast<std::size_t>(i)].name);
    relations_->item(i)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
  }
}

void BiomassWindow::show_state() {
  relation_->setText(text(fish_.relation_text()));
  QString files;
  for (const std::filesystem::path& file : {fish_.relations_file(), fish_.lengths_file(), fish_.areas_file()}) {
    if (!file.empty()) files += text(printable(file.filename().string())) + " ";
  }
  files_->setText(files);
  write_->setEnabled(fish_.result() != nullptr);
  if (std::exchange(shown_told_, fish_.told()) != fish_.told()) tell(fish_.told());
  show_relations();
}

}  // namespace sonar
