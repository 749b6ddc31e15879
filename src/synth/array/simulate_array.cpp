// SPDX-License-Identifier: Apache-2.0
#include "synth/array/simulate_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "io/atomic_file.h"
#include "synth/array/array_sonar.h"
#include "synth/random.h"
#include "synth/truth_files.h"

namespace sonar::synth::array {
namespace {

constexpr Geographic kArea{61.5, 2.5};
constexpr double kBetweenObservations_m = 15'000.0;

/// Each seed has a day of its own, so that surveys can be told apart.
TimeNs start_of(int seed) {
  constexpr TimeNs kDay = 86'400 * kSecondNs;
  return time_from_calendar(2031, 1, 1, 9.0 * 3600.0 + 0.2) + (seed % 3000) * kDay;
}

std::vector<Voyage> voyages(const ArrayParams& params) {
  std::vector<Voyage> all;
  RandomStream random(static_cast<std::uint64_t>(params.seed), Purpose::placement, 0xFFFFFFFFU);
  const double towards_deg = random.uniform(0.0, 360.0);
  for (int i = 0; i < params.observations; ++i) {
    Voyage v;
    v.ship.origin = destination(kArea, kBetweenObservations_m * i, towards_deg);
    v.ship.course_deg = random.uniform(0.0, 360.0);
    v.ship.speed_mps = params.speed_knots * kKnot_mps;
    v.ship.yaw_deg = v.ship.pitch_deg = params.motion_deg;
    v.ship.roll_deg = 3.0 * params.motion_deg;
    v.ship.log_start_nmi = 2000.0;
    v.first_ping = start_of(params.seed);
    v.ping_interval_s = params.ping_interval_s;
    v.pings = params.pings;
    if (i > 0) follow_on(all.back(), params.gap_s, v);
    all.push_back(v);
  }
  return all;
}

template <class Row>
void append(std::vector<Row>& all, std::vector<Row> more, const std::string& observation) {
  for (Row& row : more) {
    row.observation = observation;
    all.push_back(std::move(row));
  }
}

/// The tables that only this physics knows.
struct FurtherTruth {
  std::vector<FishTruth> fish;
  std::vector<CompanyTruth> company;
  std::vector<WaterTruth> water;
  std::vector<BeamTruth> beams;
  std::vector<SphereTruth> sphere;

  [[nodiscard]] Result<void> write(const std::filesystem::path& folder) const {
    if (auto done = write_truth(folder / "fish.csv", fish); !done) return done;
    if (auto done = write_truth(folder / "company.csv", company); !done) return done;
    if (auto done = write_truth(folder / "water.csv", water); !done) return done;
    if (auto done = write_truth(folder / "beams.csv", beams); !done) return done;
    return sphere.empty() ? Result<void>{} : write_truth(folder / "sphere.csv", sphere);
  }
};

/// stated  what the raw files say; the receiver has what is true
std::vector<BeamTruth> beam_rows(const std::vector<Beam>& stated, const Receiver& receiver,
                                 const SphereParams& sphere) {
  const Pattern& pattern = receiver.pattern();
  const std::vector<double> sphere_m =
      sphere.diameter_mm > 0.0 ? sphere_amplitudes_m(sphere, receiver) : std::vector<double>{};
  std::vector<BeamTruth> rows(stated.size());
  for (std::size_t f = 0; f < pattern.fans().size(); ++f) {
    const std::vector<int>& channels = pattern.fans()[f].channel;
    for (std::size_t b = 0; b < channels.size(); ++b) {
      const auto i = static_cast<std::size_t>(channels[b]);
      const Beam& is = receiver.beams()[i];
      const Pattern::TwoWayWidths widths = pattern.two_way_widths(static_cast<int>(f), static_cast<int>(b));
      rows[i] = {static_cast<std::int64_t>(i),
                 is.elevation_deg,
                 is.azimuth_deg,
                 stated[i].psi_db,
                 db_from_linear(pattern.psi_sr(static_cast<int>(i))),
                 is.sa_correction_db,
                 stated[i].sa_correction_db,
                 is.gain_db,
                 stated[i].gain_db,
                 deg_from_rad(widths.up) / std::max(0.1, std::cos(rad_from_deg(is.elevation_deg))),
                 deg_from_rad(widths.bow) / std::max(0.1, std::cos(rad_from_deg(is.azimuth_deg))),
                 sphere_m.empty() ? kUnknown : 20.0 * std::log10(sphere_m[f])};
    }
  }
  return rows;
}

/// What the water lets a sphere run do without: 30 m beyond the sphere nothing is recorded.
std::vector<Beam> recorded_beams(const SphereParams& sphere) {
  std::vector<Beam> beams = ms70_beams();
  constexpr double kBeyond_m = 30.0;
  if (sphere.diameter_mm <= 0.0) return beams;
  const double samples = (sphere.range_m + kBeyond_m) / (kSoundSpeed_mps * kSampleInterval_s / 2.0);
  for (Beam& beam : beams) beam.count = std::min(beam.count, static_cast<int>(samples));
  return beams;
}

/// One ping's datagrams and its truth.
struct EncodedPing {
  PingBytes raw;
  ArrayPing made;
};

EncodedPing encode(const ArraySonar& sonar, const Receiver& receiver, const GridRecord& grid, int ping,
                   const Work& work) {
  EncodedPing e;
  e.made = sonar.ping(ping, work);
  if (work.cancelled()) return e;
  std::vector<ChannelCounts> channels;
  for (std::size_t row = 0; row < grid.grid.channel.size(); ++row) {
    const int channel = grid.grid.channel[row];
    const auto count = static_cast<std::size_t>(receiver.beams()[static_cast<std::size_t>(channel)].count);
    channels.push_back({channel, std::as_const(e.made.counts).view().row(static_cast<int>(row)).first(count)});
  }
  std::sort(channels.begin(), channels.end(),
            [](const ChannelCounts& a, const ChannelCounts& b) { return a.channel < b.channel; });
  e.raw = ping_bytes(sonar.scene().voyage, ping, receiver.beams(), channels);
  e.made.counts = {};
  return e;
}

/// Makes and writes the observations of a survey, one after the other.
class Survey {
 public:
  Survey(const std::filesystem::path& out, const ArrayParams& params, const Receiver& receiver,
         const std::vector<Beam>& stated, const GridRecord& grid, const std::string& program_version, Work& work)
      : params_(params),
        receiver_(receiver),
        grid_(grid),
        work_(work),
        files_(out, sounder_config(stated, kSurveyName), params.file_mb),
        truth_(out / "truth", kSurveyName, program_version),
        folder_(out / "truth") {
    further_.beams = beam_rows(stated, receiver, params.sphere);
  }

  Result<void> add(const Voyage& voyage, int number) {
    Scene scene;
    scene.voyage = voyage;
    scene.observation = static_cast<std::uint32_t>(number);
    scene.seed = static_cast<std::uint64_t>(params_.seed);
    scene.fish = params_.fish;
    scene.sphere = params_.sphere;
    scene.sea = make_sea(params_, voyage, scene.observation, receiver_.shape().fans);
    const double wave_number = middle_wave_number(receiver_.pattern());
    scene.schools = make_schools({params_, scene.voyage, scene.sea.terrain, wave_number, scene.observation}, work_);
    const std::string name = fmt::format("obs-{:04d}", number + 1);
    append(further_.water, water_rows(name, scene.sea), name);
    const ArraySonar sonar(receiver_, grid_, scene);
    ObservationTruth observation(name);
    if (auto written = write_pings(sonar, name, observation); !written) return written;
    std::ranges::stable_sort(further_.fish, {}, [](const FishTruth& row) {
      return std::tie(row.observation, row.school_id, row.ping_index);  // as bodies.csv
    });
    if (auto closed = files_.close(); !closed) return closed;
    return truth_.add(std::move(observation), grid_);
  }

  Result<SimulateResult> finish() {
    if (auto done = truth_.finish(); !done) return pass_on(done);
    if (auto done = further_.write(folder_); !done) return pass_on(done);
    SimulateResult result;
    result.files = files_.files();
    result.bytes = files_.bytes();
    result.pings = pings_;
    result.schools = truth_.schools();
    return result;
  }

 private:
  /// Pings are made some at a time on all threads and written in order.
  Result<void> write_pings(const ArraySonar& sonar, const std::string& name, ObservationTruth& observation) {
    const Voyage& voyage = sonar.scene().voyage;
    const int batch = 2 * work_.threads();
    for (int first = 0; first < voyage.pings; first += batch) {
      std::vector<EncodedPing> made(static_cast<std::size_t>(std::min(batch, voyage.pings - first)));
      work_.for_each(static_cast<std::int64_t>(made.size()), [&](std::int64_t i) {
        made[static_cast<std::size_t>(i)] = encode(sonar, receiver_, grid_, first + static_cast<int>(i), work_);
      });
      if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      for (EncodedPing& e : made) {
        if (auto written = files_.add(e.raw); !written) return written;
        observation.add(navigation_at(voyage, voyage.seconds_of(first + static_cast<int>(&e - made.data()))),
                        std::move(e.made.schools), std::move(e.made.bodies));
        append(further_.fish, std::move(e.made.fish), name);
        append(further_.company, std::move(e.made.company), name);
        append(further_.sphere, std::move(e.made.sphere), name);
      }
      pings_ += static_cast<std::int64_t>(made.size());
      work_.progress("simulate", pings_, std::int64_t{params_.observations} * params_.pings);
    }
    return {};
  }

  const ArrayParams& params_;
  const Receiver& receiver_;
  const GridRecord& grid_;
  Work& work_;
  SurveyFiles files_;
  SurveyTruth truth_;
  FurtherTruth further_;
  std::filesystem::path folder_;
  std::int64_t pings_ = 0;
};

}  // namespace

Result<SimulateResult> simulate_array_survey(const std::filesystem::path& out, const ArrayParams& params, bool force,
                                             const std::string& program_version, Work& work) {
  if (auto ok = check(params); !ok) return pass_on(ok);
  const std::vector<Voyage> all = voyages(params);
  const std::vector<Beam> table = recorded_beams(params.sphere);
  std::uint64_t bytes = 0;
  for (const Voyage& voyage : all) bytes += bytes_of(voyage, table);
  auto folder = SurveyFolder::prepare(out, force, bytes);
  if (!folder) return pass_on(folder);
  const Pattern pattern(params.elements, table, static_cast<std::uint64_t>(params.seed), work);
  const Pulse pulse(kPulseLength_s, kSampleInterval_s, params.elements.pulse_taper);
  const Receiver receiver(pattern, pulse, stated_beams(table, pattern, params.elements, pulse.effective_s()));
  const auto grid = grid_of(receiver, receiver.beams());
  if (!grid) return pass_on(grid);
  const auto stated = with_errors(receiver.beams(), params.elements, static_cast<std::uint64_t>(params.seed));
  Survey survey(out, params, receiver, stated, *grid, program_version, work);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (auto added = survey.add(all[i], static_cast<int>(i)); !added) return pass_on(added);
  }
  auto made = survey.finish();
  if (made) folder->keep();
  return made;
}

}  // namespace sonar::synth::array
