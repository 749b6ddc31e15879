// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "io/csv.h"
#include "io/product_file.h"
#include "pipeline/integrate/transects.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/observe.h"
#include "pipeline/stages/taken_background.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/run.h"
#include "school/integrate/integrate_ping.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// The schools of one ping.
struct PingSchools {
  std::vector<const PingMask*> masks;
  std::vector<std::int64_t> ids;
};

/// By ping_index; those that a human rejected are left out.
std::map<std::int64_t, PingSchools> schools_by_ping(const ObservationProduct& product) {
  std::map<std::int64_t, PingSchools> by_ping;
  for (const SchoolMask& one : product.masks) {
    const auto school = std::find_if(product.schools.begin(), product.schools.end(),
                                     [&](const SchoolRow& s) { return s.school_id == one.school_id; });
    if (school != product.schools.end() && school->status == "rejected") continue;
    by_ping[one.ping_index].masks.push_back(&one.mask);
    by_ping[one.ping_index].ids.push_back(one.school_id);
  }
  return by_ping;
}

/// One observation's pings into the sums of their units.
class ObservationIntegral {
 public:
  ObservationIntegral(Engine& engine, const std::optional<ObservationProduct>& product, const CellLayout& layout)
      : engine_(engine), product_(product), layout_(layout) {
    if (product_) schools_ = schools_by_ping(*product_);
  }

  Result<void> add(const ObservationEffort& effort, std::span<const EffortUnit> units, std::span<UnitSums> sums,
                   Work& work) {
    std::vector<std::int64_t> pings;
    for (std::size_t i = 0; i < effort.unit.size(); ++i) {
      const auto ping = static_cast<std::int64_t>(i);
      if (units[effort.unit[i]].type == EffortType::transect && !is_bad(ping)) pings.push_back(ping);
    }
    const std::size_t at_once = 2 * static_cast<std::size_t>(std::max(1, work.threads()));
    for (std::size_t block = 0; block < pings.size(); block += at_once) {
      std::vector<std::optional<PingCells>> made(std::min(at_once, pings.size() - block));
      work.for_each(std::ssize(made), [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        made[at] = cells_of(pings[block + at]);
      });
      if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      if (auto refused = engine_.refusal(); !refused) return refused;
      for (std::size_t i = 0; i < made.size(); ++i) {
        const std::int64_t ping = pings[block + i];
        if (made[i]) take(ping, *made[i], sums[effort.unit[static_cast<std::size_t>(ping)]]);
      }
      work.progress("integrate", static_cast<std::int64_t>(block + made.size()), std::ssize(pings));
    }
    return {};
  }

 private:
  /// A recording may have gone on since its product was made.
  [[nodiscard]] bool in_product(std::int64_t ping) const { return product_ && ping < std::ssize(product_->pings); }
  [[nodiscard]] bool is_bad(std::int64_t ping) const {
    return engine_.is_bad(ping) || (in_product(ping) && product_->pings[static_cast<std::size_t>(ping)].bad);
  }

  /// Empty of a damaged ping.
  std::optional<PingCells> cells_of(std::int64_t ping) {
    const auto staged = engine_.staged(ping);
    if (!staged) return std::nullopt;
    const ObservationFiles& observation = engine_.observation();
    IntegrationInput input;
    input.sv = staged->sv.counts.view();
    input.flags = staged->sv.flags.view();
    input.filtered = std::as_const(*staged->filtered).counts.view();
    input.sector = &engine_.sector();
    input.grid = &engine_.grid();
    input.background = staged->background();
    input.placement = engine_.placement(ping);
    input.seabed = staged->seabed.found ? &staged->seabed : nullptr;
    input.pulse_m = observation.sound_speed_mps * observation.pulse_length_s / 2.0;
    if (const auto of_ping = schools_.find(ping); of_ping != schools_.end()) input.schools = of_ping->second.masks;
    input.extinction = engine_.recipe().measure.extinction;
    return integrate_ping(input, layout_);
  }

  void take(std::int64_t ping, const PingCells& cells, UnitSums& sums) const {
    sums.add(cells);
    sums.extinction_corrected = engine_.recipe().measure.extinction.correct;
    if (!in_product(ping)) sums.schools_known = false;
    const auto of_ping = schools_.find(ping);
    if (of_ping == schools_.end()) return;
    for (const std::int64_t id : of_ping->second.ids) sums.schools.emplace(product_->observation, id);
  }

  Engine& engine_;
  const std::optional<ObservationProduct>& product_;
  const CellLayout& layout_;
  std::map<std::int64_t, PingSchools> schools_;
};

/// OUT's products, read when they are asked for.
ProductOf products_in(const fs::path& out) {
  return [out](const std::string& observation) -> Result<std::optional<ObservationProduct>> {
    const fs::path path = product_path(out, observation);
    std::error_code absent;
    if (!fs::exists(path, absent)) return std::optional<ObservationProduct>{};
    auto product = read_product(path);
    if (!product) return pass_on(product);
    return std::optional(std::move(*product));
  };
}

/// In reduced files most of the water was left out, and reads as silence.
Result<void> require_whole_pings(const SurveyFiles& survey, const Effort& effort) {
  for (const ObservationEffort& own : effort.observations) {
    for (const SurveyPing& ping : survey.observations[own.observation].pings) {
      for (const SurveyPing& part : survey.parts(ping)) {
        if (!survey.entry(part).reduced) continue;
        return fail(ErrorCode::unsupported,
                    "a reduced raw file (raw-reduced) lacks the water between schools; expected the raw files that it "
                    "was made from",
                    {.file = survey.files[part.file].path.string()});
      }
    }
  }
  return {};
}

Result<void> require_transects(const Effort& effort, std::span<const Transect> transects) {
  const auto sailed = [](const EffortUnit& unit) { return unit.type == EffortType::transect; };
  if (transects.empty() || std::any_of(effort.units.begin(), effort.units.end(), sailed)) return {};
  TimeNs first = std::numeric_limits<TimeNs>::max();
  TimeNs last = std::numeric_limits<TimeNs>::min();
  for (const EffortUnit& unit : effort.units) {
    const auto [least, most] = std::minmax_element(unit.times.begin(), unit.times.end());
    first = std::min(first, *least);
    last = std::max(last, *most);
  }
  return fail(ErrorCode::mismatch,
              fmt::format("no transect of the transects table has a ping; expected periods between {} and {}",
                          iso_time(first), iso_time(last)));
}

/// That of the run whose products lie in OUT.
Result<Recipe> recipe_in(const IntegrateOptions& options) {
  const auto chosen = [&] { return options.recipe ? options.recipe() : Result<Recipe>(Recipe{}); };
  std::error_code absent;
  if (!fs::exists(options.out / "products", absent)) return chosen();
  const auto files = product_files(options.out);
  if (!files) return pass_on(files);
  if (files->empty()) return chosen();
  if (options.recipe) {
    return fail(ErrorCode::usage,
                "holds products of a run, under whose recipe the survey is integrated; no other can be given",
                {.file = options.out.string()});
  }
  const auto key = read_product_key(files->front());
  if (!key) return pass_on(key);
  return recipe_from_text(key->recipe_json);
}

}  // namespace

Result<Integrated> integrate_survey(const SurveyFiles& survey, const Recipe& recipe, const ProductOf& product_of,
                                    std::span<const Transect> transects, const IntegrateParams& params, Work& work) {
  const auto layout = cell_layout(params);
  if (!layout) return pass_on(layout);
  const Effort effort = sailed_effort(survey, transects, params.edsu_nmi * kMetresPerNauticalMile);
  if (effort.observations.empty()) {
    return fail(ErrorCode::unsupported, "no observation has a grid of fans and beams: there is nothing to integrate");
  }
  if (auto whole = require_whole_pings(survey, effort); !whole) return pass_on(whole);
  if (auto some = require_transects(effort, transects); !some) return pass_on(some);
  std::vector<UnitSums> sums(effort.units.size());
  Integrated out;
  out.without_pings = effort.without_pings;
  out.left_out = effort.left_out;
  for (const ObservationEffort& own : effort.observations) {
    const ObservationFiles& observation = survey.observations[own.observation];
    const auto product = product_of(observation.name);
    if (!product) return pass_on(product);
    Engine engine(survey, observation, recipe);
    if (*product && !has_pings(**product, source_of(observation), datagram_times(survey, observation))) {
      return fail(
          ErrorCode::mismatch,
          fmt::format("{}: the product is of other pings than the raw files'; run them again", observation.name));
    }
    if (!*product) out.without_schools.push_back(observation.name);
    auto background =
        *product ? take_background(engine, **product, work) : engine.estimate_background(0, engine.pings() - 1, work);
    if (!background) return pass_on(background);
    ObservationIntegral integral(engine, *product, *layout);
    if (auto added = integral.add(own, effort.units, sums, work); !added) return pass_on(added);
  }
  out.tables = integration_tables(effort.units, sums, *layout);
  return out;
}

Result<void> write_integration(const IntegrationTables& tables, const fs::path& folder) {
  auto written = write_csv_rows(folder / "effort.csv", tables.effort);
  if (written) written = write_csv_rows(folder / "nasc.csv", tables.nasc);
  if (written) written = write_csv_rows(folder / "strata.csv", tables.strata);
  return written;
}

Result<Integrated> integrate_folder(const IntegrateOptions& options, Work& work) {
  std::vector<Transect> transects;
  if (!options.transects.empty()) {
    auto told = read_transects(options.transects);
    if (!told) return pass_on(told);
    transects = std::move(*told);
  }
  const auto recipe = recipe_in(options);
  if (!recipe) return pass_on(recipe);
  const auto survey = open_survey(options.survey, recipe->survey, recipe->navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  if (auto some = require_files(*survey, options.survey); !some) return pass_on(some);
  if (auto outside = require_outside_raw(*survey, options.out); !outside) return pass_on(outside);
  auto done = integrate_survey(*survey, *recipe, products_in(options.out), transects, options.params, work);
  if (!done) return pass_on(done);
  if (auto written = write_integration(done->tables, options.out); !written) return pass_on(written);
  return done;
}

}  // namespace sonar
