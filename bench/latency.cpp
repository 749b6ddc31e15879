// SPDX-License-Identifier: Apache-2.0
// sonar_bench_latency [--check] [REPETITIONS [SURVEY]]: how long the desktop takes from an event to the picture that answers it,
// on a simulated MS70 survey, both slices seen at 700 x 500: hovering (growth, both slices), a change of tolerance, a
// step to a ping that was made ahead; and opening a survey (SURVEY, else a small one). Every answer is compared with
// one worked out anew before it is timed. Each time stands beside its target; with --check a missed one ends with 1.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "latency_clock.h"
#include "latency_targets.h"
#include "pipeline/stages/observe.h"
#include "publish/picture_output.h"
#include "session/app_model.h"
#include "session/playing/playback.h"
#include "session/slices/slice_build.h"
#include "session/slices/slice_model.h"
#include "session/slices/slice_places.h"
#include "session/tools/seed_tool.h"
#include "synth/beam_table.h"
#include "synth/simulate.h"

namespace sonar::bench {
namespace {

constexpr PixelSize kSize{700, 500};
constexpr PixelSize kVolumeSize{900, 700};
constexpr double kHover_ms = 10.0;
constexpr double kSlice_ms = 16.0;
constexpr double kVolume_ms = 50.0;  ///< of a first, coarse volume
constexpr int kPings = 40;

class Bench {
 public:
  Bench(const std::filesystem::path& folder, LatencyTargets& targets)
      : targets_(targets), app_(queue_, options(folder / "journal")) {
    document().open({folder / "raw"});
    for (SliceModel* slice : {&top(), &side()}) {
      slice->resize(kSize, 1.0);
      slice->set_seen(true);
    }
    settle();
    must(document().shown() != nullptr, "no survey");
    find_school();
    document().look_at(ping_);
    app_.workspace.slices.set({voxel_.fan, voxel_.beam, voxel_.sample});
    settle();
  }

  void hover(int repetitions) {
    // Neighbouring samples of the school's brightest voxel, so that every growth is another one of its size.
    std::vector<double> ms;
    for (int i = 0; i < repetitions; ++i) {
      const Voxel voxel{voxel_.fan, voxel_.beam, voxel_.sample + i % 3};
      const auto pointed = [&] { return hovered(voxel); };
      ms.push_back(timed([&] { app_.seed_tool->hover(voxel, false, false); }, pointed, true));
      if (i == 0) verify_preview(voxel);
    }
    report("hover: growth, text, both slices", ms, kHover_ms);
    fmt::print("    {}\n", app_.workspace.preview().text);
  }

  void tolerance(int repetitions) {
    std::vector<double> ms;
    app_.seed_tool->hover(voxel_, false, false);
    settle();
    for (int i = 0; i < repetitions; ++i) {
      const double db = 6.0 + 0.25 * (i % 24);
      ms.push_back(timed([&] { must(!!app_.workspace.select.set("tolerance_db", db), "tolerance"); },
                         [&] { return preview_moved(); }, true));
      if (i == 0) verify_preview(voxel_);
    }
    report("tolerance: growth, text, both slices", ms, kSlice_ms);
    must(!!app_.workspace.select.reset("tolerance_db"), "tolerance");
    app_.seed_tool->leave();
    settle();
  }

  void step(int repetitions) {
    std::vector<double> ms;
    for (int i = 0; i < repetitions; ++i) {
      const std::int64_t next = (i / 4) % 2 == 0 ? document().ping() + 1 : document().ping() - 1;
      settle();  // made ahead
      const auto stepped = [&] { return document().staged() && document().staged()->ping_index == next; };
      ms.push_back(timed([&] { document().look_at(next); }, stepped, true));
      if (i == 0) verify_slices();
    }
    report("ping step, made ahead: both slices", ms, kSlice_ms);
  }

  /// A turn of the wheel on the range slice, and on a plane of each kind: until that slice shows the next one.
  void wheel(int repetitions) {
    move(SliceKind::range, "wheel: range slice", repetitions);
    for (std::size_t kind = 0; kind < kPlaneKindNames.size(); ++kind) {
      choose_plane(app_.workspace, static_cast<PlaneSlice::Kind>(kind));
      move(SliceKind::plane, fmt::format("wheel: {} plane", kPlaneKindNames.at(kind)), repetitions);
    }
  }

  /// The same with the volume seen: the event until both slices and a first, coarse volume show the ping.
  void step_with_volume(int repetitions) {
    LivePicture& volume = *app_.picture("volume");
    VolumeParams params;
    params.renderer = RendererChoice::cpu;
    app_.workspace.volume.assign(params);
    volume.resize(kVolumeSize, 1.0);
    volume.set_seen(true);
    std::vector<double> all;
    std::vector<double> slices;
    for (int i = 0; i < repetitions; ++i) {
      const std::int64_t next = (i / 4) % 2 == 0 ? document().ping() + 1 : document().ping() - 1;
      do {
        settle();
        volume.wait();
      } while (queue_.drain() > 0);
      const std::int64_t volumes = volume.pictures();
      const double begin = now_ms();
      const auto stepped = [&] { return document().staged() && document().staged()->ping_index == next; };
      slices.push_back(timed([&] { document().look_at(next); }, stepped, true, false));
      while (volume.pictures() == volumes) {
        queue_.wait();
        queue_.drain();
      }
      all.push_back(now_ms() - begin);
    }
    volume.set_seen(false);
    report("ping step, volume seen: both slices", slices, kSlice_ms);
    report("ping step: both slices and a first volume", all, kVolume_ms);
  }

 private:
  static DocumentOptions options(const std::filesystem::path& journal) {
    std::filesystem::create_directories(journal);
    DocumentOptions options;
    options.program_version = "bench";
    options.journal_folders = [journal](const auto&) { return std::vector{journal}; };
    return options;
  }
  Document& document() { return app_.workspace.document; }
  SliceModel& top() { return dynamic_cast<SliceModel&>(*app_.picture("top_slice")); }
  SliceModel& side() { return dynamic_cast<SliceModel&>(*app_.picture("side_slice")); }
  SliceModel& range() { return dynamic_cast<SliceModel&>(*app_.picture("range_slice")); }
  SliceModel& plane() { return dynamic_cast<SliceModel&>(*app_.picture("plane_slice")); }
  void settle() {
    do {
      document().settle();
      app_.seed_tool->wait();
      for (SliceModel* slice : {&top(), &side(), &range(), &plane()}) slice->wait();
    } while (queue_.drain() > 0);
  }

  /// From the event until both slices show what holds now: the window's loop, which drains whenever something came.
  double timed(const std::function<void()>& event, const std::function<bool()>& answered, bool both,
               bool settled_first = true) {
    if (settled_first) settle();
    before_ = app_.workspace.preview().mask;
    const double begin = now_ms();
    event();
    while (!answered()) {
      queue_.wait();
      queue_.drain();
    }
    // The pictures that were asked for at that moment are the last ones.
    const std::int64_t tops = top().pictures();
    const std::int64_t sides = side().pictures();
    while (both && (top().pictures() == tops || side().pictures() == sides)) {
      queue_.wait();
      queue_.drain();
    }
    return now_ms() - begin;
  }
  bool preview_moved() { return app_.workspace.preview().mask && app_.workspace.preview().mask != before_; }
  bool hovered(const Voxel& voxel) {
    const auto& mask = app_.workspace.preview().mask;
    return preview_moved() &&
           confidence_at(*mask, voxel.fan * document().shown()->sector().beams() + voxel.beam, voxel.sample) == 255;
  }

  void verify_preview(const Voxel& voxel) {
    FilteredPing ping;
    ping.volume = document().staged()->filtered;
    const SeedKey seed = seed_key(*document().shown(), voxel);
    const auto fresh = grow_seeds(document().shown()->context(), ping, std::span(&seed, 1),
                                  app_.workspace.growth_curve(), grow_params(app_.workspace.select.values()));
    must(fresh && *fresh == *app_.workspace.preview().mask, "the preview is not what grows");
    verify_slices();
  }

  void move(SliceKind kind, const std::string& what, int repetitions) {
    SliceModel& slice = kind == SliceKind::range ? range() : plane();
    slice.resize(kSize, 1.0);
    slice.set_seen(true);
    std::vector<double> ms;
    for (int i = 0; i < repetitions; ++i) {
      settle();
      const std::int64_t before = slice.pictures();
      const double begin = now_ms();
      step_slice(app_.workspace, kind, (i / 4) % 2 == 0 ? 1 : -1);
      while (slice.pictures() == before) {
        queue_.wait();
        queue_.drain();
      }
      ms.push_back(now_ms() - begin);
      if (i == 0) verify({&slice});
    }
    slice.set_seen(false);
    report(what, ms, kSlice_ms);
  }

  void verify_slices() { verify({&top(), &side()}); }
  /// Pictures against ones that are made without any that were before.
  void verify(std::initializer_list<SliceModel*> slices) {
    for (SliceModel* slice : slices) {
      SliceWish wish;
      wish.observation = document().shown();
      wish.ping = document().staged();
      wish.view = slice->picture()->map->view();
      wish.display = app_.workspace.display.values();
      wish.colours = std::make_shared<const SvColours>(slice_colours(app_.workspace));
      wish.layers = school_layers(app_.workspace, wish.ping->ping_index, light_theme(kSize));
      wish.room = std::make_shared<FlagRoom>();
      const auto fresh = slice_of(wish, kSize);
      must(fresh.has_value(), "no slice");
      const auto image = painted(fresh->frame, 1.0);
      must(image && *image == slice->image(), "a slice is not the one made anew");
    }
  }

  void find_school() {
    Work work;
    const auto found = observe(*document().survey(), document().shown()->files(), Recipe{}, {{}, {}, "bench"}, work);
    must(found && !found->masks.empty(), "no school");
    const SchoolMask* largest = nullptr;
    for (const SchoolMask& mask : found->masks) {
      const bool inside = mask.ping_index >= 6 && mask.ping_index < kPings - 6;
      if (inside && (largest == nullptr || mask.mask.voxels() > largest->mask.voxels())) largest = &mask;
    }
    must(largest != nullptr, "no school in the middle");
    ping_ = largest->ping_index;
    const PingMask& mask = largest->mask;
    auto left = std::max_element(mask.confidence.begin(), mask.confidence.end()) - mask.confidence.begin();
    const int beams = document().shown()->sector().beams();
    for (const Run& run : mask.runs) {
      if (left < run.count) {
        voxel_ = {run.row / beams, run.row % beams, run.first_sample + static_cast<int>(left)};
        return;
      }
      left -= run.count;
    }
  }

  void report(const std::string& what, std::vector<double> ms, double target_ms) {
    fmt::print("{}\n", targets_.line(what, std::move(ms), target_ms));
  }

  LatencyTargets& targets_;
  ChangeQueue queue_;
  AppModel app_;
  std::int64_t ping_ = 0;
  Voxel voxel_;
  std::shared_ptr<const PingMask> before_;
};

/// Clicks upon the brightest voxels of one ping after another, each school deleted again, until so many acts stand in the
/// journal.
void fill_journal(const std::filesystem::path& survey, const std::filesystem::path& folder, std::size_t acts) {
  ChangeQueue queue;
  DocumentOptions options;
  options.program_version = "bench";
  options.cache = {folder / "cache"};
  options.journal_folders = [&](const auto&) { return std::vector{folder / "journal"}; };
  Document document(queue, options);
  document.open({survey});
  document.settle();
  for (std::size_t i = 0; document.choices().lines->size() < acts && i < 4 * acts; ++i) {
    document.look_at(static_cast<std::int64_t>(i) % document.shown()->pings());
    document.settle();
    const Volume& filtered = *document.staged()->filtered;
    const auto counts = filtered.counts.all();
    std::size_t best = 0;
    for (std::size_t v = 0; v < counts.size(); ++v) {
      if (counts[v] > counts[best] && !any(filtered.flags.all()[v])) best = v;
    }
    const auto samples = static_cast<std::size_t>(filtered.counts.shape().samples);
    GrowCommand command;
    const SeedKey seed{document.shown()->grid().channel[best / samples], static_cast<int>(best % samples)};
    command.seeds = {seed};
    document.act(command);
    const auto ping = static_cast<std::size_t>(document.ping());
    document.act(DeleteCommand{{document.shown()->context().times[ping], seed.channel, seed.sample}});
    document.settle();
  }
  fmt::print("  a journal of {} acts\n", document.choices().lines->size());
}

/// From the wish to open a survey, indexed before, to the first slice on show.
void opening(LatencyTargets& targets, const std::filesystem::path& survey, const std::filesystem::path& folder,
             int repetitions) {
  constexpr double kLarge_bytes = 1e10;
  std::vector<double> ms;
  std::vector<double> not_indexed;
  std::error_code absent;
  std::filesystem::remove_all(folder / "cache", absent);
  for (int i = 0; i <= repetitions; ++i) {  // the first one makes the index
    ChangeQueue queue;
    DocumentOptions options;
    options.program_version = "bench";
    options.cache = {folder / "cache"};
    options.journal_folders = [&](const auto&) { return std::vector{folder / "journal"}; };
    AppModel app(queue, options);
    LivePicture& slice = *app.picture("top_slice");
    slice.resize(kSize, 1.0);
    slice.set_seen(true);
    const double begin = now_ms();
    app.workspace.document.open({survey});
    while (slice.image().size.width == 0 || !app.workspace.document.staged()) {
      queue.wait();
      queue.drain();
    }
    (i > 0 ? ms : not_indexed).push_back(now_ms() - begin);
    must(slice.image().size == kSize, "the first picture");
    app.workspace.document.settle();
  }
  double bytes = 0.0;
  for (const auto& file : std::filesystem::directory_iterator(survey)) {
    if (file.is_regular_file()) bytes += static_cast<double>(file.file_size());
  }
  const double target_ms = bytes > kLarge_bytes ? 2000.0 : 1000.0;
  fmt::print("{}\n", targets.line(fmt::format("opening {:.0f} MB, indexed: first slice", bytes / 1e6), ms, target_ms));
  fmt::print("{}\n", targets.line("the same, not indexed, files in memory", not_indexed, std::nullopt));
}

int run(int repetitions, const std::string& survey, bool check) {
  LatencyTargets targets(check);
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sonar-bench-latency-{}", ::getpid());
  synth::SurveyParams params = synth::survey_params(synth::Preset::standard);
  params.observations = 1;
  params.pings = kPings;
  params.schools = 4;
  {
    Work work;
    const auto made = synth::simulate_survey(folder / "raw", params, synth::ms70_beams(), false, "bench", work);
    must(made.has_value(), "no survey was made");
    Bench bench(folder, targets);
    bench.hover(repetitions);
    bench.tolerance(repetitions);
    bench.step(repetitions);
    bench.wheel(repetitions);
    bench.step_with_volume(repetitions);
    const std::filesystem::path opened = survey.empty() ? folder / "raw" : std::filesystem::path(survey);
    opening(targets, opened, folder, 5);
    fill_journal(opened, folder, 300);
    opening(targets, opened, folder, 5);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  fmt::print("{}\n", targets.verdict());
  return targets.exit_code();
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  const auto given = sonar::bench::latency_arguments(argc, argv);
  const auto& others = given.others;
  return sonar::bench::run(others.empty() ? 31 : std::max(1, std::atoi(others[0].c_str())),
                           others.size() > 1 ? others[1] : "", given.check);
}
