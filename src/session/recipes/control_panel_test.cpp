// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/control_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "session/test_app.h"

namespace sonar {
namespace {

TEST(ControlPanel, ADozenSettingsComeFirstEachWithItsSentence) {
  ChangeQueue queue;
  Workspace workspace(queue, {});
  std::size_t first = 0;
  bool folded = false;
  for (const PanelSection& section : control_panel(workspace)) {
    folded = folded || !section.open;
    EXPECT_EQ(section.open, !folded) << section.title << ": nothing open comes behind what is folded";
    if (folded) continue;
    first += section.names.size();
    ASSERT_EQ(section.notes.size(), section.names.size()) << section.title;
    for (const auto& note : section.notes) EXPECT_TRUE(note.text().ends_with(".")) << note.name;
  }
  EXPECT_EQ(first, 12U);
}

TEST(ControlPanel, EverySettingIsThereOnce) {
  ChangeQueue queue;
  Workspace workspace(queue, {});
  std::multiset<std::string> shown;
  std::set<std::string> there;
  for (const PanelSection& section : control_panel(workspace)) {
    for (const Property& one : section.source->properties()) {
      // Of what pictures are asked for, the parts of a chart and of noise steps alone are views'.
      const bool of_pictures = section.source->value("width_px").has_value();
      const bool of_view = one.name.starts_with("chart.") || one.name.starts_with("frequency.") ||
                           one.name.starts_with("curves.") || one.name.starts_with("noise-steps.");
      if (!of_pictures || of_view) there.insert(one.name);
    }
    if (section.names.empty()) {
      for (const Property& one : section.source->properties()) shown.insert(one.name);
    }
    shown.insert(section.names.begin(), section.names.end());
    for (const std::string& name : section.names)
      EXPECT_TRUE(section.source->value(name)) << section.title << ": " << name;
  }
  for (const std::string& name : there) EXPECT_GE(shown.count(name), 1U) << name;
}

}  // namespace
}  // namespace sonar
