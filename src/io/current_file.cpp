// SPDX-License-Identifier: Apache-2.0
#include "io/current_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/cf_time.h"
#include "io/netcdf_file.h"

namespace sonar {
namespace {

constexpr std::size_t kMostValues = 400'000;
constexpr double kFastest_mps = 20.0;  ///< no current; fill values are 1e20 to 1e38
constexpr double kDeepest_m = 12'000.0;

/// What a variable is, by its CF standard name and by the names that programs give it.
struct Role {
  std::string_view standard_name;
  std::array<std::string_view, 6> names;
};
constexpr Role kEast{"eastward_sea_water_velocity", {"u", "UCUR", "EWCT", "ucur", "east", "U"}};
constexpr Role kNorth{"northward_sea_water_velocity", {"v", "VCUR", "NSCT", "vcur", "north", "V"}};
constexpr Role kTime{"time", {"time", "TIME", "Time", "t"}};
constexpr Role kDepth{"depth", {"depth", "DEPTH", "Depth", "DEPH"}};
constexpr Role kLatitude{"latitude", {"lat", "latitude", "LATITUDE", "Lat"}};
constexpr Role kLongitude{"longitude", {"lon", "longitude", "LONGITUDE", "Lon"}};
constexpr Role kFlag{"", {"pflag"}};

/// A file of currents as it is read; the first failure stays in the reader.
class CurrentFile {
 public:
  explicit CurrentFile(const std::filesystem::path& path) : in_(path, path.string()) { names_ = in_.variables(root()); }

  Result<CurrentProfiles> read() {
    const std::string time = required(kTime);
    const std::string depth = required(kDepth);
    const std::string east = required(kEast);
    const std::string north = required(kNorth);
    read_times(time);
    find_shape(time, east);
    read_depths(depth);
    east_mps_ = velocities(east);
    north_mps_ = velocities(north);
    latitude_deg_ = along_track(kLatitude);
    longitude_deg_ = along_track(kLongitude);
    read_flags();
    if (!in_.ok()) return pass_on(in_.status());
    return profiles();
  }

 private:
  [[nodiscard]] int root() const { return in_.root(); }
  [[nodiscard]] std::size_t times() const { return time_.size(); }
  [[nodiscard]] std::size_t values() const { return times() * bins_; }

  /// Name of the variable; empty where there is none.
  std::string find(const Role& role) {
    for (const std::string& name : names_) {
      if (!role.standard_name.empty() && in_.text_of(root(), name, "standard_name") == role.standard_name) return name;
    }
    for (const std::string_view name : role.names) {
      if (std::find(names_.begin(), names_.end(), name) != names_.end()) return std::string(name);
    }
    return {};
  }

  std::string required(const Role& role) {
    std::string name = in_.ok() ? find(role) : std::string{};
    if (name.empty()) {
      in_.refuse(ErrorCode::format, fmt::format("there is no variable of standard name {}, nor one named {}",
                                                role.standard_name, role.names.front()));
    }
    return name;
  }

  /// All values, what is missing as NaN, scaled.
  std::vector<double> numbers(const std::string& name, std::size_t expected) {
    if (!in_.ok()) return {};
    const double fill = in_.number_of(root(), name, "_FillValue");
    const double missing = in_.number_of(root(), name, "missing_value");
    const double scale = in_.number_of(root(), name, "scale_factor");
    const double offset = in_.number_of(root(), name, "add_offset");
    std::vector<double> values = in_.values<double>(root(), name, expected);
    for (double& value : values) {
      if (value == fill || value == missing) value = std::numeric_limits<double>::quiet_NaN();
      if (std::isfinite(scale)) value *= scale;
      if (std::isfinite(offset)) value += offset;
    }
    return values;
  }

  void refuse_unit(const std::string& name, const std::string& unit, std::string_view expected) {
    in_.refuse(ErrorCode::format, fmt::format("'{}' has the unit '{}': expected {}", name, unit, expected));
  }

  void read_times(const std::string& name) {
    if (!in_.ok()) return;
    const std::string units = in_.text_of(root(), name, "units");
    const auto axis = cf::time_axis(units);
    if (!axis) return refuse_unit(name, units, "days since 2009-01-01 00:00:00, or hours, minutes, seconds");
    constexpr double kMost_s = 7'258'118'400.0;  // 2200, as of raw files: what a recipe can tell, and TimeNs can hold
    const double origin_s = static_cast<double>(axis->origin) / static_cast<double>(kSecondNs);
    for (const double value : numbers(name, in_.size(root(), name))) {
      const double seconds = origin_s + value * axis->unit_s;
      const bool known = seconds > 0.0 && seconds < kMost_s;
      time_.push_back(known ? static_cast<TimeNs>(std::llround(seconds * 1e3)) * (kSecondNs / 1000) : 0);
    }
  }

  /// Number of bins, and whether times or bins come first.
  void find_shape(const std::string& time, const std::string& east) {
    if (!in_.ok()) return;
    const std::vector<std::string> of_time = in_.dimensions_of(root(), time);
    const std::vector<std::string> of_east = in_.dimensions_of(root(), east);
    const std::size_t all = in_.size(root(), east);
    const auto at = of_time.size() == 1 ? std::find(of_east.begin(), of_east.end(), of_time.front()) : of_east.end();
    if (at == of_east.end() || times() == 0 || all == 0) {
      return in_.refuse(ErrorCode::format, fmt::format("'{}': expected values over time and depth", east));
    }
    if (all > kMostValues) {
      return in_.refuse(ErrorCode::format, fmt::format("'{}' has {} values: expected {} at the most; average it over "
                                                       "longer times, or cut it to those of the survey",
                                                       east, all, kMostValues));
    }
    bins_ = all / times();
    // Dimensions of length 1 before that of time change nothing.
    std::size_t before = 1;
    for (auto it = of_east.begin(); it != at; ++it) before *= in_.dimension(root(), *it);
    if (before != 1 && before != bins_) {
      in_.refuse(ErrorCode::format, fmt::format("'{}': expected values over time and depth alone", east));
    }
    time_first_ = before == 1;
    axes_ = axes_of(east);
  }

  /// Dimensions along which a variable has more than one value.
  std::vector<std::string> axes_of(const std::string& name) {
    std::vector<std::string> axes = in_.dimensions_of(root(), name);
    std::erase_if(axes, [&](const std::string& one) { return in_.dimension(root(), one) == 1; });
    return axes;
  }
  /// Whether a variable's values are as many as those of the velocity east, in the same order.
  bool is_parallel(const std::string& name) { return axes_of(name) == axes_; }

  [[nodiscard]] std::size_t place(std::size_t time, std::size_t bin) const {
    return time_first_ ? time * bins_ + bin : bin * times() + time;
  }

  void read_depths(const std::string& name) {
    if (!in_.ok()) return;
    const std::string unit = in_.text_of(root(), name, "units");
    constexpr std::array<std::string_view, 5> kMetres{"m", "metre", "metres", "meter", "meters"};
    if (std::find(kMetres.begin(), kMetres.end(), unit) == kMetres.end()) return refuse_unit(name, unit, "m");
    const std::size_t count = in_.size(root(), name);
    if (in_.ok() && count != bins_ && !is_parallel(name)) {
      return in_.refuse(ErrorCode::format,
                        fmt::format("'{}' has {} values: expected {}, or that for each time", name, count, bins_));
    }
    depth_m_ = numbers(name, count);
    if (in_.text_of(root(), name, "positive") != "up") return;
    for (double& depth : depth_m_) depth = -depth;
  }

  [[nodiscard]] double depth_at(std::size_t time, std::size_t bin) const {
    return depth_m_[depth_m_.size() == bins_ ? bin : place(time, bin)];
  }

  std::vector<double> velocities(const std::string& name) {
    if (!in_.ok()) return {};
    const std::string unit = in_.text_of(root(), name, "units");
    constexpr std::array<std::string_view, 8> kMetres{"m s-1",         "m/s",          "m s^-1", "meter second-1",
                                                      "meters/second", "metre/second", "m.s-1",  "meter s-1"};
    constexpr std::array<std::string_view, 4> kCentimetres{"cm s-1", "cm/s", "cm s^-1", "cm.s-1"};
    const bool slow = std::find(kCentimetres.begin(), kCentimetres.end(), unit) != kCentimetres.end();
    if (!slow && std::find(kMetres.begin(), kMetres.end(), unit) == kMetres.end()) {
      refuse_unit(name, unit, "m s-1 or cm s-1");
      return {};
    }
    if (!is_parallel(name)) {
      in_.refuse(ErrorCode::format, fmt::format("'{}': expected values over {}", name, fmt::join(axes_, ", ")));
    }
    std::vector<double> out = numbers(name, values());
    for (double& value : out) value *= slow ? 0.01 : 1.0;
    return out;
  }

  /// A value for each time: told so, or one for all (a mooring); empty where it is neither.
  std::vector<double> along_track(const Role& role) {
    const std::string name = in_.ok() ? find(role) : std::string{};
    if (name.empty()) return {};
    const std::size_t count = in_.size(root(), name);
    if (count != times() && count != 1) return {};
    std::vector<double> out = numbers(name, count);
    if (count == 1 && !out.empty()) out.assign(times(), out.front());
    return out;
  }

  void read_flags() {
    const std::string name = in_.ok() ? find(kFlag) : std::string{};
    if (!name.empty() && is_parallel(name)) flags_ = numbers(name, values());
  }

  [[nodiscard]] bool known(std::size_t at, double depth_m) const {
    const bool flagged = !flags_.empty() && flags_[at] != 0.0;
    return !flagged && depth_m >= 0.0 && depth_m <= kDeepest_m && std::abs(east_mps_[at]) <= kFastest_mps &&
           std::abs(north_mps_[at]) <= kFastest_mps;
  }

  static double rounded(double value, double steps) { return std::round(value * steps) / steps; }

  [[nodiscard]] CurrentProfile profile(std::size_t time) const {
    CurrentProfile out;
    out.time = time_[time];
    if (!latitude_deg_.empty() && !longitude_deg_.empty() && std::abs(latitude_deg_[time]) <= 90.0 &&
        std::abs(longitude_deg_[time]) <= 720.0) {
      out.place = {rounded(latitude_deg_[time], 1e6), rounded(wrap_180(longitude_deg_[time]), 1e6)};
    }
    for (std::size_t bin = 0; bin < bins_; ++bin) {
      const std::size_t at = place(time, bin);
      const double depth_m = depth_at(time, bin);
      if (!known(at, depth_m)) continue;
      out.bins.push_back({rounded(depth_m, 100.0), rounded(east_mps_[at], 1e4), rounded(north_mps_[at], 1e4)});
    }
    std::stable_sort(out.bins.begin(), out.bins.end(),
                     [](const auto& a, const auto& b) { return a.depth_m < b.depth_m; });
    const auto same = [](const CurrentAt& a, const CurrentAt& b) { return a.depth_m == b.depth_m; };
    out.bins.erase(std::unique(out.bins.begin(), out.bins.end(), same), out.bins.end());
    return out;
  }

  Result<CurrentProfiles> profiles() {
    CurrentProfiles out;
    for (std::size_t time = 0; time < times(); ++time) {
      if (time_[time] == 0) continue;
      CurrentProfile one = profile(time);
      if (!one.bins.empty()) out.push_back(std::move(one));
    }
    if (out.empty()) {
      in_.refuse(ErrorCode::format, "no current is told: all values are missing, flagged or out of range");
      return pass_on(in_.status());
    }
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    const auto same = [](const CurrentProfile& a, const CurrentProfile& b) { return a.time == b.time; };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
    return out;
  }

  netcdf::Reader in_;
  std::vector<std::string> names_;
  std::vector<TimeNs> time_;       ///< 0 = not told
  std::vector<std::string> axes_;  ///< of the velocity east
  std::size_t bins_ = 0;
  bool time_first_ = true;
  std::vector<double> depth_m_;
  std::vector<double> east_mps_;  ///< as the file's axes; NaN = missing
  std::vector<double> north_mps_;
  std::vector<double> latitude_deg_;  ///< [time], or empty
  std::vector<double> longitude_deg_;
  std::vector<double> flags_;
};

}  // namespace

Result<CurrentProfiles> read_currents(const std::filesystem::path& path) { return CurrentFile(path).read(); }

}  // namespace sonar
