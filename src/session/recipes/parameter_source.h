// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "session/listening.h"
#include "session/recipes/parameters.h"

namespace sonar {

/// Parameters of any struct, as a panel is generated from them.
class ParameterSource {
 public:
  virtual ~ParameterSource() = default;
  [[nodiscard]] virtual const std::vector<Property>& properties() const = 0;
  /// errors  not_found
  [[nodiscard]] virtual Result<PropertyValue> value(const std::string& name) const = 0;
  /// errors  not_found, bad_parameter; the value stands
  virtual Result<void> set(const std::string& name, const PropertyValue& to) = 0;
  virtual void tell_changes(Listening& to, std::function<void()> heard) = 0;
  /// A hand has taken hold of a control, or let go of it: what changes meanwhile is one change.
  virtual void hold(bool /*held*/) {}
};

template <class P>
class SourceOf : public ParameterSource {
 public:
  /// The parameters outlive this.
  explicit SourceOf(Parameters<P>& parameters) : parameters_(parameters) {}
  [[nodiscard]] const std::vector<Property>& properties() const override { return parameters_.properties(); }
  [[nodiscard]] Result<PropertyValue> value(const std::string& name) const override { return parameters_.value(name); }
  Result<void> set(const std::string& name, const PropertyValue& to) override { return parameters_.set(name, to); }
  void tell_changes(Listening& to, std::function<void()> heard) override { to.to(parameters_, std::move(heard)); }
  void hold(bool held) override { parameters_.hold(held); }

 private:
  Parameters<P>& parameters_;
};

template <class P>
[[nodiscard]] std::shared_ptr<ParameterSource> source_of(Parameters<P>& parameters) {
  return std::make_shared<SourceOf<P>>(parameters);
}

/// A group of controls. A note is a line below a property's control that says what the value means now.
struct PanelSection {
  std::string title;
  std::shared_ptr<ParameterSource> source;
  std::vector<std::string> names = {};  ///< which properties, in order; empty = all
  struct Note {
    std::string name;
    std::function<std::string()> text;
    std::shared_ptr<ParameterSource> also = nullptr;  ///< that it depends on beside the section's own
  };
  std::vector<Note> notes = {};
  bool open = true;  ///< folded out at first
  /// Whether values that are not the default are marked, each with a button that brings the default back.
  bool marks = false;
  /// How a number's control differs from others.
  struct Look {
    std::string name;
    std::string at_min;
    std::pair<double, double> slider;
  };
  std::vector<Look> looks = {};
  /// A property that counts only under some values of others is grey while it does not.
  struct Use {
    std::string name;
    std::function<bool()> counts;
  };
  std::vector<Use> uses = {};
  /// A text that is one of a list; where the empty one stands in it, it may be none.
  struct Words {
    std::string name;
    std::vector<std::string> words;
  };
  std::vector<Words> words = {};
};

}  // namespace sonar
