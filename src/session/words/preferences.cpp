// SPDX-License-Identifier: Apache-2.0
#include "session/words/preferences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/hash.h"
#include "pipeline/recipe/earlier_parameters.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/json_parameters.h"
#include "pipeline/recipe/json_path.h"
#include "pipeline/recipe/transfer_function_json.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostCharts = 100;
constexpr std::size_t kMostPlaces = 100;  ///< that surveys were left at
constexpr std::size_t kMostFiles = 10000;
constexpr std::size_t kMostKeys = 1000;
constexpr std::size_t kMostListed = 1000;  ///< surveys to be run
constexpr std::size_t kMostKeysOfOne = 4;
constexpr int kMostFoldersBeside = 1000;  ///< of one survey

/// Visitor: takes from JSON what fits and passes over the rest; what was called otherwise before is noted.
class LenientReader {
 public:
  LenientReader(const json& from, std::vector<std::string>& notes, std::string prefix = {})
      : from_(from), notes_(notes), prefix_(std::move(prefix)) {}

  template <class T>
  void field(std::string_view name, T& value, const FieldInfo& info) {
    const json* found = member(name);
    if (found == nullptr) return;
    if constexpr (std::is_same_v<T, bool>) {
      if (found->is_boolean()) value = found->get<bool>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (found->is_string()) value = found->get<std::string>();
    } else if constexpr (std::is_same_v<T, int>) {
      const auto whole = whole_number(*found, std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
      if (whole && within(static_cast<double>(*whole), info)) value = static_cast<int>(*whole);
    } else {
      if (found->is_number() && within(found->get<double>(), info)) value = found->get<double>();
    }
  }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo&) {
    const json* found = member(name);
    if (found == nullptr || !found->is_string()) return;
    const auto at = std::find(names.begin(), names.end(), found->get<std::string>());
    if (at != names.end()) value = static_cast<E>(at - names.begin());
  }
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    const json* found = member(name);
    if (found == nullptr) return;
    LenientReader inner(*found, notes_, prefix_ + std::string(name) + ".");
    describe(inner, p);
  }

 private:
  static bool within(double value, const FieldInfo& info) { return value >= info.min && value <= info.max; }
  [[nodiscard]] const json* member(std::string_view name) const {
    if (!from_.is_object()) return nullptr;
    auto found = from_.find(std::string(name));
    const std::string whole = prefix_ + std::string(name);
    if (const std::string earlier(earlier_name(whole)); !earlier.empty() && from_.contains(earlier)) {
      notes_.push_back(fmt::format("{}{} is called {} now", prefix_, earlier, whole));
      if (found == from_.end()) found = from_.find(earlier);
    }
    return found == from_.end() ? nullptr : &*found;
  }

  const json& from_;
  std::vector<std::string>& notes_;
  std::string prefix_;
};

/// The members that are no lists.
template <class Visitor>
void describe(Visitor& v, Preferences& p) {
  v.field("window_layout", p.window_layout, {});
  v.field("dark", p.dark, {});
  v.group("display", p.display, {});
  v.group("select", p.select, {});
  v.group("volume", p.volume, {});
  v.group("timelines", p.timelines, {});
  v.group("views", p.views, {});
  v.group("picture_file", p.picture_file, {});
  v.group("reduce", p.reduce, {});
  v.group("integrate", p.integrate, {});
  v.group("fish", p.fish, {});
  v.group("figure", p.figure, {});
  v.field("curves_linked", p.curves_linked, {});
  v.field("operator", p.operator_name, {});
  v.field("advance", p.advance, {});
  describe(v, p.window);
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }

json texts_of(const std::vector<fs::path>& paths) {
  json texts = json::array();
  for (const fs::path& one : paths) texts.push_back(json_text_of(one));
  return texts;
}

std::vector<fs::path> paths_of(const std::vector<std::string>& texts) {
  std::vector<fs::path> paths;
  for (const std::string& one : texts) paths.push_back(path_of_json(one));
  return paths;
}

std::vector<std::string> texts_of(const json& list, std::size_t most) {
  std::vector<std::string> texts;
  if (!list.is_array()) return texts;
  for (const json& one : list) {
    if (one.is_string() && !one.get<std::string>().empty() && texts.size() < most)
      texts.push_back(one.get<std::string>());
  }
  return texts;
}

void read_lists(const json& from, Preferences& to) {
  if (const auto found = from.find("recent"); found != from.end() && found->is_array()) {
    for (const json& one : *found) {
      const auto texts = texts_of(one, kMostFiles);
      if (!texts.empty() && to.recent.size() < Preferences::kMostRecent) to.recent.push_back(paths_of(texts));
    }
  }
  if (const auto found = from.find("species"); found != from.end()) {
    auto species = texts_of(*found, Preferences::kMostSpecies);
    for (std::string& one : species) std::replace_if(one.begin(), one.end(), is_control, ' ');  // no journal takes them
    if (!species.empty()) to.species = std::move(species);
  }
}

void read_batch(const json& from, Preferences& to) {
  const auto found = from.find("batch");
  if (found == from.end() || !found->is_array()) return;
  for (const json& one : *found) {
    const bool sound = one.is_object() && one.contains("survey") && one.contains("out") && one["out"].is_string();
    const auto texts = sound ? texts_of(one["survey"], kMostFiles) : std::vector<std::string>{};
    if (!texts.empty() && to.batch.size() < kMostListed)
      to.batch.push_back({paths_of(texts), path_of_json(one["out"].get<std::string>())});
  }
}

void read_files(const json& from, const char* name, FileOfSurvey& to) {
  const auto found = from.find(name);
  if (found == from.end() || !found->is_object()) return;
  for (const auto& [survey, file] : found->items()) {
    if (file.is_string() && to.size() < kMostCharts) to[survey] = file.get<std::string>();
  }
}

void read_left_at(const json& from, Preferences& to) {
  const auto found = from.find("left_at");
  if (found == from.end() || !found->is_object()) return;
  for (const auto& [survey, place] : found->items()) {
    const bool sound = place.is_array() && place.size() == 2 && place[0].is_string() && place[1].is_number_integer();
    if (sound && to.left_at.size() < kMostPlaces)
      to.left_at[survey] = {place[0].get<std::string>(), place[1].get<std::int64_t>()};
  }
}

void read_keys(const json& from, Preferences& to) {
  const auto found = from.find("keys");
  if (found == from.end() || !found->is_object()) return;
  for (const auto& [action, keys] : found->items()) {
    if (keys.is_array() && to.keys.size() < kMostKeys) to.keys[action] = texts_of(keys, kMostKeysOfOne);
  }
}

void read_curves(const json& from, Preferences& to) {
  const auto curve = [&from](const char* name) -> std::optional<TransferFunction> {
    const auto found = from.find(name);
    if (found == from.end()) return std::nullopt;
    auto read = transfer_function_from_json(*found);
    return read ? std::optional(std::move(*read)) : std::nullopt;
  };
  to.view_curve = curve("view_curve");
  to.growth_curve = curve("growth_curve");
}

fs::path home_folder(const char* variable, const char* below_home) {
  // NOLINTBEGIN(concurrency-mt-unsafe): nobody sets them
  if (const char* named = std::getenv(variable); named != nullptr && fs::path(named).is_absolute()) return named;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') return fs::path(home) / below_home;
  // NOLINTEND(concurrency-mt-unsafe)
  return {};
}

/// The folder of a survey's raw files, links followed. What is gone is told by its name.
fs::path raw_folder(const fs::path& survey) {
  std::error_code unknown;
  fs::path whole = fs::weakly_canonical(fs::absolute(survey, unknown), unknown);
  if (unknown || whole.empty()) whole = survey.lexically_normal();
  if (whole.filename().empty()) whole = whole.parent_path();
  const fs::path ending = whole.extension();
  const bool named_file = ending == ".raw" || ending == ".RAW" || ending == ".nc";
  const bool file = fs::exists(whole, unknown) ? !fs::is_directory(whole, unknown) : named_file;
  return file ? whole.parent_path() : whole;
}

}  // namespace

fs::path whole_path(const fs::path& path) {
  std::error_code unknown;
  const fs::path whole = fs::absolute(path, unknown);
  if (unknown) return path;
  const fs::path normal = whole.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

fs::path Preferences::path_of_user() {
  const fs::path folder = home_folder("XDG_CONFIG_HOME", ".config");
  return folder.empty() ? fs::path{} : folder / "sonar-explorer" / "preferences.json";
}

LoadedPreferences Preferences::load(const fs::path& path) {
  LoadedPreferences loaded;
  loaded.preferences.path = path;
  std::error_code absent;
  if (path.empty() || !fs::exists(path, absent)) return loaded;
  const auto from = read_json_file(path.string());
  if (!from || !from->is_object()) {
    const std::string why = from ? path.string() + ": expected an object" : to_line(from.error());
    loaded.notice = why + "; the window begins with its defaults";
    return loaded;
  }
  std::vector<std::string> notes;
  LenientReader reader(*from, notes);
  describe(reader, loaded.preferences);
  if (!notes.empty()) loaded.notice = fmt::format("{}: {}", path.string(), fmt::join(notes, "; "));
  read_lists(*from, loaded.preferences);
  read_batch(*from, loaded.preferences);
  read_curves(*from, loaded.preferences);
  read_files(*from, "charts", loaded.preferences.charts);
  read_files(*from, "transects", loaded.preferences.transects);
  read_left_at(*from, loaded.preferences);
  read_keys(*from, loaded.preferences);
  return loaded;
}

Result<void> Preferences::save() const {
  if (path.empty()) return fail(ErrorCode::io, "there is no folder for preferences: neither XDG_CONFIG_HOME nor HOME");
  JsonWriter writer;
  Preferences copy = *this;
  describe(writer, copy);
  json to = writer.json();
  if (view_curve) to["view_curve"] = to_json(*view_curve);
  if (growth_curve) to["growth_curve"] = to_json(*growth_curve);
  to["species"] = species;
  to["charts"] = charts;
  to["transects"] = transects;
  to["left_at"] = left_at;
  to["keys"] = keys;
  to["recent"] = json::array();
  for (const auto& paths : recent) to["recent"].push_back(texts_of(paths));
  to["batch"] = json::array();
  for (const ListedSurvey& one : batch) {
    to["batch"].push_back({{"survey", texts_of(one.paths)}, {"out", json_text_of(one.out)}});
  }
  return write_json_file(path.string(), to);
}

void Preferences::apply(Workspace& workspace) const {
  workspace.display.assign(display);
  workspace.select.assign(select);
  workspace.volume.assign(volume);
  workspace.timelines.assign(timelines);
  workspace.views.assign(views);
  workspace.picture_file.assign(picture_file);
  workspace.reduce.assign(reduce);
  workspace.integrate.assign(integrate);
  workspace.fish.assign(fish);
  workspace.window.assign(window);
  workspace.figure.assign(figure);
  if (window.theme != ThemeName::system) workspace.dark.set(dark);
  if (growth_curve) workspace.growth_curve.set(*growth_curve);
  if (view_curve) {
    workspace.curve_follows_scale.set(false);
    workspace.view_curve.set(*view_curve);
  }
  workspace.curves_linked.set(curves_linked);
}

void Preferences::take(const Workspace& workspace) {
  display = workspace.display.values();
  select = workspace.select.values();
  volume = workspace.volume.values();
  timelines = workspace.timelines.values();
  views = workspace.views.values();
  picture_file = workspace.picture_file.values();
  reduce = workspace.reduce.values();
  integrate = workspace.integrate.values();
  fish = workspace.fish.values();
  if (fish.lengths == LengthsFrom::table) fish.lengths = FishParams{}.lengths;
  dark = workspace.dark();
  window = workspace.window.values();
  figure = workspace.figure.values();
  figure.title.clear();
  figure.caption.clear();
  growth_curve = workspace.growth_curve();
  view_curve.reset();
  if (!workspace.curve_follows_scale()) view_curve = workspace.view_curve();
  curves_linked = workspace.curves_linked();
}

fs::path file_of(const FileOfSurvey& files, const fs::path& survey) {
  const auto found = files.find(whole_path(survey).string());
  return found == files.end() ? fs::path{} : fs::path(found->second);
}

void set_file(FileOfSurvey& files, const fs::path& survey, const fs::path& file) {
  const std::string name = whole_path(survey).string();
  if (file.empty()) {
    files.erase(name);
  } else if (files.size() < kMostCharts || files.contains(name)) {
    files[name] = whole_path(file).string();
  }
}

fs::path Preferences::chart_of(const fs::path& survey) const { return file_of(charts, survey); }

void Preferences::set_chart(const fs::path& survey, const fs::path& raster) { set_file(charts, survey, raster); }

std::optional<std::pair<std::string, std::int64_t>> Preferences::left_at_of(const std::vector<fs::path>& survey) const {
  const auto found = survey.empty() ? left_at.end() : left_at.find(whole_path(survey.front()).string());
  return found == left_at.end() ? std::nullopt : std::optional(found->second);
}

void Preferences::set_left_at(const std::vector<fs::path>& survey, const std::string& observation, std::int64_t ping) {
  if (survey.empty()) return;
  const std::string name = whole_path(survey.front()).string();
  if (left_at.size() >= kMostPlaces && !left_at.contains(name)) forget_a_place();
  left_at[name] = {observation, ping};
}

/// Of a survey that was not opened lately.
void Preferences::forget_a_place() {
  const auto lately = [this](const auto& place) {
    return std::any_of(recent.begin(), recent.end(),
                       [&](const auto& survey) { return survey.front().string() == place.first; });
  };
  const auto other = std::find_if_not(left_at.begin(), left_at.end(), lately);
  left_at.erase(other == left_at.end() ? left_at.begin() : other);
}

void Preferences::remember(std::vector<fs::path> opened) {
  if (opened.empty()) return;
  for (fs::path& one : opened) one = whole_path(one);
  std::erase(recent, opened);
  recent.insert(recent.begin(), std::move(opened));
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

fs::path folder_beside(const fs::path& survey, const std::string& ending) {
  const fs::path folder = raw_folder(survey);
  return folder.has_filename() ? folder.parent_path() / (folder.filename().string() + ending) : fs::path{};
}

fs::path free_folder_beside(const fs::path& survey, const std::string& ending,
                            const std::function<bool(const fs::path&)>& taken) {
  fs::path folder = folder_beside(survey, ending);
  if (folder.empty() || !require_not_beneath_raw(folder)) return {};
  for (int i = 2; taken(folder); ++i) {
    if (i > kMostFoldersBeside) return {};
    folder = folder_beside(survey, fmt::format("{}-{}", ending, i));
  }
  return folder;
}

std::vector<fs::path> journal_folders_for(const fs::path& survey) {
  std::vector<fs::path> folders;
  const fs::path folder = raw_folder(survey);
  if (fs::path beside = folder_beside(survey, "-work"); !beside.empty()) folders.push_back(std::move(beside));
  const fs::path own = home_folder("XDG_STATE_HOME", ".local/state");
  if (!own.empty()) {
    const std::string hash = to_hex(hash_text(folder.string())).substr(0, 16);
    folders.push_back(own / "sonar-explorer" / (folder.filename().string() + "-" + hash));
  }
  return folders;
}

}  // namespace sonar
