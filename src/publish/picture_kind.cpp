// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_kind.h"

#include <algorithm>
#include <array>

namespace sonar {

std::span<const PictureKindInfo> picture_kinds() {
  static constexpr std::array<PictureKindInfo, 17> kinds{{
      {"slice-top", "one fan from above, every cell with its own value"},
      {"slice-side", "one vertical fan from the side"},
      {"slice-range", "all beams at one range"},
      {"slice-plane", "a horizontal, vertical or oblique plane in metres"},
      {"volume", "a ping in three dimensions, with what stands round it"},
      {"propagation", "the schools of a ping and of its neighbours"},
      {"observation-map", "an observation from above: ship, path, footprints, schools"},
      {"survey-map", "all observations and schools on a chart"},
      {"timeline", "an echogram of an observation or of the survey, with school tracks"},
      {"echogram", "Sv of one beam, one fan or one channel against time, with the schools in it"},
      {"chart", "figures of schools: one column of a table over another, or the histogram of one"},
      {"frequency", "mean Sv of schools, and of the water round them, in each fan over the fan's frequency"},
      {"curves",
       "curves of schools: Sv in them and round them, their size over the tolerance of growing, or their behaviour "
       "against the ship"},
      {"noise-steps", "a slice as recorded and after each step of noise removal, or two of the steps compared"},
      {"lineage", "what became of an observation's schools: born, split, merged, lost and seen again, a lane each"},
      {"movie", "one of the kinds that show a ping, moving: over pings, round a ping, or along the track"},
      {"report",
       "the survey on one page: map, timeline, strongest schools and what the numbers mean; as .html, or .pdf with "
       "--whole, the whole of it"},
  }};
  return kinds;
}

std::vector<std::string> kinds_suited(std::string_view suits) {
  std::vector<std::string> out;
  for (const PictureKindInfo& kind : picture_kinds()) {
    bool suited = suits.empty();
    for (std::size_t at = 0; at < suits.size() && !suited;) {
      const std::size_t end = std::min(suits.find(' ', at), suits.size());
      const std::string_view one = suits.substr(at, end - at);
      suited = one.ends_with('-') ? kind.name.starts_with(one) : kind.name == one;
      at = end + 1;
    }
    if (suited) out.emplace_back(kind.name);
  }
  return out;
}

}  // namespace sonar
