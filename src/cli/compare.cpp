// SPDX-License-Identifier: Apache-2.0
#include "pipeline/compare.h"

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
  const auto difference =
      compare_paths(options.a, options.b, options.ignore_provenance ? Compared::content : Compared::everything);
  if (!difference) return report(difference.error());
  if (difference->empty()) {
    fmt::print("equal\n");
    return kExitDone;
  }
  fmt::print("different: {}\n", *difference);
  return kExitFailed;
}

}  // namespace

void add_compare(CLI::App& app, VerbRunner& run) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* verb = app.add_subcommand("compare", "Two products or results: equal, or the first difference");
  verb->add_option("A", options->a, "A product (.nc), a table (.csv) or a work folder")->required();
  verb->add_option("B", options->b, "The same kind")->required();
  verb->add_flag("--ignore-provenance", options->ignore_provenance,
                 "Only what products say, not how they were made (recipe, versions, history, input files)");
  verb->callback([options, &run] { run = [options] { return run_compare(*options); }; });
}

}  // namespace sonar
