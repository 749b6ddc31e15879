// SPDX-License-Identifier: Apache-2.0
#include "publish/map_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "io/product_example.h"

namespace sonar {
namespace {

bool says(const FrameDescription& frame, const std::string& words) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text.find(words) != std::string::npos;
  });
}

/// A school that the clock cut, one beside it, and one that a human rejected.
std::unique_ptr<PictureSource> cut_survey() {
  const TimeNs step = static_cast<TimeNs>(example::kPingSeconds * 1e9);
  const TimeNs first = example::kStart + 10 * step;
  const PingMask mask = example::block(1, 1, 2, 20, 10);
  std::vector<ObservationProduct> products{
      example::empty("obs-0001", 10),
      example::empty("obs-0002", 10, destination({60.0, 5.0}, 10 * example::kPingSeconds * example::kShip_mps, 0.0),
                     first)};
  products[1].cut_after = first - step;
  example::add_school(products[0], 1, 5, 9, mask);
  example::add_school(products[0], 2, 0, 2, mask);
  example::add_school(products[0], 3, 0, 2, example::block(0, 1, 2, 20, 10));
  products[0].schools[2].status = "rejected";
  example::add_school(products[1], 1, 0, 4, mask);
  for (ObservationProduct& product : products) {
    for (SchoolRow& school : product.schools) {
      school.speed_mps = example::kShip_mps;
      school.course_deg = 0.0;
      school.length_m = 20.0;
    }
  }
  return PictureSource::of(nullptr, std::move(products), {});
}

TEST(MapPictures, CountASchoolOverACutOnceAndARejectedOneNever) {
  const auto source = cut_survey();
  Work work(1);
  PictureOptions options;
  const auto survey = survey_map_frame(source->observations(), options, work);
  ASSERT_TRUE(survey) << to_line(survey.error());
  EXPECT_TRUE(says(*survey, "2 observations, 2 schools"));
  const auto observation = observation_map_frame(source->observations()[0], options);
  ASSERT_TRUE(observation) << to_line(observation.error());
  EXPECT_TRUE(says(*observation, "10 pings, 2 schools"));
  // One of the two is drawn: one is left out, whichever of its parts was named.
  options.schools = {2};
  EXPECT_TRUE(says(*survey_map_frame(source->observations(), options, work), "1 of 2 schools"));
}

}  // namespace
}  // namespace sonar
