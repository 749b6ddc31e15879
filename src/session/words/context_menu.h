// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace sonar {

/// Ids of actions that stand together.
using ActionGroup = std::span<const std::string_view>;

/// What a right click into a dock offers: ids of the window's actions, in groups with a line between; texts, keys and what
/// is greyed are the actions' own. Empty = no menu.
[[nodiscard]] std::span<const ActionGroup> context_menu(std::string_view dock);

/// Whether an action is the first of what belongs together in its menu of the menu bar: a line is drawn above it.
[[nodiscard]] bool begins_group(std::string_view action);
/// All of them. For a test.
[[nodiscard]] std::span<const std::string_view> group_beginnings();

}  // namespace sonar
