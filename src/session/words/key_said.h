// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "session/actions.h"
#include "session/listening.h"
#include "session/open/workspace.h"

namespace sonar {

/// What a key did, in a line for the view that has the keyboard: a letter says nothing by itself, and who looks at an echo does
/// not look at the foot of the window.
/// threads  the window's
class KeySaid {
 public:
  /// Both outlive this.
  KeySaid(Workspace& workspace, Actions& actions);
  ~KeySaid() = default;
  KeySaid(const KeySaid&) = delete;
  KeySaid& operator=(const KeySaid&) = delete;

  /// "Accept", then "Accept school 3", or what the window told of it; "Schools over the data: off".
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Called whenever something is said, also where it is the same again.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

 private:
  void pressed(const Action& action, const std::string& text, bool allowed);
  void hear(DocumentChange change);
  void say(std::string text);

  Workspace& workspace_;
  std::string text_;
  bool running_ = false;  ///< the action that was asked for, in this turn
  bool acting_ = false;   ///< what it began is not known to be done yet
  bool noticed_ = false;  ///< the window told of it
  std::int64_t asked_ = 0;
  Listeners<> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
