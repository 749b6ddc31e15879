// SPDX-License-Identifier: Apache-2.0
#include "session/open/open_demo.h"

#include <system_error>
#include <utility>

#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {
namespace {

/// Written last: a survey without it was begun and not finished.
constexpr const char* kWhole = "truth/complete";

Result<void> make_demo(const std::filesystem::path& folder, const std::string& program_version, Work& work) {
  std::error_code error;
  if (std::filesystem::exists(folder / kWhole, error)) return {};
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::io, error.message(), {folder.string()});
  const auto made = synth::simulate_survey(folder, synth::survey_params(synth::Preset::demo), synth::ms70_beams(), true,
                                           program_version, work);
  if (!made) return pass_on(made);
  std::filesystem::create_directories(folder / kWhole, error);
  if (error) return fail(ErrorCode::io, error.message(), {folder.string()});
  return {};
}

}  // namespace

void open_demo(AppModel& app, std::filesystem::path folder) {
  Document& document = app.workspace.document;
  const std::string version = document.options().program_version;
  if (folder.empty()) {
    const auto cache = IndexCache::of_user().folder;
    // Not a name that others can foresee, in a folder that they can write to.
    if (cache.empty())
      return document.tell("the demo survey is kept in the user's cache: HOME or XDG_CACHE_HOME must say where");
    folder = cache / ("demo-" + version);
  }
  app.preferences.set_chart(folder, folder / "truth" / "depth.tif");
  document.open({folder}, [folder, version](Work& work) { return make_demo(folder, version, work); });
}

}  // namespace sonar
