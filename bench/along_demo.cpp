// SPDX-License-Identifier: Apache-2.0
// sonar_bench_along [FOLDER]: the demo survey's ping 66 seen along the beams, where thin cells would lose what varies
// across them, against the same picture in which no cell is taken for thin (limit 0); and against half the step, where
// too long a one would leave the grain of wood. The survey to that ping is made anew, in FOLDER where one is named, which is kept. Ends
// with 1 where a picture misses 60 dB, or a tile of 64 x 64 pixels 54 dB, or 48 dB against half the step. The numbers do not
// depend on the machine.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "publish/picture_source.h"
#include "publish/renderer_choice.h"
#include "publish/volumes/volume_figure.h"
#include "render/draw_frame.h"
#include "render/reference/brute_force.h"
#include "render/volume_renderer.h"
#include "synth/beam_table.h"
#include "synth/simulate.h"
#include "targets.h"

namespace sonar::bench {
namespace {

constexpr std::int64_t kPing = 66;
constexpr PixelSize kSize{1024, 768};

template <class T>
T must(Result<T> result) {
  if (!result) {
    fmt::print(stderr, "{}\n", to_line(result.error()));
    std::exit(EXIT_FAILURE);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// The ping without noise in viridis from -75 dB, as it is drawn; its camera stands behind the transducer and looks along
/// the middle beam.
struct Scene {
  std::shared_ptr<const VolumeData> volume;
  OpticalTable table;
  VolumeView view;
};

Scene scene_of(const std::filesystem::path& survey, Work& work) {
  const auto source = must(PictureSource::open({&survey, 1}, std::nullopt, work));
  DrawnObservation* observation = must(source->observation(""));
  const Sector sector = must(observation->sector());
  const DrawnPing ping = must(observation->ping(kPing, work));
  PictureOptions options;
  options.display.scale.low_db = -75.0;
  options.display.scale.map = ColourMapName::viridis;
  Scene out;
  out.volume = drawn_volume(sector, *ping.staged, options, {}, ping.navigation.transducer_depth_m);
  out.table = must(volume_table(options));
  out.view.size = kSize;
  out.view.camera = overview(sector, kSize);
  out.view.camera.target = sector.centre(sector.fans() / 2, sector.beams() / 2, 200);
  out.view.camera.eye = out.view.camera.target * -0.3 + Point<Sonar>{0.0, 0.0, -6.0};
  return out;
}

void compare(VolumeRenderer& renderer, const Scene& scene, Targets& targets, Work& work) {
  must(renderer.set_volume(scene.volume));
  must(renderer.set_transfer(scene.table));
  const auto drawn = [&](double limit, double step_samples = 1.0) {
    return over(must(renderer.draw(scene.view, {1, step_samples, limit, 0}, work)), Rgba8{0, 0, 0, 255});
  };
  const Image thin = drawn(DrawQuality{}.homogeneous_limit);
  const Image exact = drawn(0.0);
  const auto lit = std::count_if(exact.pixels.begin(), exact.pixels.end(),
                                 [](const Rgba8& pixel) { return pixel.r + pixel.g + pixel.b > 24; });
  const double share = static_cast<double>(lit) / static_cast<double>(kSize.count());
  targets.require(share > 0.1, "an empty picture proves nothing");
  const double whole = psnr_db(thin, exact);
  const double tile = worst_tile_psnr_db(thin, exact);
  fmt::print("{}: {:.1f} dB, worst tile {:.1f} dB, echoes in {:.0f} % of the pixels\n", renderer.name(), whole, tile,
             100.0 * share);
  targets.at_least(fmt::format("{}, dB along the beams", renderer.name()), 60.0, whole);
  targets.at_least(fmt::format("{}, dB of the worst tile", renderer.name()), 54.0, tile);
  targets.at_least(fmt::format("{}, dB of the worst tile against half the step", renderer.name()), 48.0,
                   worst_tile_psnr_db(exact, drawn(0.0, 0.5)));
}

int run(const std::filesystem::path& folder) {
  Work work(2);
  const synth::SurveyParams params = synth::survey_params(synth::Preset::demo);
  auto scenes = must(synth::survey_scenes(params, synth::ms70_beams()));
  scenes.resize(1);
  scenes.front().pings = kPing + 8;  // what comes later is not looked at
  must(synth::simulate_scenes(folder, scenes, params, synth::ms70_beams(), true, "bench", work));
  const Scene scene = scene_of(folder, work);
  Targets targets;
  for (const RendererChoice choice : {RendererChoice::cpu, RendererChoice::gl}) {
    const auto offscreen = offscreen_renderer(choice);
    if (offscreen) {
      compare(*offscreen->renderer, scene, targets, work);
    } else {
      targets.skip("a back-end", to_line(offscreen.error()));
    }
  }
  for (const std::string& line : targets.news()) fmt::print("{}\n", line);
  for (const std::string& line : targets.verdict()) fmt::print("{}\n", line);
  return targets.hold() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  if (argc > 1) return sonar::bench::run(argv[1]);
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sonar-bench-along-{}", ::getpid());
  const int code = sonar::bench::run(folder);
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return code;
}
