// SPDX-License-Identifier: Apache-2.0
#include "view/time_text.h"

namespace sonar {

std::string time_text(TimeNs time) {
  std::string text = iso_time(time);
  if (const auto t = text.find('T'); t != std::string::npos) text[t] = ' ';
  if (!text.empty() && text.back() == 'Z') text.replace(text.size() - 1, 1, " UTC");
  return text;
}

}  // namespace sonar
