// SPDX-License-Identifier: Apache-2.0
#include "session/numbers/fish_biomass.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "base/number_text.h"
#include "base/within_memory.h"
#include "pipeline/biomass/length_table.h"
#include "pipeline/biomass/ts_table.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/survey_numbers.h"
#include "session/looks/screen_theme.h"
#include "session/open/survey_schools.h"
#include "view/charts/cause_chart.h"

namespace sonar {
namespace {

struct Wish {
  std::vector<ProductPtr> products;
  std::vector<SurveyNumber> numbers;
  bool all = false;
  FishChoice fish;
  std::shared_ptr<const Integrated> integrated;  ///< null = no strata
  std::map<std::string, double> areas;
  std::filesystem::path areas_file;
};

Result<Biomass> computed(const Wish& wish) {
  std::vector<ObservationProduct> products;
  for (const ProductPtr& product : wish.products) products.push_back(without_voxels(*product));
  auto survey = merge(std::move(products));
  if (!survey) return pass_on(survey);
  number_known(survey->observations, wish.numbers, wish.all);
  StrataInput strata;
  if (wish.integrated) {
    strata = {wish.integrated->tables.effort, wish.integrated->tables.strata, wish.areas};
    if (auto known = require_strata(wish.areas, strata.strata, wish.areas_file); !known) return pass_on(known);
  }
  return biomass_of(survey->observations, wish.fish, strata);
}

/// Products of schools that are open, in the order of the survey.
std::vector<ProductPtr> products_of(const Document& document) {
  std::vector<ProductPtr> products;
  if (document.survey() == nullptr) return products;
  for (std::size_t i = 0; i < document.survey()->observations.size(); ++i) {
    if (auto product = document.product(i)) products.push_back(std::move(product));
  }
  return products;
}

FrequencyBand sonar_of(const std::vector<ProductPtr>& products) {
  FrequencyBand band;
  for (const ProductPtr& product : products) {
    const FrequencyBand own = frequencies_of({product.get(), 1});
    if (!(own.to_khz > 0.0)) continue;
    band.from_khz = band.to_khz > 0.0 ? std::min(band.from_khz, own.from_khz) : own.from_khz;
    band.to_khz = std::max(band.to_khz, own.to_khz);
  }
  return band;
}

}  // namespace

FishBiomass::FishBiomass(Workspace& workspace, Integration& integration)
    : params(workspace.fish),
      school_rows([this](std::size_t row) { select(row); }),
      workspace_(workspace),
      integration_(integration) {
  (void)read_relations({});
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::survey) put(nullptr, {});
    if (change == DocumentChange::survey || change == DocumentChange::measures) again();
  });
  listening_.to(params, [this] { again(); });
  listening_.to(workspace.units.changed(), [this] {
    school_rows.show_in(workspace_.units());
    strata_rows.show_in(workspace_.units());
  });
  listening_.to(integration.changed(), [this] {
    if (integration_.result() != integrated_) again();
  });
}

void FishBiomass::begin() {
  begun_ = true;
  choose_known_relation();
  if (workspace_.document.survey() != nullptr) workspace_.document.open_all();
  again();
}

Result<void> FishBiomass::read_relations(const std::filesystem::path& file) {
  auto table = read_ts_table(file);
  if (!table) return pass_on(table);
  relations_ = std::move(*table);
  relations_file_ = file;
  spans_.clear();
  choose_known_relation();
  again();
  changed_.tell();
  return {};
}

/// Preferences may have kept one of a table that is not open.
void FishBiomass::choose_known_relation() {
  FishParams now = params.values();
  if (ts_relation_named(relations_, now.relation)) return;
  now.relation = relations_.front().name;
  params.assign(std::move(now));
}

Result<void> FishBiomass::read_lengths(const std::filesystem::path& file) {
  auto lengths = read_fish_lengths(file);
  if (!lengths) return pass_on(lengths);
  lengths_ = std::move(*lengths);
  lengths_file_ = file;
  FishParams now = params.values();
  now.lengths = LengthsFrom::table;
  params.assign(std::move(now));
  again();
  return {};
}

Result<void> FishBiomass::read_areas(const std::filesystem::path& file) {
  auto areas = read_stratum_areas(file);
  if (!areas) return pass_on(areas);
  areas_ = std::move(*areas);
  areas_file_ = file;
  again();
  return {};
}

bool FishBiomass::spans(const std::string& relation) const {
  if (const auto own = spans_.find(relation); own != spans_.end()) return own->second;
  const auto chosen = ts_relation_named(relations_, params.values().relation);
  if (!chosen) return false;
  const auto usual = ts_choices(relations_, *chosen, sonar_.from_khz, sonar_.to_khz);
  return std::any_of(usual.begin(), usual.end(), [&](const TsRelation& one) { return one.name == relation; });
}

void FishBiomass::set_spans(const std::string& relation, bool on) {
  if (spans(relation) == on) return;
  spans_[relation] = on;
  again();
}

Result<FishChoice> FishBiomass::chosen_fish() const {
  const FishParams& of = params.values();
  auto chosen = ts_relation_named(relations_, of.relation);
  if (!chosen) return pass_on(chosen);
  FishChoice fish;
  // With a hand's own aspect the table's relation stays a choice: the band tells what the model makes of it.
  for (const TsRelation& one : relations_) {
    if (spans(one.name)) fish.choices.push_back(one);
  }
  if (of.aspect == AspectModel::none) chosen->directivity = {};
  if (of.aspect == AspectModel::own) {
    chosen->directivity = {of.line_share, of.any_aspect_share, of.heading_sd_deg, of.tilt_sd_deg};
  }
  fish.chosen = std::move(*chosen);
  if (of.lengths == LengthsFrom::table) {
    if (!lengths_)
      return fail(ErrorCode::usage, "open a table of lengths (CSV length_cm,count), or tell mean and deviation");
    fish.lengths = *lengths_;
  } else {
    fish.lengths = normal_lengths(of.mean_length_cm, of.sd_length_cm);
  }
  fish.weight = {of.weight_a_g > kNoWeight_g ? of.weight_a_g : kUnknown, of.weight_b};
  fish.species = of.species;
  return fish;
}

/// Many choices change at once: figures follow once.
void FishBiomass::again() {
  if (!begun_) return;
  workspace_.queue.post_latest("biomass", [this, alive = std::weak_ptr<bool>(alive_)] {
    if (!alive.expired()) compute();
  });
}

void FishBiomass::compute() {
  const Document& document = workspace_.document;
  Wish wish;
  wish.products = products_of(document);
  integrated_ = integration_.result();
  if (wish.products.empty()) {
    if (!document.unmeasured().empty()) return put(nullptr, document.unmeasured());
    return put(nullptr, document.survey() == nullptr ? "" : "no schools are measured yet");
  }
  sonar_ = sonar_of(wish.products);
  auto fish_chosen = chosen_fish();
  if (!fish_chosen) return put(nullptr, to_line(fish_chosen.error()));
  wish.fish = std::move(*fish_chosen);
  wish.numbers = document.survey_numbers();
  wish.all = document.all_measured();
  wish.integrated = integrated_;
  wish.areas = areas_;
  wish.areas_file = areas_file_;
  const std::size_t unmeasured = wish.all ? 0 : document.survey()->observations.size() - wish.products.size();
  (void)background_.post_latest([this, alive = std::weak_ptr<bool>(alive_), wish = std::move(wish), number = ++wishes_,
                                 unmeasured](const CancelToken&) {
    auto done = [&]() -> Result<Biomass> {
      try {
        return within_memory([&] { return computed(wish); });
      } catch (const std::exception& failure) {
        return fail(ErrorCode::io, failure.what());  // the window goes on
      }
    }();
    workspace_.queue.post(
        [this, alive, number, unmeasured, shared = std::make_shared<Result<Biomass>>(std::move(done))] {
          if (alive.expired() || number != wishes_) return;
          if (!*shared) return put(nullptr, to_line(shared->error()));
          const std::string notes = notes_of(**shared, unmeasured);
          put(std::make_shared<const Biomass>(std::move(**shared)), notes);
        });
  });
}

std::string FishBiomass::notes_of(const Biomass& done, std::size_t unmeasured) const {
  std::string text;
  const auto add = [&text](bool there, const std::string& line) {
    if (there) text += (text.empty() ? "" : "\n") + line;
  };
  const auto schools = [](std::int64_t n) { return count_of(static_cast<std::size_t>(n), "school"); };
  const TsRelation& chosen = done.fish.chosen;
  add(unmeasured > 0, count_of(unmeasured, "observation") + " not measured yet: schools there are not counted");
  add(chosen.frequency_from_khz > done.sonar.to_khz || chosen.frequency_to_khz < done.sonar.from_khz,
      fmt::format("the relation was found at other frequencies than the sonar's {:.4g} to {:.4g} kHz",
                  done.sonar.from_khz, done.sonar.to_khz));
  add(chosen.aspect == TsAspect::dorsal, "the relation is of fish seen from above; a sideways beam sees their sides");
  add(done.without_course > 0 && chosen.directivity.known(),
      schools(done.without_course) + " without a known course: fish of any heading are meant there");
  add(done.cut > 0, schools(done.cut) + " cut off by an edge in every ping: more fish than counted");
  add(done.without_numbers > 0, schools(done.without_numbers) + " without numbers: backscatter or place is unknown");
  add(!done.integrated, "strata follow when echo integration has run: only the schools that were seen are counted");
  return text;
}

std::string FishBiomass::relation_text() const {
  const auto chosen = ts_relation_named(relations_, params.values().relation);
  return chosen ? ts_text(*chosen) : to_line(chosen.error());
}

void FishBiomass::select(std::size_t row) {
  const School clicked = school_of(result_->schools.at(row));
  if (std::exchange(selected_, clicked) != clicked) changed_.tell();
}

std::optional<std::size_t> FishBiomass::selected_row() const {
  if (!result_ || !selected_) return std::nullopt;
  const auto& rows = result_->schools;
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const BiomassRow& row) { return school_of(row) == *selected_; });
  if (found == rows.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.begin());
}

std::pair<std::string, BandCauses> FishBiomass::causes() const {
  if (!result_) return {};
  const auto at = selected_row();
  if (!at) return {"All schools that were seen", result_->causes};
  return {fmt::format("School {} of {}", selected_->school_id, selected_->observation), result_->school_causes[*at]};
}

void FishBiomass::put(std::shared_ptr<const Biomass> result, std::string told) {
  ++wishes_;  // what is on its way is of choices before
  result_ = std::move(result);
  told_ = std::move(told);
  if (!selected_row()) selected_.reset();
  school_rows.set(result_ ? result_->schools : std::vector<BiomassRow>{});
  strata_rows.set(result_ ? result_->strata : std::vector<BiomassStratumRow>{});
  changed_.tell();
}

Result<void> FishBiomass::write(const std::filesystem::path& folder) const {
  if (!result_) return fail(ErrorCode::usage, told_.empty() ? "there are no figures yet" : told_);
  if (auto outside = require_outside_raw(*workspace_.document.survey(), folder); !outside) return outside;
  return write_biomass(*result_, folder);
}

void FishBiomass::settle() {
  do {
    workspace_.document.settle();
    background_.wait();
  } while (workspace_.queue.drain() > 0);
}

CausePicture::CausePicture(Workspace& workspace, FishBiomass& fish) : LivePicture(workspace), fish_(fish) {
  listening_.to(fish.changed(), [this] { update(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
}

LivePicture::Build CausePicture::build(const PictureLook& look) {
  if (!fish_.result()) return {};
  const auto [title, causes] = fish_.causes();
  const auto bar = [](const char* name, const CauseSpan& span) { return CauseBar{name, span.down_db, span.up_db, {}}; };
  std::vector<CauseBar> bars{bar("fading", causes.fading), bar("calibration", causes.calibration),
                             bar("lengths", causes.lengths), bar("course", causes.course),
                             bar("TS relation", causes.relation)};
  const auto& choices = fish_.result()->fish.choices;
  for (std::size_t i = 0; i < causes.by_choice_db.size() && i < choices.size(); ++i) {
    bars.back().marks.push_back({choices[i].name, causes.by_choice_db[i]});
  }
  return [look, name = title, bars = std::move(bars)](PixelSize size, const CancelToken&,
                                                      const Show& show) -> Result<void> {
    auto frame = cause_chart(name, bars, size, dock_theme(size, look));
    if (!frame) return pass_on(frame);
    show({std::move(*frame), std::nullopt, nullptr});
    return {};
  };
}

}  // namespace sonar
