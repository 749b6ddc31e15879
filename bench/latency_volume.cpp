// SPDX-License-Identifier: Apache-2.0
// sonar_bench_latency_volume [--check] [REPETITIONS]: how long the view in three dimensions takes from an event to the first, coarse
// picture that answers it, on a simulated MS70 survey, seen at 900 x 700 and drawn by the processor: a step to a ping that
// was made ahead, an edit of the transfer function, a turn, a hovered preview; and to the last, finest one. The picture at
// rest is compared with one that a fresh back-end draws before anything is timed. First pictures stand beside their
// target; with --check a missed one ends with 1.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "latency_clock.h"
#include "latency_targets.h"
#include "session/volume/volume_model.h"
#include "synth/beam_table.h"
#include "synth/simulate.h"

namespace sonar::bench {
namespace {

constexpr PixelSize kSize{900, 700};
constexpr int kPings = 16;
constexpr double kFirst_ms = 50.0;

class Bench {
 public:
  Bench(const std::filesystem::path& folder, LatencyTargets& targets)
      : targets_(targets), workspace_(queue_, options(folder / "journal")) {
    VolumeParams params;
    params.renderer = RendererChoice::cpu;
    workspace_.volume.assign(params);
    workspace_.document.open({folder / "raw"});
    workspace_.document.settle();
    must(workspace_.document.shown() != nullptr, "no survey");
    show();
    const double begin = now_ms();
    settle();
    fmt::print("first picture of all, to rest: {:.0f} ms\n", now_ms() - begin);
    verify();
  }

  void step(int repetitions) {
    repeat("ping step, made ahead", repetitions, [this](int i) {
      const std::int64_t next = (i / 8) % 2 == 0 ? 1 : -1;
      workspace_.document.look_at(workspace_.document.ping() + next);
    });
  }
  void edit_table(int repetitions) {
    repeat("transfer function edited", repetitions, [this](int i) {
      SvScale scale;
      scale.low_db = -60.0 - 0.5 * (i % 8 + 1);
      workspace_.view_curve.set(*transfer_function(scale));
    });
  }
  void turn(int repetitions) {
    repeat("turned", repetitions, [this](int i) {
      const PixelPoint from{400.0, 300.0};
      model_->pointer({PointerAction::press, PointerButton::left, from});
      model_->pointer({PointerAction::move, PointerButton::left, {from.x + 10.0 + i, from.y + 3.0}});
      model_->pointer({PointerAction::release, PointerButton::left, from});
    });
  }
  /// How long the window itself is held up by a pointer over the volume.
  void point(int repetitions) {
    std::vector<double> ms;
    for (int i = 0; i < repetitions * 10; ++i) {
      const double begin = now_ms();
      (void)model_->shown()->picked_at({100.0 + 37.0 * (i % 17), 100.0 + 29.0 * (i % 19)});
      ms.push_back(now_ms() - begin);
    }
    report("pick under a pointer, in the window's thread", ms, std::nullopt);
  }

 private:
  static DocumentOptions options(const std::filesystem::path& journal) {
    std::filesystem::create_directories(journal);
    DocumentOptions options;
    options.program_version = "bench";
    options.prefetch = kPings;
    options.journal_folders = [journal](const auto&) { return std::vector{journal}; };
    return options;
  }
  void show() {
    model_ = std::make_unique<VolumeModel>(workspace_);
    model_->resize(kSize, 1.0);
    model_->set_seen(true);
  }
  void settle() {
    do {
      workspace_.document.settle();
      model_->wait();
    } while (queue_.drain() > 0);
  }
  void verify() {
    const Image before = model_->image();
    must(model_->shown() != nullptr && model_->shown()->done, "no picture");
    show();
    settle();
    must(model_->image() == before, "two back-ends draw the same ping differently");
  }

  void repeat(const std::string& what, int repetitions, const std::function<void(int)>& event) {
    std::vector<double> first;
    std::vector<double> rest;
    int coarsest = 0;
    for (int i = 0; i < repetitions; ++i) {
      settle();
      const std::int64_t pictures = model_->pictures();
      const double begin = now_ms();
      event(i);
      while (model_->pictures() == pictures) {
        queue_.wait();
        queue_.drain();
      }
      first.push_back(now_ms() - begin);
      must(model_->shown()->ping_index == workspace_.document.ping(), "a picture of another ping");
      coarsest = std::max(coarsest, model_->shown()->divisor);
      settle();
      rest.push_back(now_ms() - begin);
    }
    report(fmt::format("{}: first picture (up to 1/{} of the resolution)", what, coarsest), first, kFirst_ms);
    report(fmt::format("{}: at rest", what), rest, std::nullopt);
  }

  void report(const std::string& what, std::vector<double> ms, std::optional<double> target_ms) {
    fmt::print("{}\n", targets_.line(what, std::move(ms), target_ms));
  }

  LatencyTargets& targets_;
  ChangeQueue queue_;
  Workspace workspace_;
  std::unique_ptr<VolumeModel> model_;
};

int run(int repetitions, bool check) {
  LatencyTargets targets(check);
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sonar-bench-volume-{}", ::getpid());
  {
    synth::SurveyParams params = synth::survey_params(synth::Preset::standard);
    params.observations = 1;
    params.pings = kPings;
    Work work;
    must(!!synth::simulate_survey(folder / "raw", params, synth::ms70_beams(), false, "bench", work), "no survey");
    Bench bench(folder, targets);
    bench.step(repetitions);
    bench.edit_table(repetitions);
    bench.turn(repetitions);
    bench.point(repetitions);
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
  const int repetitions = given.others.empty() ? 10 : std::clamp(std::atoi(given.others[0].c_str()), 1, 1000);
  return sonar::bench::run(repetitions, given.check);
}
