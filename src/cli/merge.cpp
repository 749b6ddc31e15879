// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/merge.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/progress.h"
#include "cli/verb.h"

namespace sonar {
namespace {

int run_merge(const std::string& out) {
  Work work(1);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const auto merged = merge_folder(out, {}, work);
  clear_progress();
  if (!merged) return report(merged.error());
  for (const std::string& line : note_lines(*merged)) fmt::print(stderr, "{}\n", line);
  fmt::print("{}", merge_text(*merged, out));
  for (const MergeFailure& failure : merged->failures) {
    const std::string of = failure.observation ? *failure.observation + ": " : "";
    fmt::print(stderr, "sonarx: {}{}\n", of, failure.text);
  }
  for (const std::string& name : merged->missing) {
    fmt::print(stderr, "sonarx: {}: planned, but there is no product\n", name);
  }
  return merged->complete() ? kExitDone : kExitPartly;
}

}  // namespace

void add_merge(CLI::App& app, VerbRunner& run) {
  const auto out = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("merge", "Put the products of a work folder together: tables and survey map");
  verb->add_option("OUT", *out, "Work folder that holds products/")->required()->check(named_path());
  verb->callback([out, &run] { run = [out] { return run_merge(*out); }; });
}

}  // namespace sonar
