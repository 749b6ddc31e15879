// SPDX-License-Identifier: Apache-2.0
#include "view/school_labels.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <variant>
#include <vector>

namespace sonar {
namespace {

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

bool holds(const PixelRect& outer, const PixelRect& box) {
  constexpr double kRounding = 1e-9;
  return box.x >= outer.x - kRounding && box.y >= outer.y - kRounding &&
         box.x + box.width <= outer.x + outer.width + kRounding &&
         box.y + box.height <= outer.y + outer.height + kRounding;
}

/// Rooms, what is seen of a school in them, and words that are there before, at random.
class RandomViews {
 public:
  struct View {
    PixelRect room;
    PixelRect seen;
    std::vector<PixelRect> words;
  };
  View next(double largest_share) {
    View view;
    view.room = {even(0.0, 50.0), even(0.0, 50.0), even(200.0, 900.0), even(120.0, 700.0)};
    view.seen =
        within(view.room, even(0.0, largest_share) * view.room.width, even(0.0, largest_share) * view.room.height);
    for (int i = 0; i < 4; ++i) view.words.push_back(within(view.room, 60.0, 14.0));
    return view;
  }

 private:
  double even(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  PixelRect within(const PixelRect& room, double width, double height) {
    return {room.x + even(0.0, room.width - width), room.y + even(0.0, room.height - height), width, height};
  }
  std::mt19937 random_{20200105};
};

/// The only text that a view has then.
TextItem named_in(const RandomViews::View& view) {
  const Theme theme = light_theme({640, 480});
  LabelRoom room(view.room);
  for (const PixelRect& word : view.words) room.take(word);
  FrameDescription frame;
  TextItem name;
  name.text = "school 17 (north wall)";
  name.size_px = theme.text_px;
  name.anchor = TextAnchor::centre;
  name.bold = true;
  add_selected_name(frame, room, name, "17", view.seen, theme);
  std::vector<TextItem> texts;
  for (const auto& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(*text);
  }
  EXPECT_EQ(texts.size(), 1U);
  return texts.empty() ? TextItem{} : texts.front();
}

// Law: however near one looks, the number is there, whole; and on other words only where there is no room else, which four
// words hardly leave none of.
TEST(SelectedName, IsThereInEveryView) {
  RandomViews views;
  int on_words = 0;
  for (int i = 0; i < 500; ++i) {
    const auto view = views.next(1.0);
    const TextItem name = named_in(view);
    const PixelRect box = LabelRoom::box_of(name);
    ASSERT_NE(name.text.find("17"), std::string::npos) << i;
    ASSERT_TRUE(holds(view.room, box)) << i;
    for (const PixelRect& word : view.words) on_words += overlap(box, word) ? 1 : 0;
  }
  EXPECT_LE(on_words, 5);
}

// Law: of a school that leaves room, the name lies off it; and where a school fills the room, its number is on it.
TEST(SelectedName, LiesOffTheSchoolUnlessThatFillsTheView) {
  RandomViews views;
  for (int i = 0; i < 500; ++i) {
    const auto view = views.next(0.3);
    ASSERT_FALSE(overlap(LabelRoom::box_of(named_in(view)), view.seen)) << i;
  }
  const PixelRect all{0.0, 0.0, 400.0, 300.0};
  const TextItem name = named_in({all, all, {}});
  EXPECT_EQ(name.text, "17");
  EXPECT_EQ(name.at, (PixelPoint{200.0, 150.0})) << "in the middle of what is seen";
}

}  // namespace
}  // namespace sonar
