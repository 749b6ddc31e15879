// SPDX-License-Identifier: Apache-2.0
#include "session/actions.h"

#include <algorithm>
#include <map>

namespace sonar {

const Action* Actions::find(std::string_view id) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const Action& action) { return action.id == id; });
  return found == list_.end() ? nullptr : &*found;
}

std::vector<std::string> Actions::clashes() const {
  std::map<std::string, std::string> of_key;
  std::vector<std::string> ids;
  for (const Action& action : list_) {
    for (const std::string& key : action.keys) {
      const auto [known, fresh] = of_key.emplace(key, action.id);
      if (!fresh) ids.insert(ids.end(), {known->second, action.id});
    }
  }
  return ids;
}

}  // namespace sonar
