// SPDX-License-Identifier: Apache-2.0
#include <QApplication>
#include <QCommandLineParser>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string_view>
#include <utility>

#include "gui/main_window.h"
#include "gui/queue_pump.h"
#include "session/live_watch.h"
#include "session/open_demo.h"

namespace sonar {
namespace {

TimeNs utc_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

DocumentOptions document_options(const Preferences& preferences) {
  DocumentOptions options;
  options.program_version = SONAR_VERSION;
  options.operator_name = preferences.operator_name;
  options.cache = IndexCache::of_user();
  options.journal_folders = journal_folders_for;
  options.clock = utc_now;
  options.memory_bytes = static_cast<std::uint64_t>(preferences.memory_gb * 1e9);
  return options;
}

struct CommandLine {
  QCommandLineParser parser;
  QCommandLineOption demo{"demo", "Open a simulated survey; it is made first where it is not there yet"};
  QCommandLineOption dark{"dark", "Begin in dark colours"};
  QCommandLineOption live{"live", "The survey is still being recorded: follow it"};
  QCommandLineOption recipe{"recipe", "Open the survey under this recipe, or preset, from now on", "recipe"};

  CommandLine() {
    QCoreApplication::setApplicationName("sonar-explorer");
    QCoreApplication::setApplicationVersion(SONAR_VERSION);
    parser.setApplicationDescription("Explores fishery-sonar surveys: detect schools, follow them, map them");
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addPositionalArgument("survey", "Folders of raw files, or raw files", "[survey...]");
    parser.addOptions({demo, dark, live, recipe});
  }
};

/// What is asked of the program needs no window, or is no sense: it is answered where there is no display, too.
bool asks_for_text(int argc, char** argv) {
  const std::span<char*> words(argv + 1, argv + argc);
  return std::any_of(words.begin(), words.end(), [](const char* word) {
    const std::string_view text(word);
    return text == "-h" || text == "--help" || text == "--help-all" || text == "-v" || text == "--version";
  });
}

/// Qt says several lines and aborts where it finds no display.
void end_without_display(QtMsgType type, const QMessageLogContext& /*where*/, const QString& /*text*/) {
  if (type != QtFatalMsg) return;
  const char* display = std::getenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe): before any thread
  std::fprintf(stderr,
               "sonar-explorer: no display to open a window on (DISPLAY is '%s'); expected a desktop, or ssh -X. "
               "sonarx works without one\n",
               display != nullptr ? display : "");
  std::_Exit(1);
}

int run_program(int argc, char** argv) {
  if (asks_for_text(argc, argv)) {
    QCoreApplication plain(argc, argv);
    CommandLine().parser.process(plain);
    return 0;
  }
  qInstallMessageHandler(end_without_display);
  const QApplication application(argc, argv);
  qInstallMessageHandler(nullptr);
  CommandLine line;
  QCommandLineParser& parser = line.parser;
  const QCommandLineOption& demo = line.demo;
  const QCommandLineOption& dark = line.dark;
  parser.process(application);

  const LoadedPreferences loaded = Preferences::load(Preferences::path_of_user());
  QueuePump pump;
  AppModel app(pump.queue(), document_options(loaded.preferences));
  app.preferences = loaded.preferences;
  app.preferences.apply(app.workspace);
  if (parser.isSet(dark)) app.workspace.dark.set(true);
  if (parser.isSet(line.recipe)) {
    auto recipe = named_recipe(parser.value(line.recipe).toStdString());
    if (!recipe) {
      std::fprintf(stderr, "sonar-explorer: %s\n", to_line(recipe.error()).c_str());
      return 2;
    }
    app.workspace.document.use_recipe(std::move(*recipe));
  }
  MainWindow window(app);
  window.take_layout(app.preferences.window_layout);
  window.show();
  if (!loaded.notice.empty()) app.workspace.document.tell(loaded.notice);
  std::vector<std::filesystem::path> paths;
  for (const QString& path : parser.positionalArguments()) paths.emplace_back(path.toStdString());
  if (parser.isSet(demo)) {
    open_demo(app);
  } else if (!paths.empty()) {
    if (parser.isSet(line.live)) app.live->follow_next();
    app.workspace.document.open(std::move(paths));
  }
  return QApplication::exec();
}

}  // namespace
}  // namespace sonar

int main(int argc, char** argv) {
  try {
    return sonar::run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sonar-explorer: %s\n", error.what());
    return 70;
  }
}
