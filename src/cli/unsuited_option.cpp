// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_options.h"

namespace sonar {

std::optional<UnsuitedOption> unsuited_option(const CLI::App& verb, const RenderArguments& arguments) {
  const auto given = [&](const std::string& option) { return verb.get_option(option)->count() > 0; };
  for (const DescribedFlags::Made& one : arguments.suits) {
    if (!given(one.flag)) continue;
    const std::vector<std::string> kinds = kinds_suited(one.suits);
    if (std::find(kinds.begin(), kinds.end(), arguments.kind) != kinds.end()) continue;
    return UnsuitedOption{one.flag,
                          fmt::format("no option of {}; it suits {}", arguments.kind, fmt::join(kinds, ", "))};
  }
  if (arguments.kind == "timeline" && given("--whole-survey") && given("--observation")) {
    return UnsuitedOption{"--observation", "not together with --whole-survey, which draws all of them"};
  }
  if (arguments.kind == "chart" && given("--no-masks")) {
    return UnsuitedOption{"--no-masks", "no option of chart, which shows nothing but schools"};
  }
  if (given("--masks-alone") && given("--no-masks")) {
    return UnsuitedOption{"--masks-alone", "not together with --no-masks, which leaves nothing to draw"};
  }
  if (given("--tint") && given("--no-masks")) {
    return UnsuitedOption{"--tint", "not together with --no-masks"};
  }
  return std::nullopt;
}

}  // namespace sonar
