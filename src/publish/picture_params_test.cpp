// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_params.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "publish/picture_options.h"

namespace sonar {
namespace {

/// Visitor: the kinds that fields and groups name.
class Named {
 public:
  template <class T>
  void field(std::string_view name, T&, const FieldInfo& info) {
    note(name, info.suits);
  }
  template <class E>
  void choice(std::string_view name, E&, ChoiceNames, const ChoiceInfo& info) {
    note(name, info.suits);
  }
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    groups.emplace_back(name);
    describe(*this, p);
  }
  std::vector<std::string> groups;
  std::vector<std::string> without_kind;

 private:
  void note(std::string_view name, std::string_view suits) {
    if (kinds_suited(suits).empty()) without_kind.emplace_back(name);
  }
};

TEST(PictureParams, GroupsOfKindsAreNamedAsTheKindsAre) {
  PictureParams params;
  Named named;
  describe(named, params);
  for (const std::string& group : named.groups) EXPECT_EQ(kinds_suited(group), std::vector{group});
}

TEST(PictureParams, EveryOptionSuitsSomeKind) {
  Named named;
  DisplayParams display;
  describe(named, display);
  EXPECT_EQ(named.without_kind, std::vector<std::string>{});
}

TEST(PictureKinds, ANameThatEndsWithADashStandsForAllThatBeginSo) {
  EXPECT_EQ(kinds_suited("slice- timeline"),
            (std::vector<std::string>{"slice-top", "slice-side", "slice-range", "slice-plane", "timeline"}));
  EXPECT_EQ(kinds_suited("").size(), picture_kinds().size());
  EXPECT_TRUE(kinds_suited("teapot").empty());
}

TEST(PictureOptions, PlacesThatAreNoNumbersAreToldBeforeAnythingIsRead) {
  const auto problem = [](auto change) {
    PictureOptions options;
    change(options);
    const auto valid = validate_options(options);
    return valid ? std::string() : valid.error().text;
  };
  EXPECT_EQ(problem([](PictureOptions&) {}), "");
  EXPECT_EQ(problem([](PictureOptions& o) { o.kind.volume.eye = "1,2"; }), "eye and target make a camera together");
  EXPECT_EQ(problem([](PictureOptions& o) {
              o.kind.volume.eye = "1,2,nan";
              o.kind.volume.target = "0,0,0";
            }),
            "eye 1,2,nan: expected 3 numbers between commas");
  EXPECT_EQ(problem([](PictureOptions& o) {
              o.kind.slice_plane.plane = PlaneLies::through_places;
              o.kind.slice_plane.through = "1,2,1,2";
            }),
            "these numbers make no plane: expected two places or a normal");
  EXPECT_EQ(problem([](PictureOptions& o) { o.volume.frames = -1; }), "frames = -1 is outside 0 .. 1024");
}

}  // namespace
}  // namespace sonar
