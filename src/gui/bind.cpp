// SPDX-License-Identifier: Apache-2.0
#include "gui/bind.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/listening_of.h"
#include "gui/own_keys.h"
#include "gui/translated.h"

namespace sonar {
namespace {

constexpr int kSliderSteps = 200;
constexpr double kMostSlider = 1000.0;  // a slider over more than this helps nobody

using Source = std::shared_ptr<ParameterSource>;

QString text(const std::string& utf8) { return QString::fromStdString(utf8); }

/// Calls `show` with the value now and after every change, as long as the widget lives.
template <class Widget, class Show>
void follow(const Source& source, const std::string& name, Widget* widget, Show show) {
  const auto refresh = [source, name, widget, show] {
    const auto value = source->value(name);
    if (!value) return;
    const QSignalBlocker silent(widget);
    show(*widget, *value);
  };
  refresh();
  source->tell_changes(listening_of(*widget), refresh);
}

QWidget* bind_switch(const Source& source, const Property& property, QWidget* parent) {
  auto* box = new QCheckBox(translated(property.label), parent);
  follow(source, property.name, box, [](QCheckBox& b, const PropertyValue& v) { b.setChecked(std::get<bool>(v)); });
  QObject::connect(box, &QCheckBox::toggled, box,
                   [source, name = property.name](bool on) { (void)source->set(name, on); });
  return box;
}

QWidget* bind_choice(const Source& source, const Property& property, QWidget* parent) {
  auto* box = new QComboBox(parent);
  for (const std::string& choice : property.choices) box->addItem(translated(label_of(choice, {})));
  follow(source, property.name, box,
         [](QComboBox& b, const PropertyValue& v) { b.setCurrentIndex(static_cast<int>(std::get<Choice>(v).index)); });
  QObject::connect(box, &QComboBox::currentIndexChanged, box, [source, name = property.name](int index) {
    if (index >= 0) (void)source->set(name, Choice{static_cast<std::size_t>(index)});
  });
  return box;
}

QWidget* bind_text(const Source& source, const Property& property, QWidget* parent) {
  auto* line = new QLineEdit(parent);
  follow(source, property.name, line,
         [](QLineEdit& l, const PropertyValue& v) { l.setText(text(std::get<std::string>(v))); });
  QObject::connect(line, &QLineEdit::editingFinished, line,
                   [source, name = property.name, line] { (void)source->set(name, line->text().toStdString()); });
  return line;
}

/// A text that is one of a list, written as the list has it.
QWidget* bind_word(const Source& source, const Property& property, QWidget* parent) {
  auto* box = new QComboBox(parent);
  for (const std::string& word : property.choices)
    box->addItem(word.empty() ? translated("(none)") : text(word), text(word));
  // Long names do not make the panel wide.
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(8);
  follow(source, property.name, box,
         [](QComboBox& b, const PropertyValue& v) { b.setCurrentIndex(b.findData(text(std::get<std::string>(v)))); });
  QObject::connect(box, &QComboBox::currentIndexChanged, box, [source, name = property.name, box](int index) {
    if (index >= 0) (void)source->set(name, box->itemData(index).toString().toStdString());
  });
  return box;
}

QWidget* bind_int(const Source& source, const Property& property, QWidget* parent) {
  auto* box = new QSpinBox(parent);
  box->setRange(static_cast<int>(std::max(property.min, -1e9)), static_cast<int>(std::min(property.max, 1e9)));
  if (property.unit != "1") box->setSuffix(text(" " + property.unit));
  box->setKeyboardTracking(false);
  follow(source, property.name, box, [](QSpinBox& b, const PropertyValue& v) { b.setValue(std::get<int>(v)); });
  QObject::connect(box, &QSpinBox::valueChanged, box,
                   [source, name = property.name](int value) { (void)source->set(name, value); });
  return box;
}

/// Digits behind the point that tell a range's values apart.
int decimals_of(const Property& property) {
  // A least value that is not zero can be typed.
  const bool small = property.min > 0.0 && property.min < 0.1;
  const int of_least = small ? static_cast<int>(std::ceil(-std::log10(property.min) - 1e-9)) : 0;
  const double range = property.max - property.min;
  if (!std::isfinite(range) || range > 20.0) return std::max(1, of_least);
  return std::max(range > 2.0 ? 2 : 3, of_least);
}

QWidget* bind_double(const Source& source, const Property& property, QWidget* parent) {
  auto* both = new QWidget(parent);
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  auto* box = new QDoubleSpinBox(both);
  box->setDecimals(decimals_of(property));
  box->setRange(std::max(property.min, -1e9), std::min(property.max, 1e9));
  box->setSingleStep(property.max - property.min > 2.0 ? 1.0 : 0.05);
  if (property.unit != "1") box->setSuffix(text(" " + property.unit));
  if (!property.at_min.empty()) box->setSpecialValueText(translated(property.at_min));
  box->setKeyboardTracking(false);
  box->setObjectName(text(property.name + ".box"));
  keep_own_keys(*box);
  follow(source, property.name, box,
         [](QDoubleSpinBox& b, const PropertyValue& v) { b.setValue(std::get<double>(v)); });
  QObject::connect(box, &QDoubleSpinBox::valueChanged, box,
                   [source, name = property.name](double value) { (void)source->set(name, value); });
  if (property.slider || property.max - property.min <= kMostSlider) {
    auto* slider = new QSlider(Qt::Horizontal, both);
    slider->setRange(0, kSliderSteps);
    slider->setObjectName(text(property.name + ".slider"));
    slider->setMinimumWidth(60);
    keep_own_keys(*slider);
    const auto [low, high] = property.slider.value_or(std::pair(property.min, property.max));
    const double step = (high - low) / kSliderSteps;
    follow(source, property.name, slider, [low = low, step](QSlider& s, const PropertyValue& v) {
      s.setValue(
          static_cast<int>(std::lround(std::clamp((std::get<double>(v) - low) / step, 0.0, 1.0 * kSliderSteps))));
    });
    // What the box shows is what counts, unless the slider is finer than that.
    const double unit = std::pow(10.0, -decimals_of(property));
    const double grain = unit < step ? unit : 0.0;
    const double lowest = property.at_min.empty() ? low : property.min;
    QObject::connect(slider, &QSlider::valueChanged, slider,
                     [source, name = property.name, low = low, lowest, step, grain](int at) {
                       const double value = at == 0 ? lowest : low + step * at;
                       (void)source->set(name, grain > 0.0 && at > 0 ? std::round(value / grain) * grain : value);
                     });
    QObject::connect(slider, &QSlider::sliderPressed, slider, [source] { source->hold(true); });
    QObject::connect(slider, &QSlider::sliderReleased, slider, [source] { source->hold(false); });
    row->addWidget(slider, 1);
  }
  row->addWidget(box);
  return both;
}

QString value_text(const PropertyValue& value, const Property& property) {
  if (const auto* on = std::get_if<bool>(&value)) return *on ? translated("on") : translated("off");
  if (const auto* whole = std::get_if<int>(&value)) return QString::number(*whole);
  if (const auto* number = std::get_if<double>(&value)) return text(fmt::format("{:g}", *number));
  if (const auto* choice = std::get_if<Choice>(&value))
    return translated(label_of(property.choices[choice->index], {}));
  return text(std::get<std::string>(value));
}

/// What it does; its range, unit and default on one line.
QString tooltip_of(const Property& property) {
  QString what = translated(property.tooltip);
  if (!what.isEmpty()) what[0] = what[0].toUpper();
  const QString unit = property.unit.empty() || property.unit == "1" ? QString() : text(" " + property.unit);
  const auto* number = std::get_if<double>(&property.initial);
  const bool lowest = number != nullptr && *number <= property.min && !property.at_min.empty();
  const QString initial = lowest ? translated(property.at_min) : value_text(property.initial, property) + unit;
  if (std::isfinite(property.min) && std::isfinite(property.max) && property.max > property.min) {
    const QString range = translated("%1 to %2, default %3");
    const auto number_text = [](double value) { return text(fmt::format("{:g}", value)); };
    return what + "\n" + range.arg(number_text(property.min), number_text(property.max) + unit, initial);
  }
  return what + "\n" + translated("Default %1").arg(initial);
}

}  // namespace

QWidget* bound_control(const Source& source, const Property& property, QWidget* parent) {
  QWidget* control = nullptr;
  if (std::holds_alternative<bool>(property.initial)) {
    control = bind_switch(source, property, parent);
  } else if (std::holds_alternative<Choice>(property.initial)) {
    control = bind_choice(source, property, parent);
  } else if (std::holds_alternative<int>(property.initial)) {
    control = bind_int(source, property, parent);
  } else if (std::holds_alternative<double>(property.initial)) {
    control = bind_double(source, property, parent);
  } else if (!property.choices.empty()) {
    control = bind_word(source, property, parent);
  } else {
    control = bind_text(source, property, parent);
  }
  control->setObjectName(text(property.name));
  control->setToolTip(tooltip_of(property));
  // A number is a box and a slider, each of which can have the keyboard.
  const QList<QWidget*> inside{control, control->findChild<QDoubleSpinBox*>(), control->findChild<QSlider*>()};
  for (QWidget* one : inside) {
    if (one == nullptr) continue;
    one->setAccessibleName(translated(property.label));
    one->setAccessibleDescription(control->toolTip());
  }
  keep_own_keys(*control);
  return control;
}

}  // namespace sonar
