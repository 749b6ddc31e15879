// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sonar {
namespace {

const ChartColumn kDepth = *chart_column(ChartTable::school_pings, "depth_m");
const ChartColumn kPing = *chart_column(ChartTable::school_pings, "ping_index");
const ChartColumn kTime = *chart_column(ChartTable::school_pings, "time_utc");

/// 1, 2 or 5 times a power of ten.
bool is_round(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number) + 1e-9));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (std::abs(number / power - factor) < 1e-6) return true;
  }
  return false;
}

bool is_multiple(double number, double of) { return std::abs(number / of - std::round(number / of)) < 1e-6; }

// Whatever the values: each lies in the bin that it is counted in, the edges are multiples of one round number.
TEST(ChartBins, EveryKnownValueIsInOneBinWhoseEdgesAreRound) {
  std::mt19937 random(7);
  for (const double scale : {1e-6, 0.03, 1.0, 47.0, 2.5e7}) {
    for (const int about : {0, 1, 7, 30, 200}) {
      std::vector<double> values;
      std::normal_distribution<double> spread(-3.0 * scale, scale);
      for (int i = 0; i < 300; ++i) values.push_back(i % 17 == 0 ? std::nan("") : spread(random));
      const ChartBins bins = chart_bins(values, kDepth, about);
      ASSERT_GE(bins.count(), 1U);
      EXPECT_LE(bins.count(), 200U);
      const double width = bins.edges[1] - bins.edges[0];
      EXPECT_TRUE(is_round(width)) << width;
      for (const double edge : bins.edges) EXPECT_TRUE(is_multiple(edge, width)) << edge << " of " << width;
      std::vector<std::size_t> counts(bins.count());
      for (std::size_t row = 0; row < values.size(); ++row) {
        if (std::isnan(values[row])) {
          EXPECT_EQ(bins.bin_of_row[row], ChartBins::kNone);
          continue;
        }
        const std::size_t bin = bins.bin_of_row[row];
        ASSERT_LT(bin, bins.count());
        EXPECT_LE(bins.edges[bin], values[row]);
        EXPECT_LT(values[row], bins.edges[bin + 1]);
        ++counts[bin];
      }
      std::size_t sum = 0;
      for (const std::size_t count : counts) sum += count;
      EXPECT_EQ(sum, 300U - 18U);
      EXPECT_GT(counts.front(), 0U) << "no empty bin at the ends";
      EXPECT_GT(counts.back(), 0U);
    }
  }
}

// By hand: 0 to 999 has quartiles 249.75 and 749.25; 2 * 499.5 / 1000^(1/3) = 99.9, next to 100.
TEST(ChartBins, TheirWidthIsThatOfFreedmanAndDiaconis) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(i);
  const ChartBins bins = chart_bins(values, kDepth, 0);
  EXPECT_EQ(bins.edges, (std::vector<double>{0, 100, 200, 300, 400, 500, 600, 700, 800, 900, 1000}));
}

TEST(ChartBins, AboutAsManyAsAreAskedFor) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(i);
  EXPECT_EQ(chart_bins(values, kDepth, 20).count(), 20U);
  EXPECT_EQ(chart_bins(values, kDepth, 10).count(), 10U);
  EXPECT_EQ(chart_bins(values, kPing, 200).count(), 100U) << "a ping is no narrower than a ping";
}

TEST(ChartBins, OneValueAloneAndNone) {
  for (const double value : {-48.2, 0.0, 3e-7, 1e9}) {
    const ChartBins bins = chart_bins(std::vector<double>(5, value), kDepth, 0);
    ASSERT_EQ(bins.count(), 1U) << value;
    EXPECT_LE(bins.edges[0], value);
    EXPECT_GT(bins.edges[1], value);
  }
  EXPECT_EQ(chart_bins(std::vector<double>(3, std::nan("")), kDepth, 0).count(), 0U);
  EXPECT_EQ(chart_bins({}, kDepth, 0).count(), 0U);
}

TEST(ChartBins, OneFarAwayMakesNoMoreThanEyesCanSee) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.001 * i);
  values.push_back(1e9);
  EXPECT_LE(chart_bins(values, kDepth, 0).count(), 200U);
  values.back() = -1e9;
  EXPECT_LE(chart_bins(values, kDepth, 0).count(), 200U);
}

// An hour from 08:00 on.
TEST(ChartBins, TimesAreDividedAsClocksAre) {
  constexpr double kEight_s = 1'578'124'800.0;
  std::vector<double> values;
  for (int i = 0; i < 3600; ++i) values.push_back(kEight_s + i);
  const ChartBins bins = chart_bins(values, kTime, 12);
  ASSERT_EQ(bins.count(), 12U);
  for (std::size_t i = 0; i <= 12; ++i) EXPECT_EQ(bins.edges[i], kEight_s + 300.0 * static_cast<double>(i));
}

}  // namespace
}  // namespace sonar
