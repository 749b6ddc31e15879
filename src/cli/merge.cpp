// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/merge.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/merged_text.h"
#include "cli/named_path.h"
#include "cli/progress.h"
#include "cli/verb.h"
#include "io/atomic_file.h"

namespace sonar {
namespace {

int run_merge(const std::string& out, bool json) {
  Work work(1);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const auto merged = merge_folder(out, {}, work);
  clear_progress();
  if (!merged) return report(merged.error());
  for (const std::string& line : note_lines(*merged)) print_note(line);
  if (auto told = print_merge(*merged, out, json); !told) return report(told.error());
  for (const MergeFailure& failure : merged->failures) {
    const std::string of = failure.observation ? *failure.observation + ": " : "";
    print_error(of + failure.text);
  }
  for (const std::string& name : merged->missing) {
    print_error(fmt::format("{}: planned, but there is no product", name));
  }
  return merged->complete() ? kExitDone : kExitPartly;
}

}  // namespace

Result<void> print_merge(const MergeReport& report, const std::filesystem::path& out, bool json) {
  if (!json) {
    fmt::print("{}", merge_text(report, out));
    return {};
  }
  const auto text = read_file(out / "survey.json");
  if (!text) return pass_on(text);
  fmt::print("{}", *text);
  return {};
}

void add_merge(CLI::App& app, VerbRunner& run) {
  const auto out = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* verb = app.add_subcommand("merge", "Merge the products of a work folder into tables and the survey map");
  verb->add_option("OUT", *out, "Work folder that holds products/")->required()->check(named_path());
  verb->add_flag("--json", *json, "Print what stands in OUT/survey.json instead of a text");
  verb->callback([out, json, &run] { run = [out, json] { return run_merge(*out, *json); }; });
}

}  // namespace sonar
