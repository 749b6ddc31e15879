// SPDX-License-Identifier: Apache-2.0
#include <QApplication>
#include <QCommandLineParser>
#include <QJsonArray>
#include <QJsonDocument>
#include <QPalette>
#include <QSocketNotifier>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>
#include <utility>

#include "base/asked_to_end.h"
#include "base/manual.h"
#include "gui/main_window.h"
#include "gui/queue_pump.h"
#include "gui/translated.h"
#include "session/batch/batch.h"
#include "session/live/live_watch.h"
#include "session/open/open_demo.h"
#include "session/words/all_words.h"

namespace sonar {
namespace {

TimeNs utc_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Before the window takes a theme of its own.
bool application_is_dark() {
  const QPalette palette = QApplication::palette();
  return palette.color(QPalette::Window).lightness() < palette.color(QPalette::WindowText).lightness();
}

DocumentOptions document_options(const Preferences& preferences) {
  DocumentOptions options;
  options.program_version = SONAR_VERSION;
  options.operator_name = preferences.operator_name;
  options.cache = IndexCache::of_user();
  options.journal_folders = journal_folders_for;
  options.clock = utc_now;
  options.memory_bytes = static_cast<std::uint64_t>(preferences.window.memory_gb * 1e9);
  return options;
}

constexpr const char* kExamples =
    "\nExamples:\n"
    "  sonar-explorer --demo                    a simulated survey, made first where it is not there yet\n"
    "  sonar-explorer SURVEY --recipe R.json    a folder of raw files under a recipe\n"
    "  sonar-explorer OUT                       what sonarx run SURVEY --out OUT found, in its survey\n"
    "  sonar-explorer --live SURVEY             a survey that is still being recorded\n";

struct CommandLine {
  QCommandLineParser parser;
  QCommandLineOption help{{"h", "help"}, "Show this help and end"};
  QCommandLineOption version{{"V", "version"}, "Show the version and end"};
  QCommandLineOption demo{"demo", "Open a simulated survey; it is made first where it is not there yet"};
  QCommandLineOption dark{"dark", "Begin in dark colours"};
  QCommandLineOption live{"live", "The survey is still being recorded: follow it"};
  QCommandLineOption words{"words",
                           "Print the texts of the window's menus, panels and tables as JSON, for translators"};
  QCommandLineOption recipe{"recipe", "Open the survey under this recipe, or preset, from now on", "recipe"};

  CommandLine() {
    QCoreApplication::setApplicationName("sonar-explorer");
    QCoreApplication::setApplicationVersion(SONAR_VERSION);
    parser.setApplicationDescription("Explores fishery-sonar surveys: detect schools, follow them, map them");
    parser.setSingleDashWordOptionMode(QCommandLineParser::ParseAsLongOptions);  // as Qt takes its own
    parser.addPositionalArgument("survey", "Folders of raw files, raw files, or folders of results (sonarx run --out)",
                                 "[survey...]");
    parser.addOptions({help, version, demo, dark, live, recipe, words});
    // Qt takes these itself, and its own pages tell them.
    QCommandLineOption flags(QStringList{"dograb", "nograb", "reverse", "widgetcount"});
    QCommandLineOption values(
        {"display", "geometry", "name", "platform", "platformpluginpath", "platformtheme", "plugin", "qwindowgeometry",
         "qwindowicon", "qwindowtitle", "session", "style", "stylesheet"},
        {}, "value");
    for (QCommandLineOption* of_qt : {&flags, &values}) {
      of_qt->setFlags(QCommandLineOption::HiddenFromHelp);
      parser.addOption(*of_qt);
    }
  }

  /// What could not be parsed, without a full stop.
  [[nodiscard]] std::string problem() const {
    const QStringList unknown = parser.unknownOptionNames();
    if (unknown.isEmpty()) return parser.errorText().chopped(1).toStdString();
    return (unknown[0].size() > 1 ? "there is no option --" : "there is no option -") + unknown[0].toStdString();
  }
};

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

/// As a user would.
void close_when_asked(QWidget& window, AppModel& app) {
  const int asked = asked_to_end();
  if (asked < 0) return;
  auto* notifier = new QSocketNotifier(asked, QSocketNotifier::Read, &window);
  QObject::connect(notifier, &QSocketNotifier::activated, &window, [notifier, &window, &app] {
    notifier->setEnabled(false);
    app.batch->stop();  // nobody is there to be asked
    window.close();
  });
}

void print_words() {
  ChangeQueue queue;
  AppModel app(queue, {});
  QJsonArray words;
  for (const std::string& one : all_words(app)) words.append(QString::fromStdString(one));
  std::printf("%s", QJsonDocument(words).toJson().constData());
}

int run_program(int argc, char** argv) {
  CommandLine line;
  QCommandLineParser& parser = line.parser;
  QStringList words;
  for (const char* word : std::span(argv, static_cast<std::size_t>(argc))) words << QString::fromLocal8Bit(word);
  // Before a display is asked for: help, and what is no sense, need none.
  if (!parser.parse(words)) {
    std::fprintf(stderr, "sonar-explorer: %s; see sonar-explorer --help\n", line.problem().c_str());
    return 2;
  }
  if (parser.isSet(line.version)) {
    std::puts("sonar-explorer " SONAR_VERSION);
    return 0;
  }
  if (parser.isSet(line.help)) {
    const QCoreApplication plain(argc, argv);  // the text names the program as it was called
    std::printf("%s%s\nManual: %s\n", parser.helpText().toStdString().c_str(), kExamples, manual_place().c_str());
    return 0;
  }
  if (line.parser.isSet(line.words)) {
    print_words();
    return 0;
  }
  qInstallMessageHandler(end_without_display);
  const QApplication application(argc, argv);
  qInstallMessageHandler(nullptr);

  load_language();

  const LoadedPreferences loaded = Preferences::load(Preferences::path_of_user());
  QueuePump pump;
  AppModel app(pump.queue(), document_options(loaded.preferences));
  app.preferences = loaded.preferences;
  app.dialogs.system_is_dark = [dark = application_is_dark()] { return dark; };
  app.preferences.apply(app.workspace);
  app.actions.take_keys(app.preferences.keys);
  if (parser.isSet(line.dark)) app.workspace.dark.set(true);
  if (parser.isSet(line.recipe)) {
    const auto used = app.workspace.document.use_named_recipe(parser.value(line.recipe).toStdString());
    if (!used) {
      std::fprintf(stderr, "sonar-explorer: %s\n", to_line(used.error()).c_str());
      return 2;
    }
  }
  MainWindow window(app);
  window.take_layout(app.preferences.window_layout);
  window.show();
  close_when_asked(window, app);
  if (!loaded.notice.empty()) app.workspace.document.tell(loaded.notice);
  std::vector<std::filesystem::path> paths;
  for (const QString& path : parser.positionalArguments()) paths.emplace_back(path.toStdString());
  if (parser.isSet(line.demo)) {
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
