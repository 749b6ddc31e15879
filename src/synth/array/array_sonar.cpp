// SPDX-License-Identifier: Apache-2.0
#include "synth/array/array_sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kMilling_m = 0.4;     ///< by which a fish's place differs from ping to ping
constexpr double kKeepsBelow_m = 0.5;  ///< the surface, and above the seabed

std::int16_t count_of(double power_w) {
  const double counts = power_w > 0.0 ? std::round(std::log2(power_w) * 256.0) : kMinCount;
  return static_cast<std::int16_t>(std::clamp(counts, static_cast<double>(kMinCount), static_cast<double>(kMaxCount)));
}

}  // namespace

double middle_wave_number(const Pattern& pattern) { return pattern.fans()[pattern.fans().size() / 2].wave_number; }

Result<GridRecord> grid_of(const Receiver& receiver, const std::vector<Beam>& stated) {
  constexpr double kPort_deg = 270.0;
  auto grid = derive_beam_grid(sounder_config(stated, ""), kPort_deg);
  if (!grid) return pass_on(grid);
  std::vector<int> channels;
  GridRecord record;
  for (const Fan& fan : receiver.pattern().fans()) {
    channels.insert(channels.end(), fan.channel.begin(), fan.channel.end());
    int count = 0;
    for (const int channel : fan.channel) count = std::max(count, stated[static_cast<std::size_t>(channel)].count);
    record.sample_count.push_back(count);
  }
  if (grid->channel != channels) {
    return fail(ErrorCode::unsupported, "the beams are not fans of equal azimuths at one frequency each");
  }
  record.grid = std::move(*grid);
  record.range = receiver.range();
  record.sound_speed_mps = kSoundSpeed_mps;
  return record;
}

/// A ping as it is gathered.
struct ArraySonar::Heard {
  Array3<std::complex<float>> field;
  ExpectedBox background;
  std::vector<SchoolField> schools;
  std::vector<BodyTruth> bodies;
  std::vector<FishTruth> fish;
  std::vector<CompanyTruth> company;
  std::vector<SphereTruth> sphere;
};

ArraySonar::ArraySonar(const Receiver& receiver, const GridRecord& grid, const Scene& scene)
    : receiver_(receiver),
      grid_(grid),
      scene_(scene),
      sector_(grid.grid.sector(grid.range)),
      wave_number_(middle_wave_number(receiver.pattern())),
      diffuse_(receiver, scene.sea, scene.voyage.ship.transducer_depth_m, scene.seed),
      power_per_sv_(receiver.shape()) {
  if (scene.sphere.diameter_mm > 0.0) sphere_m_ = sphere_amplitudes_m(scene.sphere, receiver);
  const Shape3 shape = receiver.shape();
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        power_per_sv_(f, b, s) = static_cast<float>(receiver.power_per_sv(f, b, s));
      }
    }
  }
}

View ArraySonar::view(int ping) const {
  return view_of(scene_.voyage, ping, scene_.sea.company.unsteady, scene_.sea.gradient_per_s);
}

void ArraySonar::hear_school(const School& school, const View& view, int ping, const Work& work, Heard& heard) const {
  if (work.cancelled()) return;
  RandomStream random(scene_.seed, Purpose::milling, scene_.observation, static_cast<std::uint32_t>(ping),
                      static_cast<std::uint32_t>(school.id));
  const Point<Enu> centre = view.from_transducer(school.centre_at(view.seconds));
  const double surface = -view.transducer_m.z - kKeepsBelow_m;
  std::vector<Echo> echoes;
  std::vector<PlacedEcho> placed;
  echoes.reserve(school.echoes.size());
  placed.reserve(school.echoes.size());
  double nearest = 1e9;
  double farthest = 0.0;
  for (const SchoolEcho& e : school.echoes) {
    Point<Enu> at = centre + school.offset_at(e.at_rest, view.seconds);
    at = at + Point<Enu>{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)} * kMilling_m;
    at.z = std::min(at.z, surface);
    if (scene_.sea.terrain.there) {
      const Point<Enu> there = view.in_scene(at);
      at.z = std::max(at.z, -scene_.sea.terrain.depth_at(there.x, there.y) - view.transducer_m.z + kKeepsBelow_m);
    }
    const double r = norm(at);
    const Point<Enu> seen = at * (1.0 / r);
    const double expected = e.broadside_m2 * school.mean_aspect.front().at(seen, school.heading_rad);
    std::complex<double> amplitude;
    const double first = random.normal();
    const double second = random.normal();
    if (school.together == 1) {
      const Point<Enu> axis = fish_axis(school.heading_rad + first * rad_from_deg(scene_.fish.heading_sd_deg),
                                        second * rad_from_deg(scene_.fish.tilt_sd_deg));
      const double along = axis.x * seen.x + axis.y * seen.y + axis.z * seen.z;
      amplitude = std::sqrt(e.broadside_m2 * aspect(scene_.fish, wave_number_, school.fish_length_cm, along));
    } else {
      amplitude = std::complex<double>(first, second) * std::sqrt(expected / 2.0);
    }
    placed.push_back({at, expected});
    nearest = std::min(nearest, r);
    farthest = std::max(farthest, r);
    echoes.push_back({view.heard(at), r, amplitude, expected});
  }
  heard.bodies.push_back(body_row(school, view, sector_, placed, ping));
  heard.fish.push_back(fish_row(school, heard.bodies.back()));
  const RangeAxis& range = receiver_.range();
  if (nearest > range.range_m(range.count)) return;
  ExpectedBox box;
  box.first_sample = std::max(0, Pulse::first_tap(range.sample_at(nearest)));
  const int last = std::min(range.count, Pulse::first_tap(range.sample_at(farthest)) + Pulse::kTaps);
  if (last <= box.first_sample) return;
  const Shape3 shape = receiver_.shape();
  box.power_w = Array3<float>({shape.fans, shape.beams, last - box.first_sample});
  for (const Echo& e : echoes) {
    if (work.cancelled()) return;
    receiver_.add(e, heard.field.view(), &box);
  }
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const auto power = box.power_w.row(f, b);
      for (std::size_t s = 0; s < power.size(); ++s) {
        power[s] /= power_per_sv_.row(f, b)[s + static_cast<std::size_t>(box.first_sample)];
      }
    }
  }
  heard.schools.push_back({school.id, 0, 0, box.first_sample, std::move(box.power_w)});
}

void ArraySonar::hear_company(const View& view, int ping, const Work& work, Heard& heard) const {
  const Shape3 shape = receiver_.shape();
  const RangeAxis& range = receiver_.range();
  const auto use = [&](const CompanyEchoes& thing) {
    CompanyTruth row;
    row.ping_index = ping;
    row.kind = kCompanyNames[static_cast<std::size_t>(thing.kind)];
    row.backscatter_m2 = 0.0;
    SectorIndex least{1e9, 1e9, 1e9};
    SectorIndex most{-1e9, -1e9, -1e9};
    for (std::size_t i = 0; i < thing.echoes.size(); ++i) {
      if (work.cancelled()) return;
      const Echo& e = thing.echoes[i];
      receiver_.add(e, heard.field.view(), &heard.background);
      row.backscatter_m2 += e.expected_m2;
      const SectorIndex at = sector_.index_of(to_sonar(thing.places[i], view.heading_rad));
      least = {std::min(least.fan, at.fan), std::min(least.beam, at.beam), std::min(least.sample, at.sample)};
      most = {std::max(most.fan, at.fan), std::max(most.beam, at.beam), std::max(most.sample, at.sample)};
    }
    // A beam and a pulse wider: so far it is heard.
    row.first_fan = std::max<std::int64_t>(0, std::lround(least.fan - 1.0));
    row.last_fan = std::min<std::int64_t>(shape.fans - 1, std::lround(most.fan + 1.0));
    row.first_beam = std::max<std::int64_t>(0, std::lround(least.beam - 1.0));
    row.last_beam = std::min<std::int64_t>(shape.beams - 1, std::lround(most.beam + 1.0));
    row.first_sample = std::max<std::int64_t>(0, std::lround(least.sample) - 4);
    row.last_sample = std::min<std::int64_t>(range.count - 1, std::lround(most.sample) + 4);
    if (row.first_fan > row.last_fan || row.first_beam > row.last_beam || row.first_sample > row.last_sample) return;
    heard.company.push_back(row);
  };
  for_each_company(scene_.sea, scene_.fish, wave_number_, view, scene_.seed, scene_.observation, ping,
                   range.range_m(range.count), use);
  for (const OtherPing& other : scene_.sea.others) {
    if (other.ping != ping || other.first_sample >= shape.samples) continue;
    RandomStream random(scene_.seed, Purpose::other_sounder, scene_.observation, static_cast<std::uint32_t>(ping));
    std::vector<std::complex<float>> amplitude(static_cast<std::size_t>(shape.beams));
    receiver_.pattern().receive(other.from, other.fan, amplitude);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    for (int b = 0; b < shape.beams; ++b) {
      const auto row = heard.field.row(other.fan, b);
      const int end = std::min(shape.samples, other.first_sample + other.samples);
      for (int s = other.first_sample; s < end; ++s) {
        row[static_cast<std::size_t>(s)] +=
            amplitude[static_cast<std::size_t>(b)] *
            std::complex<float>(std::polar(std::sqrt(other.power_w), phase + 0.3 * (s - other.first_sample)));
      }
    }
    CompanyTruth row;
    row.ping_index = ping;
    row.kind = kCompanyNames[static_cast<std::size_t>(CompanyKind::other_sounder)];
    row.first_fan = row.last_fan = other.fan;
    row.last_beam = shape.beams - 1;
    row.first_sample = other.first_sample;
    row.last_sample = std::min(shape.samples - 1, other.first_sample + other.samples);
    heard.company.push_back(row);
  }
}

void ArraySonar::hear_sphere(const View& view, int ping, Heard& heard) const {
  if (sphere_m_.empty()) return;
  heard.sphere.push_back(sphere_at(scene_.sphere, ping, scene_.voyage.pings, scene_.seed));
  const Point<Enu> at = place_of(heard.sphere.back(), view);
  receiver_.add({view.heard(at), norm(at), 1.0, 1.0, sphere_m_}, heard.field.view(), nullptr);
}

std::vector<RowLimits> ArraySonar::limits(const View& view) const {
  const Shape3 shape = receiver_.shape();
  const RangeAxis& range = receiver_.range();
  const double depth = view.navigation.transducer_depth_m;
  const double pulse_m = kSoundSpeed_mps * kPulseLength_s / 2.0;
  std::vector<RowLimits> rows;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const Beam& beam = receiver_.beam(f, b);
      RowLimits l;
      l.count = beam.count;
      l.near_end = static_cast<int>(std::ceil(range.sample_at(kTruthNear_m)));
      l.surface_begin = l.seabed_begin = l.count;
      const double half = rad_from_deg(beam.vertical_width_deg / 2.0);
      const double upper = rad_from_deg(beam.elevation_deg) + half;
      const double lower = rad_from_deg(beam.elevation_deg) - half;
      if (upper > 0.0) {
        const double sample = std::ceil(range.sample_at((depth - kTruthSurfaceMargin_m) / std::sin(upper)));
        l.surface_begin = static_cast<int>(std::clamp(sample, 0.0, static_cast<double>(l.count)));
      }
      const double azimuth = rad_from_deg(beam.azimuth_deg);
      for (int s = 0; scene_.sea.terrain.there && s < l.count; s += 2) {
        const double r = range.range_m(s);
        const double level = r * std::cos(lower);
        const Point<Enu> p =
            view.in_scene(view.from_ship(level * std::sin(azimuth), level * std::cos(azimuth), r * std::sin(lower)));
        if (-p.z < scene_.sea.terrain.depth_at(p.x, p.y)) continue;
        l.seabed_begin = std::max(0, static_cast<int>(range.sample_at(r - pulse_m)));
        break;
      }
      rows.push_back(l);
    }
  }
  return rows;
}

void ArraySonar::tell_schools(const View& view, int ping, Heard& heard, ArrayPing& out) const {
  const std::vector<RowLimits> rows = limits(view);
  const int beams = receiver_.shape().beams;
  const auto background_sv = [&](int row, int sample) {
    const auto i = static_cast<std::size_t>(sample);
    return static_cast<double>(heard.background.power_w.row(row / beams, row % beams)[i]) /
           static_cast<double>(power_per_sv_.row(row / beams, row % beams)[i]);
  };
  out.schools = school_truth({grid_.grid, sector_, view.navigation, rows, background_sv, ping}, heard.schools);
  for (SchoolTruth& school : out.schools) {
    if (scene_.sea.terrain.there) {
      school.row.bottom_depth_m = scene_.sea.terrain.depth_at(view.transducer_m.x, view.transducer_m.y);
    }
    for (const BodyTruth& body : out.bodies) {
      if (body.school_id != school.row.school_id) continue;
      school.row.volume_corrected_m3 = body.volume_m3;
      school.row.length_corrected_m = body.length_m;
      school.row.width_corrected_m = body.width_m;
      school.row.height_corrected_m = body.height_m;
      school.row.sv_corrected_db = body.sv_mean_db;
    }
  }
}

ArrayPing ArraySonar::ping(int ping, const Work& work) const {
  const View v = view(ping);
  const Shape3 shape = receiver_.shape();
  Heard heard;
  heard.field = Array3<std::complex<float>>(shape);
  Diffuse::Heard diffuse = diffuse_.add(v, scene_.observation, ping, heard.field.view());
  heard.background.power_w = std::move(diffuse.expected_w);
  for (const DiffuseStretch& stretch : diffuse.stretches) {
    CompanyTruth row;
    row.ping_index = ping;
    row.kind = kCompanyNames[static_cast<std::size_t>(stretch.kind)];
    row.first_fan = row.last_fan = stretch.fan;
    row.last_beam = shape.beams - 1;
    row.first_sample = stretch.first_sample;
    row.last_sample = stretch.last_sample;
    heard.company.push_back(row);
  }
  hear_company(v, ping, work, heard);
  hear_sphere(v, ping, heard);
  for (const School& school : scene_.schools) hear_school(school, v, ping, work, heard);
  if (work.cancelled()) return {};

  ArrayPing out;
  out.counts = Array3<std::int16_t>(shape, kNoData);
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      const auto field = heard.field.row(f, b);
      const auto counts = out.counts.row(f, b);
      for (std::size_t s = 0; s < static_cast<std::size_t>(receiver_.beam(f, b).count); ++s) {
        counts[s] = count_of(static_cast<double>(std::norm(field[s])));
      }
    }
  }
  out.bodies = std::move(heard.bodies);
  out.fish = std::move(heard.fish);
  out.company = std::move(heard.company);
  out.sphere = std::move(heard.sphere);
  tell_schools(v, ping, heard, out);
  return out;
}

}  // namespace sonar::synth::array
