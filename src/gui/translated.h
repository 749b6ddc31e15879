// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <string>

namespace sonar {

// Everything that a user reads in the window and that is no data passes through here. The English text is what a translation
// knows it by; tools/make_translation_template collects them: the literals of translated() and to_translate() in these files, and
// those of the models by all_words().

/// A text in the language of the window.
[[nodiscard]] QString translated(const char* english);
[[nodiscard]] QString translated(const std::string& english);
/// Marks a text that is translated where it is shown, not where it stands.
[[nodiscard]] constexpr const char* to_translate(const char* english) { return english; }
/// A path of menus, "&File/&Export", each of its parts by itself.
[[nodiscard]] QString translated_menu(const std::string& path, const QString& between);

/// Loads sonar-explorer_LANGUAGE.qm for the user's language from share/sonar-explorer beside the program, the user's own
/// (~/.local/share) or the system's, and Qt's own texts; without it the window speaks English. SONAR_LANGUAGE names another
/// language than the system's: "nb".
void load_language();

}  // namespace sonar
