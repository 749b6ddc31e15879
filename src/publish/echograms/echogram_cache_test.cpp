// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/echogram_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

constexpr EchogramRange kRange{0.0, 0.5, 700};

/// 37 pings, each cell its own.
EchogramPyramid echogram() {
  EchogramPyramid out(kRange);
  for (int ping = 0; ping < 37; ++ping) {
    std::vector<EchogramCell> column;
    for (int bin = 0; bin < kRange.bins; ++bin) {
      const auto count = static_cast<std::int16_t>(-20000 + 10 * bin + ping);
      column.push_back({0.001F * static_cast<float>(bin + ping), static_cast<float>(1 + bin), count, count});
    }
    out.add_ping(ping * kSecondNs, column, ping == 3 ? EchogramPyramid::kUnknownDistance : 0.1 * ping);
  }
  return out;
}

void expect_same(const EchogramPyramid& a, const EchogramPyramid& b) {
  EXPECT_EQ(a.range(), b.range());
  EXPECT_EQ(a.pings_per_column(), b.pings_per_column());
  EXPECT_EQ(a.times(), b.times());
  ASSERT_EQ(a.distances_nmi().size(), b.distances_nmi().size());
  for (std::size_t i = 0; i < a.pings(); ++i) {
    EXPECT_EQ(std::isnan(a.distances_nmi()[i]), std::isnan(b.distances_nmi()[i]));
    if (i != 3) {
      EXPECT_EQ(a.distances_nmi()[i], b.distances_nmi()[i]);
    }
  }
  ASSERT_EQ(a.levels(), b.levels());
  for (int i = 0; i < a.levels(); ++i) EXPECT_EQ(a.level(i), b.level(i)) << i;
}

struct Survey {
  SurveyFiles files;
  ObservationFiles observation;
  Survey() {
    for (const char* hash : {"other", "aaaa", "bbbb"}) {
      SurveyFile file;
      file.index.hash = hash;
      files.files.push_back(file);
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
      observation.pings.push_back({1 + i / 2, i % 2});
      PingNavigation n;
      n.time = i * kSecondNs;
      observation.navigation.push_back(n);
    }
  }
  [[nodiscard]] EchogramEntry entry(const std::string& recipe = "recipe", bool filtered = false) const {
    return echogram_entry({"cache"}, files, observation, recipe, filtered, kNotFiltered, kRange);
  }
};

TEST(EchogramCache, GivesBackWhatWasKept) {
  const test::TemporaryFolder folder;
  const EchogramEntry entry{folder.path() / "cache" / "a.echogram", "key"};
  EXPECT_FALSE(kept_echogram(entry, 0));
  const EchogramPyramid made = echogram();
  keep_echogram(entry, made);
  for (const int level : {0, 1, 3, 99}) {
    const auto kept = kept_echogram(entry, level);
    ASSERT_TRUE(kept) << level;
    expect_same(*kept, made.coarser(level));
  }
  EXPECT_EQ(made.coarser(1).pings_per_column(), 2);
  EXPECT_EQ(made.coarser(1).range(), (EchogramRange{0.0, 1.0, 350}));
  EXPECT_EQ(made.coarser(1).level(0), made.level(1));
  expect_same(*kept_echogram(entry, 0), made);
}

// What was kept goes on growing as what was made does.
TEST(EchogramCache, KeptEchogramsTakeMorePings) {
  const test::TemporaryFolder folder;
  const EchogramEntry entry{folder.path() / "a", "key"};
  EchogramPyramid made = echogram();
  keep_echogram(entry, made);
  auto kept = *kept_echogram(entry, 0);
  const std::vector<EchogramCell> column(700, EchogramCell{1.0F, 2.0F, -100, -100});
  for (int i = 40; i < 60; ++i) {
    made.add_ping(i * kSecondNs, column);
    kept.add_ping(i * kSecondNs, column);
  }
  ASSERT_EQ(kept.levels(), made.levels());
  for (int i = 0; i < made.levels(); ++i) EXPECT_EQ(kept.level(i), made.level(i));
}

TEST(EchogramCache, StaleAndDamagedEntriesAreNone) {
  const test::TemporaryFolder folder;
  const EchogramEntry entry{folder.path() / "a", "key"};
  keep_echogram(entry, echogram());
  EXPECT_FALSE(kept_echogram({entry.path, "another key"}, 0));
  EXPECT_FALSE(kept_echogram({}, 0));
  const auto size = std::filesystem::file_size(entry.path);
  std::fstream file(entry.path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(size / 2));
  file.put('x');
  file.close();
  EXPECT_FALSE(kept_echogram(entry, 0));
  EXPECT_TRUE(kept_echogram(entry, 3));  // the damage lies in the finest level
  std::filesystem::resize_file(entry.path, size - 1);
  EXPECT_FALSE(kept_echogram(entry, 3));
}

TEST(EchogramCache, KeysFollowWhatAnEchogramIsMadeFrom) {
  const Survey same;
  const EchogramEntry entry = same.entry();
  EXPECT_EQ(entry.key, Survey().entry().key);
  EXPECT_NE(entry.key, same.entry("another recipe").key);
  EXPECT_EQ(entry.path, same.entry("another recipe").path);  // written over
  EXPECT_NE(entry.key, same.entry("recipe", true).key);
  EXPECT_NE(entry.path, same.entry("recipe", true).path);
  Survey changed;
  changed.files.files[2].index.hash = "cccc";
  EXPECT_NE(entry.key, changed.entry().key);
  Survey deeper;
  deeper.observation.navigation[2].transducer_depth_m = 1.0;
  EXPECT_NE(entry.key, deeper.entry().key);
  Survey fewer;
  fewer.observation.pings.pop_back();
  EXPECT_NE(entry.key, fewer.entry().key);
  Survey shifted;  // one file less before those of the observation
  shifted.files.files.erase(shifted.files.files.begin());
  for (SurveyPing& ping : shifted.observation.pings) --ping.file;
  EXPECT_EQ(entry.key, shifted.entry().key);
  EXPECT_EQ(entry.path, shifted.entry().path);
  EXPECT_TRUE(echogram_entry({}, same.files, same.observation, "", false, kNotFiltered, kRange).path.empty());
}

TEST(EchogramCache, PartsThatDoNotBelongTogetherMakeNoEchogram) {
  const EchogramPyramid made = echogram();
  std::vector<EchogramLevel> levels;
  for (int i = 0; i < made.levels(); ++i) levels.push_back(made.level(i));
  const auto of = [&](const EchogramRange& range, int per_column, const std::vector<EchogramLevel>& l) {
    return EchogramPyramid::of_parts(range, per_column, made.times(), made.distances_nmi(), l).has_value();
  };
  EXPECT_TRUE(of(kRange, 1, levels));
  EXPECT_FALSE(of(kRange, 2, levels));
  EXPECT_FALSE(of(kRange, 0, levels));
  EXPECT_FALSE(of({0.0, 0.5, 699}, 1, levels));
  EXPECT_FALSE(of(kRange, 1, {}));
  EXPECT_FALSE(of(kRange, 1, {levels.begin(), levels.end() - 1}));
  levels[1].cells.pop_back();
  EXPECT_FALSE(of(kRange, 1, levels));
}

// A week of pings every 5 s over 1200 pixels: 100 a pixel, of which columns of 16 leave six.
TEST(EchogramCache, WidePicturesOfLongSurveysReadCoarseLevelsAlone) {
  EXPECT_EQ(echogram_level(40, 640), 0);
  EXPECT_EQ(echogram_level(8 * 640 - 1, 640), 0);
  EXPECT_EQ(echogram_level(8 * 640, 640), 1);
  EXPECT_EQ(echogram_level(120960, 1200), 4);
}

}  // namespace
}  // namespace sonar
