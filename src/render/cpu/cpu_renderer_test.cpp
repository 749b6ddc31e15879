// SPDX-License-Identifier: Apache-2.0
// The vector ray-caster against the brute-force one, whose steps are 8 times as short and which shares with it only the
// rule for missing samples and the formula of light. Bounds: rounding to 8 bits alone allows 59 dB; the sample-a-step
// picture of white speckle reaches 55 dB and more (docs of the benchmark), smooth data more.
#include <gmock/gmock.h>

#include <memory>

#include "render/ray_rules.h"
#include "render/reference/brute_force.h"
#include "render/test_scenes.h"
#include "render/transfer_table.h"

namespace sonar {
namespace {

using namespace scenes;

struct Case {
  const char* name;
  Sector sector;
  Camera camera;
  double surface_z_m = -1e9;
  bool dense = false;
};

Sector uneven_fan() { return {uneven(-60.0, -5.0, 9), uneven(60.0, 115.0, 11), RangeAxis{3.0, 0.5, 110}}; }
Sector starboard() { return {even(-40.0, 0.0, 9), even(62.0, 118.0, 12), RangeAxis{0.0, 0.5, 120}}; }
Sector port() { return {even(-40.0, 0.0, 9), even(242.0, 298.0, 12), RangeAxis{0.0, 0.5, 120}}; }
Sector wide() { return {uneven(-80.0, 20.0, 11), even(-130.0, 130.0, 27), RangeAxis{0.0, 0.5, 100}}; }
Sector whole() { return {even(-90.0, 90.0, 19), even(0.0, 360.0, 37), RangeAxis{0.0, 0.5, 80}}; }
Sector behind() { return {even(-30.0, 10.0, 9), even(330.0, 420.0, 19), RangeAxis{-2.0, 0.5, 120}}; }

std::vector<Case> cases() {
  const auto along = [](const Sector& s, double part) {
    return Sector::direction(s.elevation_rad(s.fans() / 2), s.azimuth_rad(s.beams() / 2)) * part;
  };
  std::vector<Case> out{
      {"even", fan(), overview(fan())},
      {"even_dense", fan(), overview(fan()), -1e9, true},
      {"uneven", uneven_fan(), overview(uneven_fan())},
      {"negative_first_range", fan(130, -4.0), overview(fan(130, -4.0))},
      {"far_first_range", fan(80, 20.0), overview(fan(80, 20.0))},
      {"starboard", starboard(), overview(starboard())},
      {"port", port(), overview(port())},
      {"wide", wide(), overview(wide())},
      {"whole_sphere", whole(), looking({60, -90, -70}, {0, 0, 0})},
      {"beyond_360", behind(), overview(behind())},
      {"inside", fan(), looking(along(fan(), 15.0), along(fan(), 40.0))},
      {"inside_backwards", fan(), looking(along(fan(), 50.0), {0, 0, 0})},
      {"below", fan(), looking({35, 10, 110}, {30, 0, 15})},
      {"along_a_beam", fan(), looking(along(fan(), -1.0), along(fan(), 40.0))},
      {"from_the_transducer", fan(), looking({0, 0, 0}, along(fan(), 40.0))},
      {"surface", fan(), overview(fan()), 12.0, true},
  };
  return out;
}

std::unique_ptr<VolumeRenderer> renderer(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table,
                                         std::span<const MaskLayer> masks = {}) {
  auto out = make_cpu_renderer();
  EXPECT_TRUE(out->set_volume(volume));
  EXPECT_TRUE(out->set_transfer(table));
  EXPECT_TRUE(out->set_masks(masks));
  return out;
}

Image black(const RayImage& rays) { return over(rays, Rgba8{0, 0, 0, 255}); }

RayImage draw(VolumeRenderer& r, const VolumeView& view, const DrawQuality& quality = {}) {
  Work work(2);
  auto out = r.draw(view, quality, work);
  EXPECT_TRUE(out) << (out ? "" : to_line(out.error()));
  return out ? std::move(*out) : RayImage{};
}

double against_reference(const std::shared_ptr<const VolumeData>& volume, const OpticalTable& table,
                         const VolumeView& view, std::span<const MaskLayer> masks = {},
                         const DrawQuality& quality = {}) {
  Work work(2);
  const auto ours = draw(*renderer(volume, table, masks), view, quality);
  const auto truth = brute_force(*volume, table, masks, view, 0.125, work);
  double seen = 0.0;
  for (const auto& pixel : truth.rgba) seen += static_cast<double>(pixel[3]);
  EXPECT_GT(seen, 0.004 * static_cast<double>(truth.rgba.size())) << "next to nothing in the picture";
  return psnr_db(black(ours), black(truth));
}

VolumeView small(const Camera& camera) {
  VolumeView view;
  view.camera = camera;
  view.size = {48, 36};
  return view;
}

class Against : public testing::TestWithParam<Case> {};

TEST_P(Against, BruteForce) {
  const Case& c = GetParam();
  auto data = volume(c.sector);
  data->surface_z_m = c.surface_z_m;
  EXPECT_GT(against_reference(data, table(c.dense), small(c.camera)), 50.0);
}

TEST_P(Against, SkippingChangesNothing) {
  const Case& c = GetParam();
  auto data = volume(c.sector);
  data->surface_z_m = c.surface_z_m;
  OpticalTable sparse = table(false);
  OpticalTable all = sparse;
  // An extinction too small to see makes every cell one that is walked.
  for (auto& entry : all.rgb_extinction) entry[3] = std::max(entry[3], 1e-9F);
  const DrawQuality every{1, 1.0, 0.0, 0};
  const auto a = draw(*renderer(data, sparse), small(c.camera), every);
  const auto b = draw(*renderer(data, all), small(c.camera), every);
  EXPECT_LT(a.counts.samples, b.counts.samples);
  EXPECT_GT(psnr_db(black(a), black(b)), 55.0);
}

INSTANTIATE_TEST_SUITE_P(CpuRenderer, Against, testing::ValuesIn(cases()),
                         [](const auto& named) { return std::string(named.param.name); });

/// Rays that run along the beams graze the cells' faces all the way: none may pass over what it has not seen.
TEST(CpuRenderer, RaysAlongTheBeamsLoseNothing) {
  const Sector sector(even(-45.0, 0.0, 20), even(240.0, 300.0, 25), RangeAxis{0.0, 0.38, 1319});
  const auto data = volume(sector);
  VolumeView view = small({});
  view.size = {256, 192};
  view.camera.target = sector.centre(10, 12, 200);
  view.camera.eye = view.camera.target * -0.3 + Point<Sonar>{0.0, 0.0, -6.0};
  const auto r = renderer(data, table(true));
  const RayImage leaping = draw(*r, view, {1, 1.0, 0.03, 0});
  const RayImage walking = draw(*r, view, {1, 1.0, 0.0, 0});
  float worst = 0.0F;
  for (std::size_t i = 0; i < leaping.rgba.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(leaping.rgba[i][c] - walking.rgba[i][c]));
  }
  EXPECT_LT(worst, 0.05F) << "a cell of one segment is right to a few steps of 255; a lost stretch of ray is not";
}

TEST(CpuRenderer, FirstHitAgainstBruteForce) {
  VolumeView view = small(overview(fan()));
  view.mode = RayMode::first_hit;
  view.first_hit_db = -60.0;
  EXPECT_GT(against_reference(volume(fan()), table(false), view, {}, {1, 0.125, 0.03, 0}), 35.0);
  view.lighting.on = true;
  EXPECT_GT(against_reference(volume(fan(), 0.0), table(false), view, {}, {1, 0.125, 0.03, 0}), 33.0);
}

TEST(CpuRenderer, MaximumAgainstBruteForce) {
  VolumeView view = small(overview(fan()));
  view.mode = RayMode::maximum;
  EXPECT_GT(against_reference(volume(fan()), table(false), view, {}, {1, 0.125, 0.03, 0}), 45.0);
}

TEST(CpuRenderer, LightAgainstBruteForce) {
  VolumeView view = small(overview(uneven_fan()));
  view.lighting.on = true;
  EXPECT_GT(against_reference(volume(uneven_fan(), 0.5), table(false), view, {}, {1, 0.25, 0.03, 0}), 42.0);
}

PingMask block(Shape3 shape, int fan0, int beam0, int sample0, int size, std::uint8_t edge, std::uint8_t core) {
  PingMask out;
  for (int f = fan0; f < fan0 + size; ++f) {
    for (int b = beam0; b < beam0 + size; ++b) {
      out.runs.push_back({f * shape.beams + b, sample0, 8 * size});
      for (int s = 0; s < 8 * size; ++s) {
        const bool rim =
            f == fan0 || b == beam0 || f == fan0 + size - 1 || b == beam0 + size - 1 || s < 4 || s >= 8 * size - 4;
        out.confidence.push_back(rim ? edge : core);
      }
    }
  }
  return out;
}

std::vector<MaskLayer> two_schools(Shape3 shape) {
  return {{std::make_shared<PingMask>(block(shape, 3, 4, 50, 4, 80, 255)), {1.0F, 0.2F, 0.1F}},
          {std::make_shared<PingMask>(block(shape, 1, 8, 70, 3, 60, 200)), {0.1F, 0.9F, 0.3F}}};
}

TEST(CpuRenderer, MasksAgainstBruteForce) {
  const auto data = volume(fan());
  const auto masks = two_schools(data->sv.shape());
  for (const bool data_too : {true, false}) {
    for (const RayMode mode : {RayMode::accumulate, RayMode::maximum, RayMode::first_hit}) {
      VolumeView view = small(overview(fan()));
      view.mode = mode;
      view.masks.data_too = data_too;
      EXPECT_GT(against_reference(data, table(false), view, masks, {1, 0.25, 0.03, 0}), 40.0)
          << data_too << static_cast<int>(mode);
    }
  }
}

TEST(CpuRenderer, SchoolsThatOverlapAgainstBruteForce) {
  const auto data = volume(fan());
  const Shape3 shape = data->sv.shape();
  // Each has voxels where its confidence is the larger one.
  const std::vector<MaskLayer> masks{
      {std::make_shared<PingMask>(block(shape, 3, 4, 50, 4, 80, 200)), {1.0F, 0.2F, 0.1F}},
      {std::make_shared<PingMask>(block(shape, 4, 6, 62, 4, 120, 255)), {0.1F, 0.9F, 0.3F}}};
  for (const bool data_too : {true, false}) {
    VolumeView view = small(overview(fan()));
    view.masks.data_too = data_too;
    EXPECT_GT(against_reference(data, table(false), view, masks, {1, 0.25, 0.03, 0}), 40.0) << data_too;
  }
}

TEST(CpuRenderer, MissingSamplesAgainstBruteForce) {
  auto data = volume(fan());
  std::uint32_t n = 0;
  for (auto& sv : data->sv.all()) {
    if (noise(n++ + 7U) > 0.8) sv = kNoData;
  }
  for (int b = 0; b < 6; ++b) {
    for (auto& sv : data->sv.row(5, b)) sv = kNoData;
  }
  EXPECT_GT(against_reference(data, table(true), small(overview(fan()))), 50.0);
  VolumeView view = small(overview(fan()));
  view.mode = RayMode::maximum;
  EXPECT_GT(against_reference(data, table(false), view, {}, {1, 0.25, 0.03, 0}), 40.0);
}

TEST(CpuRenderer, MissingHalfLeavesTheColourOfTheRest) {
  // All water is at -40 dB, half of the beams unknown: no ray may have a colour of another level.
  auto data = volume(fan(), 0.0);
  for (auto& sv : data->sv.all()) sv = static_cast<std::int16_t>(std::lround(counts_from_db(-40.0)));
  for (int f = 0; f < 10; ++f) {
    for (int b = 0; b < 6; ++b) {
      for (auto& sv : data->sv.row(f, b)) sv = kNoData;
    }
  }
  const auto o = optics_at(table(false), -40.0);
  const auto rays = draw(*renderer(data, table(false)), small(overview(fan())));
  int seen = 0;
  for (const auto& p : rays.rgba) {
    if (p[3] < 0.02F) continue;
    ++seen;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(p[c] / p[3]), o[c], 0.004);
  }
  EXPECT_GT(seen, 100);
}

TEST(CpuRenderer, OpaqueThingsEndRays) {
  const auto data = volume(fan());
  VolumeView view = small(overview(fan()));
  view.opaque_m = std::make_shared<std::vector<float>>(view.size.count(), 95.0F);
  EXPECT_GT(against_reference(data, table(true), view), 50.0);
  view.opaque_m = std::make_shared<std::vector<float>>(view.size.count(), 1.0F);
  for (const auto& p : draw(*renderer(data, table(true)), view).rgba) EXPECT_EQ(p[3], 0.0F);
}

TEST(CpuRenderer, ConstantWaterGivesTheExponential) {
  // The central ray of a 60 m deep fan, all at -50 dB: alpha = 1 - exp(-sigma L).
  auto data = volume(fan(121), 0.0);
  for (auto& sv : data->sv.all()) sv = static_cast<std::int16_t>(std::lround(counts_from_db(-50.0)));
  OpticalTable flat;
  flat.rgb_extinction = {{0.25F, 0.5F, 0.75F, 0.01F}, {0.25F, 0.5F, 0.75F, 0.01F}};
  VolumeView view;
  view.size = {1, 1};
  const auto out = Sector::direction(rad_from_deg(-22.0), rad_from_deg(3.0));
  view.camera = looking(out * -5.0, out * 30.0);
  for (const double limit : {0.0, 0.03, 10.0}) {
    const auto p = draw(*renderer(data, flat), view, {1, 1.0, limit, 0}).rgba[0];
    EXPECT_NEAR(p[3], 1.0 - std::exp(-0.01 * 60.0), 2e-5) << limit;
    EXPECT_NEAR(p[1], 0.5 * (1.0 - std::exp(-0.01 * 60.0)), 3e-4) << limit;
  }
}

TEST(CpuRenderer, AnEmptyTableIsTransparent) {
  OpticalTable empty = table(false);
  for (auto& entry : empty.rgb_extinction) entry[3] = 0.0F;
  for (const RayMode mode : {RayMode::accumulate, RayMode::maximum}) {
    VolumeView view = small(overview(fan()));
    view.mode = mode;
    const auto rays = draw(*renderer(volume(fan()), empty), view);
    EXPECT_EQ(rays.counts.samples, 0);
    for (const auto& p : rays.rgba) EXPECT_THAT(p, testing::Each(0.0F));
  }
}

TEST(CpuRenderer, AnEyeBeyondAllNumbersOfSamplesSeesNothing) {
  const VolumeView view = small(looking({1e12, 0, 0}, {2e12, 0, 0}));
  for (const auto& p : draw(*renderer(volume(fan()), table(true)), view).rgba) EXPECT_EQ(p[3], 0.0F);
}

TEST(CpuRenderer, AnyNumberOfThreadsGivesTheSameBits) {
  const auto r = renderer(volume(fan()), table(true));
  Work one(1);
  Work four(4);
  const auto a = r->draw(small(overview(fan())), {}, one);
  const auto b = renderer(volume(fan()), table(true))->draw(small(overview(fan())), {}, four);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->rgba, b->rgba);
  EXPECT_EQ(a->counts.samples, b->counts.samples);
}

TEST(CpuRenderer, TurningSonarAndCameraTogetherChangesNothing) {
  const Sector a = fan();
  const double turn = rad_from_deg(123.0);
  std::vector<double> azimuth = even(-30.0, 30.0, 13);
  for (double& v : azimuth) v += turn;
  const Sector b(even(-45.0, 0.0, 10), azimuth, a.range());
  const auto turned = [&](const Point<Sonar>& p) {
    return Point<Sonar>{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z};
  };
  Camera camera = overview(a);
  const auto first = draw(*renderer(volume(a), table(true)), small(camera));
  camera.eye = turned(camera.eye);
  camera.target = turned(camera.target);
  auto data = volume(b);
  data->sv = volume(a)->sv;
  const auto second = draw(*renderer(data, table(true)), small(camera));
  EXPECT_GT(psnr_db(black(first), black(second)), 60.0);
}

TEST(CpuRenderer, HalfResolutionTakesSomeOfTheRays) {
  const auto r = renderer(volume(fan()), table(true));
  VolumeView view = small(overview(fan()));
  view.size = {95, 71};
  const auto full = draw(*r, view);
  for (const int divisor : {2, 4}) {
    const auto part = draw(*r, view, {divisor, 1.0, 0.03, 0});
    ASSERT_EQ(part.size, divided(view.size, divisor));
    for (int y = 0; y < part.size.height; ++y) {
      for (int x = 0; x < part.size.width; ++x) {
        const auto& p = part.rgba[static_cast<std::size_t>(y * part.size.width + x)];
        const auto& q =
            full.rgba[static_cast<std::size_t>(full_pixel(y, divisor, 71) * 95 + full_pixel(x, divisor, 95))];
        for (std::size_t c = 0; c < 4; ++c) ASSERT_NEAR(p[c], q[c], 2e-3);
      }
    }
  }
}

TEST(CpuRenderer, JitteredFramesAddUpToAFinerPicture) {
  const auto data = volume(fan());
  const auto r = renderer(data, table(false));
  const VolumeView view = small(overview(fan()));
  Work work(2);
  // Sixteen rays a pixel: frames take other places in it.
  VolumeView fine = view;
  fine.size = {4 * view.size.width, 4 * view.size.height};
  const RayImage truth = reduced(brute_force(*data, table(false), {}, fine, 0.25, work), 4);
  RayImage sum = draw(*r, view, {1, 2.0, 0.0, 1});
  const double one = psnr_db(black(sum), black(truth));
  for (std::uint32_t n = 2; n <= 16; ++n) {
    const auto next = draw(*r, view, {1, 2.0, 0.0, n});
    for (std::size_t i = 0; i < sum.rgba.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) sum.rgba[i][c] += next.rgba[i][c];
    }
  }
  for (auto& p : sum.rgba) {
    for (float& c : p) c /= 16.0F;
  }
  EXPECT_GT(psnr_db(black(sum), black(truth)), one + 6.0);
}

}  // namespace
}  // namespace sonar
