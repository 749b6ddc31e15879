// SPDX-License-Identifier: Apache-2.0
#include "gui/palette.h"

#include <QApplication>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QStyleOption>

#include "view/theme.h"

namespace sonar {
namespace {

QColor colour(Rgba8 c) { return {c.r, c.g, c.b, c.a}; }

/// Fusion draws the frame of an empty box darker than the window: nothing is seen of it where the window is dark.
class VisibleBoxes : public QProxyStyle {
 public:
  VisibleBoxes() : QProxyStyle(QStyleFactory::create("Fusion")) {}
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element != PE_IndicatorCheckBox) return;
    painter->save();
    painter->setPen(option->palette.color(QPalette::Disabled, QPalette::WindowText));
    painter->setBrush(Qt::NoBrush);
    painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
    painter->restore();
  }
};

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
  QApplication::setStyle(new VisibleBoxes);
  QApplication::setPalette(palette);
}

}  // namespace sonar
