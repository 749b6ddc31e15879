// SPDX-License-Identifier: Apache-2.0
// The small things: units, arrays, flags, numbers as text, errors and diagnostics.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <type_traits>

#include "base/array.h"
#include "base/check.h"
#include "base/diagnostics.h"
#include "base/number_text.h"
#include "base/result.h"
#include "base/sample_flags.h"
#include "base/units.h"

namespace sonar {
namespace {

// A count is 10 log10(2) / 256 dB = 0.011758984 dB; 256 counts double. Check values: 1340 -> 15.757, 2239 -> 26.328 dB.
TEST(Units, CountsAndDecibels) {
  EXPECT_NEAR(kDbPerCount, 0.011758984, 5e-10);
  EXPECT_NEAR(db_from_counts(1340), 15.757, 5e-4);
  EXPECT_NEAR(db_from_counts(2239), 26.328, 5e-4);
  EXPECT_DOUBLE_EQ(counts_from_db(db_from_counts(-4321)), -4321);
  EXPECT_EQ(linear_from_count(0), 1.0);
  EXPECT_EQ(linear_from_count(256), 2.0);
  EXPECT_EQ(linear_from_count(-512), 0.25);
  EXPECT_EQ(linear_from_count(kNoData), 0.0);
  for (const int count : {-32767, -20000, -5105, 1, 32767}) {
    const double expected = std::pow(10.0, count * kDbPerCount / 10.0);
    EXPECT_NEAR(linear_from_count(static_cast<std::int16_t>(count)) / expected, 1.0, 1e-12);
  }
}

TEST(Units, TheNearestCountOfALinearValue) {
  for (int count = kMinCount; count <= kMaxCount; ++count) {
    const double linear = linear_from_count(static_cast<std::int16_t>(count));
    ASSERT_EQ(count_from_linear(linear), count);
    // 0.4998 and 0.5002 of the way to the next
    const double below = linear * std::exp2(0.4998 / 256.0);
    const double above = linear * std::exp2(0.5002 / 256.0);
    ASSERT_EQ(count_from_linear(below), count);
    ASSERT_EQ(count_from_linear(above), std::min<int>(kMaxCount, count + 1));
  }
  EXPECT_EQ(count_from_linear(1e-300), kMinCount);
  EXPECT_EQ(count_from_linear(1e300), kMaxCount);
}

TEST(Units, TheNearestWholeNumber) {
  for (const double value : {-32768.4, -2.6, -2.4, -0.4, 0.0, 0.4, 0.6, 2.4, 2.6, 40000.7}) {
    EXPECT_EQ(nearest_int(value), std::lround(value)) << value;
  }
  EXPECT_EQ(nearest_int(-2.5), -2);
  EXPECT_EQ(nearest_int(2.5), 3);
}

TEST(Units, LinearAndBack) {
  EXPECT_DOUBLE_EQ(linear_from_db(-30.0), 0.001);
  EXPECT_DOUBLE_EQ(db_from_linear(0.01), -20.0);
  EXPECT_DOUBLE_EQ(deg_from_rad(rad_from_deg(47.5)), 47.5);
  EXPECT_NEAR(6 * kKnot_mps, 3.0867, 1e-4);
}

TEST(Array3, SampleIsFastestThenBeamThenFan) {
  Array3<int> array(Shape3{2, 3, 4});
  int n = 0;
  for (int fan = 0; fan < 2; ++fan) {
    for (int beam = 0; beam < 3; ++beam) {
      for (int sample = 0; sample < 4; ++sample) array(fan, beam, sample) = n++;
    }
  }
  EXPECT_EQ(array.shape().size(), 24U);
  EXPECT_EQ(array.shape().rows(), 6U);
  for (int i = 0; i < 24; ++i) EXPECT_EQ(array.all()[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(array.row(1, 2)[0], 20);
  EXPECT_EQ(array.view().row(5)[3], 23);
  const View3<const int> borrowed = array.view();
  EXPECT_EQ(borrowed(0, 1, 2), 6);
  static_assert(!std::is_convertible_v<View3<const int>, View3<int>>,
                "a view for reading never becomes one for writing");
}

TEST(Array3, EmptyShapesAreEmpty) {
  EXPECT_TRUE((Array3<int>(Shape3{0, 5, 5}).all().empty()));
  EXPECT_EQ((Array3<int>(Shape3{1, 1, 3}, 7).all()[2]), 7);
}

TEST(SampleFlags, EachIsOneBitOfAByte) {
  std::set<int> bits;
  for (const SampleFlags flag :
       {SampleFlags::near_field, SampleFlags::surface, SampleFlags::corrupted, SampleFlags::dropout,
        SampleFlags::interference, SampleFlags::impulse, SampleFlags::seabed, SampleFlags::low_snr}) {
    bits.insert(static_cast<int>(flag));
  }
  EXPECT_EQ(bits, (std::set<int>{1, 2, 4, 8, 16, 32, 64, 128}));
  EXPECT_FALSE(any(kNeverMember & kFault));
  EXPECT_FALSE(any(kNotFiltered & SampleFlags::low_snr));
}

// The shortest text that reads back equal.
TEST(NumberText, ReadsBackEqual) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(12.0), "12");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(std::numeric_limits<double>::quiet_NaN()), "");
  for (const double value : {1.0 / 3.0, 1e-17, -123456789.125, 6.02e23, 0.30000000000000004}) {
    EXPECT_EQ(std::stod(shortest(value)), value);
  }
  EXPECT_EQ(degrees_text(59.999999849), "59.99999985");
  EXPECT_EQ(degrees_text(-0.5), "-0.50000000");
  EXPECT_EQ(degrees_text(std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(Errors, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(ErrorCode::cancelled); ++i) names.insert(name(static_cast<ErrorCode>(i)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(ErrorCode::cancelled) + 1);
  EXPECT_FALSE(names.contains("unknown"));
}

TEST(Errors, OneLineSaysWhere) {
  EXPECT_EQ(to_line({ErrorCode::format, "expected RAW0", {"a.raw", 12, 3}}), "a.raw: byte 12: ping 3: expected RAW0");
  EXPECT_EQ(to_line({ErrorCode::io, "no such file", {"a.raw", -1, -1}}), "a.raw: no such file");
  EXPECT_EQ(to_line({ErrorCode::usage, "what?", {}}), "what?");
  EXPECT_EQ(to_line({ErrorCode::io, "gone", {"two\nlines \x1b[31m\x7f Trom\xc3\xb8", 7}}),
            "two?lines ?[31m? Trom\xc3\xb8: byte 7: gone");
}

TEST(Errors, PassOn) {
  const Result<int> failed = fail(ErrorCode::format, "bad", {"x", 1, -1});
  const Result<double> other = pass_on(failed);
  ASSERT_FALSE(other);
  EXPECT_EQ(to_line(other.error()), "x: byte 1: bad");
}

TEST(Diagnostics, CodesAreStableWordsAndUnique) {
  std::set<std::string_view> codes;
  std::size_t i = 0;
  for (const DiagnosticEntry& entry : diagnostic_table()) {
    EXPECT_EQ(static_cast<std::size_t>(entry.code), i++);
    EXPECT_EQ(name(entry.code), entry.name);
    EXPECT_EQ(entry.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string_view::npos);
    EXPECT_TRUE(entry.sentence.ends_with('.')) << entry.name;
    codes.insert(entry.name);
  }
  EXPECT_EQ(codes.size(), diagnostic_table().size());
}

TEST(CheckDeathTest, SaysWhichContract) {
  EXPECT_DEATH(SONAR_CHECK(1 + 1 == 3), "base_test.cpp:[0-9]+: contract broken: 1 \\+ 1 == 3");
}

}  // namespace
}  // namespace sonar
