// SPDX-License-Identifier: Apache-2.0
#include "gui/theme.h"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

#include "view/theme.h"

namespace sonar {
namespace {

QColor colour(Rgba8 c) { return {c.r, c.g, c.b, c.a}; }

}  // namespace

void take_theme(bool dark) {
  const Theme theme = dark ? dark_theme({1280, 800}) : light_theme({1280, 800});
  const QColor window = dark ? colour(theme.background).lighter(125) : QColor(240, 241, 243);
  QPalette palette;
  palette.setColor(QPalette::Window, window);
  palette.setColor(QPalette::WindowText, colour(theme.text));
  palette.setColor(QPalette::Base, colour(theme.background));
  palette.setColor(QPalette::AlternateBase, window);
  palette.setColor(QPalette::Text, colour(theme.text));
  palette.setColor(QPalette::Button, window);
  palette.setColor(QPalette::ButtonText, colour(theme.text));
  palette.setColor(QPalette::ToolTipBase, colour(theme.background));
  palette.setColor(QPalette::ToolTipText, colour(theme.text));
  palette.setColor(QPalette::PlaceholderText, colour(theme.muted));
  palette.setColor(QPalette::Highlight, QColor(0, 114, 178));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, colour(theme.muted));
  }
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(palette);
}

}  // namespace sonar
