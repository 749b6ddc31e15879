// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "view/colour_bar.h"
#include "view/key_rows.h"
#include "view/maps/map_example.h"
#include "view/maps/survey_map.h"
#include "view/slices/slice_example.h"
#include "view/slices/slice_picture.h"
#include "view/slices/slice_steps.h"
#include "view/sv_scale.h"
#include "view/volume/propagation_labels.h"

namespace sonar {
namespace {

constexpr double kLeast_px = 12.0;

void expect_readable(const FrameDescription& frame, const std::string& what) {
  int texts = 0;
  for (const auto& item : frame.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text == nullptr) continue;
    ++texts;
    EXPECT_GE(text->size_px, kLeast_px) << what << ": " << text->text;
  }
  EXPECT_GT(texts, 0) << what;
}

// Law: what a view says secondarily is as large as what it says first where that is no larger than can be read.
TEST(LeastText, NoTextOfAFlatPictureIsSmaller) {
  for (const PixelSize size : {PixelSize{300, 130}, PixelSize{420, 170}, PixelSize{700, 240}, PixelSize{900, 700}}) {
    const std::string what = std::to_string(size.width) + " x " + std::to_string(size.height);
    const Theme theme = with_text(light_theme(size), kLeast_px);
    const Sector sector = slice_example::hand_sector();
    const slice_example::LitVolume volume(sector, {4, 3, 20}, -30.0, -90.0);
    for (const SliceView& view : {SliceView{TopSlice{4}}, SliceView{SideSlice{3}}}) {
      const auto slice = slice_picture(sector, volume.data(), {}, view, {}, theme, size);
      if (slice) expect_readable(slice->frame, "slice, " + what);
    }
    FrameDescription bar{size, {}, {}, {}};
    add_colour_bar(bar, {10, 10, 15, size.height - 40.0}, colour_bar(sv_colours(SvScale{})), theme);
    expect_readable(bar, "colour bar, " + what);
    FrameDescription panel{size, {}, {}, {}};
    const PixelRect place{5, 5, 200, 100};
    add_depth_scale(panel, 100.0, 2.0, place, theme);
    const std::vector<PanelNumber> numbers{{"3", {40, 40, 20, 10}}};
    add_panel_numbers(panel, numbers, place, theme);
    add_panel_note(panel, "no school was looked for", place, theme);
    expect_readable(panel, "panel of a propagation, " + what);
  }
}

TEST(LeastText, NoTextOfAMapIsSmaller) {
  using namespace map_example;
  std::vector<ObservationProduct> survey{product("obs-0001", 60)};
  add_school(survey[0], 1, destination(survey[0].pings[30].transducer, 60.0, 270.0), 30, 31, block(2, 1, 2, 25, 5));
  SurveyMapStyle style;
  style.transects = {{"T1", "north", EffortType::transect, survey[0].pings[5].time, survey[0].pings[50].time}};
  for (const PixelSize size : {PixelSize{640, 480}, PixelSize{1000, 760}}) {
    const std::string what = std::to_string(size.width) + " x " + std::to_string(size.height);
    const auto map = survey_map(survey, {}, nullptr, style, size, with_text(light_theme(size), kLeast_px));
    ASSERT_TRUE(map) << to_line(map.error());
    EXPECT_TRUE(says(*map, "obs-0001")) << what;
    expect_readable(*map, "survey map, " + what);
  }
}

TEST(LeastText, NoTextOfNoiseStepsAndKeysIsSmaller) {
  const Sector sector = slice_example::hand_sector();
  const Array3<std::int16_t> sv({8, 7, 41}, static_cast<std::int16_t>(std::lround(counts_from_db(-40.0))));
  const Array3<SampleFlags> flags({8, 7, 41});
  SliceStepsData data;
  data.flags = flags.view();
  data.steps = {{"Unfiltered", {"as it was recorded"}, false, sv.view()}};
  constexpr PixelSize kSize{900, 700};
  const Theme theme = with_text(light_theme({640, 480}), kLeast_px);
  const auto steps = slice_steps(sector, data, {}, SliceView{TopSlice{4}}, {}, theme, kSize);
  ASSERT_TRUE(steps) << to_line(steps.error());
  EXPECT_TRUE(map_example::says(steps->frame, "as it was recorded"));
  expect_readable(steps->frame, "noise steps");
  FrameDescription key{kSize, {}, {}, {}};
  const std::vector<KeyEntry> entries{{"school", [](FrameDescription&, const PixelRect&) {}}};
  add_key(key, {0, 0, 300, 40}, entries, theme);
  expect_readable(key, "key");
}

}  // namespace
}  // namespace sonar
