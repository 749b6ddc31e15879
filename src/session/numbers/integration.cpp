// SPDX-License-Identifier: Apache-2.0
#include "session/numbers/integration.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <utility>

#include "base/number_text.h"
#include "base/within_memory.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/work_folders.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

/// What every observation's job needs, taken in the window's turn.
struct Wish {
  std::shared_ptr<const SurveyFiles> survey;
  Recipe recipe;
  std::map<std::string, ProductPtr> products;
  std::vector<Transect> transects;
  IntegrateParams params;
};

Result<Integrated> integrated(const Wish& wish, Work& work) {
  const ProductOf product_of = [&wish](const std::string& name) -> Result<std::optional<ObservationProduct>> {
    const auto found = wish.products.find(name);
    if (found == wish.products.end()) return std::optional<ObservationProduct>{};
    return std::optional(*found->second);
  };
  return integrate_survey(*wish.survey, wish.recipe, product_of, wish.transects, wish.params, work);
}

std::string notes_of(const Integrated& done) {
  std::string text;
  const auto add = [&text](const std::vector<std::string>& names, const char* what) {
    for (const std::string& name : names) text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", name, what);
  };
  add(done.left_out, "not integrated: of another sounder, or without a grid of fans and beams");
  add(done.without_pings, "no ping lies in this transect");
  add(done.without_schools, "schools were not measured: its columns of schools are empty");
  if (const std::string extinction = extinction_text(done.tables); !extinction.empty()) {
    text += (text.empty() ? "" : "\n") + extinction;
  }
  return text;
}

}  // namespace

Integration::Integration(Workspace& workspace)
    : params(workspace.integrate),
      effort_rows([this](std::size_t row) { go_to(row, 0.0); }),
      nasc_rows([this](std::size_t row) {
        if (!result_) return;
        const NascRow& cell = result_->tables.nasc[row];
        const auto& effort = result_->tables.effort;
        const auto of = std::find_if(effort.begin(), effort.end(), [&](const EffortRow& unit) {
          return unit.edsu == cell.edsu && unit.transect == cell.transect;
        });
        if (of != effort.end()) go_to(static_cast<std::size_t>(of - effort.begin()), 0.0);
      }),
      workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.transects.changed(), [this] { changed_.tell(); });
  listening_.to(workspace.units.changed(), [this] {
    effort_rows.show_in(workspace_.units());
    nasc_rows.show_in(workspace_.units());
    strata_rows.show_in(workspace_.units());
  });
}

Integration::~Integration() {
  if (work_) work_->cancel();
}

std::string Integration::transects_text() const {
  const SurveyTransects& transects = workspace_.transects();
  return transects.periods.empty() ? std::string("each observation is a transect")
                                   : fmt::format("{} of {}", count_of(transects.periods.size(), "period"),
                                                 printable(transects.file.filename().string()));
}

Result<void> Integration::start() {
  const Document& document = workspace_.document;
  if (running()) return fail(ErrorCode::usage, "echo integration is running already");
  if (document.survey() == nullptr) return fail(ErrorCode::usage, "no survey is open");
  if (!document.survey()->raw_gone.empty()) {
    return fail(ErrorCode::usage,
                "the raw files are not here; echo integration reads every ping: File > Find raw files");
  }
  if (const auto layout = cell_layout(params.values()); !layout) return pass_on(layout);
  tell({});
  waiting_ = true;
  progress_ = {"measuring schools", 0, 0};
  workspace_.document.open_all();
  if (measured()) begin();
  changed_.tell();
  return {};
}

bool Integration::measured() const {
  const Document& document = workspace_.document;
  return document.all_measured() && !document.measuring();
}

void Integration::begin() {
  waiting_ = false;
  const Document& document = workspace_.document;
  Wish wish{document.survey_files(), document.measuring_recipe(), {}, workspace_.transects().periods, params.values()};
  for (std::size_t i = 0; i < wish.survey->observations.size(); ++i) {
    if (auto product = document.product(i)) wish.products[wish.survey->observations[i].name] = std::move(product);
  }
  work_ = std::make_shared<Work>(document.options().threads);
  const auto alive = std::weak_ptr<bool>(alive_);
  work_->set_progress([this, alive, work = std::weak_ptr(work_),
                       give_way = GivesWay(workspace_.document.right_of_way())](
                          std::string_view stage, std::int64_t done, std::int64_t total) mutable {
    workspace_.queue.post_latest("integration", [this, alive, work, now = Progress{std::string(stage), done, total}] {
      if (alive.expired() || !work_ || work.lock() != work_) return;
      progress_ = now;
      changed_.tell();
    });
    give_way();
  });
  (void)runs_.post([this, alive, work = work_, wish = std::move(wish)](const CancelToken&) {
    auto done = [&]() -> Result<Integrated> {
      try {
        return within_memory([&] { return integrated(wish, *work); });
      } catch (const std::exception& failure) {
        return fail(ErrorCode::io, failure.what());  // the window goes on
      }
    }();
    workspace_.queue.post([this, alive, work, shared = std::make_shared<Result<Integrated>>(std::move(done))] {
      if (!alive.expired() && work == work_) end(std::move(*shared));
    });
  });
}

void Integration::end(Result<Integrated> done) {
  work_.reset();
  progress_ = {};
  if (done) {
    told_ = notes_of(*done);
    return put(std::make_shared<const Integrated>(std::move(*done)));
  }
  tell(done.error().code == ErrorCode::cancelled ? "stopped" : to_line(done.error()));
}

void Integration::stop() {
  if (std::exchange(waiting_, false)) {
    progress_ = {};
    return tell("stopped");
  }
  if (work_) work_->cancel();
}

void Integration::hear(DocumentChange change) {
  if (change == DocumentChange::survey) {
    // What runs is of the survey that was open before.
    if (work_) work_->cancel();
    work_.reset();
    waiting_ = false;
    progress_ = {};
    told_.clear();
    return put(nullptr);
  }
  const bool further = change == DocumentChange::measures || change == DocumentChange::progress;
  if (!further || !waiting_) return;
  const Document& document = workspace_.document;
  if (measured()) {
    begin();
    changed_.tell();
  } else if (!document.unmeasured().empty() && !document.measuring()) {
    waiting_ = false;
    progress_ = {};
    tell(document.unmeasured());
  }
}

void Integration::put(std::shared_ptr<const Integrated> result) {
  result_ = std::move(result);
  const IntegrationTables tables = result_ ? result_->tables : IntegrationTables{};
  effort_rows.set(tables.effort);
  nasc_rows.set(tables.nasc);
  strata_rows.set(tables.strata);
  changed_.tell();
}

void Integration::tell(std::string line) {
  told_ = std::move(line);
  changed_.tell();
}

Result<void> Integration::write(const std::filesystem::path& folder) const {
  if (!result_) return fail(ErrorCode::usage, "nothing has been integrated yet");
  if (auto outside = require_outside_raw(*workspace_.document.survey(), folder); !outside) return outside;
  return write_integration(result_->tables, folder);
}

void Integration::go_to(std::size_t effort, double share) {
  const SurveyFiles* survey = workspace_.document.survey();
  if (!result_ || survey == nullptr || effort >= result_->tables.effort.size()) return;
  const EffortRow& unit = result_->tables.effort[effort];
  const auto length = static_cast<double>(unit.last_time_utc - unit.first_time_utc);
  const TimeNs time = unit.first_time_utc + static_cast<TimeNs>(std::clamp(share, 0.0, 1.0) * length);
  // The ping of that time, or the first after it: its observation has a grid, for it was integrated.
  std::optional<std::pair<std::size_t, std::int64_t>> best;
  TimeNs best_time = 0;
  for (std::size_t i = 0; i < survey->observations.size(); ++i) {
    if (!survey->observations[i].grid) continue;
    const auto& pings = survey->observations[i].navigation;
    const auto at = std::lower_bound(pings.begin(), pings.end(), time,
                                     [](const PingNavigation& ping, TimeNs t) { return ping.time < t; });
    if (at == pings.end() || (best && best_time <= at->time)) continue;
    best = {i, at - pings.begin()};
    best_time = at->time;
  }
  if (best) go_to_ping(workspace_, best->first, best->second);
}

void Integration::settle() {
  do {
    workspace_.document.settle();
    runs_.wait();
  } while (workspace_.queue.drain() > 0);
}

}  // namespace sonar
