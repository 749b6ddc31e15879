// SPDX-License-Identifier: Apache-2.0
#include "io/ices_acoustic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

EffortRow unit(const std::string& transect, std::int64_t edsu) {
  EffortRow row;
  row.transect = transect;
  row.edsu = edsu;
  row.latitude = 60.0;
  row.longitude = 5.0;
  row.distance_nmi = 0.5;
  return row;
}

NascRow cell(const EffortRow& of, double depth_m, double volume_m3, double height_m, double nasc) {
  NascRow row;
  row.transect = of.transect;
  row.edsu = of.edsu;
  row.depth_from_m = depth_m;
  row.depth_to_m = depth_m + 10.0;
  row.volume_m3 = volume_m3;
  row.height_m = height_m;
  row.nasc_m2_nmi2 = nasc;
  return row;
}

/// What stands between <Value> and </Value>, in order.
std::vector<std::string> values(const std::string& xml) {
  constexpr std::string_view kBegin = "<Value>";
  std::vector<std::string> out;
  for (auto at = xml.find(kBegin); at != std::string::npos; at = xml.find(kBegin, at + 1)) {
    const auto first = at + kBegin.size();
    out.push_back(xml.substr(first, xml.find('<', first) - first));
  }
  return out;
}

// Of two range bins with NASC 16 over 8 m in 100 m^3, and 40 over 10 m in 300 m^3: (16/8 * 100 + 40/10 * 300) / 400 * 10 = 35.
TEST(IcesAcoustic, AChannelIsTheMeanOfItsRangesAndStaysWithItsUnit) {
  const std::vector<EffortRow> effort = {unit("A", 1), unit("A", 2), unit("B", 1), unit("B", 2)};
  const std::vector<NascRow> nasc = {cell(effort[2], 0.0, 5.0, 10.0, 7.0), cell(effort[0], 0.0, 100.0, 8.0, 16.0),
                                     cell(effort[1], 0.0, 1.0, 10.0, 3.0), cell(effort[0], 0.0, 300.0, 10.0, 40.0),
                                     cell(effort[0], kUnknown, 1.0, 10.0, 99.0)};
  const std::string xml = ices_acoustic_xml({}, effort, nasc, IcesPart::all);
  EXPECT_EQ(values(xml), (std::vector<std::string>{"35", "3", "7"}));
}

// XML 1.0 has no character for most controls, not even as a reference.
TEST(IcesAcoustic, TextsOfDataLeaveItWellFormed) {
  ObservationProduct product;
  product.title = "a\x01<b>\xF8";
  const std::string xml = ices_acoustic_xml(product, std::vector<EffortRow>{unit("A", 1)}, {}, IcesPart::all);
  EXPECT_THAT(xml, HasSubstr("<LocalID>a\uFFFD&lt;b&gt;\uFFFD</LocalID>"));
  EXPECT_THAT(xml, Not(HasSubstr("&#")));
}

}  // namespace
}  // namespace sonar
