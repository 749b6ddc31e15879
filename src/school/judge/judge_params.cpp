// SPDX-License-Identifier: Apache-2.0
#include "school/judge/judge_params.h"

#include <algorithm>
#include <cstddef>

namespace sonar {
namespace {

/// Takes the first entry off a list, without the blanks round it.
std::string_view take_entry(std::string_view& list) {
  const std::size_t comma = std::min(list.find(','), list.size());
  std::string_view entry = list.substr(0, comma);
  list.remove_prefix(std::min(list.size(), comma + 1));
  entry.remove_prefix(std::min(entry.find_first_not_of(' '), entry.size()));
  return entry.substr(0, entry.find_last_not_of(' ') + 1);
}

}  // namespace

bool names_judge(std::string_view list, std::string_view judge) {
  while (!list.empty()) {
    if (take_entry(list) == judge) return true;
  }
  return false;
}

std::string_view no_judge_in(std::string_view list) {
  while (!list.empty()) {
    const std::string_view entry = take_entry(list);
    if (!entry.empty() && std::ranges::find(kJudgeNames, entry) == kJudgeNames.end()) return entry;
  }
  return {};
}

}  // namespace sonar
