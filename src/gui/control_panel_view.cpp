// SPDX-License-Identifier: Apache-2.0
#include "gui/control_panel_view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollBar>
#include <QVBoxLayout>
#include <initializer_list>

#include "gui/listening_of.h"
#include "gui/own_keys.h"
#include "gui/panel_section.h"
#include "gui/picture_view.h"
#include "gui/translated.h"

namespace sonar {
namespace {

constexpr int kEditorHeight_px = 215;

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

QWidget* curve_row(TransferEditor& editor, Workspace& workspace, QWidget* parent) {
  auto* row = new QWidget(parent);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(8, 0, 4, 0);
  auto* which = new QComboBox(row);
  which->setObjectName("curve");
  which->addItems({translated("View curve"), translated("Growth curve")});
  which->setAccessibleName(translated("Curve that is shown"));
  which->setToolTip(
      translated("View curve: colours and opacity of the volume.\nGrowth curve: opacity on which mode paper grows."));
  QObject::connect(which, &QComboBox::currentIndexChanged, which,
                   [&editor](int index) { editor.growth_shown().set(index == 1); });
  auto* linked = new QCheckBox(translated("Linked"), row);
  linked->setObjectName("curves_linked");
  linked->setToolTip(translated("A change of one curve is a change of both.\nDefault: off"));
  linked->setChecked(workspace.curves_linked());
  listening_of(*linked).to(workspace.curves_linked.changed(),
                           [linked, &workspace] { linked->setChecked(workspace.curves_linked()); });
  QObject::connect(linked, &QCheckBox::toggled, linked, [&workspace](bool on) { workspace.curves_linked.set(on); });
  auto* preset = new QComboBox(row);
  preset->setObjectName("curve_preset");
  preset->addItem(translated("Preset"));
  for (const CurvePreset& one : curve_presets()) {
    preset->addItem(translated(label_of(one.name, {})), text(std::string(one.name)));
    preset->setItemData(preset->count() - 1, translated(std::string(one.text)), Qt::ToolTipRole);
  }
  preset->setAccessibleName(translated("Preset of the curve"));
  preset->setToolTip(translated("Shapes for the display limits"));
  QObject::connect(preset, &QComboBox::activated, preset, [&editor, preset](int index) {
    if (index > 0) editor.take_preset(preset->itemData(index).toString().toStdString());
    preset->setCurrentIndex(0);
  });
  for (QWidget* control : std::initializer_list<QWidget*>{which, linked, preset}) keep_own_keys(*control);
  layout->addWidget(which, 1);
  layout->addWidget(preset, 1);
  layout->addWidget(linked);
  return row;
}

}  // namespace

ControlPanelView::ControlPanelView(TransferEditor& editor, Workspace& workspace,
                                   const std::vector<PanelSection>& sections) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);  // a click beside its controls leaves the keyboard to the views
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* inside = new QWidget(this);
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(0, 4, 0, 4);
  column->setSpacing(2);
  auto* picture = new PictureView(editor, workspace.latencies, inside);
  picture->setObjectName("transfer_editor");
  picture->setAccessibleName(translated("Curve of opacity over Sv, with the display limits"));
  picture->setFixedHeight(kEditorHeight_px);
  column->addWidget(curve_row(editor, workspace, inside));
  column->addWidget(picture);
  for (const PanelSection& section : sections) add_folding_section(*column, section, inside);
  column->addStretch(1);
  setWidget(inside);
  setMinimumWidth(inside->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width());
}

}  // namespace sonar
