// SPDX-License-Identifier: Apache-2.0
#include "view/volume/pick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

/// Uneven beams on the port side, first range not 0.
Sector sector() {
  std::vector<double> elevation;
  std::vector<double> azimuth;
  for (int i = 0; i < 8; ++i) elevation.push_back(rad_from_deg(-40.0 + 5.0 * i + 0.1 * i * i));
  for (int i = 0; i < 10; ++i) azimuth.push_back(rad_from_deg(242.0 + 5.0 * i - 0.1 * i * i));
  return {elevation, azimuth, {1.5, 0.5, 200}};
}

VolumeData volume_of(double sv_db) {
  VolumeData out{sector(), Array3<std::int16_t>({8, 10, 200}, static_cast<std::int16_t>(counts_from_db(sv_db))), -1e9};
  return out;
}

void light(VolumeData& volume, int fan, int beam, int sample, double sv_db) {
  volume.sv(fan, beam, sample) = static_cast<std::int16_t>(counts_from_db(sv_db));
}

OpticalTable table_from(double clear_db, double full_db, double extinction) {
  OpticalTable table{-90.0, -20.0, {}};
  for (int i = 0; i < 256; ++i) {
    const double db = -90.0 + 70.0 * i / 255.0;
    const double t = std::clamp((db - clear_db) / (full_db - clear_db), 0.0, 1.0);
    table.rgb_extinction.push_back({1.0F, 1.0F, 1.0F, static_cast<float>(extinction * t)});
  }
  return table;
}

VolumeView view_of(const VolumeData& volume, RayMode mode) {
  VolumeView view;
  view.camera = overview(volume.sector, {400, 300});
  view.size = {400, 300};
  view.mode = mode;
  view.first_hit_db = -60.0;  // half way up, in dB, between a lit voxel and its neighbours
  return view;
}

PixelPoint pixel_of(const VolumeView& view, const Point<Sonar>& p) {
  return basis(view.camera, view.size).project(p)->pixel;
}

TEST(Pick, GivesTheOneLitVoxelUnderThePointerInEveryMode) {
  for (const RayMode mode : {RayMode::accumulate, RayMode::first_hit, RayMode::maximum, RayMode::volume_and_surface}) {
    for (const auto& [fan, beam, sample] : {std::array{2, 3, 40}, std::array{6, 8, 150}, std::array{1, 1, 190}}) {
      VolumeData volume = volume_of(-80.0);
      light(volume, fan, beam, sample, -40.0);
      const VolumeView view = view_of(volume, mode);
      const auto hit = pick(volume, table_from(-60.0, -40.0, 1.0), {}, view,
                            pixel_of(view, volume.sector.centre(fan, beam, sample)));
      ASSERT_TRUE(hit) << fan << ' ' << beam << ' ' << sample;
      EXPECT_EQ(hit->fan, fan);
      EXPECT_EQ(hit->beam, beam);
      EXPECT_NEAR(hit->sample, sample, 1) << "interpolation spreads a voxel over its neighbours";
      EXPECT_LT(norm(hit->position - volume.sector.centre(fan, beam, sample)), 2.0);
    }
  }
}

TEST(Pick, FindsNothingWhereNothingIsVisible) {
  const VolumeData volume = volume_of(-80.0);
  const VolumeView view = view_of(volume, RayMode::accumulate);
  EXPECT_FALSE(pick(volume, table_from(-60.0, -40.0, 1.0), {}, view, {200.5, 150.5}));
  EXPECT_FALSE(pick(volume, table_from(-90.0, -85.0, 1.0), {}, view, {0.5, 0.5})) << "this ray misses the sector";
}

TEST(Pick, PassesThroughThinHazeToTheSchool) {
  VolumeData volume = volume_of(-70.0);
  for (int sample = 95; sample < 106; ++sample) {
    for (int fan = 3; fan < 6; ++fan) {
      for (int beam = 3; beam < 7; ++beam) light(volume, fan, beam, sample, -30.0);
    }
  }
  const VolumeView view = view_of(volume, RayMode::accumulate);
  const auto hit =
      pick(volume, table_from(-71.0, -30.0, 0.5), {}, view, pixel_of(view, volume.sector.centre(4, 5, 100)));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->sv_db, -30.0, 0.02);
}

TEST(Pick, TheNearerOfTwoIsTaken) {
  VolumeData volume = volume_of(-80.0);
  VolumeView view = view_of(volume, RayMode::first_hit);
  // Looking outwards along a beam from the transducer: samples stand one behind the other.
  view.camera.eye = {0.0, 0.0, 0.0};
  view.camera.target = volume.sector.centre(4, 5, 100);
  light(volume, 4, 5, 60, -40.0);
  light(volume, 4, 5, 120, -40.0);
  const auto hit = pick(volume, table_from(-60.0, -40.0, 1.0), {}, view, {200.0, 150.0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->sample, 60, 1);
  EXPECT_NEAR(hit->distance_m, volume.sector.range().range_m(60), 0.5);
}

TEST(Pick, SeabedAndSeaSurfaceEndARay) {
  VolumeData volume = volume_of(-80.0);
  light(volume, 4, 5, 100, -40.0);
  VolumeView view = view_of(volume, RayMode::accumulate);
  const Point<Sonar> place = volume.sector.centre(4, 5, 100);
  const PixelPoint pixel = pixel_of(view, place);
  const OpticalTable table = table_from(-60.0, -40.0, 1.0);
  view.opaque_m = std::make_shared<std::vector<float>>(view.size.count(), 10.0F);
  EXPECT_FALSE(pick(volume, table, {}, view, pixel));
  view.opaque_m = nullptr;
  EXPECT_TRUE(pick(volume, table, {}, view, pixel));
  volume.surface_z_m = place.z + 15.0;
  EXPECT_FALSE(pick(volume, table, {}, view, pixel)) << "the place is in the air";
}

TEST(Pick, AMaskIsMetWithOrWithoutTheData) {
  VolumeData volume = volume_of(-80.0);
  PingMask mask;
  for (int beam = 3; beam < 7; ++beam) mask.runs.push_back({4 * 10 + beam, 90, 20});
  mask.confidence.assign(80, 200);
  const std::array layers{MaskLayer{nullptr, {}}, MaskLayer{std::make_shared<PingMask>(mask), {}}};
  VolumeView view = view_of(volume, RayMode::accumulate);
  const PixelPoint pixel = pixel_of(view, volume.sector.centre(4, 5, 100));
  const OpticalTable table = table_from(-60.0, -40.0, 1.0);
  for (const bool data_too : {true, false}) {
    view.masks.data_too = data_too;
    const auto hit = pick(volume, table, layers, view, pixel);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mask, 1);
    EXPECT_NEAR(hit->sample, 100, 11);
  }
}

TEST(Pick, AMasksSurfaceGivesAMemberFromWhereverOneLooks) {
  const VolumeData volume = volume_of(-80.0);
  PingMask mask;
  for (int beam = 3; beam < 7; ++beam) mask.runs.push_back({4 * 10 + beam, 90, 20});
  mask.confidence.assign(80, 60);
  const std::array layers{MaskLayer{std::make_shared<PingMask>(mask), {}}};
  const VolumeView view = view_of(volume, RayMode::accumulate);
  const OpticalTable table = table_from(-60.0, -40.0, 1.0);
  int met = 0;
  for (int dx = -40; dx <= 40; dx += 4) {
    for (int dy = -40; dy <= 40; dy += 4) {
      PixelPoint pixel = pixel_of(view, volume.sector.centre(4, 5, 100));
      pixel.x += dx;
      pixel.y += dy;
      const auto hit = pick(volume, table, layers, view, pixel);
      if (!hit || hit->mask < 0) continue;
      ++met;
      EXPECT_EQ(hit->fan, 4) << dx << ", " << dy;
      EXPECT_TRUE(hit->beam >= 3 && hit->beam < 7 && hit->sample >= 90 && hit->sample < 110)
          << hit->beam << " " << hit->sample;
    }
  }
  EXPECT_GT(met, 5);
}

TEST(Pick, WhereMasksOverlapTheSurerOneIsMet) {
  // The second lies within the first and is surer of its voxels: there the picture shows the second's colour.
  const VolumeData volume = volume_of(-80.0);
  const auto box = [](int first_beam, int beams, std::uint8_t confidence) {
    PingMask mask;
    for (int fan = 2; fan < 7; ++fan) {
      for (int beam = first_beam; beam < first_beam + beams; ++beam) mask.runs.push_back({fan * 10 + beam, 90, 20});
    }
    mask.confidence.assign(static_cast<std::size_t>(5 * beams * 20), confidence);
    return std::make_shared<PingMask>(mask);
  };
  const std::array layers{MaskLayer{box(2, 6, 100), {}}, MaskLayer{box(4, 4, 200), {}}};
  VolumeView view = view_of(volume, RayMode::accumulate);
  // Along a beam from the transducer: nothing else is met before.
  view.camera.eye = {0.0, 0.0, 0.0};
  for (const auto& [beam, mask] : {std::pair{2, 0}, std::pair{6, 1}}) {
    view.camera.target = volume.sector.centre(4, beam, 100);
    const auto hit = pick(volume, table_from(-60.0, -40.0, 1.0), layers, view, {200.0, 150.0});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->mask, mask) << beam;
  }
}

TEST(Pick, NoDataIsNeverTheAnswerWhereDataIsNear) {
  VolumeData volume = volume_of(-80.0);
  light(volume, 4, 5, 100, -40.0);
  volume.sv(4, 5, 101) = kNoData;
  const VolumeView view = view_of(volume, RayMode::maximum);
  const auto hit =
      pick(volume, table_from(-60.0, -40.0, 1.0), {}, view, pixel_of(view, volume.sector.centre(4, 5, 100)));
  ASSERT_TRUE(hit);
  EXPECT_NE(volume.sv(hit->fan, hit->beam, hit->sample), kNoData);
}

TEST(Pick, WhatIsDrawnBesideMissingSamplesIsFound) {
  // A lit block round beams of which every second one is missing: no place round it has eight known corners, yet the renderers
  // draw the voxel, since the missing ones take the mean of what is known round them.
  VolumeData volume = volume_of(-80.0);
  for (int fan = 3; fan <= 5; ++fan) {
    for (int beam = 4; beam <= 6; ++beam) {
      for (int sample = 97; sample <= 103; ++sample) light(volume, fan, beam, sample, -40.0);
    }
  }
  for (int sample = 90; sample <= 110; ++sample) {
    volume.sv(4, 4, sample) = volume.sv(4, 6, sample) = kNoData;
    volume.sv(3, 5, sample) = volume.sv(5, 5, sample) = kNoData;
  }
  for (const RayMode mode : {RayMode::accumulate, RayMode::first_hit, RayMode::maximum, RayMode::volume_and_surface}) {
    const VolumeView view = view_of(volume, mode);
    const auto hit =
        pick(volume, table_from(-60.0, -40.0, 1.0), {}, view, pixel_of(view, volume.sector.centre(4, 5, 100)));
    ASSERT_TRUE(hit) << static_cast<int>(mode);
    EXPECT_NEAR(hit->sv_db, -40.0, 0.02);
    EXPECT_NE(volume.sv(hit->fan, hit->beam, hit->sample), kNoData);
    EXPECT_NEAR(hit->sample, 100, 4);
  }
}

TEST(Pick, NothingIsFoundWhereNothingIsKnown) {
  VolumeData volume = volume_of(-40.0);
  for (auto& sv : volume.sv.all()) sv = kNoData;
  for (const RayMode mode : {RayMode::accumulate, RayMode::first_hit, RayMode::maximum, RayMode::volume_and_surface}) {
    const VolumeView view = view_of(volume, mode);
    EXPECT_FALSE(pick(volume, table_from(-60.0, -40.0, 1.0), {}, view, {200.5, 150.5}));
  }
}

}  // namespace
}  // namespace sonar
