// SPDX-License-Identifier: Apache-2.0
#include "session/actions.h"

#include <algorithm>
#include <map>

namespace sonar {

const Action* Actions::find(std::string_view id) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const Action& action) { return action.id == id; });
  return found == list_.end() ? nullptr : &*found;
}

void Actions::press(const Action& action) {
  const bool allowed = !action.enabled || action.enabled();
  std::string text = action.text_now ? action.text_now() : std::string{};
  if (pressed_) pressed_(action, text.empty() ? action.text : text, allowed);
  if (allowed) action.run();
}

const Action* Actions::with_key(std::string_view key) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const Action& action) {
    return std::find(action.keys.begin(), action.keys.end(), key) != action.keys.end();
  });
  return found == list_.end() ? nullptr : &*found;
}

bool Actions::set_keys(std::string_view id, const std::vector<std::string>& keys) {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const Action& action) { return action.id == id; });
  if (found == list_.end()) return false;
  usual_.try_emplace(found->id, found->keys);
  found->keys.clear();
  for (const std::string& key : keys) {
    if (with_key(key) == nullptr) found->keys.push_back(key);
  }
  if (usual_keys(*found) == found->keys) usual_.erase(found->id);
  keys_changed_.tell();
  return found->keys == keys;
}

std::string Actions::with_keys(std::string_view text) const {
  std::string out;
  for (;;) {
    const std::size_t open = text.find('[');
    const std::size_t close = open == text.npos ? text.npos : text.find(']', open);
    if (close == text.npos) return out.append(text);
    const Action* named = find(text.substr(open + 1, close - open - 1));
    out.append(text.substr(0, open));
    if (named == nullptr) out += '[';  // a bracket of the text's own
    if (named != nullptr) out += named->keys.empty() ? named->text : named->keys.front();
    text.remove_prefix((named == nullptr ? open : close) + 1);
  }
}

const std::vector<std::string>& Actions::usual_keys(const Action& action) const {
  const auto changed = usual_.find(action.id);
  return changed == usual_.end() ? action.keys : changed->second;
}

Actions::Keys Actions::changed_keys() const {
  Keys keys;
  for (const auto& [id, usual] : usual_) keys[id] = find(id)->keys;
  return keys;
}

void Actions::take_keys(const Keys& keys) {
  for (Action& action : list_) action.keys = usual_keys(action);
  usual_.clear();
  // First all let go: two may have changed theirs with each other.
  for (const auto& [id, own] : keys) {
    if (find(id) != nullptr) set_keys(id, {});
  }
  // What a user chose goes before what an action has come with since.
  const auto chosen = [&](const std::string& key) {
    return std::ranges::any_of(
        keys, [&](const auto& one) { return find(one.first) != nullptr && std::ranges::count(one.second, key) > 0; });
  };
  for (const Action& action : list_) {
    std::vector<std::string> left = action.keys;
    if (std::erase_if(left, chosen) > 0) set_keys(action.id, left);
  }
  for (const auto& [id, own] : keys) set_keys(id, own);
  keys_changed_.tell();
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
