// SPDX-License-Identifier: Apache-2.0
#include "pipeline/score/score.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/verb.h"

namespace sonar {
namespace {

struct ScoreOptions {
  std::string out;
  std::string truth;
  bool json = false;
};

int run_score(const ScoreOptions& options) {
  const auto found = read_result_side(options.out);
  if (!found) return report(found.error());
  const auto truth = read_truth_side(options.truth);
  if (!truth) return report(truth.error());
  if (!share_pings(*found, *truth)) {
    return report(
        {ErrorCode::mismatch, fmt::format("has no ping at the time of any ping of {}", options.truth), {options.out}});
  }
  const Score result = score(*found, *truth);
  fmt::print("{}", options.json ? score_json(result) : score_text(result));
  for (const std::string& observation : truth->missing) {
    report({ErrorCode::not_found,
            fmt::format("{}.nc is missing though the tables name it; its schools take no part", observation),
            {options.truth}});
  }
  return truth->missing.empty() ? kExitDone : kExitPartly;
}

}  // namespace

void add_score(CLI::App& app, VerbRunner& run) {
  const auto options = std::make_shared<ScoreOptions>();
  CLI::App* verb = app.add_subcommand("score", "Tell how well a result matches a known truth");
  verb->add_option("OUT", options->out, "Work folder of a run")->required()->check(named_path());
  verb->add_option("--truth", options->truth, "Folder with the truth, as simulate writes it")
      ->required()
      ->check(named_path("FOLDER"));
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return run_score(*options); }; });
}

}  // namespace sonar
