// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/compare.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/verb.h"

namespace sonar {
namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  bool ignore_provenance = false;
};

int run_compare(const CompareOptions& options) {
  Work work(1);
  const CancelOnInterrupt watch(work);
  const Compared what = options.ignore_provenance ? Compared::content : Compared::everything;
  const auto told = compare_paths(options.a, options.b, what, work);
  if (!told) return report(told.error());
  if (!told->difference.empty()) {
    fmt::print("different: {}\n", told->difference);
    return kExitFailed;
  }
  if (told->tolerated == 0) {
    fmt::print("equal\n");
  } else {
    fmt::print("equal within {:g} of each number, not to the last digit: {} differ, the first {}\n", kEqualRelative,
               told->tolerated, told->first_tolerated);
  }
  return kExitDone;
}

}  // namespace

void add_compare(CLI::App& app, VerbRunner& run) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* verb =
      app.add_subcommand("compare", "Tell whether two products or results are equal, or where they differ first");
  verb->add_option("A", options->a, "A product (.nc), a table (.csv) or a work folder")->required();
  verb->add_option("B", options->b, "The same kind")->required();
  verb->add_flag("--ignore-provenance", options->ignore_provenance,
                 "Only what products say, not how they were made (recipe, versions, history, input files)");
  verb->callback([options, &run] { run = [options] { return run_compare(*options); }; });
}

}  // namespace sonar
