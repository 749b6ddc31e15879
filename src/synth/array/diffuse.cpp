// SPDX-License-Identifier: Apache-2.0
#include "synth/array/diffuse.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kElevations = 361;  ///< -90 .. 90 degrees
constexpr double kElevationStep = kPi / (kElevations - 1);
constexpr int kAzimuths = 101;  ///< -75 .. 75 degrees from abeam
constexpr double kAzimuthStep = rad_from_deg(1.5);
constexpr int kNodeStep = 4;         ///< samples between two looks at surface and seabed
constexpr float kLeastSize = 5e-3F;  ///< -46 dB

double azimuth_of(int a) { return (a - (kAzimuths - 1) / 2) * kAzimuthStep; }

/// Complex Gaussian numbers of mean squared size 1, two a block.
class Gaussians {
 public:
  explicit Gaussians(RandomStream random) : random_(random) {}
  std::complex<float> next() {
    if (left_ == 0) {
      words_ = random_.block();
      left_ = 4;
    }
    const float u = (static_cast<float>(words_[left_ - 1] >> 8U) + 0.5F) / 16777216.0F;
    const float angle = static_cast<float>(words_[left_ - 2] >> 8U) * (6.2831853F / 16777216.0F);
    left_ -= 2;
    const float size = std::sqrt(-std::log(u));
    return {size * std::cos(angle), size * std::sin(angle)};
  }

 private:
  RandomStream random_;
  std::array<std::uint32_t, 4> words_{};
  std::size_t left_ = 0;
};

}  // namespace

/// What lies round the ship, by azimuth and every kNodeStep-th sample. Elevations are those heard; beyond +-90 degrees
/// there is nothing.
struct Diffuse::Surfaces {
  int nodes = 0;
  struct Node {
    float surface_elevation = 0.0F, surface = 0.0F;  ///< strength: backscatter / range, rad^-1 m^-1 of the pattern
    float seabed_elevation = 0.0F, seabed = 0.0F;
    std::array<float, 2> layer{};  ///< factors of the layers' patches
  };
  std::vector<Node> at;  ///< [azimuth][node]
};

/// One fan's scatter, sv times the vertical pattern's angle, by azimuth and sample.
struct Diffuse::Densities {
  std::vector<float> all;                                   ///< [azimuth][sample]
  std::array<std::vector<double>, 3> layer_surface_seabed;  ///< [kind][sample], summed over the sector's azimuths
};

Diffuse::Diffuse(const Receiver& receiver, const Sea& sea, double transducer_depth_m, std::uint64_t seed)
    : receiver_(receiver), sea_(sea), seed_(seed), power_per_sv_sr_(receiver.shape()) {
  fill_patterns();
  fill_profiles(transducer_depth_m);
  constexpr double kNoiseSpread_db = 2.0;
  const Shape3 shape = receiver.shape();
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      RandomStream random(seed, Purpose::beam_noise, 0, static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(b));
      noise_w_.push_back(
          static_cast<float>(linear_from_db(sea.company.noise_power_db + kNoiseSpread_db * random.normal())));
      const int channel = receiver.pattern().fans()[static_cast<std::size_t>(f)].channel[static_cast<std::size_t>(b)];
      const double psi = receiver.pattern().psi_sr(channel);
      for (int s = 0; s < shape.samples; ++s) {
        power_per_sv_sr_(f, b, s) = static_cast<float>(receiver.power_per_sv(f, b, s) / psi);
      }
    }
  }
}

void Diffuse::fill_patterns() {
  const Pattern& pattern = receiver_.pattern();
  for (std::size_t f = 0; f < pattern.fans().size(); ++f) {
    const Fan& fan = pattern.fans()[f];
    const std::size_t beams = fan.bow.size();
    std::vector<std::complex<float>> out(beams);
    const double elevation = std::asin(fan.up);
    const std::size_t middle = beams / 2;
    const double middle_azimuth = std::asin(std::clamp(fan.bow[middle] / std::cos(elevation), -1.0, 1.0));
    std::vector<float>& vertical = vertical_.emplace_back();
    double angle = 0.0;
    for (int e = 0; e < kElevations; ++e) {
      const double here = -kPi / 2.0 + e * kElevationStep;
      const bool heard = pattern.two_way(static_cast<int>(f), direction(here, middle_azimuth), 0.0, out);
      vertical.push_back(heard ? std::norm(out[middle]) : 0.0F);
      angle += static_cast<double>(vertical.back()) * std::cos(here) * kElevationStep;
    }
    std::vector<std::complex<float>>& horizontal = horizontal_.emplace_back(beams * kAzimuths);
    std::vector<double> arc(beams);
    for (int a = 0; a < kAzimuths; ++a) {
      if (!pattern.two_way(static_cast<int>(f), direction(elevation, azimuth_of(a)), 0.0, out)) continue;
      for (std::size_t b = 0; b < beams; ++b) {
        horizontal[b * kAzimuths + static_cast<std::size_t>(a)] = out[b];
        arc[b] += static_cast<double>(std::norm(out[b])) * kAzimuthStep;
      }
    }
    for (std::size_t b = 0; b < beams; ++b) {
      held_to_psi_.push_back(static_cast<float>(pattern.psi_sr(fan.channel[b]) / (arc[b] * angle)));
    }
  }
}

void Diffuse::fill_profiles(double transducer_depth_m) {
  const Shape3 shape = receiver_.shape();
  layers_.resize(sea_.layers.size());
  for (std::size_t f = 0; f < static_cast<std::size_t>(shape.fans); ++f) {
    std::vector<float>& volume = volume_.emplace_back(shape.samples);
    for (auto& layer : layers_) layer.emplace_back(shape.samples);
    for (int s = 0; s < shape.samples; ++s) {
      const double r = std::max(1.0, receiver_.range().range_m(s));
      for (int e = 0; e < kElevations; e += 2) {
        const double elevation = -kPi / 2.0 + e * kElevationStep;
        const double depth = transducer_depth_m - r * std::sin(elevation);
        if (depth < 0.0) break;
        const double angle =
            static_cast<double>(vertical_[f][static_cast<std::size_t>(e)]) * std::cos(elevation) * 2.0 * kElevationStep;
        const auto i = static_cast<std::size_t>(s);
        volume[i] += static_cast<float>(sea_.reverberation_sv * angle);
        for (std::size_t l = 0; l < layers_.size(); ++l) {
          const double z = (depth - sea_.layers[l].depth_m) / sea_.layers[l].thickness_m;
          if (std::abs(z) < 4.0)
            layers_[l][f][i] += static_cast<float>(sea_.layers[l].sv * std::exp(-z * z / 2.0) * angle);
        }
      }
    }
  }
}

float Diffuse::vertical(std::size_t fan, double elevation_rad) const {
  const double x = (elevation_rad + kPi / 2.0) / kElevationStep;
  const int i = static_cast<int>(x);
  if (x < 0.0 || i + 1 >= kElevations) return 0.0F;
  const auto part = static_cast<float>(x - i);
  const auto& table = vertical_[fan];
  return table[static_cast<std::size_t>(i)] * (1.0F - part) + table[static_cast<std::size_t>(i) + 1] * part;
}

Diffuse::Surfaces Diffuse::look_around(const View& view) const {
  Surfaces out;
  out.nodes = receiver_.shape().samples / kNodeStep + 2;
  out.at.resize(static_cast<std::size_t>(kAzimuths * out.nodes));
  const double depth = -view.transducer_m.z;
  const auto elevation_heard = [&view](const Point<Enu>& p) {
    return static_cast<float>(std::asin(std::clamp(view.heard(p).up, -1.0, 1.0)));
  };
  for (int a = 0; a < kAzimuths; ++a) {
    const Point<Enu> ahead = view.from_ship(std::sin(azimuth_of(a)), std::cos(azimuth_of(a)), 0.0);
    for (int n = 0; n < out.nodes; ++n) {
      Surfaces::Node& node = out.at[static_cast<std::size_t>(a * out.nodes + n)];
      const double r = std::max(1.0, receiver_.range().range_m(n * kNodeStep));
      const auto place = [&](double up) {
        Point<Enu> p = ahead * std::sqrt(std::max(0.0, r * r - up * up));
        p.z = up;
        return p;
      };
      const auto in_scene = [&view](const Point<Enu>& p) { return view.in_scene(p); };
      for (std::size_t l = 0; l < sea_.layers.size(); ++l) {
        const Point<Enu> p = in_scene(place(std::max(-r, depth - sea_.layers[l].depth_m)));
        node.layer[l] = static_cast<float>(linear_from_db(3.0 * sea_.layers[l].patches.at(p.x, p.y)));
      }
      if (sea_.surface_per_m2 > 0.0 && r > depth) {
        const Point<Enu> p = place(depth);
        const Point<Enu> q = in_scene(p);
        node.surface_elevation = elevation_heard(p);
        node.surface =
            static_cast<float>(sea_.surface_per_m2 * linear_from_db(sea_.surface_patch_db(q.x, q.y, view.seconds)) / r);
      }
      if (!sea_.terrain.there) continue;
      // The ray of this length that ends on the seabed: its depth by looking again from where it ends.
      const Point<Enu> below = in_scene(place(0.0));
      double down = sea_.terrain.depth_at(below.x, below.y) - depth;
      for (int again = 0; again < 3 && down < r; ++again) {
        const Point<Enu> p = in_scene(place(-down));
        down = sea_.terrain.depth_at(p.x, p.y) - depth;
      }
      if (down >= r) continue;
      const Point<Enu> p = place(-down);
      const Point<Enu> q = in_scene(p);
      const double slope = (sea_.terrain.depth_at(q.x + 2.0 * ahead.x, q.y + 2.0 * ahead.y) -
                            sea_.terrain.depth_at(q.x - 2.0 * ahead.x, q.y - 2.0 * ahead.y)) /
                           4.0;
      const double grazing = std::asin(down / r) - std::atan(slope);
      const double lambert = std::pow(std::max(0.02, std::sin(grazing)), 2);
      node.seabed_elevation = elevation_heard(p);
      node.seabed = static_cast<float>(sea_.terrain.strength * lambert *
                                       linear_from_db(2.5 * sea_.terrain.patches.at(q.x, q.y)) / r);
    }
  }
  return out;
}

void Diffuse::fill_densities(const Surfaces& around, int fan, Densities& out) const {
  const int samples = receiver_.shape().samples;
  const auto f = static_cast<std::size_t>(fan);
  out.all.assign(static_cast<std::size_t>(kAzimuths * samples), 0.0F);
  for (auto& kind : out.layer_surface_seabed) kind.assign(static_cast<std::size_t>(samples), 0.0);
  constexpr int kSide = (kAzimuths - 1) / 2 - 20;  ///< 30 degrees either way
  for (int a = 0; a < kAzimuths; ++a) {
    const bool counted = a >= kSide && a < kAzimuths - kSide;
    for (int s = 0; s < samples; ++s) {
      const auto& low = around.at[static_cast<std::size_t>(a * around.nodes + s / kNodeStep)];
      const auto& high = around.at[static_cast<std::size_t>(a * around.nodes + s / kNodeStep + 1)];
      const float part = static_cast<float>(s % kNodeStep) / kNodeStep;
      const auto mix = [part](float x, float y) { return x + (y - x) * part; };
      const auto i = static_cast<std::size_t>(s);
      float layer = 0.0F;
      for (std::size_t l = 0; l < layers_.size(); ++l) layer += layers_[l][f][i] * mix(low.layer[l], high.layer[l]);
      float surface = 0.0F;
      if (low.surface > 0.0F) {
        const double e = static_cast<double>(mix(low.surface_elevation, high.surface_elevation));
        surface = vertical(f, e) * mix(low.surface, high.surface);
      }
      float seabed = 0.0F;
      if (low.seabed > 0.0F && high.seabed > 0.0F) {
        const double e = static_cast<double>(mix(low.seabed_elevation, high.seabed_elevation));
        seabed = vertical(f, e) * mix(low.seabed, high.seabed);
      }
      out.all[static_cast<std::size_t>(a * samples + s)] = volume_[f][i] + layer + surface + seabed;
      if (!counted) continue;
      out.layer_surface_seabed[0][i] += static_cast<double>(layer);
      out.layer_surface_seabed[1][i] += static_cast<double>(surface);
      out.layer_surface_seabed[2][i] += static_cast<double>(seabed);
    }
  }
}

void Diffuse::hear_fan(const Densities& densities, int fan, std::uint32_t observation, int ping,
                       View3<std::complex<float>> field, Array3<float>& expected) const {
  const Shape3 shape = receiver_.shape();
  const auto samples = static_cast<std::size_t>(shape.samples);
  const auto beams = static_cast<std::size_t>(shape.beams);
  std::vector<float> re(samples * beams);
  std::vector<float> im(samples * beams);
  std::vector<float> source_re(samples);
  std::vector<float> source_im(samples);
  const auto& horizontal = horizontal_[static_cast<std::size_t>(fan)];
  for (int a = 0; a < kAzimuths; ++a) {
    Gaussians draw(RandomStream(seed_, Purpose::diffuse, observation, static_cast<std::uint32_t>(ping),
                                static_cast<std::uint32_t>(fan * kAzimuths + a)));
    const float* density = densities.all.data() + static_cast<std::size_t>(a) * samples;
    for (std::size_t s = 0; s < samples; ++s) {
      const float size = std::sqrt(density[s] * static_cast<float>(kAzimuthStep));
      const std::complex<float> g = draw.next();
      source_re[s] = size * g.real();
      source_im[s] = size * g.imag();
    }
    for (std::size_t b = 0; b < beams; ++b) {
      const std::complex<float> h = horizontal[b * kAzimuths + static_cast<std::size_t>(a)];
      if (std::abs(h) < kLeastSize) continue;
      const float power = std::norm(h) * static_cast<float>(kAzimuthStep);
      float* to_re = re.data() + b * samples;
      float* to_im = im.data() + b * samples;
      float* mean = expected.row(fan, static_cast<int>(b)).data();
      for (std::size_t s = 0; s < samples; ++s) {
        to_re[s] += h.real() * source_re[s] - h.imag() * source_im[s];
        to_im[s] += h.real() * source_im[s] + h.imag() * source_re[s];
        mean[s] += power * density[s];
      }
    }
  }
  const Pulse::Taps& taps = receiver_.pulse().noise_taps();
  std::vector<std::complex<float>> raw(samples + Pulse::kTaps);
  for (std::size_t b = 0; b < beams; ++b) {
    const std::size_t row = static_cast<std::size_t>(fan) * beams + b;
    const auto per_sv = power_per_sv_sr_.row(fan, static_cast<int>(b));
    const auto mean = expected.row(fan, static_cast<int>(b));
    Gaussians noise(RandomStream(seed_, Purpose::speckle, observation, static_cast<std::uint32_t>(ping),
                                 static_cast<std::uint32_t>(row)));
    const float noise_size = std::sqrt(noise_w_[row]);
    for (std::size_t s = 0; s < samples; ++s) {
      const float watts = held_to_psi_[row] * per_sv[s];
      const float size = std::sqrt(watts);
      raw[s] = std::complex<float>(size * re[b * samples + s], size * im[b * samples + s]) + noise.next() * noise_size;
      mean[s] = mean[s] * watts + noise_w_[row];
    }
    const auto out = field.row(fan, static_cast<int>(b));
    for (std::size_t s = 0; s < samples; ++s) {
      std::complex<float> sum;
      for (std::size_t t = 0; t < Pulse::kTaps; ++t) {
        const std::size_t from = s + t;  // centred: tap kTaps/2 - 1 is the peak
        if (from >= Pulse::kTaps / 2 - 1 && from - (Pulse::kTaps / 2 - 1) < samples) {
          sum += taps[t] * raw[from - (Pulse::kTaps / 2 - 1)];
        }
      }
      out[s] += sum;
    }
  }
}

Diffuse::Heard Diffuse::add(const View& view, std::uint32_t observation, int ping,
                            View3<std::complex<float>> field) const {
  Heard heard{Array3<float>(receiver_.shape()), {}};
  const Surfaces around = look_around(view);
  constexpr std::array<CompanyKind, 3> kKinds = {CompanyKind::layer, CompanyKind::surface, CompanyKind::seabed};
  Densities densities;
  const Shape3 shape = receiver_.shape();
  for (int f = 0; f < shape.fans; ++f) {
    fill_densities(around, f, densities);
    hear_fan(densities, f, observation, ping, field, heard.expected_w);
    constexpr int kCounted = 41;
    std::optional<DiffuseStretch> open;
    for (int s = 0; s <= shape.samples; ++s) {
      std::optional<CompanyKind> strongest;
      if (s < shape.samples) {
        const auto i = static_cast<std::size_t>(s);
        const int middle = shape.beams / 2;
        const float per_sv = power_per_sv_sr_(f, middle, s);
        const float noise = noise_w_[static_cast<std::size_t>(f * shape.beams + middle)];
        // What the water itself and the noise give; a kind is there where it is more than that.
        double most = kCounted * (static_cast<double>(volume_[static_cast<std::size_t>(f)][i]) +
                                  static_cast<double>(noise / per_sv) / 0.07);
        for (std::size_t k = 0; k < kKinds.size(); ++k) {
          if (densities.layer_surface_seabed[k][i] > most) {
            most = densities.layer_surface_seabed[k][i];
            strongest = kKinds[k];
          }
        }
      }
      if (open && strongest == open->kind) {
        open->last_sample = s;
        continue;
      }
      if (open) heard.stretches.push_back(*open);
      open.reset();
      if (strongest) open = DiffuseStretch{*strongest, f, s, s};
    }
  }
  return heard;
}

}  // namespace sonar::synth::array
