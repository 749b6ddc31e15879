// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "session/change_queue.h"
#include "session/listeners.h"

namespace sonar {

/// One of a property's choices.
struct Choice {
  std::size_t index = 0;
  friend bool operator==(const Choice&, const Choice&) = default;
};
using PropertyValue = std::variant<bool, int, double, std::string, Choice>;

/// What a panel needs to show one parameter: made from its struct's describe().
struct Property {
  std::string name;   ///< path, "grow.tolerance_db"
  std::string label;  ///< "Tolerance"
  std::string unit;
  std::string tooltip;
  double min = 0.0;  ///< of numbers; may be infinite
  double max = 0.0;
  std::vector<std::string> choices;
  PropertyValue initial;  ///< default
  std::string at_min;     ///< what the minimum means, "none"; empty = the number
  /// Where a slider ends, of numbers whose own range helps no hand; at its lower end it gives the minimum.
  std::optional<std::pair<double, double>> slider;
  std::string suits;   ///< as FieldInfo's
  bool basic = false;  ///< every user sets it; else an expert does
};

/// "tolerance_db" with unit "dB" -> "Tolerance": the unit stands beside the control.
[[nodiscard]] std::string label_of(std::string_view name, std::string_view unit);

/// Visitor: lists the properties of a described struct, its values as defaults.
class PropertyLister {
 public:
  template <class T>
  void field(std::string_view name, T& value, const FieldInfo& info) {
    list_.push_back({prefix_ + std::string(name),
                     label_of(name, info.unit),
                     std::string(info.unit),
                     std::string(info.text),
                     info.min,
                     info.max,
                     {},
                     value,
                     {},
                     {},
                     std::string(info.suits),
                     info.tier == Tier::basic});
  }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo& info) {
    list_.push_back({prefix_ + std::string(name),
                     label_of(name, {}),
                     {},
                     std::string(info.text),
                     0.0,
                     0.0,
                     {names.begin(), names.end()},
                     Choice{static_cast<std::size_t>(value)},
                     {},
                     {},
                     std::string(info.suits),
                     info.tier == Tier::basic});
  }
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    describe(*this, p);
    prefix_ = outer;
  }
  [[nodiscard]] std::vector<Property> take() { return std::move(list_); }

 private:
  std::string prefix_;
  std::vector<Property> list_;
};

/// Visitor: reads or, where there is a new value of the right type, writes the property of one path.
class PropertyAccess {
 public:
  explicit PropertyAccess(std::string_view path, const PropertyValue* to = nullptr) : path_(path), to_(to) {}

  template <class T>
  void field(std::string_view name, T& value, const FieldInfo&) {
    if (prefix_ + std::string(name) != path_) return;
    found_ = true;
    if (to_ != nullptr && std::holds_alternative<T>(*to_)) {
      value = std::get<T>(*to_);
      written_ = true;
    }
    value_ = value;
  }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo&) {
    if (prefix_ + std::string(name) != path_) return;
    found_ = true;
    if (to_ != nullptr && std::holds_alternative<Choice>(*to_) && std::get<Choice>(*to_).index < names.size()) {
      value = static_cast<E>(std::get<Choice>(*to_).index);
      written_ = true;
    }
    value_ = Choice{static_cast<std::size_t>(value)};
  }
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    describe(*this, p);
    prefix_ = outer;
  }
  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] bool written() const { return written_; }
  [[nodiscard]] const PropertyValue& value() const { return value_; }

 private:
  std::string path_;
  const PropertyValue* to_;
  std::string prefix_;
  PropertyValue value_;
  bool found_ = false;
  bool written_ = false;
};

/// A described parameter struct that a panel shows and changes. Listeners hear of all changes of a turn at once.
/// threads  the window's
template <class P>
class Parameters {
 public:
  explicit Parameters(ChangeQueue& queue, P defaults = {})
      : queue_(queue), shared_(std::make_shared<Shared>(defaults)), defaults_(std::move(defaults)) {
    PropertyLister lister;
    P copy = defaults_;
    describe(lister, copy);
    properties_ = lister.take();
  }

  [[nodiscard]] const std::vector<Property>& properties() const { return properties_; }
  [[nodiscard]] const P& values() const { return shared_->values; }
  /// errors  not_found: no such property
  [[nodiscard]] Result<PropertyValue> value(std::string_view name) const {
    PropertyAccess access(name);
    P copy = shared_->values;
    describe(access, copy);
    if (!access.found()) return fail(ErrorCode::not_found, fmt::format("no property {}", name));
    return access.value();
  }
  /// errors  not_found; bad_parameter: another type, or out of range. The value stands.
  Result<void> set(std::string_view name, const PropertyValue& to) {
    PropertyAccess access(name, &to);
    P copy = shared_->values;
    describe(access, copy);
    if (!access.found()) return fail(ErrorCode::not_found, fmt::format("no property {}", name));
    if (!access.written()) return fail(ErrorCode::bad_parameter, fmt::format("{}: no value for it", name));
    if (auto valid = validate(copy); !valid) return valid;
    assign(std::move(copy));
    return {};
  }
  Result<void> reset(std::string_view name) {
    PropertyAccess access(name);
    P copy = defaults_;
    describe(access, copy);
    if (!access.found()) return fail(ErrorCode::not_found, fmt::format("no property {}", name));
    return set(name, access.value());
  }
  /// Values that were validated.
  void assign(P values) {
    shared_->values = std::move(values);
    if (shared_->posted) return;
    shared_->posted = true;
    queue_.post([weak = std::weak_ptr<Shared>(shared_)] {
      const auto shared = weak.lock();
      if (!shared) return;
      shared->posted = false;
      shared->changed.tell(shared->values);
    });
  }
  /// A hand has taken hold of a slider, or let go of it.
  void hold(bool held) { held_ = held; }
  [[nodiscard]] bool held() const { return held_; }
  [[nodiscard]] Listeners<const P&>& changed() { return shared_->changed; }

 private:
  struct Shared {
    explicit Shared(P initial) : values(std::move(initial)) {}
    P values;
    Listeners<const P&> changed;
    bool posted = false;
  };
  ChangeQueue& queue_;
  std::shared_ptr<Shared> shared_;
  P defaults_;
  std::vector<Property> properties_;
  bool held_ = false;
};

}  // namespace sonar
