// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>
#include <memory>

#include "session/recipes/parameter_source.h"

namespace sonar {

/// The control of one property, of the kind that its value has: a switch, a number with a slider, a choice, a text. It
/// shows what the property is and changes it; unit, range and default stand in the control and its tooltip.
[[nodiscard]] QWidget* bound_control(const std::shared_ptr<ParameterSource>& source, const Property& property,
                                     QWidget* parent);

}  // namespace sonar
