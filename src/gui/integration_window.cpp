// SPDX-License-Identifier: Apache-2.0
#include "gui/integration_window.h"

#include <fmt/format.h>

#include <QSignalBlocker>
#include <utility>
#include <vector>

#include "gui/panel_section.h"
#include "gui/translated.h"

namespace sonar {

IntegrationWindow::IntegrationWindow(AppModel& app)
    : PageWindow(app, "integration", to_translate("Echo integration")),
      integration_(*app.integration),
      nasc_(std::make_unique<EffortPicture>(app.workspace, integration_, EffortPicture::Kind::nasc)),
      section_(std::make_unique<EffortPicture>(app.workspace, integration_, EffortPicture::Kind::section)) {
  add_choices();
  add_results();
  add_foot();
  listening_.to(integration_.changed(), [this] { show_state(); });
  listening_.to(app.workspace.units.changed(), [this] { show_bins(); });
  show_state();
}

void IntegrationWindow::add_choices() {
  add_folding_section(choices(), PanelSection{to_translate("How water is cut"), source_of(integration_.params)},
                      inside());
  transects_ = new QLabel(inside());
  transects_->setObjectName("transects");
  transects_->setTextFormat(Qt::PlainText);
  transects_->setWordWrap(true);
  choices().addWidget(transects_);
  auto* row = new QHBoxLayout();
  choices().addLayout(row);
  const auto act = [this](const char* id) {
    const Action* action = app().actions.find(id);
    if (action != nullptr && (!action->enabled || action->enabled())) action->run();
  };
  add_button(*row, "open_transects", to_translate("Transects..."),
             to_translate("A table of transects, strata and off-effort periods (CSV)"),
             [act] { act("transects.open"); });
  add_button(*row, "no_transects", to_translate("None"), to_translate("Each observation is a transect"),
             [act] { act("transects.none"); });
  bins_ = new QComboBox(inside());
  bins_->setObjectName("range_bin");
  bins_->setToolTip(translated("Range bin that the section shows"));
  bins_->setAccessibleName(translated("Range bin that the section shows"));
  connect(bins_, &QComboBox::currentIndexChanged, this, [this](int index) {
    const QVariant from = bins_->itemData(index);
    section_->show_range_bin(from.isValid() ? std::optional(from.toDouble()) : std::nullopt);
  });
  choices().addWidget(bins_);
  end_choices();
}

void IntegrationWindow::add_results() {
  add_picture(*nasc_, "nasc_chart", to_translate("NASC over distance"));
  add_picture(*section_, "sv_section", to_translate("Section"));
  add_rows(integration_.strata_rows, "strata", to_translate("Strata"));
  add_rows(integration_.effort_rows, "effort", to_translate("Effort"));
  add_rows(integration_.nasc_rows, "nasc", to_translate("NASC"));
}

void IntegrationWindow::add_foot() {
  progress_ = new QProgressBar(this);
  progress_->setObjectName("progress");
  progress_->setAccessibleName(translated("Progress of echo integration"));
  foot().addWidget(progress_, 1);
  start_ = add_button(foot(), "start", to_translate("&Integrate"),
                      to_translate("Reads every ping of the survey, behind the window"), [this] {
                        const auto started = integration_.start();
                        if (!started) tell(started);
                      });
  stop_ = add_button(foot(), "stop", to_translate("S&top"), to_translate("The result before stays"),
                     [this] { integration_.stop(); });
  write_ = add_button(foot(), "write", to_translate("&Write tables..."),
                      to_translate("effort.csv, nasc.csv and strata.csv into a folder"), [this] {
                        write_into(to_translate("Folder for the tables"),
                                   [this](const std::string& folder) { return integration_.write(folder); });
                      });
}

void IntegrationWindow::show_bins() {
  const std::vector<double> bins = section_->range_bins();
  const auto words_of = [unit = app().workspace.units().length()](double from_m) {
    return translated("Section: range bin from %1").arg(QString::fromStdString(round_text(from_m, unit)));
  };
  if (bins_->count() == static_cast<int>(bins.size()) + 1) {
    bool same = true;
    for (int i = 0; i < static_cast<int>(bins.size()); ++i) {
      same = same && bins_->itemData(i + 1).toDouble() == bins[static_cast<std::size_t>(i)];
    }
    for (int i = 0; same && i < static_cast<int>(bins.size()); ++i) {
      bins_->setItemText(i + 1, words_of(bins[static_cast<std::size_t>(i)]));
    }
    if (same) return;
  }
  const QSignalBlocker silent(bins_);
  bins_->clear();
  bins_->addItem(translated("Section: mean of all range bins"));
  for (const double from_m : bins) {
    bins_->addItem(words_of(from_m), from_m);
  }
  section_->show_range_bin(std::nullopt);
}

void IntegrationWindow::show_state() {
  const Progress& now = integration_.progress();
  const bool running = integration_.running();
  progress_->setRange(0, running ? static_cast<int>(now.total) : 1);  // 0 to 0: it moves to and fro
  progress_->setValue(running ? static_cast<int>(now.done) : 0);
  progress_->setFormat(running ? QString::fromStdString(now.stage) + " %p %" : QString());
  start_->setEnabled(!running);
  stop_->setEnabled(running);
  write_->setEnabled(integration_.result() != nullptr);
  transects_->setText(QString::fromStdString(integration_.transects_text()));
  // What was told of a folder stays until integration has more to say.
  if (std::exchange(shown_told_, integration_.told()) != integration_.told()) tell(integration_.told());
  show_bins();
}

}  // namespace sonar
