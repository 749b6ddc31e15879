// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_options.h"
#include "io/recordings.h"
#include "publish/reports/report_html.h"

namespace sonar {

namespace {

/// What goes against the way that a movie moves, or the paper of a report.
std::optional<UnsuitedOption> unsuited_in_whole(const CLI::App& verb, const RenderArguments& arguments) {
  const auto given = [&](const std::string& option) { return verb.get_option(option)->count() > 0; };
  if (arguments.kind == "report") {
    for (const char* option : {"--size", "--schools"}) {
      if (given(option))
        return UnsuitedOption{option, "no option of report, which is on A4 pages and of the whole survey"};
    }
    if (arguments.whole && !has_ending(arguments.out, ".pdf") && !is_report_html(arguments.out)) {
      return UnsuitedOption{"--whole", "goes with a name that ends in .pdf or .html; expected one with --out"};
    }
  }
  if (arguments.kind != "movie") return std::nullopt;
  for (const char* option : {"--reference", "--difference"}) {
    if (given(option)) return UnsuitedOption{option, "no option of movie; it suits single pictures"};
  }
  const bool turntable = arguments.picture.kind.movie.motion == MovieMotion::turntable;
  if (given("--ping") && !turntable) {
    return UnsuitedOption{"--ping", "goes with --motion turntable; other movies go from --first-ping to --last-ping"};
  }
  for (const char* option : {"--first-ping", "--last-ping", "--between"}) {
    if (given(option) && turntable)
      return UnsuitedOption{option, "not together with --motion turntable, which shows one --ping"};
  }
  for (const char* option : {"--turns-deg", "--turntable-pictures"}) {
    if (given(option) && !turntable) return UnsuitedOption{option, "goes with --motion turntable"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<UnsuitedOption> unsuited_option(const CLI::App& verb, const RenderArguments& arguments) {
  const auto given = [&](const std::string& option) { return verb.get_option(option)->count() > 0; };
  const std::string drawn = drawn_kind_name(arguments);
  const std::string drawn_name = arguments.kind == "movie" ? "a movie of " + drawn : arguments.kind;
  for (const DescribedFlags::Made& one : arguments.suits) {
    if (!given(one.flag)) continue;
    const std::vector<std::string> kinds = kinds_suited(one.suits);
    if (std::find(kinds.begin(), kinds.end(), arguments.kind) != kinds.end()) continue;
    // A movie takes what the pictures take that it is made of.
    if (arguments.kind == "movie" && std::find(kinds.begin(), kinds.end(), drawn) != kinds.end()) continue;
    return UnsuitedOption{one.flag, fmt::format("no option of {}; it suits {}", drawn_name, fmt::join(kinds, ", "))};
  }
  if (auto unsuited = unsuited_in_whole(verb, arguments)) return unsuited;
  if (arguments.kind == "timeline" && given("--whole-survey") && given("--observation")) {
    return UnsuitedOption{"--observation", "not together with --whole-survey, which draws all of them"};
  }
  if (arguments.kind == "echogram" && given("--of-fan") && given("--beam")) {
    return UnsuitedOption{"--beam", "not together with --of-fan, which takes all beams of the fan"};
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
