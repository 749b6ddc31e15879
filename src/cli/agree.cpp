// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/agree.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/verb.h"
#include "io/csv.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/plan.h"

namespace sonar {
namespace {

struct AgreeOptions {
  std::string a;
  std::string b;
  std::string out;
  bool json = false;
};

/// Nothing is written where raw files lie: those that were run, or those of a folder above.
Result<void> require_outside(const AgreeOptions& options) {
  for (const std::string& folder : {options.a, options.b}) {
    const auto run_on = planned_survey(folder);
    if (!run_on) return pass_on(run_on);
    if (auto outside = require_outside_raw(*run_on, options.out); !outside) return outside;
  }
  return require_not_beneath_raw(options.out);
}

int run_agree(const AgreeOptions& options) {
  if (!options.out.empty()) {
    if (auto outside = require_outside(options); !outside) return report(outside.error());
  }
  const auto a = read_result_side(options.a);
  if (!a) return report(a.error());
  const auto b = read_result_side(options.b);
  if (!b) return report(b.error());
  if (auto one = require_one_survey(*a, options.a, *b, options.b); !one) return report(one.error());
  const Agreement agreement = agree(*a, *b);
  if (!options.out.empty()) {
    const auto table = std::filesystem::path(options.out) / "agreement.csv";
    if (auto written = write_csv_rows(table, agreement.rows); !written) return report(written.error());
    if (!options.json) fmt::print("{}\n", table.string());
  }
  fmt::print("{}", options.json ? agreement_json(agreement) : agreement_text(agreement));
  return kExitDone;
}

}  // namespace

void add_agree(CLI::App& app, VerbRunner& run) {
  const auto options = std::make_shared<AgreeOptions>();
  CLI::App* verb = app.add_subcommand("agree", "Tell how well two readers' results of one survey agree");
  verb->add_option("A", options->a, "Work folder of one reader, or of the program alone")
      ->required()
      ->check(named_path());
  verb->add_option("B", options->b, "Work folder of the other, of the same raw files")->required()->check(named_path());
  verb->add_option("-o,--out", options->out, "Folder for agreement.csv")->check(named_folder());
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return run_agree(*options); }; });
}

}  // namespace sonar
