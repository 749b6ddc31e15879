// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/render_options.h"

namespace sonar {
namespace {

/// Options that not every kind of picture has a use for, and the kinds that have.
struct Suits {
  const char* option;
  std::string_view kinds;  ///< between blanks; one that ends with - stands for all that begin so
};
constexpr std::string_view kOfPing = "slice- volume propagation observation-map";
constexpr std::string_view kOfSv = "slice- volume timeline";
constexpr std::array<Suits, 48> kSuits{{
    {"--observation", "slice- volume propagation observation-map timeline"},
    {"--ping", kOfPing},
    {"--refused", "slice- volume observation-map timeline"},
    {"--filtered", kOfSv},
    {"--unfiltered", kOfSv},
    {"--map", kOfSv},
    {"--quick", "survey-map"},
    {"--low-db", "slice- volume timeline survey-map"},
    {"--span-db", "slice- volume timeline survey-map"},
    {"--threshold-db", kOfSv},
    {"--transfer-function", kOfSv},
    {"--fan", "slice-top"},
    {"--beam", "slice-side"},
    {"--range-m", "slice-range"},
    {"--depth-m", "slice-plane"},
    {"--bearing-deg", "slice-plane"},
    {"--through", "slice-plane"},
    {"--point", "slice-plane"},
    {"--normal", "slice-plane"},
    {"--removed", "slice-"},
    {"--weak", "slice-"},
    {"--weak-db", "slice-"},
    {"--north-up", "slice-top slice-plane"},
    {"--grid", "slice-"},
    {"--mode", "volume"},
    {"--first-hit-db", "volume"},
    {"--lighting", "volume"},
    {"--eye", "volume"},
    {"--target", "volume"},
    {"--orbit-deg", "volume"},
    {"--rise-deg", "volume"},
    {"--zoom", "volume"},
    {"--masks-alone", "volume"},
    {"--mask-outline", "volume"},
    {"--core", kOfPing},
    {"--fuzzy", "volume"},
    {"--table-entries", "volume"},
    {"--frames", "volume"},
    {"--seconds", "volume"},
    {"--renderer", "volume"},
    {"--no-context", "volume"},
    {"--ship-length-m", "volume"},
    {"--depth-raster", "volume survey-map"},
    {"--neighbours", "propagation"},
    {"--side", "propagation"},
    {"--along-log", "timeline"},
    {"--maximum", "timeline"},
    {"--whole-survey", "timeline"},
}};

/// Names of the kinds that `kinds` stands for.
std::vector<std::string> named_kinds(std::string_view kinds) {
  std::vector<std::string> out;
  for (const PictureKindInfo& kind : picture_kinds()) {
    for (std::size_t at = 0; at < kinds.size();) {
      const std::size_t end = std::min(kinds.find(' ', at), kinds.size());
      const std::string_view one = kinds.substr(at, end - at);
      if (one.ends_with('-') ? kind.name.starts_with(one) : kind.name == one) out.emplace_back(kind.name);
      at = end + 1;
    }
  }
  return out;
}

}  // namespace

std::optional<UnsuitedOption> unsuited_option(const CLI::App& verb, const std::string& kind) {
  for (const Suits& one : kSuits) {
    if (verb.get_option(one.option)->count() == 0) continue;
    const std::vector<std::string> kinds = named_kinds(one.kinds);
    if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) continue;
    return UnsuitedOption{one.option, fmt::format("no option of {}; it suits {}", kind, fmt::join(kinds, ", "))};
  }
  if (kind == "timeline" && verb.get_option("--whole-survey")->count() > 0 &&
      verb.get_option("--observation")->count() > 0) {
    return UnsuitedOption{"--observation", "not together with --whole-survey, which draws all of them"};
  }
  const auto given = [&](const char* option) { return verb.get_option(option)->count() > 0; };
  if (given("--masks-alone") && given("--no-masks")) {
    return UnsuitedOption{"--masks-alone", "not together with --no-masks, which leaves nothing to draw"};
  }
  if (given("--mask-outline") && (given("--no-masks") || given("--masks-alone"))) {
    return UnsuitedOption{"--mask-outline", "not together with --no-masks or --masks-alone: it is drawn round both"};
  }
  return std::nullopt;
}

}  // namespace sonar
