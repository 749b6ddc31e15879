// SPDX-License-Identifier: Apache-2.0
#include "gui/translated.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QStandardPaths>
#include <QStringList>
#include <QTranslator>

namespace sonar {
namespace {

constexpr const char* kContext = "sonar";

/// The first of the folders that has one for this language.
void load(const QLocale& locale, const QString& name, const QStringList& folders) {
  auto* translator = new QTranslator(QCoreApplication::instance());
  for (const QString& folder : folders) {
    if (translator->load(locale, name, "_", folder)) {
      QCoreApplication::installTranslator(translator);
      return;
    }
  }
}

}  // namespace

QString translated(const char* english) { return QCoreApplication::translate(kContext, english); }

QString translated(const std::string& english) { return translated(english.c_str()); }

QString translated_menu(const std::string& path, const QString& between) {
  QStringList parts;
  for (const QString& part : QString::fromStdString(path).split('/')) parts.append(translated(part.toStdString()));
  return parts.join(between);
}

void load_language() {
  const QString chosen = qEnvironmentVariable("SONAR_LANGUAGE");
  const QLocale locale = chosen.isEmpty() ? QLocale() : QLocale(chosen);
  // Qt goes on to a user's second language where there is no file for the first, and the program is in English as it is.
  if (locale.uiLanguages().value(0).startsWith("en")) return;
  load(locale, "qtbase", {QLibraryInfo::path(QLibraryInfo::TranslationsPath)});
  QStringList folders = QStandardPaths::standardLocations(QStandardPaths::GenericDataLocation);
  folders.prepend(QCoreApplication::applicationDirPath() + "/../share");
  for (QString& folder : folders) folder += "/sonar-explorer";
  load(locale, "sonar-explorer", folders);
}

}  // namespace sonar
