// SPDX-License-Identifier: Apache-2.0
#include "session/words/key_said.h"

#include <fmt/format.h>

#include <cctype>
#include <memory>
#include <utility>

namespace sonar {
namespace {

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

KeySaid::KeySaid(Workspace& workspace, Actions& actions)
    : workspace_(workspace), listening_(workspace.document.changes(), [this](DocumentChange change) { hear(change); }) {
  actions.on_press(
      [this](const Action& action, const std::string& text, bool allowed) { pressed(action, text, allowed); });
}

void KeySaid::pressed(const Action& action, const std::string& text, bool allowed) {
  ++asked_;
  running_ = allowed;
  acting_ = noticed_ = false;
  if (!allowed) {
    return say(fmt::format("{}: {}", text, action.of_school ? "select a school first" : "not possible now"));
  }
  say(text);
  // Behind the action itself: whether it is on, and whether it began something that takes time.
  workspace_.queue.post([this, &action, text, asked = asked_, alive = std::weak_ptr<bool>(alive_)] {
    if (alive.expired() || asked != asked_) return;
    running_ = false;
    acting_ = workspace_.document.busy();
    if (action.checked && !noticed_) say(fmt::format("{}: {}", text, action.checked() ? "on" : "off"));
  });
}

void KeySaid::hear(DocumentChange change) {
  if (!running_ && !acting_) return;
  const Document& document = workspace_.document;
  if (change == DocumentChange::notice) {
    noticed_ = true;
    say(document.notices().back());
  }
  if (change != DocumentChange::state) return;
  const ChoicesShown& now = document.choices();
  const auto name = now.names.find(now.done_line);
  if (name != now.names.end() && !noticed_) say(sentence(name->second));
  // What the window tells of the act comes in this turn too.
  workspace_.queue.post([this, asked = asked_, alive = std::weak_ptr<bool>(alive_)] {
    if (!alive.expired() && asked == asked_ && !workspace_.document.busy()) acting_ = false;
  });
}

void KeySaid::say(std::string text) {
  text_ = std::move(text);
  changed_.tell();
}

}  // namespace sonar
